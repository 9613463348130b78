//! Payloads in free motion: taken and left at the speed of their link.

use super::{BALANCE, CONTROL, PARABOLA, inverse_and_forward};
use crate::simulate::{imbalance, simulate};
use crate::support::{edited, within};

/// A table of 2 kg·m² that carries 3 kg at 0.5 m, 0.75 kg·m², from 0.2 s to 0.6 s.
const TABLE: &str = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "rotary-table"
table = { diameter = "2 m", mass = "4 kg" }
[[payload]]
on = "table"
mass = "3 kg"
at = ["500 mm", "0 mm"]
during = ["0.2 s", "0.6 s"]
[motion]
type = "cycle"
[[motion.segment]]
dwell = "1 s"
[simulation]
start_angle = "0 deg"
start_speed = "3 rad/s"
duration = "0.9 s"
output_step = "10 ms"
torque = "5 N m"
"#;

/// The speed rises in broken lines, T/J, without a jump; the payload brings and takes its kinetic energy.
#[test]
fn it_comes_and_goes_with_the_speed_of_its_link() {
    let found = simulate(TABLE);
    let (omegas, energies) = (found.get("omega [rad/s]"), found.get("payload energy [J]"));
    let (light, laden) = (5.0 / 2.0, 5.0 / 2.75);
    let taken = 3.0 + 0.2 * light;
    let left = taken + 0.4 * laden;
    for (k, t) in found.get("t [s]").into_iter().enumerate() {
        let (omega, energy) = if t < 0.2 - 1e-9 {
            (3.0 + light * t, 0.0)
        } else if t < 0.6 - 1e-9 {
            (taken + laden * (t - 0.2), 0.375 * taken * taken)
        } else {
            let energy = 0.375 * (taken * taken - left * left);
            (left + light * (t - 0.6), energy)
        };
        within("omega", omegas[k], omega, PARABOLA);
        within("energy", energies[k], energy, PARABOLA);
    }
    assert!(imbalance(&found) < BALANCE);
}

/// Taken from rest below and left above, on a rack that a motor lifts: until then and after that it does not weigh.
#[test]
fn what_is_lifted_brings_no_energy_and_leaves_with_its_height() {
    // 20 kg and 0.01 kg·m² on 50 mm; 7 kg more.
    let text = r#"
gravity = ["-10 m/s^2", "0 m/s^2"]
[mechanism]
type = "rack-and-pinion"
pinion = { radius = "50 mm", mass = "1 kg", inertia = "0.01 kg m^2" }
rack = { mass = "20 kg" }
[[load]]
on = "rack"
opposing_force = "10 N"
[[payload]]
on = "rack"
mass = "7 kg"
segments = [2]
[motion]
type = "cycle"
[[motion.segment]]
dwell = "0.3 s"
[[motion.segment]]
dwell = "0.5 s"
[[motion.segment]]
dwell = "0.2 s"
[simulation]
start_angle = "0 deg"
duration = "0.95 s"
output_step = "10 ms"
torque = "10.2 N m"
"#;
    // 10.2 N m less 10 N m and 0.5 N m of friction do not lift; laden it falls: (10.2 − 13.5 + 0.5)/(0.01 + 27·0.0025).
    let found = simulate(text);
    let laden = (10.2 - 13.5 + 0.5) / (0.01 + 27.0 * 0.0025);
    let fall = (10.2 - 10.0 + 0.5) / (0.01 + 20.0 * 0.0025);
    let (omegas, energies) = (found.get("omega [rad/s]"), found.get("payload energy [J]"));
    let phi = 0.5 * laden * 0.25;
    let speed = 0.5 * laden;
    for (k, t) in found.get("t [s]").into_iter().enumerate() {
        let (omega, energy) = if t < 0.3 - 1e-9 {
            (0.0, 0.0)
        } else if t < 0.8 - 1e-9 {
            (laden * (t - 0.3), 0.0)
        } else {
            let taken = 7.0 * 10.0 * 0.05 * phi + 0.5 * 7.0 * (0.05 * speed).powi(2);
            (speed + fall * (t - 0.8), -taken)
        };
        within("omega", omegas[k], omega, PARABOLA);
        within("energy", energies[k], energy, PARABOLA);
    }
    assert!(imbalance(&found) < BALANCE);
}

/// On the rod of a slider-crank, where J depends on φ: its motion under a controller asks for the torque of d'Alembert's principle, and in free motion the
/// energies balance.
#[test]
fn on_a_rod_it_follows_its_motion() {
    let text = format!(
        r#"
gravity = ["3 m/s^2", "-9 m/s^2"]
[mechanism]
type = "slider-crank"
crank = {{ length = "90 mm", mass = "1 kg", inertia = "20 kg cm^2" }}
rod = {{ length = "300 mm", mass = "0.8 kg", inertia = "80 kg cm^2", com = ["120 mm", "0 mm"] }}
slider = {{ mass = "4 kg" }}
[[payload]]
on = "rod"
mass = "2.5 kg"
inertia = "0.03 kg m^2"
at = ["200 mm", "40 mm"]
during = ["0.9 s", "0.35 s"]
while_moving = true
[[load]]
on = "slider"
opposing_force = "30 N"
[motion]
type = "cycle"
[[motion.segment]]
law = "polynomial-345"
move = "360 deg"
duration = "1 s"
[[motion.segment]]
dwell = "0.2 s"
[simulation]
start_angle = "0 deg"
duration = "2 s"
output_step = "5 ms"
torque = "200 N m"
{CONTROL}
"#
    );
    assert!(inverse_and_forward(&text) > 5.0);
    let free = edited(&text, CONTROL, "start_speed = \"40 rad/s\"");
    let free = edited(&free, "\"200 N m\"", "\"5 N m\"");
    let found = simulate(&free);
    let imbalance = imbalance(&found);
    assert!(imbalance < BALANCE, "{imbalance:e}");
    let energies = found.get("payload energy [J]");
    assert!(
        energies.iter().any(|energy| energy.abs() > 1.0),
        "{energies:?}"
    );
}
