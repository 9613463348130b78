//! `jred export --prove`: what it prints, writes and ends with.

use jred::Image;
use serde_json::Value;

use super::{export_of, words_of};
use crate::support::{Folder, press_file, shipped};

#[test]
fn a_proof_is_printed_and_stated_in_the_image() {
    let folder = Folder::new();
    let out = folder.path("press.jred");
    let more = ["--torque-error", "2 N m", "--prove"];
    let run = export_of(&press_file(), &more, Some(&out));
    let run = run.ends(0);
    assert!(
        run.out
            .contains("proven over every position: torque error of the table within "),
        "{}",
        run.out
    );
    // A closed form is not proven.
    assert!(!run.out.contains("layout slider-crank"), "{}", run.out);
    let json = export_of(
        &press_file(),
        &[&more[..], &["--format", "json"]].concat(),
        None,
    );
    let json = json.ends(0);
    let json: Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(json["error_between_places"], "proven");
    let proof = |name: &str| json["proof"][name].as_f64().unwrap();
    let [table, tick, least] = ["table_torque_error", "tick_torque_error", "at_least"].map(proof);
    assert!(least <= table && table <= tick && tick <= 2.0, "{json}");
    let stated = f64::from(Image::new(&words_of(&out)).unwrap().validity().torque_error);
    assert!(
        tick <= stated && stated <= tick * 1.000_001,
        "{stated} {tick}"
    );
    let plain = export_of(
        &press_file(),
        &["--torque-error", "2 N m", "--format", "json"],
        None,
    );
    let plain: Value = serde_json::from_str(&plain.out).unwrap();
    assert!(plain["proof"].is_null() && plain["error_between_places"] == "estimated");
}

#[test]
fn what_is_not_proven_is_named_and_ends_with_1() {
    let cam = shipped("cam-translating.toml");
    let run = export_of(&cam, &["--torque-error", "0.5 N m", "--prove"], None);
    let run = run.ends(1);
    let why = "not proven: the motion that joint \"";
    assert!(
        run.out.contains(why) && run.message().contains(why),
        "{} {}",
        run.out,
        run.err
    );
}

/// The best table of so many bytes meets its own estimate; its proven error, with the roundings of all ticks, is larger.
#[test]
fn a_proven_error_above_the_one_allowed_ends_with_1() {
    let table = ["--type", "i16", "--layout", "rows", "--max-bytes", "2000"];
    let best = export_of(
        &press_file(),
        &[&table[..], &["--format", "json"]].concat(),
        None,
    );
    let best = best.ends(0);
    let best: Value = serde_json::from_str(&best.out).unwrap();
    let reached = best["torque_error"].as_f64().unwrap();
    let allowed = format!("{} N m", reached * 1.000_01);
    let asked = [&table[..], &["--torque-error", &allowed]].concat();
    export_of(&press_file(), &asked, None).ends(0);
    let run = export_of(&press_file(), &[&asked[..], &["--prove"]].concat(), None);
    let run = run.ends(1);
    assert!(
        run.message().contains("the proven torque error, "),
        "{}",
        run.err
    );
    assert!(run.message().contains(" deg, is above the "), "{}", run.err);
}
