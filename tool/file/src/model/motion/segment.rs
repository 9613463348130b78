//! One segment of a motion: a move by a law, or successive polynomials.

use jred::machine::motion::{Law, Polynomial};

use super::MoveLimits;

/// One segment of a segmented motion.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionSegment {
    /// The drive link's position at its start, if it prescribes the drive link instead of the tool; `None`: it continues from the previous segment.
    pub from: Option<f64>,
    /// Distance (rad, or m); zero for a dwell.
    pub distance: f64,
    /// The course over this distance.
    pub course: SegmentProfile,
    /// The limits in the file, for which the course is the fastest.
    pub limits: Option<MoveLimits>,
}

/// The course of a segment from one end to the other.
#[derive(Clone, Debug, PartialEq)]
pub enum SegmentProfile {
    /// By a motion law, from rest to rest.
    Law {
        /// The law.
        law: Law,
        /// Duration (s).
        duration: f64,
    },
    /// By successive polynomials.
    Phases(Vec<Phase>),
}

/// One polynomial over the time since its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// Duration (s).
    pub duration: f64,
    /// Displacement over the time.
    pub polynomial: Polynomial,
}

impl MotionSegment {
    /// A pause (s).
    pub fn dwell(duration: f64) -> Self {
        Self::law(0.0, duration, Law::default())
    }

    /// A move (rad, or m) by a motion law in a duration (s).
    pub const fn law(distance: f64, duration: f64, law: Law) -> Self {
        let course = SegmentProfile::Law { law, duration };
        Self {
            from: None,
            distance,
            course,
            limits: None,
        }
    }

    /// Successive polynomials that cover the distance together.
    pub const fn phases(distance: f64, phases: Vec<Phase>) -> Self {
        let course = SegmentProfile::Phases(phases);
        Self {
            from: None,
            distance,
            course,
            limits: None,
        }
    }

    /// A move by one polynomial.
    pub fn polynomial(distance: f64, duration: f64, polynomial: Polynomial) -> Self {
        let phase = Phase {
            duration,
            polynomial,
        };
        Self::phases(distance, vec![phase])
    }

    /// The same, made for limits.
    #[must_use]
    pub fn within(self, limits: MoveLimits) -> Self {
        let limits = Some(limits);
        Self { limits, ..self }
    }

    /// The same from a position of the drive link, which is then prescribed.
    #[must_use]
    pub fn of_drive(self, from: f64) -> Self {
        let from = Some(from);
        Self { from, ..self }
    }

    /// A move at constant speed.
    pub fn constant_speed(distance: f64, duration: f64, speed: f64) -> Self {
        let steady = Polynomial::constant_jerk([speed, 0.0, 0.0]);
        Self::polynomial(distance, duration, steady)
    }

    /// Duration (s).
    pub fn duration(&self) -> f64 {
        match &self.course {
            SegmentProfile::Law { duration, .. } => *duration,
            SegmentProfile::Phases(phases) => phases.iter().map(|phase| phase.duration).sum(),
        }
    }

    /// Speed and acceleration at the start and at the end.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        match &self.course {
            SegmentProfile::Law { law, duration } => {
                let bend = self.distance / (duration * duration);
                [0.0, 1.0].map(|z| [0.0, law.at(z)[2] * bend])
            }
            SegmentProfile::Phases(phases) => {
                let at = |phase: Option<&Phase>, end: bool| {
                    phase.map_or([0.0; 2], |phase| {
                        let t = if end { phase.duration } else { 0.0 };
                        let [_, v, a, _] = phase.polynomial.at(t);
                        [v, a]
                    })
                };
                [at(phases.first(), false), at(phases.last(), true)]
            }
        }
    }
}
