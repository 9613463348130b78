//! The torque of a motion in the units of a drive with the profile CiA 402, as feed-forward.
//!
//! The torque offset 0x60B2 and the target torque 0x6071 count thousandths of the motor's rated torque 0x6076, which is in mN·m; the position 0x6064
//! counts increments.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use jred_file::number::rounding::rounded;
use jred_file::problem;
use jred_file::text::problem::Result;

/// An instant at the shaft of the motor.
#[derive(Clone, Copy, Debug)]
pub struct ShaftInstant {
    /// Time (s).
    pub t: f64,
    /// Position (rad, or m).
    pub position: f64,
    /// Torque (N·m, or N), positive where it moves the shaft towards growing position.
    pub torque: f64,
}

/// A table for a drive.
#[derive(Clone, Copy, Debug)]
pub struct TorqueOffsets<'a> {
    /// Name of the machine.
    pub title: &'a str,
    /// The instants.
    pub instants: &'a [ShaftInstant],
    /// Rated torque in the drive's object 0x6076 (N·m, or N).
    pub rated: f64,
    /// Increments of a turn of the shaft, for a column of positions.
    pub counts_per_turn: Option<u32>,
    /// Inertia of rotor and gearbox in the torques (kg·m²).
    pub rotor: f64,
    /// Name of the drive whose motor has the shaft; without one it is the input of the drive train.
    pub drive: Option<&'a str>,
    /// Unit of torques: "N m", or "N".
    pub unit: &'static str,
}

/// Largest magnitude of a thousandth in an INTEGER16, whose least number is not used.
const MOST: f64 = i16::MAX as f64;

/// Peak torque over rated torque that most servo motors do not exceed.
const USUAL_PEAK: f64 = 5.0;

impl TorqueOffsets<'_> {
    fn largest(&self) -> f64 {
        let torques = self.instants.iter().map(|i| i.torque.abs());
        torques.fold(0.0, f64::max)
    }

    /// The fault and cure of a torque above the drive's peak torque (N·m, or N), or above a usual one if that is not known.
    pub fn excess(&self, peak: Option<f64>) -> Option<String> {
        let (largest, unit) = (self.largest(), self.unit);
        let per_mille = (largest / self.rated * 1e3).round();
        let shown = format!("the largest torque, {} {unit}, is", rounded(largest));
        match peak {
            Some(peak) => (largest > peak).then(|| {
                format!(
                    "{shown} above the peak torque of motor and amplifier, {} {unit}: take a stronger drive, or a slower motion",
                    rounded(peak)
                )
            }),
            None => (largest > USUAL_PEAK * self.rated).then(|| {
                format!(
                    "{shown} {per_mille} per mille of the rated torque; most drives take up to {} (0x6072): give the rated torque of the motor, and a gearbox before the machine \
                     with --drive MOTOR+GEARBOX or in the file",
                    USUAL_PEAK * 1e3
                )
            }),
        }
    }

    /// The table as CSV, with base and frame in comments.
    ///
    /// # Errors
    /// A number beyond the range of its object.
    pub fn csv(&self) -> Result<String> {
        let unit = self.unit;
        let base = (self.rated * 1e3).round();
        if !(1.0..=f64::from(u32::MAX)).contains(&base) {
            return Err(problem!(
                help = "give the rated torque of the motor, as it is set in the drive",
                "the rated torque {} {unit} does not fit object 0x6076, whole m{unit} from 1 to {}",
                rounded(self.rated),
                u32::MAX
            ));
        }
        // The drive knows the rated torque in whole thousandths of a newton metre only.
        let rated = base * 1e-3;
        let largest = self.largest();
        let frame = match self.drive {
            Some(drive) => format!("the motor of {drive}, with its gearbox and friction"),
            None => "the input of the machine file's drive train, or the drive link without one; a gearbox that is not in the file is not in the figures".to_owned(),
        };
        let mut text = format!(
            "# {}\n\
             # base: 0x6076 = {base} m{unit}; 1 per mille = {} {unit}\n\
             # largest torque {} {unit}; rounded to half of a per mille\n\
             # frame: {frame}; positive counts and torque are those of that shaft; a negative ratio turns both\n\
             # inertia of rotor and gearbox in the torque: {} kg m^2\n\
             # write the torque to 0x60B2 (torque offset) in position and velocity modes, to 0x6071 (target torque) in torque mode\n\
             t [s],{}0x60B2 [per mille]\n",
            self.title.replace(['\n', '\r'], " "),
            rounded(rated * 1e-3),
            rounded(largest),
            rounded(self.rotor),
            self.counts_per_turn.map_or("", |_| "0x6064 [counts],")
        );
        for instant in self.instants {
            let t = instant.t;
            // Avoids -0.
            let per_mille = (instant.torque / rated * 1e3).round() + 0.0;
            if !(-MOST..=MOST).contains(&per_mille) {
                // In whole thousandths, so that it fits.
                let least = (largest * 1e6 / MOST).ceil() * 1e-3;
                return Err(problem!(
                    help = format!(
                        "is the rated torque that of the motor? From {} {unit} the motion fits; set the same in object 0x6076",
                        rounded(least)
                    ),
                    "the torque {} {unit} at t = {} s is {} per mille of the rated torque: objects 0x60B2 and 0x6071 are INTEGER16, up to {MOST}",
                    rounded(instant.torque),
                    rounded(t),
                    rounded(per_mille)
                ));
            }
            let _ = write!(text, "{t},");
            if let Some(per_turn) = self.counts_per_turn {
                let counts = (instant.position / TAU * f64::from(per_turn)).round() + 0.0;
                if !(f64::from(-i32::MAX)..=f64::from(i32::MAX)).contains(&counts) {
                    return Err(problem!(
                        help = "give fewer --counts-per-turn, as scaled in the drive, or a motion of fewer turns",
                        "the position at t = {} s is {} counts: object 0x6064 is INTEGER32, up to {}",
                        rounded(t),
                        rounded(counts),
                        i32::MAX
                    ));
                }
                let _ = write!(text, "{counts},");
            }
            let _ = writeln!(text, "{per_mille}");
        }
        Ok(text)
    }
}
