//! The largest forces of a motion, between the rows of a listing, against closed forms.

use std::path::Path;

use crate::support::machines::braked_rotor;
use crate::support::{budget, near};
use jred_machine::analysis::reduce::{Over, Request, Sets, largest};
use jred_machine::read;

const WAY: f64 = 12.0;
const TIME: f64 = 0.5;

fn request(over: Over) -> Request {
    Request {
        over,
        positions: 12,
        sets: Sets::default(),
        state: None,
    }
}

/// The largest drive torque of a rotor that moves by a law, and its time.
fn drive_torque(law: &str) -> (f64, f64) {
    let text = braked_rotor(law);
    let file = read::parse("rotor.toml", &text, Path::new("")).unwrap();
    let found = largest(&file, &request(Over::Time)).unwrap();
    let drive = &found[0];
    assert!(
        drive.quantity.name.contains("drive"),
        "{}",
        drive.sentence()
    );
    (drive.value, drive.at)
}

/// c + B + A·sin(2πz) − B·cos(2πz): largest at tan(2πz) = −A/B.
#[test]
fn a_peak_between_rows() {
    let (value, at) = drive_torque(r#"law = "cycloidal""#);
    let a = std::f64::consts::TAU * 0.02 * WAY / (TIME * TIME);
    let b = 0.11 * WAY / TIME;
    near("torque", value, 3.0 + b + a.hypot(b), budget::LARGEST_FORCE);
    let angle = std::f64::consts::PI - (a / b).atan();
    let expected = TIME * angle / std::f64::consts::TAU;
    near("time", at, expected, budget::LARGEST_FORCE.sqrt());
}

/// Where the acceleration ends the speed is largest, and the acceleration jumps: no row need be there.
#[test]
fn a_peak_at_a_jump() {
    let (value, at) = drive_torque("law = \"trapezoid\"\naccelerate = 0.237\ndecelerate = 0.311");
    let speed = WAY / TIME / (1.0 - f64::midpoint(0.237, 0.311));
    let expected = 3.0 + 0.11 * speed + 0.02 * speed / (0.237 * TIME);
    near("torque", value, expected, budget::LARGEST_AT_JUMP);
    near("time", at, 0.237 * TIME, budget::LARGEST_AT_JUMP);
}
