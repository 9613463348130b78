//! The arithmetic of polynomials and of the equation of motion, for each number type.

use core::fmt;
use core::ops::{Add, Mul, Sub};

use super::{FrictionSign, Number, Outcome, Quantity as _, Role, Scale};

/// Numbers for the coefficients of a cell.
pub trait Ring:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// A small multiple.
    fn times(self, factor: i8) -> Self;
    /// An integer.
    fn whole(number: u16) -> Self;
}

/// The arithmetic of a tick. Not nameable outside the crate: it may change with every release.
///
/// A curve is evaluated in [`Raw`](Self::Raw) numbers, in a format given by its [`Role`] (for the fixed-point types see the table in
/// [`number`](super)). In floating point every format is the plain number.
pub trait Kernel: Number {
    /// Numbers for the evaluation of polynomials and for sums of torques.
    type Raw: Ring;
    /// As `Raw`, but wide enough that no check overflows.
    type Wide: Ring;
    /// A multiplier for slopes, of any magnitude.
    type Factor: Copy + fmt::Debug + PartialEq;
    /// Constants of forward dynamics without a division.
    type Reciprocal: Copy + Default + fmt::Debug + PartialEq;
    /// A place within a cell, 0 to 1.
    type Fraction: Copy;
    /// Code in the image header; `None`: not stored in images.
    const CODE: Option<u8>;
    /// Divisor of [`step`](Self::step).
    const STEP: i8;
    /// The centre of row polynomials in a cell.
    const ROW_CENTRE: f64;

    fn raw(word: Self::Word) -> Self::Raw;
    /// The nearest word for a coefficient in machine units, if it is in range.
    fn word(role: Role, coefficient: f64) -> Option<Self::Word>;
    fn widen(raw: Self::Raw) -> Self::Wide;
    /// A coefficient or sum in machine units, in single precision: for checks without double precision in firmware.
    fn approximate(role: Role, wide: Self::Wide) -> f32;
    /// A coefficient in machine units.
    fn exact(role: Role, raw: Self::Raw) -> f64;
    /// Whether a cell can be evaluated anywhere without overflow, NaN or infinity.
    fn is_sound(coefficients: [Self::Wide; 4]) -> bool;

    /// ½·cells/span·J_b·ω_b²/T_b: the velocity torque at the speed base is this times dJ/du, for a slope that is stored times `step`.
    fn velocity_factor(
        cells: u32,
        span: Self::Real,
        scale: &Scale,
        step: i8,
    ) -> Option<Self::Factor>;

    /// The cell of a phase, and the place in it.
    fn locate(phase: u32, cells: u32) -> (u32, Self::Fraction);
    /// As `locate`, with the place relative to `ROW_CENTRE`.
    #[inline(always)]
    fn locate_row(phase: u32, cells: u32) -> (u32, Self::Fraction) {
        Self::locate(phase, cells)
    }
    /// As `locate_row`, to 2⁻¹⁶ of a cell.
    #[inline(always)]
    fn locate_row_short(phase: u32, cells: u32) -> (u32, Self::Fraction) {
        Self::locate_row(phase, cells)
    }
    /// x·u/STEP, for a place of `locate`.
    fn step(x: Self::Raw, u: Self::Fraction) -> Self::Raw;
    /// x·u, for a place of `locate_row`.
    #[inline(always)]
    fn row_step(x: Self::Raw, u: Self::Fraction) -> Self::Raw {
        Self::step(x, u)
    }
    /// x·u, for a place of `locate_row_short`.
    #[inline(always)]
    fn row_step_short(x: Self::Raw, u: Self::Fraction) -> Self::Raw {
        Self::row_step(x, u)
    }

    /// ½·J′·ω_b²/T_b·ω from the slope: a coefficient that adds to b.
    fn velocity(slope: Self::Raw, factor: Self::Factor, omega: Self) -> Self::Raw;
    /// a·b: J·α, or (½·J′·ω + b)·ω.
    fn product(a: Self::Raw, b: Self) -> Self::Raw;
    /// sum + a·b
    #[inline(always)]
    fn accumulate(sum: Self::Raw, a: Self::Raw, b: Self) -> Self::Raw {
        sum + Self::product(a, b)
    }
    /// sum + |c|·sgn ω; nothing for ω = 0.
    fn add_signed(sum: Self::Raw, c: Self::Raw, omega: Self) -> Self::Raw;
    /// sum + |c|·share
    fn add_share(sum: Self::Raw, c: Self::Raw, share: Self) -> Self::Raw;
    /// sum plus Coulomb friction.
    #[inline(always)]
    fn add_sliding(sum: Self::Raw, c: Self::Raw, friction: FrictionSign<Self>) -> Self::Raw {
        match friction {
            FrictionSign::OfSpeed(omega) => Self::add_signed(sum, c, omega.number()),
            FrictionSign::Scaled(share) => Self::add_share(sum, c, share),
        }
    }
    /// The sum as a torque. It fits, as `Model::new` ensured.
    fn torque(sum: Self::Raw) -> Self;
    /// (torque − resisting)/J
    fn quotient(torque: Self, resisting: Self::Raw, inertia: Self::Raw) -> Outcome<Self>;
    /// Constants of `by_reciprocal`, from J and J_m/J at one place, and |1 − J·(1/J)|; `None` if the two do not match.
    fn reciprocal_of(inertia: Self::Raw, reciprocal: Self::Raw) -> Option<(Self::Reciprocal, f32)>;
    /// J_m, in machine units.
    fn reciprocal_unit(constants: Self::Reciprocal) -> f32;
    /// As `quotient`, with J_m/J; with one step of Newton's iteration if J is given.
    fn by_reciprocal(
        torque: Self,
        resisting: Self::Raw,
        reciprocal: Self::Raw,
        constants: Self::Reciprocal,
        inertia: Option<Self::Raw>,
    ) -> Outcome<Self>;
}

macro_rules! float {
    ($float:ident, $code:expr) => {
        impl Ring for $float {
            #[inline(always)]
            fn times(self, factor: i8) -> Self {
                self * $float::from(factor)
            }
            #[inline(always)]
            fn whole(number: u16) -> Self {
                $float::from(number)
            }
        }

        impl Kernel for $float {
            type Raw = $float;
            type Wide = $float;
            type Factor = $float;
            type Reciprocal = ();
            type Fraction = $float;
            const CODE: Option<u8> = $code;
            const STEP: i8 = 1;
            const ROW_CENTRE: f64 = 0.0;

            #[inline(always)]
            fn raw(word: $float) -> $float {
                word
            }
            fn word(_: Role, coefficient: f64) -> Option<$float> {
                <Self as Number>::from_f64(coefficient)
            }
            fn widen(raw: $float) -> $float {
                raw
            }
            fn approximate(_: Role, wide: $float) -> f32 {
                wide as f32
            }
            fn exact(_: Role, raw: $float) -> f64 {
                raw as f64
            }
            fn is_sound(coefficients: [$float; 4]) -> bool {
                // Far below the largest number: a sum of a few such products cannot overflow.
                coefficients.iter().all(|c| c.abs() < 1e30)
            }
            fn velocity_factor(cells: u32, span: $float, scale: &Scale, _: i8) -> Option<$float> {
                let bases = scale.velocity_base() as $float;
                let factor = 0.5 * cells as $float / span * bases;
                (factor.is_finite() && factor > 0.0).then_some(factor)
            }
            #[inline(always)]
            fn locate(phase: u32, cells: u32) -> (u32, $float) {
                let (cell, fraction) = crate::number::phase::cell(phase, cells);
                (cell, fraction as $float * (1.0 / 4_294_967_296.0))
            }
            #[inline(always)]
            fn step(x: $float, u: $float) -> $float {
                x * u
            }
            #[inline(always)]
            fn velocity(slope: $float, factor: $float, omega: $float) -> $float {
                slope * factor * omega
            }
            #[inline(always)]
            fn product(a: $float, b: $float) -> $float {
                a * b
            }
            #[inline(always)]
            fn add_signed(sum: $float, c: $float, omega: $float) -> $float {
                if cfg!(soft_float) {
                    // By the bits of ω: with software floating point a comparison is a call.
                    let sign = -0.0 as $float;
                    let bits = omega.to_bits();
                    let not_zero = (bits << 1).wrapping_sub(1) < $float::INFINITY.to_bits() << 1;
                    let c = if not_zero { c.abs().to_bits() } else { 0 };
                    return sum + $float::from_bits(c | bits & sign.to_bits());
                }
                let c = if omega < 0.0 { -c.abs() } else { c.abs() };
                if omega == 0.0 { sum } else { sum + c }
            }
            #[inline(always)]
            fn add_share(sum: $float, c: $float, share: $float) -> $float {
                sum + c.abs() * share
            }
            #[inline(always)]
            fn torque(sum: $float) -> $float {
                sum
            }
            #[inline(always)]
            fn quotient(torque: $float, resisting: $float, inertia: $float) -> Outcome<$float> {
                Outcome {
                    value: (torque - resisting) / inertia,
                    saturated: false,
                }
            }
            fn reciprocal_of(_: $float, _: $float) -> Option<((), f32)> {
                None
            }
            fn reciprocal_unit((): ()) -> f32 {
                1.0
            }
            #[inline(always)]
            fn by_reciprocal(
                torque: $float,
                resisting: $float,
                reciprocal: $float,
                (): (),
                _: Option<$float>,
            ) -> Outcome<$float> {
                // Not reached: `Table::new` refuses a reciprocal in floating point.
                Self::quotient(torque * reciprocal, resisting * reciprocal, 1.0)
            }
        }
    };
}

float!(f32, Some(1));
float!(f64, None);

#[cfg(test)]
mod tests {
    use core::num::Wrapping;

    use super::Kernel as _;
    use crate::Q31;

    /// |c|·sgn ω in floating point and in fixed point, for c with either sign.
    #[test]
    #[allow(clippy::float_cmp, reason = "sums of halves are exact")]
    fn every_speed_but_zero_has_a_sign() {
        for c in [2.5, -2.5] {
            for omega in [1e-45, f32::MIN_POSITIVE, 1.0, f32::MAX] {
                assert_eq!(f32::add_signed(4.0, c, omega), 6.5, "{omega}");
                assert_eq!(f32::add_signed(4.0, c, -omega), 1.5, "{omega}");
            }
            assert_eq!(f32::add_signed(4.0, c, 0.0), 4.0);
            assert_eq!(f32::add_signed(4.0, c, -0.0), 4.0);
            let [sum, c] = [400, (c * 10.0) as i32].map(Wrapping);
            let fixed = |omega| Q31::add_signed(sum, c, Q31::from_bits(omega)).0;
            assert_eq!([1, i32::MAX].map(fixed), [425; 2]);
            assert_eq!([-1, i32::MIN].map(fixed), [375; 2]);
            assert_eq!(fixed(0), 400);
        }
    }
}
