//! Logs of the motor, with rotor and drive train.

use std::f64::consts::TAU;

use jred::mechanism::TrainOutput;
use jred_analysis::identify::{Fault, identify, of_motor, referred, without_drive};

use super::plant::{Encoder, Log, Plant, STEP, VARIED, errors, log, motion, press};

/// A press whose drive train loses a fifth.
fn lossy() -> Plant {
    let text = crate::reading::text_of("press.toml");
    let lossy = crate::support::edited(&text, "efficiency = \"97 %\"", "efficiency = \"80 %\"");
    let plant = Plant {
        file: crate::reading::parse(&lossy).unwrap(),
        ..press()
    };
    assert!((plant.file.drive_train.efficiency() - 0.8).abs() < 1e-12);
    plant
}

/// The log of a motor with a rotor (kg·m²), made from that of the drive link by the drive train's own torques.
fn motor_log(plant: &Plant, rotor: f64) -> Log {
    let train = &plant.file.drive_train;
    let ratio = train.ratio();
    let mut log = log(plant, Encoder::Fine, false, 4, 30.0);
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
    log
}

#[test]
fn a_log_of_the_motor_gives_the_machine_alone() {
    let plant = lossy();
    let ratio = plant.file.drive_train.ratio();
    // As much as the machine itself has.
    let rotor = 0.5 * plant.inertias()[0] / (ratio * ratio);
    let inertia = plant.file.train_inertia() + rotor * ratio * ratio;
    let mut log = motor_log(&plant, rotor);
    referred(&mut log.samples, &plant.file, rotor, 1e-3);
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

/// A rotor five times as heavy as the machine, and a torque that is 2 ms late: its losses are taken out when they were.
#[test]
fn a_heavy_rotor_is_taken_out_as_late_as_the_torque_is() {
    let plant = lossy();
    let inertias = plant.inertias();
    let mean = inertias.iter().sum::<f64>() / inertias.len() as f64;
    let rotor = 5.0 * mean / plant.file.drive_train.ratio().powi(2);
    let mut log = motor_log(&plant, rotor);
    log.samples.torque.rotate_right(1);
    let found = of_motor(&log.samples, &plant.file, rotor, &log.options).unwrap();
    let [inertia, inside, torque] = errors(&plant, &found);
    println!("{inertia} {torque} {inside} {:?}", found.delay);
    assert!((found.delay.value - 2e-3).abs() < 0.3e-3);
    assert!(inertia < 0.01 && torque < 0.02, "{inertia} {torque}");
    assert!(inside > 0.6, "{inside}");
}
