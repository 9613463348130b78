//! Figures of a machine file's motion, segment by segment.

use serde::Serialize;

use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::{Motion, ToolCoordinate};

/// The motion in figures (SI).
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct MotionFindings {
    /// The prescribed coordinate: "drive link", or a coordinate of the tool.
    pub of: String,
    /// Whether it repeats.
    pub cyclic: bool,
    /// Duration (s).
    #[serde(rename = "duration [s]")]
    pub duration: f64,
    /// Advance of the drive link (rad, or m).
    pub advance: f64,
    /// The drive link's largest speed (per s).
    pub speed: f64,
    /// The drive link's largest acceleration (per s²).
    pub acceleration: f64,
    /// Its segments.
    pub segments: Vec<SegmentFinding>,
}

/// One segment (SI).
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct SegmentFinding {
    /// Whether it prescribes an angle.
    pub angle: bool,
    /// Whether it prescribes the drive link, not the tool.
    #[serde(rename = "of the drive link")]
    pub of_drive: bool,
    /// Duration (s).
    #[serde(rename = "duration [s]")]
    pub duration: f64,
    /// Distance (rad, or m).
    pub distance: f64,
    /// Largest speed (per s).
    pub speed: f64,
    /// Largest acceleration (per s²).
    pub acceleration: f64,
    /// Largest jerk (per s³); `None` if the acceleration jumps.
    pub jerk: Option<f64>,
    /// C_v, C_a, C_j and C_Mdyn; `None` for a dwell.
    pub coefficients: Option<[Option<f64>; 4]>,
}

impl SegmentFinding {
    /// The coordinate that it prescribes.
    pub const fn coordinate(&self) -> Coordinate {
        if self.angle {
            Coordinate::Angle
        } else {
            Coordinate::Length
        }
    }
}

impl MotionFindings {
    pub(super) fn of(file: &MachineFile) -> Option<Self> {
        let motion: &Motion = file.motion.as_ref()?;
        let drive = file.machine.mechanism().coordinate();
        let tool = motion.tool();
        let [speed, acceleration] = motion.drive_peaks();
        let segments = motion.courses().into_iter().map(|course| {
            let coordinate = tool.filter(|_| !course.of_drive);
            let coordinate = coordinate.map_or(drive, ToolCoordinate::coordinate);
            SegmentFinding {
                angle: coordinate == Coordinate::Angle,
                of_drive: course.of_drive,
                duration: course.duration,
                distance: course.distance,
                speed: course.speed,
                acceleration: course.acceleration,
                jerk: course.jerk,
                coefficients: course.coefficients(),
            }
        });
        Some(Self {
            of: tool.map_or_else(|| "drive link".to_owned(), |tool| tool.name().to_owned()),
            cyclic: motion.cyclic,
            duration: motion.duration(),
            advance: motion.at(motion.duration()).phi - motion.at(0.0).phi,
            speed,
            acceleration,
            segments: segments.collect(),
        })
    }
}
