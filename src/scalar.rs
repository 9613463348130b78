//! The numbers a table and a tick are made of: `f32`, `f64` and [`Q31`].

use core::fmt;

pub use crate::fixed::Q31;
use crate::{Domain, Scale};

/// A number type for tables and ticks. Sealed: `f32`, `f64`, [`Q31`].
///
/// Floating point works in SI units or in per-unit, as its [`Scale`] says; fixed point always in per-unit.
pub trait Scalar: Kernel {
    /// Name as the command line and the generated sources use it.
    const NAME: &'static str;
}

/// A result, and whether it had to be limited to the number's range.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Outcome<S> {
    /// The result; the nearest end of the range if it did not fit.
    pub value: S,
    /// The exact result lies outside the range. Never set for floating point.
    pub saturated: bool,
}

/// The arithmetic behind a tick. Not nameable outside the crate: it may change with every release.
pub trait Kernel:
    Copy + Default + PartialEq + PartialOrd + fmt::Debug + crate::sealed::Sealed + 'static
{
    /// A number as it lies in a table image.
    type Word: bytemuck::Pod + fmt::Debug + PartialEq;
    /// Sums of products before the one rounding at the end.
    type Wide: Copy + core::ops::Add<Output = Self::Wide> + core::ops::Sub<Output = Self::Wide>;
    /// A constant to multiply slopes by, of any size.
    type Factor: Copy + fmt::Debug + PartialEq;
    /// Length of the drive link's range: `f64` for `f64` models, else `f32`.
    type Span: Copy + fmt::Debug;
    /// A place within a cell, 0 to 1.
    type Fraction: Copy;
    /// Code in the image header; `None`: not stored in images.
    const CODE: Option<u8>;

    fn from_word(word: Self::Word) -> Self;
    fn to_word(self) -> Self::Word;
    /// The nearest number, if `value` is in range.
    fn from_f64(value: f64) -> Option<Self>;
    fn to_f64(self) -> f64;
    /// `value` in units of `base`.
    fn per_unit(value: f32, base: f32) -> Outcome<Self>;
    /// Back to SI.
    fn si(self, base: f32) -> f32;

    fn span(domain: Domain) -> Self::Span;
    fn span_f32(domain: Domain<f32>) -> Self::Span;
    /// ½·(dJ/du)·cells/span·J_b·ω_b²/T_b is the velocity torque at the speed base: this is all but dJ/du.
    fn velocity_factor(cells: u32, span: Self::Span, scale: &Scale) -> Option<Self::Factor>;
    fn fraction(bits: u32) -> Self::Fraction;
    /// The cubic of a cell from its four control points (in sixths).
    fn cubic(points: [Self; 4]) -> [Self; 4];
    fn value(cubic: [Self; 4], u: Self::Fraction) -> Self;
    /// Slope per cell.
    fn slope(cubic: [Self; 4], u: Self::Fraction) -> Self;
    /// Whether a cell can be evaluated anywhere without overflow, NaN or infinity.
    fn cell_is_sound(points: [Self; 4]) -> bool;
    /// Whether slope · factor fits.
    fn factor_fits(slope: f32, factor: Self::Factor) -> bool;
    /// The number in single precision, for checks: no double-precision code in firmware that loads an image.
    fn to_wide_f32(self) -> f32;

    fn wide(self) -> Self::Wide;
    fn times(self, other: Self) -> Self::Wide;
    fn scaled(self, factor: Self::Factor) -> Self;
    /// `self` with the sign of `other`; zero where `other` is zero.
    fn signed_like(self, other: Self) -> Self::Wide;
    fn narrow(wide: Self::Wide) -> Outcome<Self>;
    /// `wide` / `divisor` for a positive divisor.
    fn quotient(wide: Self::Wide, divisor: Self) -> Outcome<Self>;
}

macro_rules! float {
    ($float:ident, $code:expr) => {
        impl Scalar for $float {
            const NAME: &'static str = stringify!($float);
        }

        impl Kernel for $float {
            type Word = $float;
            type Wide = $float;
            type Factor = $float;
            type Span = $float;
            type Fraction = $float;
            const CODE: Option<u8> = $code;

            fn from_word(word: $float) -> Self {
                word
            }
            fn to_word(self) -> $float {
                self
            }
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
            fn span(domain: Domain) -> $float {
                domain.span() as $float
            }
            fn span_f32(domain: Domain<f32>) -> $float {
                domain.span() as $float
            }
            fn velocity_factor(cells: u32, span: $float, scale: &Scale) -> Option<$float> {
                let bases = scale.velocity_base() as $float;
                let factor = 0.5 * cells as $float / span * bases;
                (factor.is_finite() && factor > 0.0).then_some(factor)
            }
            #[inline]
            fn fraction(bits: u32) -> $float {
                bits as $float * (1.0 / 4_294_967_296.0)
            }
            #[inline]
            fn cubic([c0, c1, c2, c3]: [Self; 4]) -> [Self; 4] {
                [
                    c0 + 4.0 * c1 + c2,
                    3.0 * (c2 - c0),
                    3.0 * (c0 - 2.0 * c1 + c2),
                    (c3 - c0) + 3.0 * (c1 - c2),
                ]
            }
            #[inline]
            fn value([p0, p1, p2, p3]: [Self; 4], u: $float) -> Self {
                p0 + u * (p1 + u * (p2 + u * p3))
            }
            #[inline]
            fn slope([_, p1, p2, p3]: [Self; 4], u: $float) -> Self {
                p1 + u * (2.0 * p2 + u * (3.0 * p3))
            }
            fn cell_is_sound(points: [Self; 4]) -> bool {
                // Far below the largest number, no sum of a few such products overflows.
                points.iter().all(|c| c.abs() < 1e30)
            }
            fn factor_fits(slope: f32, factor: $float) -> bool {
                (slope as $float * factor).abs() < 1e30
            }
            fn to_wide_f32(self) -> f32 {
                self as f32
            }
            #[inline]
            fn wide(self) -> $float {
                self
            }
            #[inline]
            fn times(self, other: Self) -> $float {
                self * other
            }
            #[inline]
            fn scaled(self, factor: $float) -> Self {
                self * factor
            }
            #[inline]
            fn signed_like(self, other: Self) -> $float {
                if other > 0.0 {
                    self
                } else if other < 0.0 {
                    -self
                } else {
                    0.0
                }
            }
            #[inline]
            fn narrow(wide: $float) -> Outcome<Self> {
                Outcome {
                    value: wide,
                    saturated: false,
                }
            }
            #[inline]
            fn quotient(wide: $float, divisor: Self) -> Outcome<Self> {
                Self::narrow(wide / divisor)
            }
        }
    };
}

float!(f32, Some(1));
float!(f64, None);
