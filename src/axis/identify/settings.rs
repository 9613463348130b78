//! The figures of the signals that an identification is given, checked once.

use super::column::{Column, Effect};
use super::filter::Filter;
use super::weight::{MOST_TICKS, WINDOWS, Weights, weights};
use super::{RESIDUAL_KEPT, SLOWEST};
use crate::Harmonic;
use crate::axis::AxisError;
use crate::axis::error::{positive, within};
use crate::curve::{Circular, CurveSet, MAX_HARMONICS, curves, words_len};
use crate::math::Real;
use core::f32::consts::TAU;

/// Time between two rows (s).
const KNOT: f32 = 0.004;

/// Half width of the filter of the speed (s).
const NARROW: f32 = 0.012;

/// Six standard deviations of a second difference: a jump, in the noise of the angle.
const JUMP: f32 = 6.0 * 2.449_49;

/// And at least this share of the greatest speed times the period, which no acceleration reaches.
const LEAST_JUMP: f32 = 0.25;

/// The figures of the signals that an [`Identification`](super::Identification) is given.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct IdentificationSettings {
    /// Period of the ticks (s): 0.5, 1 or 2 ms, or so.
    pub period: f32,
    /// Greatest speed of the drive link (rad/s); what is faster is left out.
    pub max_speed: f32,
    /// Mean of J (kg·m²) as far as it is known: within a factor of two.
    pub inertia: f32,
    /// How long before the instant of the phase the torque of a tick acted (s); negative if it acts later: −0.1 ms for a current that is sampled 0.1 ms
    /// after the encoder, −½·period for a command that acts until the next tick.
    pub torque_delay: f32,
    /// Standard deviation of the torque's noise (N·m).
    pub torque_noise: f32,
    /// Standard deviation of the angle's noise (rad); at least that of the counts, 2π/counts/√12.
    pub angle_noise: f32,
    /// Time constant after which older samples count less (s); infinite: never.
    pub memory: f32,
}

/// The settings in the units of ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plan<T> {
    /// Ticks between two knots.
    pub(super) ticks: usize,
    /// Rotations in each tick.
    pub(super) pivots: usize,
    /// Samples from an angle to its torque, in a ring.
    pub(super) late: usize,
    pub(super) inertia: T,
    pub(super) jump: T,
    pub(super) slowest: T,
    pub(super) fastest: T,
    pub(super) angle_variance: T,
    pub(super) torque_products: [T; WINDOWS],
    pub(super) least_share: T,
    /// √λ, the share that the equations keep in each row.
    pub(super) kept: T,
    pub(super) residual_kept: T,
    /// Samples after which the figures of the motion are halved.
    pub(super) remembered: u32,
}

type Planned<T> = (Plan<T>, [Weights<T>; MOST_TICKS], Filter<T>);

impl IdentificationSettings {
    pub(super) fn plan<T: Circular>(
        &self,
        ring: usize,
        coefficients: usize,
    ) -> Result<Planned<T>, AxisError> {
        positive("the period of the tick", self.period)?;
        within(
            "the period of the tick",
            self.period,
            (0.000_49..0.002_1).contains(&self.period),
            "from 0.5 to 2 ms: add every second tick of a faster drive, or more seldom",
        )?;
        positive("the greatest speed", self.max_speed)?;
        positive("the inertia", self.inertia)?;
        positive("the noise of the torque", self.torque_noise)?;
        positive("the noise of the angle", self.angle_noise)?;
        within(
            "the memory",
            self.memory,
            self.memory >= 1.0,
            "at least a second",
        )?;
        let period = self.period;
        let ticks = (KNOT / period + 0.5) as u32;
        let turns = self.max_speed / TAU;
        within(
            "the greatest speed",
            self.max_speed,
            turns * period * ((ticks as usize * WINDOWS) as f32) < 0.5,
            "less than half a turn in 24 ms",
        )?;
        // Where the noise of the torque and of the angle's second derivative are alike.
        let corner = Real::sqrt(self.torque_noise / (self.inertia * self.angle_noise)) / TAU;
        // The motion comes last: a corner below its harmonics would smooth away what the instruments are for.
        let corner = (0.7 * corner).min(0.05 / period).max(5.0 * turns);
        let narrow = (NARROW / period + 0.5) as u32;
        // R. Schafer, *IEEE Signal Processing Magazine* 28, 2011: the corner of a filter of fourth degree.
        let wide = ((2.5 / (corner * period) + 4.6) / 3.2 + 0.5) as u32;
        let wide = wide.max(narrow + 1);
        within(
            "the length of the ring",
            ring as f32,
            ring > 2 * wide as usize,
            "more than 0.32/(turns per second times the period) + 4, and 24 ms",
        )?;
        let delay = self.torque_delay / period;
        within(
            "the delay of the torque",
            self.torque_delay,
            delay < narrow as f32 && -delay < narrow as f32,
            "between -12 and 12 ms",
        )?;
        // Rounded down.
        let whole = delay as isize - isize::from(delay < (delay as isize) as f32);
        let late = delay - whole as f32;
        let [period, angle, torque, inertia, late] = [
            self.period,
            self.angle_noise,
            self.torque_noise,
            self.inertia,
            late,
        ]
        .map(T::from_single);
        let (table, products) = weights(ticks, period, late);
        let step = self.max_speed * self.period;
        let jump = (JUMP * self.angle_noise).max(LEAST_JUMP * step);
        // √λ = exp(−h/2τ), of an exponent below 0.003.
        let faded = 0.5 * ticks as f32 * self.period / self.memory;
        let plan = Plan {
            ticks: ticks as usize,
            pivots: coefficients.div_ceil(ticks.max(1) as usize),
            late: (ring as isize + whole) as usize,
            inertia,
            jump: T::from_single(jump),
            slowest: T::from_single(SLOWEST.min(self.max_speed / 40.0)),
            // Noise and ripple of the filter exceed a stated plateau.
            fastest: T::from_single(1.05 * self.max_speed),
            angle_variance: angle * angle,
            torque_products: products.map(|product| torque * torque * product),
            least_share: T::from_f64(1e-6),
            kept: T::from_single(1.0 - faded * (1.0 - 0.5 * faded)),
            residual_kept: T::from_f64(RESIDUAL_KEPT),
            remembered: (2.0 * self.memory / self.period).min(131_072.0) as u32,
        };
        Ok((plan, table, Filter::new(wide, narrow, period, angle)))
    }
}

/// The columns of a set with these orders of cogging.
pub(super) fn columns<T: Circular, const N: usize>(
    set: CurveSet,
    cogging: &[u32],
) -> Result<[Column<T>; N], AxisError> {
    let made = all_columns(set, cogging).ok_or(AxisError::OutOfRange {
        what: "the number of coefficients",
        value: N as f32,
        range: "the number of words of a set with constant friction, and two for each order of cogging",
    })?;
    for (k, column) in made.iter().enumerate() {
        let mut earlier = made.iter().take(k);
        // The load is a torque over φ as cogging is; of order 0 it is Coulomb friction.
        let is_new = column.order > 0 && !earlier.any(|other| other.acts_as(column));
        within(
            "an order of the cogging",
            column.order as f32,
            column.effect != Effect::Cogging || is_new,
            "above the harmonics of the load, and given once",
        )?;
    }
    Ok(made)
}

/// The columns; `None` if their number is another one, or the set has what cannot be identified.
fn all_columns<T: Circular, const N: usize>(
    set: CurveSet,
    cogging: &[u32],
) -> Option<[Column<T>; N]> {
    let words = N.checked_sub(2 * cogging.len())?;
    let mut lengths = (0..=MAX_HARMONICS).map(|n| words_len::<Harmonic<f64>>(n, set));
    lengths.find(|length| *length == words)?;
    if set & curves::COULOMB != 0 && set & curves::CONSTANT_COULOMB != 0 {
        return None;
    }
    let mut made = [Column::new(Effect::None, 0, false); N];
    for (word, column) in made.iter_mut().enumerate() {
        *column = match word.checked_sub(words) {
            None => Column::of_word(word, set)?,
            Some(more) => Column::new(Effect::Cogging, *cogging.get(more / 2)?, more % 2 == 1),
        };
    }
    Some(made)
}
