//! The largest forces of a motion, between the rows of a listing, against closed forms.

use std::path::Path;

use crate::reader;
use crate::support::machines::braked_rotor;
use crate::support::{budget, near};
use jred_analysis::duty::Duty;
use jred_analysis::reduce::{Over, Request, Sets, largest};

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
    let file = reader::parse("rotor.toml", &text, Path::new("")).unwrap();
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

/// Of peaks that are nearly as high as each other, the highest is found, wherever the steps lie.
#[test]
fn the_highest_of_many_peaks() {
    use std::f64::consts::TAU;
    let times = [0.5, 0.37, 0.613, 0.4441, 0.531];
    for highest in 0..times.len() {
        // By the formula of a_peak_between_rows, the way that gives the wanted peak.
        let peak = |k: usize| if k == highest { 20.0 + 1e-6 } else { 20.0 };
        let moves = times.iter().enumerate().map(|(k, time)| {
            let way = (peak(k) - 3.0)
                / (0.11 / time + (TAU * 0.02 / (time * time)).hypot(0.11 / time));
            format!(
                "[[motion.segment]]\nlaw = \"cycloidal\"\nmove = \"{way} rad\"\nduration = \"{time} s\"\n"
            )
        });
        let text = braked_rotor(r#"law = "cycloidal""#);
        let (machine, _) = text.split_once("[[motion.segment]]").unwrap();
        let text = machine.to_owned() + &moves.collect::<String>();
        let file = reader::parse("rotor.toml", &text, Path::new("")).unwrap();
        let found = largest(&file, &request(Over::Time)).unwrap();
        near(
            "force",
            found[0].value,
            peak(highest),
            budget::LARGEST_FORCE,
        );
        for steps in [50, 250, 2000] {
            let duty = Duty::new(&file, file.motion.as_ref().unwrap(), steps).unwrap();
            let most = duty.figures(|i| i.input_torque).max;
            near("torque", most, peak(highest), budget::LARGEST_FORCE);
        }
    }
}
