//! The numbers of a tick: `f32`, `f64`, [`Q31`](crate::Q31) and [`Q15`](crate::Q15).

use core::fmt;

use super::Factor;
use super::kernel::Kernel;
use crate::math::Real;

/// A number of a tick: `f32`, `f64`, [`Q31`](crate::Q31) or [`Q15`](crate::Q15). Sealed.
///
/// Floating point uses SI units or per-unit, depending on its [`Scale`](crate::Scale); fixed point always uses per-unit.
///
/// ```
/// use jred::Q31;
/// use jred::number::Number;
///
/// fn doubled<S: Number>(x: S) -> Option<S> {
///     S::from_f64(2.0 * x.to_f64())
/// }
/// assert_eq!(doubled(0.25), Some(0.5));
/// assert_eq!(doubled(Q31::MAX), None);
/// ```
///
/// Other crates cannot implement it, completely or not:
///
/// ```compile_fail,E0277
/// use jred::Outcome;
/// use jred::number::Number;
///
/// #[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
/// struct Mine(f32);
///
/// impl Number for Mine {
///     type Real = f32;
///     type Word = f32;
///     type Speed = Self;
///     type Acceleration = Self;
///     type Torque = Self;
///     type MotorTorque = Self;
///     const NAME: &'static str = "mine";
///     const FIXED: bool = false;
///     fn from_f64(value: f64) -> Option<Self> {
///         Some(Self(value as f32))
///     }
///     fn to_f64(self) -> f64 {
///         self.0.into()
///     }
///     fn per_unit(value: f32, base: f32) -> Outcome<Self> {
///         Outcome { value: Self(value / base), saturated: false }
///     }
///     fn si(self, base: f32) -> f32 {
///         self.0 * base
///     }
/// }
/// ```
///
/// Nor is a 16-bit number a 32-bit one:
///
/// ```
/// # use jred::{Q15, Q31};
/// let half = Q31::from_bits(i32::from(Q15::from_bits(1 << 14).to_bits()) << 16);
/// ```
///
/// ```compile_fail,E0308
/// # use jred::{Q15, Q31};
/// let half: Q31 = Q15::from_bits(1 << 14);
/// ```
pub trait Number:
    Copy + Default + PartialEq + PartialOrd + fmt::Debug + crate::sealed::Sealed + 'static
{
    /// The type for lengths and spans: `f64` for `f64`, otherwise `f32`.
    type Real: Real;
    /// A number as stored in a table: `f32`, `f64`, `i32` for `Q31`, `i16` for `Q15`.
    type Word: bytemuck::Pod + Default + fmt::Debug + PartialEq;
    /// A speed: the number itself in floating point, [`Speed`](crate::Speed) in fixed point.
    type Speed: super::Quantity<Number = Self>;
    /// An acceleration: the number itself, or [`Acceleration`](crate::Acceleration).
    type Acceleration: super::Quantity<Number = Self>;
    /// A torque on the drive link: the number itself, or [`Torque`](crate::Torque).
    type Torque: super::Quantity<Number = Self>;
    /// A torque on the motor's shaft: the number itself, or [`MotorTorque`](crate::MotorTorque).
    type MotorTorque: super::Quantity<Number = Self>;
    /// Name in the command line and in generated sources.
    const NAME: &'static str;
    /// Fixed point: the largest number is 1, and forward dynamics can avoid the division.
    const FIXED: bool;

    /// The nearest number, if it is in range.
    fn from_f64(value: f64) -> Option<Self>;
    /// The same number.
    fn to_f64(self) -> f64;
    /// `value` in units of `base`.
    fn per_unit(value: f32, base: f32) -> Outcome<Self>;
    /// From units of `base` to SI.
    fn si(self, base: f32) -> f32;
    /// `count` times the factor; limited and flagged in fixed point.
    #[doc(hidden)]
    fn of_count(count: i32, factor: &Factor) -> Outcome<Self>;
    /// The sum of two counts, each times its factor, rounded once; limited and flagged in fixed point.
    #[doc(hidden)]
    #[inline(always)]
    fn of_counts(counts: [(i32, &Factor); 2]) -> Outcome<Self> {
        let [a, b] = counts.map(|(count, factor)| Self::of_count(count, factor));
        let sum = a.value.plus(b.value);
        Outcome {
            value: sum.value,
            saturated: a.saturated || b.saturated || sum.saturated,
        }
    }
    /// The number times the factor, as a count; limited, and 0 for NaN.
    #[doc(hidden)]
    fn to_count(self, factor: &Factor) -> i32;
    /// The number times the factor; limited and flagged in fixed point.
    #[doc(hidden)]
    fn times(self, factor: &Factor) -> Outcome<Self>;
    /// The sum; limited and flagged in fixed point.
    #[doc(hidden)]
    fn plus(self, other: Self) -> Outcome<Self>;
    /// self − other; limited and flagged in fixed point.
    #[doc(hidden)]
    fn minus(self, other: Self) -> Outcome<Self>;
    /// The mean of two.
    #[doc(hidden)]
    #[must_use]
    fn mean(self, other: Self) -> Self;
    /// The smallest nonzero number of the same sign; 0 for 0.
    #[doc(hidden)]
    #[must_use]
    fn least(self) -> Self;
    /// Limited to −1 … 1; NaN becomes 0.
    #[doc(hidden)]
    #[must_use]
    #[inline(always)]
    fn to_unit(self) -> Self {
        self
    }
    /// Whether its magnitude is greater than the limit; true for NaN.
    #[doc(hidden)]
    fn exceeds(self, limit: Self) -> bool;
    /// Limited to a range; NaN becomes 0.
    #[doc(hidden)]
    #[must_use]
    #[inline(always)]
    fn within(self, [least, greatest]: [Self; 2]) -> Self {
        if self > greatest {
            greatest
        } else if self >= least {
            self
        } else if self < least {
            least
        } else {
            Self::default()
        }
    }
}

/// A number in tables of polynomials: `f32`, `f64`, [`Q31`](crate::Q31). Sealed.
///
/// Its supertrait `Kernel` is the arithmetic of a tick, which may change with every release: it cannot be named outside the crate.
pub trait Scalar: Number + Kernel {}

/// A result, and whether it was limited to the number's range.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Outcome<S> {
    /// The result; the nearest end of the range if it did not fit.
    pub value: S,
    /// The exact result lies outside the range. Never set for floating point.
    pub saturated: bool,
}

impl<S> Outcome<S> {
    /// A result that was not limited.
    #[inline(always)]
    pub(crate) const fn exact(value: S) -> Self {
        Self {
            value,
            saturated: false,
        }
    }

    /// The same, with the result converted by `of`.
    #[inline(always)]
    pub(crate) fn map<T>(self, of: impl FnOnce(S) -> T) -> Outcome<T> {
        Outcome {
            value: of(self.value),
            saturated: self.saturated,
        }
    }
}

macro_rules! float {
    ($float:ident) => {
        impl Scalar for $float {}

        impl Number for $float {
            type Real = $float;
            type Word = $float;
            type Speed = $float;
            type Acceleration = $float;
            type Torque = $float;
            type MotorTorque = $float;
            const NAME: &'static str = stringify!($float);
            const FIXED: bool = false;

            fn from_f64(value: f64) -> Option<Self> {
                let nearest = value as $float;
                nearest.is_finite().then_some(nearest)
            }
            fn to_f64(self) -> f64 {
                self as f64
            }
            fn per_unit(value: f32, base: f32) -> Outcome<Self> {
                Outcome {
                    value: value as $float / base as $float,
                    saturated: false,
                }
            }
            fn si(self, base: f32) -> f32 {
                self as f32 * base
            }
            #[inline(always)]
            fn of_count(count: i32, factor: &Factor) -> Outcome<Self> {
                (count as $float).times(factor)
            }
            #[inline(always)]
            fn to_count(self, factor: &Factor) -> i32 {
                (self * factor.float as $float) as i32
            }
            #[inline(always)]
            fn times(self, factor: &Factor) -> Outcome<Self> {
                Outcome::exact(self * factor.float as $float)
            }
            #[inline(always)]
            fn plus(self, other: Self) -> Outcome<Self> {
                Outcome::exact(self + other)
            }
            #[inline(always)]
            fn minus(self, other: Self) -> Outcome<Self> {
                Outcome::exact(self - other)
            }
            #[inline(always)]
            fn mean(self, other: Self) -> Self {
                0.5 * (self + other)
            }
            #[inline(always)]
            fn least(self) -> Self {
                // By the bits: with software floating point a comparison is a call.
                let size = if self.to_bits() << 1 == 0 {
                    0.0
                } else {
                    $float::MIN_POSITIVE
                };
                size.copysign(self)
            }
            #[inline(always)]
            fn to_unit(self) -> Self {
                self.within([-1.0, 1.0])
            }
            #[inline(always)]
            fn exceeds(self, limit: Self) -> bool {
                // Magnitudes of floating point compare like their bits, with NaN above all.
                self.to_bits() << 1 > limit.to_bits() << 1
            }
        }
    };
}

float!(f32);
float!(f64);
