//! What can be wrong with limits.

use core::fmt;

/// Why a [`Curve`](super::Curve) or a [`Meter`](super::Meter) cannot be made.
///
/// Carries no number: firmware that prints nothing then needs no double precision.
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
        /// How many.
        given: usize,
    },
    /// The speeds of a curve must rise.
    NotRising {
        /// Index of the point that is not beyond the one before.
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
            Self::Points { given } => write!(
                f,
                "a curve has 1 to {} points, not {given}",
                super::MAX_POINTS
            ),
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

impl core::error::Error for LimitError {}
