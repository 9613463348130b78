//! `jred vary`: content of a row, shares, resuming, messages.
// Rows are compared digit by digit.
#![allow(clippy::float_cmp)]

mod store;

use std::collections::HashMap;

use crate::support::{Folder, jred, jred_of, press_file, press_text};

/// The rows of a CSV file by column.
fn rows(text: &str) -> Vec<HashMap<String, String>> {
    let mut reader = csv_reader(text);
    let names: Vec<String> = reader.remove(0);
    let row = |cells: Vec<String>| names.iter().cloned().zip(cells).collect();
    reader.into_iter().map(row).collect()
}

/// A CSV reader of the test's own: quotes, commas, lines.
fn csv_reader(text: &str) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    for line in text.lines() {
        let (mut cells, mut cell, mut quoted) = (Vec::new(), String::new(), false);
        for c in line.chars() {
            match c {
                '"' => quoted = !quoted,
                ',' if !quoted => cells.push(std::mem::take(&mut cell)),
                c => cell.push(c),
            }
        }
        cells.push(cell);
        rows.push(cells);
    }
    rows
}

/// A row equals the result of `jred size` for a machine file edited by hand.
#[test]
fn a_row_is_what_sizing_the_changed_file_gives() {
    let folder = Folder::new();
    let run = jred_of(
        "vary {} --vary slider.mass=42,60kg --vary segment.1.duration=0.4,0.3s --format csv",
        [&press_file()],
    )
    .ends(0);
    let rows = rows(&run.out);
    assert_eq!(rows.len(), 4);
    for row in &rows {
        let text = press_text()
            .replacen(
                "\"42 kg\"",
                &format!("\"{} kg\"", row["mechanism.slider.mass [kg]"]),
                1,
            )
            .replacen(
                "\"0.4 s\"",
                &format!("\"{} s\"", row["motion.segment.1.duration [s]"]),
                1,
            );
        let file = folder.file("changed.toml", text);
        let sized = jred([&"size", &file, &"--format", &"json"]);
        let sized = sized.json();
        let fit = sized["fit"].as_array().unwrap();
        if fit.is_empty() {
            assert_eq!(row["verdict"], "none fits");
            continue;
        }
        assert_eq!(row["verdict"], "fits");
        let best = &fit[0];
        assert_eq!(row["motor"], best["motor"].as_str().unwrap());
        assert_eq!(row["gearbox"], best["gearbox"].as_str().unwrap_or("direct"));
        let energy = best["duty"]["motoring energy [J]"].as_f64().unwrap();
        crate::support::near(
            "energy",
            row["energy [J]"].parse().unwrap(),
            energy,
            crate::support::budget::ROW,
        );
        let checks = best["checks"].as_array().unwrap();
        let judged = checks.iter().filter(|c| c["verdict"] != "warn");
        let margins = judged.filter_map(|c| c["margin"].as_f64());
        let margin = margins.fold(f64::INFINITY, f64::min);
        crate::support::within(
            "margin",
            row["margin"].parse().unwrap(),
            margin,
            crate::support::budget::ROW,
        );
    }
}

/// Machines that cannot be built are rows with the reason.
#[test]
fn a_machine_that_is_refused_is_a_row() {
    let run = jred_of(
        "vary {} --vary rod.length=25,180mm --format json",
        [&press_file()],
    )
    .ends(0);
    let rows: Vec<serde_json::Value> = run
        .out
        .lines()
        .skip(1)
        .map(|l| serde_json::from_str(l).unwrap())
        .collect();
    assert_eq!(rows.len(), 2);
    assert_eq!(rows[0]["verdict"], "machine refused");
    assert!(
        rows[0]["note"]
            .as_str()
            .unwrap()
            .contains("too short for a full turn"),
        "{}",
        rows[0]
    );
    assert!(rows[0]["motor"].is_null());
    assert_eq!(rows[1]["verdict"], "fits");
}

/// If no machine has a drive, the exit code is that of `jred size` without a drive. A share leaves this to the whole.
#[test]
fn one_when_no_machine_has_a_drive() {
    let (press, out) = (press_file(), Folder::new());
    let vary = |values: &str, code: i32| {
        let run = jred([&"vary", &press, &"--vary", &values, &"--steps", &"64"]);
        run.ends(code).out
    };
    let none = vary("load.pressing force.force.1=-900,-800kN", 1);
    assert!(none.contains("0 of 2 machines have a drive"), "{none}");
    let one = vary("load.pressing force.force.1=-900,-10kN", 0);
    assert!(one.contains("1 of 2 machines has a drive"), "{one}");
    jred_of(
        "vary {} --vary 'load.pressing force.force.1=-900,-800kN' --steps 64 --shard 0/2 --out {}",
        [&press, &out.path("share.csv")],
    )
    .ends(0);
    let help = jred([&"vary", &"--help"]).ends(0).out;
    assert!(help.contains("1 no machine has one"), "{help}");
}

#[test]
fn what_cannot_be_varied_is_said() {
    let press = press_file();
    let out = Folder::new();
    let says = |vary: &str, words: &[&str]| {
        jred([&"vary", &press, &"--vary", &vary])
            .ends(2)
            .says(words);
    };
    says(
        "slider.mas=30..60kg:8",
        &[
            "no quantity \"slider.mas\"",
            "did you mean \"slider.mass\"?",
        ],
    );
    says(
        "hammer.mass=30..60kg:8",
        &["no quantity \"hammer.mass\"", "mechanism.slider.mass"],
    );
    says(
        "mass=30..60kg:8",
        &["names 3 quantities", "mechanism.crank.mass"],
    );
    says(
        "rules.rms_torque=70..90%:3",
        &["no quantity", "with a default value into the file first"],
    );
    says(
        "slider.mass=30..60mm:8",
        &["\"mm\" is not a unit of mechanism.slider.mass", "42 kg"],
    );
    says(
        "slider.mass=30..60:8",
        &["is not a unit of mechanism.slider.mass"],
    );
    says("slider.mass=30g..60kg:8", &["use one unit"]);
    says("slider.mass=30..60kg", &["the number of values is missing"]);
    says("slider.mass=30..60kg:0", &["0 values", "1 to"]);
    says("slider.mass=30..30kg:4", &["is empty"]);
    says("slider.mass=30..60kg:1", &["for one value"]);
    says("slider.mass=-30..60kg:4:log", &["greater than zero"]);
    says("slider.mass=30..60kg:4:lin", &["\"lin\" is not valid"]);
    says("slider.mass", &["has no \"=\""]);
    says("slider.mass=heavy", &["does not begin with a number"]);
    for values in ["nan..60kg:3", "30..inf kg:3", "nan,60kg"] {
        let words = ["is not a finite number; write a quantity as a number with a unit: \"60 kg\""];
        says(&format!("slider.mass={values}"), &words);
    }
    says("slider.mass=30..60kilos:3", &["unknown unit \"kilos\""]);
    let twice = jred_of(
        "vary {} --vary slider.mass=30,40kg --vary mechanism.slider.mass=50kg",
        [&press],
    );
    twice
        .ends(2)
        .says(&["mechanism.slider.mass is varied twice"]);
    let many = jred_of(
        "vary {} --vary slider.mass=30..60kg:100000 --vary rod.mass=5..6kg:100000",
        [&press],
    );
    many.ends(2)
        .says(&["100000 × 100000 machines are too many", "at most 100000000"]);
    let shard = jred_of(
        "vary {} --vary slider.mass=30,40kg --shard 2/2 --out {}",
        [&press, &out.path("x")],
    );
    shard.ends(2).says(&["there is no share 2 of 2"]);
}

/// The elements of lists count from 1 as in messages; an index of 0 is refused with that hint.
#[test]
fn the_first_element_is_number_one() {
    let run = |path: &str| {
        let vary = format!("{path}.duration=0.4,0.5s");
        jred([&"vary", &press_file(), &"--vary", &vary, &"--steps", &"64"])
    };
    let first = run("motion.segment.1");
    assert!(first.code < 2, "{}", first.err);
    let wrong = run("motion.segment.0").ends(2);
    let told = wrong.err.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(told.contains("counted from 1"), "{told}");
}
