//! Cycles that the process drives, of several turns, and for a prescribed mean speed, against closed forms.

use std::f64::consts::TAU;

use jred_analysis::steady::{Level, MeanSpeed, Steady, SteadyError, SteadyRequest, steady};

use super::{checked, rotor};
use crate::reading::parse;
use crate::support::near;

fn asked(text: &str, request: &SteadyRequest) -> Result<Steady, SteadyError> {
    let file = parse(text).unwrap();
    steady(&file, file.simulation.as_ref().unwrap(), request)
}

fn mean_speed(speed: f64, by: Level) -> MeanSpeed {
    MeanSpeed { speed, by }
}

/// A moment of 40 N m over 140° of two turns (half of each ramp counts), on a rotor of 0.4 kg m².
const STROKE: &str = "[[load]]\nname = \"gas\"\non = \"shaft-1\"\nmoment = \"40 N m\"\nbetween = [\"340 deg\", \"500 deg\"]\n\
                      ramp = \"20 deg\"\nturns = 2\n";

const GAS: f64 = 40.0 * 140.0 / 360.0 * TAU;

/// An engine in four strokes against a constant brake: the brake's torque is the work of the gas over two turns, and the flywheel that of the
/// energy between the end of one stroke and the beginning of the next.
#[test]
fn a_brake_holds_an_engine_at_a_mean_speed() {
    let text = rotor(STROKE, "torque = \"-1 N m\"");
    let speed = 30.0;
    let request = SteadyRequest {
        mean_speed: Some(mean_speed(speed, Level::Motor)),
        ..SteadyRequest::default()
    };
    let cycle = checked(asked(&text, &request)).cycle.unwrap();
    let figures = &cycle.figures;
    assert_eq!(figures.turns, 2);
    near("mean speed", figures.mean_speed, speed, 1e-10);
    near("period", figures.period, 2.0 * TAU / speed, 1e-10);
    let held = cycle.held.as_ref().unwrap();
    let brake = GAS / (2.0 * TAU);
    near("torque", held.torque.unwrap(), -brake, 1e-9);
    near("gas", figures.energy.process, GAS, 1e-9);
    near("brake", figures.energy.motor, -GAS, 1e-9);
    // The gas exceeds the brake from a place on one ramp to that on the other: 40·s(x) = brake with s = x³·(10 − 15·x + 6·x²).
    let s = |x: f64| x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if 40.0 * s(middle) < brake {
            low = middle;
        } else {
            high = middle;
        }
    }
    let ramp = 20.0 / 360.0 * TAU;
    // ∫s over the rest of a ramp.
    let area = |x: f64| 2.5 * x.powi(4) - 3.0 * x.powi(5) + x.powi(6);
    let above = 2.0 * ramp * (40.0 * (area(1.0) - area(low)) - brake * (1.0 - low));
    let swing = above + (40.0 - brake) * 120.0 / 360.0 * TAU;
    let [fast, slow] = [figures.max_speed, figures.min_speed];
    near(
        "swing",
        0.5 * 0.4 * (fast * fast - slow * slow),
        swing,
        1e-9,
    );
    near(
        "fluctuation",
        figures.kinetic_energy_fluctuation,
        swing,
        1e-9,
    );
    // The flywheel: δ·J·ω² = swing with (ω_max + ω_min)/2; with the mean over the time it differs in the second order of δ.
    let request = SteadyRequest {
        delta: Some(0.01),
        ..request
    };
    let found = asked(&text, &request).unwrap().flywheel.unwrap();
    near("delta", found.cycle.figures.delta, 0.01, 1e-9);
    near("mean speed", found.cycle.figures.mean_speed, speed, 1e-9);
    near(
        "J",
        0.4 + found.inertia,
        swing / (0.01 * speed * speed),
        1e-3,
    );
}

/// The same engine against a generator whose torque grows with the speed: it runs where the mean torque is that of the gas, without an option.
#[test]
fn a_generator_takes_what_an_engine_gives() {
    let generator = "start_speed = \"300 rpm\"\ntorque_speed = [[\"-1 rad/s\", \"0.3 N m\"], [\"1000 rad/s\", \"-300 N m\"]]";
    let cycle = checked(asked(&rotor(STROKE, generator), &SteadyRequest::default()))
        .cycle
        .unwrap();
    let figures = &cycle.figures;
    // The mean over the angle of 0.3·ω is GAS/4π.
    near("works", figures.energy.motor, -GAS, 1e-9);
    assert!(figures.mean_speed > 0.0);
    let mean = GAS / (2.0 * TAU) / 0.3;
    assert!(
        (figures.mean_speed / mean - 1.0).abs() < 0.1,
        "{}",
        figures.mean_speed
    );
    assert!(cycle.left_over < 1.0);
}

/// The load that a motor can bear at a mean speed: a friction of 2 N m three and a half times.
#[test]
fn a_load_is_found_for_a_mean_speed() {
    let friction = "[[load]]\nname = \"friction\"\non = \"shaft-1\"\nopposing_moment = \"2 N m\"";
    let motor = "torque_speed = [[\"0 rad/s\", \"10 N m\"], [\"100 rad/s\", \"0 N m\"]]";
    let request = SteadyRequest {
        mean_speed: Some(mean_speed(30.0, Level::Load("friction".to_owned()))),
        ..SteadyRequest::default()
    };
    let cycle = checked(asked(&rotor(friction, motor), &request))
        .cycle
        .unwrap();
    near("factor", cycle.held.unwrap().factor, 3.5, 1e-9);
    let request = SteadyRequest {
        mean_speed: Some(mean_speed(30.0, Level::Load("fan".to_owned()))),
        ..SteadyRequest::default()
    };
    let why = asked(&rotor(friction, motor), &request).unwrap_err();
    assert!(matches!(why, SteadyError::NoLoad { .. }), "{why:?}");
}

/// A cycle of turns that the loads do not repeat after is refused; twice as many are the same.
#[test]
fn turns_are_those_of_the_loads() {
    let text = rotor(STROKE, "torque = \"-1 N m\"");
    let with = |turns| SteadyRequest {
        mean_speed: Some(mean_speed(30.0, Level::Motor)),
        turns: Some(turns),
        ..SteadyRequest::default()
    };
    let why = asked(&text, &with(3)).unwrap_err();
    assert!(
        matches!(why, SteadyError::Turns { own: 2, asked: 3 }),
        "{why:?}"
    );
    let [two, four] =
        [2, 4].map(|turns| asked(&text, &with(turns)).unwrap().cycle.unwrap().figures);
    near("delta", two.delta, four.delta, 1e-9);
    near("works", 2.0 * two.energy.motor, four.energy.motor, 1e-9);
}
