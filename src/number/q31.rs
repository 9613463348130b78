//! Fixed point with 32-bit tables.

use core::num::Wrapping;

use super::kernel::{Kernel, Ring};
use super::product::{high, high_short};
use super::quotient::quotient;
use super::{Factor, Number, Outcome, Role, Scalar, Scale};
use crate::math;
use crate::{Acceleration, MotorTorque, Speed, Torque};

/// A per-unit number in [−1, 1): an `i32` in units of 2⁻³¹.
///
/// The [`Scale`] of its model defines 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
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

impl Ring for Wrapping<i32> {
    #[inline(always)]
    fn times(self, factor: i8) -> Self {
        self * Self(i32::from(factor))
    }
    #[inline(always)]
    fn whole(number: u16) -> Self {
        Self(i32::from(number))
    }
}

impl Ring for i64 {
    #[inline(always)]
    fn times(self, factor: i8) -> Self {
        self * Self::from(factor)
    }
    #[inline(always)]
    fn whole(number: u16) -> Self {
        Self::from(number)
    }
}

impl Scalar for Q31 {}

/// 2 to the power of the number of fraction bits of a raw value with this role.
const fn unit(role: Role) -> f64 {
    match role {
        Role::Inertia | Role::Viscous => 1_073_741_824.0,
        Role::Load | Role::Coulomb => 536_870_912.0,
        Role::Reciprocal => 2_147_483_648.0,
    }
}

impl Number for Q31 {
    type Real = f32;
    type Word = i32;
    type Speed = Speed<Self>;
    type Acceleration = Acceleration<Self>;
    type Torque = Torque<Self>;
    type MotorTorque = MotorTorque<Self>;
    const NAME: &'static str = "i32";
    const FIXED: bool = true;

    fn from_f64(value: f64) -> Option<Self> {
        Self::word(Role::Reciprocal, value).map(Self)
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
    #[inline(always)]
    fn of_count(count: i32, factor: &Factor) -> Outcome<Self> {
        Self(count).times(factor)
    }
    #[inline(always)]
    fn to_count(self, factor: &Factor) -> i32 {
        factor.times(self.0).0
    }
    #[inline(always)]
    fn times(self, factor: &Factor) -> Outcome<Self> {
        let (value, saturated) = factor.times(self.0);
        Outcome {
            value: Self(value),
            saturated,
        }
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Outcome<Self> {
        let value = self.0.saturating_add(other.0);
        Outcome {
            value: Self(value),
            saturated: value != self.0.wrapping_add(other.0),
        }
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Outcome<Self> {
        let value = self.0.saturating_sub(other.0);
        Outcome {
            value: Self(value),
            saturated: value != self.0.wrapping_sub(other.0),
        }
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

impl Kernel for Q31 {
    type Raw = Wrapping<i32>;
    type Wide = i64;
    type Factor = i32;
    type Reciprocal = Reciprocal;
    type Fraction = i32; // Q31 from 0 to 1; in rows Q32 from −½ to ½
    const CODE: Option<u8> = Some(2);
    const STEP: i8 = 2;
    const ROW_CENTRE: f64 = 0.5;
    #[inline(always)]
    fn raw(word: i32) -> Self::Raw {
        Wrapping(word)
    }
    fn word(role: Role, coefficient: f64) -> Option<i32> {
        let scaled = math::rint(coefficient * unit(role));
        (-2_147_483_648.0..2_147_483_648.0)
            .contains(&scaled)
            .then_some(scaled as i32)
    }
    fn widen(raw: Self::Raw) -> i64 {
        i64::from(raw.0)
    }
    fn approximate(role: Role, wide: i64) -> f32 {
        wide as f32 / unit(role) as f32
    }
    fn exact(role: Role, raw: Self::Raw) -> f64 {
        f64::from(raw.0) / unit(role)
    }
    fn is_sound(coefficients: [i64; 4]) -> bool {
        // Every step of a value or slope stays below this sum; each floor adds less than 1.
        let [p0, p1, p2, p3] = coefficients.map(i64::abs);
        let limit = i64::from(i32::MAX) - 8;
        p1 + p2 + p3 <= limit && p0 + (p1 + p2 + p3) / 2 <= limit
    }
    fn velocity_factor(cells: u32, span: f32, scale: &Scale, step: i8) -> Option<i32> {
        whole(f32::velocity_factor(cells, span, scale, step)? * 2.0 / f32::from(step))
    }
    #[inline(always)]
    fn locate(phase: u32, cells: u32) -> (u32, i32) {
        let (cell, fraction) = crate::number::phase::cell(phase, cells);
        (cell, (fraction >> 1) as i32)
    }
    #[inline(always)]
    fn locate_row(phase: u32, cells: u32) -> (u32, i32) {
        let (cell, fraction) = crate::number::phase::cell(phase, cells);
        (cell, (fraction ^ 0x8000_0000) as i32)
    }
    #[inline(always)]
    fn locate_row_short(phase: u32, cells: u32) -> (u32, i32) {
        let (cell, fraction) = crate::number::phase::cell_short(phase, cells);
        (cell, (fraction ^ 0x8000_0000) as i32)
    }
    #[inline(always)]
    fn step(x: Self::Raw, u: i32) -> Self::Raw {
        Wrapping(high(x.0, u))
    }
    #[inline(always)]
    fn row_step_short(x: Self::Raw, u: i32) -> Self::Raw {
        Wrapping(high_short(x.0, u))
    }
    #[inline(always)]
    fn velocity(slope: Self::Raw, factor: i32, omega: Self) -> Self::Raw {
        // The slope is Q30 times `step`; the factor converts it to 31 fraction bits. The product fits, as `Model::new` ensured.
        Wrapping(high(slope.0.wrapping_mul(factor), omega.0))
    }
    #[inline(always)]
    fn product(a: Self::Raw, b: Self) -> Self::Raw {
        Wrapping(high(a.0, b.0))
    }
    #[inline(always)]
    fn add_signed(sum: Self::Raw, c: Self::Raw, omega: Self) -> Self::Raw {
        // The sign of c·ω decides the sign of the term.
        let c = if (c.0 ^ omega.0) < 0 { -c } else { c };
        if omega.0 == 0 { sum } else { sum + c }
    }
    #[inline(always)]
    fn add_share(sum: Self::Raw, c: Self::Raw, share: Self) -> Self::Raw {
        sum + Wrapping(high(c.0.wrapping_abs(), share.0) << 1)
    }
    #[inline(always)]
    fn torque(sum: Self::Raw) -> Self {
        Self(sum.0.wrapping_shl(2))
    }
    fn quotient(torque: Self, resisting: Self::Raw, inertia: Self::Raw) -> Outcome<Self> {
        let net = i64::from(torque.0) - (i64::from(resisting.0) << 2); // Q31
        let magnitude = net.unsigned_abs();
        let divisor = inertia.0.unsigned_abs() << 1;
        if magnitude >= u64::from(divisor) {
            // |quotient| ≥ 1: outside the range (−1 itself counts as saturated, too).
            return Outcome {
                value: if net < 0 { Self::MIN } else { Self::MAX },
                saturated: true,
            };
        }
        let quotient = quotient(magnitude as u32, divisor) as i32; // below 2³¹
        Outcome {
            value: Self(if net < 0 { -quotient } else { quotient }),
            saturated: false,
        }
    }
    fn reciprocal_of(inertia: Self::Raw, seed: Self::Raw) -> Option<(Reciprocal, f32)> {
        // J·ρ is a power of two, 2⁻ᵐ of the inertia base, except for the seed's error.
        let product = high(inertia.0, seed.0); // Q29
        let nearest = (u32::try_from(product).ok()? + product as u32 / 3).checked_ilog2()?;
        let shift = 29u32.checked_sub(nearest)?;
        let error = 1.0 - product as f32 / (1u32 << nearest) as f32;
        let constants = Reciprocal {
            unit: 1i32.checked_shl(28u32.checked_sub(shift)?)?,
            gain: 8i32 << shift.min(24),
        };
        (shift <= 20).then_some((constants, error.abs()))
    }
    fn reciprocal_unit(constants: Reciprocal) -> f32 {
        constants.unit as f32 / 268_435_456.0 // 2²⁸
    }
    #[inline(always)]
    fn by_reciprocal(
        torque: Self,
        resisting: Self::Raw,
        reciprocal: Self::Raw,
        Reciprocal { unit, gain }: Reciprocal,
        inertia: Option<Self::Raw>,
    ) -> Outcome<Self> {
        let net = (torque.0 >> 2).wrapping_sub(resisting.0); // Q29, |net| < 2
        let mut quotient = high(net, reciprocal.0); // Q28 − m
        if let Some(inertia) = inertia {
            // One step of Newton's iteration, ρ ← ρ + ρ·(1 − J·ρ), applied to the quotient: its error is squared.
            let error = (unit << 1).wrapping_sub(high(inertia.0, reciprocal.0)); // Q29 + m
            quotient = quotient.wrapping_add(high(quotient, error.wrapping_mul(gain))); // Q32
        }
        if (quotient.wrapping_add(unit) as u32) < (unit as u32) << 1 {
            Outcome {
                value: Self(quotient.wrapping_mul(gain)),
                saturated: false,
            }
        } else {
            Outcome {
                value: if quotient < 0 { Self::MIN } else { Self::MAX },
                saturated: true,
            }
        }
    }
}

/// Constants that convert a torque and the seed of 1/J to an acceleration, in units of 2⁻ᵐ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reciprocal {
    /// 2²⁸⁻ᵐ
    unit: i32,
    /// 2³⁺ᵐ
    gain: i32,
}

/// The integer value of a factor, except for the rounding of its three bases.
pub(super) fn whole(factor: f32) -> Option<i32> {
    const ROUNDING: f32 = 1e-6;
    let nearest = (factor + 0.5) as i32;
    let off = (factor - nearest as f32).abs();
    (nearest > 0 && factor < 1e6 && off <= ROUNDING * factor).then_some(nearest)
}

#[cfg(test)]
mod tests {
    use super::{Kernel as _, Q31};

    /// Every step of (c₃·u + c₂)·u + c₁ and of p₀ + …·u stays within 32 bits for u from −½ to ½ and 0 to 1: up to the limit, for any split among the
    /// three coefficients and with either sign, and not one unit beyond it.
    #[test]
    fn a_cell_is_sound_up_to_the_limit() {
        let limit = i64::from(i32::MAX) - 8;
        let third = limit / 3;
        for slopes in [
            [limit, 0, 0],
            [0, limit, 0],
            [0, 0, limit],
            [third, third, limit - 2 * third],
            [1, limit - 3, 2],
        ] {
            for sign in [1, -1] {
                let [p1, p2, p3] = slopes.map(|p| sign * p);
                let constant = limit - limit / 2;
                for p0 in [constant, -constant] {
                    assert!(Q31::is_sound([p0, p1, p2, p3]), "{p0} {slopes:?}");
                    let more = p0 + p0.signum();
                    assert!(!Q31::is_sound([more, p1, p2, p3]), "{p0} {slopes:?}");
                }
                assert!(Q31::is_sound([0, p1, p2, p3]), "{slopes:?}");
                let more = |p: i64| if p < 0 { p - 1 } else { p + 1 };
                for beyond in [[more(p1), p2, p3], [p1, more(p2), p3], [p1, p2, more(p3)]] {
                    let [p1, p2, p3] = beyond;
                    assert!(!Q31::is_sound([0, p1, p2, p3]), "{beyond:?}");
                }
            }
        }
        assert!(Q31::is_sound([-limit, 1, 0, 0]) && !Q31::is_sound([limit, 0, 2, 0]));
    }
}
