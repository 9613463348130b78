//! The numbers that a tick takes and gives: `f32`, `f64`, [`Q31`](crate::Q31) and [`Q15`](crate::Q15).

use core::fmt;

use super::Rate;
use super::kernel::Kernel;
use crate::math::Real;

/// A number of a tick: `f32`, `f64`, [`Q31`](crate::Q31) or [`Q15`](crate::Q15). Sealed.
///
/// Floating point works in SI units or in per-unit, as its [`Scale`](crate::Scale) says; fixed point always in per-unit.
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
/// A number of one's own does not compile, complete or not:
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
/// Nor is a number of 16 bits one of 32:
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
    /// A number as it lies in a table: `f32`, `f64`, `i32` for `Q31`, `i16` for `Q15`.
    type Word: bytemuck::Pod + Default + fmt::Debug + PartialEq;
    /// Name as the command line and the generated sources use it.
    const NAME: &'static str;
    /// Fixed point: the largest number is 1, and forward dynamics can do without a division.
    const FIXED: bool;

    /// The nearest number, if it is in range.
    fn from_f64(value: f64) -> Option<Self>;
    /// The same number.
    fn to_f64(self) -> f64;
    /// `value` in units of `base`.
    fn per_unit(value: f32, base: f32) -> Outcome<Self>;
    /// Back to SI.
    fn si(self, base: f32) -> f32;
    /// `count` times the factor; limited and flagged in fixed point.
    #[doc(hidden)]
    fn of_count(count: i32, rate: &Rate) -> Outcome<Self>;
    /// The whole count below this number; limited, and 0 for what is no number.
    #[doc(hidden)]
    fn to_count(self, rate: &Rate) -> i32;
}

/// A number in tables of polynomials: `f32`, `f64`, [`Q31`](crate::Q31). Sealed.
///
/// Its supertrait `Kernel` is the arithmetic behind a tick, which may change with every release: it cannot be named outside the
/// crate.
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

macro_rules! float {
    ($float:ident) => {
        impl Scalar for $float {}

        impl Number for $float {
            type Real = $float;
            type Word = $float;
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
            fn of_count(count: i32, rate: &Rate) -> Outcome<Self> {
                Outcome {
                    value: count as $float * rate.factor as $float,
                    saturated: false,
                }
            }
            #[inline(always)]
            fn to_count(self, rate: &Rate) -> i32 {
                (self * rate.counts as $float) as i32
            }
        }
    };
}

float!(f32);
float!(f64);
