//! What turns the rotation of a motor into the displacement of a drive link, up to the sized drive.

use jred::mechanism::TrainOutput;
use std::f64::consts::TAU;

use jred::Reducible as _;

use super::{machine_path, read, within};
use crate::linkage_file::strokes::{LIFT, MOTION, boom};
use crate::support::{Folder, jred};

pub(crate) const SCREW: &str = r#"
[[drive_train]]
type = "belt"
driver = { radius = "30 mm", inertia = "2 kg cm^2" }
driven = { radius = "60 mm", inertia = "12 kg cm^2" }

[[drive_train]]
type = "ball-screw"
lead = "10 mm"
inertia = "6 kg cm^2"
mass = "4 kg"
efficiency = "90 %"
"#;

#[test]
fn a_ball_screw_lets_a_motor_turn() {
    let text = format!("{LIFT}{SCREW}{MOTION}");
    let file = read(&text);
    let train = &file.drive_train;
    within(train.ratio(), 2.0 * TAU / 0.01, 1e-9);
    // What turns and slides, as a mass at the rod: the screw's 6 kg cm² alone are 237 kg.
    let turns = TAU / 0.01;
    let mass = 4.0 + (6e-4 + 12e-4) * turns * turns + 2e-4 * (2.0 * turns).powi(2);
    let whole = file.with_drive_train().unwrap();
    let bare = file.machine.reduction(0.6).unwrap().inertia[0];
    within(whole.reduction(0.6).unwrap().inertia[0] - bare, mass, 1e-8);
    // Statically, T·2π·η = F·lead.
    let [slope, cos] = boom(0.6);
    let force = 100.0 * 9.81 * 0.8 * cos * slope;
    let input = train.input(&TrainOutput {
        torque: force,
        ..TrainOutput::default()
    });
    within(input.torque, force * 0.01 / (TAU * 0.9) / 2.0, 1e-12);

    let folder = Folder::new();
    let sized = jred([&"size", &folder.file("lift.toml", &text)]);
    assert!(sized.code < 2, "{}", sized.err);
    let direct = jred([
        &"size",
        &folder.file("direct.toml", format!("{LIFT}{MOTION}")),
    ])
    .ends(2);
    assert!(
        direct
            .message()
            .contains("the drive link slides, but the catalogue contains rotary motors only"),
        "{}",
        direct.message()
    );
    let file = folder.file("lift.toml", &text);
    let out = folder.path("table.bin");
    let exported = jred([&"export", &file, &"--out", &out, &"--torque-error", &"5 N"]);
    assert!(
        exported.code < 2 && (exported.code == 1 || exported.out.contains("force error reached")),
        "{} {}",
        exported.out,
        exported.err
    );
}

#[test]
fn the_excavator_is_sized() {
    let path = machine_path("excavator-bucket.toml");
    jred([&"reduce", &path]).ends(0);
    let run = jred([&"size", &path]);
    assert!(run.code < 2, "{}", run.err);
    jred([&"simulate", &path]).ends(0);
    for name in [
        "linkage-four-bar.toml",
        "linkage-press.toml",
        "linkage-planetary.toml",
    ] {
        jred([&"size", &machine_path(name)]).ends(0);
    }
}
