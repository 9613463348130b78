//! `jred identify`: J(φ), V′(φ), friction and cogging of a machine from a log of its position and torque.
//!
//! ```text
//! J(φ)·α + ½·J′(φ)·ω² + V′(φ) + b·ω + c·sgn ω + cogging(φ) = T(t)          logged as T(t − d)
//! ```
//!
//! The method is that of `docs/commands/identify.md`: rows in `weak.rs`, the solution in `fit.rs`; its checks are [`Excitation`] and [`Fault`].

use std::f64::consts::TAU;

mod basis;
mod clock;
mod cogging;
mod fault;
mod fit;
mod likelihood;
mod matrix;
mod order;
mod place;
mod record;
mod result;
mod shaft;
mod slip;
mod smooth;
mod solution;
mod visits;
mod weak;

use jred_file::math;

use basis::Basis;
use fit::{DELAY_STEP, Fit, fit, needed, rest};
use matrix::DIAGONALS;
use solution::Unfit;

pub use fault::{Fault, Obstacle};
pub use place::{OTHER, Reading, against_design, judge_reading, shift};
pub use record::{RecordFault, Repair, samples};
pub use result::{Cogging, CurvePoint, Estimate, Excitation, Identified};
pub use shaft::{Shaft, of_motor, referred, without_drive};

/// Highest harmonic that is tried.
const HARMONICS: usize = 24;

/// Lowest number of harmonics that is tried if the log is short.
const FEWEST: usize = 5;

/// Share of samples in the other direction from which on the mean load is apart from Coulomb friction.
const BOTH_WAYS: f64 = 0.02;

/// Highest harmonic of c that is tried, and the share of samples in the other direction that it needs.
const FRICTION: usize = 8;
const BOTH_OFTEN: f64 = 0.2;

/// Rounds in which the samples of outliers are left out.
const CLEANING: usize = 4;

/// With faulty samples, a delay (s) that is further from the one to begin with needs another fit: which rows have them depends on it.
const FURTHER: f64 = 1e-3;

/// Outliers are faults if the torque's noise without them is less than this share: a coarse encoder has some of its own.
const FEWER: f64 = 0.9;

/// Delays (ms) that are tried if the first does not lead to the delay.
const DELAYS: std::ops::RangeInclusive<i32> = -6..=12;

/// Samples at equal steps, of the drive link.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// Time between samples (s).
    pub step: f64,
    /// Position (rad), without jumps after a turn.
    pub position: Vec<f64>,
    /// Torque (N·m).
    pub torque: Vec<f64>,
    /// Samples that are not used: long gaps, saturated torques.
    pub faulty: Vec<bool>,
}

/// The request.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Orders of the cogging per turn of the drive link; up to 24 they become harmonics of V′.
    pub cogging: Vec<u32>,
    /// The delay of the logged torque (s), if known.
    pub delay: Option<f64>,
    /// Coulomb friction of the design (N·m) at equal steps of a turn from φ = 0 on; empty if it is not known.
    pub friction: Vec<f64>,
    /// Smallest step of the position (rad).
    pub encoder_step: Option<f64>,
}

/// Identifies a machine whose drive link turns fully.
///
/// # Errors
/// Why the log does not determine the machine.
pub fn identify(samples: &Samples, options: &Options) -> Result<Identified, Obstacle> {
    let basis = basis_of(samples, options)?;
    let mut first = fitted(samples, &basis, options)?;
    if samples.faulty.contains(&true) && (first.delay - first.start).abs() > FURTHER {
        let again = fit(samples, &first.basis, options, Some(first.delay), None);
        first = again.map_err(|unfit| obstacle(samples, unfit))?;
    }
    let (cleaned, spikes) = cleaned(samples, &first, options);
    let (found, spikes) = match cleaned {
        Some(cleaned) if cleaned.torque_noise < FEWER * first.torque_noise => (cleaned, spikes),
        _ => (first, Vec::new()),
    };
    let basis = found.order();
    let found = found
        .subset(basis)
        .map_err(|unfit| obstacle(samples, unfit))?;
    Ok(result::identified(&found, samples, options, &spikes))
}

/// The fit without the samples of outliers, and those samples; `None` without outliers.
fn cleaned(samples: &Samples, first: &Fit, options: &Options) -> (Option<Fit>, Vec<usize>) {
    let mut used = samples.clone();
    let mut spikes = Vec::new();
    let mut cleaned: Option<Fit> = None;
    for _ in 0..CLEANING {
        let now = cleaned.as_ref().unwrap_or(first);
        let outliers = fault::outliers(now);
        if outliers.is_empty() {
            break;
        }
        let (spacing, delay) = (now.weak.spacing, now.delay);
        for row in &outliers {
            let from = row * spacing;
            used.faulty[from..from + DIAGONALS * spacing].fill(true);
        }
        // With too few rows left, the last fit stays.
        let Ok(next) = fit(&used, &first.basis, options, Some(delay), None) else {
            break;
        };
        spikes.extend(outliers.iter().map(|row| (row + 3) * spacing));
        cleaned = Some(next);
    }
    (cleaned, spikes)
}

/// Samples that move forwards and back.
fn ways(speed: &[f64]) -> [f64; 2] {
    let rest = rest(speed);
    let count = |sign: f64| speed.iter().filter(|w| sign * **w > rest).count() as f64;
    [count(1.0), count(-1.0)]
}

/// The unknowns that this log may determine.
fn basis_of(samples: &Samples, options: &Options) -> Result<Basis, Obstacle> {
    let least = Basis {
        harmonics: FEWEST,
        mean: false,
        friction: 0,
        shape: Vec::new(),
        cogging: Vec::new(),
        least: 0,
    };
    let speed = visits::check(samples, needed(&least))?;
    let [forward, back] = ways(&speed);
    let share = forward.min(back) / (forward + back);
    let varied = share > BOTH_OFTEN && visits::both_ways(samples, &speed);
    let orders = options.cogging.iter();
    let (low, cogging): (Vec<u32>, Vec<u32>) =
        orders.partition(|order| **order as usize <= HARMONICS);
    Ok(Basis {
        harmonics: HARMONICS,
        mean: share > BOTH_WAYS,
        friction: if varied { FRICTION } else { 0 },
        shape: cornered(without_mean(
            options.friction.iter().copied().filter(|_| varied),
        )),
        cogging,
        least: low.into_iter().max().unwrap_or(0) as usize,
    })
}

/// A curve without its mean; empty if it is constant but for rounding.
pub fn without_mean(curve: impl Iterator<Item = f64>) -> Vec<f64> {
    let curve: Vec<f64> = curve.collect();
    let mean = curve.iter().sum::<f64>() / curve.len().max(1) as f64;
    let rest: Vec<f64> = curve.iter().map(|c| c - mean).collect();
    let varies = rest.iter().any(|c| c.abs() > 1e-6 * mean.abs());
    if varies { rest } else { Vec::new() }
}

/// Share (RMS) of the design's friction beyond the harmonics of c, below which they describe it. As an unknown it would then be nearly one of them.
const SMOOTH: f64 = 0.01;

/// The curve (without its mean); empty if the harmonics of c describe it.
fn cornered(curve: Vec<f64>) -> Vec<f64> {
    let wave = |order: usize, value: fn(f64) -> f64| {
        let step = order as f64 * TAU / curve.len() as f64;
        let each = curve.iter().zip(0u32..);
        each.map(|(c, k)| c * value(f64::from(k) * step))
            .sum::<f64>()
    };
    let size: f64 = curve.iter().map(|c| c * c).sum();
    let told = (1..=FRICTION).map(|k| wave(k, math::cos).powi(2) + wave(k, math::sin).powi(2));
    let beyond = size - told.sum::<f64>() * 2.0 / curve.len() as f64;
    if beyond > SMOOTH * SMOOTH * size {
        curve
    } else {
        Vec::new()
    }
}

/// The fit with as many harmonics as the rows suffice for, and with the delay searched for if it is far from the usual one.
fn fitted(samples: &Samples, basis: &Basis, options: &Options) -> Result<Fit, Obstacle> {
    let mut basis = basis.clone();
    let mut found = fit(samples, &basis, options, None, None);
    let fewest = FEWEST.max(basis.least);
    while let (Err(Unfit::Few { .. }), true) = (&found, basis.harmonics > fewest) {
        basis = basis.with_harmonics((basis.harmonics * 3 / 4).max(fewest));
        found = fit(samples, &basis, options, None, None);
    }
    // Constant friction has fewer unknowns, and needs no angle in both directions.
    if let (Err(_), 1..) = (&found, basis.friction) {
        basis = basis.with_friction(0);
        basis.shape.clear();
        found = fit(samples, &basis, options, None, None);
    }
    let found = found.map_err(|unfit| obstacle(samples, unfit))?;
    if found.delay_step.abs() < DELAY_STEP {
        return Ok(found);
    }
    let low = basis.with_harmonics(basis.harmonics.min(basis.least.max(8)));
    let tried = DELAYS.filter_map(|ms| {
        let start = f64::from(ms) * 1e-3;
        let known = Options {
            delay: Some(start),
            ..options.clone()
        };
        let tried = fit(samples, &low, &known, None, Some(1)).ok()?;
        Some((start, tried.torque_noise))
    });
    let best = tried.min_by(|a, b| a.1.total_cmp(&b.1));
    let Some((start, _)) = best else {
        return Ok(found);
    };
    let again = fit(samples, &basis, options, Some(start), None)
        .map_err(|unfit| obstacle(samples, unfit))?;
    Ok(if again.torque_noise < found.torque_noise {
        again
    } else {
        found
    })
}

fn obstacle(samples: &Samples, unfit: Unfit) -> Obstacle {
    match unfit {
        Unfit::Few { rows, needed } => Obstacle::short(samples, rows, needed),
        Unfit::Singular => Obstacle::NotDetermined,
    }
}

/// The angle within a turn.
fn within_turn(phi: f64) -> f64 {
    phi.rem_euclid(TAU)
}
