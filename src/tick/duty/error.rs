//! Errors of limits.

use core::fmt;

use crate::number::error::{Curable, error};

/// Why a [`Curve`](super::Curve) or a [`Meter`](super::Meter) cannot be created.
///
/// Contains no floating-point number: firmware that prints none then needs no double precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum LimitError {
    /// The named quantity is NaN or infinite.
    NotFinite(&'static str),
    /// The named quantity must not be negative.
    Negative(&'static str),
    /// The named quantity must be greater than zero.
    NotPositive(&'static str),
    /// A curve has no point, or more than [`MAX_POINTS`](super::MAX_POINTS).
    Points {
        /// Number of points.
        given: usize,
    },
    /// The speeds of a curve must rise.
    NotRising {
        /// Index of the first point that does not rise.
        point: usize,
    },
    /// The time constant of an exponential window must be at least ten ticks.
    WindowTooShort,
}

impl fmt::Display for LimitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite(what) => write!(f, "{what} is not a finite number"),
            Self::Negative(what) => write!(f, "{what} must not be negative"),
            Self::NotPositive(what) => write!(f, "{what} must be greater than zero"),
            Self::Points { given } => write!(f, "the curve has {given} points"),
            Self::NotRising { point } => write!(
                f,
                "the speeds of a curve must rise, but that of point {point} (counted from 0) does not"
            ),
            Self::WindowTooShort => {
                f.write_str("the time constant of an exponential window must be at least ten ticks")
            }
        }
    }
}

error!(LimitError);

impl Curable for LimitError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite(_) => f.write_str("give a number that is neither NaN nor infinite"),
            Self::Negative(_) => f.write_str("give zero or a positive value"),
            Self::NotPositive(_) => f.write_str("give a value greater than zero"),
            Self::Points { .. } => write!(f, "give 1 to {} points", super::MAX_POINTS),
            Self::NotRising { .. } => f.write_str("give the points in the order of their speeds"),
            Self::WindowTooShort => f.write_str("give a longer time constant"),
        }
    }
}
