//! Positions prescribed in time: factor 1, and the actuator's power.

use jred::friction::{Coordinate, Rheonomic};

use super::integrate;
use crate::support::{assert_near, budget, derivative};

const MASS: f64 = 1.7;
const HUB: f64 = 0.3;

/// Distance of the mass along the arm, with its rates.
fn distance(t: f64) -> [f64; 3] {
    let (sin, cos) = (2.0 * t + 0.3).sin_cos();
    [0.5 + 0.2 * sin, 0.4 * cos, -0.8 * sin]
}

/// A hub with an arm along which an actuator moves a mass, in a field of weight `gravity` along −y.
fn arm(phi: f64, t: f64, gravity: f64) -> Rheonomic {
    let r = Coordinate::of_time(distance(t));
    let (sin, cos) = Coordinate::angle(phi).sin_cos();
    Rheonomic::default()
        .with(HUB, Coordinate::angle(phi), 0.0)
        .and_then(|sums| sums.with(MASS, r * cos, 0.0))
        .and_then(|sums| sums.with(MASS, r * sin, -MASS * gravity))
        .unwrap()
}

#[test]
fn a_mass_along_a_rotating_arm() {
    let (phi, t, omega, torque) = (0.8, 0.6, 3.0, 2.5);
    let [r, v, a] = distance(t);
    let sums = arm(phi, t, 9.81);
    let inertia = HUB + MASS * r * r;
    assert_near("J", sums.inertia[0], inertia, budget::IDENTITY);
    assert_near("J_t", sums.inertia[2], 2.0 * MASS * r * v, budget::IDENTITY);
    // d(Jω)/dt = T + weight: momentum, not energy.
    let weight = -MASS * 9.81 * r * phi.cos();
    let alpha = sums.acceleration(omega, torque).unwrap();
    assert_near(
        "d(Jω)/dt",
        inertia * alpha + 2.0 * MASS * r * v * omega,
        torque + weight,
        budget::IDENTITY * 10.0,
    );
    assert_near(
        "there and back",
        sums.torque(omega, alpha),
        torque,
        budget::IDENTITY * 10.0,
    );
    // The actuator pushes with F_r = m·(r̈ − r·ω²) + m·g·sin φ along the arm.
    let force = MASS * (a - r * omega * omega) + MASS * 9.81 * phi.sin();
    assert_near(
        "actuator power",
        sums.actuator_power(omega, alpha),
        force * v,
        budget::IDENTITY * 10.0,
    );
    assert_near(
        "kinetic energy",
        sums.kinetic_energy(omega),
        0.5 * inertia * omega * omega + 0.5 * MASS * v * v,
        budget::IDENTITY,
    );
}

#[test]
fn free_run_keeps_the_momentum() {
    let (h, steps) = (1e-4, 10_000);
    let run = |t: f64, y: &[f64; 3]| {
        let sums = arm(y[0], t, 0.0);
        let alpha = sums.acceleration(y[1], 0.0).unwrap();
        [y[1], alpha, sums.actuator_power(y[1], alpha)]
    };
    let end = integrate(run, 0.0, [0.0, 5.0, 0.0], h, steps);
    let (before, after) = (arm(0.0, 0.0, 0.0), arm(end[0], 1.0, 0.0));
    let momentum = before.inertia[0] * 5.0;
    assert_near(
        "Jω",
        after.inertia[0] * end[1],
        momentum,
        budget::FREE_RUN * momentum,
    );
    // Not ω·√J: the actuator has worked.
    let ratio = end[1] * after.inertia[0].sqrt() / (5.0 * before.inertia[0].sqrt());
    assert!((ratio - 1.0).abs() > 0.02, "{ratio}");
    let gained = after.kinetic_energy(end[1]) - before.kinetic_energy(5.0);
    assert_near(
        "energy",
        gained,
        end[2],
        budget::FREE_RUN * before.kinetic_energy(5.0),
    );
}

/// A coordinate with every term: x = r(t)·cos(φ + c(t)), of which B and C take part.
#[test]
fn every_term_of_lagranges_equation() {
    let place = |phi: f64, t: f64| {
        let r = Coordinate::of_time(distance(t));
        let lead = Coordinate::of_time([0.3 * t * t, 0.6 * t, 0.6]);
        let (_, cos) = (Coordinate::angle(phi) * 1.5 + lead).sin_cos();
        r * cos - Coordinate::constant(0.1) * Coordinate::angle(phi)
    };
    let sums = |phi: f64, t: f64| Rheonomic::default().with(MASS, place(phi, t), 0.0).unwrap();
    let (phi, t, omega, alpha) = (0.4, 0.9, 2.2, -1.5);
    let here = sums(phi, t);
    // Newton: m·ẍ·x_φ is the torque and m·ẍ·x_t the actuator's power; ẍ by differences of ẋ along the motion.
    let speed = |dt: f64| {
        let x = place(phi + omega * dt + 0.5 * alpha * dt * dt, t + dt);
        x.phi * (omega + alpha * dt) + x.t
    };
    let acceleration = derivative(speed, 0.0, 1e-3);
    let x = place(phi, t);
    let close = |what, a: f64, b: f64| assert_near(what, a, b, budget::RICHARDSON * 10.0);
    close(
        "torque",
        here.torque(omega, alpha),
        MASS * acceleration * x.phi,
    );
    close(
        "power",
        here.actuator_power(omega, alpha),
        MASS * acceleration * x.t,
    );
    // The derivatives of the sums.
    close(
        "J_φ",
        here.inertia[1],
        derivative(|p| sums(p, t).inertia[0], phi, 1e-3),
    );
    close(
        "J_t",
        here.inertia[2],
        derivative(|s| sums(phi, s).inertia[0], t, 1e-3),
    );
    close(
        "B_φ",
        here.drift[1],
        derivative(|p| sums(p, t).drift[0], phi, 1e-3),
    );
    close(
        "B_t",
        here.drift[2],
        derivative(|s| sums(phi, s).drift[0], t, 1e-3),
    );
    close(
        "C_φ",
        here.rest[1],
        derivative(|p| sums(p, t).rest[0], phi, 1e-3),
    );
    close(
        "C_t",
        here.rest[2],
        derivative(|s| sums(phi, s).rest[0], t, 1e-3),
    );
}

#[test]
fn what_is_wrong_is_said() {
    let x = Coordinate::angle(1.0);
    let text = |r: Result<Rheonomic, jred::Error>| r.unwrap_err().to_string();
    assert_eq!(
        text(Rheonomic::default().with(-1.0, x, 0.0)),
        "mass is -1, but must not be negative"
    );
    assert_eq!(
        text(Rheonomic::default().with(1.0, x, f64::NAN)),
        "force is not a finite number"
    );
    assert_eq!(
        text(Rheonomic::default().with(1.0, x * f64::INFINITY, 0.0)),
        "coordinate prescribed in time is not a finite number"
    );
    assert_eq!(
        Rheonomic::default()
            .acceleration(1.0, 1.0)
            .unwrap_err()
            .to_string(),
        "inertia is 0, but must be greater than zero"
    );
}
