//! The numbers of the press example, derived independently: textbook formulas in `support/press.rs`, other numerical
//! methods, none of the tool's code. What is compared is what the command prints.

mod support;

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::sync::OnceLock;

use serde_json::Value;
use support::numerics::{derivative, trapezoid};
use support::press::{self, Geared, Input, figures};
use support::{
    Columns, Folder, budget, edited_press, jred, largest, near, near_column, press_file, within,
};

const RPM: f64 = PI / 30.0;

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
    let text = support::press_text();
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
    // Not of the tool: d'Alembert and Lagrange on one side, the power balance on the other.
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
    let run = jred([
        &"reduce",
        &press_file(),
        &"--positions",
        &"720",
        &"--links",
        &"--format",
        &"json",
    ]);
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
    let run = jred([
        &"reduce",
        &press_file(),
        &"--over",
        &"time",
        &"--positions",
        &positions,
        &"--format",
        &"csv",
    ]);
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
        "T_motor_shaft [N m]",
        &|t| press::input(t).torque,
        budget::DERIVATION,
    );
}

/// Over a cycle that ends as it began, the drive gives exactly what the loads take: the ram's friction over twice the
/// stroke, the bearings' over the motion, 0.4·(2π)²/0.4 s·∫S′² dz with ∫S′² dz = 10/7, and the pressing force over its
/// way.
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
        (Some(motors), Some(gearboxes)) => jred([
            &"size",
            &file,
            &"--format",
            &"json",
            &"--steps",
            &steps,
            &"--motors",
            &folder.file("motors.csv", motors),
            &"--gearboxes",
            &folder.file("gearboxes.csv", gearboxes),
        ]),
        _ => jred([&"size", &file, &"--format", &"json", &"--steps", &steps]),
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
    // The largest torque against gravity, sought here every 0.01° instead of every 0.5°.
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
    check_duty(&answer, [budget::DEFAULT_STEPS, budget::DEFAULT_PEAK]);
}

#[test]
fn the_duty_at_the_input_with_fine_steps() {
    let answer = size("200000", Some(ONE_MOTOR), Some(ONE_GEARBOX));
    check_duty(&answer, [budget::FINE_STEPS, budget::FINE_PEAK]);
}

/// Rows of the built-in catalogue, by key: name of the column without unit to text.
fn catalogue(name: &str) -> BTreeMap<String, BTreeMap<String, String>> {
    let path = format!("{}/catalogue/{name}", env!("CARGO_MANIFEST_DIR"));
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names: Vec<String> = reader
        .headers()
        .unwrap()
        .iter()
        .map(|title| title.split(" [").next().unwrap().to_owned())
        .collect();
    let rows = reader.records().map(|record| {
        let record = record.unwrap();
        let row: BTreeMap<_, _> = names
            .iter()
            .cloned()
            .zip(record.iter().map(String::from))
            .collect();
        (row["key"].clone(), row)
    });
    rows.collect()
}

/// A row of a catalogue: name of the column to text.
type Row = BTreeMap<String, String>;

fn number(row: &Row, name: &str) -> Option<f64> {
    let cell = row.get(name)?;
    (!cell.is_empty()).then(|| cell.parse().unwrap())
}

/// The cycle as one motor sees it.
struct AtMotor {
    torque: Vec<f64>,
    speed: Vec<f64>,
    lambda: Vec<f64>,
    mean_speed: f64,
}

const STEP: f64 = press::CYCLE / FINE as f64;

impl AtMotor {
    fn new(motor: &Row, gearbox: Option<&Row>) -> Self {
        let g = |name: &str| number(gearbox?, name);
        let geared = Geared {
            ratio: g("ratio").unwrap_or(1.0),
            efficiency: g("efficiency").unwrap_or(100.0) / 100.0,
            gearbox: g("input_inertia").unwrap_or(0.0) * 1e-4,
            rotor: number(motor, "rotor_inertia").unwrap() * 1e-4,
        };
        let cycle = reference();
        let points = cycle.iter().map(|i| geared.motor(i));
        let (torque, speed): (Vec<f64>, Vec<f64>) = points.map(|[t, n]| (t, n)).unzip();
        let lambda = cycle.iter().map(|i| geared.inertia_ratio(i)).collect();
        let mean_speed = trapezoid(STEP, speed.iter().map(|n| n.abs())) / press::CYCLE;
        Self {
            torque,
            speed,
            lambda,
            mean_speed,
        }
    }
}

/// What docs/sizing-rules.md says about a motor's limits.
struct Limits {
    rated: f64,
    rated_speed: f64,
    standstill: f64,
    peak: f64,
    max_speed: f64,
    corner: f64,
    at_top: f64,
}

impl Limits {
    fn of(motor: &Row) -> Self {
        let m = |name: &str| number(motor, name);
        let (rated, rated_speed) = (m("rated_torque").unwrap(), m("rated_speed").unwrap() * RPM);
        Self {
            rated,
            rated_speed,
            standstill: m("standstill_torque").unwrap_or(rated),
            peak: m("peak_torque").unwrap(),
            max_speed: m("max_speed").map_or(rated_speed, |n| n * RPM),
            corner: m("peak_corner_speed").map_or(rated_speed, |n| n * RPM),
            at_top: m("peak_torque_at_max_speed").unwrap_or(rated),
        }
    }

    fn continuous(&self, n: f64) -> f64 {
        if n <= self.rated_speed {
            self.standstill - (self.standstill - self.rated) * n / self.rated_speed
        } else if n <= self.max_speed {
            self.rated * self.rated_speed / n
        } else {
            0.0
        }
    }

    fn short_time(&self, n: f64) -> f64 {
        if n <= self.corner {
            self.peak
        } else if n <= self.max_speed {
            let part = (n - self.corner) / (self.max_speed - self.corner);
            self.peak - (self.peak - self.at_top) * part
        } else {
            0.0
        }
    }
}

/// Checks every figure of one drive, and every rule's figure, limit and verdict.
fn check_drive(drive: &Value, motor: &Row, gearbox: Option<&Row>, tolerances: [f64; 2]) {
    let name = format!("{} {:?}", motor["key"], gearbox.map(|g| &g["key"]));
    let seen = AtMotor::new(motor, gearbox);
    check_motor_duty(&name, &drive["duty"], &seen, tolerances);
    let [integral, peak] = tolerances;
    let mut expected = motor_rules(&seen, motor, gearbox, tolerances);
    if let Some(gearbox) = gearbox {
        let cycle = reference();
        let turning = trapezoid(STEP, cycle.iter().map(|i| i.speed.abs()));
        let cubes = cycle.iter().map(|i| i.speed.abs() * i.torque.abs().powi(3));
        let cubic_mean = (trapezoid(STEP, cubes) / turning).cbrt();
        let most = cycle
            .iter()
            .fold(0.0, |most: f64, i| most.max(i.torque.abs()));
        let (mean, fastest) = (seen.mean_speed / RPM, largest(&seen.speed) / RPM);
        let g = |name: &str| number(gearbox, name);
        expected.extend([
            ("gearbox peak torque", most, g("peak_output_torque"), peak),
            (
                "gearbox cubic-mean torque",
                cubic_mean,
                g("rated_output_torque"),
                integral,
            ),
            ("gearbox mean speed", mean, g("rated_input_speed"), integral),
            ("gearbox largest speed", fastest, g("max_input_speed"), peak),
        ]);
    }
    let checks = drive["checks"].as_array().unwrap();
    assert_eq!(checks.len(), if gearbox.is_some() { 9 } else { 5 });
    for (rule, value, limit, share) in expected {
        let check = checks.iter().find(|c| c["rule"] == rule).unwrap();
        let what = format!("{name}: {rule}");
        near(&what, check["value"].as_f64().unwrap(), value, share);
        match limit {
            // The peak's limit moves with the instant at which the duty comes closest.
            Some(limit) => near(&what, check["limit"].as_f64().unwrap(), limit, share),
            None => assert!(check["limit"].is_null(), "{what}"),
        }
        let verdict = match limit {
            None => "not-checked",
            Some(limit) if value > limit => "fail",
            Some(_) if rule == "inertia ratio" && value > 5.0 => "warn",
            Some(_) => "pass",
        };
        assert_eq!(check["verdict"], verdict, "{what}: {check}");
    }
}

fn check_motor_duty(name: &str, duty: &Value, seen: &AtMotor, tolerances: [f64; 2]) {
    let points = seen.torque.iter().zip(&seen.speed);
    let power: Vec<f64> = points.map(|(t, n)| t * n).collect();
    for (what, values) in [
        ("torque [N m]", &seen.torque),
        ("speed [rad/s]", &seen.speed),
        ("power [W]", &power),
        ("inertia ratio", &seen.lambda),
    ] {
        let title = format!("{name}: {what}");
        check_figures(&title, &duty[what], values, tolerances);
    }
    let regenerative = trapezoid(STEP, power.iter().map(|p| (-p).max(0.0)));
    let motoring = trapezoid(STEP, power.iter().map(|p| p.max(0.0)));
    let check = |what: &str, expected: f64, most: f64| {
        let found = duty[what].as_f64().unwrap();
        within(&format!("{name}: {what}"), found, expected, most);
    };
    let most = budget::ENERGY_PARTS * tolerances[0] * motoring;
    check("regenerative energy [J]", regenerative, most);
    check("motoring energy [J]", motoring, most);
    let most = tolerances[0] * seen.mean_speed;
    check("mean |speed| [rad/s]", seen.mean_speed, most);
}

/// Rule, figure, limit and tolerance.
type Expected = (&'static str, f64, Option<f64>, f64);

fn motor_rules(
    seen: &AtMotor,
    motor: &Row,
    gearbox: Option<&Row>,
    [integral, peak]: [f64; 2],
) -> Vec<Expected> {
    let limits = Limits::of(motor);
    let ratio = gearbox.map_or(1.0, |g| number(g, "ratio").unwrap());
    let weight = (0..3600).map(|k| {
        let phi = f64::from(k) / 10.0;
        derivative(press::potential, phi.to_radians(), 2e-3).abs()
    });
    let hold = weight.fold(0.0, f64::max) / (press::RATIO * ratio);
    let rms = figures(&seen.torque).rms;
    let fastest = largest(&seen.speed);
    let continuous = 0.8 * limits.continuous(seen.mean_speed);
    let (speed, standstill) = (0.9 * limits.max_speed / RPM, 0.6 * limits.standstill);
    let mut rules = vec![
        ("RMS torque", rms, Some(continuous), integral),
        ("speed", fastest / RPM, Some(speed), peak),
        (
            "holding torque",
            hold,
            Some(standstill),
            budget::HOLDING_GRID,
        ),
        ("inertia ratio", largest(&seen.lambda), Some(10.0), peak),
    ];
    // Beyond the largest speed there is no torque at all, and any point there is as far out as any other.
    if fastest <= limits.max_speed {
        let points = seen.torque.iter().zip(&seen.speed);
        let used = points.map(|(t, n)| (t.abs(), limits.short_time(n.abs())));
        let closest = used.max_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)));
        let (torque, limit) = closest.unwrap();
        rules.push(("peak torque", torque, Some(0.8 * limit), peak));
    }
    rules
}

#[test]
fn the_drives() {
    let (motors, gearboxes) = (catalogue("motors.csv"), catalogue("gearboxes.csv"));
    let answer = size("2000", None, None);
    let fit = answer["fit"].as_array().unwrap();
    let refused = answer["refused"].as_array().unwrap();
    // The best one, the others that fit now and then, and a sample of what is refused.
    let some = fit.iter().step_by(9).chain(refused.iter().step_by(81));
    let mut direct = 0;
    for drive in some {
        let motor = &motors[drive["motor"].as_str().unwrap()];
        let gearbox = drive["gearbox"].as_str().map(|key| &gearboxes[key]);
        direct += usize::from(gearbox.is_none());
        check_drive(
            drive,
            motor,
            gearbox,
            [budget::DEFAULT_STEPS, budget::DEFAULT_PEAK],
        );
    }
    println!("{direct} of them coupled directly");
}

const ONE_MOTOR: &str = "\
key,maker,model,rated_torque [N m],rated_speed [rpm],standstill_torque [N m],peak_torque [N m],max_speed [rpm],\
rotor_inertia [kg cm^2],peak_corner_speed [rpm],peak_torque_at_max_speed [N m],source
m,Maker,Model,8,2000,9,36,4000,8.5,1500,12,Source
";
const ONE_GEARBOX: &str = "\
key,maker,model,ratio,rated_output_torque [N m],peak_output_torque [N m],rated_input_speed [rpm],\
max_input_speed [rpm],input_inertia [kg cm^2],efficiency [%],source
g,Maker,Model,3,40,80,,7000,0.99,96,Source
";

fn row(csv: &str) -> BTreeMap<String, String> {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let names = reader.headers().unwrap().clone();
    let record = reader.records().next().unwrap().unwrap();
    let names = names.iter().map(|n| n.split(" [").next().unwrap());
    names
        .zip(record.iter())
        .map(|(name, cell)| (name.to_owned(), cell.to_owned()))
        .collect()
}

/// A motor with every figure of the envelope, and a gearbox without a rated speed, at fine steps.
#[test]
fn a_drive_with_fine_steps() {
    let answer = size("200000", Some(ONE_MOTOR), Some(ONE_GEARBOX));
    let (motor, gearbox) = (row(ONE_MOTOR), row(ONE_GEARBOX));
    let all = answer["fit"].as_array().unwrap().iter();
    let all: Vec<&Value> = all.chain(answer["refused"].as_array().unwrap()).collect();
    assert_eq!(all.len(), 2);
    for drive in all {
        let gearbox = (!drive["gearbox"].is_null()).then_some(&gearbox);
        check_drive(
            drive,
            &motor,
            gearbox,
            [budget::FINE_STEPS, budget::FINE_PEAK],
        );
        assert_eq!(drive["assumptions"], Value::Array(vec![]));
    }
}

/// RMS of the input torque of a press with `steps`.
fn rms(text: &str, steps: u32) -> f64 {
    let folder = Folder::new();
    let run = jred([
        &"size",
        &folder.file("press.toml", text),
        &"--format",
        &"json",
        &"--steps",
        &steps.to_string(),
        &"--motors",
        &folder.file("motors.csv", ONE_MOTOR),
        &"--gearboxes",
        &folder.file("gearboxes.csv", ONE_GEARBOX),
    ]);
    run.json()["input torque [N m]"]["rms"].as_f64().unwrap()
}

/// With a trapezoidal law, no friction, no pressing force and no kink from an efficiency, the integrand is smooth on
/// each stretch but not periodic, and Simpson's rule shows its order: half the step, a sixteenth of the error.
#[test]
fn the_rms_converges_with_order_four() {
    let smooth = edited_press("efficiency = \"97 %\"", "efficiency = \"100 %\"");
    let smooth = support::edited(&smooth, "[\"-10 kN\", \"0 N\"]", "[\"0 N\", \"0 N\"]");
    let smooth = support::edited(&smooth, "\"150 N\"", "\"0 N\"");
    let smooth = support::edited(
        &smooth,
        "\"polynomial-345\"",
        "\"trapezoid\"\naccelerate = 0.25\ndecelerate = 0.25",
    );
    let limit = rms(&smooth, 100_000);
    // Stretches of 0.1 s and 0.2 s are cut into even numbers, rounded up: these double exactly.
    let errors = [99, 199, 399].map(|steps| (rms(&smooth, steps) - limit).abs());
    let orders = [
        (errors[0] / errors[1]).log2(),
        (errors[1] / errors[2]).log2(),
    ];
    println!("errors {errors:?}, orders {orders:?}");
    for order in orders {
        within("order", order, 4.0, budget::ORDER);
    }
}

/// With ramps and efficiency, the default of 2000 steps still leaves less than the budget, and more steps leave less.
#[test]
fn the_default_steps_are_enough() {
    let press = support::press_text();
    let limit = figures(&reference().iter().map(|i| i.torque).collect::<Vec<_>>()).rms;
    let errors = [250, 2000, 16_000].map(|steps| (rms(&press, steps) / limit - 1.0).abs());
    println!("relative errors of the RMS: {errors:?}");
    assert!(errors[0] > errors[1] && errors[1] < budget::DEFAULT_STEPS);
    assert!(errors[2] < budget::DEFAULT_STEPS / 10.0);
}
