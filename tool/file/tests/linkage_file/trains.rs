//! Transmissions from the rotation of a motor to the displacement of a drive link, up to the sized drive.

use std::f64::consts::TAU;

use jred::machine::Reducible as _;
use jred::mechanism::TrainOutput;

use super::{close, read};
use crate::linkage_file::strokes::boom;
use crate::support::machines::{LIFT, LIFT_MOTION, SCREW};

#[test]
fn a_ball_screw_lets_a_motor_turn() {
    let text = format!("{LIFT}{SCREW}{LIFT_MOTION}");
    let file = read(&text);
    let train = &file.drive_train;
    close(train.ratio(), 2.0 * TAU / 0.01, 1e-9);
    // All rotating and sliding parts as a mass at the rod: the screw's 6 kg cm² alone are 237 kg.
    let turns = TAU / 0.01;
    let mass = 4.0 + (6e-4 + 12e-4) * turns * turns + 2e-4 * (2.0 * turns).powi(2);
    let whole = file.with_drive_train().unwrap();
    let bare = file.machine.reduction(0.6).unwrap().inertia;
    close(whole.reduction(0.6).unwrap().inertia - bare, mass, 1e-8);
    // Statically, T·2π·η = F·lead.
    let [slope, cos] = boom(0.6);
    let force = 100.0 * 9.81 * 0.8 * cos * slope;
    let input = train.input(&TrainOutput {
        torque: force,
        ..TrainOutput::default()
    });
    close(input.torque, force * 0.01 / (TAU * 0.9) / 2.0, 1e-12);
}
