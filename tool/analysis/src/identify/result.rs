//! The result of an identification.

use jred_file::math;
use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::Serialize;

use super::basis::in_turn;
use super::cogging::cogging;
use super::fault::Fault;
use super::fit::{DELAY_STEP, Fit, GRID, rest};
use super::matrix::dot;
use super::slip::slip;
use super::visits::speed_variation;
use super::{Options, Samples, ways};

/// Quantile of the normal distribution for a band of 95 %.
const BAND: f64 = 1.96;

/// A share of the torque's noise that some fault must have caused.
const NOISY: f64 = 0.1;

/// A value with its 95 % band.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Half width of its band.
    pub band: f64,
}

/// Cogging of an order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Cogging {
    /// Periods in a turn of the drive link.
    pub order: u32,
    /// Factor of its cosine (N·m).
    pub cosine: Estimate,
    /// Factor of its sine (N·m).
    pub sine: Estimate,
}

/// The curves at an angle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CurvePoint {
    /// The angle (rad).
    pub phi: f64,
    /// J (kg·m²).
    pub inertia: Estimate,
    /// J′ (kg·m²/rad).
    pub inertia_slope: f64,
    /// V′ of weight and springs, without a mean (N·m).
    pub potential_slope: Estimate,
    /// Coulomb friction c (N·m): constant unless both directions show that it depends on the angle.
    pub coulomb: Estimate,
}

/// How well the log's motion determines the machine.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Excitation {
    /// Duration of the log (s).
    pub duration: f64,
    /// Time in motion (s).
    #[serde(skip)]
    pub moving: f64,
    /// Time between two samples (s).
    pub step: f64,
    /// Turns.
    pub turns: f64,
    /// Median over the angles of std ω²/mean ω².
    pub speed_variation: f64,
    /// Inertial torque against the torque's noise: std α·mean J/σ_T.
    pub acceleration: f64,
    /// Share of the samples in motion whose direction is positive.
    pub forward: f64,
    /// Largest band of J, as a share of its maximum.
    pub band: f64,
}

/// A machine, as its log shows it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Identified {
    /// Number of harmonics of J and of V′.
    pub harmonics: usize,
    /// Coefficients of J: mean, then cosine and sine of each harmonic (kg·m²).
    pub inertia: Vec<Estimate>,
    /// Coefficients of V′: cosine and sine of each harmonic (N·m).
    pub potential: Vec<Estimate>,
    /// The curves over a turn.
    pub curves: Vec<CurvePoint>,
    /// Mean load (N·m); `None`: in one direction it is a part of Coulomb friction.
    pub mean_load: Option<Estimate>,
    /// Viscous friction (N·m·s/rad).
    pub viscous: Estimate,
    /// Coulomb friction, the mean over the angle (N·m).
    pub coulomb: Estimate,
    /// Factor of the design's Coulomb friction without its mean, which the identified friction has in it; null if that does not depend on the angle, and
    /// in one direction.
    pub coulomb_shape: Option<Estimate>,
    /// The design's Coulomb friction without its mean.
    #[serde(skip)]
    pub(super) shape: Vec<f64>,
    /// Coefficients of Coulomb friction that depends on the angle: cosine and sine of each harmonic (N·m).
    pub coulomb_waves: Vec<Estimate>,
    /// Cogging.
    pub cogging: Vec<Cogging>,
    /// Delay of the logged torque (s).
    pub delay: Estimate,
    /// Standard deviation of the torque's noise (N·m).
    pub torque_noise: f64,
    /// Standard deviation of the position's noise (rad).
    pub position_noise: f64,
    /// Mean square of the residuals against the noise model: about 1.
    pub misfit: f64,
    /// The motion.
    pub excitation: Excitation,
    /// Faults that were found.
    pub faults: Vec<Fault>,
}

impl Identified {
    /// The drive torque of a motion (N·m).
    pub fn torque(&self, phi: f64, omega: f64, alpha: f64) -> f64 {
        let half_square = 0.5 * omega * omega;
        let mut sum = self.inertia.first().map_or(0.0, |mean| mean.value) * alpha;
        let coefficients = self.inertia.get(1..).unwrap_or_default().chunks(2);
        for ((k, j), v) in (1..).zip(coefficients).zip(self.potential.chunks(2)) {
            let order = f64::from(k);
            let (s, c) = math::sin_cos(order * phi);
            let [a, b] = [j[0].value, j[1].value];
            sum += (a * c + b * s) * alpha + order * (b * c - a * s) * half_square;
            sum += v[0].value * c + v[1].value * s;
        }
        let sign = if omega == 0.0 { 0.0 } else { omega.signum() };
        let waves = (1..).zip(self.coulomb_waves.chunks(2)).map(|(k, c)| {
            let (sin, cos) = math::sin_cos(f64::from(k) * phi);
            c[0].value * cos + c[1].value * sin
        });
        let shape = self
            .coulomb_shape
            .map_or(0.0, |factor| factor.value * in_turn(&self.shape, phi)[0]);
        let coulomb = self.coulomb.value + shape + waves.sum::<f64>();
        let cogging = self.cogging.iter().map(|cog| {
            let (s, c) = math::sin_cos(f64::from(cog.order) * phi);
            cog.cosine.value * c + cog.sine.value * s
        });
        sum + self.mean_load.map_or(0.0, |load| load.value)
            + self.viscous.value * omega
            + coulomb * sign
            + cogging.sum::<f64>()
    }

    /// The only direction of the log (±1); `None`: both, so that the mean load is apart from Coulomb friction.
    pub fn direction(&self) -> Option<f64> {
        let forward = self.excitation.forward > 0.5;
        self.mean_load
            .is_none()
            .then_some(if forward { 1.0 } else { -1.0 })
    }

    /// The band of J, and whether J is positive, of the curves as they are.
    pub(super) fn judge_inertia(&mut self) {
        let band = self.curves.iter().map(|point| point.inertia.band);
        self.excitation.band = band.fold(0.0, f64::max) / self.largest_inertia().max(1e-300);
        let is_own = |fault: &Fault| matches!(fault, Fault::NotPositive { .. });
        self.faults.retain(|fault| !is_own(fault));
        let each = self.curves.iter();
        let least = each.min_by(|a, b| a.inertia.value.total_cmp(&b.inertia.value));
        let is_reversed = |fault: &Fault| matches!(fault, Fault::Reversed { .. });
        let reversed = self.faults.iter().any(is_reversed);
        let least = least.filter(|point| point.inertia.value <= 0.0 && !reversed);
        self.faults.extend(least.map(|point| Fault::NotPositive {
            at: point.phi,
            inertia: point.inertia.value,
        }));
    }

    /// Largest J (kg·m²).
    pub fn largest_inertia(&self) -> f64 {
        let sizes = self.curves.iter().map(|point| point.inertia.value.abs());
        sizes.fold(0.0, f64::max)
    }
}

/// The result of a fit.
pub(super) fn identified(
    fit: &Fit,
    samples: &Samples,
    options: &Options,
    spikes: &[usize],
) -> Identified {
    let basis = &fit.basis;
    let one = |i: usize| Estimate {
        value: fit.theta[i],
        band: BAND * fit.variance(i, &[1.0]).max(0.0).sqrt(),
    };
    let sum = |from: usize, row: &[f64]| Estimate {
        value: dot(row, &fit.theta[from..from + row.len()]),
        band: BAND * fit.variance(from, row).max(0.0).sqrt(),
    };
    let curves: Vec<CurvePoint> = (0..GRID)
        .map(|k| {
            let phi = k as f64 * TAU / GRID as f64;
            let mut waves = Vec::new();
            basis.harmonics_at(phi, &mut waves);
            CurvePoint {
                phi,
                inertia: sum(0, &basis.inertia_row(phi)),
                inertia_slope: basis.at(&fit.theta, &waves, phi).inertia_slope,
                potential_slope: sum(basis.potential(), &basis.potential_row(phi)),
                coulomb: sum(basis.coulomb(), &basis.friction_row(phi)),
            }
        })
        .collect();
    let cogging = basis.cogging.iter().zip(0..).map(|(&order, k)| Cogging {
        order,
        cosine: one(basis.cog() + 2 * k),
        sine: one(basis.cog() + 2 * k + 1),
    });
    let delay_band = if fit.delay_free {
        BAND * fit.variance(basis.unknowns(), &[1.0]).max(0.0).sqrt()
    } else {
        0.0
    };
    let mut identified = Identified {
        harmonics: basis.harmonics,
        inertia: (0..basis.inertias()).map(one).collect(),
        potential: (basis.potential()..basis.mean_load()).map(one).collect(),
        mean_load: basis.mean.then(|| one(basis.mean_load())),
        viscous: one(basis.viscous()),
        coulomb: one(basis.coulomb()),
        coulomb_shape: (!basis.shape.is_empty()).then(|| one(basis.coulomb() + 1)),
        shape: basis.shape.clone(),
        coulomb_waves: (basis.coulomb_waves()..basis.cog()).map(one).collect(),
        cogging: cogging.collect(),
        delay: Estimate {
            value: options.delay.unwrap_or(fit.delay),
            band: delay_band,
        },
        torque_noise: fit.torque_noise,
        position_noise: fit.position_noise,
        misfit: fit.misfit,
        excitation: excitation(fit, samples, &curves),
        faults: Vec::new(),
        curves,
    };
    identified.faults = faults(&identified, fit, samples, options, spikes);
    identified.judge_inertia();
    identified
}

fn excitation(fit: &Fit, samples: &Samples, curves: &[CurvePoint]) -> Excitation {
    let speed = &fit.motion.speed;
    let count = speed.len() as f64;
    let alpha = &fit.motion.acceleration;
    let mean_alpha = alpha.iter().sum::<f64>() / count;
    let deviation = alpha.iter().map(|a| (a - mean_alpha).powi(2)).sum::<f64>() / count;
    let inertias = curves.iter().map(|point| point.inertia.value.abs());
    let mean = inertias.sum::<f64>() / curves.len() as f64;
    let [forward, back] = ways(speed);
    let rest = rest(speed);
    let moving = speed.iter().map(|w| w.abs()).filter(|w| *w > rest);
    let travel = moving.sum::<f64>() * samples.step;
    let moving = (forward + back) * samples.step;
    Excitation {
        duration: samples.step * samples.position.len() as f64,
        moving,
        turns: travel / TAU,
        speed_variation: speed_variation(samples, speed),
        step: samples.step,
        acceleration: deviation.sqrt() * mean / fit.torque_noise,
        forward: forward / (forward + back).max(1.0),
        band: 0.0,
    }
}

fn faults(
    found: &Identified,
    fit: &Fit,
    samples: &Samples,
    options: &Options,
    spikes: &[usize],
) -> Vec<Fault> {
    let mut faults = Vec::new();
    if found.curves.iter().all(|point| point.inertia.value < 0.0) {
        faults.push(Fault::Reversed { position: None });
    }
    let slip = slip(fit, samples, options);
    if let Some(slip) = slip.as_ref().filter(|slip| slip.proven) {
        faults.push(slip.fault());
        return faults;
    }
    // The jump of a slip is an outlier itself.
    let near = |at: f64| slip.as_ref().is_some_and(|slip| (at - slip.at).abs() < 1.0);
    let spikes = spikes.iter().map(|spike| *spike as f64 * samples.step);
    let spikes: Vec<f64> = spikes.filter(|at| !near(*at)).collect();
    if let Some(first) = spikes.iter().copied().reduce(f64::min) {
        faults.push(Fault::Spikes {
            count: spikes.len(),
            first,
        });
    }
    faults.extend(cogging(fit));
    // Outliers and cogging look like a slip.
    if faults.is_empty() {
        faults.extend(slip.map(|slip| slip.fault()));
    }
    let rms = (dot(&samples.torque, &samples.torque) / samples.torque.len() as f64).sqrt();
    let share = found.torque_noise / rms;
    if share > NOISY {
        faults.push(Fault::Noisy { share });
    }
    if fit.delay_step.abs() >= DELAY_STEP {
        faults.push(Fault::Delay { at: fit.delay });
    }
    faults
}
