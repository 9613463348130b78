//! The angle of the drive link as a binary fraction of its range.

use crate::number::error::RangeError;
use core::f64::consts::TAU;
use core::num::NonZeroU32;
use core::ops::{Add, Sub};

use crate::math::{self, Real};
use crate::number::error::finite;

/// A position in the drive link's range as a fraction of 2³²: one turn for a rotating link, the stroke for a sliding one.
///
/// Wrapping is free (integer overflow); the high part selects the table cell, the low part interpolates. Resolution: 2⁻³² of the range (1.5e-9 rad of
/// a turn).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Phase(u32);

impl Phase {
    /// From the raw fraction, in units of 2⁻³² of the range.
    #[must_use]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The raw fraction, in units of 2⁻³² of the range.
    #[must_use]
    pub const fn to_bits(self) -> u32 {
        self.0
    }

    /// From an encoder count with `per_turn` counts per turn (or stroke). Whole turns cancel exactly, and no error accumulates: the result is
    /// floor(count·2³²/per_turn) modulo 2³².
    ///
    /// A counter that overflows keeps its angle only if 2³² is a multiple of `per_turn` (a power of two); other counters must wrap at a whole number
    /// of turns.
    #[must_use]
    pub const fn from_counts(count: u32, per_turn: NonZeroU32) -> Self {
        let within = count % per_turn.get();
        // within < per_turn, so that the quotient is below 2³².
        Self((((within as u64) << 32) / per_turn.get() as u64) as u32)
    }

    /// From an angle in radians, wrapped to one turn. Accuracy: half a unit of 2⁻³² turn for |φ| ≤ 2π (test `radians_round_to_half_a_unit`). NaN
    /// gives phase 0.
    #[must_use]
    pub fn from_radians(phi: f64) -> Self {
        let turns = phi / TAU;
        let fraction = turns - math::floor(turns);
        // `as` saturates; 2³² itself (from rounding up) wraps to 0.
        Self((fraction * 4_294_967_296.0 + 0.5) as u64 as u32)
    }

    /// From an angle in radians in single precision, without double-precision code. Accuracy: 6e-8 of a turn for |φ| ≤ 2π (test
    /// `single_precision_radians_keep_their_promise`). The phase is 0 for NaN and beyond ±6e8 rad, where single precision no longer distinguishes
    /// turns.
    #[must_use]
    pub fn from_radians_f32(phi: f32) -> Self {
        const TURNS_PER_RADIAN: f32 = core::f32::consts::FRAC_1_PI * 0.5;
        let turns = phi * TURNS_PER_RADIAN;
        if !(turns > -1.0e8 && turns < 1.0e8) {
            return Self(0);
        }
        // The difference is exact, in (−1, 1); the remainder of 1/2π amounts to 4e-8 of a turn at 2π.
        let fraction = turns - (turns as i32) as f32 + phi * 6.420_638e-9;
        Self((fraction * 4_294_967_296.0) as i64 as u32)
    }

    /// The angle in radians, in [0, 2π).
    #[must_use]
    pub fn radians(self) -> f64 {
        f64::from(self.0) * (TAU / 4_294_967_296.0)
    }

    /// The cell of a table with `cells` cells, and the place in it as a fraction of 2³².
    ///
    /// One long multiplication (two short ones on a Cortex-M0); any number of cells up to 65535.
    #[must_use]
    #[inline(always)]
    pub fn cell(self, cells: u32) -> (u32, u32) {
        cell(self.0, cells)
    }
}

/// Index of the cell, and the place in it as a fraction of 2³²; for up to 65535 cells.
#[inline(always)]
pub(crate) fn cell(phase: u32, cells: u32) -> (u32, u32) {
    if cfg!(short_multiply) {
        cell_by_halves(phase, cells)
    } else {
        let product = u64::from(phase) * u64::from(cells);
        ((product >> 32) as u32, product as u32)
    }
}

/// As `cell`; only the upper half of the place is valid.
#[inline(always)]
pub(crate) fn cell_short(phase: u32, cells: u32) -> (u32, u32) {
    if cfg!(short_multiply) {
        let [upper, _] = products(phase, cells);
        (upper >> 16, upper << 16)
    } else {
        let product = u64::from(phase) * u64::from(cells);
        ((product >> 32) as u32, product as u32)
    }
}

fn cell_by_halves(phase: u32, cells: u32) -> (u32, u32) {
    let [upper, low] = products(phase, cells);
    (upper >> 16, upper << 16 | low & 0xffff)
}

/// phase·cells/2¹⁶, and the lower half of phase times cells.
#[inline(always)]
fn products(phase: u32, cells: u32) -> [u32; 2] {
    let low = (phase & 0xffff).wrapping_mul(cells);
    [
        (phase >> 16).wrapping_mul(cells).wrapping_add(low >> 16),
        low,
    ]
}

/// Wraps at a full turn.
impl Add for Phase {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

/// Wraps at a full turn.
impl Sub for Phase {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }
}

/// The range of the drive link; `f64` for mechanisms, `f32` in table images.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Domain<R = f64> {
    /// A link that turns fully, φ in radians; every curve is periodic.
    Turn,
    /// A stroke from `from` to `to`: metres for a sliding link, radians for one that swings. Positions outside are clamped to the ends.
    Stroke {
        /// Start of the stroke.
        from: R,
        /// End of the stroke, greater than `from`.
        to: R,
    },
}

impl Domain<f64> {
    /// A checked stroke.
    ///
    /// # Errors
    /// An end that is not finite, or `to` not greater than `from`.
    pub fn stroke(from: f64, to: f64) -> Result<Self, RangeError> {
        let from = finite("start of the stroke", from)?;
        let to = finite("end of the stroke", to)?;
        crate::number::error::positive("length of the stroke", to - from)?;
        Ok(Self::Stroke { from, to })
    }

    /// The phase of a position: wrapped for a turn, clamped for a stroke.
    #[must_use]
    pub fn phase(self, position: f64) -> Phase {
        match self {
            Self::Turn => Phase::from_radians(position),
            // `as` saturates at both ends, so it clamps.
            Self::Stroke { from, to } => {
                Phase(((position - from) / (to - from) * 4_294_967_296.0) as u32)
            }
        }
    }

    /// The position at a fraction (0 to 1) of the range.
    #[must_use]
    pub fn position(self, fraction: f64) -> f64 {
        match self {
            Self::Turn => fraction * TAU,
            Self::Stroke { from, to } => from + fraction * (to - from),
        }
    }
}

impl<R: Real> Domain<R> {
    /// Length of the range: 2π or the stroke.
    #[must_use]
    pub fn span(self) -> R {
        match self {
            Self::Turn => R::from_f64(TAU),
            Self::Stroke { from, to } => to - from,
        }
    }

    /// The same range in another precision: `f32` tables and images store it in single precision.
    #[must_use]
    pub fn to<T: Real>(self) -> Domain<T> {
        match self {
            Self::Turn => Domain::Turn,
            Self::Stroke { from, to } => Domain::Stroke {
                from: T::from_f64(from.to_f64()),
                to: T::from_f64(to.to_f64()),
            },
        }
    }
}

impl Domain<f32> {
    /// The phase of a position: wrapped for a turn, clamped for a stroke. No double precision.
    #[must_use]
    pub fn phase(self, position: f32) -> Phase {
        match self {
            Self::Turn => Phase::from_radians_f32(position),
            Self::Stroke { from, to } => {
                Phase(((position - from) / (to - from) * 4_294_967_296.0) as u32)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{cell_by_halves, products};

    #[test]
    fn halves_give_the_cell_of_the_long_product() {
        for cells in [1, 2, 4, 100, 255, 256, 1000, 32_768, 65_535] {
            for phase in (0..70_000u32).map(|k| k.wrapping_mul(61_357)).chain([
                u32::MAX,
                0xffff,
                0x1_0000,
                0xffff_0000,
            ]) {
                let long = u64::from(phase) * u64::from(cells);
                let expected = ((long >> 32) as u32, long as u32);
                assert_eq!(cell_by_halves(phase, cells), expected);
                assert_eq!(u64::from(products(phase, cells)[0]), long >> 16);
            }
        }
    }
}
