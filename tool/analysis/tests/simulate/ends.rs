//! The report of a run that is over contains only events up to then.

use std::f64::consts::TAU;

use jred_analysis::simulate::{SimulationError, SimulationResult, simulate};

use super::{J, turntable};
use crate::reading::{parse, rendered};
use crate::support::{budget, near};

fn found(text: &str) -> SimulationResult {
    let file = parse(text).unwrap();
    simulate(&file, file.simulation.as_ref().unwrap()).unwrap()
}

const FRICTION: &str = "[[load]]\non = \"shaft-1\"\nopposing_moment = \"2 N m\"\n";

/// 2 rad/s coast to rest under 2 N·m at J·ω/M; a moment that acts from 0.4 s to 0.5 s drives the machine on, and it comes to rest again.
#[test]
fn friction_holds_from_the_last_rest_on() {
    let coast = "start_speed = \"2 rad/s\"\ntorque = \"0 N m\"\noutput_step = \"10 ms\"";
    let run = |more: &str, duration: &str| {
        let motion = "[motion]\ntype = \"cycle\"\n[[motion.segment]]\ndwell = \"2 s\"\n";
        let simulation = format!("{coast}\nduration = \"{duration}\"");
        found(&turntable(
            &format!("{FRICTION}{more}{motion}"),
            &simulation,
        ))
    };
    let rest = run("", "1 s").held.unwrap();
    near("time", rest.time, J, budget::CLOSED_MOTION);
    near("way", rest.way, J, budget::CLOSED_MOTION);
    let push = "[[load]]\non = \"shaft-1\"\nmoment = \"3 N m\"\nduring = [\"0.4 s\", \"0.5 s\"]\n";
    // 1 N·m for 0.1 s, 2 N·m against it.
    let speed = 0.1 / J;
    let again = run(push, "1 s").held.unwrap();
    near(
        "time",
        again.time,
        0.5 + speed * J / 2.0,
        budget::CLOSED_MOTION,
    );
    let way = J + 0.05 * speed + 0.25 * speed * speed * J;
    near("way", again.way, way, budget::CLOSED_MOTION);
    assert!(run(push, "0.45 s").held.is_none(), "it moves at the end");
}

/// A controller is not a run-down, though friction holds the machine for a while, or to the end.
#[test]
fn a_controlled_machine_does_not_run_down() {
    for gain in ["0.1 N m s/rad", "0.001 N m s/rad"] {
        let simulation = format!(
            "start_speed = \"-2 rad/s\"\nduration = \"0.5 s\"\noutput_step = \"10 ms\"\ntorque = \"9 N m\"\n\
             control = {{ speed_gain = \"{gain}\", integral_time = \"100 ms\" }}"
        );
        let motion = "[motion]\ntype = \"constant-speed\"\nspeed = \"10 rad/s\"\n";
        let run = found(&turntable(&format!("{FRICTION}{motion}"), &simulation));
        let rests = run.states.iter().any(|[_, omega, _]| *omega == 0.0);
        assert!(rests && run.held.is_none(), "{gain}: {:?}", run.held);
    }
}

/// A constant moment does its work in each turn, in the direction of the turns; what the started turn does is not counted.
#[test]
fn the_works_of_whole_turns_are_counted() {
    for sign in [1.0, -1.0] {
        let load = "[[load]]\non = \"shaft-1\"\nmoment = \"0.5 N m\"\n";
        let simulation = format!(
            "start_speed = \"{:?} rad/s\"\nduration = \"1 s\"\noutput_step = \"0.5 s\"\ntorque = \"{:?} N m\"",
            20.0 * sign,
            0.25 * sign
        );
        let run = found(&turntable(load, &simulation));
        // φ = 20·t + ½·(0.75 or 0.25)/J·t² in the direction of motion.
        let alpha = (0.25 + 0.5 * sign) / J;
        let turns = ((20.0 + 0.5 * alpha) / TAU).floor();
        let turned = run.turned.unwrap();
        assert_eq!(turned.turns, sign * turns);
        let tight = budget::CLOSED_MOTION;
        near("motor", turned.motor, 0.25 * turns * TAU, tight);
        near("process", turned.process, 0.5 * sign * turns * TAU, tight);
        let kinetic = 0.5 * J * (400.0 + 2.0 * alpha * turns * TAU);
        near("kinetic", turned.kinetic, kinetic, tight);
    }
    // Less than a turn.
    let slow = turntable(
        "",
        "duration = \"0.1 s\"\noutput_step = \"0.1 s\"\ntorque = \"1 N m\"",
    );
    assert!(found(&slow).turned.is_none());
}

const SCREW: &str = r#"
gravity = { inclination = "0 deg" }
[mechanism]
type = "ball-screw"
lead = "10 mm"
stroke = ["0 mm", "400 mm"]
[mechanism.screw]
inertia = "5 kg cm^2"
[mechanism.nut]
mass = "100 kg"
[simulation]
start_angle = "0 deg"
duration = "3 s"
output_step = "0.5 s"
torque = "1 N m"
stop = { time = "2 s", brake_torque = "1 N m" }
"#;

/// A run that ends at the end of the stroke, before the motor is switched off.
#[test]
fn what_comes_after_the_end_has_not_happened() {
    let run = found(SCREW);
    assert_eq!((run.halted_at, run.rest), (None, None));
    let ended = run.ended;
    assert!(
        matches!(ended, Some(SimulationError::EndOfStroke { .. })),
        "{ended:?}"
    );
}

/// A position of what nothing prescribes; the cure names the section that is missing, or the key.
#[test]
fn a_start_position_needs_a_motion_of_something() {
    let position = SCREW.replace("start_angle = \"0 deg\"", "start_position = \"0 mm\"");
    // Where the stroke is given in lengths, it is the nut's.
    let at = parse(&position.replace("\"0 mm\"\n", "\"250 mm\"\n")).unwrap();
    let start = at.simulation.unwrap().start_angle;
    assert!((start - 25.0 * TAU).abs() < 1e-12, "{start}");
    let line = position.lines().find(|line| line.starts_with("stroke"));
    let report = rendered(&parse(&position.replace(line.unwrap(), "")).unwrap_err());
    let says = "`start_position` in [simulation] goes with [motion] `of = …`, and the file has no [motion]";
    assert!(report.replace('\n', " ").contains(says), "{report}");
    let motion = "[motion]\ntype = \"cycle\"\n[[motion.segment]]\ndwell = \"1 s\"\n[simulation]";
    let report = rendered(&parse(&position.replace("[simulation]", motion)).unwrap_err());
    assert!(report.contains("a [motion] without `of`"), "{report}");
    let of = motion.replace(
        "\"cycle\"",
        "\"cycle\"\nof = { point = \"nut\", along = \"x\" }",
    );
    assert!(parse(&position.replace("[simulation]", &of)).is_ok());
}

/// Zero everywhere has no place, and a screw has no crank.
#[test]
fn a_screw_without_mass_has_no_inertia_anywhere() {
    let none = SCREW
        .replace("5 kg cm^2", "0 kg cm^2")
        .replace("100 kg", "0 kg");
    let report = rendered(&parse(&none).unwrap_err());
    for says in [
        "is zero at every position",
        "give the screw a mass or an inertia",
    ] {
        assert!(report.contains(says), "{report}");
    }
    assert!(!report.contains("crank"), "{report}");
}
