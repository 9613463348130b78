//! Sine and cosine of a binary angle.
//!
//! `libm` and the other crates for single precision take radians: the phase would be rounded to radians and reduced to an octant again, with a number
//! for π of more than single precision (`libm::sinf` uses double precision for that). A binary angle is reduced by integers, exactly. Two short
//! polynomials remain, best approximations by the Remez algorithm on |x| ≤ π/4. They approximate κ·x, where κ − 1 = −2.8e-8 compensates the rounding
//! of 2π in x:
//!
//! ```text
//! sin κx ≈ x + x³·(s₀ + s₁·x² + s₂·x⁴)         |error| ≤ 4.8e-9
//! cos κx ≈ 1 − x²/2 + x⁴·(c₀ + c₁·x² + c₂·x⁴)  |error| ≤ 1.3e-9
//! ```

use crate::Phase;
use crate::math::{self, Real};

/// A number type for the evaluation of harmonics: `f32` or `f64`. Sealed.
pub trait Circular: Real {
    /// 0, ½ and 1.
    const CONSTANTS: [Self; 3];
    /// Eight units of rounding: the allowed error of a coefficient's share of a sum, for every order of its harmonic.
    const ROUNDINGS: Self;

    /// From single precision.
    fn from_single(value: f32) -> Self;

    /// Sine and cosine of a phase of one turn.
    ///
    /// **Accuracy**: 1.05e-7 in `f32`, 2.5e-16 in `f64` (test `sine_and_cosine_keep_their_bounds`). `f32` uses no double precision.
    fn sin_cos_of(phase: Phase) -> (Self, Self);
}

impl Circular for f32 {
    const CONSTANTS: [Self; 3] = [0.0, 0.5, 1.0];
    const ROUNDINGS: Self = 8.0 * Self::EPSILON;

    fn from_single(value: f32) -> Self {
        value
    }

    #[inline]
    fn sin_cos_of(phase: Phase) -> (Self, Self) {
        const RADIANS: f32 = core::f32::consts::TAU / 4_294_967_296.0;
        const S: [f32; 3] = [-0.166_666_83, 0.008_333_045, -0.000_195_920_83];
        const C: [f32; 3] = [0.041_666_914, -0.001_389_496_3, 0.000_025_077_652];
        let (quarter, rest) = octant(phase);
        let x = rest as Self * RADIANS;
        let square = x * x;
        let sin = x + x * square * (S[0] + square * (S[1] + square * S[2]));
        let cos = 1.0 - square * (0.5 - square * (C[0] + square * (C[1] + square * C[2])));
        turn((sin, cos), quarter)
    }
}

impl Circular for f64 {
    const CONSTANTS: [Self; 3] = [0.0, 0.5, 1.0];
    const ROUNDINGS: Self = 8.0 * Self::EPSILON;

    fn from_single(value: f32) -> Self {
        value.into()
    }

    #[inline]
    fn sin_cos_of(phase: Phase) -> (Self, Self) {
        let (quarter, rest) = octant(phase);
        let x = Self::from(rest) * (core::f64::consts::TAU / 4_294_967_296.0);
        turn(math::sin_cos(x), quarter)
    }
}

/// The nearest quarter turn (0 to 3), and the angle from it in units of 2⁻³² turn, within ±2²⁹.
#[inline]
const fn octant(phase: Phase) -> (u32, i32) {
    let bits = phase.to_bits();
    let quarter = bits.wrapping_add(1 << 29) >> 30;
    (quarter, bits.wrapping_sub(quarter << 30) as i32)
}

/// Sine and cosine of an angle, advanced by quarter turns.
#[inline]
fn turn<T: Real>((sin, cos): (T, T), quarter: u32) -> (T, T) {
    let (sin, cos) = if quarter & 1 == 0 {
        (sin, cos)
    } else {
        (cos, -sin)
    };
    if quarter & 2 == 0 {
        (sin, cos)
    } else {
        (-sin, -cos)
    }
}
