//! Linkages, springs, dampers and bounded drives in machine files: what they say in SI units, against independent
//! results, and what a user is told about a wrong one.

mod cams;
mod change_points;
mod elements;
mod refusals;
mod strokes;
mod trains;
mod values;
mod wheels;

use crate::reading::{parse, read, refuses, refuses_edit};

/// The four-bar of the golden data, as a user would write it: lengths rounded nowhere, angles of the drawing by eye.
const FOUR_BAR: &str = r#"gravity = ["0 m/s^2", "-9.81 m/s^2"]

[mechanism]
type = "linkage"
drive = "crank bearing"
ground = { O = ["0 mm", "0 mm"], C = ["300 mm", "0 mm"] }

[[mechanism.body]]
name = "crank"
mass = "0.5 kg"
inertia = "4 kg cm^2"
com = ["30 mm", "-5 mm"]
angle = "0 deg"
points = { A = ["80 mm", "0 mm"] }

[[mechanism.body]]
name = "coupler"
mass = "0.9 kg"
inertia = "0.006 kg m^2"
com = ["110 mm", "40 mm"]
angle = "50 deg"
points = { B = ["250 mm", "0 mm"] }

[[mechanism.body]]
name = "rocker"
mass = "0.7 kg"
inertia = "0.0025 kg m^2"
com = ["85 mm", "10 mm"]
angle = "100 deg"
points = { B = ["180 mm", "0 mm"] }

[[mechanism.joint]]
name = "crank bearing"
between = ["ground.O", "crank"]

[[mechanism.joint]]
name = "crank pin"
between = ["crank.A", "coupler"]

[[mechanism.joint]]
name = "coupler pin"
between = ["coupler.B", "rocker.B"]

[[mechanism.joint]]
name = "rocker bearing"
between = ["ground.C", "rocker"]

[[load]]
on = "rocker"
moment = "-6 N m"
"#;

#[track_caller]
fn within(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= tolerance,
        "{found} is {error:e} from {expected}, more than {tolerance:e}"
    );
}
