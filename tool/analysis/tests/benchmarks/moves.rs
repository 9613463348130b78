//! Axes that a textbook does on one page: three phases of constant torque, or a law whose mean square has a closed form.

use super::{SIMPSON, duty, machine, near, read};

const G: f64 = 9.81;

/// A trapezoid of the tool over this way (m), with the speed (m/s) and the acceleration (m/s²) of both ramps.
fn trapezoid(body: &str, point: &str, [way, speed, acceleration]: [f64; 3], rest: f64) -> String {
    format!(
        r#"{body}
[motion]
type = "point-to-point"
of = {{ point = "{point}", along = "x" }}
[[motion.segment]]
law = "trapezoid"
move = "{way} m"
max_speed = "{speed} m/s"
max_acceleration = "{acceleration} m/s^2"
[[motion.segment]]
dwell = "{rest} s"
"#
    )
}

/// RMS of torques (N·m), each for a time (s), over a whole cycle (s).
fn rms(phases: &[(f64, f64)], cycle: f64) -> f64 {
    let squares: f64 = phases
        .iter()
        .map(|(torque, time)| torque * torque * time)
        .sum();
    (squares / cycle).sqrt()
}

/// Three phases of a horizontal axis with friction: J·a/r ± F·r.
#[track_caller]
fn three_phases(text: &str, inertia: f64, radius: f64, friction: f64, move_: [f64; 3], rest: f64) {
    let [way, speed, acceleration] = move_;
    let duty = duty(&read(text));
    let found = duty.figures(|i| i.input_torque);
    let ramp = speed / acceleration;
    let steady = way / speed - ramp;
    let inert = inertia * acceleration / radius;
    let phases = [
        (inert + friction, ramp),
        (friction, steady),
        (friction - inert, ramp),
    ];
    near("peak", found.max, inert + friction, SIMPSON);
    near("least", found.min, friction - inert, SIMPSON);
    near(
        "RMS",
        found.rms,
        rms(&phases, 2.0 * ramp + steady + rest),
        SIMPSON,
    );
}

#[test]
fn a_belt_axis() {
    let body = r#"gravity = { inclination = "0 deg" }
[mechanism]
type = "belt-axis"
pulley = { pitch = "8 mm", teeth = 24, inertia = "4 kg cm^2" }
idler = [{ diameter = "30 mm", count = 2, inertia = "1.5 kg cm^2" }]
belt_mass = "0.9 kg"
carriage = { mass = "18 kg", friction = 0.03 }"#;
    // 24 teeth of 8 mm are 192 mm a turn.
    let radius = 0.192 / std::f64::consts::TAU;
    let idlers = 2.0 * 1.5e-4 * (radius / 0.015).powi(2);
    let inertia = 4e-4 + idlers + (18.0 + 0.9) * radius * radius;
    let move_ = [0.6, 1.5, 10.0];
    let text = trapezoid(body, "carriage", move_, 0.25);
    three_phases(
        &text,
        inertia,
        radius,
        0.03 * 18.0 * G * radius,
        move_,
        0.25,
    );
}

#[test]
fn a_feed_roll() {
    let body = r#"gravity = { inclination = "0 deg" }
[mechanism]
type = "feed-roll"
roll = { diameter = "100 mm", inertia = "58 kg cm^2" }
idler = [{ diameter = "80 mm", inertia = "24 kg cm^2" }]
strip = { mass = "9 kg", friction = 0.2 }
[[load]]
on = "roll"
opposing_moment = "1.8 N m""#;
    let inertia = 58e-4 + 24e-4 * 1.25 * 1.25 + 9.0 * 0.05 * 0.05;
    let friction = 0.2 * 9.0 * G * 0.05 + 1.8;
    let move_ = [0.25, 1.25, 12.5];
    let text = trapezoid(body, "strip", move_, 0.3);
    three_phases(&text, inertia, 0.05, friction, move_, 0.3);
}

/// Up a slope of 12°, goods and half the belt on the bed, through a reduction of 5 with 96 %.
#[test]
fn an_inclined_conveyor() {
    let file = machine("belt-conveyor.toml");
    let duty = duty(&file);
    let slope = 12f64.to_radians();
    let force = 120.0 * G * slope.sin() + 0.25 * (120.0 + 7.0) * G * slope.cos() + 35.0;
    let steady = force * 0.06 / 5.0 / 0.96;
    near(
        "steady",
        super::at(&duty, 4.0).input_torque.abs(),
        steady,
        SIMPSON,
    );
    let at_drum = 0.021 * 2.0 + 4.0 * 6e-4 * (120f64 / 50.0).powi(2) + (120.0 + 14.0) * 0.0036;
    let acceleration = 1.0 / 0.06;
    let driven = force * 0.06 + at_drum * acceleration + 45e-4 * acceleration;
    let started = super::at(&duty, 0.25).input_torque.abs();
    let driver = 0.4e-4 * acceleration * 5.0;
    // The driven gear stands behind the teeth, the driver before them.
    near("start", started, driven / 5.0 / 0.96 + driver, SIMPSON);
}

/// A vertical screw: up, then down. The weight acts all the time, friction against the motion.
#[test]
fn a_vertical_screw() {
    let text = r#"gravity = { inclination = "90 deg" }
[mechanism]
type = "ball-screw"
lead = "10 mm"
screw = { inertia = "3.8 kg cm^2" }
nut = { mass = "62 kg", friction = 0.1 }
[[load]]
on = "nut"
opposing_force = "60 N"
[motion]
type = "cycle"
of = { point = "nut", along = "x" }
[[motion.segment]]
law = "trapezoid"
move = "300 mm"
max_speed = "0.5 m/s"
max_acceleration = "4 m/s^2"
[[motion.segment]]
law = "trapezoid"
move = "-300 mm"
max_speed = "0.5 m/s"
max_acceleration = "4 m/s^2"
"#;
    let lead = 0.01 / std::f64::consts::TAU;
    let inertia = (3.8e-4 + 62.0 * lead * lead) * 4.0 / lead;
    // A vertical guide carries no weight: friction = 0.1 does nothing.
    let (weight, friction) = (62.0 * G * lead, 60.0 * lead);
    let (ramp, steady) = (0.125, 0.3 / 0.5 - 0.125);
    let phases = [
        (weight + friction + inertia, ramp),
        (weight + friction, steady),
        (weight + friction - inertia, ramp),
        (weight - friction - inertia, ramp),
        (weight - friction, steady),
        (weight - friction + inertia, ramp),
    ];
    let duty = duty(&read(text));
    let found = duty.figures(|i| i.input_torque);
    near(
        "RMS",
        found.rms,
        rms(&phases, 4.0 * ramp + 2.0 * steady),
        SIMPSON,
    );
    near("peak", found.max, weight + friction + inertia, SIMPSON);
    near("holding", duty.hold_torque, weight, SIMPSON);
}

/// Steps by the 3-4-5 polynomial, whose acceleration h/T²·(60z − 180z² + 120z³) has the mean square 120/7·h²/T⁴ and the largest value
/// 10/√3·h/T².
#[test]
fn an_indexing_table() {
    let text = r#"gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "rotary-table"
table = { diameter = "900 mm", mass = "85 kg" }
parts = [{ count = 8, mass = "6.5 kg", pitch_circle = "700 mm", inertia = "0.03 kg m^2" }]
[[load]]
on = "table"
opposing_moment = "18 N m"
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "45 deg"
duration = "0.5 s"
[[motion.segment]]
dwell = "1.5 s"
"#;
    let inertia = 0.5 * 85.0 * 0.45 * 0.45 + 8.0 * (0.03 + 6.5 * 0.35 * 0.35);
    let step = std::f64::consts::FRAC_PI_4 / 0.25;
    let found = duty(&read(text)).figures(|i| i.input_torque);
    near(
        "peak",
        found.max,
        inertia * step * 10.0 / 3f64.sqrt() + 18.0,
        1e-6,
    );
    let square = (inertia * step).powi(2) * 120.0 / 7.0 + 18.0 * 18.0;
    near("RMS", found.rms, (square * 0.25).sqrt(), SIMPSON);
}

/// A disc of 50 kg and 500 mm: 15625 kg cm², as machinemfg.com/servo-motor-sizing ("Case One") prints.
#[test]
fn a_disc() {
    let text = r#"gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "rotary-table"
table = { diameter = "500 mm", mass = "50 kg" }
[motion]
type = "constant-speed"
speed = "60 rpm"
"#;
    near(
        "inertia",
        duty(&read(text)).instants[0].inertia,
        1.5625,
        1e-13,
    );
}
