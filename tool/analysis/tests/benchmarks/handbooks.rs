//! Examples of makers' handbooks: figures only, at the rounding at which they are printed.

use super::{at, duty, printed, read};

/// A screw axis with mass in kg, coefficient 0.2, screw and drive train, moved by 0.275 m at 15 m/min in 1.2 s.
fn screw_axis(mass: &str, screw: &str, train: &str) -> String {
    format!(
        r#"gravity = {{ inclination = "0 deg", acceleration = "9.8 m/s^2" }}
[mechanism]
type = "ball-screw"
lead = "10 mm"
screw = {{ inertia = "{screw}" }}
nut = {{ mass = "{mass}", friction = 0.2 }}
{train}
[motion]
type = "point-to-point"
of = {{ point = "nut", along = "x" }}
[[motion.segment]]
law = "trapezoid"
move = "275 mm"
max_speed = "0.25 m/s"
max_acceleration = "2.5 m/s^2"
[[motion.segment]]
dwell = "0.3 s"
"#
    )
}

/// Solid cylinder, π/32·ρ·l·d⁴, in kg m².
fn cylinder(length: f64, diameter: f64) -> f64 {
    std::f64::consts::PI / 32.0 * 7.87e3 * length * diameter.powi(4)
}

/// Yaskawa, E-V-MD series, user's manual, 2.2.2 "Selection calculations", page 2-5
/// (manualshive.com/en/manual/yaskawa/e-v-md-series/3588034?page=30): screw of 20 mm and 1 m behind a reduction of 2, 250 kg.
#[test]
fn yaskawa_geared_screw() {
    let screw = format!("{} kg m^2", cylinder(1.0, 0.02));
    let train = r#"[[drive_train]]
type = "gear-train"
stage = [{ driver = { teeth = 20, inertia = "0.4 kg cm^2" }, driven = { teeth = 40, inertia = "0 kg m^2" }, efficiency = 0.9 }]
"#;
    let duty = duty(&read(&screw_axis("250 kg", &screw, train)));
    let steady = at(&duty, 0.6);
    let rpm = steady.input_speed.abs() * 30.0 / std::f64::consts::PI;
    printed("motor speed", rpm, 3000.0, 1e-6);
    printed("load torque", steady.input_torque.abs(), 0.43, 0.005);
    printed("load inertia", steady.input_inertia, 2.29e-4, 0.005e-4);
    // 135 W are made from 0.43 N m, which is rounded by up to 1.2 %.
    let power = (steady.input_torque * steady.input_speed).abs();
    printed("load moving power", power, 135.0, 0.012 * 135.0);
    // 0.1 s of acceleration and 1.0 s at speed, 40 times a minute.
    printed("cycle", duty.duration, 1.5, 1e-12);
}

/// Yaskawa, Sigma II series SGMVH, user's manual, 11.1.1 "Selection example for speed control", page 11-2
/// (azmanual.top/manuals/802399/yaskawa-sigma-ii-series-sgmvh.html?page=304): screw of 40 mm and 1.4 m, coupling of 1 kg and 60 mm, 500 kg.
#[test]
fn yaskawa_direct_screw() {
    let coupling = 1.0 * 0.06 * 0.06 / 8.0;
    let screw = format!("{} kg m^2", cylinder(1.4, 0.04) + coupling);
    let train = r#"[[drive_train]]
type = "belt"
driver = { radius = "30 mm", inertia = "0 kg m^2" }
driven = { radius = "30 mm", inertia = "0 kg m^2" }
efficiency = 0.9
"#;
    let duty = duty(&read(&screw_axis("500 kg", &screw, train)));
    let steady = at(&duty, 0.6);
    let rpm = steady.input_speed * 30.0 / std::f64::consts::PI;
    printed("motor speed", rpm, 1500.0, 1e-6);
    printed("load torque", steady.input_torque, 1.73, 0.005);
    // Printed as the sum of three figures with one decimal each.
    printed("load inertia", steady.input_inertia, 44.9e-4, 0.15e-4);
}

/// FANUC, AC servo motor αiS/αi series, descriptions B-65262EN/03, 3.2.1, page 46
/// (cncmanuals.com/fanuc/41/ac-servo-motor-alpha-i-is-series-descriptions/page/64): table of 11760 N with 490 N of gib force, 20 mm a turn, η = 0.9,
/// 0.8 N m of friction at the motor.
#[test]
fn fanuc_table() {
    let text = r#"gravity = { inclination = "0 deg", acceleration = "9.8 m/s^2" }
[mechanism]
type = "ball-screw"
lead = "20 mm"
screw = { inertia = "1 kg cm^2" }
nut = { mass = "1200 kg", friction = 0.05 }
[[load]]
name = "gib force, 0.05 times 490 N"
on = "nut"
opposing_force = "24.5 N"
[[load]]
name = "0.8 N m at the motor, before the efficiency"
on = "screw"
opposing_moment = "0.72 N m"
[[drive_train]]
type = "belt"
driver = { radius = "30 mm", inertia = "0 kg m^2" }
driven = { radius = "30 mm", inertia = "0 kg m^2" }
efficiency = 0.9
[motion]
type = "constant-speed"
speed = "1000 rpm"
"#;
    let duty = duty(&read(text));
    printed("load torque", at(&duty, 0.03).input_torque, 3.0, 0.05);
    let force = at(&duty, 0.03).terms.coulomb - 0.72;
    let force = force * std::f64::consts::TAU / 0.02;
    printed("force", force, 612.5, 1e-9);
}

/// Weihong, WISE series, user's manual, belt driving system, page 28
/// (manualshive.com/ru/manual/weihong/wise-wsdv-11020psb/952565?page=34): two wheels of 50 mm and 0.5 kg; the sum printed needs the 2 kg
/// of its formula, not the 10 kg of its list.
#[test]
fn weihong_belt_axis() {
    let text = r#"gravity = { inclination = "0 deg" }
[mechanism]
type = "belt-axis"
pulley = { diameter = "50 mm", inertia = "1.5625 kg cm^2" }
idler = [{ inertia = "1.5625 kg cm^2" }]
carriage = { mass = "2 kg" }
[motion]
type = "point-to-point"
of = { point = "carriage", along = "x" }
[[motion.segment]]
law = "trapezoid"
move = "1 m"
duration = "1 s"
accelerate = "10 %"
decelerate = "10 %"
[[motion.segment]]
dwell = "1 s"
"#;
    let duty = duty(&read(text));
    let steady = at(&duty, 0.5);
    printed("load inertia", steady.input_inertia, 15.6e-4, 0.05e-4);
    printed("speed", steady.omega * 0.025, 1.0 / 0.9, 1e-9);
}
