//! Motions that are made, written and judged: `jred fastest` and `jred retime`, then `jred size`.

use crate::support::{Folder, Run, edited, jred_with, press_text};
use serde_json::Value;

const PRESS_DRIVE: &str = "sgm7a-25a+npt025mf-4";

/// The press, which rests for 1.5 s after each stroke.
fn rested() -> String {
    edited(&press_text(), "dwell = \"0.1 s\"", "dwell = \"1.5 s\"")
}

/// The same with another motion.
fn with_motion(text: &str, motion: &str) -> String {
    let begin = text.find("[motion]").unwrap();
    let end = text.find("# Start from rest").unwrap();
    edited(text, &text[begin..end], motion)
}

fn checked<'v>(drive: &'v Value, rule: &str) -> &'v Value {
    let checks = drive["checks"].as_array().unwrap();
    checks.iter().find(|check| check["rule"] == rule).unwrap()
}

fn run(arguments: &[&str]) -> Run {
    jred_with(arguments)
}

/// With the reserve of the rules, written as a profile, the same drive is accepted, and its peak torque is that of the motion; without a reserve
/// torque and speed are refused.
#[test]
fn size_accepts_a_motion_with_its_reserve() {
    let folder = Folder::new();
    let press = folder.file("press.toml", rested());
    let press = press.to_str().unwrap();
    let motion = "[motion]\ntype = \"profile\"\nfile = \"p.csv\"\n\n";
    let judged = folder.file("judged.toml", with_motion(&rested(), motion));
    let judged = judged.to_str().unwrap();
    let profile = folder.path("p.csv");
    let profile = profile.to_str().unwrap();
    for (reserve, verdict) in [("rules", "pass"), ("0 %", "fail")] {
        let made = run(&[
            "fastest",
            press,
            "--drive",
            PRESS_DRIVE,
            "--reserve",
            reserve,
            "--profile",
            profile,
            "--format",
            "json",
        ])
        .ends(0)
        .json();
        let sized = run(&["size", judged, "--why", PRESS_DRIVE, "--format", "json"]).json();
        let drive = &sized["asked"];
        for rule in ["peak torque", "speed"] {
            assert_eq!(
                checked(drive, rule)["verdict"],
                verdict,
                "{reserve}: {drive:#}"
            );
        }
        let [asked, found] = [&made["motor"]["peak_torque"], &sized["explanation"]["contributions"]["total"]["torque [N m]"]["max"]];
        let [asked, found] = [asked, found].map(|value| value.as_f64().unwrap());
        assert!((found / asked - 1.0).abs() < 1e-6, "{found} {asked}");
        let left = made["reserve"]["torque"].as_f64().unwrap();
        assert!((left - if reserve == "rules" { 0.2 } else { 0.0 }).abs() < 1e-12);
    }
    run(&["fastest", press, "--reserve", "120 %"])
        .ends(2)
        .says(&["less than 100 %"]);
}
