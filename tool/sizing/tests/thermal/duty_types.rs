//! The duty type of a cycle, one machine for each row of the table.

use std::path::Path;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_sizing::cycle::Cycle;
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::thermal::classify::{DutyType, Features};

use super::budget;
use super::within;
use crate::support::press_text;

/// A flywheel on a shaft with friction, an opposing load, and a motion.
fn machine(load: &str, motion: &str) -> Cycle {
    let text = format!(
        r#"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "gear-train"
flywheel = "0.02 kg m^2"
stage = [{{ driver = {{ teeth = 20, inertia = "0.001 kg m^2" }}, driven = {{ teeth = 40, inertia = "0.002 kg m^2" }} }}]
[[load]]
on = "shaft-1"
{load}
[motion]
{motion}
"#
    );
    Cycle::new(&duty_of(&text))
}

fn duty_of(text: &str) -> Duty {
    let file = checked::parse("machine.toml", text, Path::new("")).unwrap();
    Duty::new(&file, file.motion.as_ref().unwrap(), 800).unwrap()
}

fn kind(load: &str, motion: &str) -> DutyType {
    let direct = Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]);
    let features = Features::of(&machine(load, motion), &direct, 1.0);
    features.duty_type()
}

const FRICTION: &str = "opposing_moment = \"2 N m\"";
/// Enough friction that the machine never drives its motor.
const MUCH_FRICTION: &str = "opposing_moment = \"900 N m\"";
const STEADY: &str = "type = \"constant-speed\"\nspeed = \"300 rpm\"";

fn moves(segments: &[&str]) -> String {
    let head = "type = \"cycle\"\nstart = \"0 deg\"";
    let segments = segments.join("\n[[motion.segment]]\n");
    format!("{head}\n[[motion.segment]]\n{segments}\n")
}

const TURN: &str = "law = \"polynomial-345\"\nmove = \"360 deg\"\nduration = \"0.3 s\"";
const BACK: &str = "law = \"polynomial-345\"\nmove = \"-360 deg\"\nduration = \"0.3 s\"";
const DWELL: &str = "dwell = \"0.1 s\"";

#[test]
fn each_type() {
    let window =
        "opposing_moment = \"2 N m\"\nbetween = [\"20 deg\", \"90 deg\"]\nramp = \"10 deg\"";
    for (number, load, motion) in [
        (1, FRICTION, STEADY.to_owned()),
        (4, MUCH_FRICTION, moves(&[TURN, DWELL])),
        (5, FRICTION, moves(&[TURN, DWELL])),
        (6, window, STEADY.to_owned()),
        (7, FRICTION, moves(&[TURN, BACK])),
        (8, MUCH_FRICTION, moves(&[TURN])),
    ] {
        let found = kind(load, &motion);
        assert_eq!(found.number, number, "{found}: {found:?}");
        assert!(found.to_string().contains(&format!("S{number}")), "{found}");
    }
}

/// A long run at constant speed between short ramps: the starts have no thermal effect. A speed that oscillates between 0.5 and 1.5 times its mean
/// never stops, though it brakes: S8. One that goes down to almost zero does: S7.
#[test]
fn a_speed_that_swings_does_not_stop() {
    let direct = Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]);
    for (swing, number) in [(0.5, 8), (1.0 - 1e-9, 7)] {
        let mut duty = duty_of(&press_text());
        let duration = duty.duration;
        for instant in &mut duty.instants {
            let turn = std::f64::consts::TAU * instant.t / duration;
            instant.input_speed = 30.0 * (1.0 - swing * turn.cos());
            instant.input_torque = 10.0 * turn.sin();
        }
        let found = Features::of(&Cycle::new(&duty), &direct, 1.0);
        assert_eq!(found.stops, swing > 0.9, "{swing}");
        assert_eq!(found.duty_type().number, number, "{swing}");
        // With a gearbox all speeds scale.
        for ratio in [-1e4, 1e-4, 1e4] {
            let geared = Features::of(&Cycle::new(&duty), &direct, ratio);
            assert_eq!(geared.stops, found.stops, "{swing} {ratio}");
        }
    }
}

#[test]
fn starts_that_do_not_count() {
    let long = "law = \"trapezoid\"\naccelerate = \"0.5 %\"\ndecelerate = \"0.5 %\"\nmove = \"36000 deg\"\nduration = \"60 s\"";
    let found = kind(MUCH_FRICTION, &moves(&[long, "dwell = \"20 s\""]));
    assert_eq!(found.number, 3, "{found:?}");
    assert_eq!(found.features.starts, 1);
    let words = "duty type S3, at rest 25 % of the time, starts thermally negligible";
    assert_eq!(found.to_string(), words);
    within("rest", found.features.rest, 0.25, budget::SIMPSON);
}

#[test]
fn features_are_counted() {
    let two = kind(FRICTION, &moves(&[TURN, DWELL, TURN, DWELL]));
    assert_eq!(two.features.starts, 2);
    within("rest", two.features.rest, 0.25, budget::SIMPSON);
    let words = two.to_string();
    for part in ["S5", "2 starts", "25 %", "with electric braking"] {
        assert!(words.contains(part), "{part} is not in {words}");
    }
}

/// A rotor with friction c, accelerated for a quarter of the time and decelerated for another: their share of ∫T² is (T₁² + T₂²)/(T₁² + 2c² + T₂²)
/// with T₁ = c + J·α and T₂ = c − J·α.
#[test]
fn the_share_of_the_acceleration_is_in_closed_form() {
    let quarters = "law = \"trapezoid\"\naccelerate = \"25 %\"\ndecelerate = \"25 %\"\nmove = \"360 deg\"\nduration = \"0.3 s\"";
    let found = kind(FRICTION, &moves(&[quarters, DWELL])).features;
    let alpha = std::f64::consts::TAU / (0.3 * 0.75) / 0.075;
    let inertia = 0.02 + 0.001 + 0.002 / 4.0;
    let [first, last] = [1.0, -1.0].map(|sign| (2.0 + sign * inertia * alpha).powi(2));
    let share = (first + last) / (first + 2.0 * 4.0 + last);
    assert!((0.5..0.97).contains(&share), "{share}");
    // The ends of a quarter may be on either side.
    within("share", found.accelerating, share, 0.01);
    within("rest", found.rest, 0.25, budget::SIMPSON);
}

/// A speed that changes its sign stops in between, though no instant is at rest.
#[test]
fn a_reversal_is_a_stop() {
    let direct = Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]);
    for (back, stops) in [(-20.0, true), (20.0, false)] {
        let mut duty = duty_of(&press_text());
        let half = 0.5 * duty.duration;
        for instant in &mut duty.instants {
            instant.input_speed = if instant.t < half { 30.0 } else { back };
        }
        let cycle = Cycle::new(&duty);
        assert_eq!(Features::of(&cycle, &direct, 1.0).stops, stops, "{back}");
        assert_eq!(Features::of(&cycle, &direct, -1.0).stops, stops, "{back}");
    }
}

/// A motor brakes if its torque opposes its speed, however small the torque, in either direction.
#[test]
fn braking_is_torque_against_speed() {
    let direct = Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]);
    for (speed, torque, brakes) in [
        (300.0, [2.0, -1.0], true),
        (300.0, [2.0, 1.0], false),
        (-300.0, [-2.0, 1.0], true),
        (-300.0, [-2.0, -1.0], false),
        (0.5, [20.0, -10.0], true),
    ] {
        let mut duty = duty_of(&press_text());
        let half = 0.5 * duty.duration;
        for instant in &mut duty.instants {
            instant.input_speed = speed;
            instant.input_torque = torque[usize::from(instant.t > half)];
        }
        let found = Features::of(&Cycle::new(&duty), &direct, 1.0);
        assert_eq!(found.braking, brakes, "{torque:?} at {speed}");
    }
}
