//! The only use of `libm`: one library, so the same bits on every processor. `clippy.toml` refuses its functions everywhere else in the package. They
//! are called by path, so that `std`'s methods never replace them in tests.
#![allow(clippy::disallowed_methods, reason = "the door itself")]
#![cfg_attr(
    not(feature = "mechanics"),
    allow(dead_code, reason = "ticks need some of it, mechanisms all")
)]

/// A binary floating-point number: `f32` or `f64`. Sealed.
///
/// Motion laws are written once for both: firmware runs them in `f32`, the host in `f64`.
pub trait Real:
    Copy
    + PartialOrd
    + core::ops::Add<Output = Self>
    + core::ops::Sub<Output = Self>
    + core::ops::Mul<Output = Self>
    + core::ops::Div<Output = Self>
    + core::ops::Neg<Output = Self>
    + core::fmt::Debug
    + crate::sealed::Sealed
{
    /// Distance of 1 to the next larger number.
    const EPSILON: Self;
    /// The value nearest to a constant.
    fn from_f64(value: f64) -> Self;
    /// The same number in double precision.
    fn to_f64(self) -> f64;
    /// The number rounded to single precision.
    fn to_f32(self) -> f32;
    /// The value nearest to a count, without double precision for `f32`.
    fn from_count(count: u32) -> Self;
    /// Neither NaN nor infinite.
    fn is_finite(self) -> bool;
    /// Sine and cosine by `libm`, correct to 1 ulp. For `f32` this computes in double precision.
    fn sin_cos(self) -> (Self, Self);
    /// Square root by `libm`, correctly rounded.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Cube root of a number that is not negative, to 3 ulp (test `cube_roots_are_right`); zero below the smallest normal number. No double precision
    /// for `f32`.
    #[must_use]
    fn cbrt(self) -> Self;
}

impl Real for f32 {
    const EPSILON: Self = Self::EPSILON;
    fn to_f32(self) -> f32 {
        self
    }
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    fn is_finite(self) -> bool {
        self.is_finite()
    }
    fn from_f64(value: f64) -> Self {
        value as Self
    }
    fn from_count(count: u32) -> Self {
        count as Self
    }
    fn sin_cos(self) -> (Self, Self) {
        libm::sincosf(self)
    }
    fn sqrt(self) -> Self {
        libm::sqrtf(self)
    }
    fn cbrt(self) -> Self {
        if self < Self::MIN_POSITIVE {
            return 0.0;
        }
        // A third of the exponent gives five bits; each step of Halley's iteration triples them. `libm::cbrtf` computes its steps in double
        // precision.
        let mut root = Self::from_bits(self.to_bits() / 3 + 709_958_130);
        for _ in 0..2 {
            let off = self / (root * root * root);
            root = root * (1.0 + 2.0 * off) / (2.0 + off);
        }
        root
    }
}

impl Real for f64 {
    const EPSILON: Self = Self::EPSILON;
    fn to_f32(self) -> f32 {
        self as f32
    }
    fn to_f64(self) -> f64 {
        self
    }
    fn is_finite(self) -> bool {
        self.is_finite()
    }
    fn from_f64(value: f64) -> Self {
        value
    }
    fn from_count(count: u32) -> Self {
        f64::from(count)
    }
    fn sin_cos(self) -> (Self, Self) {
        libm::sincos(self)
    }
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
    fn cbrt(self) -> Self {
        libm::cbrt(self)
    }
}

pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

pub(crate) fn sqrt(x: f64) -> f64 {
    libm::sqrt(x)
}

pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

pub(crate) fn asin(x: f64) -> f64 {
    libm::asin(x)
}

pub(crate) fn acos(x: f64) -> f64 {
    libm::acos(x)
}

pub(crate) fn exp(x: f64) -> f64 {
    libm::exp(x)
}

pub(crate) fn ln(x: f64) -> f64 {
    libm::log(x)
}

pub(crate) fn log2(x: f64) -> f64 {
    libm::log2(x)
}

pub(crate) fn exp2(x: f64) -> f64 {
    libm::exp2(x)
}

pub(crate) fn pow(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

pub(crate) fn floor(x: f64) -> f64 {
    libm::floor(x)
}

/// The nearest integer, halves away from zero.
pub(crate) fn round(x: f64) -> f64 {
    libm::round(x)
}

/// The nearest integer, halves to even.
pub(crate) fn rint(x: f64) -> f64 {
    libm::rint(x)
}

pub(crate) fn abs(x: f64) -> f64 {
    libm::fabs(x)
}

/// sgn x, with sgn 0 = 0.
pub(crate) fn sign(x: f64) -> f64 {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        0.0
    }
}
