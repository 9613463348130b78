//! Simulations against golden data, closed forms, and its own energy balance.
// Copied figures, counts and zeros are exact.
#![allow(clippy::float_cmp)]

mod axis;
mod bends;
mod branches;
mod columns;
mod control;
mod counterbalance;
mod emergency;
mod ends;
mod losses;
mod missing;
mod narrow;
mod parting;
mod pendulum;
mod refusals;
mod scheduled;
mod stops;
mod together;
mod turns;
mod winding;

use std::f64::consts::{PI, TAU};

use jred_analysis::simulate::{SimulationError, SimulationResult};
use jred_file::units::RPM;
use serde_json::Value;

use crate::reading::{parse, rendered};
use crate::support::{
    Columns, budget, edited, largest, near, near_column, press, press_text, within,
};

/// The simulation of a machine text, or why it ends before its time.
pub(crate) fn run(text: &str) -> Result<Columns, String> {
    let file = parse(text).map_err(|problem| rendered(&problem))?;
    let simulation = file.simulation.as_ref().unwrap();
    let found =
        jred_analysis::simulate::simulate(&file, simulation).and_then(SimulationResult::whole);
    let found = found.map_err(|why| match why {
        SimulationError::Machine(error) => error.to_string(),
        SimulationError::Parted { t, separation } => format!(
            "at t = {t:.6} s {}: at {}; {}",
            separation.what(),
            separation.state(),
            separation.cure()
        ),
        why => format!("{why:?}"),
    })?;
    Ok(Columns {
        names: found.names(),
        rows: found.rows().to_vec(),
    })
}

/// Its columns, all of them full.
#[track_caller]
pub(crate) fn simulate(text: &str) -> Columns {
    let columns = run(text).unwrap_or_else(|report| panic!("{report}"));
    assert!(
        columns
            .rows
            .iter()
            .flatten()
            .all(|x| x.unwrap().is_finite()),
        "not finite"
    );
    columns
}

/// The energy balance as a share of the energy turned over so far at most.
pub(crate) fn imbalance(columns: &Columns) -> f64 {
    let parts = [
        "motor work [J]",
        "process work [J]",
        "losses [J]",
        "kinetic energy [J]",
    ];
    let turned_over = parts
        .map(|name| largest(&columns.get(name)))
        .into_iter()
        .fold(0.0, f64::max);
    largest(&columns.get("energy balance [J]")) / turned_over
}

#[test]
fn golden_start_from_rest() {
    let case: Value =
        serde_json::from_str(include_str!("data/07_slider_crank_start_A.json")).unwrap();
    let input = |path: &str| case.pointer(&format!("/inputs{path}")).unwrap();
    let machine = format!(
        r#"
title = "golden"
gravity = ["{} m/s^2", "{} m/s^2"]
[mechanism]
type = "slider-crank"
offset = "{} m"
flywheel = "{} kg m^2"
[mechanism.crank]
length = "{} m"
mass = "{} kg"
inertia = "{} kg m^2"
com = ["{} m", "{} m"]
[mechanism.rod]
length = "{} m"
mass = "{} kg"
inertia = "{} kg m^2"
com = ["{} m", "{} m"]
[mechanism.slider]
mass = "{} kg"
[[load]]
on = "slider"
force = ["{} N", "{} N"]
[[load]]
on = "crank"
moment = "{} N m"
[simulation]
start_angle = "{} rad"
start_speed = "{} rad/s"
duration = "0.5 s"
output_step = "0.05 s"
torque = "{} N m"
at = "crank"
"#,
        input("/gravity/0"),
        input("/gravity/1"),
        input("/e"),
        input("/flywheel_I"),
        input("/r"),
        input("/m1"),
        input("/I1"),
        input("/crank_com/0"),
        input("/crank_com/1"),
        input("/l"),
        input("/m2"),
        input("/I2"),
        input("/coupler_com/0"),
        input("/coupler_com/1"),
        input("/m3"),
        input("/F_slider/F/0"),
        input("/F_slider/F/1"),
        input("/M_crank"),
        input("/phi0"),
        input("/omega0"),
        input("/T_drive"),
    );
    let found = simulate(&machine);
    let golden = Columns::of_json(&case["expected"]["tables"]["run"]);
    near_column("t", &found.get("t [s]"), &golden.get("t"), 1e-15);
    let phi: Vec<f64> = found
        .get("phi [deg]")
        .iter()
        .map(|phi| phi.to_radians())
        .collect();
    near_column("phi", &phi, &golden.get("phi"), budget::GOLDEN_MOTION);
    for (name, column) in [
        ("omega [rad/s]", "omega"),
        ("alpha [rad/s^2]", "alpha"),
        ("J_red [kg m^2]", "J"),
        ("kinetic energy [J]", "kinetic_energy"),
    ] {
        near_column(
            name,
            &found.get(name),
            &golden.get(column),
            budget::GOLDEN_MOTION,
        );
    }
    let balance = imbalance(&found);
    assert!(balance <= budget::BALANCE, "{balance:e}");
}

/// The press with its losses: the balance closes, and its parts are what textbook formulas make of φ and ω.
#[test]
fn energy_of_the_press() {
    let found = simulate(&press_text());
    let balance = imbalance(&found);
    assert!(balance <= budget::BALANCE, "{balance:e}");
    let phi: Vec<f64> = found
        .get("phi [deg]")
        .iter()
        .map(|phi| phi.to_radians())
        .collect();
    let omega = found.get("omega [rad/s]");
    let each = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        phi.iter().zip(&omega).map(|(p, w)| f(*p, *w)).collect()
    };
    // Rotor and driver pulley turn three times as fast.
    let whole = |phi: f64| press::inertia(phi) + press::train() + 0.02 * press::RATIO.powi(2);
    let check = |name: &str, f: &dyn Fn(f64, f64) -> f64| {
        near_column(name, &found.get(name), &each(f), budget::ANGLE_IN_DEGREES);
    };
    check("J_red [kg m^2]", &|phi, _| whole(phi));
    check("kinetic energy [J]", &|phi, w| 0.5 * whole(phi) * w * w);
    check("potential energy [J]", &|phi, _| press::potential(phi));
    check("motor torque [N m]", &|_, w| {
        let rpm = w * press::RATIO / RPM;
        if rpm < 500.0 {
            60.0 - 15.0 * rpm / 500.0
        } else {
            (45.0 - 45.0 * (rpm - 500.0) / 300.0).max(0.0)
        }
    });
    // The pressing force takes the same energy at every passage of bottom dead centre.
    let work = found.get("process work [J]");
    let strokes = ((phi.last().unwrap() - PI) / TAU + 0.5).floor();
    let one = {
        let n = 90_000;
        let (from, width) = (315f64.to_radians(), 45f64.to_radians());
        let force = (0..=n).map(|k| press::process(from + width * f64::from(k) / f64::from(n)));
        crate::support::numerics::trapezoid(
            width / f64::from(n),
            force.collect::<Vec<_>>().into_iter(),
        )
    };
    // The last angle is not in the window of the pressing force.
    let into = phi.last().unwrap().to_degrees().rem_euclid(360.0);
    assert!(!(310.0..360.0).contains(&into), "{into}");
    near(
        "process work",
        *work.last().unwrap(),
        strokes * one,
        budget::PRESSING_WORK,
    );
    // Losses of the press: guide friction over the ram's way, bearings, belt. The first two from the rows.
    assert!(found.get("losses [J]").windows(2).all(|w| w[1] >= w[0]));
}

/// A turntable behind a gear pair 2 : 1: J = 0.02 + 0.08/4 + 0.01 = 0.05 kg m².
fn turntable(more: &str, simulation: &str) -> String {
    format!(
        r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
flywheel = "0.01 kg m^2"
[[mechanism.stage]]
driver = {{ teeth = 20, inertia = "0.02 kg m^2" }}
driven = {{ teeth = 40, inertia = "0.08 kg m^2" }}
{more}
[simulation]
start_angle = "0 deg"
{simulation}
"#
    )
}

const J: f64 = 0.05;

#[test]
fn coast_down_to_standstill() {
    // 1.2 N m at the output are 0.6 N m at the drive link, with 0.4 N m there: α = −20 rad/s².
    let friction = r#"
[[load]]
on = "shaft-2"
opposing_moment = "1.2 N m"
[[load]]
on = "shaft-1"
opposing_moment = "0.4 N m"
"#;
    for sign in [1.0, -1.0] {
        let found = simulate(&turntable(
            friction,
            &format!(
                r#"start_speed = "{} rad/s"
duration = "4 s"
output_step = "0.01 s"
torque = "0 N m""#,
                sign * 31.4
            ),
        ));
        let (time, omega, phi) = (
            found.get("t [s]"),
            found.get("omega [rad/s]"),
            found.get("phi [deg]"),
        );
        let (stop, deceleration) = (31.4 / 20.0, 20.0);
        for (row, t) in time.iter().enumerate() {
            let (w, angle) = if *t < stop {
                (
                    31.4 - deceleration * t,
                    31.4 * t - 0.5 * deceleration * t * t,
                )
            } else {
                (0.0, 0.5 * 31.4 * stop)
            };
            within("omega", omega[row], sign * w, budget::STANDSTILL * 31.4);
            within(
                "phi",
                phi[row].to_radians(),
                sign * angle,
                budget::STANDSTILL * 0.5 * 31.4 * stop,
            );
            if *t > stop + 1e-9 {
                assert_eq!(
                    omega[row].to_bits() << 1,
                    0,
                    "stays at t = {t}: {}",
                    omega[row]
                );
            }
        }
        let rest = |name: &str| -> Vec<f64> {
            let column = found.get(name).into_iter().zip(&time);
            column
                .filter(|(_, t)| **t > stop + 1e-9)
                .map(|(x, _)| x)
                .collect()
        };
        assert!(rest("alpha [rad/s^2]").iter().all(|a| *a == 0.0));
        assert!(rest("phi [deg]").windows(2).all(|w| w[0] == w[1]));
        // All of ½·J·ω² went into friction.
        for losses in rest("losses [J]") {
            near("losses", losses, 0.5 * J * 31.4 * 31.4, budget::STANDSTILL);
        }
        assert!(imbalance(&found) <= budget::BALANCE);
    }
}

#[test]
fn friction_holds_until_the_torque_exceeds_it() {
    let run = |torque: f64| {
        let friction = "[[load]]\non = \"shaft-2\"\nopposing_moment = \"1.2 N m\"";
        let simulation =
            format!("duration = \"1 s\"\noutput_step = \"0.1 s\"\ntorque = \"{torque} N m\"");
        simulate(&turntable(friction, &simulation))
    };
    for torque in [0.0, 0.599, -0.599] {
        let found = run(torque);
        for name in [
            "omega [rad/s]",
            "phi [deg]",
            "alpha [rad/s^2]",
            "losses [J]",
        ] {
            assert!(
                found.get(name).iter().all(|x| *x == 0.0),
                "{torque}: {name}"
            );
        }
    }
    for torque in [0.601f64, -0.601, 5.0] {
        let found = run(torque);
        let alpha = torque.signum() * (torque.abs() - 0.6) / J;
        near(
            "omega",
            *found.get("omega [rad/s]").last().unwrap(),
            alpha,
            budget::CLOSED_MOTION,
        );
        near(
            "phi",
            found.get("phi [deg]").last().unwrap().to_radians(),
            alpha / 2.0,
            budget::CLOSED_MOTION,
        );
    }
}

#[test]
fn a_falling_torque_settles() {
    // T = 5 N m·(1 − n/1000 rpm) against b = 0.02 N m s at the output: k = 5/(1000 rpm), at the drive link b/4.
    let viscous = "[[load]]\non = \"shaft-2\"\nviscous_moment = \"0.02 N m s/rad\"";
    let found = simulate(&turntable(
        viscous,
        r#"duration = "5 s"
output_step = "0.05 s"
torque_speed = [["0 rpm", "5 N m"], ["1000 rpm", "0 N m"]]"#,
    ));
    let k = 5.0 / (1000.0 * RPM) + 0.02 / 4.0;
    let (settled, rate) = (5.0 / k, k / J);
    let expected: Vec<f64> = found
        .get("t [s]")
        .iter()
        .map(|t| -settled * (-rate * t).exp_m1())
        .collect();
    near_column(
        "omega",
        &found.get("omega [rad/s]"),
        &expected,
        budget::CLOSED_MOTION,
    );
    let angle: Vec<f64> = found
        .get("t [s]")
        .iter()
        .map(|t| (settled * t + settled / rate * (-rate * t).exp_m1()).to_degrees())
        .collect();
    near_column(
        "phi",
        &found.get("phi [deg]"),
        &angle,
        budget::CLOSED_MOTION,
    );
    assert!(imbalance(&found) <= budget::BALANCE);
}

#[test]
fn the_tolerance_decides() {
    let run = |tolerance: &str| {
        let text = edited(&press_text(), "at = \"motor\"", tolerance);
        *simulate(&text).get("phi [deg]").last().unwrap()
    };
    let best = run("tolerance = 1e-13");
    let errors = ["tolerance = 1e-4", "tolerance = 1e-10"].map(|t| (run(t) - best).abs() / best);
    println!("{errors:?}");
    assert!(errors[0] > 10.0 * errors[1], "{errors:?}");
    assert!(errors[1] < budget::TOLERANCE_1E10, "{errors:?}");
}
