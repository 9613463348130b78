//! Speed and acceleration from the counts of an encoder.

use super::AxisError;
use super::error::{positive, within};
use crate::Phase;

/// A tracking filter: phase, speed and acceleration of a drive link, from one encoder phase per period.
///
/// The fading-memory filter of second degree (α-β-γ filter; N. Morrison, *Introduction to Sequential Smoothing and Prediction*, 1969): it fits a
/// parabola to all phases so far, with weight θⁿ for the phase n periods ago. With the residual r = φ − φ_predicted:
///
/// ```text
/// φ ← φ_predicted + (1 − θ³)·r
/// ω ← ω_predicted + 3/2·(1 − θ²)·(1 − θ)·r/T
/// α ← α_predicted + (1 − θ)³·r/T²
/// ```
///
/// Its three poles are at θ: critically damped. It follows a constant acceleration without lag, and a step of the acceleration to within 1 % after
/// about 8.4/(1 − θ) periods. Where many counts pass in a period, the quantisation δ of the encoder (one count) causes these standard deviations of
/// the speed at the end of the period, and of the acceleration:
///
/// ```text
/// σ_ω = δ/T·√((1 − θ)³·(49 + 50·θ + 13·θ²)/(24·(1 + θ)⁵))
/// σ_α = δ/T²·√((1 − θ)⁵/(2·(1 + θ)⁵))
/// ```
///
/// (test `the_filter_settles_and_smooths_as_stated`). For θ = 0.9 these are 0.013·δ/T and 0.0004·δ/T².
///
/// It computes with 64-bit integers: the same bits on every processor, and no error that grows with the number of turns. Over a turn phases wrap, and
/// the residual must stay below half a turn: from rest a speed below 1.3·(1 − θ) and below a sixth of a turn per period, and an acceleration below
/// 1.6·(1 − θ)² turns per period squared. A speed of a quarter of the range per period or more is impossible: speed and acceleration restart at 0. So
/// wrong counts, however many, are forgotten like any other change (test `wrong_counts_are_forgotten`), and at the end of a stroke the speed comes to
/// rest (test `at_the_end_of_a_stroke_the_speed_comes_to_rest`).
///
/// The `residual` reports the difference between reading and prediction, and `jumped` a residual above the [largest step](Self::with_largest_step): a
/// count that jumps, a broken wire, or an encoder that was set to a new value. The filter uses such a reading like any other; the program decides
/// whether to trust the motion until it has settled. At constant acceleration the residual is the error of the encoder's counts; a sudden change of
/// the acceleration by Δα leaves up to 0.53·Δα·T²/(1 − θ)², 0.29 from θ = 0.9 on (test `a_change_of_the_acceleration_is_no_jump`).
///
/// In memory it is the `jred_tracker` of C, whose header computes the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(C)]
pub struct Tracker {
    /// Units of 2⁻⁶⁴ of the range; the same per period, and per period squared.
    phase: i64,
    speed: i64,
    acceleration: i64,
    /// Shares of the residual, in units of 2⁻³².
    gains: [u32; 3],
    /// The largest residual that is not a jump, in units of 2⁻³² of the range.
    largest: u32,
}

/// Position, speed and acceleration of a drive link, as a [`Tracker`] found them, per period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TrackerOutput {
    /// The phase, filtered.
    pub phase: Phase,
    /// The speed, in units of 2⁻³² of the range per period.
    pub speed: i32,
    /// The acceleration, in units of 2⁻⁴⁰ of the range per period squared; limited to 32 bits, which [`Period::alpha`](super::Period::alpha) flags.
    pub acceleration: i32,
    /// Reading minus prediction, in units of 2⁻³² of the range; on a stroke limited to half of it.
    pub residual: i32,
    /// The residual exceeds the largest step, or speed and acceleration restarted at 0: not a motion of this machine.
    pub jumped: bool,
}

/// A quarter of the range.
const QUARTER: u32 = 1 << 30;

/// θ of the poles of a first-order lag with this corner frequency (Hz) and period (s).
pub(super) fn memory_of(bandwidth: f32, period: f32) -> Result<f32, AxisError> {
    positive("the bandwidth of the filter", bandwidth)?;
    positive("the period of the tick", period)?;
    Ok(1.0 / (1.0 + core::f32::consts::TAU * bandwidth * period))
}

/// An acceleration from units of 2⁻⁶⁴ to units of 2⁻⁴⁰, limited to 32 bits.
#[inline]
const fn upper(acceleration: i64) -> i32 {
    let wide = acceleration >> 24;
    let upper = (wide >> 32) as i32;
    if upper == wide as i32 >> 31 {
        wide as i32
    } else {
        upper >> 31 ^ i32::MAX
    }
}

impl Tracker {
    /// A filter with the memory θ, 0 to 0.99: 0 differentiates three phases without smoothing, 0.9 averages over about ten.
    ///
    /// # Errors
    /// [`AxisError::OutOfRange`]: θ outside 0 to 0.99.
    pub fn new(memory: f32) -> Result<Self, AxisError> {
        let holds = (0.0..=0.99).contains(&memory);
        within("the memory of the filter", memory, holds, "from 0 to 0.99")?;
        let rest = 1.0 - memory;
        let gains = [
            1.0 - memory * memory * memory,
            1.5 * (1.0 - memory * memory) * rest,
            rest * rest * rest,
        ];
        Ok(Self {
            phase: 0,
            speed: 0,
            acceleration: 0,
            // Up to 3/2.
            gains: gains.map(|gain| (gain * 2_147_483_648.0) as u32),
            largest: QUARTER,
        })
    }

    /// The same, with the largest step of the machine in a period, in either direction, such as `tick.moved(most)` for its greatest speed. A reading
    /// farther from the prediction has [`jumped`](TrackerOutput::jumped). The default is a quarter of the range.
    #[must_use]
    pub const fn with_largest_step(self, step: Phase) -> Self {
        Self {
            largest: (step.to_bits() as i32).unsigned_abs(),
            ..self
        }
    }

    /// A filter with the poles of three first-order lags with the corner frequency `bandwidth` (Hz), called every `period` (s): θ = 1/(1 +
    /// 2π·bandwidth·period), the usual discrete form of a first-order lag.
    ///
    /// # Errors
    /// A number that is not positive and finite, or a memory outside 0 to 0.99.
    pub fn with_bandwidth(bandwidth: f32, period: f32) -> Result<Self, AxisError> {
        Self::new(memory_of(bandwidth, period)?)
    }

    /// The same at rest at this phase: for the start, or after the encoder was set.
    #[must_use]
    pub const fn at(self, phase: Phase) -> Self {
        Self {
            phase: (phase.to_bits() as i64) << 32,
            speed: 0,
            acceleration: 0,
            ..self
        }
    }

    /// Advances one period, with the encoder's phase now, on a turn.
    #[inline]
    pub const fn update(&mut self, measured: Phase) -> TrackerOutput {
        let phase = self
            .phase
            .wrapping_add(self.speed)
            .wrapping_add(self.acceleration >> 1);
        // The shorter way round.
        let residual = measured.to_bits().wrapping_sub((phase >> 32) as u32) as i32;
        let (correction, lost) = self.correct(residual);
        self.phase = phase.wrapping_add(correction);
        self.tracked(residual, lost)
    }

    /// As [`update`](Self::update), on a stroke: at its ends phases do not wrap, but stay.
    #[inline]
    pub const fn update_stroke(&mut self, measured: Phase) -> TrackerOutput {
        // The prediction may lie beyond an end. Limiting it would remove the residual, and a speed at an end would persist.
        let phase =
            self.phase as u64 as i128 + self.speed as i128 + (self.acceleration >> 1) as i128;
        let residual = measured.to_bits() as i64 - (phase >> 32) as i64;
        // A residual beyond half of the stroke is limited to half.
        let residual = if residual > i32::MAX as i64 {
            i32::MAX
        } else if residual < i32::MIN as i64 {
            i32::MIN
        } else {
            residual as i32
        };
        let (correction, lost) = self.correct(residual);
        let phase = phase + correction as i128;
        self.phase = match phase >> 64 {
            0 => phase as i64,
            ..0 => 0,
            _ => -1,
        };
        self.tracked(residual, lost)
    }

    /// Sets the acceleration of the period that the next reading ends, in the units of [`TrackerOutput::acceleration`]: for an observer, whose model
    /// predicts it.
    #[inline]
    pub(super) const fn accelerate(&mut self, acceleration: i32) {
        self.acceleration = (acceleration as i64) << 24;
    }

    /// The share of a residual that corrects the acceleration, in the units of [`TrackerOutput::acceleration`] and limited as that.
    #[inline]
    pub(super) const fn correction(&self, residual: i32) -> i32 {
        let [.., of_acceleration] = self.gains;
        upper((residual as i64 * of_acceleration as i64) << 1)
    }

    /// Whether speed and acceleration restarted at 0.
    #[inline]
    pub(super) const fn restarted(&self) -> bool {
        self.speed == 0 && self.acceleration == 0
    }

    /// Corrects speed and acceleration by a residual. Returns the correction of the phase, and whether the motion was impossible.
    #[inline]
    const fn correct(&mut self, residual: i32) -> (i64, bool) {
        let residual = residual as i64;
        let [of_phase, of_speed, of_acceleration] = self.gains;
        // A residual has 31 bits, a gain 32 in units of 2⁻³¹: no product overflows.
        let gained = self
            .acceleration
            .wrapping_add((residual * of_speed as i64) << 1);
        self.speed = self.speed.wrapping_add(gained);
        self.acceleration = self
            .acceleration
            .wrapping_add((residual * of_acceleration as i64) << 1);
        // Impossible motion: without this test the filter could follow a wrong one endlessly, because differences of phases wrap.
        let lost = (self.speed ^ self.speed << 1) < 0;
        if lost {
            self.speed = 0;
            self.acceleration = 0;
        }
        ((residual * of_phase as i64) << 1, lost)
    }

    #[inline]
    const fn tracked(&self, residual: i32, lost: bool) -> TrackerOutput {
        TrackerOutput {
            phase: Phase::from_bits((self.phase >> 32) as u32),
            speed: (self.speed >> 32) as i32,
            acceleration: upper(self.acceleration),
            residual,
            jumped: lost || residual.unsigned_abs() > self.largest,
        }
    }
}
