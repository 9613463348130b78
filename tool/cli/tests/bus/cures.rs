//! Cures for a bus beyond a limit: each change is made in the machine file, and the bus must then satisfy every rule.

use serde_json::Value;

use super::command::figure;
use crate::support::{Folder, Run, jred_with, press_text, shipped, without_resistors};

/// A vertical axis that feeds back more than half of what it draws.
fn lift() -> String {
    std::fs::read_to_string(shipped("ball-screw.toml")).unwrap()
}

/// Keys of `[supply]` and their values.
pub(super) type Keys<'a> = Vec<(&'a str, String)>;

pub(super) fn keys(pairs: &[(&'static str, &str)]) -> Keys<'static> {
    let pairs = pairs.iter();
    pairs
        .map(|(key, value)| (*key, (*value).to_owned()))
        .collect()
}

/// The supply with these keys, those of the resistor in a table of their own.
fn supply(keys: &Keys) -> String {
    let table = |resistor: bool| -> String {
        let mine = keys
            .iter()
            .filter(|(key, _)| key.starts_with("brake_resistor.") == resistor);
        let lines = mine.map(|(key, value)| {
            let key = key.trim_start_matches("brake_resistor.");
            let flag = value == "true";
            let quotes = if flag { "" } else { "\"" };
            format!("{key} = {quotes}{value}{quotes}\n")
        });
        lines.collect::<Vec<_>>().concat()
    };
    let resistor = table(true);
    let resistor = if resistor.is_empty() {
        resistor
    } else {
        format!("[supply.brake_resistor]\n{resistor}")
    };
    format!("\n[supply]\n{}{resistor}", table(false))
}

fn run_as(
    folder: &Folder,
    keys: &Keys,
    others: &[&str],
    more: &[&str],
    ends: i32,
    format: &str,
) -> Run {
    let first = folder.file("first.toml", press_text() + &supply(keys));
    let mut files = vec![first];
    for (k, text) in others.iter().enumerate() {
        files.push(folder.file(&format!("other{k}.toml"), text));
    }
    let mut arguments = vec!["bus", "--steps", "100", "--format", format];
    arguments.extend(files.iter().map(|file| file.to_str().unwrap()));
    arguments.extend(more);
    let parts = without_resistors(folder);
    arguments.extend(["--catalogue", parts.to_str().unwrap()]);
    jred_with(&arguments).ends(ends)
}

pub(super) fn run(
    folder: &Folder,
    keys: &Keys,
    others: &[&str],
    more: &[&str],
    ends: i32,
) -> (String, Value) {
    let of = |format| run_as(folder, keys, others, more, ends, format);
    (of("table").out, of("json").json())
}

/// Makes every change of every cure in turn and checks the bus. Returns the first words of each.
pub(super) fn mend(
    folder: &Folder,
    before: &Keys<'static>,
    others: &[&str],
    more: &[&str],
) -> Vec<String> {
    let (text, answer) = run(folder, before, others, more, 1);
    assert!(
        text.contains("\nany one of these changes is sufficient\n- "),
        "{text}"
    );
    let mut kinds = Vec::new();
    for cure in answer["cures"].as_array().unwrap() {
        let words = cure["words"].as_str().unwrap();
        assert!(text.contains(&format!("\n- {words}\n")), "{words}\n{text}");
        kinds.push(words.split([' ', '=', ',']).next().unwrap().to_owned());
        let mut after = before.clone();
        let changes = cure["changes"].as_array().unwrap();
        for change in changes {
            let key = change["key"].as_str().unwrap();
            let least = change["at least"].as_f64();
            let value = least.or(change["at most"].as_f64()).unwrap();
            // The upper end of a range: the smallest resistance is given in the file.
            if key == "brake_resistor.resistance"
                && least.is_some()
                && changes
                    .iter()
                    .any(|c| c["key"] == key && !c["at most"].is_null())
            {
                continue;
            }
            let key = [
                "capacitance",
                "brake_resistor.resistance",
                "brake_resistor.power",
                "brake_resistor.peak_power",
                "brake_resistor.pulse_energy",
            ]
            .into_iter()
            .find(|known| *known == key)
            .unwrap_or_else(|| panic!("{key} in {words}"));
            // The figure in full and slightly beyond, for roundings.
            let safe = value
                * if least.is_some() {
                    1.0 + 1e-9
                } else {
                    1.0 - 1e-9
                };
            let unit = change["unit"].as_str().unwrap();
            after.retain(|(k, _)| *k != key);
            after.push((key, format!("{safe} {unit}")));
        }
        if words.ends_with("with a chopper_voltage below max_voltage") {
            after.push(("chopper_voltage", "810 V".to_owned()));
        }
        if words.starts_with("regenerative") {
            after.retain(|(key, _)| !key.starts_with("brake_resistor"));
            after.push(("regenerative", "true".to_owned()));
        } else if !cure["phases [s]"].is_null() {
            // Axes with the same file cannot be shifted: the figures are those of the bus in step, with these phases.
            let most = figure(&answer, &["most room", "figures", "highest voltage [V]"]);
            assert_eq!(cure["phases [s]"], answer["most room"]["phases [s]"]);
            assert!(most <= 820.0, "{most}");
            continue;
        }
        let mended = run_as(folder, &after, others, more, 0, "json").json();
        assert_eq!(mended["checks"][0]["holds"], Value::Bool(true));
        assert!(mended["cures"].as_array().unwrap().is_empty());
    }
    kinds
}

const BARE: [(&str, &str); 4] = [
    ("mains_voltage", "400 V"),
    ("capacitance", "470 uF"),
    ("chopper_voltage", "780 V"),
    ("max_voltage", "820 V"),
];

/// A lift and a press without a resistor: a resistor, a capacitor or another supply are cures; phases are not.
#[test]
fn a_bus_without_a_resistor() {
    let folder = Folder::new();
    let lift = lift();
    for more in [&["--in-step"][..], &[]] {
        let mut before = keys(&BARE);
        before.push(("min_resistance", "30 Ohm".to_owned()));
        let kinds = mend(&folder, &before, &[&lift], more);
        assert_eq!(
            kinds[..2],
            ["brake_resistor.resistance", "capacitance"],
            "{kinds:?}"
        );
        assert_eq!(kinds.last().unwrap(), "regenerative", "{kinds:?}");
    }
    // With unknown chopper voltage the resistor is sized for any timing of the regenerated energy.
    let before: Keys = keys(&BARE)
        .into_iter()
        .filter(|(key, _)| *key != "chopper_voltage")
        .collect();
    mend(&folder, &before, &[&lift], &[]);
    let (text, answer) = run(&folder, &before, &[&lift], &[], 1);
    assert!(
        text.contains("with a chopper_voltage below max_voltage"),
        "{text}"
    );
    let back = figure(&answer, &["bounds", "peak fed back [W]"]);
    let largest = figure(&answer["cures"][0]["changes"][0], &["at most"]);
    assert!((largest * back - 820.0 * 820.0).abs() < 1e-6, "{largest}");
}

/// An existing resistor is not proposed again: its shortage and the required one are reported.
#[test]
#[ignore = "more than five seconds of a processor"]
fn a_resistor_that_is_too_weak() {
    let folder = Folder::new();
    let lift = lift();
    let resistor = [
        ("brake_resistor.resistance", "47 Ohm"),
        ("brake_resistor.power", "50 W"),
        ("brake_resistor.peak_power", "900 W"),
        ("brake_resistor.pulse_energy", "100 W s"),
    ];
    let mut before = keys(&BARE);
    before.extend(keys(&resistor));
    for more in [&["--in-step"][..], &[]] {
        let (text, answer) = run(&folder, &before, &[&lift], more, 1);
        for words in [
            "  is short of",
            "W mean power",
            "J pulse energy",
            "  required: ",
        ] {
            assert!(text.contains(words), "{words}\n{text}");
        }
        let lacks = &answer["brake resistor lacks"];
        for (name, key, has) in [
            ("brake resistor mean power", "mean [W]", 50.0),
            ("brake resistor pulse energy", "pulse [J]", 100.0),
        ] {
            let checks = answer["checks"].as_array().unwrap();
            let check = checks.iter().find(|check| check["check"] == name).unwrap();
            let by = figure(check, &["value"]) - has;
            assert!((figure(lacks, &[key]) - by).abs() <= 1e-9 * by);
        }
        let kinds = mend(&folder, &before, &[&lift], more);
        assert_eq!(kinds[0], "brake_resistor.power");
        assert!(kinds.contains(&"capacitance".to_owned()), "{kinds:?}");
    }
    // Too large a resistance lets the voltage rise; too small a one for the chopper is not a cure.
    let mut before = keys(&BARE);
    before.extend(keys(&[
        ("brake_resistor.resistance", "3 kOhm"),
        ("brake_resistor.power", "1 kW"),
    ]));
    let kinds = mend(&folder, &before, &[&lift], &[]);
    assert_eq!(kinds[0], "brake_resistor.resistance");
    before.push(("min_resistance", "2.9 kOhm".to_owned()));
    let (text, answer) = run(&folder, &before, &[&lift], &[], 1);
    assert!(
        text.contains("but the chopper requires at least 2900 Ω"),
        "{text}"
    );
    let keys = answer["cures"].to_string();
    assert!(!keys.contains("brake_resistor.resistance"), "{keys}");
}

/// Phases alone can be a cure: two presses in step raise the bus too far, half a cycle apart they do not.
#[test]
fn phases_that_do() {
    let folder = Folder::new();
    let press = press_text();
    let mut before = keys(&BARE);
    before[1].1 = "420 uF".to_owned();
    let (_, answer) = run(&folder, &before, &[&press], &[], 1);
    let cures = answer["cures"].as_array().unwrap();
    let cure = cures
        .iter()
        .find(|cure| !cure["phases [s]"].is_null())
        .unwrap();
    let words = cure["words"].as_str().unwrap();
    assert!(words.starts_with("axes synchronised, axis 2 "), "{words}");
    mend(&folder, &before, &[&press], &[]);
    mend(&folder, &before, &[&press], &["--in-step"]);
}
