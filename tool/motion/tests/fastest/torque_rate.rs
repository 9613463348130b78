//! Limited rate of the torque.

use std::f64::consts::PI;

use jred_file::model::machine::MachineFile;
use jred_motion::fastest::{Fastest, NoMotion, Task, solve};
use jred_motion::path_dynamics::{Actuator, PathDynamics};
use jred_sizing::cycle::form::Coefficients;

use super::jerk::{NEAR, ROUNDING, WITHIN, cubic, seven, smooth};
use super::{close, jerk_limits, motor, table, task, torque_rate_limits};
use crate::support::{edited_press, press_file, shipped};

/// Relative change of the time by an inactive limit, which changes the convergence of the search [3e-8].
const CHANGES_NOTHING: f64 = 1e-6;

/// With constant inertia the torque is proportional to the acceleration: the same profile from the torque and its rate, without limits of the drive
/// link.
#[test]
fn a_torque_rate_is_a_jerk() {
    let file = table(2.0, "");
    let limits = torque_rate_limits(40.0);
    for length in [3.0, 0.8] {
        let asked = Task {
            limits,
            ..task(0.0, length)
        };
        let found = smooth(&file, &motor([8.0; 2], 2.0), &asked);
        close(found.time, seven(length, 2.0, 4.0, 20.0), NEAR);
    }
}

/// The torque of the press changes at the permitted rate; the time approaches that without a limit from above, and never reaches it.
#[test]
fn a_press_with_a_torque_rate() {
    let file = jred_analysis::checked::read(&press_file()).unwrap();
    let limits = torque_rate_limits(1e3);
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
    keeps_the_rate(&file, &motor, &found, 1e3);
}

/// The torque rate throughout each step of the written profile: its speed is the cubic through both speeds and accelerations.
fn keeps_the_rate(file: &MachineFile, motor: &Actuator, found: &Fastest, limit: f64) {
    let dynamics = PathDynamics::new(file, motor.clone(), 1.0);
    let parts = 16;
    for pair in found.trace.nodes().windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let torque = |k: i32| {
            let [omega, alpha, way_gone] = cubic(&a, &b, f64::from(k) / f64::from(parts));
            let place = dynamics.place(a.phi + way_gone).unwrap();
            dynamics.demand(&place, omega, alpha)
        };
        let part = b.step / f64::from(parts);
        for k in 1..=parts {
            let [before, after] = [k - 1, k].map(torque);
            let change = (after.torque - before.torque).abs();
            // Roundings of the speeds and of the torque.
            let digits = after.per_acceleration * (a.omega + b.omega) / b.step + after.torque.abs();
            let rounding = ROUNDING * digits;
            assert!(
                change <= limit * part * (1.0 + WITHIN) + rounding,
                "{} in step {k} of {} at {}",
                change / part / limit - 1.0,
                b.step,
                a.t
            );
        }
    }
}

/// The press with a lossy drive and belt, and one with much larger losses.
#[test]
#[ignore = "more than five seconds of a processor"]
fn the_rate_is_kept_inside_the_steps() {
    let drive = Actuator {
        coefficients: Coefficients([3.2e-3, 0.25 / 0.96, 0.25 * 0.96, 0.0, 0.0]),
        ratio: 4.0,
        ..motor([24.0, 10.0], 314.0)
    };
    for (efficiency, limit) in [(97, 1e3), (97, 1e4), (70, 1e3)] {
        let file = press(efficiency);
        let asked = rate(limit, 9.0);
        let found = smooth(&file, &drive, &asked);
        keeps_the_rate(&file, &drive, &found, limit);
    }
}

/// The press with this efficiency (%) of its belt.
fn press(efficiency: u32) -> MachineFile {
    let belt = format!("efficiency = \"{efficiency} %\"");
    super::machine(&edited_press("efficiency = \"97 %\"", &belt))
}

fn rate(limit: f64, to: f64) -> Task {
    Task {
        limits: torque_rate_limits(limit),
        ..task(PI, to)
    }
}

/// A motion whose inertia carries the load takes half the time of one whose torque follows it. Half a per cent of efficiency must not select between
/// them: another method (linear programmes over a spline of the time) needs 0.370 s with 97 %.
#[test]
#[ignore = "more than five seconds of a processor"]
fn losses_do_not_hide_the_fast_motion() {
    let mut last = 0.0;
    for efficiency in [99, 97, 95, 90, 80, 60] {
        let found = smooth(
            &press(efficiency),
            &motor([120.0; 2], 94.2),
            &rate(300.0, 3.0 * PI),
        );
        assert!(
            found.time > last,
            "{efficiency} %: {} after {last}",
            found.time
        );
        last = found.time;
    }
    assert!(last < 0.38, "{last}");
}

/// A larger limit of the rate, or of the speed, is never slower.
#[test]
fn a_larger_rate_is_faster() {
    let file = press(97);
    let mut last = f64::INFINITY;
    for limit in [100.0, 150.0, 290.0, 300.0, 500.0, 700.0, 2000.0] {
        let found = smooth(&file, &motor([120.0; 2], 94.2), &rate(limit, 3.0 * PI));
        assert!(found.time < last, "{limit}: {} after {last}", found.time);
        last = found.time;
    }
}

/// A peak torque limit far from active changes nothing: bends are rounded over the loads that occur.
#[test]
fn a_torque_that_does_not_bind_changes_nothing() {
    let file = press(85);
    let times = [120.0, 1e3, 1e4].map(|torque| {
        let found = smooth(&file, &motor([torque; 2], 94.2), &rate(300.0, 3.0 * PI));
        found.time
    });
    close(times[1], times[0], CHANGES_NOTHING);
    close(times[2], times[0], CHANGES_NOTHING);
}

/// Where two parabolas of a cam meet the torque jumps; a limited jerk permits that.
#[test]
fn a_load_that_jumps_has_no_torque_rate() {
    let text = std::fs::read_to_string(shipped("cam-translating.toml")).unwrap();
    let file = super::machine(&text.replace("modified-sine", "parabola"));
    let limits = torque_rate_limits(1e3);
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
    let limits = jerk_limits(1e4);
    smooth(
        &file,
        &motor,
        &Task {
            limits,
            ..task(0.0, 3.0)
        },
    );
}

/// A slow motion follows the loads: dT/dt = T′·ω with T the torque at zero speed, so a small limit r is active everywhere, and the motion takes t =
/// ∫|T′| dφ/r. The effect of inertia and viscous friction falls with r. With a gearbox and a belt the power reverses twice.
#[test]
#[ignore = "more than five seconds of a processor"]
fn a_small_rate_follows_the_loads() {
    let file = jred_analysis::checked::read(&press_file()).unwrap();
    let actuator = Actuator {
        coefficients: Coefficients([0.0, 0.25 / 0.95, 0.25 * 0.95, 0.0, 0.0]),
        ratio: 4.0,
        ..motor([24.0, 12.0], 1200.0)
    };
    let dynamics = PathDynamics::new(&file, actuator.clone(), 1.0);
    let parts = 100_000;
    let torques: Vec<f64> = (0..=parts)
        .map(|k| 3.2 + 5.8 * f64::from(k) / f64::from(parts))
        .map(|phi| {
            dynamics
                .demand(&dynamics.place(phi).unwrap(), 0.0, 0.0)
                .torque
        })
        .collect();
    let variation: f64 = torques
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .sum();
    for (rate, more) in [(3.0, 0.05), (0.3, 0.01)] {
        let limits = torque_rate_limits(rate);
        let asked = Task {
            limits,
            ..task(3.2, 9.0)
        };
        let found = smooth(&file, &actuator, &asked);
        let longer = found.time * rate / variation - 1.0;
        assert!(longer > -1e-3 && longer < more, "{rate} N·m/s: {longer}");
    }
}
