//! Carriages in free motion: momentum, energy, and the torque of the motion.

use jred_file::model::schedule::ScheduleInstant;

use super::{BALANCE, CONTROL, inverse_and_forward};
use crate::reading::parse;
use crate::simulate::{imbalance, simulate};
use crate::support::{edited, near, within};

/// An arm of 2 kg·m² with a carriage of 3 kg that goes from 0.2 m to 1 m and back, in a cycle of a second.
fn arm(gravity: &str, more: &str, simulation: &str) -> String {
    format!(
        r#"
gravity = ["0 m/s^2", "{gravity} m/s^2"]
[mechanism]
type = "rotary-table"
table = {{ diameter = "2 m", mass = "4 kg" }}
{more}
[[carriage]]
on = "table"
mass = "3 kg"
at = ["200 mm", "0 mm"]
stroke = ["0 mm", "800 mm"]
[carriage.motion]
type = "cycle"
[[carriage.motion.segment]]
law = "polynomial-345"
move = "800 mm"
duration = "0.4 s"
[[carriage.motion.segment]]
law = "polynomial-345"
move = "-800 mm"
duration = "0.6 s"
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "720 deg"
duration = "0.9 s"
[[motion.segment]]
dwell = "0.1 s"
[simulation]
start_angle = "0 deg"
output_step = "10 ms"
{simulation}
"#
    )
}

/// s and ṡ of the carriage, by its law 3-4-5.
fn place(t: f64) -> [f64; 2] {
    let t = t % 1.0;
    let (z, h, from, lasts) = if t < 0.4 {
        (t / 0.4, 0.8, 0.0, 0.4)
    } else {
        ((t - 0.4) / 0.6, -0.8, 0.8, 0.6)
    };
    let s = from + h * z.powi(3) * (10.0 - 15.0 * z + 6.0 * z * z);
    [s, h / lasts * 30.0 * z * z * (1.0 - z).powi(2)]
}

/// Without torque the angular momentum (J + m·r²)·ω stays, and what the carriage's axis does is the gain of energy.
#[test]
fn on_a_free_rotor_the_angular_momentum_stays() {
    let text = arm(
        "0",
        "",
        "start_speed = \"5 rad/s\"\nduration = \"2.3 s\"\ntorque = \"0 N m\"",
    );
    let found = simulate(&text);
    let inertia = |s: f64| 2.0 + 3.0 * (0.2 + s).powi(2);
    let momentum = inertia(0.0) * 5.0;
    let energy = |[s, v]: [f64; 2]| 0.5 * momentum * momentum / inertia(s) + 1.5 * v * v;
    let columns = [
        "omega [rad/s]",
        "J_red [kg m^2]",
        "kinetic energy [J]",
        "carriage work [J]",
    ];
    let columns = columns.map(|name| found.get(name));
    for (k, t) in found.get("t [s]").into_iter().enumerate() {
        let here = place(t);
        let expected = [
            momentum / inertia(here[0]),
            inertia(here[0]),
            energy(here),
            energy(here) - energy([0.0; 2]),
        ];
        for (column, expected) in columns.iter().zip(expected) {
            within("column", column[k], expected, 1e-9);
        }
    }
    assert!(imbalance(&found) < BALANCE);
}

/// Friction holds the arm level while its carriage, on a guide that stands upright, is lifted: its axis does the work.
#[test]
fn on_a_held_arm_its_axis_lifts_it() {
    let text = arm(
        "-10",
        "[[load]]\non = \"table\"\nopposing_moment = \"300 N m\"",
        "duration = \"1.5 s\"\ntorque = \"0 N m\"",
    );
    let text = edited(&text, "stroke =", "direction = \"90 deg\"\nstroke =");
    let found = simulate(&text);
    let works = found.get("carriage work [J]");
    let speeds = found.get("omega [rad/s]");
    for (k, t) in found.get("t [s]").into_iter().enumerate() {
        let [s, v] = place(t);
        within("work", works[k], 3.0 * 10.0 * s + 1.5 * v * v, 1e-9);
        within("held", speeds[k], 0.0, 0.0);
    }
    assert!(imbalance(&found) < BALANCE);
}

/// It lets go the arm when its moment has grown to the friction: 3 kg at 10 m/s², 6 N m at the start and 30 N m at the end of its way.
#[test]
fn a_carriage_that_goes_out_lets_the_arm_go() {
    let text = arm(
        "-10",
        "[[load]]\non = \"table\"\nopposing_moment = \"18 N m\"",
        "duration = \"0.5 s\"\ntorque = \"0 N m\"",
    );
    let found = simulate(&edited(&text, "10 ms", "1 ms"));
    let speeds = found.get("omega [rad/s]");
    // r = 0.6 m half-way, at 0.2 s.
    for (k, t) in found.get("t [s]").into_iter().enumerate() {
        if t < 0.2 {
            within("held", speeds[k], 0.0, 0.0);
        } else if t > 0.2005 {
            assert!(speeds[k] < 0.0, "t = {t}: {}", speeds[k]);
        }
    }
    assert!(imbalance(&found) < BALANCE);
}

/// An end stop takes ½·J·ω² of the arm, with the carriage on it, and nothing of the carriage's own speed, which lies across the arm here: its axis bears that.
#[test]
fn an_end_stop_does_not_stop_the_carriage() {
    let text = arm(
        "0",
        "",
        "start_speed = \"-3 rad/s\"\nduration = \"0.3 s\"\ntorque = \"0 N m\"\nend_stops = { at = [\"-20 deg\", \"90 deg\"], restitution = 0.5 }",
    );
    let text = edited(&text, "stroke =", "direction = \"90 deg\"\nstroke =");
    let file = parse(&text).unwrap();
    let simulation = file.simulation.as_ref().unwrap();
    let found = jred_analysis::simulate::simulate(&file, simulation).unwrap();
    let impacts = found.impacts.unwrap();
    assert_eq!(impacts.count, 1);
    let [s, v] = place(impacts.time);
    assert!(v > 0.5, "{v}");
    let inertia = 2.0 + 3.0 * (0.04 + s * s);
    let lost = 0.5 * inertia * impacts.speed.powi(2) * (1.0 - 0.25);
    let found = simulate(&text);
    near("lost", *found.get("losses [J]").last().unwrap(), lost, 1e-9);
    // (J + m·r²)·ω + m·0.2·ṡ stays before and after the impact.
    let momentum = |[s, v]: [f64; 2], omega: f64| (2.0 + 3.0 * (0.04 + s * s)) * omega + 0.6 * v;
    let before = momentum([0.0, 0.0], -3.0);
    near("speed", momentum([s, v], -impacts.speed), before, 1e-9);
    let after = momentum([s, v], 0.5 * impacts.speed);
    let omega = *found.get("omega [rad/s]").last().unwrap();
    near("after", momentum(place(0.3), omega), after, 1e-9);
    assert!(imbalance(&found) < BALANCE);
}

/// Under gravity and friction, with a motor, forward and under a controller that follows the motion.
#[test]
fn it_follows_its_motion() {
    let friction = "[[load]]\non = \"table\"\nopposing_moment = \"4 N m\"";
    let controlled = arm(
        "-9",
        friction,
        &format!("duration = \"1.7 s\"\ntorque = \"5000 N m\"\n{CONTROL}"),
    );
    assert!(inverse_and_forward(&controlled) > 100.0);
    let across = edited(&controlled, "stroke =", "direction = \"70 deg\"\nstroke =");
    assert!(inverse_and_forward(&across) > 100.0);
    let free = arm(
        "-9",
        friction,
        "start_speed = \"3 rad/s\"\nduration = \"2.7 s\"\ntorque = \"30 N m\"",
    );
    let imbalance = imbalance(&simulate(&free));
    assert!(imbalance < BALANCE, "{imbalance:e}");
}

/// On the rod of a slider-crank, whose ψ′ and place depend on φ, with a payload and a load of segments beside it.
#[test]
fn on_a_rod_with_all_loads() {
    let text = format!(
        r#"
gravity = ["3 m/s^2", "-9 m/s^2"]
[mechanism]
type = "slider-crank"
crank = {{ length = "90 mm", mass = "1 kg", inertia = "20 kg cm^2" }}
rod = {{ length = "300 mm", mass = "0.8 kg", inertia = "80 kg cm^2", com = ["120 mm", "0 mm"] }}
slider = {{ mass = "4 kg" }}
[[load]]
name = "punch"
on = "slider"
force = ["-200 N", "0 N"]
during = ["0.2 s", "0.5 s"]
[[load]]
name = "brush"
on = "slider"
opposing_force = "20 N"
direction = "forward"
[[payload]]
on = "slider"
mass = "1 kg"
during = ["0.1 s", "0.6 s"]
while_moving = true
[[carriage]]
on = "rod"
mass = "3 kg"
inertia = "0.02 kg m^2"
at = ["60 mm", "30 mm"]
direction = "25 deg"
stroke = ["0 mm", "150 mm"]
[carriage.motion]
type = "cycle"
start = "10 mm"
[[carriage.motion.segment]]
law = "modified-sine"
move = "130 mm"
duration = "0.45 s"
[[carriage.motion.segment]]
dwell = "0.1 s"
[[carriage.motion.segment]]
law = "polynomial-345"
move = "-130 mm"
duration = "0.35 s"
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "360 deg"
duration = "0.8 s"
[[motion.segment]]
dwell = "0.2 s"
[simulation]
start_angle = "0 deg"
duration = "1.8 s"
output_step = "5 ms"
torque = "500 N m"
{CONTROL}
"#
    );
    assert!(inverse_and_forward(&text) > 10.0);
    let free = edited(&text, CONTROL, "start_speed = \"25 rad/s\"");
    let free = edited(&free, "\"500 N m\"", "\"3 N m\"");
    let imbalance = imbalance(&simulate(&free));
    assert!(imbalance < BALANCE, "{imbalance:e}");
    // J_red is that of the machine with its carriage and payload where they are.
    let found = simulate(&text);
    let file = parse(&text).unwrap();
    let motion = file.motion.as_ref().unwrap();
    let inertias = found.get("J_red [kg m^2]");
    for (k, t) in found.get("t [s]").into_iter().enumerate() {
        let t = t % 1.0;
        if [0.0, 0.1, 0.6, 1.0].iter().any(|at| (t - at).abs() < 1e-6) {
            continue;
        }
        let state = motion.at(t);
        let now = ScheduleInstant::of(t, state.omega);
        let expected = file.bare_reduction_at(&now, state.phi).unwrap().inertia;
        near("J", inertias[k], expected, 1e-8);
    }
}
