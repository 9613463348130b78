//! From an encoder count to the phase of a drive link that turns, without a division in the tick.

use core::num::NonZeroU128;

use super::AxisError;
use crate::Phase;
use crate::number::{signed_words, upper_of_sum};

/// Counting direction of an encoder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Counting {
    /// Up while φ grows.
    #[default]
    Up,
    /// Down while φ grows.
    Down,
}

/// An encoder and its mounting: how a count relates to φ.
///
/// ```text
/// φ/2π = ±(count − homing_offset)/(counts_per_turn·gear)
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Mounting {
    /// Counts per turn of the encoder's shaft; for a quadrature encoder four times its lines.
    pub counts_per_turn: u32,
    /// Turns of the encoder's shaft, and the turns of the drive link that they cause: `[1, 1]` on its own shaft, `[17, 2]` behind a ratio of 8.5.
    pub gear: [u32; 2],
    /// Counting direction.
    pub counting: Counting,
    /// The count at φ = 0.
    pub homing_offset: i64,
}

impl Mounting {
    /// An encoder on the shaft of the drive link, counting up from φ = 0.
    #[must_use]
    pub const fn direct(counts_per_turn: u32) -> Self {
        Self {
            counts_per_turn,
            gear: [1, 1],
            counting: Counting::Up,
            homing_offset: 0,
        }
    }
}

/// Converts any count of an encoder to the phase of a drive link that turns, with two multiplications.
///
/// ```
/// use jred::axis::{Counting, Encoder, Mounting};
///
/// const ENCODER: Encoder = match Encoder::new(Mounting {
///     counts_per_turn: 10_000,
///     gear: [17, 2],
///     counting: Counting::Down,
///     homing_offset: 1234,
/// }) {
///     Ok(encoder) => encoder,
///     Err(_) => panic!("the encoder's figures"),
/// };
/// assert_eq!(ENCODER.phase(1234).to_bits(), 0);
/// // A turn of the drive link: 85 000 counts.
/// assert_eq!(ENCODER.phase(1234 - 3 * 85_000).to_bits(), 0);
/// assert_eq!(ENCODER.phase(1234 - 85_000 / 4).to_bits(), 1 << 30);
/// ```
///
/// Accuracy: less than a unit of 2⁻³² of a turn (1.5e-9 rad) for every count of 32 or 64 bits and every ratio, and exact where the phase is a whole
/// number of units, such as at home and whole turns from it (test `the_phase_of_every_count_is_within_a_unit`). No error accumulates.
///
/// A counter of less than 32 bits, or one that overflows, first needs a [`Counter`](super::Counter). A 32-bit register that passes 2³¹ keeps its
/// angle without one only if 2³² counts are whole turns of the drive link (test `a_register_that_overflows_keeps_its_angle`).
///
/// In memory it is the `jred_encoder` of C, whose header computes the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct Encoder {
    /// Turns per count, modulo a turn, rounded to units of 2⁻⁶⁴: `upper`·2³² + `lower`.
    lower: i32,
    upper: u32,
    /// The phase of count 0 plus half a unit of a phase, in units of 2⁻⁶⁴.
    start: u64,
    /// The remainder of the turns per count, in units of 2⁻⁹⁶.
    rest: i32,
}

/// Half a unit of a phase, in units of 2⁻⁶⁴ of a turn.
const HALF: u64 = 1 << 31;

impl Encoder {
    /// Creates an encoder with this mounting. `const`: a program can have it in flash.
    ///
    /// # Errors
    /// [`AxisError::NotPositive`]: zero counts per turn, or a zero in the gear. [`AxisError::OutOfRange`]: less than two counts per turn of the drive
    /// link.
    pub const fn new(mounting: Mounting) -> Result<Self, AxisError> {
        let Mounting {
            counts_per_turn,
            gear: [encoder, link],
            counting,
            homing_offset: home,
        } = mounting;
        // A count is link/per of a turn.
        let Some(per) = NonZeroU128::new(counts_per_turn as u128 * encoder as u128) else {
            let what = if encoder == 0 {
                "the number of turns of the encoder in its gear"
            } else {
                "the number of counts of a turn of the encoder"
            };
            return Err(AxisError::NotPositive(what, 0.0));
        };
        if link == 0 {
            return Err(AxisError::NotPositive(
                "the number of turns of the drive link in the encoder's gear",
                0.0,
            ));
        }
        let link = link as u128;
        if per.get() < 2 * link {
            return Err(AxisError::OutOfRange {
                what: "the number of counts of a turn of the drive link",
                value: per.get() as f32 / link as f32,
                range: "at least 2",
            });
        }
        // Rounded to units of 2⁻⁹⁶: link < 2³².
        let step = ((link << 96) + per.get() / 2) / per.get();
        // The phase of home alone, exact: (home mod per)·link mod per, over per.
        let below = home.unsigned_abs() as u128 % per.get();
        let within = if home < 0 && below > 0 {
            per.get() - below
        } else {
            below
        };
        let within = within * link % per.get();
        // within < per < 2⁶⁴, so that the quotient has 64 bits.
        let home = (within << 64) / per.get();
        let (step, home) = match counting {
            Counting::Up => (step, (home as u64).wrapping_neg()),
            Counting::Down => ((1 << 96) - step, home as u64),
        };
        let nearest = (step + (1 << 31)) >> 32;
        let rest = (step as i128 - ((nearest as i128) << 32)) as i32;
        let (lower, upper) = signed_words(nearest as u64);
        Ok(Self {
            lower,
            upper,
            start: home.wrapping_add(HALF),
            rest,
        })
    }

    /// The phase at a 32-bit count.
    #[must_use]
    #[inline(always)]
    pub const fn phase(&self, count: i32) -> Phase {
        Phase::from_bits(upper_of_sum(count, (self.lower, self.upper), self.start))
    }

    /// The phase at a 64-bit count.
    #[must_use]
    #[inline]
    pub const fn phase_wide(&self, count: i64) -> Phase {
        let rest = self.rest as i64;
        let step = ((self.upper as u64) << 32).wrapping_add(self.lower as u64);
        // 95 bits, floored to units of 2⁻⁶⁴.
        let upper = (count >> 32) * rest;
        let lower = (count as u32 as i64 * rest) >> 32;
        let phase = (count as u64)
            .wrapping_mul(step)
            .wrapping_add((upper + lower) as u64)
            .wrapping_add(self.start);
        Phase::from_bits((phase >> 32) as u32)
    }
}
