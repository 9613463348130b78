//! Fixed point: per-unit numbers in [−1, 1) with 31 fractional bits.
//!
//! Formats: control points and coefficients of a cell are Q31; u is an unsigned Q32; products are formed in 64
//! bits and shifted back by 31 (or 32 for u), rounding towards −∞, so each product is low by at most one unit of
//! 2⁻³¹. Sums of products stay in 64 bits (Q31) and are limited once, at the end. Nothing wraps: what could
//! overflow inside a cell is refused when the table is built (`cell_is_sound`).

use core::num::NonZeroU64;

use crate::scalar::{Kernel, Outcome, Scalar};
use crate::{Domain, Scale};

/// A per-unit number in [−1, 1): an `i32` in units of 2⁻³¹.
///
/// What 1 stands for is said by the [`Scale`] of the model it is used with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Q31(i32);

impl Q31 {
    /// The largest number, 1 − 2⁻³¹.
    pub const MAX: Self = Self(i32::MAX);
    /// The smallest number, −1.
    pub const MIN: Self = Self(i32::MIN);

    /// From the raw integer, in units of 2⁻³¹.
    #[must_use]
    pub const fn from_bits(bits: i32) -> Self {
        Self(bits)
    }

    /// The raw integer, in units of 2⁻³¹.
    #[must_use]
    pub const fn to_bits(self) -> i32 {
        self.0
    }
}

/// mantissa · 2^−shift, mantissa in Q31 units, 1 ≤ shift ≤ 62.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Factor {
    mantissa: i32,
    shift: u32,
}

impl Factor {
    /// From a positive single-precision number: its 24-bit significand is taken over exactly. Below 2⁻³² no product with
    /// a number in [−1, 1) reaches one unit: the factor is zero.
    fn from_f32(value: f32) -> Option<Self> {
        if !(value > 0.0 && value < 1.0e30) {
            return None;
        }
        if value < 1.0 / 4_294_967_296.0 {
            return Some(Self {
                mantissa: 0,
                shift: 62,
            });
        }
        let bits = value.to_bits();
        let exponent = (bits >> 23) as i32 - 127; // value = 1.xxx · 2^exponent, for normal numbers
        let mantissa = ((bits & 0x007F_FFFF) | 0x0080_0000) << 7; // 1.xxx · 2³⁰
        let shift = 30 - exponent;
        (1..=62).contains(&shift).then_some(Self {
            mantissa: mantissa as i32,
            shift: shift as u32,
        })
    }
}

impl Scalar for Q31 {
    const NAME: &'static str = "q31";
}

impl Kernel for Q31 {
    type Word = i32;
    type Wide = i64;
    type Factor = Factor;
    type Span = f32;
    type Fraction = u32;
    const CODE: Option<u8> = Some(2);

    fn from_word(word: i32) -> Self {
        Self(word)
    }
    fn to_word(self) -> i32 {
        self.0
    }
    fn from_f64(value: f64) -> Option<Self> {
        let scaled = libm::rint(value * 2_147_483_648.0);
        (-2_147_483_648.0..2_147_483_648.0)
            .contains(&scaled)
            .then_some(Self(scaled as i32))
    }
    fn to_f64(self) -> f64 {
        f64::from(self.0) * (1.0 / 2_147_483_648.0)
    }
    fn per_unit(value: f32, base: f32) -> Outcome<Self> {
        let scaled = value / base * 2_147_483_648.0;
        Outcome {
            value: Self(scaled as i32), // `as` saturates
            saturated: !(-2_147_483_648.0..2_147_483_648.0).contains(&scaled),
        }
    }
    fn si(self, base: f32) -> f32 {
        self.0 as f32 * (1.0 / 2_147_483_648.0) * base
    }
    fn span(domain: Domain) -> f32 {
        domain.to_f32().span()
    }
    fn span_f32(domain: Domain<f32>) -> f32 {
        domain.span()
    }
    fn velocity_factor(cells: u32, span: f32, scale: &Scale) -> Option<Factor> {
        Factor::from_f32(f32::velocity_factor(cells, span, scale)?)
    }
    #[inline]
    fn fraction(bits: u32) -> u32 {
        bits
    }
    #[inline]
    fn cubic([c0, c1, c2, c3]: [Self; 4]) -> [Self; 4] {
        // Sound cells do not overflow (`cell_is_sound`); wrapping only keeps the panic path out.
        let (c0, c1, c2, c3) = (c0.0, c1.0, c2.0, c3.0);
        let three = |x: i32| x.wrapping_add(x).wrapping_add(x);
        [
            Self(c0.wrapping_add(c1.wrapping_shl(2)).wrapping_add(c2)),
            Self(three(c2.wrapping_sub(c0))),
            Self(three(c0.wrapping_sub(c1.wrapping_shl(1)).wrapping_add(c2))),
            Self(c3.wrapping_sub(c0).wrapping_add(three(c1.wrapping_sub(c2)))),
        ]
    }
    #[inline]
    fn value([p0, p1, p2, p3]: [Self; 4], u: u32) -> Self {
        let inner = part(p3.0, u).wrapping_add(p2.0);
        let middle = part(inner, u).wrapping_add(p1.0);
        Self(part(middle, u).wrapping_add(p0.0))
    }
    #[inline]
    fn slope([_, p1, p2, p3]: [Self; 4], u: u32) -> Self {
        let three_p3 = p3.0.wrapping_add(p3.0).wrapping_add(p3.0);
        let inner = part(three_p3, u).wrapping_add(p2.0.wrapping_shl(1));
        Self(part(inner, u).wrapping_add(p1.0))
    }
    fn cell_is_sound(points: [Self; 4]) -> bool {
        let [c0, c1, c2, c3] = points.map(|c| i64::from(c.0));
        let p0 = c0 + 4 * c1 + c2;
        let p1 = 3 * (c2 - c0);
        let p2 = 3 * (c0 - 2 * c1 + c2);
        let p3 = (c3 - c0) + 3 * (c1 - c2);
        let limit = i64::from(i32::MAX) - 8; // room for the roundings
        let horner = p1.abs() + p2.abs() + p3.abs();
        // Sums that wrap on the way to a coefficient come back, so only the coefficients and the Horner steps
        // count: the value by its hull, the other steps by the sum of their parts.
        horner <= limit
            && p1.abs() + 2 * p2.abs() + 3 * p3.abs() <= limit
            && bezier([p0, p1, p2, p3])
                .iter()
                .all(|b| b.abs() <= 3 * limit)
    }
    fn factor_fits(slope: f32, factor: Factor) -> bool {
        let (high, low) = (factor.shift / 2, factor.shift - factor.shift / 2);
        let factor = factor.mantissa as f32 / (1u64 << high) as f32 / (1u64 << low) as f32;
        (slope.abs() + SLOPE_ROUNDINGS) * factor < 0.999_999
    }
    fn to_wide_f32(self) -> f32 {
        self.0 as f32 * (1.0 / 2_147_483_648.0)
    }
    #[inline]
    fn wide(self) -> i64 {
        i64::from(self.0)
    }
    #[inline]
    fn times(self, other: Self) -> i64 {
        (i64::from(self.0) * i64::from(other.0)) >> 31
    }
    #[inline]
    fn scaled(self, factor: Factor) -> Self {
        // `factor_fits` was checked for every slope of the table.
        let product = i64::from(self.0) * i64::from(factor.mantissa);
        Self((product >> (factor.shift & 63)) as i32)
    }
    #[inline]
    fn signed_like(self, other: Self) -> i64 {
        self.wide() * i64::from(other.0.signum())
    }
    #[inline]
    fn narrow(wide: i64) -> Outcome<Self> {
        let limited = wide.clamp(i64::from(i32::MIN), i64::from(i32::MAX));
        Outcome {
            value: Self(limited as i32),
            saturated: limited != wide,
        }
    }
    fn quotient(wide: i64, divisor: Self) -> Outcome<Self> {
        let magnitude = wide.unsigned_abs();
        let divisor =
            NonZeroU64::new(u64::from(divisor.0.unsigned_abs())).unwrap_or(NonZeroU64::MIN);
        if magnitude >= divisor.get() {
            // |quotient| ≥ 1: outside the range (−1 itself is given as saturated, too).
            let value = if wide < 0 { Self::MIN } else { Self::MAX };
            return Outcome {
                value,
                saturated: true,
            };
        }
        let quotient = ((magnitude << 31) / divisor) as i32; // below 2³¹
        Outcome {
            value: Self(if wide < 0 { -quotient } else { quotient }),
            saturated: false,
        }
    }
}

/// The tick's own slope may differ from the exact one by a few units: its roundings.
const SLOPE_ROUNDINGS: f32 = 8.0 / 2_147_483_648.0;

/// x·u for u in [0, 1), rounded towards −∞.
#[inline]
fn part(x: i32, u: u32) -> i32 {
    ((i64::from(x) * i64::from(u)) >> 32) as i32
}

/// Three times the Bézier points of a cubic.
fn bezier([p0, p1, p2, p3]: [i64; 4]) -> [i64; 4] {
    [
        3 * p0,
        3 * p0 + p1,
        3 * p0 + 2 * p1 + p2,
        3 * (p0 + p1 + p2 + p3),
    ]
}
