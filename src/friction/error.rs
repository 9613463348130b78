//! Why a friction drive cannot be created or moved.

use core::fmt;

use crate::number::error::{Curable, RangeError, error};

/// Why a friction drive cannot be created or moved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum FrictionError {
    /// A quantity outside its range.
    Range(RangeError),
    /// A friction stage with a varying ratio or slip, where only constant ones are possible.
    VaryingRatio {
        /// Index of the stage.
        stage: usize,
    },
    /// Load and slip, which depend on each other, did not converge.
    NotSettled,
}

error!(FrictionError, Range(RangeError));

impl fmt::Display for FrictionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Range(error) => error.fmt(f),
            Self::VaryingRatio { stage } => write!(
                f,
                "the ratio or slip of friction stage {stage} varies: the angle of its second shaft need not be a function \
                 of the drive angle"
            ),
            Self::NotSettled => f.write_str("load and slip of the friction drive do not settle"),
        }
    }
}

impl Curable for FrictionError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Range(error) => return error.write_cure(f),
            Self::VaryingRatio { .. } => {
                "give numbers, or use the friction drive's own equation of motion"
            }
            Self::NotSettled => "let the one depend less on the other",
        })
    }
}
