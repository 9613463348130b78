//! One cycle of the duty, prepared so that any number of drives can be checked against it.
//!
//! The torque of a motor is a linear form c·x of the five [loads](loads_of) x of an instant. A drive contributes only the five coefficients c. The
//! values over the cycle follow from c without iterating over the samples:
//! - its RMS is ‖R·c‖, with R the triangular factor of the samples ([`Cycle::rms_torque`]);
//! - its extremes, its peak against an envelope and the signs of its power are found by branch and bound over stretches of samples ([`Cycle::peak`],
//!   [`Cycle::torque_extremes`], [`Cycle::energies`]).
//!
//! Each equals the result of a loop over all samples, to rounding (1e-12 of the sum of the form's terms; `tests/cycle.rs`). A peak is then the peak
//! of the polynomial through the samples of its panel, and where the power changes sign the energies are those of that polynomial:
//! `tests/cycle/between.rs` compares both with closed forms. [`Cycle::new`] is one pass over the samples. After it a drive costs the same at a
//! thousand samples and at a million, except for a few more levels of the search (docs/performance.md).

use jred_file::math;
use std::sync::OnceLock;

use crate::catalogue::Drive;
use crate::cycle::form::{Coefficients, LOADS, MotorDuty, loads_of};
use crate::motor::envelope::{Envelope, MotorLimits};
use jred_analysis::duty::mechanics::Mechanics;
use jred_analysis::duty::{Duty, Panel, PanelPolynomial, Smooth};
use jred_file::number::figures::Figures;

mod beyond;
mod extremes;
mod factor;
mod floor;
pub mod form;
mod front;
mod peak_check;
mod power;
mod repeats;
pub(crate) mod speeds;
mod torque_integrals;
mod tree;

use extremes::Stretches;
use factor::Factor;
use front::Front;
pub(crate) use peak_check::PeakCheck;
use repeats::Distinct;
use speeds::Speeds;
pub(crate) use torque_integrals::TorqueIntegrals;
use tree::Tree;

/// Exponent of the mean torque for roller bearings.
const BEARING: f64 = 10.0 / 3.0;

/// One instant of the cycle at the gearbox output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadSample {
    /// Time (s).
    pub t: f64,
    /// Weight in the integral over the cycle (s).
    pub weight: f64,
    alpha: f64,
    output_torque: f64,
    speed: f64,
}

impl LoadSample {
    /// The five loads: see [`loads_of`]. They are not stored: for a million instants they would take another 16 MB.
    #[inline]
    pub fn loads(&self) -> [f64; LOADS] {
        loads_of(self.alpha, self.output_torque, self.speed)
    }

    /// Speed at the gearbox output (rad/s).
    #[inline]
    pub const fn speed(&self) -> f64 {
        self.speed
    }

    /// Motor power divided by the gear ratio (W).
    #[inline]
    fn power(&self, c: &Coefficients) -> f64 {
        self.speed * c.torque(&self.loads())
    }

    /// Whether power flows back to the motor, by more than rounding of its torque.
    #[inline]
    fn gives_back(&self, c: &Coefficients, slack: f64) -> bool {
        self.power(c) < -slack * self.speed.abs()
    }

    /// Torque at the gearbox output (N·m).
    #[inline]
    pub const fn output_torque(&self) -> f64 {
        self.output_torque
    }
}

/// The cycle.
#[derive(Clone, Debug)]
pub struct Cycle {
    duration: f64,
    hold_torque: f64,
    mechanics: Mechanics,
    samples: Vec<LoadSample>,
    smooth: Smooth,
    inertia: Figures,
    speed: Figures,
    mean_speed: f64,
    peak_output_torque: f64,
    mean_loads: [f64; LOADS],
    /// The samples at which the machine, and its inertia alone, feed back most power: most regenerating drives do so at one of them.
    giving: [Option<usize>; 2],
    /// Largest magnitudes of the loads.
    largest: [f64; LOADS],
    torque: Factor,
    power: Factor,
    tree: Tree,
    front: Front,
    /// The cycle without its repeats, if there are many.
    distinct: Option<Distinct>,
    cubic_mean: OnceLock<f64>,
    /// Sorted only when a thermal model needs it.
    speeds: OnceLock<Speeds>,
    bearing_mean: OnceLock<f64>,
}

/// The closest approach of the cycle to an envelope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// |T| as a share of the envelope's torque there; infinite beyond the envelope's largest speed.
    pub used: f64,
    /// Motor torque there (N·m).
    pub torque: f64,
    /// Motor speed there (rad/s).
    pub speed: f64,
}

impl Cycle {
    /// Prepares a duty in one pass over its instants, whose weights must not be negative.
    pub fn new(duty: &Duty) -> Self {
        let samples: Vec<LoadSample> = duty
            .instants
            .iter()
            .map(|instant| LoadSample {
                t: instant.t,
                weight: instant.weight,
                alpha: instant.input_alpha,
                output_torque: instant.input_torque,
                speed: instant.input_speed,
            })
            .collect();
        let mut largest = [0.0f64; LOADS];
        let mut mean_loads = [0.0; LOADS];
        for sample in &samples {
            for (k, load) in sample.loads().into_iter().enumerate() {
                largest[k] = largest[k].max(load.abs());
                mean_loads[k] += sample.weight * load;
            }
        }
        // A torque is rounded like ½·J′·ω², even where the sum cancels. A machine that turns evenly without a load has only rounding errors, which no
        // bound could tell from values.
        for instant in &duty.instants {
            let energy = instant.input_inertia * instant.input_speed * instant.input_speed;
            for torque in [1, 2] {
                largest[torque] = largest[torque].max(energy);
            }
        }
        let tree = Tree::new(&samples, &largest);
        Self {
            duration: duty.duration,
            hold_torque: duty.hold_torque,
            mechanics: duty.mechanics.clone(),
            inertia: duty.figures(|i| i.input_inertia),
            speed: duty.figures(|i| i.input_speed),
            mean_speed: duty.integral(|i| i.input_speed.abs()) / duty.duration,
            peak_output_torque: duty.figures(|i| i.input_torque).peak(),
            smooth: duty.smooth.clone(),
            mean_loads: mean_loads.map(|sum| sum / duty.duration),
            giving: [
                least(&samples, |sample| sample.output_torque * sample.speed),
                least(&samples, |sample| sample.alpha * sample.speed),
            ],
            torque: Factor::of_loads(&samples),
            power: Factor::of_powers(&samples),
            front: Front::new(&tree, &samples, &largest),
            distinct: Distinct::of(&samples, &duty.smooth, &largest),
            tree,
            largest,
            cubic_mean: OnceLock::new(),
            speeds: OnceLock::new(),
            bearing_mean: OnceLock::new(),
            samples,
        }
    }

    /// Length of the cycle (s).
    pub const fn duration(&self) -> f64 {
        self.duration
    }

    /// Torque that holds the machine at the gearbox output (N·m); see [`Duty::hold_torque`].
    pub const fn hold_torque(&self) -> f64 {
        self.hold_torque
    }

    /// Data of machine and motion for the mechanical rules.
    pub const fn mechanics(&self) -> &Mechanics {
        &self.mechanics
    }

    /// The instants in order of time.
    pub fn samples(&self) -> &[LoadSample] {
        &self.samples
    }

    /// Inertia at the gearbox output over the cycle (kg·m²).
    pub const fn inertia(&self) -> Figures {
        self.inertia
    }

    /// Mean of the speed's magnitude at the gearbox output (rad/s).
    pub const fn mean_speed(&self) -> f64 {
        self.mean_speed
    }

    /// Largest speed at the gearbox output (rad/s).
    #[inline]
    pub fn peak_speed(&self) -> f64 {
        self.speed.peak()
    }

    /// Largest magnitude of the torque at the gearbox output (N·m).
    pub const fn peak_output_torque(&self) -> f64 {
        self.peak_output_torque
    }

    /// Mean torque at the gearbox output, weighted with the speed: (∫|n|·|T|^p dt/∫|n| dt)^(1/p), so that the load counts by its share of the
    /// revolutions. p = 3 is the root-mean-cube torque of gears, 10/3 that of roller bearings. These two are computed once, any other at every call.
    pub fn mean_output_torque(&self, power: f64) -> f64 {
        let once = match power {
            3.0 => &self.cubic_mean,
            BEARING => &self.bearing_mean,
            _ => return self.power_mean(power),
        };
        *once.get_or_init(|| self.power_mean(power))
    }

    fn power_mean(&self, power: f64) -> f64 {
        let turning = self.mean_speed * self.duration;
        if turning == 0.0 {
            return 0.0;
        }
        let share =
            |s: &LoadSample| s.weight * s.speed().abs() * math::pow(s.output_torque().abs(), power);
        math::pow(
            self.samples.iter().map(share).sum::<f64>() / turning,
            1.0 / power,
        )
    }

    /// The samples by speed.
    pub(crate) fn speeds(&self) -> &Speeds {
        self.speeds.get_or_init(|| Speeds::new(&self.samples))
    }

    /// RMS of the motor torque (N·m).
    pub fn rms_torque(&self, coefficients: &Coefficients) -> f64 {
        self.torque.norm(&coefficients.0) / self.duration.sqrt()
    }

    /// Calls `take`, in order, with the index of every sample at which the motor torque (N·m) exceeds `bound` in magnitude. The cost depends on these
    /// samples only.
    pub(crate) fn beyond(&self, coefficients: &Coefficients, bound: f64, take: impl FnMut(usize)) {
        self.stretches().beyond(coefficients, bound, take);
    }

    /// Samples, in order, of all panels for whose range of speeds (rad/s, at the gearbox output, without sign) `is_open` is true.
    pub(crate) fn at_speeds(&self, is_open: &impl Fn([f64; 2]) -> bool) -> Vec<usize> {
        self.stretches().at_speeds(is_open)
    }

    /// Calls `take` with every panel of the integrals, in order, and the motor's torque and speed over it; returns whether they are known.
    pub(crate) fn each_panel(
        &self,
        coefficients: &Coefficients,
        ratio: f64,
        mut take: impl FnMut(&Panel, &PanelPolynomial, &PanelPolynomial),
    ) -> bool {
        let stretches = self.stretches();
        let mut is_known = false;
        for range in self.smooth.panels(self.samples.len()) {
            if let Some(panel) = stretches.panel(range) {
                let torque = |k: usize| coefficients.torque(&self.samples[k].loads());
                let speed = |k: usize| self.samples[k].speed() * ratio;
                take(&panel, &panel.values(torque), &panel.values(speed));
                is_known = true;
            }
        }
        is_known
    }

    /// Integrals of functions with bends: see [`TorqueIntegrals`].
    pub(crate) fn bent<'c>(
        &'c self,
        coefficients: &'c Coefficients,
        ratio: f64,
    ) -> TorqueIntegrals<'c> {
        TorqueIntegrals::new(self.stretches(), coefficients, ratio)
    }

    /// Mean of the motor torque (N·m).
    pub fn mean_torque(&self, coefficients: &Coefficients) -> f64 {
        coefficients.torque(&self.mean_loads)
    }

    /// Least and largest motor torque (N·m), both with their sign.
    pub fn torque_extremes(&self, coefficients: &Coefficients) -> [f64; 2] {
        self.distinct().extremes(coefficients)
    }

    /// Largest magnitude of the motor torque (N·m).
    pub fn peak_torque(&self, coefficients: &Coefficients) -> f64 {
        self.distinct().largest_magnitude(coefficients)
    }

    /// Largest current of the motor (A) among the samples, with field weakening; NaN if the current of a torque is unknown.
    pub fn peak_current(
        &self,
        coefficients: &Coefficients,
        ratio: f64,
        motor: &MotorLimits,
    ) -> f64 {
        let current =
            |torque, speed| (motor.current(torque, speed)).map_or(f64::INFINITY, f64::abs);
        let most = (self.distinct()).largest_current(coefficients, ratio, current);
        if most.is_finite() { most } else { f64::NAN }
    }

    /// Energy supplied by the motor over a cycle and energy that flows back to it (J), both not negative.
    pub fn energies(&self, coefficients: &Coefficients, ratio: f64) -> [f64; 2] {
        self.stretches().energies(coefficients, ratio)
    }

    /// Whether energy flows back to the motor at any instant; cheaper than [`Cycle::energies`].
    pub fn regenerates(&self, coefficients: &Coefficients) -> bool {
        self.distinct().regenerates(coefficients, self.giving)
    }

    /// The instant closest to the peak-torque envelope, or furthest beyond it. Instants beyond the envelope's largest speed come first; without a
    /// limit it is the instant of the largest torque.
    pub fn peak(&self, coefficients: &Coefficients, ratio: f64, envelope: &Envelope) -> Peak {
        let peak = self.distinct().peak(coefficients, ratio, envelope);
        peak.unwrap_or(Peak {
            used: f64::NEG_INFINITY,
            torque: 0.0,
            speed: 0.0,
        })
    }

    /// Compares the peak with two shares of the envelope as far as bounds allow. It is much cheaper than [`Cycle::peak`], which settles the open
    /// cases.
    pub(crate) fn peak_against(
        &self,
        coefficients: &Coefficients,
        ratio: f64,
        envelope: &Envelope,
        shares: [f64; 2],
    ) -> PeakCheck {
        (self.distinct()).against(coefficients, ratio, envelope, shares)
    }

    fn stretches(&self) -> Stretches<'_> {
        Stretches {
            samples: &self.samples,
            tree: &self.tree,
            front: &self.front,
            smooth: &self.smooth,
            largest: &self.largest,
        }
    }

    /// The same without repeats, for results that depend on a single sample.
    fn distinct(&self) -> Stretches<'_> {
        let all = self.stretches();
        match &self.distinct {
            None => all,
            Some(Distinct { tree, front }) => Stretches { tree, front, ..all },
        }
    }

    /// Least and largest power of the motor (W): a pass over the samples.
    fn power_extremes(&self, coefficients: &Coefficients, ratio: f64) -> [f64; 2] {
        let power = |torque: f64, speed: f64| torque * speed;
        let of = |sample: &LoadSample| {
            power(coefficients.torque(&sample.loads()), sample.speed() * ratio)
        };
        let [mut least, mut largest] = [(0, f64::INFINITY), (0, f64::NEG_INFINITY)];
        for (k, sample) in self.samples.iter().enumerate() {
            let power = of(sample);
            if power < least.1 {
                least = (k, power);
            }
            if power > largest.1 {
                largest = (k, power);
            }
        }
        let stretches = self.stretches();
        let least_between = stretches.between(least.0, coefficients, ratio, |t, n| -power(t, n));
        let largest_between = stretches.between(largest.0, coefficients, ratio, power);
        [
            least_between.map_or(least.1, |peak| -peak.used),
            largest_between.map_or(largest.1, |peak| peak.used),
        ]
    }

    /// The duty at the motor of a drive. Only the extremes of the power take a pass over the samples.
    pub fn motor_duty(&self, drive: &Drive) -> MotorDuty {
        let (coefficients, ratio) = (drive.coefficients(), drive.ratio());
        let [least, largest] = self.torque_extremes(&coefficients);
        let [motoring_energy, regenerative_energy] = self.energies(&coefficients, ratio);
        let [least_power, largest_power] = self.power_extremes(&coefficients, ratio);
        let scale = 1.0 / (ratio * ratio);
        let gearbox = drive.inertia_ratio(0.0);
        let load = scale / drive.rotor();
        let inertia = self.inertia;
        // λ = g + s·J: its mean square is (g + s·mean)² + s²·(rms² − mean²).
        let spread = inertia.rms * inertia.rms - inertia.mean * inertia.mean;
        let mean = gearbox + load * inertia.mean;
        MotorDuty {
            torque: Figures {
                min: least,
                mean: self.mean_torque(&coefficients),
                max: largest,
                rms: self.rms_torque(&coefficients),
            },
            speed: Figures {
                min: self.speed.min * ratio,
                mean: self.speed.mean * ratio,
                max: self.speed.max * ratio,
                rms: self.speed.rms * ratio,
            },
            mean_speed: self.mean_speed * ratio,
            power: Figures {
                min: least_power,
                mean: (motoring_energy - regenerative_energy) / self.duration,
                max: largest_power,
                rms: self.power.norm(&coefficients.0) * ratio / self.duration.sqrt(),
            },
            motoring_energy,
            regenerative_energy,
            inertia_ratio: Figures {
                min: gearbox + load * inertia.min,
                mean,
                max: gearbox + load * inertia.max,
                rms: (mean * mean + load * load * spread.max(0.0)).sqrt(),
            },
        }
    }
}

/// The sample with the smallest value of a figure.
fn least(samples: &[LoadSample], figure: impl Fn(&LoadSample) -> f64) -> Option<usize> {
    let all = samples.iter().map(figure).enumerate();
    all.min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(index, _)| index)
}
