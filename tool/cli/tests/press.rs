//! The numbers of the press example, derived independently: textbook formulas in `support/press.rs`, other numerical methods, no code of the tool.
//! Compared with the output of the command.

mod drives;

use std::f64::consts::TAU;
use std::sync::OnceLock;

use crate::support::numerics::{derivative, trapezoid};
use crate::support::press::{self, Input, figures};
use crate::support::{
    Columns, Folder, budget, jred_of, largest, near, near_column, press_file, shipped, within,
};
use drives::{ONE_GEARBOX, ONE_MOTOR};
use jred_file::units::RPM;
use serde_json::Value;

/// Instants of the reference: 2.5 µs apart, a hundred times closer than the tool's.
const FINE: usize = 200_000;

/// The reference cycle at the input of the belt.
fn reference() -> &'static [Input] {
    static CYCLE: OnceLock<Vec<Input>> = OnceLock::new();
    CYCLE.get_or_init(|| press::cycle(FINE))
}

fn meaningful(text: &str) -> Vec<String> {
    let lines = text.lines().map(|line| {
        let line = line.split('#').next().unwrap_or_default();
        line.split_whitespace().collect::<Vec<_>>().join(" ")
    });
    lines.filter(|line| !line.is_empty()).collect()
}

#[test]
fn the_example_is_the_machine_written_down_here() {
    let text = crate::support::press_text();
    let (machine, _) = text.split_once("[simulation]").unwrap();
    let machine: Vec<String> = meaningful(machine)
        .into_iter()
        .filter(|line| !line.starts_with("title"))
        .collect();
    assert_eq!(
        machine,
        meaningful(press::STATED),
        "machines/press.toml was changed: change support/press.rs with it"
    );
    assert!(!text.contains("[rules]"), "the defaults are judged here");
}

#[test]
fn both_derivations_of_the_torque_agree() {
    // Independent of the tool: d'Alembert and Lagrange on one side, the power balance on the other.
    let times: Vec<f64> = (40..=360).map(|k| 1e-3 * f64::from(k) + 1.37e-5).collect();
    let lagrange: Vec<f64> = times.iter().map(|t| press::crank_torque(*t)).collect();
    let power: Vec<f64> = times
        .iter()
        .map(|t| press::crank_torque_by_power(*t))
        .collect();
    near_column("torque by power", &power, &lagrange, budget::DERIVATION);
}

#[test]
fn the_reduced_link() {
    let run = jred_of(
        "reduce {} --positions 720 --links --format json",
        [&press_file()],
    );
    let columns = Columns::of_json(&run.ends(0).json());
    let angles = columns.get("phi [deg]");
    let angles: Vec<f64> = angles.iter().map(|phi| phi.to_radians()).collect();
    let check = |name: &str, expected: &dyn Fn(f64) -> f64, share: f64| {
        let expected: Vec<f64> = angles.iter().map(|phi| expected(*phi)).collect();
        near_column(name, &columns.get(name), &expected, share);
    };
    let slope = |phi: f64| derivative(press::inertia, phi, 2e-3);
    check(
        "J_red [kg m^2]",
        &|phi| press::inertia(phi) + press::train(),
        budget::CLOSED_FORM,
    );
    check("J_red' [kg m^2/rad]", &slope, budget::DIFFERENCES);
    check(
        "J_red'' [kg m^2/rad^2]",
        &|phi| derivative(slope, phi, 2e-2),
        budget::SECOND_DIFFERENCES,
    );
    check("U [J]", &press::potential, budget::CLOSED_FORM);
    check(
        "T_potential [N m]",
        &|phi| -derivative(press::potential, phi, 2e-3),
        budget::DIFFERENCES,
    );
    check("T_process [N m]", &press::process, budget::CLOSED_FORM);
    check(
        "b_viscous [N m s/rad]",
        &press::viscous,
        budget::CLOSED_FORM,
    );
    check("c_coulomb [N m]", &press::coulomb, budget::CLOSED_FORM);
    for (k, link) in ["crank", "rod", "slider"].into_iter().enumerate() {
        let name = format!("J_red {link} [kg m^2]");
        check(&name, &|phi| press::shares(phi)[k], budget::CLOSED_FORM);
    }
    check(
        "J_red flywheel and drive train [kg m^2]",
        &|_| 0.05 + press::train(),
        budget::CLOSED_FORM,
    );
}

fn over_time(positions: &str) -> Columns {
    let run = jred_of(
        "reduce {} --over time --positions {} --format csv",
        [&press_file(), &positions],
    );
    run.ends(0).columns()
}

#[test]
fn the_torque_over_time() {
    let columns = over_time("2001");
    let times = columns.get("t [s]");
    assert_eq!(times.first(), Some(&0.0));
    within("cycle", times[2000], press::CYCLE, 1e-15);
    let check = |name: &str, expected: &dyn Fn(f64) -> f64, share: f64| {
        let expected: Vec<f64> = times.iter().map(|t| expected(*t)).collect();
        near_column(name, &columns.get(name), &expected, share);
    };
    check(
        "phi [deg]",
        &|t| press::motion(t)[0].to_degrees(),
        budget::CLOSED_FORM,
    );
    check(
        "omega [rad/s]",
        &|t| press::motion(t)[1],
        budget::CLOSED_FORM,
    );
    check(
        "alpha [rad/s^2]",
        &|t| press::motion(t)[2],
        budget::CLOSED_FORM,
    );
    check(
        "T_drive [N m]",
        &|t| press::crank_torque(t) + press::train() * press::motion(t)[2],
        budget::DERIVATION,
    );
    check(
        "T_input [N m]",
        &|t| press::input(t).torque,
        budget::DERIVATION,
    );
}

/// Over a closed cycle the drive delivers exactly the energy that the loads take: the ram's friction over twice the stroke, the bearings' over the
/// motion, 0.4·(2π)²/0.4 s·∫S′² dz with ∫S′² dz = 10/7, and the work of the pressing force.
#[test]
fn the_energy_of_a_cycle() {
    let friction = 150.0 * 2.0 * 0.06;
    let bearings = 0.4 * TAU * TAU / press::MOVE * (10.0 / 7.0);
    let n = 90_000;
    let (from, width) = (315f64.to_radians(), 45f64.to_radians());
    let force = (0..=n).map(|k| -press::process(from + width * f64::from(k) / f64::from(n)));
    let pressing = trapezoid(width / f64::from(n), force.collect::<Vec<_>>().into_iter());
    let columns = over_time("100001");
    let power: Vec<f64> = columns
        .get("T_drive [N m]")
        .iter()
        .zip(columns.get("omega [rad/s]"))
        .map(|(torque, omega)| torque * omega)
        .collect();
    let work = trapezoid(press::CYCLE / 1e5, power.into_iter());
    near(
        "work of the drive over a cycle",
        work,
        friction + bearings + pressing,
        budget::QUADRATURE,
    );
}

/// The command's answer as JSON, with more arguments.
fn size(steps: &str, motors: Option<&str>, gearboxes: Option<&str>) -> Value {
    let folder = Folder::new();
    let file = press_file();
    let run = match (motors, gearboxes) {
        (Some(motors), Some(gearboxes)) => jred_of(
            "size {} --format json --all --steps {} --motors {} --gearboxes {}",
            [
                &file,
                &steps,
                &folder.file("motors.csv", motors),
                &folder.file("gearboxes.csv", gearboxes),
            ],
        ),
        _ => jred_of(
            "size {} --format json --all --motor sgm?h-* --steps {}",
            [&file, &steps],
        ),
    };
    run.ends(0).json()
}

fn check_figures(what: &str, found: &Value, values: &[f64], [integral, peak]: [f64; 2]) {
    let expected = figures(values);
    let size = largest(values);
    let one = |name: &str| found[name].as_f64().unwrap();
    within(
        &format!("{what}, min"),
        one("min"),
        expected.min,
        peak * size,
    );
    within(
        &format!("{what}, max"),
        one("max"),
        expected.max,
        peak * size,
    );
    within(
        &format!("{what}, mean"),
        one("mean"),
        expected.mean,
        integral * expected.rms,
    );
    near(&format!("{what}, RMS"), one("rms"), expected.rms, integral);
}

fn check_duty(answer: &Value, tolerances: [f64; 2]) {
    let cycle = reference();
    let of = |quantity: fn(&Input) -> f64| cycle.iter().map(quantity).collect::<Vec<_>>();
    near("cycle", answer["cycle [s]"].as_f64().unwrap(), 0.5, 1e-15);
    let check = |name: &str, values: &[f64]| check_figures(name, &answer[name], values, tolerances);
    check("input torque [N m]", &of(|i| i.torque));
    check("input speed [rad/s]", &of(|i| i.speed));
    check("input inertia [kg m^2]", &of(|i| i.inertia));
    let times = (0..=FINE).map(|k| press::CYCLE * k as f64 / FINE as f64);
    let torque: Vec<f64> = times.map(press::crank_torque).collect();
    check("drive link torque [N m]", &torque);
    // The largest torque against gravity, searched every 0.01° instead of every 0.5°.
    let weight = (0..36_000).map(|k| {
        let phi = f64::from(k) / 100.0;
        derivative(press::potential, phi.to_radians(), 2e-3).abs() / press::RATIO
    });
    let hold = weight.fold(0.0, f64::max);
    near(
        "holding torque",
        answer["holding torque [N m]"].as_f64().unwrap(),
        hold,
        budget::HOLDING_GRID,
    );
}

#[test]
fn the_duty_at_the_input() {
    let answer = size("2000", None, None);
    check_duty(&answer, [budget::FINE_STEPS, budget::DEFAULT_PEAK]);
}

#[test]
fn the_duty_at_the_input_with_fine_steps() {
    let answer = size("200000", Some(ONE_MOTOR), Some(ONE_GEARBOX));
    check_duty(&answer, [budget::FINE_STEPS, budget::FINE_PEAK]);
}

/// RMS of the input torque of a press with `steps`.
fn rms(text: &str, steps: u32) -> f64 {
    let folder = Folder::new();
    let run = jred_of(
        "size {} --format json --steps {} --motors {} --gearboxes {}",
        [
            &folder.file("press.toml", text),
            &steps.to_string(),
            &folder.file("motors.csv", ONE_MOTOR),
            &folder.file("gearboxes.csv", ONE_GEARBOX),
        ],
    );
    run.json()["input torque [N m]"]["rms"].as_f64().unwrap()
}

/// With ramps and efficiency: the RMS does not depend on the number of instants.
#[test]
fn the_rms_needs_no_steps() {
    let press = crate::support::press_text();
    let limit = figures(&reference().iter().map(|i| i.torque).collect::<Vec<_>>()).rms;
    let errors = [16, 250, 2000, 16_000].map(|steps| (rms(&press, steps) / limit - 1.0).abs());
    println!("relative errors of the RMS: {errors:?}");
    assert!(errors.iter().all(|error| *error < budget::FINE_STEPS));
}

/// A screw's input turns although the drive link slides: F·v = η·T·ω where it drives, with 97 % of the belt and 88 % of the screw, lead 10 mm, i = 2.
#[test]
fn the_input_of_a_screw_is_a_torque() {
    let run = jred_of(
        "reduce {} --over time --positions 401 --format csv",
        [&shipped("excavator-bucket.toml")],
    );
    let columns = run.ends(0).columns();
    let [force, torque, speed, acceleration] =
        ["F_drive [N]", "T_input [N m]", "v [m/s]", "a [m/s^2]"].map(|name| columns.get(name));
    let per_metre = 2.0 * TAU / 0.01;
    let mut seen = 0;
    for k in 0..force.len() {
        let steady = acceleration[k].abs() < 1e-2 && force[k] * speed[k] > 50.0;
        if steady {
            let ideal = force[k] / per_metre / (0.97 * 0.88);
            assert!(
                (torque[k] / ideal - 1.0).abs() < 0.01,
                "{} {ideal}",
                torque[k]
            );
            seen += 1;
        }
    }
    assert!(seen > 0);
}
