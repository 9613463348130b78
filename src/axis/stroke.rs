//! From an encoder count to the phase of a drive link that has a stroke.

use super::AxisError;
use super::error::within;
use crate::math;
use crate::number::Real;
use crate::{Domain, Outcome, Phase};

/// A scale or encoder along a stroke, and its mounting.
///
/// ```text
/// s = home_position + (count − homing_offset)·resolution
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct StrokeMounting {
    /// Movement of the drive link per count (m, or rad for one that swings); negative if the encoder counts down while the position grows.
    pub resolution: f64,
    /// The count at `home_position`.
    pub homing_offset: i64,
    /// Position at the count `homing_offset` (m, or rad).
    pub home_position: f64,
}

/// Converts any count of an encoder to the phase of a drive link that has a stroke, limited to its ends and flagged there.
///
/// ```
/// use jred::Domain;
/// use jred::axis::{StrokeEncoder, StrokeMounting};
///
/// // A stroke from 0.1 to 0.6 m, a micrometre a count, count 0 at 0.35 m.
/// const STROKE: Domain = Domain::Stroke { from: 0.1, to: 0.6 };
/// let scaled = StrokeMounting { resolution: 1e-6, homing_offset: 0, home_position: 0.35 };
/// let encoder = StrokeEncoder::new(STROKE, scaled)?;
/// assert_eq!(encoder.phase(0).value.to_bits(), 1 << 31);
/// assert!(!encoder.phase(-250_000).saturated);
/// assert!(encoder.phase(-250_001).saturated && encoder.phase(250_001).saturated);
/// # Ok::<(), jred::axis::AxisError>(())
/// ```
///
/// A 32-bit register may overflow within the stroke, read as signed or as unsigned: [`phase`](Self::phase) uses the count nearest to the middle of
/// the stroke (test `a_register_may_overflow_within_the_stroke`). A register of fewer bits needs a [`Counter`](super::Counter) first.
///
/// Accuracy: less than a unit of 2⁻³² of the stroke for every count; half a unit for strokes of up to a million counts (tests
/// `the_phase_along_a_stroke_is_within_a_unit`, `strokes_of_many_counts_are_within_a_unit`).
///
/// In memory it is the `jred_stroke_encoder` of C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct StrokeEncoder {
    /// A count as a share of the stroke, rounded to units of 2⁻⁶⁴.
    step: i64,
    /// The phase of the count `middle` plus half a unit, in units of 2⁻³²; for 32-bit counts far beyond the stroke, if they do not suffice for it.
    start: i64,
    start_narrow: i64,
    /// The count next to the middle of the stroke.
    middle: i64,
    /// The stroke's counts plus one: limit of a count's distance from the middle.
    reach: i64,
    /// The remainder of `start`, in units of 2⁻⁶⁴.
    part: u32,
    /// The remainder of `step`, in units of 2⁻⁹⁶.
    rest: i32,
}

/// 2³²
const UNITS: f64 = 4_294_967_296.0;
/// Beyond the stroke for every 32-bit count.
const FAR: i64 = 1 << 61;

impl StrokeEncoder {
    /// An encoder without a stroke, which flags every count: a placeholder.
    pub const NOWHERE: Self = Self {
        step: 0,
        start: FAR,
        start_narrow: FAR,
        middle: 0,
        reach: 0,
        part: 0,
        rest: 0,
    };

    /// Creates an encoder with this mounting, on a drive link with this stroke.
    ///
    /// # Errors
    /// [`AxisError::NotFinite`]; [`AxisError::OutOfRange`]: a stroke of less than 16 or more than 2⁵³ counts (a turn has no stroke), a
    /// home 100,000 strokes away, or so far from the stroke that its counts have more than 62 bits.
    pub fn new<R: Real>(domain: Domain<R>, scaled: StrokeMounting) -> Result<Self, AxisError> {
        let StrokeMounting {
            resolution,
            homing_offset: home,
            home_position: at_home,
        } = scaled;
        let (from, span) = match domain.to::<f64>() {
            Domain::Turn => (0.0, 0.0),
            Domain::Stroke { from, to } => (from, to - from),
        };
        for (what, value) in [
            ("the encoder's resolution", resolution),
            ("the position at home", at_home),
        ] {
            if !value.is_finite() {
                return Err(AxisError::NotFinite(what));
            }
        }
        // A reversed stroke is refused.
        let step = resolution / span.max(0.0);
        let counts = 1.0 / math::abs(step);
        let holds = (16.0..=9_007_199_254_740_992.0).contains(&counts);
        within(
            "the number of counts of the stroke",
            counts as f32,
            holds,
            "from 16 to 9007199254740992",
        )?;
        let at_home = (at_home - from) / span;
        let holds = math::abs(at_home) <= 1e5;
        within(
            "the position at home, in strokes,",
            at_home as f32,
            holds,
            "from -100000 to 100000",
        )?;
        // Counts from home to the middle: the whole counts, and the fraction.
        let way = (0.5 - at_home) / step;
        let whole = math::rint(way);
        let middle = i128::from(home) + whole as i128;
        let holds = middle.unsigned_abs() < 1 << 62;
        within(
            "the count in the middle of the stroke",
            middle as f32,
            holds,
            "of at most 62 bits",
        )?;
        let all = (step * UNITS * UNITS * UNITS) as i128;
        let nearest = (all + (1 << 31)) >> 32;
        let start = ((0.5 - (way - whole) * step) * UNITS * UNITS) as i128 + (1 << 31);
        // Both ends are less than 2³¹ counts from the count next to the middle.
        let narrow = counts <= UNITS - 2.0;
        Ok(Self {
            step: nearest as i64,
            start: (start >> 32) as i64,
            start_narrow: if narrow { (start >> 32) as i64 } else { FAR },
            middle: middle as i64,
            reach: counts as i64 + 1,
            part: start as u32,
            rest: (all - (nearest << 32)) as i32,
        })
    }

    /// The phase at a 32-bit count, as read from a register that overflows; limited to the stroke, and flagged there. A stroke of more than 2³²
    /// counts needs [`phase_wide`](Self::phase_wide): here all its counts are flagged.
    #[must_use]
    #[inline(always)]
    pub const fn phase(&self, count: i32) -> Outcome<Phase> {
        let count = count.wrapping_sub(self.middle as i32) as i64;
        let lower = (count * (self.step as u32 as i64) + self.part as i64) >> 32;
        // |count·step| ≤ 2³¹·2⁶⁰, so that each of the terms is less than 2⁶⁰.
        limited(count * (self.step >> 32) + lower + self.start_narrow)
    }

    /// The phase at a 64-bit count; limited to the stroke, and flagged there.
    #[must_use]
    #[inline]
    pub const fn phase_wide(&self, count: i64) -> Outcome<Phase> {
        let count = count.saturating_sub(self.middle);
        let count = if count > self.reach {
            self.reach
        } else if count < -self.reach {
            -self.reach
        } else {
            count
        };
        // |count·step| is less than 2⁶⁶, so that no term exceeds 2³⁴.
        let (upper, lower) = (count >> 32, count as u32 as u64);
        let low = lower * (self.step as u32 as u64);
        // In units of 2⁻⁶², so that the sum does not overflow.
        let rest = upper * self.rest as i64 + ((lower as i64 * self.rest as i64) >> 32);
        let rests = (rest >> 2) + (self.part >> 2) as i64;
        let parts = ((low >> 2) as i64 + rests) >> 30;
        limited(upper * self.step + lower as i64 * (self.step >> 32) + parts + self.start)
    }
}

/// The phase of a place in units of 2⁻³² of the stroke, limited.
#[inline(always)]
const fn limited(place: i64) -> Outcome<Phase> {
    let end = 1 << 32;
    let value = if place < 0 {
        0
    } else if place < end {
        place as u32
    } else {
        u32::MAX
    };
    Outcome {
        value: Phase::from_bits(value),
        saturated: place < 0 || place > end,
    }
}
