//! `jred reduce --points`: golden transfer functions, closed forms of velocity and acceleration.

use crate::support::{Folder, budget, jred, jred_of, near_column, press_file};
use jred_file::units::RPM;
use serde_json::Value;

/// The slider-crank of the golden data as a machine file.
const GOLDEN: &str = r#"
gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "slider-crank"
offset = "12 mm"
[mechanism.crank]
length = "50 mm"
mass = "0.8 kg"
inertia = "0.0006 kg m^2"
com = ["15 mm", "4 mm"]
[mechanism.rod]
length = "200 mm"
mass = "0.45 kg"
inertia = "0.0021 kg m^2"
com = ["75 mm", "6 mm"]
[mechanism.slider]
mass = "0.6 kg"
[[load]]
on = "slider"
force = ["-120 N", "0 N"]
"#;

fn golden_rows() -> (Vec<String>, Vec<Vec<f64>>) {
    let text = include_str!("../../../tests/data/01_slider_crank_A.json");
    let case: Value = serde_json::from_str(text).unwrap();
    let table = &case["expected"]["tables"]["position"];
    let names = table["columns"].as_array().unwrap().iter();
    let rows = table["rows"].as_array().unwrap().iter();
    let row = |row: &Value| {
        let cells = row.as_array().unwrap().iter();
        cells.map(|x| x.as_f64().unwrap()).collect()
    };
    (
        names.map(|n| n.as_str().unwrap().to_owned()).collect(),
        // The last three are not multiples of ten degrees.
        rows.map(row).take(36).collect(),
    )
}

#[test]
fn transfer_functions_are_the_golden_ones() {
    let folder = Folder::new();
    let file = folder.file("golden.toml", GOLDEN);
    let found = jred([&"reduce", &file, &"--points", &"--format", &"csv"])
        .ends(0)
        .columns();
    let (names, rows) = golden_rows();
    let golden = |name: &str| -> Vec<f64> {
        let k = names.iter().position(|n| n == name).unwrap();
        rows.iter().map(|row| row[k]).collect()
    };
    for (column, name) in [
        ("B x [m]", "xB"),
        ("B x' [m/rad]", "dxB"),
        ("B x'' [m/rad^2]", "d2xB"),
        ("slider com x [m]", "xB"),
        ("rod psi' [rad/rad]", "dth"),
        ("rod psi'' [rad/rad^2]", "d2th"),
    ] {
        near_column(
            column,
            &found.get(column),
            &golden(name),
            budget::CLOSED_FORM,
        );
    }
    let psi: Vec<f64> = golden("th").iter().map(|x| x.to_degrees()).collect();
    near_column(
        "rod psi",
        &found.get("rod psi [deg]"),
        &psi,
        budget::CLOSED_FORM,
    );
    assert!(
        !found.names.iter().any(|name| name.contains("/s")),
        "velocities without a motion: {:?}",
        found.names
    );
    // JSON contains the same numbers.
    let json = jred([&"reduce", &file, &"--points", &"--format", &"json"]).json();
    let again = crate::support::Columns::of_json(&json);
    assert_eq!(again.names, found.names);
    for name in &found.names {
        // The JSON reader of the test rounds the last digit.
        near_column(
            name,
            &again.get(name),
            &found.get(name),
            budget::CLOSED_FORM,
        );
    }
}

/// At constant ω, v = −r·ω·(sin φ + …): the in-line press by hand.
#[test]
fn velocities_and_accelerations_in_time() {
    let found = jred_of(
        "reduce {} --points --speed '-90 rpm' --accel '35 rad/s^2' --format csv",
        [&press_file()],
    )
    .ends(0)
    .columns();
    let (r, l) = (0.03f64, 0.18f64);
    let (omega, alpha) = (-90.0 * RPM, 35.0);
    let phi: Vec<f64> = found
        .get("phi [deg]")
        .iter()
        .map(|x| x.to_radians())
        .collect();
    let of = |f: &dyn Fn(f64) -> f64| phi.iter().map(|&phi| f(phi)).collect::<Vec<f64>>();
    // x = r·cos φ + w, w² = l² − r²·sin²φ: w·w′ = −r²·sin φ·cos φ, w·w″ = −w′² − r²·cos 2φ.
    let w = |phi: f64| (l * l - (r * phi.sin()).powi(2)).sqrt();
    let d1 = |phi: f64| -r * r * phi.sin() * phi.cos() / w(phi);
    let d2 = |phi: f64| -(d1(phi).powi(2) + r * r * (2.0 * phi).cos()) / w(phi);
    let v = |phi: f64| (-r * phi.sin() + d1(phi)) * omega;
    let a =
        |phi: f64| (-r * phi.sin() + d1(phi)) * alpha + (-r * phi.cos() + d2(phi)) * omega * omega;
    near_column(
        "v_x",
        &found.get("B v_x [m/s]"),
        &of(&v),
        budget::CLOSED_FORM,
    );
    near_column(
        "v",
        &found.get("B v [m/s]"),
        &of(&|p| v(p).abs()),
        budget::CLOSED_FORM,
    );
    near_column(
        "a_x",
        &found.get("B a_x [m/s^2]"),
        &of(&a),
        budget::CLOSED_FORM,
    );
    // The crank pin moves on a circle.
    let speed = of(&|_| r * omega.abs());
    near_column("A v", &found.get("A v [m/s]"), &speed, budget::CLOSED_FORM);
    let size = of(&|_| r * (omega.powi(4) + alpha * alpha).sqrt());
    near_column("A a", &found.get("A a [m/s^2]"), &size, budget::CLOSED_FORM);
    // sin β = −(r/l)·sin φ.
    let turn = of(&|p| -r * p.cos() * omega / w(p));
    near_column(
        "rod",
        &found.get("rod omega [rad/s]"),
        &turn,
        budget::CLOSED_FORM,
    );
    let slider = found.get("slider alpha [rad/s^2]");
    assert!(slider.iter().all(|x| x.abs() <= 0.0), "{slider:?}");
}

/// Over time the speed is the slope of the position.
#[test]
fn over_time_velocities_are_those_of_the_motion() {
    let found = jred_of(
        "reduce {} --points --over time --positions 2001 --format csv",
        [&press_file()],
    )
    .ends(0)
    .columns();
    let (t, x) = (found.get("t [s]"), found.get("rod com x [m]"));
    let (v, a) = (
        found.get("rod com v_x [m/s]"),
        found.get("rod com a_x [m/s^2]"),
    );
    let step = t[1] - t[0];
    let largest = crate::support::largest(&v);
    for k in (4..1990).step_by(97) {
        let slope = (8.0 * (x[k + 1] - x[k - 1]) - (x[k + 2] - x[k - 2])) / (12.0 * step);
        crate::support::within("v_x", v[k], slope, 1e-6 * largest);
        let slope = (8.0 * (v[k + 1] - v[k - 1]) - (v[k + 2] - v[k - 2])) / (12.0 * step);
        crate::support::within("a_x", a[k], slope, 1e-5 * crate::support::largest(&a));
    }
}

#[test]
fn what_cannot_be_asked_for() {
    let press = press_file();
    jred([&"reduce", &press, &"--points", &"--links"]).ends(2);
    jred([&"reduce", &press, &"--accel", &"3 rad/s^2"]).ends(2);
    jred([&"reduce", &press, &"--speed", &"0.2 m/s"])
        .ends(2)
        .says(&["--speed \"0.2 m/s\" cannot be used", "angular speed", "rpm"]);
    jred([&"reduce", &press, &"--speed", &"1 rpm", &"--over", &"time"])
        .ends(2)
        .says(&["the motion of the machine file gives the speed"]);
    let folder = Folder::new();
    let file = folder.file("golden.toml", GOLDEN);
    jred([&"reduce", &file, &"--reactions"])
        .ends(2)
        .says(&["forces and energies need a speed", "--speed \"60 rpm\""]);
}
