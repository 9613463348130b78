//! Machines whose inertia, ratio or radius changes, each against a derivation of its own.

use super::{SIMPSON, duty, machine, near};
use jred::machine::Reducible as _;

/// Runs with a strip at v: x = R·cos φ, so ω = −v/(R·sin φ) and α = −ω²·cot φ.
#[test]
fn a_flying_shear() {
    let file = machine("flying-shear.toml");
    let duty = duty(&file);
    let mut largest = 0.0f64;
    let synchronous = duty.instants.iter().filter(|i| i.t < 0.04 - 1e-6);
    for instant in synchronous {
        let (sin, cos) = instant.phi.sin_cos();
        let omega = -2.0 / (0.16 * sin);
        let expected = -2.0 * 0.62 * omega * omega * cos / sin;
        near("speed", instant.omega, omega, 1e-9);
        let off = (instant.terms.acceleration - expected).abs();
        assert!(off <= 1e-7 * 54.0, "{} at {}", off, instant.t);
        largest = largest.max(expected.abs());
    }
    // At the ends x = ±40 mm, sin φ = −√(1 − 1/16).
    let sin = (1.0f64 - 1.0 / 16.0).sqrt();
    let end = 1.24 * (2.0 / (0.16 * sin)).powi(2) * 0.25 / sin;
    near("largest", largest, end, 1e-7);
}

/// Where two circles meet, on the right (−1) or left (+1) of the line from the first centre to the second.
fn meet(a: [f64; 2], r: f64, b: [f64; 2], q: f64, side: f64) -> [f64; 2] {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let d = dx.hypot(dy);
    let along = (r * r - q * q + d * d) / (2.0 * d);
    let across = side * (r * r - along * along).sqrt();
    [
        a[0] + (along * dx - across * dy) / d,
        a[1] + (along * dy + across * dx) / d,
    ]
}

/// The ram of `machines/toggle-press.toml` from its circles.
fn ram(phi: f64) -> f64 {
    let pin = [0.06 * phi.cos(), 0.06 * phi.sin()];
    let [x, y] = meet(pin, 0.335, [-0.25, 0.4], 0.25, -1.0);
    x + (0.25f64.powi(2) - (0.4 - y).powi(2)).sqrt()
}

/// Coining with 60 kN at 75°: the torque is the force times the ram's way a radian, by differences of fourth order.
#[test]
fn a_toggle_press() {
    let file = machine("toggle-press.toml");
    let phi = 75f64.to_radians();
    let h = 1e-3;
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| ram(phi + k * h));
    let slope = (a - 8.0 * b + 8.0 * c - d) / (12.0 * h);
    let reduced = file.machine.reduction(phi).unwrap();
    near("coining torque", reduced.process, -60e3 * slope, 1e-8);
    let friction = 300.0 * slope.abs();
    near("guide friction", reduced.coulomb, friction, 1e-8);
}

/// A roll at line speed: T = J·α + F·r, with no term from the change of J, for the web brings its momentum along.
#[test]
fn a_winder_at_line_speed() {
    let file = machine("winder.toml");
    let (core, thickness, density, speed) = (0.076, 250e-6, 1380.0 * 1.2, 4.0);
    for radius in [0.0761, 0.1, 0.2, 0.2999] {
        let phi = std::f64::consts::TAU * (radius - core) / thickness;
        let mass = density * std::f64::consts::PI * (radius * radius - core * core);
        let inertia = 0.09 + 0.5 * mass * (radius * radius + core * core);
        let omega = speed / radius;
        let alpha = -speed / (radius * radius) * thickness * omega / std::f64::consts::TAU;
        let tension = 320.0 * (1.0 - 0.25 * (1.0 - core / radius));
        let reduced = file.machine.reduction(phi).unwrap();
        near("inertia", reduced.inertia, inertia, 1e-11);
        let found = reduced.torque(omega, alpha).total();
        near(
            "torque",
            found,
            inertia * alpha + tension * radius + 1.5,
            1e-9,
        );
        // The powers: what the motor and the web put in is what the roll stores and the pull takes.
        let per_length = density * thickness;
        let slope = per_length * radius.powi(3);
        let stored = inertia * omega * alpha + 0.5 * slope * omega.powi(3);
        let motor = (found - 1.5) * omega;
        let brought = 0.5 * per_length * speed.powi(3);
        near("power", motor + brought, stored + tension * speed, 1e-9);
    }
}

/// The web's way: after 650 m the section of the wound layers, h·L, is the ring between the radii.
#[test]
fn a_winder_winds_its_length() {
    let duty = duty(&machine("winder.toml"));
    let last = duty.instants.last().unwrap();
    let ring = 250e-6 * 650.0 / std::f64::consts::PI;
    let radius = (0.076f64 * 0.076 + ring).sqrt();
    let turned = std::f64::consts::TAU * (radius - 0.076) / 250e-6;
    near("angle", last.phi, turned, SIMPSON);
    // Just before it stops: 0.4 m/s² of the web at standstill, ½·μ·v_line² too much taken off.
    let per_length = 1380.0 * 1.2 * 250e-6;
    let mass = 1380.0 * 1.2 * ring * std::f64::consts::PI;
    let inertia = 0.09 + 0.5 * mass * (radius * radius + 0.076 * 0.076);
    let tension = 320.0 * (1.0 - 0.25 * (1.0 - 0.076 / radius));
    let torque = -inertia * 0.4 / radius + (tension - 8.0 * per_length) * radius + 1.5;
    // The friction rests with the roll; the last instant lies within rounding of it.
    let found = last.terms.total() - last.terms.coulomb + 1.5;
    near("torque at the end", found, torque, 1e-6);
}
