//! A pendulum: its period, and how friction brings it to rest.

use std::f64::consts::PI;

use super::{imbalance, simulate};
use crate::support::numerics::{bisect, elliptic_k};
use crate::support::{budget, largest, within};

/// A crank with its centre of mass off the pivot and nothing but hair-light parts behind it: a pendulum with
/// J = 0.02 + 2·0.1² = 0.04 kg m², m·g·a = 2·9.81·0.1 = 1.962 N m, hanging at −90°.
pub(super) fn pendulum(more: &str, simulation: &str) -> String {
    format!(
        r#"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "slider-crank"
[mechanism.crank]
length = "50 mm"
mass = "2 kg"
inertia = "0.02 kg m^2"
com = ["100 mm", "0 mm"]
[mechanism.rod]
length = "200 mm"
mass = "0 kg"
inertia = "0 kg m^2"
[mechanism.slider]
mass = "0 kg"
{more}
[simulation]
torque = "0 N m"
at = "crank"
tolerance = 1e-12
{simulation}
"#
    )
}

pub(super) const WEIGHT: f64 = 2.0 * 9.81 * 0.1;
const SWING: f64 = 0.02 + 2.0 * 0.1 * 0.1;

#[test]
fn a_pendulum_swings_back() {
    // Released at rest 120° from the bottom: the period is 4·√(J/mga)·K(sin 60°).
    let period = 4.0 * (SWING / WEIGHT).sqrt() * elliptic_k(60f64.to_radians().sin());
    let found = simulate(&pendulum(
        "",
        &format!(
            "start_angle = \"30 deg\"\nduration = \"{} s\"\noutput_step = \"{} s\"",
            3.0 * period,
            period / 40.0
        ),
    ));
    let phi = found.get("phi [deg]");
    let omega = found.get("omega [rad/s]");
    let fastest = (2.0 * WEIGHT * (1.0 + 0.5) / SWING).sqrt();
    for swing in 0..=3 {
        // At whole periods back at the start, half a period later on the other side.
        within("phi", phi[40 * swing], 30.0, budget::SWING * 120.0);
        within("omega", omega[40 * swing], 0.0, budget::SWING * fastest);
        if swing < 3 {
            within("phi", phi[40 * swing + 20], -210.0, budget::SWING * 120.0);
            within(
                "omega",
                omega[40 * swing + 10],
                -fastest,
                budget::SWING * fastest,
            );
            within(
                "omega",
                omega[40 * swing + 30],
                fastest,
                budget::SWING * fastest,
            );
        }
    }
    let kinetic = found.get("kinetic energy [J]");
    let balance = largest(&found.get("energy balance [J]")) / largest(&kinetic);
    assert!(balance <= budget::BALANCE, "{balance:e}");
}

#[test]
fn friction_brings_a_pendulum_to_rest() {
    // Each half swing loses c·(θ + θ′): mga·(cos θ′ − cos θ) = c·(θ + θ′), θ from the bottom, until the weight's
    // moment is below c.
    let c = 0.15;
    let mut turning = vec![120f64.to_radians()];
    loop {
        let from = *turning.last().unwrap();
        if (WEIGHT * from.sin()).abs() <= c && from < PI / 2.0 {
            break;
        }
        let lost = |to: f64| WEIGHT * (to.cos() - from.cos()) - c * (from + to);
        // The next turning point is the zero beside the trivial one at −θ.
        turning.push(bisect(lost, -from + 1e-6, from));
    }
    assert!(turning.len() > 6, "{turning:?}");
    let friction = format!("[[load]]\non = \"crank\"\nopposing_moment = \"{c} N m\"");
    let found = simulate(&pendulum(
        &friction,
        "start_angle = \"30 deg\"\nduration = \"12 s\"\noutput_step = \"1 ms\"",
    ));
    let phi = found.get("phi [deg]");
    let omega = found.get("omega [rad/s]");
    let mut seen = vec![30.0];
    for k in 1..phi.len() - 1 {
        let turns = (phi[k] - phi[k - 1]) * (phi[k + 1] - phi[k]) < 0.0;
        let stops = omega[k] == 0.0 && omega[k - 1] != 0.0;
        if turns || stops {
            seen.push(phi[k]);
        }
    }
    assert_eq!(seen.len(), turning.len(), "{seen:?} against {turning:?}");
    for (k, (found, expected)) in seen.iter().zip(&turning).enumerate() {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        within(
            "turning point",
            *found,
            -90.0 + side * expected.to_degrees(),
            budget::TURNING_SAMPLE_DEG,
        );
    }
    // Where it rests it is exact: no sampling.
    let last = turning.len() - 1;
    let side = if last % 2 == 0 { 1.0 } else { -1.0 };
    within(
        "rest",
        *phi.last().unwrap(),
        -90.0 + side * turning[last].to_degrees(),
        budget::REST_DEG,
    );
    assert!(imbalance(&found) <= budget::BALANCE);
}

/// Friction turns with the motion wherever that is, not only at the output points.
#[test]
fn the_output_step_does_not_change_the_motion() {
    let friction = "[[load]]\non = \"crank\"\nopposing_moment = \"0.05 N m\"";
    let end = |step: &str| {
        let run = format!("start_angle = \"30 deg\"\nduration = \"6 s\"\noutput_step = \"{step}\"");
        let found = simulate(&pendulum(friction, &run));
        ["phi [deg]", "losses [J]"].map(|column| *found.get(column).last().unwrap())
    };
    let [phi, losses] = end("10 ms");
    for step in ["0.5 s", "1.5 s", "6 s"] {
        let [other_phi, other_losses] = end(step);
        within(step, other_phi, phi, budget::SWING * 120.0);
        within(step, other_losses, losses, budget::SWING * losses);
    }
}
