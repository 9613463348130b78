//! Generalised least squares with instruments, in rounds.
//!
//! ```text
//! C = σ_T²·Δt²·Σww + σ_v²·BBᵀ = LLᵀ          covariance of the rows: noise of the torque and of the encoder
//! θ = (Z̃ᵀX̃)⁻¹·Z̃ᵀR̃                            X̃ = L⁻¹X from the measured angle, Z̃ from the low-passed one
//! ```
//!
//! X has the encoder's noise, which ordinary least squares would turn into a smaller J; Z has almost none of it, also if a controller carries it
//! into the motion.

use std::f64::consts::TAU;

use super::basis::Basis;
use super::likelihood::{covariance, torque_variance};
use super::matrix::{Band, Matrix, dot, factor, whiten};
use super::smooth::{Smooth, half_window, noise, smooth, speed_noise};
use super::solution::{Unfit, solve};
use super::weak::{self, Weak};
use super::{Options, Samples};

/// Distance of the knots of the test functions (s).
const KNOTS: f64 = 4e-3;

/// Half window of the filter of the speed (s).
const SPEED_WINDOW: f64 = 12e-3;

/// Largest change of the delay in a round (s).
pub(super) const DELAY_STEP: f64 = 1e-3;

/// The delay to begin with (s).
pub(super) const DELAY: f64 = 1e-3;

/// Rows are left out if their support is this close (s) to a faulty sample or to rest.
const NEAR: f64 = 3e-3;

/// Below this speed (rad/s), or a twentieth of the RMS speed if that is lower, friction is that of a joint at rest.
const REST: f64 = 0.3;

/// Samples between two knots.
fn spacing(step: f64) -> usize {
    ((KNOTS / step).round() as usize).max(2)
}

/// Rows of a log without faults, but for those at its ends.
pub(super) fn most_rows(samples: &Samples) -> usize {
    weak::number(samples.position.len(), spacing(samples.step))
}

/// The speed (rad/s) from which on the machine moves.
pub(super) fn rest(speed: &[f64]) -> f64 {
    REST.min((dot(speed, speed) / speed.len().max(1) as f64).sqrt() / 20.0)
}

/// Number of rounds.
const ROUNDS: usize = 3;

/// Least number of rows, as a multiple of the unknowns.
pub(super) const ROWS: usize = 20;

/// Least number of rows for these unknowns and the delay.
pub(super) fn needed(basis: &Basis) -> usize {
    ROWS * (basis.unknowns() + 1)
}

/// Positions over a turn.
pub(super) const GRID: usize = 360;

/// A fit.
pub(super) struct Fit {
    pub(super) basis: Basis,
    pub(super) theta: Vec<f64>,
    /// The delay (s) that it began with.
    pub(super) start: f64,
    /// The delay (s), that of the rows, and its last change before it was bounded.
    pub(super) delay: f64,
    pub(super) delay_of_rows: f64,
    pub(super) delay_step: f64,
    /// Whether the delay is an unknown, after the others.
    pub(super) delay_free: bool,
    /// Standard deviations of position (rad) and torque (N·m).
    pub(super) position_noise: f64,
    pub(super) torque_noise: f64,
    /// Mean square of the whitened residuals.
    pub(super) misfit: f64,
    /// Of the unknowns: by the noise model, with the misfit if that is above 1, and by the residuals.
    pub(super) covariances: [Matrix; 2],
    pub(super) residuals: Vec<f64>,
    pub(super) whitened: Matrix,
    pub(super) instruments: Matrix,
    pub(super) right: Vec<f64>,
    /// Which rows count.
    pub(super) kept: Vec<bool>,
    pub(super) weak: Weak,
    pub(super) motion: Smooth,
    pub(super) lower: Band,
}

/// Derivative by the row's number.
fn gradient(y: &[f64], distance: f64) -> Vec<f64> {
    let last = y.len() - 1;
    let slope = |i: usize| {
        let [from, to] = [i.saturating_sub(1), (i + 1).min(last)];
        (y[to] - y[from]) / ((to - from).max(1) as f64 * distance)
    };
    (0..y.len()).map(slope).collect()
}

/// The instruments with a cut-off frequency.
struct Instruments {
    motion: Smooth,
    rows: Matrix,
}

impl Instruments {
    fn new(weak: &Weak, basis: &Basis, samples: &Samples, cutoff: f64) -> Self {
        let half = half_window(cutoff, samples.step);
        let motion = smooth(&samples.position, samples.step, half);
        let rows = weak.rows(basis, &motion.position, &motion.speed);
        Self { motion, rows }
    }
}

/// Data that the rounds of a fit share.
struct Prepared {
    weak: Weak,
    /// From the measured position.
    rows: Matrix,
    position_noise: f64,
    kept: Vec<bool>,
    used: usize,
    /// Turns per second.
    turns: f64,
    /// Those of the first round.
    instruments: Instruments,
}

impl Prepared {
    /// For torques that are late by about `delay`.
    fn new(samples: &Samples, basis: &Basis, options: &Options, delay: f64) -> Result<Self, Unfit> {
        let (step, position) = (samples.step, &samples.position);
        let count = position.len();
        let spacing = spacing(step);
        let weak = Weak::new(count, spacing, step);
        let position_noise = noise(position, &samples.faulty)
            .max(options.encoder_step.unwrap_or_default() / 12.0f64.sqrt())
            .max(1e-9);
        let half = ((SPEED_WINDOW / step).round() as usize).max(4);
        let raw = smooth(position, step, half).speed;
        let excess = position_noise.powi(2) * speed_noise(half, step);
        let mean_square = dot(&raw, &raw) / count as f64;
        let travel = position.first().zip(position.last());
        let travel = travel.map_or(0.0, |(a, b)| (b - a).abs());
        let turns = (travel / (count as f64 * step)).max(mean_square.sqrt()) / TAU;
        let speed: Vec<f64> = raw
            .iter()
            .map(|w| w.signum() * (w * w - excess).max(0.0).sqrt())
            .collect();
        let rows = weak.rows(basis, position, &speed);
        let first_cutoff = (5.0 * turns).max(10.0);
        let instruments = Instruments::new(&weak, basis, samples, first_cutoff);
        let margin = 2.0 * half_window(first_cutoff, step) as f64 + 5e-3 / step;
        let edge = (margin / spacing as f64).ceil() as usize + 1;
        let near = (NEAR / step + 1e-9) as usize;
        // A sample has the position of its time, and the torque of an earlier one.
        let late = (delay / step).round() as isize;
        let of_torque = |k: usize| {
            k.checked_add_signed(late)
                .and_then(|k| samples.faulty.get(k))
        };
        // A torque before or after the log is not known.
        let faulty = (0..count).map(|k| samples.faulty[k] || of_torque(k) != Some(&false));
        let faulty = weak.touched(faulty, near);
        let rest = rest(&raw);
        let resting = instruments.motion.speed.iter().map(|w| w.abs() < rest);
        let resting = weak.touched(resting, near);
        let kept: Vec<bool> = (0..weak.count)
            .map(|i| i >= edge && i + edge < weak.count && !faulty[i] && !resting[i])
            .collect();
        let used = kept.iter().filter(|kept| **kept).count();
        let needed = needed(basis);
        if used < needed {
            return Err(Unfit::Few { rows: used, needed });
        }
        Ok(Self {
            weak,
            rows,
            position_noise,
            kept,
            used,
            turns,
            instruments,
        })
    }
}

/// The rows, with zeros where they do not count.
pub(super) fn masked(rows: &Matrix, kept: &[bool]) -> Matrix {
    let mut masked = rows.clone();
    for (row, kept) in masked.rows_mut().zip(kept) {
        if !kept {
            row.fill(0.0);
        }
    }
    masked
}

fn zeroed(values: &[f64], kept: &[bool]) -> Vec<f64> {
    let each = values.iter().zip(kept);
    each.map(|(v, kept)| if *kept { *v } else { 0.0 }).collect()
}

/// The fit with this basis, beginning at the delay `start`, if that is not known.
pub(super) fn fit(
    samples: &Samples,
    basis: &Basis,
    options: &Options,
    start: Option<f64>,
    rounds: Option<usize>,
) -> Result<Fit, Unfit> {
    let delay_free = options.delay.is_none();
    let start = options.delay.or(start).unwrap_or(DELAY);
    let Prepared {
        weak,
        rows,
        position_noise,
        kept,
        used,
        turns,
        mut instruments,
    } = Prepared::new(samples, basis, options, start)?;
    let mut delay = start;
    let torque_band = weak.torque_band();
    // Without weights, to begin with.
    let right = weak.torque(&samples.torque, delay)[0].clone();
    let [x, z] = [&rows, &instruments.rows].map(|rows| masked(rows, &kept));
    let zero = |values: &[f64]| zeroed(values, &kept);
    let first = solve(&x, &z, &zero(&right), used)?;
    let mut theta = first.theta;
    let mut variance = 0.3 * dot(&first.residuals, &first.residuals) / used as f64 / torque_band[0];
    let mut last = None;
    for round in 0..rounds.unwrap_or(ROUNDS) {
        let errors = weak.position_errors(basis, &theta, &instruments.motion);
        let mut position_band = weak.position_band(&errors);
        for row in &mut position_band {
            *row = row.map(|x| x * position_noise * position_noise);
        }
        let [right, slope] = weak.torque(&samples.torque, delay);
        let modelled = rows.times(&theta);
        let residuals: Vec<f64> = right.iter().zip(&modelled).map(|(r, x)| r - x).collect();
        let steps = if round == 0 { 6 } else { 2 };
        variance = torque_variance(
            &position_band,
            &torque_band,
            &kept,
            &zero(&residuals),
            variance,
            steps,
        )
        .ok_or(Unfit::Singular)?;
        let band = covariance(&position_band, &torque_band, variance, &kept);
        let lower = factor(&band).ok_or(Unfit::Singular)?;
        if round == 0 {
            let grid = (0..GRID).map(|k| k as f64 * TAU / GRID as f64);
            let size: f64 = grid
                .map(|phi| dot(&basis.inertia_row(phi), &theta[..basis.inertias()]).abs())
                .sum();
            let mean = (size / GRID as f64).max(1e-300);
            let crossing = (variance.sqrt() / (mean * position_noise)).sqrt() / TAU;
            // The machine's own harmonics must pass, whatever the noise.
            let cutoff = (0.7 * crossing).min(0.05 / samples.step).max(5.0 * turns);
            instruments = Instruments::new(&weak, basis, samples, cutoff);
        }
        let modelled = gradient(&instruments.rows.times(&theta), weak.knots());
        let [mut x, mut z] = [&rows, &instruments.rows].map(|rows| masked(rows, &kept));
        if delay_free {
            let negative = |v: &[f64]| -> Vec<f64> { zero(v).iter().map(|v| -v).collect() };
            x = x.beside(&negative(&slope));
            z = z.beside(&negative(&modelled));
        }
        let mut column = Matrix::zeros(right.len(), 1)
            .beside(&zero(&right))
            .select(&[1]);
        for matrix in [&mut x, &mut z, &mut column] {
            whiten(&lower, matrix);
        }
        let right: Vec<f64> = column.rows().map(|row| row[0]).collect();
        let mut found = solve(&x, &z, &right, used)?;
        let delay_of_rows = delay;
        let delay_step = if delay_free {
            found.theta.pop().unwrap_or_default()
        } else {
            0.0
        };
        delay += delay_step.clamp(-DELAY_STEP, DELAY_STEP);
        theta.clone_from(&found.theta);
        last = Some((lower, x, z, right, found, delay_of_rows, delay_step));
    }
    let (lower, whitened, z, right, found, delay_of_rows, delay_step) =
        last.ok_or(Unfit::Singular)?;
    Ok(Fit {
        basis: basis.clone(),
        theta: found.theta,
        start,
        delay,
        delay_of_rows,
        delay_step,
        delay_free,
        position_noise,
        torque_noise: variance.sqrt(),
        misfit: found.misfit,
        covariances: found.covariances,
        residuals: found.residuals,
        whitened,
        instruments: z,
        right,
        kept,
        weak,
        motion: instruments.motion,
        lower,
    })
}

impl Fit {
    pub(super) fn used(&self) -> usize {
        self.kept.iter().filter(|kept| **kept).count()
    }

    /// Variance of a sum of unknowns, from unknown `from` on with these factors: the larger of the two covariances.
    pub(super) fn variance(&self, from: usize, factors: &[f64]) -> f64 {
        let each = self.covariances.iter().map(|covariance| {
            let sum = factors.iter().enumerate().map(|(i, a)| {
                let row = &covariance.row(from + i)[from..from + factors.len()];
                a * dot(row, factors)
            });
            sum.sum::<f64>()
        });
        each.fold(0.0, f64::max)
    }
}
