//! Factors of any magnitude between numbers of a tick, and between 32-bit counts and numbers.

use super::product::high;

/// A factor, prepared for floating point and for fixed point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct Factor {
    pub(super) float: f32,
    /// In fixed point: an argument shifted by this uses 31 bits where the result is 1,
    shift: u32,
    /// and times this in units of 2⁻³² is a quarter of the result.
    mantissa: i32,
}

/// 2³¹
const ONE: f32 = 2_147_483_648.0;

impl Factor {
    /// From a number: result = ratio·number. `None` if the ratio is 2³¹ or more, or if it or its inverse is not a positive normal number.
    pub(crate) fn new(ratio: f32) -> Option<Self> {
        Self::of(ratio, ratio)
    }

    /// From a count: result = ratio·count.
    pub(crate) fn of_count(ratio: f32) -> Option<Self> {
        Self::of(ratio, ratio * ONE)
    }

    /// To a count: result = ratio·number.
    pub(crate) fn to_count(ratio: f32) -> Option<Self> {
        Self::of(ratio, ratio / ONE)
    }

    /// In fixed point `ratio` is the result of the argument 1.
    fn of(float: f32, ratio: f32) -> Option<Self> {
        let argument = 1.0 / ratio;
        if !(ratio > 0.0 && ratio.is_normal() && argument.is_normal() && float.is_normal()) {
            return None;
        }
        let (mut shift, mut shifted) = (0, argument);
        while shifted <= 0.5 && shift < 30 {
            shifted *= 2.0;
            shift += 1;
        }
        // Otherwise the result of every argument except 0 would be beyond the range.
        (shifted > 0.5).then(|| Self {
            float,
            shift,
            mantissa: (0.25 / shifted * 2.0 * ONE) as i32,
        })
    }

    /// x times the ratio, limited to 32 bits, and whether it was limited.
    #[inline(always)]
    pub(super) fn times(&self, x: i32) -> (i32, bool) {
        let shift = self.shift & 31;
        let shifted = x << shift;
        let quarter = high(shifted, self.mantissa);
        let value = quarter << 2;
        if shifted >> shift == x && value >> 2 == quarter {
            (value, false)
        } else {
            ((x >> 31) ^ i32::MAX, true)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Factor, ONE};

    /// A factor times its inverse is 1, over the whole range of both. Beyond that range, where one of its numbers is zero, subnormal or infinite,
    /// there is no factor.
    #[test]
    fn factors_and_their_inverses() {
        // 2⁻¹²⁶ is the smallest normal number; the ratio's inverse is below 2¹²⁸.
        for power in -125..=30 {
            let ratio = 2.0f32.powi(power);
            let factor = Factor::new(ratio).unwrap();
            if (-29..=29).contains(&power) {
                let inverse = Factor::new(1.0 / ratio).unwrap();
                let there = if power < 0 {
                    1 << 30
                } else {
                    (1 << 30) >> power
                };
                let back = inverse.times(factor.times(there).0).0;
                let lost = 4i64 << (-power).max(0);
                assert!(i64::from(back - there).abs() <= lost, "2^{power}: {back}");
            }
        }
        let tiny = f32::MIN_POSITIVE;
        for none in [
            0.0,
            -1.0,
            f32::NAN,
            f32::INFINITY,
            0.5 * tiny,
            ONE,
            1.0 / tiny,
        ] {
            assert_eq!(Factor::new(none), None, "{none:e}");
        }
        // From a count: the ratio may be smaller by 2³¹, but must itself be a normal single-precision number.
        assert!(Factor::of_count(tiny).is_some());
        assert_eq!(Factor::of_count(0.5 * tiny), None);
        // To a count: larger by 2³¹.
        assert!(Factor::to_count(4.0 * ONE * tiny).is_some());
        assert_eq!(Factor::to_count(0.9 * ONE * tiny), None);
    }
}
