//! Limited rate of the torque.

use jred_motion::fastest::{Limits, NoMotion, Task, solve};
use jred_motion::trace::Node;
use jred_motion::way::{Actuator, Way};
use jred_sizing::cycle::form::Coefficients;

use super::jerk::{NEAR, seven, smooth};
use super::{close, motor, table, task};
use crate::support::press_file;

/// Of a constant inertia the torque is the acceleration: the same profile from the torque and its rate, without the limits of the drive link.
#[test]
fn a_torque_rate_is_a_jerk() {
    let file = table(2.0, "");
    let limits = Limits {
        torque_rate: Some(40.0),
        level_ends: true,
        ..Limits::default()
    };
    for length in [3.0, 0.8] {
        let asked = Task {
            limits,
            ..task(0.0, length)
        };
        let found = smooth(&file, &motor([8.0; 2], 2.0), &asked);
        close(found.time, seven(length, 2.0, 4.0, 20.0), NEAR);
    }
}

/// The torque of the press changes as fast as allowed, from above, and never as fast as without a limit.
#[test]
fn a_press_with_a_torque_rate() {
    let file = jred_machine::read::read(&press_file()).unwrap();
    let limits = Limits {
        torque_rate: Some(1e3),
        level_ends: true,
        ..Limits::default()
    };
    let motor = motor([60.0, 40.0], 90.0);
    let found = smooth(
        &file,
        &motor,
        &Task {
            limits,
            ..task(3.2, 9.0)
        },
    );
    assert!(found.time > 1.01 * found.bound.unwrap());
    let way = Way::new(&file, motor, 1.0);
    let torque = |node: &Node, alpha: f64| {
        let place = way.place(node.phi).unwrap();
        way.demand(&place, node.omega, alpha).torque
    };
    for pair in found.trace.nodes().windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        let change = torque(b, b.alpha[0]) - torque(a, a.alpha[1]);
        assert!(
            change.abs() <= 1e3 * b.step * (1.0 + 1e-5) + 1e-6,
            "{change} in {}",
            b.step
        );
    }
}

/// Where two parabolas of a cam meet the torque jumps; a limited jerk bears it.
#[test]
fn a_load_that_jumps_has_no_torque_rate() {
    let text =
        std::fs::read_to_string(press_file().with_file_name("cam-translating.toml")).unwrap();
    let file = super::machine(&text.replace("modified-sine", "parabola"));
    let limits = Limits {
        torque_rate: Some(1e3),
        level_ends: true,
        ..Limits::default()
    };
    let motor = motor([40.0; 2], 90.0);
    let refused = solve(
        &file,
        &motor,
        &Task {
            limits,
            ..task(0.0, 3.0)
        },
    );
    assert!(
        matches!(refused, Err(NoMotion::LoadJumps { .. })),
        "{refused:?}"
    );
    let limits = Limits {
        jerk: Some(1e4),
        level_ends: true,
        ..Limits::default()
    };
    smooth(
        &file,
        &motor,
        &Task {
            limits,
            ..task(0.0, 3.0)
        },
    );
}

/// A slow motion follows the loads: dT/dt = T′·ω with T the torque at no speed, so a limit r that is small is met everywhere, and the
/// motion takes t = ∫|T′| dφ/r. What inertia and viscous friction add falls with r. A gearbox behind a belt turns the flow of power twice.
#[test]
fn a_small_rate_follows_the_loads() {
    let file = jred_machine::read::read(&press_file()).unwrap();
    let actuator = Actuator {
        coefficients: Coefficients([0.0, 0.25 / 0.95, 0.25 * 0.95, 0.0, 0.0]),
        ratio: 4.0,
        ..motor([24.0, 12.0], 1200.0)
    };
    let way = Way::new(&file, actuator.clone(), 1.0);
    let parts = 100_000;
    let torques: Vec<f64> = (0..=parts)
        .map(|k| 3.2 + 5.8 * f64::from(k) / f64::from(parts))
        .map(|phi| way.demand(&way.place(phi).unwrap(), 0.0, 0.0).torque)
        .collect();
    let variation: f64 = torques
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .sum();
    for (rate, more) in [(3.0, 0.05), (0.3, 0.01)] {
        let limits = Limits {
            torque_rate: Some(rate),
            level_ends: true,
            ..Limits::default()
        };
        let asked = Task {
            limits,
            ..task(3.2, 9.0)
        };
        let found = smooth(&file, &actuator, &asked);
        let longer = found.time * rate / variation - 1.0;
        assert!(longer > -1e-3 && longer < more, "{rate} N·m/s: {longer}");
    }
}
