//! Errors of the parts of an axis.

use core::fmt;

use crate::Phase;
use crate::number::error::{Curable, error};

/// Why a part of an axis cannot be created.
///
/// Figures are in single precision and written with integers only: firmware that prints an error needs no floating-point formatting.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum AxisError {
    /// The named quantity is NaN or infinite.
    NotFinite(&'static str),
    /// The named quantity must be greater than zero; with its value.
    NotPositive(&'static str, f32),
    /// The named quantity must lie within a range.
    OutOfRange {
        /// The quantity.
        what: &'static str,
        /// Its value.
        value: f32,
        /// The allowed range.
        range: &'static str,
    },
    /// In fixed point the named quantity must be less than its base.
    BeyondBase {
        /// The quantity.
        what: &'static str,
        /// Its value.
        value: f32,
        /// Its base in the machine units of the model.
        base: f32,
    },
    /// The two look-aheads of a governor are not one forward and one backward.
    Directions,
    /// The load drives the machine with more than the braking torque, so that it cannot be stopped.
    Overpowered {
        /// Place.
        phase: Phase,
        /// The torque of the load, less helping friction (N·m, or N).
        load: f32,
        /// The braking torque.
        braking: f32,
    },
}

/// A number for a message, with three decimals, written with integers.
struct Decimal(f32);

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let magnitude = self.0.abs();
        if self.0 < 0.0 {
            f.write_str("-")?;
        }
        if magnitude.is_infinite() {
            return f.write_str("infinite");
        } else if magnitude >= 4e9 {
            return f.write_str("more than 4000000000");
        } else if magnitude > 0.0 && magnitude < 0.000_5 {
            return f.write_str("less than 0.001");
        }
        let whole = magnitude as u32;
        let thousandths = ((magnitude - whole as f32) * 1000.0 + 0.5) as u32;
        match thousandths {
            0 => write!(f, "{whole}"),
            1000.. => write!(f, "{}", whole.saturating_add(1)),
            _ if thousandths.is_multiple_of(100) => write!(f, "{whole}.{}", thousandths / 100),
            _ if thousandths.is_multiple_of(10) => write!(f, "{whole}.{:02}", thousandths / 10),
            _ => write!(f, "{whole}.{thousandths:03}"),
        }
    }
}

impl fmt::Display for AxisError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite(what) => write!(f, "{what} is not a finite number"),
            Self::NotPositive(what, value) => {
                let value = Decimal(value);
                write!(f, "{what} is {value}, but must be greater than zero")
            }
            Self::OutOfRange { what, value, range } => {
                write!(f, "{what} is {}, but must be {range}", Decimal(value))
            }
            Self::BeyondBase { what, value, base } => {
                let (value, base) = (Decimal(value), Decimal(base));
                write!(
                    f,
                    "{what} is {value}, but must be less than its base, {base}"
                )
            }
            Self::Directions => {
                f.write_str("the look-aheads of the governor are not one forward and one backward")
            }
            Self::Overpowered {
                phase,
                load,
                braking,
            } => {
                let thousandths = (u64::from(phase.to_bits()) * 1000) >> 32;
                let (load, braking) = (Decimal(load), Decimal(braking));
                write!(
                    f,
                    "at {thousandths}/1000 of the range the load drives the machine with {load}, more than the braking torque of {braking}"
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
            Self::NotPositive(..) => f.write_str("give a value greater than zero"),
            Self::OutOfRange { range, .. } => write!(f, "give a value {range}"),
            Self::BeyondBase { .. } => f.write_str(
                "give a smaller value, or export the table for a greater speed and acceleration",
            ),
            Self::Directions => {
                f.write_str("give one that looks forward, and then one that looks backward")
            }
            Self::Overpowered { .. } => {
                f.write_str("give more braking torque, or a counterbalance to the load")
            }
        }
    }
}

/// `value` if it is finite and greater than zero.
pub(super) fn positive(what: &'static str, value: f32) -> Result<f32, AxisError> {
    if !value.is_finite() {
        Err(AxisError::NotFinite(what))
    } else if value > 0.0 {
        Ok(value)
    } else {
        Err(AxisError::NotPositive(what, value))
    }
}

/// An error unless `value` is finite and `holds`; a comparison with NaN is false.
pub(super) fn within(
    what: &'static str,
    value: f32,
    holds: bool,
    range: &'static str,
) -> Result<(), AxisError> {
    if holds {
        Ok(())
    } else if value.is_nan() {
        Err(AxisError::NotFinite(what))
    } else {
        Err(AxisError::OutOfRange { what, value, range })
    }
}
