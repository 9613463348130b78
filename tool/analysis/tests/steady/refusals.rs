//! Machines without a steady cycle, and what is said of them.

use jred_analysis::steady::SteadyError;

use super::{rotor, try_of, unbalanced_rotor};
use crate::support::{edited, near, press_text};

fn why(text: &str, delta: Option<f64>) -> SteadyError {
    try_of(text, delta).expect_err("a steady cycle")
}

/// The weight of an unbalanced rotor is lifted by a motor that is too weak for it: it stops where the gravity torque has grown to
/// the motor's, on the way up.
#[test]
fn a_motor_too_weak_for_a_weight() {
    let text = &unbalanced_rotor(
        "0.5 kg m^2",
        "[[load]]\non = \"rotor\"\nopposing_moment = \"3 N m\"",
        "at = \"crank\"\ntorque = \"2 N m\"",
    );
    let SteadyError::Stuck(at) = why(text, None) else {
        panic!("{:?}", why(text, None));
    };
    // T = m·g·r·cos φ + 3 at the place that it names.
    let torque = 20.0 * 9.81 * 0.1 * at.phi.cos() + 3.0;
    near("needed", at.needed, torque, 2e-3);
}

#[test]
fn machines_without_a_cycle() {
    let friction =
        |moment: &str| format!("[[load]]\non = \"shaft-1\"\nopposing_moment = \"{moment}\"");
    let surplus = why(&rotor(&friction("1 N m"), "torque = \"2 N m\""), None);
    assert!(
        matches!(surplus, SteadyError::Surplus { .. }),
        "{surplus:?}"
    );
    let stuck = why(&rotor(&friction("3 N m"), "torque = \"2 N m\""), None);
    let SteadyError::Stuck(at) = stuck else {
        panic!("{stuck:?}");
    };
    near("missing", at.needed - at.given, 1.0, 1e-12);
    let free = rotor(
        "",
        "torque_speed = [[\"0 rpm\", \"5 N m\"], [\"500 rpm\", \"0 N m\"]]",
    );
    let free = why(&free, None);
    assert!(matches!(free, SteadyError::Indifferent(_)), "{free:?}");
    let none = why(&rotor(&friction("1 N m"), "torque = \"0 N m\""), None);
    assert!(matches!(none, SteadyError::NoTorque), "{none:?}");
    let against = rotor(
        &friction("1 N m"),
        "torque = \"-2 N m\"\nstart_speed = \"10 rpm\"",
    );
    let against = why(&against, None);
    assert!(
        matches!(against, SteadyError::WrongSign { .. }),
        "{against:?}"
    );
}

/// Loads that are far too large are named with the torque that is missing, not with steps of an integrator.
#[test]
fn loads_that_are_far_too_large() {
    let press = press_text();
    for (from, to) in [
        ("opposing_force = \"150 N\"", "opposing_force = \"1e8 N\""),
        ("mass = \"42 kg\"", "mass = \"1e6 kg\""),
    ] {
        let stuck = why(&edited(&press, from, to), None);
        assert!(matches!(stuck, SteadyError::Stuck(_)), "{stuck:?}");
    }
}

/// A flywheel carries a press over its working stroke that its motor alone cannot do; no flywheel makes up for work that is missing.
#[test]
#[ignore = "more than five seconds of a processor"]
fn a_flywheel_where_there_is_no_cycle_without() {
    let weak = press_text().replace(
        "[\"0 rpm\", \"60 N m\"], [\"500 rpm\", \"45 N m\"]",
        "[\"0 rpm\", \"14 N m\"], [\"500 rpm\", \"14 N m\"]",
    );
    let weak = edited(
        &weak,
        "rotor_inertia = \"200 kg cm^2\"",
        "rotor_inertia = \"2 kg cm^2\"",
    );
    let weak = edited(&weak, "\"0.05 kg m^2\"", "\"0 kg m^2\"");
    let found = try_of(&weak, Some(0.1)).unwrap();
    near(
        "delta",
        found.flywheel.unwrap().cycle.figures.delta,
        0.1,
        1e-9,
    );
    let weaker = weak.replace("\"14 N m\"", "\"3 N m\"");
    let none = why(&weaker, Some(0.1));
    // The punch's work, and that of friction and of the belt, over a turn.
    let SteadyError::NoFlywheel {
        torque: needed,
        reached: None,
        ..
    } = none
    else {
        panic!("{none:?}");
    };
    let given = try_of(&weak, Some(0.1)).unwrap().flywheel.unwrap();
    let mean = given.cycle.figures.motor_torque.mean;
    assert!(needed > 3.0 && needed < mean, "{needed} {mean}");
}
