//! Hardware counts, extended to 64 bits.

/// Extends a hardware counter of `BITS` bits (1 to 32), which overflows, to 64 bits.
///
/// The machine must move less than half the counter's range between two readings: 32 767 counts for 16 bits.
///
/// The next right reading corrects a wrong one, unless the wrong one is off by half of the range, plus or minus the machine's movement between the
/// readings before and after it. Then the count stays off by a whole range (test `a_wrong_reading_is_corrected_unless_it_is_half_the_range_off`); an
/// index pulse reveals that.
///
/// ```
/// use jred::axis::Counter;
///
/// let mut counter = Counter::<16>::default();
/// assert_eq!(counter.extend(65_000), -536);
/// assert_eq!(counter.extend(100), 100);
/// assert_eq!(counter.extend(32_000), 32_000);
/// assert_eq!(counter.extend(64_000), 64_000);
/// ```
///
/// A timer that an index pulse or its own limit resets once a turn needs no `Counter`: its count goes directly to an [`Encoder`](super::Encoder).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Counter<const BITS: u32> {
    count: i64,
}

impl<const BITS: u32> Counter<BITS> {
    /// Left shift of a reading to 32 bits.
    const SHIFT: u32 = {
        assert!(BITS >= 1 && BITS <= 32, "a counter has 1 to 32 bits");
        32 - BITS
    };

    /// A counter that has this count now.
    #[must_use]
    pub const fn at(count: i64) -> Self {
        Self { count }
    }

    /// The new count for a reading: the nearest one to the last count.
    #[inline]
    pub const fn extend(&mut self, reading: u32) -> i64 {
        let moved = (reading << Self::SHIFT).wrapping_sub((self.count as u32) << Self::SHIFT);
        let moved = (moved as i32) >> Self::SHIFT;
        self.count = self.count.wrapping_add(moved as i64);
        self.count
    }
}
