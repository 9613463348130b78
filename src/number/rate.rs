//! Counts of 32 bits to numbers of a tick and back: a factor for each number type.

#![allow(
    clippy::inline_always,
    reason = "a few instructions each; a call would take as many, also where the program is optimised for size"
)]

use super::product::high;

/// A factor between counts and numbers, prepared for floating point and for fixed point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rate {
    /// A number per count.
    pub(super) factor: f32,
    /// Counts of the number 1.
    pub(super) counts: f32,
    /// In fixed point: a count so shifted is a number in units of 2⁻³⁰ to 2⁻³¹ of `counts`,
    shift: u32,
    /// which times this, in units of 2⁻³⁰, is one in units of 2⁻³¹.
    mantissa: i32,
    /// `counts`, limited to 2³⁰, in units of ½.
    half_counts: i32,
}

/// 2³⁰
const HALF: f32 = 1_073_741_824.0;

impl Rate {
    /// For numbers of which one is `1/factor` counts; the factor and its inverse are positive, normal numbers.
    pub(crate) fn new(factor: f32) -> Option<Self> {
        let counts = 1.0 / factor;
        let sound = factor > 0.0 && factor.is_normal() && counts.is_normal();
        let (mut shift, mut shifted) = (0, counts);
        while shifted < HALF && shift < 30 {
            shifted *= 2.0;
            shift += 1;
        }
        sound.then_some(Self {
            factor,
            counts,
            shift,
            // Saturates where a count is more than the number 1.
            mantissa: (HALF / shifted * HALF * 2.0) as i32,
            half_counts: (counts * 2.0) as i32,
        })
    }

    /// `count` times the factor in units of 2⁻³¹, limited to 32 bits, and whether it was.
    #[inline(always)]
    pub(super) fn of(&self, count: i32) -> (i32, bool) {
        let shift = self.shift & 31;
        let shifted = count << shift;
        let product = high(shifted, self.mantissa); // Q29
        let value = product << 2;
        if shifted >> shift == count && value >> 2 == product {
            (value, false)
        } else {
            ((count >> 31) ^ i32::MAX, true)
        }
    }

    /// The count of a number in units of 2⁻³¹.
    #[inline(always)]
    pub(super) fn back(&self, number: i32) -> i32 {
        high(number, self.half_counts)
    }
}
