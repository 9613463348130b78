//! Limits of a motor in the output: linear motors on a sliding machine, and the voltage of the supply.

use std::path::{Path, PathBuf};

use crate::support::{Folder, budget, jred, jred_of, near};
use serde_json::Value;

const LINEAR: &str = "\
key,kind,maker,model,rated_force [N],rated_speed [m/s],standstill_force [N],peak_force [N],max_speed [m/s],moving_mass [kg],torque_constant [N/A],winding_resistance [Ohm],bus_voltage [V],figures_from,source
small,linear,Own,S,60,3,66,200,5,0.9,40,8,325,maker,invented
medium,linear,Own,M,140,3,150,450,4,1.8,60,6,325,maker,invented
";

const ROTARY: &str = "\
key,maker,model,rated_torque [N m],rated_speed [rpm],peak_torque [N m],max_speed [rpm],rotor_inertia [kg cm^2],peak_corner_speed [rpm],peak_torque_at_max_speed [N m],bus_voltage [V],figures_from,source
turns,Own,R,3,3000,9,5000,2,3500,4,560,maker,invented
";

fn machine_path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../machines")
        .join(name)
}

fn check<'v>(drive: &'v Value, rule: &str) -> &'v Value {
    let checks = drive["checks"].as_array().unwrap();
    let found = checks.iter().find(|c| c["rule"] == rule);
    found.unwrap_or_else(|| panic!("no rule {rule}: {drive:#}"))
}

#[test]
fn a_link_that_slides_takes_a_linear_motor() {
    let folder = Folder::new();
    let linear = folder.file("linear_motors.csv", LINEAR);
    let rotary = folder.file("rotary_motors.csv", ROTARY);
    let machine = machine_path("linear-gripper.toml");
    let run = jred_of(
        "size {} --catalogue {} --catalogue {} --refused --format json",
        [&machine, &linear, &rotary],
    );
    assert!(run.code == 0, "{}", run.err);
    let found: Value = serde_json::from_str(&run.out).unwrap();
    let drives: Vec<&Value> = ["fit", "refused"]
        .iter()
        .flat_map(|k| found[k].as_array().unwrap())
        .collect();
    let mut names: Vec<&str> = drives
        .iter()
        .map(|d| d["motor"].as_str().unwrap())
        .collect();
    names.sort_unstable();
    assert_eq!(names, ["medium", "small"]);
    assert!(drives.iter().all(|d| d["gearbox"].is_null()));
    // The moving part of the motor is added: F = (m_red + m)·a + ½·m_red′·v² + ….
    let input = found["input torque [N m]"]["max"].as_f64().unwrap();
    let medium = drives.iter().find(|d| d["motor"] == "medium").unwrap();
    let ratio = check(medium, "mass ratio")["value"].as_f64().unwrap();
    let mass = found["input inertia [kg m^2]"]["max"].as_f64().unwrap();
    near("mass ratio", ratio, mass / 1.8, budget::CLOSED_FORM);
    let peak = check(medium, "peak force");
    assert_eq!(peak["unit"], "N");
    assert!(peak["value"].as_f64().unwrap() > input);
    assert_eq!(check(medium, "speed")["unit"], "m/s");
    let text = jred([&"size", &machine, &"--motors", &linear, &"--full"]);
    for word in [
        "force [N]",
        "speed [m/s]",
        "mass [kg]",
        "peak force",
        "mass ratio",
    ] {
        assert!(text.out.contains(word), "{word}: {}", text.out);
    }
    for word in ["N m", "rpm", "kg cm", "RMS torque", "peak torque"] {
        assert!(!text.out.contains(word), "{word}: {}", text.out);
    }
}

#[test]
fn a_catalogue_without_the_kind_of_motor_is_refused() {
    let folder = Folder::new();
    let rotary = folder.file("rotary.csv", ROTARY);
    let linear = folder.file("linear.csv", LINEAR);
    let slides = machine_path("linear-gripper.toml");
    let turns = machine_path("press.toml");
    let run = jred([&"size", &slides, &"--motors", &rotary]).ends(2);
    assert!(
        run.message().contains("rotary motors only"),
        "{}",
        run.message()
    );
    let run = jred([&"size", &turns, &"--motors", &linear]).ends(2);
    assert!(
        run.message().contains("linear motors only"),
        "{}",
        run.message()
    );
    let run = jred([&"ratio", &slides, &"--motors", &linear]).ends(2);
    assert!(
        run.message().contains("no ratio to choose"),
        "{}",
        run.message()
    );
}

#[test]
fn the_supply_of_the_machine_file_moves_the_limits() {
    let folder = Folder::new();
    let motors = folder.file("motors.csv", ROTARY);
    let limits = |supply: &str| {
        let text = crate::support::press_text() + supply;
        let machine = folder.file("press.toml", text);
        let run = jred_of(
            "size {} --motors {} --refused --format json",
            [&machine, &motors],
        );
        assert!(run.code < 2, "{}", run.err);
        let found: Value = serde_json::from_str(&run.out).unwrap();
        let mut all = found["fit"].as_array().unwrap().clone();
        all.extend(found["refused"].as_array().unwrap().clone());
        let direct = all.iter().find(|d| d["gearbox"].is_null()).unwrap().clone();
        let limit = check(&direct, "speed")["limit"].as_f64().unwrap();
        (limit, direct["assumptions"].to_string())
    };
    let (full, words) = limits("");
    near("speed", full, 0.9 * 5000.0, budget::CLOSED_FORM);
    assert!(!words.contains("bus voltage"), "{words}");
    let (lower, words) = limits("\n[supply]\nbus_voltage = \"463 V\"\n");
    near(
        "lower voltage",
        lower,
        0.9 * 5000.0 * 463.0 / 560.0,
        budget::CLOSED_FORM,
    );
    assert!(words.contains("in proportion"), "{words}");
    let (higher, _) = limits("\n[supply]\nbus_voltage = \"650 V\"\n");
    near("higher voltage", higher, full, budget::CLOSED_FORM);
}

/// The assumptions about the motor are printed once, however many stops are simulated.
#[test]
fn a_warning_is_given_once() {
    let folder = Folder::new();
    // The stop is after a whole cycle.
    let text = std::fs::read_to_string(machine_path("vertical-axis.toml")).unwrap();
    let mut text = text.replace(
        "duration = \"0.8 s\"\noutput_step",
        "duration = \"6 s\"\noutput_step",
    );
    text = text.replace("time = \"0.45 s\"", "time = \"5 s\"");
    let machine = folder.file("axis.toml", text);
    let words: [&dyn AsRef<std::ffi::OsStr>; 6] = [
        &"simulate",
        &machine,
        &"--drive",
        &"sgm7j-06a",
        &"--stops",
        &"3",
    ];
    let run = jred(words).ends(0);
    let mut warnings: Vec<&str> = run
        .err
        .lines()
        .filter(|line| line.starts_with("warning:"))
        .collect();
    let count = warnings.len();
    warnings.sort_unstable();
    warnings.dedup();
    assert!(count > 0 && warnings.len() == count, "{}", run.err);
}
