//! A row of a plan: the polynomial of the position over a part of the time, and its arithmetic.

use crate::number::high;

pub(super) const ROW_WORDS: usize = 8;

/// A row as it lies in the image.
pub(super) type Words = [u32; ROW_WORDS];

/// Fraction bits of a time: units of 2⁻⁴⁰ s.
pub(super) const TIME_BITS: u32 = 40;

/// Units of a plan, as powers of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Units {
    /// Times of rows are in units of 2⁻ᵗ s.
    pub(super) time: u32,
    /// Speeds in units of 2ˢ·2⁻³² of the range a second.
    pub(super) speed: i32,
    /// Accelerations in units of 2ᵃ·2⁻³² of the range a second squared.
    pub(super) acceleration: i32,
}

/// The state of a plan at a time, in its units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct RowState {
    /// 2⁻³² of the range, and whole turns.
    pub(crate) position: i64,
    pub(crate) speed: i32,
    pub(crate) acceleration: i32,
}

/// x·2ⁿ, rounded down.
#[inline(always)]
pub(in crate::axis) const fn shifted(x: i64, n: i32) -> i64 {
    if n >= 0 {
        x << (n & 63)
    } else {
        x >> (if n < -63 { 63 } else { -n })
    }
}

/// x·u/2³² for an even u, up to two units too small; an odd u counts as u − 1.
#[inline(always)]
fn times(x: i32, u: u32) -> i32 {
    high(x, (u >> 1).cast_signed()) << 1
}

/// A row, decoded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    /// Start, in units of the plan.
    pub(super) start: u32,
    /// Position there, in units of 2⁻³² of the range.
    pub(super) position: i64,
    /// Speed there.
    pub(super) speed: i32,
    /// Coefficients have 2⁻ᵉ of the unit of accelerations.
    pub(super) finer: u32,
    /// Coefficients of u², u³, u⁴ and u⁵.
    pub(super) coefficients: [i32; 4],
}

impl Row {
    #[inline(always)]
    pub(super) const fn read(words: &Words) -> Self {
        let [start, low, upper, speed, c2, c3, c4, c5] = *words;
        let turns = upper.cast_signed() >> 8;
        Self {
            start,
            position: (turns as i64) << 32 | low as i64,
            speed: speed.cast_signed(),
            finer: upper & 0xff,
            coefficients: [
                c2.cast_signed(),
                c3.cast_signed(),
                c4.cast_signed(),
                c5.cast_signed(),
            ],
        }
    }

    pub(super) const fn words(&self) -> Words {
        let [c2, c3, c4, c5] = self.coefficients;
        [
            self.start,
            self.position as u32,
            ((self.position >> 32) as u32) << 8 | self.finer & 0xff,
            self.speed.cast_unsigned(),
            c2.cast_unsigned(),
            c3.cast_unsigned(),
            c4.cast_unsigned(),
            c5.cast_unsigned(),
        ]
    }

    /// The state at a time (2⁻⁴⁰ s) within the row, which is `length` units long.
    #[inline(always)]
    pub(super) fn at(&self, time: u64, length: u32, units: Units) -> RowState {
        let window = Window::of(length, units);
        let start = u64::from(self.start) << (TIME_BITS.saturating_sub(units.time) & 63);
        let since = time.wrapping_sub(start).cast_signed();
        // Less than 2³²: the window is longer than the row.
        let u = shifted(since, -(window.exponent + 8)) as u32;
        window.state(self, u, units)
    }
}

/// A power of two of seconds, longer than a row, but less than twice as long: the time in the row is a fraction of it, found by a shift.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Window {
    /// Its length is 2ᵐ s.
    pub(super) exponent: i32,
}

impl Window {
    #[inline(always)]
    pub(super) const fn of(length: u32, units: Units) -> Self {
        Self {
            exponent: 32 - length.leading_zeros().cast_signed() - units.time.cast_signed(),
        }
    }

    /// Shifts from a row's coefficients to speeds and to positions, and from its speed to a position.
    #[inline(always)]
    pub(super) const fn shifts(self, row: &Row, units: Units) -> [i32; 3] {
        let Units {
            speed,
            acceleration,
            ..
        } = units;
        let gained = self.exponent + acceleration - row.finer.cast_signed();
        [
            gained - speed,
            gained + self.exponent,
            self.exponent + speed - 32,
        ]
    }

    /// The state at a share u of the window, in units of 2⁻³².
    #[inline(always)]
    fn state(self, row: &Row, u: u32, units: Units) -> RowState {
        let [c2, c3, c4, c5] = row.coefficients;
        // The check of the row ensures that no sum exceeds 32 bits.
        let sum = |[a, b, c, d]: [i32; 4]| {
            let inner = c3.wrapping_mul(b).wrapping_add(times(
                c4.wrapping_mul(c)
                    .wrapping_add(times(c5.wrapping_mul(d), u)),
                u,
            ));
            c2.wrapping_mul(a).wrapping_add(times(inner, u))
        };
        let [to_speed, to_position, moved] = self.shifts(row, units);
        let way = times(times(sum([1, 1, 1, 1]), u), u);
        let gained = times(sum([2, 3, 4, 5]), u);
        let even = i64::from(row.speed).wrapping_mul(u.into());
        RowState {
            position: row
                .position
                .wrapping_add(shifted(even, moved))
                .wrapping_add(shifted(way.into(), to_position)),
            speed: row
                .speed
                .wrapping_add(shifted(gained.into(), to_speed) as i32),
            acceleration: sum([2, 6, 12, 20]) >> (row.finer & 31),
        }
    }
}
