//! Linkages that are kept on their branch through change points.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use jred::machine::Reducible as _;
use jred::machine::{Jointed as _, Mechanism as _};

use super::{close, read, refuses_edits};
use crate::reading::machine;

const ELLIPTIC: &str = include_str!("../../../../machines/elliptic-drive.toml");

/// Crank and rod of one length, as docs/mechanisms/linkage.md has them.
const FOLDED: &str = r#"gravity = ["0 m/s^2", "-9.81 m/s^2"]

[mechanism]
type = "linkage"
drive = "crank bearing"
keep_branch = true
drawn_at = "30 deg"
body = [
  { name = "crank",  mass = "0.8 kg", inertia = "9 kg cm^2", angle = "30 deg",  points = { A = ["100 mm", "0 mm"] } },
  { name = "rod",    mass = "0.8 kg", inertia = "9 kg cm^2", angle = "-30 deg", points = { B = ["100 mm", "0 mm"] } },
  { name = "slider", mass = "2.5 kg" },
]
joint = [
  { name = "crank bearing", between = ["ground", "crank"] },
  { name = "crank pin",     between = ["crank.A", "rod"] },
  { name = "slider pin",    between = ["rod.B", "slider"] },
  { name = "guide", type = "prismatic", between = ["ground", "slider"], direction = "0 deg" },
]
"#;

/// Ellipses that roll on each other: ψ′ = −(d² − a²)/(d² + a² − 2·a·d·cos φ), through both flat positions.
#[test]
fn an_antiparallelogram_rolls_as_ellipses_do() {
    let file = machine("elliptic-drive.toml");
    let (a, d) = (0.08, 0.24);
    let mechanism = file.machine.mechanism();
    for k in 0..=720 {
        let phi = TAU * f64::from(k) / 720.0;
        let speed = -(d * d - a * a) / (d * d + a * a - 2.0 * a * d * phi.cos());
        let cutter = mechanism.frames(phi).unwrap()[2];
        close(cutter.psi.d1, speed, 1e-11);
        // What the bearings take: 0.02·ψ′².
        let point = file.machine.reduction(phi).unwrap();
        close(
            point.reduced_torque(3.0) - point.reduced_torque(1.0),
            -0.02 * speed * speed * 2.0,
            1e-9,
        );
    }
    let flat: Vec<f64> = mechanism
        .change_points()
        .iter()
        .map(|point| point.at)
        .collect();
    assert_eq!(flat.len(), 2);
    close(flat[0], 0.0, 1e-9);
    close(flat[1], PI, 1e-9);
    assert!(!mechanism.determined(PI) && mechanism.determined(PI + 0.02));
}

/// x = 2·r·cos φ: J = I₁ + I₂ + (m₁·0 + m₂·r²) + m₃·(2·r·sin φ)², the rod's frame being at the crank pin.
#[test]
fn a_folded_slider_crank_goes_through_the_axis() {
    let file = read(FOLDED);
    for k in 0..=360 {
        let phi = TAU * f64::from(k) / 360.0;
        let [j, dj, _] = file.machine.reduction(phi).unwrap().inertias();
        let slope = 2.5 * 0.04 * (2.0 * phi).sin();
        close(
            j,
            2.0 * 9e-4 + 0.8 * 0.01 + 2.5 * 0.04 * phi.sin().powi(2),
            1e-12,
        );
        close(dj, slope, 1e-11);
    }
    close(
        file.machine.mechanism().change_points()[0].at,
        FRAC_PI_2,
        1e-9,
    );
}

#[test]
fn a_change_point_that_nobody_asked_for_is_named_with_its_cure() {
    let edits = "
        keep_branch = true => keep_branch = false =>
            is in line at φ = 90 deg and φ = 270 deg, a change point | write keep_branch = true
    ";
    refuses_edits(FOLDED, edits);
    let edits = r#"
        keep_branch = true␣ => => φ = 0 deg and φ = 180 deg, a change point | go on in two ways
        { O = ["0 mm", "0 mm"], C = ["240 mm" => { O = ["0 mm", "0 mm"], C = ["235 mm" => locks | dead point
    "#;
    refuses_edits(ELLIPTIC, edits);
    let edits = r#"
        B = ["100 mm" => B = ["250 mm" => there is no change point to pass | leave `keep_branch` out
        drawn_at = "30 deg" => drawn_at = "90 deg" => in the drawing itself, at φ = 90 deg | drawn_at
        keep_branch = true => keep_branch = "yes" => `keep_branch` | true or false
    "#;
    refuses_edits(FOLDED, edits);
}
