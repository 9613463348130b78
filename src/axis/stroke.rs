//! From an encoder's count to the phase of a drive link that has a stroke.

use super::AxisError;
use super::error::within;
use crate::math;
use crate::number::Real;
use crate::{Domain, Outcome, Phase};

/// A scale or encoder along a stroke, and how it is mounted.
///
/// ```text
/// s = at_home + (count − home)·resolution
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Scaled {
    /// How far a count moves the drive link (m, or rad for one that swings); negative if the encoder counts down while the position
    /// grows.
    pub resolution: f64,
    /// The count at the position `at_home`.
    pub home: i32,
    /// Position at the count `home` (m, or rad).
    pub at_home: f64,
}

/// An encoder of a drive link that has a stroke: the phase of any count, limited to the ends of the stroke, and whether it was.
///
/// ```
/// use jred::Domain;
/// use jred::axis::{Scaled, StrokeEncoder};
///
/// // A stroke from 0.1 to 0.6 m, a micrometre a count, count 0 at 0.35 m.
/// const STROKE: Domain = Domain::Stroke { from: 0.1, to: 0.6 };
/// let scaled = Scaled { resolution: 1e-6, home: 0, at_home: 0.35 };
/// let encoder = StrokeEncoder::new(STROKE, scaled)?;
/// assert_eq!(encoder.phase(0).value.to_bits(), 1 << 31);
/// assert!(!encoder.phase(-250_000).saturated);
/// assert!(encoder.phase(-250_001).saturated && encoder.phase(250_001).saturated);
/// # Ok::<(), jred::axis::AxisError>(())
/// ```
///
/// Accuracy: less than a unit of 2⁻³² of the stroke off, for every count of 32 bits; half of one for strokes of up to a million counts (test `the_phase_along_a_stroke_is_within_a_unit`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct StrokeEncoder {
    /// A count as a part of the stroke, in units of 2⁻⁶⁴.
    step: i64,
    /// The phase of count 0 and half a unit, in units of 2⁻³².
    start: i64,
    /// The rest of it, in units of 2⁻⁶⁴.
    rest: u32,
}

/// 2³²
const STROKE: f64 = 4_294_967_296.0;

impl StrokeEncoder {
    /// Of an encoder mounted like this, on a drive link with this stroke.
    ///
    /// # Errors
    /// [`AxisError::NotFinite`]; [`AxisError::OutOfRange`]: a stroke of less than 16 or more than 2³⁰ counts (a turn has no stroke), or a
    /// home 100,000 strokes away.
    pub fn new<R: Real>(domain: Domain<R>, scaled: Scaled) -> Result<Self, AxisError> {
        let Scaled {
            resolution,
            home,
            at_home,
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
        // A stroke from its upper to its lower end is none.
        let step = resolution / span.max(0.0);
        let counts = 1.0 / math::abs(step);
        let holds = (16.0..=1_073_741_824.0).contains(&counts);
        within(
            "the number of counts of the stroke",
            counts as f32,
            holds,
            "from 16 to 1073741824",
        )?;
        let at_home = (at_home - from) / span;
        let holds = math::abs(at_home) <= 1e5;
        within(
            "the position at home, in strokes,",
            at_home as f32,
            holds,
            "from -100000 to 100000",
        )?;
        let step = math::rint(step * STROKE * STROKE) as i64;
        let at_home = (at_home * STROKE * STROKE) as i128;
        let start = at_home - i128::from(home) * i128::from(step) + (1 << 31);
        Ok(Self {
            step,
            start: (start >> 32) as i64,
            rest: start as u32,
        })
    }

    /// The phase at a count; limited to the stroke, and flagged there.
    #[must_use]
    #[inline(always)]
    pub const fn phase(&self, count: i32) -> Outcome<Phase> {
        let count = count as i64;
        let lower = (count * (self.step as u32 as i64) + self.rest as i64) >> 32;
        // |count·step| ≤ 2³¹·2⁶⁰, so that each of the terms is less than 2⁶⁰.
        let phase = count * (self.step >> 32) + lower + self.start;
        let end = 1 << 32;
        let value = if phase < 0 {
            0
        } else if phase < end {
            phase as u32
        } else {
            u32::MAX
        };
        Outcome {
            value: Phase::from_bits(value),
            saturated: phase < 0 || phase > end,
        }
    }
}
