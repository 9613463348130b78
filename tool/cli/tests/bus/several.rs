//! `jred bus` with several axes: three and more, no common period, named drives, resistors of a catalogue, and the file that gives `[supply]`.

// A check repeats the figure that it judges.
#![allow(clippy::float_cmp)]

use std::path::PathBuf;

use serde_json::Value;

use super::command::{SUPPLY, figure, says};
use crate::support::{
    Folder, Run, budget, edited_press, near, press_file, press_text, shipped, without_resistors,
};

fn lift() -> PathBuf {
    shipped("ball-screw.toml")
}

/// The command with few steps.
fn bus(files: &[&PathBuf], more: &[&str]) -> Run {
    let files: Vec<&str> = files.iter().map(|file| file.to_str().unwrap()).collect();
    let all = [&["bus", "--steps", "100"], files.as_slice(), more].concat();
    crate::support::jred_with(&all)
}

fn json(files: &[&PathBuf], more: &[&str]) -> Value {
    bus(files, &[more, &["--format", "json"]].concat()).json()
}

/// Three axes, the supply in the last file: every sum is that of the three, every figure between the one in step and its bound.
#[test]
#[ignore = "more than five seconds of a processor"]
fn three_axes() {
    let folder = Folder::new();
    let third = folder.file("third.toml", press_text() + SUPPLY);
    let press = press_file();
    let files = [&press, &lift(), &third];
    let answer = json(&files, &[]);
    assert_eq!(answer["axes"].as_array().unwrap().len(), 3);
    assert_eq!(answer["worst"]["exhaustive"], Value::Bool(true));
    assert_eq!(answer["common period"]["kind"], "searched");
    assert_eq!(
        answer["common period"]["cycles"],
        serde_json::json!([8, 1, 8])
    );
    near("period", figure(&answer, &["period [s]"]), 4.0, budget::BUS);
    for (bound, own) in [
        ("peak drawn [W]", "peak drawn [W]"),
        ("peak fed back [W]", "peak fed back [W]"),
    ] {
        let axes = answer["axes"].as_array().unwrap();
        let sum: f64 = axes.iter().map(|axis| figure(axis, &[own])).sum();
        near(bound, figure(&answer, &["bounds", bound]), sum, budget::BUS);
    }
    for (goal, key) in [
        ("voltage", "highest voltage [V]"),
        ("resistor", "burnt [J]"),
        ("peak", "resistor peak [W]"),
        ("pulse", "resistor pulse [J]"),
    ] {
        let worst = figure(&answer, &["worst", goal, "figures", key]);
        assert!(worst >= figure(&answer, &["in step", key]), "{goal}");
        for other in ["voltage", "resistor", "peak", "pulse"] {
            assert!(
                worst >= figure(&answer, &["worst", other, "figures", key]),
                "{goal} {other}"
            );
        }
        assert_eq!(
            answer["worst"][goal]["phases [s]"]
                .as_array()
                .unwrap()
                .len(),
            3
        );
    }
    let text = bus(&files, &[]);
    says(
        &text,
        &["axis 3 Servo press", "with the highest mean brake power"],
    );
    assert!(!text.out.contains("More than three axes"));
    // With a fourth axis the phases are found one at a time, which is reported.
    let four = [&press, &lift(), &third, &press];
    let answer = json(&four, &[]);
    assert_eq!(answer["worst"]["exhaustive"], Value::Bool(false));
    says(
        &bus(&four, &[]),
        &["axis 4 Servo press", "may miss a worse phase"],
    );
}

/// Any one file may give the supply, or several the same; two that differ are named.
#[test]
fn whose_supply() {
    let folder = Folder::new();
    let press = press_file();
    let with = folder.file("with.toml", press_text() + SUPPLY);
    let answers = [
        json(&[&with, &press, &lift()], &["--in-step"]),
        json(&[&press, &with, &lift()], &["--in-step"]),
        json(&[&with, &with, &lift()], &["--in-step"]),
    ];
    for answer in &answers[1..] {
        assert_eq!(answer["in step"], answers[0]["in step"]);
        assert_eq!(answer["checks"], answers[0]["checks"]);
    }
    let other = folder.file("other.toml", press_text() + &SUPPLY.replace("470", "680"));
    let wrong = bus(&[&lift(), &with, &other], &[]).ends(2);
    wrong.says(&["other.toml differs from that in", "with.toml"]);
    let parts = without_resistors(&folder);
    let alone = ["--catalogue", parts.to_str().unwrap()];
    bus(&[&press, &lift()], &alone).ends(2).says(&[
        "no data for the DC bus",
        "add a [supply] to one of the machine files",
    ]);
}

/// Cycles that meet late, or never: each case is named, and judged by bounds for any phases.
#[test]
fn periods_that_do_not_meet() {
    let folder = Folder::new();
    let file = folder.file("press.toml", press_text() + SUPPLY);
    let other = |name: &str, duration: &str| {
        let text = edited_press(
            "duration = \"0.4 s\"",
            &format!("duration = \"{duration} s\""),
        );
        folder.file(name, text)
    };
    let late = other("late.toml", "0.4007");
    let never = other("never.toml", "0.41234567");
    let soon = other("soon.toml", "0.41");
    for (path, kind, words) in [
        (
            &late,
            "too long",
            "the common period of the cycles is 2504 s (5007, 5000 cycles of axes 1, 2), longer than the search limit of 256 cycles",
        ),
        (
            &never,
            "none",
            "the cycles have no common period within 100000 cycles",
        ),
    ] {
        let answer = json(&[&file, path], &[]);
        assert_eq!(answer["common period"]["kind"], kind);
        assert_eq!(answer["period [s]"], Value::Null);
        assert!(answer["worst"].is_null() && answer["in step"].is_null());
        // Judged by the bounds; the pulse has no bound and is not judged.
        let check = |name: &str| {
            let checks = answer["checks"].as_array().unwrap();
            let found = checks.iter().find(|check| check["check"] == name);
            found
                .unwrap_or_else(|| panic!("{name}: {answer:#}"))
                .clone()
        };
        let highest = figure(&answer, &["bounds", "highest voltage [V]"]);
        assert_eq!(figure(&check("bus voltage"), &["value"]), highest);
        assert!(check("brake resistor pulse energy")["holds"].is_null());
        let text = bus(&[&file, path], &[]);
        says(
            &text,
            &[
                &format!("checked against bounds that are valid for any phases: {words}"),
                &format!("not checked brake resistor pulse energy: no bound exists, and {words}"),
            ],
        );
        assert!(answer["not checked"].to_string().contains(words));
        bus(&[&file, path], &["--format", "csv"])
            .ends(2)
            .says(&[words]);
    }
    let answer = json(&[&file, &soon], &["--in-step"]);
    assert_eq!(answer["common period"]["kind"], "searched");
    assert_eq!(
        answer["common period"]["cycles"],
        serde_json::json!([51, 50])
    );
    near(
        "period",
        figure(&answer, &["period [s]"]),
        25.5,
        budget::BUS,
    );
}

const CATALOGUE: &str = r#"
[[motor]]
key = "m"
maker = "Maker"
model = "Model"
rated_torque = "300 N m"
rated_speed = "1000 rpm"
max_speed = "4000 rpm"
peak_torque = "3000 N m"
rotor_inertia = "500 kg cm^2"
torque_constant = "2 N m/A"
source = "Sheet"

[[gearbox]]
key = "g"
maker = "Maker"
model = "Model"
ratio = 2
rated_output_torque = "1000 N m"
peak_output_torque = "6000 N m"
rated_input_speed = "4000 rpm"
max_input_speed = "6000 rpm"
input_inertia = "10 kg cm^2"
efficiency = "96 %"
source = "Sheet"

[[amplifier]]
key = "a"
maker = "Maker"
model = "Model"
rated_current = "600 A"
peak_current = "2000 A"
constant_loss = "20 W"
source = "Sheet"

[[amplifier]]
key = "b"
maker = "Maker"
model = "Model"
rated_current = "600 A"
peak_current = "2000 A"
constant_loss = "520 W"
source = "Sheet"

[[resistor]]
key = "small"
maker = "Maker"
model = "Model"
resistance = "47 Ohm"
rated_power = "10 W"
peak_power = "40 kW"
pulse_energy = "50 kJ"
source = "Sheet"

[[resistor]]
key = "enough"
maker = "Maker"
model = "Model"
resistance = "47 Ohm"
rated_power = "3 kW"
peak_power = "40 kW"
pulse_energy = "50 kJ"
source = "Sheet"

[[resistor]]
key = "large"
maker = "Maker"
model = "Model"
resistance = "47 Ohm"
rated_power = "5 kW"
peak_power = "40 kW"
pulse_energy = "50 kJ"
source = "Sheet"
"#;

/// Each axis takes its named drive with amplifier, by keys or by the name as printed.
#[test]
fn drives_are_named() {
    let folder = Folder::new();
    let catalogue = folder.file("catalogue.toml", CATALOGUE);
    let file = folder.file("press.toml", press_text() + SUPPLY);
    let run = |drives: [&str; 2]| {
        let more = ["--in-step", "--catalogue", catalogue.to_str().unwrap()];
        let drives = drives.iter().flat_map(|drive| ["--drive", drive]);
        let more: Vec<&str> = more.into_iter().chain(drives).collect();
        json(&[&file, &press_file()], &more)
    };
    let answer = run(["1=m+g on b", "2=m, direct on a"]);
    assert_eq!(answer["axes"][0]["drive"], "m + g on b");
    assert_eq!(answer["axes"][1]["drive"], "m, direct on a");
    let again = run(["2=m+direct on a", "1=m + g on b"]);
    assert_eq!(again["axes"], answer["axes"]);
    // The amplifiers differ by 500 W, which the same motor and gearbox draw in addition all the time.
    let other = run(["1=m+g on a", "2=m, direct on a"]);
    let drawn = |answer: &Value| {
        figure(&answer["axes"][0], &["drawn [J]"]) - figure(&answer["axes"][0], &["fed back [J]"])
    };
    near(
        "500 W over 0.5 s",
        drawn(&answer) - drawn(&other),
        250.0,
        budget::CURVES,
    );
    // Without an amplifier in the name a suitable one is taken.
    let any = run(["1=m+g", "2=m"]);
    for (axis, name) in [(0, "m + g on "), (1, "m, direct on ")] {
        let drive = any["axes"][axis]["drive"].as_str().unwrap();
        assert!(drive.starts_with(name), "{drive}");
    }
    let more = [
        "--catalogue",
        catalogue.to_str().unwrap(),
        "--drive",
        "1=m+g on c",
    ];
    bus(&[&file], &more)
        .ends(2)
        .says(&["there is no drive \"m+g on c\"", "did you mean"]);
    bus(&[&file], &["--drive", "0=m"])
        .ends(2)
        .says(&["N=MOTOR+GEARBOX on AMPLIFIER"]);
}

/// The smallest sufficient resistor of the catalogue is connected; the requirement is that of the worst phases.
#[test]
fn a_resistor_of_the_catalogue() {
    let folder = Folder::new();
    let catalogue = folder.file("catalogue.toml", CATALOGUE);
    let bare: String = SUPPLY
        .lines()
        .filter(|line| !line.starts_with("brake_resistor"))
        .map(|line| line.to_owned() + "\n")
        .collect();
    let file = folder.file("press.toml", press_text() + &bare.replace("470", "47"));
    let more = [
        "--catalogue",
        catalogue.to_str().unwrap(),
        "--drive",
        "1=m",
        "--drive",
        "2=m",
    ];
    let files = [&file, &press_file()];
    let text = bus(&files, &more).ends(0);
    says(
        &text,
        &["resistor enough, the smallest of the catalogue that fits; required: at most"],
    );
    let answer = json(&files, &more);
    assert_eq!(answer["proposal"], "enough");
    assert_eq!(answer["brake resistor chosen"], "enough");
    assert_eq!(answer["holds"], Value::Bool(true));
    let need = |key: &str| figure(&answer, &["brake resistor needed", key]);
    let in_step = json(&files, &[&more[..], &["--in-step"]].concat());
    for key in ["mean [W]", "peak [W]", "pulse [J]"] {
        let one = figure(&in_step, &["brake resistor needed", key]);
        assert!(need(key) >= one * (1.0 - 1e-12), "{key}");
    }
    // With the proposed resistor the bus satisfies every rule, and its worst figures are those required.
    let with = bare.replace("470", "47")
        + "brake_resistor = { resistance = \"47 Ohm\", power = \"3 kW\", peak_power = \"40 kW\", pulse_energy = \"50 kW s\" }\n";
    let file = folder.file("with.toml", press_text() + &with);
    let held = json(&[&file, &press_file()], &more);
    assert_eq!(held["holds"], Value::Bool(true));
    assert_eq!(
        held["checks"], answer["checks"],
        "given or chosen, it is judged alike"
    );
    assert!(held["brake resistor needed"].is_null());
    let period = figure(&held, &["period [s]"]);
    for (key, goal, own, by) in [
        ("mean [W]", "resistor", "burnt [J]", period),
        ("peak [W]", "peak", "resistor peak [W]", 1.0),
        ("pulse [J]", "pulse", "resistor pulse [J]", 1.0),
    ] {
        let found = figure(&held, &["worst", goal, "figures", own]) / by;
        near(key, found, need(key), budget::PHASES);
    }
}
