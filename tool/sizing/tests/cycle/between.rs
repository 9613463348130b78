//! Peaks between the samples, and energies and losses at bends, against closed forms.
//!
//! A rotor J with friction c + b·ω moves by the inclined sine, s = h·(z − sin(2πz)/2π): its torque is c + B + A·sin(2πz) − B·cos(2πz) with A =
//! 2π·J·h/T² and B = b·h/T, so its peak is c + B + √(A² + B²).

use std::f64::consts::{PI, TAU};
use std::path::Path;

use crate::support::machines::braked_rotor;
use crate::support::{budget, near, within};
use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_sizing::cycle::Cycle;
use jred_sizing::cycle::form::Coefficients;

/// Distance (rad), time (s).
const WAY: f64 = 12.0;
const TIME: f64 = 0.5;
/// kg m², N m s/rad, N m.
const MACHINE: [f64; 3] = [0.02, 0.11, 3.0];
/// The motor: its rotor shifts the peak of the torque.
const MOTOR: [f64; 3] = [0.013, 0.04, 0.7];

/// With this number of steps no sample is at a peak.
const STEPS: usize = 302;

fn duty(steps: usize) -> Duty {
    let text = braked_rotor(r#"law = "cycloidal""#);
    let file = checked::parse("rotor.toml", &text, Path::new("")).unwrap();
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

/// At the input, and at a motor whose own inertia is part of the torque.
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
    // The samples alone miss it.
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

/// Without viscous friction the power changes its sign where A·sin(2πz) = −c: the work until then is the kinetic energy there plus the friction loss.
#[test]
fn energies_are_those_between_the_signs_of_the_power() {
    let inertia = 0.02;
    for coulomb in [0.0, 3.0, 5.0] {
        // The motor's viscous friction cancels the machine's.
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
        for steps in [16, STEPS, 5 * STEPS] {
            let cycle = Cycle::new(&duty(steps));
            let found = cycle.energies(&coefficients, 1.0);
            let allowed = budget::DUTY * motoring;
            within("motoring", found[0], motoring, allowed);
            within("regenerative", found[1], regenerative, allowed);
        }
    }
}

/// An unbalanced drum over a hundred turns: the delivered energy is regenerated, twice the largest torque per turn.
#[test]
fn a_drum_gives_back_what_it_takes() {
    let text = "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = { diameter = \"500 mm\", mass = \"20 kg\" }\n\
                [[mass]]\non = \"table\"\nmass = \"3 kg\"\nat = [\"200 mm\", \"0 mm\"]\n[motion]\ntype = \"cycle\"\n[[motion.segment]]\n\
                law = \"constant-speed\"\nmove = \"36000 deg\"\nspeed = \"600 rpm\"\n";
    let file = checked::parse("drum.toml", text, Path::new("")).unwrap();
    let most = 3.0 * 9.81 * 0.2;
    for steps in [16, 2000] {
        let duty = Duty::new(&file, file.motion.as_ref().unwrap(), steps).unwrap();
        let cycle = Cycle::new(&duty);
        // With friction at the motor the power changes sign at sin φ = −c/most.
        for coulomb in [0.0, 1.5] {
            let coefficients = Coefficients([0.0, 1.0, 1.0, 0.0, coulomb]);
            let [motoring, regenerative] = cycle.energies(&coefficients, 1.0);
            let share = coulomb / most;
            // ∫max(sin φ + s, 0) dφ over a turn, and that of the other sign.
            let back = 2.0 * ((1.0 - share * share).sqrt() - share * share.acos());
            let [taken, given] = [back + TAU * share, back].map(|x| 100.0 * most * x);
            within("taken", motoring, taken, budget::DUTY * taken);
            within("given", regenerative, given, budget::DUTY * taken);
            near(
                "mean",
                cycle.mean_torque(&coefficients) + most,
                coulomb + most,
                budget::DUTY,
            );
            let rms = (0.5 * most * most + coulomb * coulomb).sqrt();
            near("RMS", cycle.rms_torque(&coefficients), rms, budget::DUTY);
            near(
                "peak",
                cycle.peak_torque(&coefficients),
                most + coulomb,
                budget::DUTY,
            );
        }
        // The bearings' mean: ⟨|sin|^(10/3)⟩ = Γ(13/6)/(√π·Γ(8/3)).
        let mean = cycle.mean_output_torque(10.0 / 3.0);
        let exact =
            most * (1.082_339_222_568_379_f64 / (PI.sqrt() * 1.504_575_488_251_556_3)).powf(0.3);
        near("bearings", mean, exact, 1e-9);
    }
}

/// Of equal turns one is searched, and a differing turn is found: a moment of 5 N m in the last turn, or for a quarter of a turn while the weight's
/// torque is largest, in the middle of a hundred turns of 0.1 s.
#[test]
fn the_one_turn_that_differs_has_the_peak() {
    let most = 3.0 * 9.81 * 0.2;
    for (when, extra) in [
        ("", 0.0),
        ("segments = [2]", 5.0),
        ("during = [\"9.99 s\", \"10.01 s\"]", 5.0),
        ("during = [\"5.0875 s\", \"5.1125 s\"]", 5.0),
    ] {
        let load = if when.is_empty() {
            String::new()
        } else {
            format!("[[load]]\non = \"table\"\nmoment = \"-5 N m\"\n{when}\n")
        };
        let text = format!(
            "gravity = [\"0 m/s^2\", \"-9.81 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\ntable = {{ diameter = \"500 mm\", mass = \"20 kg\" }}\n\
             [[mass]]\non = \"table\"\nmass = \"3 kg\"\nat = [\"200 mm\", \"0 mm\"]\n{load}[motion]\ntype = \"cycle\"\n\
             [[motion.segment]]\nlaw = \"constant-speed\"\nmove = \"36000 deg\"\nspeed = \"600 rpm\"\n\
             [[motion.segment]]\nlaw = \"constant-speed\"\nmove = \"360 deg\"\nspeed = \"600 rpm\"\n"
        );
        let file = checked::parse("drum.toml", &text, Path::new("")).unwrap();
        for steps in [16, 2000] {
            let duty = Duty::new(&file, file.motion.as_ref().unwrap(), steps).unwrap();
            let cycle = Cycle::new(&duty);
            let drive = Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]);
            let [least, largest] = cycle.torque_extremes(&drive);
            near("least", least, -most, budget::DUTY);
            near("largest", largest, most + extra, budget::DUTY);
            near(
                "peak",
                cycle.peak_torque(&drive),
                most + extra,
                budget::DUTY,
            );
            // A drive whose friction exceeds the weight regenerates nowhere, one without friction wherever the weight falls.
            for (coulomb, back) in [(0.999 * most, true), (1.001 * most, false)] {
                let drive = Coefficients([0.0, 1.0, 1.0, 0.0, coulomb]);
                assert_eq!(cycle.regenerates(&drive), back, "{when} {coulomb}");
            }
        }
    }
}
