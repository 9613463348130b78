//! Peaks between the samples and energies about a zero of the power, against closed forms.
//!
//! A rotor J with friction c + b·ω moves by the inclined sine, s = h·(z − sin(2πz)/2π): its torque is
//! c + B + A·sin(2πz) − B·cos(2πz) with A = 2π·J·h/T² and B = b·h/T, so its peak is c + B + √(A² + B²).

use std::f64::consts::{PI, TAU};
use std::path::Path;

use crate::support::machines::braked_rotor;
use crate::support::{budget, near};
use jred_machine::analysis::duty::Duty;
use jred_machine::read;
use jred_sizing::cycle::Cycle;
use jred_sizing::cycle::form::Coefficients;

/// Way (rad), time (s).
const WAY: f64 = 12.0;
const TIME: f64 = 0.5;
/// kg m², N m s/rad, N m.
const MACHINE: [f64; 3] = [0.02, 0.11, 3.0];
/// Of the motor: its rotor bends the course of the torque as the machine does, so that the peak lies elsewhere.
const MOTOR: [f64; 3] = [0.013, 0.04, 0.7];

/// No divisor of the samples' number is a peak's place.
const STEPS: usize = 302;

fn duty(steps: usize) -> Duty {
    let text = braked_rotor(r#"law = "cycloidal""#);
    let file = read::parse("rotor.toml", &text, Path::new("")).unwrap();
    Duty::new(&file, file.motion.as_ref().unwrap(), steps).unwrap()
}

/// A, B, c of the sums of these parts.
fn terms(parts: &[[f64; 3]]) -> [f64; 3] {
    let sum = |k: usize| parts.iter().map(|part| part[k]).sum::<f64>();
    [
        TAU * sum(0) * WAY / (TIME * TIME),
        sum(1) * WAY / TIME,
        sum(2),
    ]
}

fn extremes([a, b, c]: [f64; 3]) -> [f64; 2] {
    [c + b - a.hypot(b), c + b + a.hypot(b)]
}

/// At the input, and at a motor whose own inertia is in the torque.
#[test]
fn the_peak_is_that_between_the_samples() {
    let duty = duty(STEPS);
    let cycle = Cycle::new(&duty);
    let [least, most] = extremes(terms(&[MACHINE]));
    let figures = duty.figures(|i| i.input_torque);
    near("input, least", figures.min, least, budget::PEAK_BETWEEN);
    near("input, most", figures.max, most, budget::PEAK_BETWEEN);
    near(
        "output",
        cycle.peak_output_torque(),
        most,
        budget::PEAK_BETWEEN,
    );

    let [inertia, viscous, coulomb] = MOTOR;
    let coefficients = Coefficients([inertia, 1.0, 1.0, viscous, coulomb]);
    let [least, most] = extremes(terms(&[MACHINE, MOTOR]));
    let [found_least, found_most] = cycle.torque_extremes(&coefficients);
    near("motor, least", found_least, least, budget::PEAK_BETWEEN);
    near("motor, most", found_most, most, budget::PEAK_BETWEEN);
    let peak = cycle.peak_torque(&coefficients);
    near("motor, peak", peak, most, budget::PEAK_BETWEEN);
    // The samples alone do not have it.
    let torques = cycle
        .samples()
        .iter()
        .map(|s| coefficients.torque(&s.loads()));
    let sampled = torques.fold(0.0, f64::max);
    assert!(
        sampled < most * (1.0 - 100.0 * budget::PEAK_BETWEEN),
        "{sampled} of {most}"
    );
}

/// Without viscous friction the power changes its sign where A·sin(2πz) = −c: the work before is the energy there and what
/// friction took.
#[test]
fn energies_are_those_between_the_signs_of_the_power() {
    let inertia = 0.02;
    for coulomb in [0.0, 3.0, 5.0] {
        // The machine's viscous friction is taken back by the motor's.
        let coefficients = Coefficients([0.0, 1.0, 1.0, -0.11, coulomb - 3.0]);
        let [a, ..] = terms(&[[inertia, 0.0, 0.0]]);
        let late = (coulomb / a).asin() / TAU;
        let state = |z: f64| {
            let phi = WAY * (z - (TAU * z).sin() / TAU);
            let omega = WAY / TIME * 2.0 * (PI * z).sin().powi(2);
            (phi, 0.5 * inertia * omega * omega)
        };
        let (phi, energy) = state(0.5 + late);
        let (end, left) = state(1.0 - late);
        let regenerative = energy - left - coulomb * (end - phi);
        let motoring = regenerative + coulomb * WAY;
        for steps in [STEPS, STEPS + 2, 5 * STEPS] {
            let cycle = Cycle::new(&duty(steps));
            let found = cycle.energies(&coefficients, 1.0);
            let allowed = budget::ENERGY_BETWEEN * (STEPS as f64 / steps as f64).powi(3);
            near("motoring", found[0], motoring, allowed);
            near("regenerative", found[1], regenerative, allowed);
        }
    }
}
