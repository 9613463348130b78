//! Motors that do not drive their machine on.

use jred_machine::analysis::simulate::{Simulated, simulate};

use super::turntable;
use crate::reading::parse;
use crate::support::{budget, near, within};

fn found(text: &str) -> Simulated {
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
}

/// A pendulum under a constant torque turns round where T·φ = m·g·r·(1 − cos φ), and m·g·r·sin φ − T is missing there.
#[test]
fn a_pendulum_under_too_small_a_torque_turns_round() {
    let text = |torque: f64| {
        format!(
            "gravity = [\"0 m/s^2\", \"-10 m/s^2\"]\n[mechanism]\ntype = \"linkage\"\ndrive = \"pivot\"\nbody = [{{ name = \"bob\", mass = \"1 kg\", inertia = \"0.1 kg m^2\", com = [\"0 mm\", \"-500 mm\"] }}]\njoint = [{{ name = \"pivot\", type = \"revolute\", between = [\"ground\", \"bob\"] }}]\n[simulation]\nstart_angle = \"0 deg\"\nduration = \"3 s\"\noutput_step = \"10 ms\"\ntorque = \"{torque} N m\""
        )
    };
    let torque = 3.0;
    let stuck = found(&text(torque)).missing.unwrap();
    let phi = stuck.missing.phi;
    within(
        "energy",
        torque * phi,
        5.0 * (1.0 - phi.cos()),
        budget::SWING * 5.0,
    );
    let needed = 5.0 * phi.sin();
    within("needed", stuck.missing.needed, needed, budget::SWING * 5.0);
    assert!(stuck.missing.needed > torque && stuck.time > 0.3);
    // 4·φ is above 5·(1 − cos φ) everywhere: it goes round.
    assert_eq!(found(&text(4.0)).missing, None);
}
