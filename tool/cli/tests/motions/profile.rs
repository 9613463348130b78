//! A computed motion in a profile, which the other commands read, and with the drives for which it was made.

use serde_json::Value;

use super::{PRESS_DRIVE, run};
use crate::support::{Folder, edited, jred_of, near, press_text, shipped, typed};

/// The press with a rest of 1.5 s after each stroke.
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
        let [asked, found] = [
            &made["motor"]["peak_torque"],
            &sized["explanation"]["contributions"]["total"]["torque [N m]"]["max"],
        ];
        let [asked, found] = [asked, found].map(|value| value.as_f64().unwrap());
        assert!((found / asked - 1.0).abs() < 1e-6, "{found} {asked}");
        let left = made["reserve"]["torque"].as_f64().unwrap();
        assert!((left - if reserve == "rules" { 0.2 } else { 0.0 }).abs() < 1e-12);
    }
    run(&["fastest", press, "--reserve", "120 %"])
        .ends(2)
        .says(&["less than 100 %"]);
}

/// A toothed-belt axis in millimetres: 600 mm at up to 1 m/s and 10 m/s² take 0.6 + 0.1 s. The profile is in metres, for the same [motion].
#[test]
fn an_axis_is_spoken_of_in_its_own_words() {
    let folder = Folder::new();
    let machines = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let text = std::fs::read_to_string(machines.join("belt-axis.toml")).unwrap();
    let axis = folder.file("axis.toml", &text);
    let axis = axis.to_str().unwrap();
    let profile = folder.path("p.csv");
    let profile = profile.to_str().unwrap();
    let line = format!(
        "fastest '{axis}' --torque '500 N m' --motor-speed '6000 rpm' --max-speed '1 m/s' --max-acceleration '10 m/s^2'"
    );
    let plain = typed(&line);
    let with = |more: &[&'static str]| [&plain[..], more].concat();
    let way = ["--from", "0 mm", "--to", "600 mm"];
    let made = run(&with(&way)).ends(0).out;
    for words in [
        "0.7 s: 1 move",
        "0 mm to 600 mm",
        "from x [mm]",
        "speed from [m/s]",
    ] {
        assert!(made.contains(words), "{made}");
    }
    let json = run(&[&with(&way)[..], &["--format", "json", "--profile", profile]].concat());
    let json = json.ends(0).json();
    let time = json["duration"].as_f64().unwrap();
    assert!((time - 0.7).abs() < 1e-9, "{time}");
    assert_eq!(json["unit"], "m");
    let move_to = json["moves"][0]["to"].as_f64().unwrap();
    assert!((move_to - 0.6).abs() < 1e-12, "{move_to}");
    let begin = text.find("[[motion.segment]]").unwrap();
    let again = text[..begin].replace(
        "type = \"cycle\"",
        "type = \"profile\"\nfile = \"p.csv\"\ncyclic = false",
    );
    let again = folder.file("again.toml", again);
    let checked = run(&["check", again.to_str().unwrap()]).ends(0).out;
    for words in ["motion of x of carriage: 0.7 s", "600 mm", "1 m/s"] {
        assert!(checked.contains(words), "{checked}");
    }
    let gentlest = run(&["gentlest", axis, "--format", "csv"]).ends(0);
    assert!(
        gentlest.out.starts_with("t [s],s [m],v [m/s],a [m/s^2]"),
        "{}",
        &gentlest.out[..60]
    );
    let listed = run(&["gentlest", axis]).ends(0).out;
    assert!(listed.contains("x = 0 mm to x = 600 mm"), "{listed}");
}

/// A profile of the drive link with a [motion] of the tool: the cure is named.
#[test]
fn a_profile_of_the_drive_link_does_not_go_with_a_motion_of_the_tool() {
    let folder = Folder::new();
    let press = folder.file("press.toml", rested());
    let profile = folder.path("p.csv");
    run(&[
        "fastest",
        press.to_str().unwrap(),
        "--torque",
        "30 N m",
        "--motor-speed",
        "3000 rpm",
        "--profile",
        profile.to_str().unwrap(),
    ])
    .ends(0);
    let motion = "[motion]\ntype = \"profile\"\nfile = \"p.csv\"\nof = { point = \"slider\", along = \"x\" }\nnear = \"90 deg\"\n\n";
    let wrong = folder.file("wrong.toml", with_motion(&rested(), motion));
    run(&["check", wrong.to_str().unwrap()])
        .ends(2)
        .says(&["positions of the drive link", "remove `of` from [motion]"]);
}

/// The drive that the motion is made for is first in the list; every tried drive is listed with its own motion and the saving.
#[test]
fn the_motion_is_that_of_the_first_drive() {
    let folder = Folder::new();
    let press = folder.file("press.toml", rested());
    let press = press.to_str().unwrap();
    let home = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../sizing/catalogue");
    let few = |table: &str, keys: &[&str]| {
        let text = std::fs::read_to_string(home.join(table)).unwrap();
        let kept = |line: &&str| {
            let key = line.split(',').next().unwrap();
            key == "key" || keys.contains(&key)
        };
        let lines: Vec<&str> = text.lines().filter(kept).collect();
        folder.file(table, lines.join("\n") + "\n")
    };
    let motors = few("motors.csv", &["sgmsh-15a", "sgmsh-30a"]);
    let gearboxes = few("gearboxes.csv", &["npt025mf-5", "npt035mf-10"]);
    let size = [
        "size",
        press,
        "--motion",
        "best",
        "--steps",
        "200",
        "--motors",
        motors.to_str().unwrap(),
        "--gearboxes",
        gearboxes.to_str().unwrap(),
    ];
    let text = run(&size).ends(0).out;
    let (_, named) = text.split_once("Motion: the gentlest for ").unwrap();
    let (named, _) = named.split_once(" (").unwrap();
    assert!(
        text.contains("drive, each") && text.contains("own motion"),
        "{text}"
    );
    let json = run(&[&size[..], &["--format", "json"]].concat())
        .ends(0)
        .json();
    let first = &json["fit"][0];
    let name = format!(
        "{} + {}",
        first["motor"].as_str().unwrap(),
        first["gearbox"].as_str().unwrap()
    );
    assert!(
        name == named || text.contains(&format!("The list ranks {name}")),
        "{name} {named}"
    );
}

/// A table that indexes 3,900 times an hour: with --reserve rules the motion satisfies T2B at the shock factor of its own rate, T2N as cubic mean and
/// the S1 torque, and `jred size` accepts it with the same drive. Limits that were not requested are named, with their options.
#[test]
fn size_accepts_a_gearbox_with_shock_factors() {
    let home = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../support/engineer");
    let catalogue = home.join("cat");
    let catalogue = catalogue.to_str().unwrap();
    let text = std::fs::read_to_string(home.join("table.toml")).unwrap();
    let folder = Folder::new();
    let table = folder.file("table.toml", &text);
    let table = table.to_str().unwrap();
    let profile = folder.path("fast.csv");
    let profile = profile.to_str().unwrap();
    let drive = ["--catalogue", catalogue, "--drive", "sm100bb+g115-16 on a6"];
    let line = format!("--reserve rules --max-rms s1 --profile '{profile}'");
    let asked = typed(&line);
    let made = run(&[
        &["fastest", table][..],
        &drive,
        &asked,
        &["--format", "json"],
    ]
    .concat());
    let made = made.ends(0).json();
    let kept: Vec<&str> = made["rules"]["kept"]
        .as_array()
        .unwrap()
        .iter()
        .map(|check| check["rule"].as_str().unwrap())
        .collect();
    for rule in [
        "RMS torque",
        "peak torque",
        "gearbox peak torque",
        "gearbox cubic-mean torque",
        "gearbox mean speed",
        "RMS current",
        "peak current",
    ] {
        assert!(kept.contains(&rule), "{rule}: {kept:?}");
    }
    assert_eq!(made["rules"]["not_kept"].as_array().unwrap().len(), 0);
    let begin = text.find("[motion]").unwrap();
    let end = text.find("[supply]").unwrap();
    let motion = "[motion]\ntype = \"profile\"\nfile = \"fast.csv\"\n\n";
    let judged = folder.file("judged.toml", edited(&text, &text[begin..end], motion));
    let sized = run(&[&["size", judged.to_str().unwrap()][..], &drive].concat());
    sized.ends(0);
    // A lift with continuous load: without --max-rms the RMS torque is named.
    let busy = folder.file(
        "busy.toml",
        edited(&text, "dwell = \"0.6 s\"", "dwell = \"0.01 s\""),
    );
    let weak = ["--catalogue", catalogue, "--drive", "sm100ab+g90-10 on a6"];
    let listed = run(&[
        &["fastest", busy.to_str().unwrap(), "--reserve", "rules"][..],
        &weak,
    ]
    .concat());
    if listed.code == 1 {
        assert!(listed.out.contains("not kept"), "{}", listed.out);
    }
}

/// Without a largest speed only the torque limits a move from rest to rest; an endless motion needs a largest speed.
#[test]
fn a_torque_without_a_speed() {
    let folder = Folder::new();
    let table = "title = \"t\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\nmass = \"1 kg\"\ninertia = \"2 kg m^2\"\n[motion]\ntype = \"constant-speed\"\nspeed = \"60 rpm\"\n";
    let file = folder.file("t.toml", table);
    let file = file.to_str().unwrap();
    let plain = ["fastest", file, "--torque", "20 N m"];
    let made = run(&[
        &plain[..],
        &["--from", "0 deg", "--to", "360 deg", "--format", "json"],
    ]
    .concat());
    // 10 rad/s² over the first half, and back.
    let time = made.ends(0).json()["duration"].as_f64().unwrap();
    let expected = 2.0 * (std::f64::consts::TAU / 10.0).sqrt();
    assert!((time / expected - 1.0).abs() < 1e-9, "{time} {expected}");
    run(&plain)
        .ends(2)
        .says(&["nothing limits the speed", "--max-speed", "--motor-speed"]);
}

/// The jump that the listing names is the largest one of the profile: from and to rest, or between two rows of one time. Ramps have none.
#[test]
fn a_jump_of_the_acceleration_is_said() {
    let press = shipped("press.toml");
    let line = "gentlest {} --steps 200";
    let says = jred_of(line, [&press]).out;
    let profile = jred_of(&format!("{line} --format csv"), [&press]).out;
    let number = |cell: &str| cell.parse::<f64>().unwrap();
    let rows = profile.lines().skip(1);
    let rows: Vec<Vec<f64>> = rows
        .map(|row| row.split(',').map(number).collect())
        .collect();
    let ends = [&rows[0], &rows[rows.len() - 1]].map(|row| row[3].abs());
    let inner = rows.windows(2).filter(|two| two[0][0] >= two[1][0]);
    let inner = inner.map(|two| (two[1][3] - two[0][3]).abs());
    let largest = inner.chain(ends).fold(0.0, f64::max);
    assert!(largest > 100.0, "{largest}");
    let (_, said) = says.split_once("the acceleration jumps").expect(&says);
    let (_, said) = said.split_once(" by ").unwrap();
    let said = number(said.split_once(" rad/s^2").unwrap().0);
    near("jump", said, largest, 1e-3);
    let says = jred_of(&format!("{line} --ends zero"), [&press]).out;
    assert!(!says.contains("jumps"), "{says}");
}
