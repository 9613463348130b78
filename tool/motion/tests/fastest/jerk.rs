//! Limited jerk.

use std::f64::consts::{PI, TAU};

use jred_motion::fastest::{
    Binding, Fastest, MoveLimits, NoMotion, Task, ToolSpeed, ToolSpeeds, solve,
};

use jred_motion::path_dynamics::Actuator;
use jred_motion::trace::Node;
use jred_sizing::cycle::form::Coefficients;

use super::{close, jerk_limits, motor, table, task, torque_rate_limits};
use crate::support::{press_file, shipped};

/// Relative error of the time where pieces meet the switching points.
pub(super) const NEAR: f64 = 1e-6;

/// Limits are satisfied between the nodes.
pub(super) const WITHIN: f64 = 1e-6;

/// Roundings of two speeds in the change of the acceleration between them.
pub(super) const ROUNDING: f64 = 12.0 * f64::EPSILON;

/// Speed, acceleration and distance at a share of a step: the speed is the cubic through both speeds and accelerations.
pub(super) fn cubic(a: &Node, b: &Node, share: f64) -> [f64; 3] {
    let (s, h) = (share, b.step);
    let [rise, first, last] = [b.omega - a.omega, a.alpha[1] * h, b.alpha[0] * h];
    let [square, cube] = [3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise];
    [
        a.omega + s * (first + s * (square + s * cube)),
        (first + s * (2.0 * square + 3.0 * s * cube)) / h,
        h * s * (a.omega + s * (first / 2.0 + s * (square / 3.0 + s * cube / 4.0))),
    ]
}

/// The duration from rest to rest of seven segments: v = j·t₁·(t₁ + t₂), d = v·(2·t₁ + t₂ + t₃).
pub(super) fn seven(distance: f64, speed: f64, acceleration: f64, jerk: f64) -> f64 {
    let t1 = (speed / jerk).sqrt().min(acceleration / jerk);
    let rise = t1 + speed / (jerk * t1);
    if speed * rise <= distance {
        return rise + distance / speed;
    }
    // The speed is not reached; a·(t₁ + t₂)·(2·t₁ + t₂) = d.
    let t1 = acceleration / jerk;
    if 2.0 * acceleration * t1 * t1 <= distance {
        let t2 = -1.5 * t1 + (0.25 * t1 * t1 + distance / acceleration).sqrt();
        return 4.0 * t1 + 2.0 * t2;
    }
    4.0 * (distance / (2.0 * jerk)).cbrt()
}

fn limited(speed: f64, acceleration: f64, jerk: f64) -> MoveLimits {
    MoveLimits {
        speed: Some(speed),
        acceleration: Some(acceleration),
        deceleration: Some(acceleration),
        jerk: Some(jerk),
        level_ends: true,
        ..MoveLimits::default()
    }
}

pub(super) fn smooth(
    file: &jred_file::model::machine::MachineFile,
    motor: &Actuator,
    asked: &Task,
) -> Fastest {
    let found = solve(file, motor, asked).unwrap_or_else(|why| panic!("{why}"));
    assert!(found.excess <= WITHIN, "exceeded by {:e}", found.excess);
    let nodes = found.trace.nodes();
    let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
    for (node, speed) in [(first, asked.speeds[0]), (last, asked.speeds[1])] {
        assert!(
            (node.omega.abs() - speed).abs() <= 1e-9 * (1.0 + speed),
            "{node:?}"
        );
    }
    let bound = found.bound.unwrap();
    assert!(
        found.time >= bound * (1.0 - 1e-9),
        "{} below {bound}",
        found.time
    );
    // The acceleration has no jumps, and its slope, which is linear within a step, satisfies the limit at both ends.
    let jerk = asked.limits.jerk.unwrap_or(f64::INFINITY);
    for pair in nodes.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        assert!(
            (a.alpha[1] - a.alpha[0]).abs() <= 1e-6 * asked_acceleration(&found),
            "{a:?}"
        );
        let rounding = ROUNDING * (a.omega.abs() + b.omega.abs()) / (b.step * b.step);
        let [rise, first, last] = [b.omega - a.omega, a.alpha[1], b.alpha[0]].map(|x| x / b.step);
        let mean = rise / b.step;
        for slope in [
            6.0 * mean - 4.0 * first - 2.0 * last,
            2.0 * first + 4.0 * last - 6.0 * mean,
        ] {
            assert!(
                slope.abs() <= jerk * (1.0 + WITHIN) + rounding,
                "{slope} at {}",
                a.t
            );
        }
    }
    found
}

fn asked_acceleration(found: &Fastest) -> f64 {
    let nodes = found.trace.nodes().iter();
    nodes.fold(0.0, |most: f64, node| most.max(node.alpha[0].abs()))
}

#[test]
fn seven_segments() {
    let file = table(2.0, "");
    for (length, jerk) in [
        (3.0, 20.0),
        (0.8, 20.0),
        (0.1, 20.0),
        (3.0, 5.0),
        (30.0, 200.0),
        (1e-4, 50.0),
    ] {
        let asked = Task {
            limits: limited(2.0, 4.0, jerk),
            ..task(0.5, 0.5 + length)
        };
        let found = smooth(&file, &motor([10.0; 2], 100.0), &asked);
        close(found.time, seven(length, 2.0, 4.0, jerk), NEAR);
    }
    let asked = Task {
        limits: limited(2.0, 4.0, 20.0),
        ..task(3.5, 0.5)
    };
    let found = smooth(&file, &motor([10.0; 2], 100.0), &asked);
    let limits: Vec<Binding> = found.phases.iter().map(|phase| phase.limit).collect();
    let ramp = [Binding::Jerk, Binding::Acceleration, Binding::Jerk];
    let brake = [Binding::Jerk, Binding::Deceleration, Binding::Jerk];
    assert_eq!(limits, [&ramp[..], &[Binding::Speed], &brake].concat());
    close(found.phases[1].t[0], 0.2, 1e-2);
}

/// Between two speeds without acceleration at the ends: a rise or a fall by Δv takes Δv/a + a/j.
#[test]
fn from_one_speed_to_another() {
    let file = table(2.0, "");
    let [rise, fall] = [1.5, 0.5].map(|change| change / 4.0 + 4.0 / 40.0);
    let steady = (2.0 - 1.25 * rise - 1.75 * fall) / 2.0;
    let asked = Task {
        speeds: [0.5, 1.5],
        limits: limited(2.0, 4.0, 40.0),
        ..task(0.0, 2.0)
    };
    let found = smooth(&file, &motor([100.0; 2], 100.0), &asked);
    close(found.time, rise + steady + fall, NEAR);
}

/// A lift: the torque available to drive and to brake is 40 and 120 N·m of 80, so the accelerations differ; the jerk is the same. v = a·(t − a/j), t
/// = v/a + a/j for each half, and d = v·(t₁ + t₂)/2.
#[test]
fn a_weight_leaves_different_accelerations() {
    let text = "title = \"lift\"\ngravity = [\"0 m/s^2\", \"-10 m/s^2\"]\n[mechanism]\ntype = \"hoist\"\n\
        [mechanism.drum]\nmass = \"10 kg\"\ninertia = \"0.5 kg m^2\"\n[mechanism.load]\nradius = \"100 mm\"\nmass = \"40 kg\"\n";
    let file = super::machine(text);
    let inertia = 0.5 + 40.0 * 0.01;
    let [up, down] = [40.0 / inertia, 120.0 / inertia];
    let jerk = 1500.0;
    let asked = Task {
        limits: jerk_limits(jerk),
        ..task(0.0, 20.0)
    };
    let found = smooth(&file, &motor([80.0; 2], 1e3), &asked);
    let way = |v: f64| 0.5 * v * (v / up + up / jerk + v / down + down / jerk);
    let (mut low, mut high) = (0.0, 1e3);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if way(middle) < 20.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    close(found.time, 2.0 * 20.0 / low, NEAR);
}

/// A larger jerk brings the time closer to that without a limit, from above.
#[test]
fn a_press_comes_near_the_motion_without_a_limit() {
    let file = jred_analysis::checked::read(&press_file()).unwrap();
    let motor = motor([60.0, 40.0], 90.0);
    let mut last = f64::INFINITY;
    for jerk in [1e3, 1e4, 1e5, 1e6] {
        let asked = Task {
            limits: jerk_limits(jerk),
            ..task(3.2, 7.0)
        };
        let found = smooth(&file, &motor, &asked);
        assert!(found.time < last);
        last = found.time;
    }
    let bound = solve(&file, &motor, &task(3.2, 7.0)).unwrap().time;
    assert!(last < 1.01 * bound, "{last}, {bound}");
}

/// With a large jerk limit a ramp to the acceleration a takes a/j and costs a time of that order, so the excess over the motion without a limit falls
/// with 1/j. With constant inertia the time is that of the seven segments.
#[test]
fn a_large_jerk_tends_to_the_motion_without_a_limit() {
    let file = table(2.0, "");
    let mut last = f64::INFINITY;
    for jerk in [1e2, 1e3, 1e4, 1e6, 1e8] {
        let asked = Task {
            limits: limited(2.0, 4.0, jerk),
            ..task(0.0, 3.0)
        };
        let found = smooth(&file, &motor([10.0; 2], 100.0), &asked);
        // Ramps of a thousandth of the time are as short as the shortest pieces.
        close(found.time, seven(3.0, 2.0, 4.0, jerk), 2.0 * NEAR);
        assert!(found.time < last);
        last = found.time;
    }
    close(last, 3.0 / 2.0 + 2.0 / 4.0, NEAR);
}

/// The same for a press with losses in its belt, and for the torque rate: never slower with a larger limit, and finally as fast as without one.
#[test]
fn larger_limits_of_a_press_are_faster() {
    let file = jred_analysis::checked::read(&press_file()).unwrap();
    let motor = motor([24.0, 12.0], 300.0);
    let bound = solve(&file, &motor, &task(3.2, 9.0)).unwrap().time;
    let limits: [fn(f64) -> MoveLimits; 2] = [
        |limit| jerk_limits(limit),
        |limit| torque_rate_limits(0.02 * limit),
    ];
    for limits in limits {
        let mut last = f64::INFINITY;
        for limit in [1e5, 1e6, 1e7, 1e9] {
            let asked = Task {
                limits: limits(limit),
                ..task(3.2, 9.0)
            };
            let found = smooth(&file, &motor, &asked);
            assert!(
                found.time <= last * (1.0 + NEAR),
                "{} after {last}",
                found.time
            );
            last = found.time;
        }
        close(last, bound, 1e-5);
    }
}

/// The tool is as slow as without the jerk limit, and the motion slower than with either alone.
#[test]
fn a_tool_speed_with_a_limited_jerk() {
    let file = jred_analysis::checked::read(&press_file()).unwrap();
    let mechanism = file.machine.mechanism();
    let slider = (mechanism.link_names().iter())
        .position(|name| name == "slider")
        .unwrap();
    let between = [1.8 * PI, TAU];
    let tool = ToolSpeed::new(mechanism, slider, [0.0; 2], 0.2, between);
    let tool = ToolSpeeds::from(tool.unwrap().unwrap());
    let motor = motor([300.0, 200.0], 90.0);
    let asked = |tool: ToolSpeeds, jerk: Option<f64>| Task {
        limits: MoveLimits {
            tool,
            jerk,
            level_ends: jerk.is_some(),
            ..MoveLimits::default()
        },
        ..task(3.2, 9.0)
    };
    let both = smooth(&file, &motor, &asked(tool, Some(2e4)));
    let [one, other] = [asked(tool, None), asked(ToolSpeeds::default(), Some(2e4))]
        .map(|asked| solve(&file, &motor, &asked).unwrap().time);
    assert!(
        both.time > 1.001 * one.max(other),
        "{} {one} {other}",
        both.time
    );
    // The node at the start of the range, where the tool is fastest, belongs to it.
    let limit = |phi: f64| tool.at(mechanism, phi + 1e-9).unwrap();
    let share = |node: &Node| node.omega / limit(node.phi);
    let most = both.trace.nodes().iter().map(share).fold(0.0, f64::max);
    assert!((most - 1.0).abs() <= WITHIN, "{most}");
}

/// A press with a gearbox, whose limits are close together.
#[test]
fn the_jerk_is_kept_inside_the_steps() {
    let file = jred_analysis::checked::read(&press_file()).unwrap();
    let drive = Actuator {
        coefficients: Coefficients([3.2e-3, 0.25 / 0.96, 0.25 * 0.96, 0.0, 0.0]),
        ratio: 4.0,
        ..motor([24.0, 10.0], 314.0)
    };
    for jerk in [2e4, 2e5] {
        let asked = Task {
            limits: jerk_limits(jerk),
            ..task(PI, 3.0 * PI)
        };
        smooth(&file, &drive, &asked);
    }
}

/// If torque and acceleration have the same limit, the phase has one name.
#[test]
fn a_phase_at_two_limits_is_one() {
    let file = table(1.0, "");
    let asked = Task {
        limits: limited(5.0, 20.0, 200.0),
        ..task(0.0, TAU)
    };
    let found = smooth(&file, &motor([20.0; 2], 1e3), &asked);
    assert_eq!(found.phases.len(), 7, "{:?}", found.phases);
}

/// If torque obstructs a limited jerk, the jerk is among the cures.
#[test]
fn the_cure_names_the_jerk() {
    let path = shipped("eccentric-press.toml");
    let file = jred_analysis::checked::read(&path).unwrap();
    let asked = Task {
        limits: jerk_limits(500.0),
        ..task(0.0, 10.0 * TAU)
    };
    let refused = solve(&file, &motor([30.0; 2], 104.7), &asked).unwrap_err();
    let cure = refused.cure();
    assert!(
        cure.contains("--max-jerk") && cure.contains("torque"),
        "{cure}"
    );
}

/// Too short a distance to slow down: the message names the limit and the position.
#[test]
fn what_is_in_the_way_is_named() {
    let file = table(2.0, "");
    let asked = Task {
        speeds: [2.0, 0.0],
        limits: jerk_limits(1.0),
        ..task(0.0, 1.0)
    };
    let refused = solve(&file, &motor([100.0; 2], 100.0), &asked).unwrap_err();
    let NoMotion::NotFound { limit, missed, .. } = &refused else {
        panic!("{refused}");
    };
    assert_eq!(*limit, Some(Binding::Jerk));
    assert!(*missed > 0.01);
    assert!(
        refused.to_string().contains("jerk limit is exceeded by"),
        "{refused}"
    );
}

/// Masses, lengths and times in other units: the time of the move has the same numerical value.
#[test]
fn other_units_of_a_limited_jerk() {
    let expected = seven(3.0, 2.0, 4.0, 20.0);
    for angle in [1e-6, 1e3] {
        for time in [1e-3, 1e2] {
            let limits = limited(
                2.0 * angle / time,
                4.0 * angle / (time * time),
                20.0 * angle / time.powi(3),
            );
            let torque = 10.0 * angle / (time * time);
            let asked = Task {
                limits,
                ..task(0.0, 3.0 * angle)
            };
            let found = smooth(
                &table(2.0, ""),
                &motor([torque; 2], 100.0 * angle / time),
                &asked,
            );
            close(found.time / time, expected, NEAR);
        }
    }
}
