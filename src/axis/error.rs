//! What can be wrong with an axis.

use core::fmt;

use crate::Phase;
use crate::number::error::{Curable, error};

/// Why a part of an axis cannot be made.
///
/// Carries no number: firmware that prints nothing then needs no double precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum AxisError {
    /// The named quantity is NaN or infinite.
    NotFinite(&'static str),
    /// The named quantity must be greater than zero.
    NotPositive(&'static str),
    /// The named quantity must lie within a range.
    OutOfRange {
        /// Which quantity.
        what: &'static str,
        /// From where to where.
        range: &'static str,
    },
    /// Here the load drives the machine with more than the braking torque: nothing would stop it.
    Overpowered(Phase),
}

impl fmt::Display for AxisError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite(what) => write!(f, "{what} is not a finite number"),
            Self::NotPositive(what) => write!(f, "{what} must be greater than zero"),
            Self::OutOfRange { what, range } => write!(f, "{what} must be {range}"),
            Self::Overpowered(phase) => {
                let thousandths = (u64::from(phase.to_bits()) * 1000) >> 32;
                write!(
                    f,
                    "the load drives the machine with more than the braking torque at {thousandths}/1000 of the range"
                )
            }
        }
    }
}

error!(AxisError);

impl Curable for AxisError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite(_) => f.write_str("give a number that is neither NaN nor infinite"),
            Self::NotPositive(_) => f.write_str("give a value greater than zero"),
            Self::OutOfRange { range, .. } => write!(f, "give a value {range}"),
            Self::Overpowered(_) => {
                f.write_str("give more braking torque, or a counterbalance to the load")
            }
        }
    }
}

/// `value` if it is a number that is finite and greater than zero.
pub(super) fn positive(what: &'static str, value: f32) -> Result<f32, AxisError> {
    if !value.is_finite() {
        Err(AxisError::NotFinite(what))
    } else if value > 0.0 {
        Ok(value)
    } else {
        Err(AxisError::NotPositive(what))
    }
}

/// An error unless `holds`, which of NaN no comparison does.
pub(super) fn within(
    what: &'static str,
    holds: bool,
    range: &'static str,
) -> Result<(), AxisError> {
    if holds {
        Ok(())
    } else {
        Err(AxisError::OutOfRange { what, range })
    }
}
