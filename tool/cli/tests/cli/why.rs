//! `jred size --why`: the requested drive, its rules, and its rank.

use serde_json::Value;

use super::forms::{AMPLIFIERS, RUN_BY};
use crate::support::{Folder, Run, edited_press, jred, jred_with, press_file};

/// A few motors with all gearboxes; the whole catalogue would be 100 MB of JSON.
const MOTORS: &str = "fxm*";

fn size(more: &[&str]) -> Run {
    let press = press_file();
    let of_few = ["size", press.to_str().unwrap(), "--steps", "200", "--motor"];
    jred_with(&[&of_few, &[MOTORS][..], more].concat())
}

fn why(name: &str) -> Run {
    size(&["--why", name])
}

fn name(drive: &Value, between: &str, direct: &str) -> String {
    let motor = drive["motor"].as_str().unwrap();
    match drive["gearbox"].as_str() {
        Some(gearbox) => format!("{motor}{between}{gearbox}"),
        None => format!("{motor}{direct}"),
    }
}

fn all() -> Value {
    size(&["--all", "--format", "json"]).ends(0).json()
}

/// A suitable drive is shown with its own rules and its rank, a refused one with the rules that it violates.
#[test]
fn the_drive_asked_for_is_shown_and_placed() {
    let all = all();
    let (fit, refused) = (&all["fit"], &all["refused"]);
    let count = fit.as_array().unwrap().len();
    assert!(count > 3);
    for k in [0, 2, count - 1] {
        let own = name(&fit[k], " + ", ", direct");
        let text = why(&own).ends(0).out;
        assert!(
            text.contains(&format!("Requested drive: {own}\n")),
            "{text}"
        );
        assert!(
            text.contains(&format!(
                "violates no rule: rank {} of {count} suitable drives",
                k + 1
            )),
            "{text}"
        );
        let best = name(&fit[0], " + ", ", direct");
        assert_eq!(
            text.contains(&format!("The best drive is {best}")),
            k > 0,
            "{text}"
        );
        assert!(!text.contains("Best drive:"), "{text}");
        // Its own rules, not those of the best drive.
        let check = &fit[k]["checks"][0];
        let note = check["note"].as_str().unwrap();
        let unbroken = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let first = note.split(',').next().unwrap();
        assert!(unbroken.contains(first), "{first}: {text}");
        assert!(text.contains("limit is"), "{text}");
    }
    let own = name(&refused[7], " + ", ", direct");
    let text = why(&own).ends(0).out;
    assert!(
        text.contains(&format!(
            "Requested drive: {own}\nrefused; use of the limits that it violates: "
        )),
        "{text}"
    );
    let broken = refused[7]["checks"].as_array().unwrap().iter();
    let broken: Vec<&str> = broken
        .filter(|check| check["verdict"] == "fail")
        .map(|check| check["rule"].as_str().unwrap())
        .collect();
    let place = text
        .lines()
        .find(|line| line.starts_with("refused; use of the limits"))
        .unwrap();
    assert!(
        !broken.is_empty() && broken.iter().all(|rule| place.contains(rule)),
        "{place}"
    );
    assert!(text.contains("FAIL"), "{text}");
}

/// Every printed or documented form of a name is accepted.
#[test]
fn names_as_printed_are_understood() {
    let all = all();
    let drives = || {
        all["fit"]
            .as_array()
            .unwrap()
            .iter()
            .chain(all["refused"].as_array().unwrap())
    };
    let geared = drives().find(|d| !d["gearbox"].is_null()).unwrap();
    let direct = drives().find(|d| d["gearbox"].is_null()).unwrap();
    for (drive, ways) in [
        (geared, [["+", ""], [" + ", ""], ["+ ", ""]]),
        (direct, [["", ""], ["", "+direct"], ["", ", direct"]]),
    ] {
        for [between, end] in ways {
            let text = why(&name(drive, between, end)).ends(0).out;
            let own = name(drive, " + ", ", direct");
            assert!(
                text.contains(&format!("Requested drive: {own}\n")),
                "{between:?} {end:?}: {text}"
            );
        }
    }
    let folder = Folder::new();
    folder.file("amplifiers.csv", AMPLIFIERS);
    folder.file("compatibility.csv", RUN_BY);
    for amplifier in ["small", "large"] {
        let own = format!("{} on {amplifier}", name(geared, " + ", ""));
        // A motor without a current is combined with every amplifier.
        let mine = folder.path("");
        let catalogues = [
            "--catalogue",
            "built-in",
            "--catalogue",
            mine.to_str().unwrap(),
        ];
        let run = size(&[&catalogues[..], &["--why", &own, "--format", "json"]].concat());
        let asked = &run.json()["asked"];
        assert_eq!(asked["amplifier"], amplifier);
        assert_eq!(asked["rank"].is_null(), asked["verdict"] == "fail");
    }
}

/// If no drive is suitable there is no best one, and the exit code is 1.
#[test]
fn asked_for_among_drives_of_which_none_holds() {
    let folder = Folder::new();
    let file = folder.file("heavy.toml", edited_press("\"-10 kN\"", "\"-900 kN\""));
    let run = jred([&"size", &file, &"--why", &"fxm33-30a+direct"]).ends(1);
    for words in [
        "Requested drive: fxm33-30a, direct",
        "refused; use of the limits",
        "No drive satisfies every rule",
    ] {
        assert!(run.out.contains(words), "{words:?} is not in {}", run.out);
    }
    let unknown = why("fxm33-31a+direct").ends(2);
    unknown.says(&[
        "there is no drive \"fxm33-31a+direct\" in the catalogue",
        "did you mean",
    ]);
}
