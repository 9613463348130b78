//! Errors: a quantity outside its range, and the cure of every error.

use core::fmt;

/// The remedy for an error, as text without a full stop; empty where the message suffices. Returned by the method `cure` of each error.
#[derive(Clone, Copy)]
pub struct Cure<'a>(&'a dyn Curable);

impl fmt::Display for Cure<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.write_cure(f)
    }
}

impl fmt::Debug for Cure<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Cure({self})")
    }
}

/// Writes an error's cure.
pub(crate) trait Curable {
    /// Writes the remedy.
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result;
}

impl<'a> Cure<'a> {
    pub(crate) const fn of(error: &'a dyn Curable) -> Self {
        Self(error)
    }
}

/// Gives an error its method `cure` and makes it a [`core::error::Error`]; the listed errors become variants of it by `?`.
macro_rules! error {
    ($error:ident $(, $variant:ident($of:path))*) => {
        impl $error {
            /// The remedy.
            #[must_use]
            pub const fn cure(&self) -> $crate::number::error::Cure<'_> {
                $crate::number::error::Cure::of(self)
            }
        }

        impl core::error::Error for $error {}

        $(impl From<$of> for $error {
            fn from(error: $of) -> Self {
                Self::$variant(error)
            }
        })*
    };
}
pub(crate) use error;

/// A quantity outside its range.
///
/// Values are in SI units (m, kg, s, rad).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum RangeError {
    /// The named quantity is NaN or infinite.
    NotFinite(&'static str),
    /// The named quantity must be greater than zero.
    NotPositive(&'static str, f64),
    /// The named quantity must not be negative.
    Negative(&'static str, f64),
    /// The named quantity lies outside `[min, max]`.
    OutOfRange {
        /// The quantity.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Smallest value allowed.
        min: f64,
        /// Largest value allowed.
        max: f64,
    },
    /// More elements than the fixed capacity.
    TooMany {
        /// Kind of the elements.
        what: &'static str,
        /// Capacity.
        capacity: usize,
    },
    /// The buffer is too short.
    BufferTooShort {
        /// Number of elements needed.
        needed: usize,
        /// Number of elements given.
        given: usize,
    },
}

error!(RangeError);

impl fmt::Display for RangeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite(what) => write!(f, "{what} is not a finite number"),
            Self::NotPositive(what, value) => {
                write!(f, "{what} is {value}, but must be greater than zero")
            }
            Self::Negative(what, value) => {
                write!(f, "{what} is {value}, but must not be negative")
            }
            Self::OutOfRange {
                what,
                value,
                min,
                max,
            } if max == f64::INFINITY => write!(f, "{what} is {value}, less than {min}"),
            Self::OutOfRange {
                what,
                value,
                min,
                max,
            } => write!(f, "{what} is {value}, outside {min} to {max}"),
            Self::TooMany { what, capacity } => {
                write!(f, "too many {what}: at most {capacity} fit")
            }
            Self::BufferTooShort { needed, given } => write!(
                f,
                "the buffer holds {given} elements, but {needed} are needed"
            ),
        }
    }
}

impl Curable for RangeError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite(_) => f.write_str("give a number that is neither NaN nor infinite"),
            Self::NotPositive(..) => f.write_str("give a value greater than zero"),
            Self::Negative(..) => f.write_str("give zero or a positive value"),
            Self::OutOfRange { min, max, .. } if max == f64::INFINITY => {
                write!(f, "give a value of at least {min}")
            }
            Self::OutOfRange { min, max, .. } => write!(f, "give a value from {min} to {max}"),
            Self::TooMany { .. } => f.write_str("leave some out, or join some to one"),
            Self::BufferTooShort { needed, .. } => write!(f, "give it {needed} elements"),
        }
    }
}

/// `value` if it is finite.
pub(crate) fn finite(what: &'static str, value: f64) -> Result<f64, RangeError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(RangeError::NotFinite(what))
    }
}

/// `value` if it is finite and not negative.
#[cfg(feature = "mechanics")]
pub(crate) fn not_negative(what: &'static str, value: f64) -> Result<f64, RangeError> {
    if finite(what, value)? < 0.0 {
        Err(RangeError::Negative(what, value))
    } else {
        Ok(value)
    }
}

/// `value` if it is finite and greater than zero.
pub(crate) fn positive(what: &'static str, value: f64) -> Result<f64, RangeError> {
    if finite(what, value)? > 0.0 {
        Ok(value)
    } else {
        Err(RangeError::NotPositive(what, value))
    }
}

/// `value` if it lies in [min, max].
#[cfg(feature = "mechanics")]
pub(crate) fn within(
    what: &'static str,
    value: f64,
    [min, max]: [f64; 2],
) -> Result<f64, RangeError> {
    if (min..=max).contains(&finite(what, value)?) {
        Ok(value)
    } else {
        Err(RangeError::OutOfRange {
            what,
            value,
            min,
            max,
        })
    }
}
