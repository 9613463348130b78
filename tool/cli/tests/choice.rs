//! Every output names the selected amplifier, gear ratio, mass, price and brake resistor.

use std::path::{Path, PathBuf};

use crate::support::schema::faults;
use crate::support::{Folder, Run, jred, jred_with, sizeable_machines};
use serde_json::Value;

fn engineer(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../sizing/tests/data/engineer")
        .join(name)
}

fn with_catalogue(command: &str, machine: &str, more: &[&str]) -> Run {
    let (machine, catalogue) = (engineer(machine), engineer("cat"));
    let words = [
        command,
        machine.to_str().unwrap(),
        "--catalogue",
        catalogue.to_str().unwrap(),
    ];
    jred_with(&[&words[..], more].concat())
}

/// The lift with a resistor in the catalogue: 17.3 kg, and 740 + 820 + 520 for motor, gearbox and amplifier, 60 for the resistor.
#[test]
fn every_output_names_what_is_chosen() {
    let text = with_catalogue("size", "lift.toml", &["--full"]).ends(0);
    let row = text
        .out
        .lines()
        .find(|line| line.trim_start().starts_with("1 "))
        .unwrap();
    let cells: Vec<&str> = row.split_whitespace().collect();
    for cell in ["sm100ab", "g115-16", "16", "a3", "17.3", "2140", "r100-100"] {
        assert!(cells.contains(&cell), "{cell} is not in {row}");
    }
    text.says(&["no list of the catalogue pairs motors of Muster with amplifiers of Regler"]);
    let json = with_catalogue("size", "lift.toml", &["--format", "json"])
        .ends(0)
        .json();
    assert_eq!(faults(&json), [""; 0]);
    let best = &json["fit"][0];
    let named = |key: &str| best[key].as_str().unwrap();
    assert_eq!(
        [named("amplifier"), named("brake resistor")],
        ["a3", "r100-100"]
    );
    let figure = |key: &str| best[key].as_f64().unwrap();
    for (key, expected) in [
        ("ratio", 16.0),
        ("mass [kg]", 6.9 + 9.0 + 1.4),
        ("price", 740.0 + 820.0 + 520.0 + 60.0),
    ] {
        assert!((figure(key) - expected).abs() < 1e-9, "{key}");
    }
    assert_eq!(named("certainty"), "pairing-unknown");
    let csv = with_catalogue(
        "size",
        "lift.toml",
        &["--format", "csv", "--top", "1", "--nearest", "0"],
    );
    let csv = csv.ends(0).out;
    let head: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    assert_eq!(
        head[head.len() - 3..],
        ["mass [kg]", "price", "brake resistor"]
    );
    assert!(
        csv.lines().skip(1).all(|row| row.ends_with(",r100-100")),
        "{csv}"
    );
    let folder = Folder::new();
    let page = folder.path("lift.html");
    with_catalogue("size", "lift.toml", &["--report", page.to_str().unwrap()]).ends(0);
    let page = std::fs::read_to_string(page).unwrap();
    for words in [
        "Widerstand R100-100 (r100-100)",
        "brake resistor: the smallest of the catalogue that fits",
        ">Regler A-03 †</td>",
        ">Widerstand R100-100</td>",
        "<td class=\"n\">17.3</td><td class=\"n\">2140</td>",
    ] {
        assert!(page.contains(words), "{words}");
    }
    // One axis on its own bus needs the same resistor.
    let bus = with_catalogue("bus", "lift.toml", &["--format", "json"])
        .ends(0)
        .json();
    assert_eq!(bus["brake resistor chosen"], "r100-100");
    assert_eq!(bus["holds"], Value::Bool(true));
    // The objective uses the price of the list.
    let front = with_catalogue(
        "size",
        "lift.toml",
        &["--pareto", "price,power", "--format", "json"],
    );
    let front = front.ends(0).json();
    let points = front["front"].as_array().unwrap();
    for point in points {
        assert_eq!(point["price"], point["values"][0]);
        assert!(
            point["ratio"].as_f64().unwrap() > 0.0 && point["mass [kg]"].as_f64().unwrap() > 0.0
        );
    }
    assert!(!points.is_empty());
}

/// A given drive is not called the best of the catalogue; a combination that the catalogue excludes is refused with the reason.
#[test]
fn a_drive_that_is_given_is_not_the_best() {
    let folder = Folder::new();
    let page = folder.path("page.html");
    let drive = [
        "--drive",
        "sm100ab+g115-16 on a6",
        "--report",
        page.to_str().unwrap(),
    ];
    let run = with_catalogue("size", "lift.toml", &drive).ends(0);
    assert!(
        run.out.contains("(sm100ab") && run.out.contains("(g115-16") && run.out.contains("(a6"),
        "{}",
        run.out
    );
    let page = std::fs::read_to_string(page).unwrap();
    for text in [&run.out, &page] {
        for words in [
            "Best drive",
            "best drive",
            "in the catalogue that",
            "of 1 drive",
        ] {
            assert!(!text.contains(words), "{words}");
        }
    }
    let drive = ["--drive", "sm60b+g115-16 on a6"];
    with_catalogue("size", "lift.toml", &drive).ends(2).says(&[
        "the catalogue does not combine the parts of the drive \"sm60b+g115-16 on a6\"",
        "sm60b + g70-5 on a3",
        "compatibility.csv",
    ]);
}

/// In JSON, too, means over a closed cycle and stored energies are zero.
#[test]
fn what_is_zero_is_zero_for_programs() {
    for machine in ["lift.toml", "screw.toml", "knife.toml", "table.toml"] {
        let json = with_catalogue("size", machine, &["--explain", "--format", "json"]).json();
        let mut small = Vec::new();
        collect(&json, "", &mut small);
        assert!(small.is_empty(), "{machine}: {small:?}");
    }
}

/// Collects numbers close enough to zero to be rounding: every figure of these machines is of the order of one in SI.
fn collect(value: &Value, place: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(map) => map
            .iter()
            .for_each(|(key, value)| collect(value, &format!("{place}/{key}"), found)),
        Value::Array(all) => all.iter().for_each(|value| collect(value, place, found)),
        Value::Number(number) => {
            let number = number.as_f64().unwrap();
            if number != 0.0 && number.abs() < 1e-10 {
                found.push(format!("{place} = {number:e}"));
            }
        }
        _ => {}
    }
}

/// 80 columns and 24 lines, for every machine.
#[test]
fn the_first_answer_fits_on_a_screen() {
    let mut machines = 0;
    for file in sizeable_machines() {
        let name = file.display().to_string();
        let text = jred([&"size", &file]).out;
        let widest = text.lines().map(|line| line.chars().count()).max().unwrap();
        assert!(widest <= 80 && text.lines().count() <= 24, "{name}\n{text}");
        for word in [
            "motor",
            "gearbox",
            "amplifier",
            "brake",
            "resistor",
            "order",
        ] {
            let starts = |line: &str| line.starts_with(&format!("  {word} "));
            assert!(text.lines().any(starts), "{name}: no {word}\n{text}");
        }
        // Only a terminal has colours.
        assert!(!text.contains('\u{1b}'));
        machines += 1;
    }
    assert!(machines > 35, "{machines}");
}
