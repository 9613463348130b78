//! Operation: continuous, short-time or intermittent.

/// Durations of operation and rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Operation {
    /// The cycle repeats without end: S1 and S6 to S9, and S3 to S5 whose rests are part of the motion.
    #[default]
    Continuous,
    /// One run from a cold start until everything is cold again: S2.
    Short {
        /// Operating time (s).
        operating: f64,
    },
    /// Alternating operation and rest: S3, S4, S5.
    Intermittent {
        /// Operating time (s).
        operating: f64,
        /// Rest (s).
        rest: f64,
        /// Whether the motor holds the machine at rest; otherwise it is without current.
        holding: bool,
    },
}

/// Operation and duty type of the machine file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Duty {
    /// Operation.
    pub operation: Operation,
    /// Number of the duty type, 1 to 9, if the file names one.
    pub kind: Option<u8>,
}

impl Operation {
    /// Share of the time in which the machine runs; `None` for a short operation.
    pub fn running(&self) -> Option<f64> {
        match *self {
            Self::Continuous => Some(1.0),
            Self::Short { .. } => None,
            Self::Intermittent {
                operating, rest, ..
            } => Some(operating / (operating + rest)),
        }
    }
}
