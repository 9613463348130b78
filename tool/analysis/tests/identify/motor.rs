//! Logs of the motor, with rotor and drive train.

use std::f64::consts::TAU;

use jred::mechanism::TrainOutput;
use jred_analysis::identify::{Fault, identify, referred, without_drive};

use super::plant::{Encoder, Plant, STEP, VARIED, errors, log, motion, press};

/// The log of a motor with a rotor behind a drive train with losses, made from that of the drive link by the drive train's own torques.
#[test]
fn a_log_of_the_motor_gives_the_machine_alone() {
    let text = crate::reading::text_of("press.toml");
    let lossy = crate::support::edited(&text, "efficiency = \"97 %\"", "efficiency = \"80 %\"");
    let plant = Plant {
        file: crate::reading::parse(&lossy).unwrap(),
        ..press()
    };
    let train = &plant.file.drive_train;
    let ratio = train.ratio();
    assert!((train.efficiency() - 0.8).abs() < 1e-12);
    // As much as the machine itself has.
    let rotor = 0.5 * plant.inertias()[0] / (ratio * ratio);
    let inertia = plant.file.train_inertia() + rotor * ratio * ratio;
    let mut log = log(&plant, Encoder::Fine, false, 4, 30.0);
    for (k, torque) in log.samples.torque.iter_mut().enumerate() {
        let [_, omega, alpha] = motion((k as f64 - 1.0) * STEP, &VARIED, 1.5 * TAU, TAU / 2.0);
        let output = TrainOutput {
            torque: *torque,
            omega,
            alpha,
            direction: omega,
            ..TrainOutput::default()
        };
        *torque = train.input(&output).torque + rotor * ratio * alpha;
    }
    for position in &mut log.samples.position {
        *position *= ratio;
    }
    referred(&mut log.samples, &plant.file, rotor);
    let mut found = identify(&log.samples, &log.options).unwrap();
    let [with, ..] = errors(&plant, &found);
    let (mut heavy, least) = (found.clone(), plant.inertias());
    // A rotor as heavy as the whole log, and a little more than the smallest J.
    let taken = least.iter().copied().fold(f64::MAX, f64::min) + inertia;
    without_drive(&mut heavy, &plant.file, 1.02 * taken / (ratio * ratio));
    let [Fault::NotPositive { at, inertia: below }] = heavy.faults[..] else {
        panic!("{:?}", heavy.faults);
    };
    let exact = plant.at(at, 0.0)[0];
    let removed = plant.file.train_inertia() + 1.02 * taken;
    assert!(below < 0.0 && (below - (exact + inertia - removed)).abs() < 0.01 * taken);
    assert!(heavy.excitation.band > found.excitation.band);
    assert!(with > 0.03, "{with}");
    without_drive(&mut found, &plant.file, rotor);
    let [inertia, inside, torque] = errors(&plant, &found);
    assert!(inertia < 0.01 && torque < 0.02, "{inertia} {torque}");
    assert!(inside > 0.6, "{inside}");
}
