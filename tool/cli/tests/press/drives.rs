//! Every figure and every rule of the drives, from the same independent cycle.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{FINE, RPM, check_figures, reference, size};
use crate::support::numerics::{derivative, trapezoid};
use crate::support::press::{self, Geared, figures};
use crate::support::{budget, largest, near, within};

/// Rows of the built-in catalogue, by key: name of the column without unit to text.
fn catalogue(name: &str) -> BTreeMap<String, BTreeMap<String, String>> {
    let path = format!("{}/../sizing/catalogue/{name}", env!("CARGO_MANIFEST_DIR"));
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

/// Limits of a motor by docs/sizing-rules.md.
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
    if gearbox.is_some() {
        // A cycle of half a second, where T2B is valid up to 1000 cycles an hour.
        let cycles = checks
            .iter()
            .find(|c| c["rule"] == "gearbox cycles")
            .unwrap();
        assert_eq!(
            (&cycles["value"], &cycles["verdict"]),
            (&7200.0.into(), &"warn".into())
        );
    }
    for (rule, value, limit, share) in expected {
        let check = checks.iter().find(|c| c["rule"] == rule).unwrap();
        let what = format!("{name}: {rule}");
        near(&what, check["value"].as_f64().unwrap(), value, share);
        match limit {
            // The peak's limit changes with the instant at which the duty is closest to it.
            Some(limit) => near(&what, check["limit"].as_f64().unwrap(), limit, share),
            None => assert!(check["limit"].is_null(), "{what}"),
        }
        let verdict = match limit {
            None => "not-checked",
            Some(limit) if value > limit * (1.0 + 1e-9) => "fail",
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
    let most = tolerances[0] * motoring;
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
    // Friction of belt and gearbox against it.
    let efficiency = gearbox.map_or(1.0, |g| number(g, "efficiency").unwrap() / 100.0);
    let hold =
        weight.fold(0.0, f64::max) / (press::RATIO * ratio * press::BELT_EFFICIENCY * efficiency);
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
    // Above the largest speed there is no torque, and all points there are equally far beyond.
    if fastest <= limits.max_speed {
        let points = seen.torque.iter().zip(&seen.speed);
        let used = points.map(|(t, n)| (t.abs(), limits.short_time(n.abs())));
        let closest = used.max_by(|a, b| (a.0 / a.1).total_cmp(&(b.0 / b.1)));
        let (torque, limit) = closest.unwrap();
        rules.push((
            "peak torque",
            torque,
            Some(0.8 * limit),
            budget::NEAREST_PEAK,
        ));
    }
    rules
}

#[test]
fn the_drives() {
    let (motors, gearboxes) = (catalogue("motors.csv"), catalogue("gearboxes.csv"));
    let answer = size("2000", None, None);
    let fit = answer["fit"].as_array().unwrap();
    let refused = answer["refused"].as_array().unwrap();
    // The best one, every ninth of the other suitable ones, and a sample of the refused ones.
    let some = fit.iter().step_by(9).chain(refused.iter().step_by(81));
    let mut direct = 0;
    // A brake and the current of an amplifier are checked elsewhere.
    let plain = some.filter(|drive| {
        let braked = drive["motor"].as_str().unwrap().ends_with("-brake");
        !braked && drive["amplifier"].is_null()
    });
    for drive in plain {
        let motor = &motors[drive["motor"].as_str().unwrap()];
        let gearbox = drive["gearbox"].as_str().map(|key| &gearboxes[key]);
        direct += usize::from(gearbox.is_none());
        check_drive(
            drive,
            motor,
            gearbox,
            [budget::FINE_STEPS, budget::DEFAULT_PEAK],
        );
    }
    println!("{direct} of them coupled directly");
}

pub(super) const ONE_MOTOR: &str = "\
key,maker,model,rated_torque [N m],rated_speed [rpm],standstill_torque [N m],peak_torque [N m],max_speed [rpm],\
rotor_inertia [kg cm^2],peak_corner_speed [rpm],peak_torque_at_max_speed [N m],source
m,Maker,Model,8,2000,9,36,4000,8.5,1500,12,Source
";
pub(super) const ONE_GEARBOX: &str = "\
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
        // The weight of the ram, which a motor without a brake does not hold.
        let [warning] = drive["assumptions"].as_array().unwrap().as_slice() else {
            panic!("{}", drive["assumptions"]);
        };
        assert!(warning.as_str().unwrap().contains("holding brake"));
    }
}
