//! Random duties, drives and envelopes that are hard for shortcuts.

use std::sync::LazyLock;

use jred::machine::TorqueTerms;
use jred_analysis::duty::mechanics::Mechanics;
use jred_analysis::duty::{Duty, Instant, Smooth};
use jred_sizing::catalogue::Commutation;
use jred_sizing::catalogue::{Catalogue, Motor, Winding};
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::motor::envelope::Envelope;
use proptest::prelude::*;

/// A stretch of a motion: its course and its number of instants.
#[derive(Clone, Debug)]
enum Stretch {
    /// Sums of two harmonics each; a jump where it begins.
    Smooth([[f64; 4]; 3], usize),
    /// At rest under a constant torque.
    Rest(f64, usize),
    /// At constant speed under a constant torque.
    Steady([f64; 2], usize),
    /// Random values at each instant.
    Noise(Vec<[f64; 3]>),
    /// The torque nearly cancels that of accelerating `inertia`.
    Cancelling([f64; 4], f64, usize),
}

fn count() -> impl Strategy<Value = usize> {
    prop_oneof![4 => 1usize..40, 1 => 200usize..600]
}

fn stretch() -> impl Strategy<Value = Stretch> {
    let value = || -1.0..1.0f64;
    let harmonics = || prop::array::uniform4(-1.0..1.0f64);
    prop_oneof![
        4 => (prop::array::uniform3(harmonics()), count()).prop_map(|(h, n)| Stretch::Smooth(h, n)),
        1 => (value(), count()).prop_map(|(torque, n)| Stretch::Rest(torque, n)),
        1 => (prop::array::uniform2(value()), count()).prop_map(|(x, n)| Stretch::Steady(x, n)),
        1 => prop::collection::vec(prop::array::uniform3(value()), 1..60).prop_map(Stretch::Noise),
        2 => (harmonics(), value(), count()).prop_map(|(h, inertia, n)| Stretch::Cancelling(h, inertia, n)),
    ]
}

/// a₀ + a₁·sin(2πs) + a₂·cos(2πs) + a₃·sin(6πs).
fn wave(a: &[f64; 4], s: f64) -> f64 {
    let (sin, cos) = (std::f64::consts::TAU * s).sin_cos();
    a[0] + a[1] * sin + a[2] * cos + a[3] * (3.0 * std::f64::consts::TAU * s).sin()
}

impl Stretch {
    fn len(&self) -> usize {
        match self {
            Self::Smooth(_, n)
            | Self::Rest(_, n)
            | Self::Steady(_, n)
            | Self::Cancelling(_, _, n) => *n,
            Self::Noise(values) => values.len(),
        }
    }

    /// Acceleration, torque, speed of the instant k.
    fn at(&self, k: usize) -> [f64; 3] {
        let s = k as f64 / self.len() as f64;
        match self {
            Self::Smooth(waves, _) => [wave(&waves[0], s), wave(&waves[1], s), wave(&waves[2], s)],
            Self::Rest(torque, _) => [0.0, *torque, 0.0],
            Self::Steady([torque, speed], _) => [0.0, *torque, *speed],
            Self::Noise(values) => values[k],
            Self::Cancelling(a, inertia, _) => {
                let alpha = wave(a, s);
                [
                    alpha,
                    -inertia * alpha + 1e-9 * (40.0 * s).sin(),
                    wave(a, s + 0.25),
                ]
            }
        }
    }
}

/// A duty of up to eight stretches, in scales from 1e-3 to 1e3.
pub(crate) fn duty() -> impl Strategy<Value = Duty> {
    let scales = prop::array::uniform3(-3.0..3.0f64);
    let weights = prop::collection::vec(prop_oneof![1 => Just(0.0), 5 => 1e-4..1e-2f64], 1..9);
    (prop::collection::vec(stretch(), 1..8), scales, weights).prop_map(
        |(stretches, scales, weights)| {
            let [of_alpha, of_torque, of_speed] = scales.map(|x| 10f64.powf(x));
            let mut instants = Vec::new();
            let mut t = 0.0;
            for stretch in &stretches {
                for k in 0..stretch.len() {
                    let [alpha, torque, speed] = stretch.at(k);
                    let weight = weights[instants.len() % weights.len()];
                    // Some instants have no weight, and some share their time with the one before.
                    t += if k % 7 == 3 { 0.0 } else { weight + 1e-4 };
                    instants.push(instant(
                        t,
                        weight,
                        [alpha * of_alpha, torque * of_torque, speed * of_speed],
                    ));
                }
            }
            let duration = t + 1e-3;
            Duty {
                instants,
                duration,
                hold_torque: 0.5 * of_torque,
                mechanics: Mechanics::default(),
                // Peaks and energies of the samples only.
                smooth: Smooth::default(),
            }
        },
    )
}

fn instant(t: f64, weight: f64, [alpha, torque, speed]: [f64; 3]) -> Instant {
    Instant {
        t,
        weight,
        phi: 0.0,
        omega: speed,
        alpha,
        direction: speed,
        inertia: 1.0,
        joint_friction: 0.0,
        terms: TorqueTerms::default(),
        input_torque: torque,
        input_speed: speed,
        input_alpha: alpha,
        input_inertia: 1.0 + 0.5 * t.sin(),
    }
}

/// Coefficients of a drive, each over several decades, some zero, that for regenerated power of either sign.
pub(crate) fn coefficients() -> impl Strategy<Value = Coefficients> {
    let size = || prop_oneof![1 => Just(0.0), 4 => (-4.0..2.0f64).prop_map(|x| 10f64.powf(x))];
    let back = -1.0..1.0f64;
    (
        size(),
        (-3.0..1.0f64).prop_map(|x| 10f64.powf(x)),
        back,
        size(),
        size(),
    )
        .prop_map(|(inertia, driving, back, viscous, coulomb)| {
            Coefficients([inertia, driving, back * driving, viscous, coulomb])
        })
}

/// An envelope from the data sheet's corner, from points (falling, curved either way) or from a winding.
pub(crate) fn envelope() -> impl Strategy<Value = Envelope> {
    let corner = (0.1..1.0f64, 0.1..1.0f64, 0.01..1.0f64, 0.1..3.0f64).prop_map(
        |(rated, corner, torque, peak)| {
            let mut motor = bare();
            motor.max_speed = Some(100.0);
            motor.rated_speed = Some(rated * 100.0);
            motor.rated_torque = Some(0.1 * peak);
            motor.corner_speed = Some(corner * 100.0);
            motor.peak_torque = Some(peak);
            motor.torque_at_max_speed = Some(peak * torque);
            motor
        },
    );
    let points = prop::collection::vec((0.01..1.0f64, 0.0..1.0f64), 1..6).prop_map(|steps| {
        let mut motor = bare();
        let (mut speed, mut torque) = (0.0, 4.0);
        motor.peak_curve = vec![[speed, torque]];
        for (step, drop) in steps {
            speed += 40.0 * step;
            torque *= 1.0 - 0.7 * drop;
            motor.peak_curve.push([speed, torque]);
        }
        motor.max_speed = Some(speed);
        motor
    });
    let winding = (0.01..1.0f64, 0.0..0.02f64, 1.0..5.0f64, any::<bool>()).prop_map(
        |(resistance, inductance, current, block)| {
            let mut motor = bare();
            motor.bus_voltage = Some(48.0);
            motor.winding = Winding {
                torque_constant: Some(0.2),
                voltage_constant: Some(if block { 0.2 } else { 0.2 / 3f64.sqrt() }),
                resistance: Some(resistance),
                inductance: Some(inductance),
                pole_pairs: Some(4.0),
                peak_current: Some(20.0 * current),
                commutation: if block {
                    Commutation::Block
                } else {
                    Commutation::Sine
                },
                ..Winding::default()
            };
            motor
        },
    );
    prop_oneof![2 => corner.boxed(), 2 => points.boxed(), 2 => winding.boxed(), 1 => Just(bare()).boxed()]
        .prop_map(|motor| Envelope::of(&motor))
}

/// A motor without data.
fn bare() -> Motor {
    static CATALOGUE: LazyLock<Catalogue> = LazyLock::new(|| Catalogue::load(None, None).unwrap());
    let mut motor = CATALOGUE.motors[0].clone();
    motor.rated_torque = None;
    motor.rated_speed = None;
    motor.standstill_torque = None;
    motor.peak_torque = None;
    motor.max_speed = None;
    motor.max_power = None;
    motor.corner_speed = None;
    motor.torque_at_max_speed = None;
    motor.peak_curve = Vec::new();
    motor.continuous_curve = Vec::new();
    motor.winding = Winding::default();
    motor
}
