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

/// Torque rates that ask for a motion many times as long as the fastest one, among them single values between others at which the search once
/// ended without a motion.
#[test]
fn torque_rates_of_presses_are_found() {
    let cases = [
        ("press", PRESS_DRIVE, ["1e4", "316.2278", "10"]),
        (
            "toggle-press",
            "sgm7g-05a+npt015mf-5",
            ["1e3", "1", "0.3162278"],
        ),
        (
            "linkage-press",
            "sgm7j-08a+npt035ma-16",
            ["10", "3.162278", "0.1"],
        ),
        (
            "cam-oscillating",
            "sgm7j-c2a+npt015mf-10",
            ["1", "0.3162278", "0.1"],
        ),
    ];
    for (machine, drive, rates) in cases {
        let file = format!(
            "{}/../../machines/{machine}.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let mut last = 0.0;
        for rate in rates {
            let limit = format!("{rate} N m/s");
            let asked = [
                "fastest",
                &file,
                "--drive",
                drive,
                "--max-torque-rate",
                &limit,
            ];
            let made = run(&[&asked[..], &["--format", "json"]].concat())
                .ends(0)
                .json();
            let own = &made["moves"][0];
            let time = own["time"].as_f64().unwrap();
            assert!(own["excess"].as_f64().unwrap() <= 1e-6, "{machine} {rate}");
            assert!(
                time >= own["bound"].as_f64().unwrap() && time > last,
                "{machine} {rate}"
            );
            last = time;
        }
    }
}

/// The force in a joint that `fastest` limits is the one that `reduce --reactions` finds in the motion that it wrote.
#[test]
fn a_limited_force_is_that_of_the_reactions() {
    let folder = Folder::new();
    let text = include_str!("../../../machines/scotch-yoke.toml");
    let yoke = folder.file("yoke.toml", text);
    let begin = text.find("[motion]").unwrap();
    let end = text.find("# Run-up from rest").unwrap();
    let motion = "[motion]\ntype = \"profile\"\nfile = \"p.csv\"\ncyclic = false\n\n";
    let judged = folder.file("judged.toml", edited(text, &text[begin..end], motion));
    let profile = folder.path("p.csv");
    let mut asked = vec![
        "fastest",
        yoke.to_str().unwrap(),
        "--from",
        "30 deg",
        "--to",
        "400 deg",
    ];
    asked.extend(["--torque", "80 N m", "--motor-speed", "1500 rpm"]);
    asked.extend(["--profile", profile.to_str().unwrap(), "--format", "json"]);
    let joint = ["--max-reaction", "pin in the slot=1 kN"];
    for (limit, most) in [(&joint[..], 1000.0), (&[], 2000.0)] {
        let made = run(&[&asked[..], limit].concat()).ends(0).json();
        let phases = made["moves"][0]["phases"].as_array().unwrap();
        let at_limit = phases
            .iter()
            .any(|phase| phase["limit"] == "force in pin in the slot");
        assert_eq!(at_limit, !limit.is_empty());
        let forces = run(&[
            "reduce",
            judged.to_str().unwrap(),
            "--reactions",
            "--over",
            "time",
            "--positions",
            "2000",
            "--format",
            "json",
        ]);
        let largest = forces.ends(0).json()["largest"].clone();
        let of_pin = largest
            .as_array()
            .unwrap()
            .iter()
            .find(|one| one["quantity"] == "pin in the slot F [N]");
        let force = of_pin.unwrap_or_else(|| panic!("{largest}"))["value"]
            .as_f64()
            .unwrap();
        if limit.is_empty() {
            assert!(force > 1.05 * 1000.0 && force < most, "{force}");
        } else {
            assert!((force / most - 1.0).abs() <= 1e-5, "{force}");
        }
    }
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
    let plain = [
        "fastest",
        axis,
        "--torque",
        "500 N m",
        "--motor-speed",
        "6000 rpm",
        "--max-speed",
        "1 m/s",
        "--max-acceleration",
        "10 m/s^2",
    ];
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
    let retimed = run(&["retime", axis, "--format", "csv"]).ends(0);
    assert!(
        retimed.out.starts_with("t [s],s [m],v [m/s],a [m/s^2]"),
        "{}",
        &retimed.out[..60]
    );
    let listed = run(&["retime", axis]).ends(0).out;
    assert!(listed.contains("x = 0 mm to x = 600 mm"), "{listed}");
}

/// A profile of the drive link under a [motion] of the tool: the cure is named.
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
    run(&["check", wrong.to_str().unwrap()]).ends(2).says(&[
        "the file has positions of the drive link",
        "remove `of` from [motion]",
    ]);
}

/// The drive that the motion is made for is the first of the list, and every drive that was tried stands with its own motion and what that saves.
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
    assert!(text.contains("each with its own motion"), "{text}");
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

/// Where a guide turns round its friction does, too: the largest force is that of the side on which the motion is.
#[test]
fn the_largest_force_has_the_friction_of_its_own_side() {
    let home = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let feeder = home.join("../../machines/shaking-feeder.toml");
    let answer = run(&[
        "fastest",
        feeder.to_str().unwrap(),
        "--torque",
        "100 N m",
        "--motor-speed",
        "3000 rpm",
        "--max-reaction",
        "crank pivot=4 kN",
        "--format",
        "json",
    ])
    .ends(0)
    .json();
    let force = answer["joint_forces"][0]["force"].as_f64().unwrap();
    assert!(
        force <= 4000.0 * (1.0 + 1e-6) && force > 4000.0 * (1.0 - 1e-4),
        "{force}"
    );
}

/// A limit that is satisfied by far lags behind where the torque bends; at this RMS torque that once stopped the search.
#[test]
fn a_limit_far_away_does_not_stop_the_search() {
    let press = crate::support::press_file();
    let answer = run(&[
        "fastest",
        press.to_str().unwrap(),
        "--drive",
        "sgm7a-25a+npt025mf-4",
        "--max-rms",
        "10.40564 N m",
        "--format",
        "json",
    ])
    .ends(0)
    .json();
    let found = answer["motor"]["rms_torque"].as_f64().unwrap();
    assert!(found <= 10.40564 && found > 10.4, "{found}");
}

/// Firmware that follows the plan is where the motion is, within what the plan says of itself; as Rust source it has the same words, and the identifier of the table.
#[test]
fn a_plan_is_the_motion() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    let press = press.to_str().unwrap();
    let [plan, source, c_source, table] =
        ["p.jred", "p.rs", "press_plan.h", "t.jred"].map(|name| folder.path(name));
    let fastest = |plan: &std::path::Path, format: &str| {
        run(&[
            "fastest",
            press,
            "--torque",
            "50 N m",
            "--motor-speed",
            "3000 rpm",
            "--max-speed",
            "28 rad/s",
            "--format",
            format,
            "--instants",
            "1001",
            "--plan-error",
            "0.02 %",
            "--plan",
            plan.to_str().unwrap(),
        ])
        .ends(0)
    };
    let course = fastest(&plan, "csv").columns();
    assert!(fastest(&source, "table").out.contains("rows, "));
    run(&[
        "export",
        press,
        "--torque-error",
        "2 N m",
        "--out",
        table.to_str().unwrap(),
    ])
    .ends(0);
    let words = |path: &std::path::Path| -> Vec<u32> {
        let bytes = std::fs::read(path).unwrap();
        bytes
            .chunks(4)
            .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
            .collect()
    };
    let (words, table) = (words(&plan), words(&table));
    fastest(&c_source, "table");
    let [text, c_text] = [&source, &c_source].map(|path| std::fs::read_to_string(path).unwrap());
    for text in [&text, &c_text] {
        let hexadecimal = text
            .split("0x")
            .skip(2)
            .map(|rest| u32::from_str_radix(&rest[..8], 16).unwrap());
        assert_eq!(hexadecimal.collect::<Vec<_>>(), words);
    }
    // Every ending of C and C++, small or capital, has the same text.
    for ending in ["hh", "hpp", "hxx", "c", "cc", "cpp", "CPP", "cxx"] {
        let other = folder.path(&format!("press_plan.{ending}"));
        fastest(&other, "table");
        assert_eq!(std::fs::read_to_string(&other).unwrap(), c_text, "{ending}");
    }
    let array = format!("const uint32_t press_plan_words[{}] =", words.len());
    assert!(c_text.contains(&array), "{c_text}");
    let image = jred::Image::new(&table).unwrap();
    assert!(text.contains(&format!("MACHINE: u32 = 0x{:08x}", image.machine())));
    let machine = format!("#define PRESS_PLAN_MACHINE 0x{:08x}u", image.machine());
    assert!(c_text.contains(&machine), "{c_text}");
    let model = image.any_model::<jred::Spline<f32>>().unwrap();
    let read = jred::axis::Plan::new(&words, &model).unwrap();
    let read = read.of_machine(image.machine()).unwrap();
    let errors = read.errors();
    let column = |name: &str| course.get(name);
    let [times, positions] = [column("t [s]"), column("phi [deg]")];
    let [speeds, accelerations] = [column("omega [rad/s]"), column("alpha [rad/s^2]")];
    let last = times.len() - 1;
    assert_eq!(last, 1000);
    let mut beyond = 0;
    for k in 0..last {
        let (t, position, speed) = (times[k], positions[k], speeds[k]);
        let acceleration = accelerations[k];
        let place = read.at((t * 2f64.powi(40)) as u64).value;
        let turns =
            f64::from(place.turns) + f64::from(place.motion.phase.to_bits()) / 2f64.powi(32);
        let position_error = (turns * 360.0 - position).to_radians().abs();
        assert!(
            position_error <= 1.01 * f64::from(errors.position) + 1e-7,
            "{t}: {position_error:e}"
        );
        let speed_error = (f64::from(place.motion.omega) - speed).abs();
        assert!(
            speed_error <= 1.01 * f64::from(errors.speed) + 1e-5,
            "{t}: {speed_error:e}"
        );
        let error = (f64::from(place.motion.alpha) - acceleration).abs();
        // An instant may lie on a corner.
        beyond += usize::from(error > 1.05 * f64::from(errors.acceleration) + 1e-3);
    }
    assert!(beyond <= 2, "{beyond}");
}

/// An error that is no share is refused; one that whole numbers cannot keep is said.
#[test]
fn the_error_of_a_plan_is_looked_at() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    let (press, plan) = (press.to_str().unwrap(), folder.path("p.jred"));
    let refused = |more: &[&str], says: &str| {
        let mut arguments = vec!["retime", press];
        arguments.extend(more);
        run(&arguments).ends(2).says(&[says]);
    };
    refused(&["--plan-error", "1 %"], "--plan");
    // Finer than whole numbers: it is written, and says so.
    run(&[
        "fastest",
        press,
        "--torque",
        "50 N m",
        "--motor-speed",
        "3000 rpm",
        "--plan",
        plan.to_str().unwrap(),
        "--plan-error",
        "0.0001 %",
    ])
    .ends(0)
    .says(&[
        "warning: the plan's acceleration is off by",
        "but --plan-error allows",
        "give a larger --plan-error",
    ]);
    refused(
        &["--plan", plan.to_str().unwrap(), "--plan-error", "50 %"],
        "from 0.0001 % to 10 %",
    );
}

/// An ending that says nothing of the form of a plan is refused before anything is computed.
#[test]
fn a_plan_has_a_known_ending() {
    let folder = Folder::new();
    let press = folder.file("press.toml", press_text());
    for name in ["q.txt", "q", "q.rs.bak"] {
        let plan = folder.path(name);
        let arguments = [
            "retime",
            press.to_str().unwrap(),
            "--plan",
            plan.to_str().unwrap(),
        ];
        run(&arguments).ends(2).says(&[".rs is Rust source"]);
        assert!(!plan.exists(), "{name}");
    }
}
