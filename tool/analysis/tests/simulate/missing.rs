//! Motors that do not drive their machine on.

use std::f64::consts::PI;

use jred_analysis::simulate::{SimulationResult, simulate};

use super::pendulum::{WEIGHT, pendulum};
use super::turntable;
use crate::reading::parse;
use crate::support::{budget, edited, near, within};

fn found(text: &str) -> SimulationResult {
    let file = parse(text).unwrap();
    simulate(&file, file.simulation.as_ref().unwrap()).unwrap()
}

/// 2 N·m of friction at the output are 1 N·m at the drive link.
#[test]
fn a_motor_that_cannot_start_its_machine_is_short_of_the_friction() {
    let friction = "[[load]]\non = \"shaft-2\"\nopposing_moment = \"2 N m\"\n";
    let run = |torque: &str| {
        let motor = format!("duration = \"0.1 s\"\noutput_step = \"10 ms\"\ntorque = \"{torque}\"");
        found(&turntable(friction, &motor)).missing
    };
    for (torque, sign) in [("0.7 N m", 1.0), ("-0.7 N m", -1.0)] {
        let stuck = run(torque).unwrap();
        assert_eq!((stuck.time, stuck.missing.phi), (0.0, 0.0));
        near(
            "given",
            stuck.missing.given,
            0.7 * sign,
            budget::CLOSED_FORM,
        );
        near("needed", stuck.missing.needed, sign, budget::CLOSED_FORM);
    }
    assert_eq!(run("1.1 N m"), None);
    assert_eq!(run("0 N m"), None);
    // Until it is switched off; after that it drives nothing.
    let stopped = |time: &str| {
        let motor = format!(
            "duration = \"0.1 s\"\noutput_step = \"10 ms\"\ntorque = \"0.7 N m\"\nstop = {{ time = \"{time}\", brake_torque = \"3 N m\" }}"
        );
        found(&turntable(friction, &motor)).missing
    };
    assert_eq!(stopped("50 ms"), run("0.7 N m"));
    assert_eq!(stopped("0 s"), None);
}

/// A pendulum under a constant torque turns round where T·θ = m·g·a·(1 − cos θ), and m·g·a·sin θ − T is missing there.
#[test]
fn a_pendulum_under_too_small_a_torque_turns_round() {
    let swing = |torque: f64| {
        let hanging = "start_angle = \"-90 deg\"\nduration = \"3 s\"\noutput_step = \"10 ms\"";
        let text = pendulum("", hanging);
        found(&edited(&text, "0 N m", &format!("{torque} N m"))).missing
    };
    let torque = 1.0;
    let stuck = swing(torque).unwrap();
    let theta = stuck.missing.phi + 0.5 * PI;
    let most = budget::SWING * WEIGHT;
    within("energy", torque * theta, WEIGHT * (1.0 - theta.cos()), most);
    within("needed", stuck.missing.needed, WEIGHT * theta.sin(), most);
    assert!(stuck.missing.needed > torque && stuck.time > 0.3);
    // (1 − cos θ)/θ is 0.7246 at most: with 0.76 of its weight it goes round.
    assert_eq!(swing(1.5), None);
}
