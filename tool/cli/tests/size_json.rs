//! The JSON of `jred size` against its schema, `docs/schemas/size.json`.

use std::path::{Path, PathBuf};

use crate::support::schema::faults;
use crate::support::{
    Folder, budget, edited_press, jred, jred_of, jred_with, press_file, sizeable_machines,
};
use serde_json::{Value, json};

fn check(answer: &Value) {
    let faults = faults(answer);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

fn machine(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../machines")
        .join(name)
}

#[test]
fn answers_follow_the_schema() {
    let explained = jred([&"size", &press_file(), &"--explain", &"--format", &"json"]);
    let answer = explained.ends(0).json();
    check(&answer);
    let effects = answer["explanation"]["contributions"]["effects"]
        .as_array()
        .unwrap();
    let shares = effects
        .iter()
        .map(|e| e["share of mean square"].as_f64().unwrap());
    crate::support::within("shares", shares.sum(), 1.0, budget::CELLS);
    assert_eq!(answer["fit"].as_array().unwrap().len(), 10);
    assert_eq!(answer["refused"].as_array().unwrap().len(), 3);
    for (name, motors) in [
        ("hoist.toml", "sgmsh-*"),
        ("ball-screw.toml", "sgmph-*"),
        ("geneva.toml", "sgmuh-*"),
    ] {
        let run = jred_of(
            "size {} --motor {} --all --format json",
            [&machine(name), &motors],
        );
        let answer = run.json();
        check(&answer);
        for list in ["fit", "refused"] {
            assert_eq!(
                answer["counts"][list],
                answer[list].as_array().unwrap().len()
            );
        }
    }
}

#[test]
fn an_answer_without_a_drive_follows_it_as_well() {
    let folder = Folder::new();
    let file = folder.file("heavy.toml", edited_press("\"-10 kN\"", "\"-900 kN\""));
    let run = jred([&"size", &file, &"--explain", &"--format", &"json"]);
    let answer = run.ends(1).json();
    check(&answer);
    assert_eq!(answer["explanation"]["change"]["holds"], false);
}

/// The schema rejects invalid answers. A sliding drive link has its own keys; one with both kinds of keys or neither is invalid.
#[test]
fn a_slide_has_keys_in_newtons_and_metres() {
    let bucket = machine("excavator-bucket.toml");
    let turning = jred([&"size", &press_file(), &"--format", &"json"]).json();
    let sliding = jred([&"size", &bucket, &"--format", &"json"]).json();
    check(&turning);
    check(&sliding);
    let slides = sliding.get("drive link speed [m/s]").is_some();
    assert!(slides && sliding.get("drive link speed [rad/s]").is_none());
    assert!(turning.get("drive link speed [m/s]").is_none());
    let mut neither = sliding;
    neither
        .as_object_mut()
        .unwrap()
        .remove("drive link force [N]");
    assert!(!faults(&neither).is_empty());
}

#[test]
fn the_schema_refuses_what_is_wrong() {
    let best = jred([&"size", &press_file(), &"--top", &"1", &"--format", &"json"]).json();
    let mut name = best["fit"][0]["motor"].as_str().unwrap().to_owned();
    if let Some(gearbox) = best["fit"][0]["gearbox"].as_str() {
        name = format!("{name}+{gearbox}");
    }
    let run = jred_of(
        "size {} --top 1 --why {} --format json",
        [&press_file(), &name],
    );
    let answer = run.ends(0).json();
    check(&answer);
    assert_eq!(answer["asked"]["rank"], 1);
    let spoilt: [(&str, Value); 6] = [
        ("/schema", json!("jred-size/3")),
        ("/asked/rank", json!(0)),
        ("/cycle [s]", json!("0.5 s")),
        ("/counts/fit", json!(-1)),
        ("/fit/0/checks/0/verdict", json!("good")),
        ("/fit/0/duty/torque [N m]", json!({ "min": 0 })),
    ];
    for (place, wrong) in spoilt {
        let mut answer = answer.clone();
        *answer.pointer_mut(place).unwrap() = wrong;
        assert!(!faults(&answer).is_empty(), "{place}");
    }
    let mut without = answer.clone();
    without.as_object_mut().unwrap().remove("counts");
    assert!(!faults(&without).is_empty());
}

#[test]
fn a_drive_can_be_named() {
    let named = |name: &str, code: i32| {
        jred_of("size {} --why {} --format json", [&press_file(), &name]).ends(code)
    };
    let answer = jred([&"size", &press_file(), &"--format", &"json"]).json();
    let refused = &answer["refused"][0];
    let motor = refused["motor"].as_str().unwrap();
    let name = match refused["gearbox"].as_str() {
        Some(gearbox) => format!("{motor}+{gearbox}"),
        None => motor.to_owned(),
    };
    let why = named(&name, 0).json();
    check(&why);
    assert!(why["asked"]["rank"].is_null());
    assert_eq!(why["asked"]["motor"], motor);
    let change = &why["explanation"]["change"];
    assert_eq!(change["holds"], false);
    assert!(change["drive"].as_str().unwrap().contains(motor));
    assert!(!change["misses"].as_array().unwrap().is_empty());
    named("fxm33-30a+npt025mf-33", 2).says(&[
        "there is no drive \"fxm33-30a+npt025mf-33\" in the catalogue",
        "did you mean \"fxm33-30a + npt025mf-3\"?",
    ]);
}

/// The motor of the next smaller rated power, with the rules that it violates: no other refused motor is between.
#[test]
fn the_next_smaller_motor_says_why_not() {
    let press = press_file();
    let size = |more: &[&str]| {
        let some = ["size", press.to_str().unwrap(), "--motor", "sgm*"];
        jred_with(&[&some[..], more].concat()).ends(0)
    };
    let text = size(&["--full"]).out;
    let (_, rest) = text.split_once("next smaller motor, ").unwrap();
    let line = rest.lines().next().unwrap();
    let (power, reason) = line.split_once(" kW: ").unwrap();
    let power: f64 = power.parse().unwrap();
    let all = size(&["--all", "--format", "json"]).json();
    let powers = |list: &str| {
        let drives = all[list].as_array().unwrap().iter();
        drives
            .filter_map(|d| d["rated power [W]"].as_f64())
            .collect::<Vec<_>>()
    };
    let least = powers("fit").into_iter().fold(f64::INFINITY, f64::min);
    let below = powers("refused").into_iter().filter(|p| *p < least);
    let next = below.fold(0.0, f64::max);
    crate::support::within("power", power * 1e3, next, 5e-3 * next);
    let (name, reasons) = reason.split_once(" is refused: ").unwrap();
    let refused = size(&["--refused"]).out;
    let at = refused.find(&format!("\n {name} ")).expect(&refused);
    let reason = reasons.split(" N m, limit ").next().unwrap();
    let (rule, figure) = reason.rsplit_once(' ').unwrap();
    let row = refused[at + 1..].lines().next().unwrap();
    assert!(
        row.contains(rule) && row.contains(figure),
        "{row}: {reasons}"
    );
}

/// On 400 V mains the best drive with the maker's own figures is larger than others that violate no rule. Every format names the smallest of each
/// class of certainty, with its rank and the size of the class.
#[test]
fn smaller_motors_of_less_certain_data_are_not_hidden() {
    let folder = Folder::new();
    let axis = std::fs::read_to_string(machine("belt-axis.toml")).unwrap();
    let file = folder.file(
        "axis.toml",
        format!("{axis}\n[supply]\nmains_voltage = \"400 V\"\n"),
    );
    // Motors of every class.
    let some = ["size", file.to_str().unwrap()];
    let motors = [
        "--motor",
        "1ft7034*",
        "--motor",
        "sgmuh*",
        "--motor",
        "mc20-180*",
    ];
    let size = |more: &[&str]| jred_with(&[&some, &motors[..], more].concat()).ends(0);
    let all = size(&["--all", "--format", "json"]).json();
    check(&all);
    let fit = all["fit"].as_array().unwrap();
    let classes = all["certainties"].as_array().unwrap();
    let power = |drive: &Value| drive["rated power [W]"].as_f64().unwrap();
    let words = [
        "other-figures",
        "makers-figures-incomplete",
        "other-figures-incomplete",
        "voltage-unknown",
    ];
    assert_eq!(classes.len(), 4);
    let text = size(&["--full"]).out;
    let csv = size(&["--top", "1", "--format", "csv"]).out;
    let mut least = f64::INFINITY;
    for (class, word) in classes.iter().zip(words) {
        assert_eq!(class["certainty"], word);
        let members = || fit.iter().filter(|drive| drive["certainty"] == word);
        assert_eq!(class["drives"], members().count());
        let smallest = members().map(power).fold(f64::INFINITY, f64::min);
        let first = &class["first"];
        crate::support::within("smallest", power(first), smallest, 0.0);
        let rank = class["rank"].as_u64().unwrap();
        let mut member = fit[rank as usize - 1].clone();
        assert_eq!(member["rank"].take(), rank);
        member.as_object_mut().unwrap().remove("rank");
        assert_eq!(&member, first);
        // The classes depend on the source of the figures and on the voltage.
        let unknown = first["motor largest bus voltage [V]"].is_null();
        assert_eq!(unknown, word == "voltage-unknown");
        assert!(word != "other-figures" || first["figures from"] == "other");
        let motor = first["motor"].as_str().unwrap();
        assert!(text.contains(&format!("the first is rank {rank}: {motor}")));
        let row = format!("{rank},{motor},");
        let mut rows = csv.lines().filter(|line| line.starts_with(&row));
        assert!(
            rows.next()
                .is_some_and(|line| line.contains(&format!(",{word},"))),
            "{row}"
        );
        if smallest < least && rank > 1 {
            assert!(
                text.contains(&format!("{motor} + ")) || text.contains(&format!("{motor}, direct"))
            );
            assert!(text.contains(&format!(
                "violates no rule either, but ranks lower ({rank})"
            )));
        }
        least = least.min(smallest);
    }
    // The case under test: the best drive is not the smallest.
    assert!(power(&fit[0]) > 2.0 * least);
    // Each unchecked rule, counted a second time.
    let gaps = all["not checked"].as_array().unwrap();
    assert!(!gaps.is_empty());
    for gap in gaps {
        let open = fit.iter().filter(|drive| {
            let mut checks = drive["checks"].as_array().unwrap().iter();
            checks.any(|c| c["id"] == gap["id"] && c["verdict"] == "not-checked")
        });
        assert_eq!(gap["drives"], open.count(), "{}", gap["rule"]);
        assert!(!gap["cure"].as_str().unwrap().is_empty());
    }
    let report = folder.path("report.html");
    size(&["--report", report.to_str().unwrap()]);
    let page = std::fs::read_to_string(report).unwrap();
    for class in classes {
        let motor = class["first"]["motor"].as_str().unwrap();
        assert!(page.contains(&format!("the first is rank {}: {motor}", class["rank"])));
    }
}

/// Compares every figure of two answers and of the objects in them; `path` is the position in the JSON. Tolerances are shares of the largest figure
/// of the group (a small mean next to its RMS); for a margin, of its limit.
fn compare(path: &str, found: &Value, exact: &Value, least: f64) -> usize {
    match (found, exact) {
        (Value::Object(found), Value::Object(exact)) => {
            let keys = |of: &serde_json::Map<String, Value>| of.keys().cloned().collect::<Vec<_>>();
            assert_eq!(keys(found), keys(exact), "{path}");
            let group = ["rms", "max"].map(|key| exact.get(key).and_then(Value::as_f64));
            let group = group
                .into_iter()
                .flatten()
                .fold(0.0, |m: f64, x| m.max(x.abs()));
            // The current between two instants is a straight line for the overload.
            if exact.get("id").is_some_and(|id| id == "overload") {
                let [found, exact] =
                    [found, exact].map(|check| check.get("value").and_then(Value::as_f64));
                if let (Some(found), Some(exact)) = (found, exact) {
                    let off = (found - exact).abs() / exact.max(1.0);
                    assert!(off <= budget::OVERLOAD_STEPS, "{path}: {found} {exact}");
                }
                return 1;
            }
            // Notes contain rounded figures.
            let figures = found.iter().filter(|(key, _)| *key != "note");
            let figures = figures.map(|(key, value)| {
                let least = if key == "margin" { 1.0 } else { group };
                compare(&format!("{path}/{key}"), value, &exact[key], least)
            });
            figures.sum()
        }
        (Value::Array(found), Value::Array(exact)) => {
            assert_eq!(found.len(), exact.len(), "{path}");
            let figures = found.iter().zip(exact).enumerate();
            figures
                .map(|(k, (found, exact))| compare(&format!("{path}/{k}"), found, exact, 0.0))
                .sum()
        }
        (Value::Number(found), Value::Number(exact)) => {
            let [found, exact] = [found, exact].map(|number| number.as_f64().unwrap());
            let off = (found - exact).abs() / exact.abs().max(least).max(f64::MIN_POSITIVE);
            assert!(off <= budget::DUTY, "{path}: {found} {exact} {off:e}");
            1
        }
        _ => {
            assert_eq!(found, exact, "{path}");
            0
        }
    }
}

/// Integrals, peaks, margins and the order of the drives.
#[test]
fn every_figure_is_that_of_a_smaller_tolerance() {
    let (mut machines, mut figures) = (0, 0);
    for file in sizeable_machines() {
        let name = file.display().to_string();
        let size = |tolerance: &str| {
            let run = jred_of("size {} --format json --tolerance {}", [&file, &tolerance]);
            run.json()
        };
        figures += compare(&name, &size("1e-9"), &size("1e-12"), 0.0);
        machines += 1;
    }
    assert!(machines > 35 && figures > 20_000, "{machines} {figures}");
}
