//! Fixed point with 16-bit tables.

use crate::math;
use crate::number::{Factor, Number, Outcome};
use crate::{Acceleration, MotorTorque, Q31, Speed, Torque};

/// A per-unit number in [−1, 1): an `i16` in units of 2⁻¹⁵, for tables of [`Rows16`](crate::curve::Rows16).
///
/// The [`Scale`](crate::Scale) of its model defines 1. Conversions round to the nearest number, halves away from zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Q15(i16);

/// 1 in units of the last place.
const UNIT: f32 = 32_768.0;

impl Q15 {
    /// The largest number, 1 − 2⁻¹⁵.
    pub const MAX: Self = Self(i16::MAX);
    /// The smallest number, −1.
    pub const MIN: Self = Self(i16::MIN);

    /// From the raw integer, in units of 2⁻¹⁵.
    #[must_use]
    #[inline]
    pub const fn from_bits(bits: i16) -> Self {
        Self(bits)
    }

    /// The raw integer, in units of 2⁻¹⁵.
    #[must_use]
    #[inline]
    pub const fn to_bits(self) -> i16 {
        self.0
    }
}

impl Number for Q15 {
    type Real = f32;
    type Word = i16;
    type Speed = Speed<Self>;
    type Acceleration = Acceleration<Self>;
    type Torque = Torque<Self>;
    type MotorTorque = MotorTorque<Self>;
    const NAME: &'static str = "i16";
    const FIXED: bool = true;

    fn from_f64(value: f64) -> Option<Self> {
        let nearest = math::round(value * f64::from(UNIT));
        let fits = (f64::from(i16::MIN)..=f64::from(i16::MAX)).contains(&nearest);
        fits.then_some(Self(nearest as i16))
    }

    fn to_f64(self) -> f64 {
        f64::from(self.0) / f64::from(UNIT)
    }

    fn per_unit(value: f32, base: f32) -> Outcome<Self> {
        let scaled = value / base * UNIT;
        // Adding half a unit and truncating rounds to the nearest. `as` saturates, and gives 0 for NaN.
        let nearest = (scaled + if scaled < 0.0 { -0.5 } else { 0.5 }) as i32;
        let limited = nearest.clamp(i32::from(i16::MIN), i32::from(i16::MAX));
        Outcome {
            value: Self(limited as i16),
            saturated: limited != nearest || scaled.is_nan(),
        }
    }

    fn si(self, base: f32) -> f32 {
        f32::from(self.0) * (1.0 / UNIT) * base
    }

    #[inline(always)]
    fn of_count(count: i32, factor: &Factor) -> Outcome<Self> {
        Q31::of_count(count, factor).into()
    }

    #[inline(always)]
    fn of_counts(counts: [(i32, &Factor); 2]) -> Outcome<Self> {
        Q31::of_counts(counts).into()
    }

    #[inline(always)]
    fn to_count(self, factor: &Factor) -> i32 {
        Q31::from(self).to_count(factor)
    }

    #[inline(always)]
    fn times(self, factor: &Factor) -> Outcome<Self> {
        let Outcome { value, saturated } = Q31::from(self).times(factor);
        // Rounded to the nearest, because repeated rounding down would make a motion fall a little each tick.
        let rounded = value.to_bits().saturating_add(1 << 15) >> 16;
        Outcome {
            value: Self(rounded as i16),
            saturated,
        }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Outcome<Self> {
        Q31::from(self).plus(other.into()).into()
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Outcome<Self> {
        Q31::from(self).minus(other.into()).into()
    }

    #[inline(always)]
    fn mean(self, other: Self) -> Self {
        Self(self.0.midpoint(other.0))
    }
    #[inline(always)]
    fn least(self) -> Self {
        Self(self.0.signum())
    }
    #[inline(always)]
    fn exceeds(self, limit: Self) -> bool {
        self.0.unsigned_abs() > limit.0.unsigned_abs()
    }
}

/// The same number.
impl From<Q15> for Q31 {
    #[inline(always)]
    fn from(short: Q15) -> Self {
        Self::from_bits(i32::from(short.0) << 16)
    }
}

/// Rounded down.
impl From<Outcome<Q31>> for Outcome<Q15> {
    #[inline(always)]
    fn from(long: Outcome<Q31>) -> Self {
        Self {
            value: Q15((long.value.to_bits() >> 16) as i16),
            saturated: long.saturated,
        }
    }
}
