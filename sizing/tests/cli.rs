//! The command line: exit codes, forms of output, and what a user is told who made a mistake.
// Copied figures, counts and zeros are exact.
#![allow(clippy::float_cmp)]

mod support;

use std::io::Read as _;
use std::path::Path;
use std::process::{Command, Stdio};

use support::json::row_numbers;
use support::{Columns, Folder, Run, edited, edited_press, jred, press_file, press_text};

fn export(file: &Path, more: &[&str], out: &Path) -> Run {
    let mut arguments: Vec<&str> = vec!["export", file.to_str().unwrap()];
    arguments.extend(more);
    arguments.extend(["--out", out.to_str().unwrap()]);
    run(&arguments)
}

fn run(arguments: &[&str]) -> Run {
    let output = Command::new(env!("CARGO_BIN_EXE_jred"))
        .args(arguments)
        .env("NO_COLOR", "1")
        .output()
        .unwrap();
    let run = Run {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    };
    assert!(!run.err.contains("panicked"), "{}", run.err);
    run
}

#[test]
fn zero_when_everything_holds() {
    let press = press_file();
    let folder = Folder::new();
    for format in ["table", "csv", "json"] {
        for command in ["reduce", "size", "simulate"] {
            let done = jred([&command, &press, &"--format", &format]).ends(0);
            assert!(!done.out.is_empty() && done.err.is_empty(), "{}", done.err);
        }
    }
    for (format, number) in [
        ("image", "f32"),
        ("rust", "f32"),
        ("c", "q31"),
        ("image", "q31"),
    ] {
        let out = folder.path("table");
        let more = [
            "--torque-error",
            "0.5 N m",
            "--format",
            format,
            "--type",
            number,
        ];
        let done = export(&press, &more, &out).ends(0);
        done_says(
            &done,
            &["torque error reached", "of 0.5 N m allowed", "written to"],
        );
        assert!(out.metadata().unwrap().len() > 1000);
    }
}

fn done_says(run: &Run, words: &[&str]) {
    for word in words {
        assert!(run.out.contains(word), "{word:?} is not in\n{}", run.out);
    }
}

#[test]
fn one_when_no_drive_holds() {
    let folder = Folder::new();
    let heavy = edited_press("\"-10 kN\"", "\"-900 kN\"");
    let file = folder.file("heavy.toml", &heavy);
    let done = jred([&"size", &file]).ends(1);
    done_says(
        &done,
        &[
            "No drive of",
            "holds every rule. The one that misses by least: ",
            "FAIL",
            "refused; --refused lists them with their reasons",
        ],
    );
    let done = jred([&"size", &file, &"--refused"]).ends(1);
    done_says(&done, &["\nRefused\n", "peak torque", " against "]);
    for format in ["csv", "json"] {
        jred([&"size", &file, &"--format", &format]).ends(1);
    }
    let answer = jred([&"size", &file, &"--format", &"json"]).json();
    assert_eq!(answer["fit"].as_array().unwrap().len(), 0);
    // Every refused drive has a broken rule.
    for drive in answer["refused"].as_array().unwrap() {
        let checks = drive["checks"].as_array().unwrap();
        assert!(checks.iter().any(|c| c["verdict"] == "fail"), "{drive}");
    }
}

#[test]
fn one_when_a_torque_error_is_not_reached() {
    let folder = Folder::new();
    let out = folder.path("table.bin");
    let more = ["--torque-error", "0.5 N m", "--max-cells", "32"];
    let done = export(&press_file(), &more, &out).ends(1);
    done.says(&[
        "no table meets a torque error of",
        "cells reach",
        "allow a larger error",
    ]);
    assert!(!out.exists(), "a file was written nevertheless");
}

#[test]
fn rules_of_the_file_change_the_verdict() {
    let folder = Folder::new();
    let strict = format!("{}\n[rules]\nspeed = \"1 %\"\n", press_text());
    let done = jred([&"size", &folder.file("strict.toml", strict)]).ends(1);
    done_says(&done, &["1 % of"]);
    let count = |rules: &str| {
        let text = format!("{}\n[rules]\n{rules}\n", press_text());
        let answer = jred([&"size", &folder.file("m.toml", text), &"--format", &"json"]);
        answer.json()["fit"].as_array().unwrap().len()
    };
    let default = count("rms_torque = \"80 %\"");
    assert!(count("rms_torque = \"60 %\"") < default);
    assert!(count("rms_torque = \"100 %\"\npeak_torque = \"100 %\"") > default);
    // The limit that was set is the limit that is printed.
    let text = format!("{}\n[rules]\ninertia_ratio = 7\n", press_text());
    let answer = jred([&"size", &folder.file("m.toml", text), &"--format", &"json"]).json();
    assert_eq!(answer["rules"]["inertia_ratio"], 7.0);
    let checks = answer["fit"][0]["checks"].as_array().unwrap();
    let check = checks
        .iter()
        .find(|c| c["rule"] == "inertia ratio")
        .unwrap();
    assert_eq!(check["limit"], 7.0);
}

#[test]
fn two_for_bad_input() {
    let folder = Folder::new();
    let missing = folder.path("no such file.toml");
    for command in ["reduce", "size", "simulate"] {
        let done = jred([&command, &missing]).ends(2);
        done.says(&["cannot read the machine file", "no such file"]);
        assert!(done.out.is_empty());
        jred([&command, &folder.path("")])
            .ends(2)
            .says(&["it is a folder, not a file"]);
        jred([&command, &folder.file("empty.toml", "")])
            .ends(2)
            .says(&["is empty", "[mechanism]"]);
    }
    let out = folder.path("out");
    export(&missing, &["--torque-error", "1 N m"], &out)
        .ends(2)
        .says(&["cannot read the machine file"]);
    assert!(!out.exists());
    // Not bigger than the reader allows.
    let large = folder.file("large.toml", "# filler\n".repeat(1_200_000));
    jred([&"reduce", &large])
        .ends(2)
        .says(&["at most", "are read"]);
    jred([&"reduce", &folder.file("binary.toml", [0xffu8, 0xfe, 0, 1])])
        .ends(2)
        .says(&["UTF-8"]);
}

#[test]
fn what_a_command_needs_is_named() {
    let folder = Folder::new();
    let text = press_text();
    let (machine, rest) = text.split_once("[motion]").unwrap();
    let (_, simulation) = rest.split_once("[simulation]").unwrap();
    let no_motion = folder.file("a.toml", format!("{machine}[simulation]{simulation}"));
    let (no_simulation, _) = text.split_once("[simulation]").unwrap();
    let no_simulation = folder.file("b.toml", no_simulation);
    jred([&"size", &no_motion])
        .ends(2)
        .says(&["the machine file has no [motion]", "add a [motion]"]);
    jred([&"reduce", &no_motion, &"--over", &"time"])
        .ends(2)
        .says(&["the machine file has no [motion]", "add a [motion]"]);
    jred([&"simulate", &no_simulation])
        .ends(2)
        .says(&["the machine file has no [simulation]", "add a [simulation]"]);
    let out = folder.path("out");
    export(&no_motion, &["--torque-error", "1 N m"], &out)
        .ends(2)
        .says(&["the machine file has no [motion]", "--omega and --alpha"]);
    export(
        &no_motion,
        &[
            "--torque-error",
            "1 N m",
            "--omega",
            "90 rpm",
            "--alpha",
            "50",
        ],
        &out,
    )
    .ends(0);
    jred([&"reduce", &no_motion]).ends(0);
    jred([&"size", &no_simulation]).ends(0);
}

#[test]
fn wrong_command_lines() {
    let press = press_file();
    let press = press.to_str().unwrap();
    for (arguments, words) in [
        (&[] as &[&str], &["Usage"] as &[&str]),
        (&["weigh", press], &["unrecognized subcommand", "Usage"]),
        (&["size"], &["<FILE>"]),
        (
            &["size", press, "--fromat", "csv"],
            &["--fromat", "--format"],
        ),
        (&["size", press, "--steps", "15"], &["15", "16"]),
        (&["size", press, "--steps", "1e3"], &["invalid"]),
        (&["size", press, "--top", "-1"], &["-1"]),
        (&["reduce", press, "--positions", "1"], &["1", "2"]),
        (&["reduce", press, "--positions", "1000001"], &["1000000"]),
        (
            &["reduce", press, "--format", "xml"],
            &["xml", "table", "csv", "json"],
        ),
        (
            &["reduce", press, "--over", "space"],
            &["space", "angle", "time"],
        ),
        (&["export", press, "--torque-error", "1 N m"], &["--out"]),
        (&["export", press, "--out", "x"], &["--torque-error"]),
    ] {
        let done = run(arguments).ends(2);
        done.says(words);
        assert!(done.out.is_empty(), "{}", done.out);
    }
}

#[test]
fn wrong_quantities_on_the_command_line() {
    let folder = Folder::new();
    let out = folder.path("out");
    let ok = ["--torque-error", "1 N m", "--omega", "90 rpm"];
    for (option, value, words) in [
        ("--torque-error", "0.5", &["no unit", "N m"] as &[&str]),
        ("--torque-error", "-1 N m", &["greater than zero"]),
        ("--torque-error", "0 N m", &["greater than zero"]),
        ("--torque-error", "nan N m", &["--torque-error"]),
        ("--torque-error", "NaN", &["--torque-error"]),
        ("--torque-error", "inf N m", &["--torque-error"]),
        ("--torque-error", "1e999 N m", &["--torque-error"]),
        ("--torque-error", "1 N", &["N m"]),
        ("--torque-error", "1 kg m^2", &["N m"]),
        ("--torque-error", "", &["--torque-error"]),
        ("--omega", "90", &["no unit", "rpm"]),
        ("--omega", "-90 rpm", &["greater than zero"]),
        ("--omega", "90 Hz", &["rpm"]),
        ("--omega", "90 N m", &["rpm"]),
        ("--alpha", "fast", &["--alpha", "fast"]),
        ("--max-cells", "3", &["4"]),
        ("--max-cells", "65537", &["65536"]),
    ] {
        let mut more: Vec<String> = ok.map(String::from).into();
        if let Some(at) = more.iter().position(|o| o == option) {
            more.drain(at..=at + 1);
        }
        more.push(format!("{option}={value}"));
        let more: Vec<&str> = more.iter().map(String::as_str).collect();
        let done = export(&press_file(), &more, &out).ends(2);
        done.says(words);
        assert!(!out.exists());
    }
}

/// An acceleration that is no acceleration must not silently become another one.
#[test]
fn an_acceleration_must_be_a_number_not_below_zero() {
    let folder = Folder::new();
    for alpha in ["nan", "inf", "-inf", "-50"] {
        let out = folder.path("out");
        let alpha = format!("--alpha={alpha}");
        let done = export(
            &press_file(),
            &["--torque-error", "1 N m", "--omega", "90 rpm", &alpha],
            &out,
        );
        assert_eq!(done.code, 2, "{alpha}:\n{}{}", done.out, done.err);
    }
}

#[test]
fn output_that_cannot_be_written() {
    let folder = Folder::new();
    let nowhere = folder.path("no such folder/out.html");
    for command in [
        &["size", "--report"] as &[&str],
        &["simulate", "--plot"],
        &["export", "--torque-error", "1 N m", "--out"],
    ] {
        let mut arguments = command.to_vec();
        let press = press_file();
        arguments.extend([nowhere.to_str().unwrap(), press.to_str().unwrap()]);
        let done = run(&arguments).ends(2);
        done.says(&["cannot write", "out.html"]);
    }
}

/// A slip on the command line must not cost the user his machine.
#[test]
fn the_machine_file_is_never_overwritten() {
    let folder = Folder::new();
    let mut lost = Vec::new();
    for options in [
        &["size", "--report"] as &[&str],
        &["simulate", "--plot"],
        &["export", "--torque-error", "1 N m", "--out"],
    ] {
        let file = folder.file("machine.toml", press_text());
        let mut arguments = options.to_vec();
        arguments.extend([file.to_str().unwrap(), file.to_str().unwrap()]);
        let done = run(&arguments);
        if std::fs::read(&file).unwrap() != press_text().as_bytes() || done.code != 2 {
            lost.push(options[0]);
        }
    }
    assert!(lost.is_empty(), "overwritten by {lost:?}");
}

/// `jred … | head -1`: whoever reads stops reading, which is no error.
#[test]
fn a_closed_pipe_is_no_error() {
    let press = press_file();
    for arguments in [
        &["reduce", "--positions", "100000", "--format", "csv"] as &[&str],
        &["size", "--format", "json"],
    ] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_jred"))
            .args(arguments)
            .arg(&press)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut first = [0; 10];
        let mut stdout = child.stdout.take().unwrap();
        stdout.read_exact(&mut first).unwrap();
        drop(stdout);
        let output = child.wait_with_output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{message}");
        assert!(message.is_empty(), "{message}");
    }
}

#[test]
fn help_names_the_exit_codes() {
    let help = run(&["--help"]).ends(0);
    done_says(
        &help,
        &[
            "Exit codes: 0",
            "1 a sizing rule is violated",
            "2 bad input",
            "docs/machine-file.md",
        ],
    );
    for command in ["reduce", "size", "simulate", "export"] {
        done_says(&help, &[command]);
        let help = run(&[command, "--help"]).ends(0);
        done_says(&help, &["Usage: jred", "--format"]);
    }
    done_says(&run(&["--version"]).ends(0), &["jred 0."]);
}

/// CSV and JSON carry every digit: both read back to the same numbers, bit for bit.
#[test]
fn csv_and_json_carry_every_digit() {
    let press = press_file();
    for arguments in [
        vec!["reduce", "--positions", "97", "--links"],
        vec!["reduce", "--positions", "97", "--over", "time"],
        vec!["simulate"],
    ] {
        let text = |format: &'static str| {
            let mut arguments = arguments.clone();
            arguments.extend([press.to_str().unwrap(), "--format", format]);
            run(&arguments).ends(0).out
        };
        let csv = Columns::of_csv(&text("csv"));
        let json = text("json");
        let numbers = row_numbers(&json);
        let cells: Vec<Option<f64>> = csv.rows.concat();
        assert_eq!(cells.len(), numbers.len());
        assert!(cells.len() > 97 * 10);
        for (a, b) in cells.iter().zip(&numbers) {
            assert_eq!(a.map(f64::to_bits), b.map(f64::to_bits), "{a:?} and {b:?}");
        }
        // Numbers of full precision, not rounded ones: most need sixteen or seventeen digits.
        let long = text("csv")
            .split([',', '\n'])
            .filter(|cell| cell.chars().filter(char::is_ascii_digit).count() >= 15)
            .count();
        assert!(long > cells.len() / 4, "{long} of {}", cells.len());
        let parsed = Columns::of_json(&serde_json::from_str(&json).unwrap());
        assert_eq!(parsed.names, csv.names);
    }
}

/// The verdicts in CSV are those in JSON.
#[test]
fn sizes_agree_between_csv_and_json() {
    let press = press_file();
    let csv = jred([&"size", &press, &"--format", &"csv"]).ends(0).out;
    let json = jred([&"size", &press, &"--format", &"json"]).ends(0).json();
    let drives = json["fit"].as_array().unwrap().iter();
    let drives = drives.chain(json["refused"].as_array().unwrap());
    let mut rows = csv::Reader::from_reader(csv.as_bytes());
    let names = rows.headers().unwrap().clone();
    assert_eq!(
        names.iter().collect::<Vec<_>>().join(","),
        "rank,motor,gearbox,ratio,verdict,rule,figure,limit,unit,note"
    );
    let mut records = rows.records();
    for (k, drive) in drives.enumerate() {
        for check in drive["checks"].as_array().unwrap() {
            let row = records.next().unwrap().unwrap();
            let fits = k < json["fit"].as_array().unwrap().len();
            assert_eq!(
                row[0],
                if fits {
                    (k + 1).to_string()
                } else {
                    String::new()
                }
            );
            assert_eq!(&row[1], drive["motor"].as_str().unwrap());
            assert_eq!(&row[2], drive["gearbox"].as_str().unwrap_or(""));
            assert_eq!(&row[5], check["rule"].as_str().unwrap());
            let near = |cell: &str, value: &serde_json::Value| {
                let (a, b): (f64, f64) = (cell.parse().unwrap(), value.as_f64().unwrap());
                assert!((a - b).abs() <= 1e-15 * b.abs(), "{a} and {b}");
            };
            near(&row[6], &check["value"]);
            match check["limit"].as_f64() {
                Some(_) => near(&row[7], &check["limit"]),
                None => assert_eq!(&row[7], ""),
            }
        }
    }
    assert!(records.next().is_none());
}

#[test]
fn every_column_has_a_unit() {
    let press = press_file();
    for columns in [
        jred([&"reduce", &press, &"--format", &"csv", &"--links"]),
        jred([&"reduce", &press, &"--format", &"csv", &"--over", &"time"]),
        jred([&"simulate", &press, &"--format", &"csv"]),
    ] {
        let columns = columns.ends(0).columns();
        for name in &columns.names {
            assert!(name.ends_with(']') && name.contains(" ["), "{name}");
        }
        let mut names = columns.names.clone();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), columns.names.len(), "a name is there twice");
    }
}

#[test]
fn positions_and_times() {
    let press = press_file();
    for positions in [2usize, 7, 36] {
        let run = jred([
            &"reduce",
            &press,
            &"--format",
            &"csv",
            &"--positions",
            &positions.to_string(),
        ]);
        let phi = run.ends(0).columns().get("phi [deg]");
        assert_eq!(phi.len(), positions);
        for (k, phi) in phi.iter().enumerate() {
            let expected = 360.0 * k as f64 / positions as f64;
            assert!((phi - expected).abs() < 1e-12, "{phi} and {expected}");
        }
    }
    let run = jred([
        &"reduce",
        &press,
        &"--over",
        &"time",
        &"--positions",
        &"6",
        &"--format",
        &"csv",
    ]);
    let times = run.ends(0).columns().get("t [s]");
    assert_eq!(times.len(), 6);
    for (k, t) in times.iter().enumerate() {
        assert!((t - 0.1 * k as f64).abs() < 1e-15);
    }
}

#[test]
fn every_machine_of_the_folder_can_be_reduced() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../machines");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let columns = jred([&"reduce", &path, &"--format", &"csv"])
                .ends(0)
                .columns();
            let inertia = columns.get("J_red [kg m^2]");
            assert_eq!(inertia.len(), 36);
            assert!(inertia.iter().all(|j| *j > 0.0), "{}", path.display());
            count += 1;
        }
    }
    assert!(count > 0);
}

#[test]
fn paths_with_blanks_and_other_letters() {
    let folder = Folder::new();
    let file = folder.file("Prägepresse  zwölf – № 3.toml", press_text());
    let report = folder.path("Bericht für Größe.html");
    let done = jred([&"size", &file, &"--report", &report]).ends(0);
    done_says(&done, &["Bericht für Größe.html"]);
    assert!(
        std::fs::read_to_string(report)
            .unwrap()
            .contains("Prägepresse")
    );
}

#[test]
fn top_lists_that_many() {
    let press = press_file();
    let ranks = |top: &str| {
        let out = jred([&"size", &press, &"--top", &top]).ends(0).out;
        let (_, table) = out.split_once(" rank ").unwrap();
        let (table, _) = table.split_once("ranked:").unwrap();
        table.lines().count() - 2
    };
    assert_eq!(ranks("0"), 0);
    assert_eq!(ranks("1"), 1);
    assert_eq!(ranks("7"), 7);
    let fit = jred([&"size", &press, &"--format", &"json"]).json();
    let fit = fit["fit"].as_array().unwrap().len();
    assert_eq!(ranks("1000000"), fit);
}

#[test]
fn machines_at_their_limits() {
    let folder = Folder::new();
    let zero = edited_press("duration = \"0.4 s\"", "duration = \"0 s\"");
    jred([&"size", &folder.file("a.toml", zero)])
        .ends(2)
        .says(&["duration"]);
    let zero = edited(&press_text(), "duration = \"2 s\"", "duration = \"0 s\"");
    jred([&"simulate", &folder.file("b.toml", zero)])
        .ends(2)
        .says(&["duration"]);
    // A train whose output carries nothing is a machine nevertheless.
    let light = r#"
gravity = ["0 m/s^2", "0 m/s^2"]
[mechanism]
type = "gear-train"
stage = [{ driver = { teeth = 20, inertia = "2 kg cm^2" }, driven = { teeth = 60, inertia = "0 kg m^2" } }]
[motion]
type = "constant-speed"
speed = "60 rpm"
"#;
    let file = folder.file("light.toml", light);
    let columns = jred([&"reduce", &file, &"--format", &"csv"])
        .ends(0)
        .columns();
    for inertia in columns.get("J_red [kg m^2]") {
        assert!((inertia / 2e-4 - 1.0).abs() < 1e-15);
    }
    // Constant speed and no load: no torque at all is asked for.
    let answer = jred([&"size", &file, &"--format", &"json"]).ends(0).json();
    assert_eq!(answer["input torque [N m]"]["rms"], 0.0);
    // A train without any inertia cannot be.
    let nothing = edited(light, "\"2 kg cm^2\"", "\"0 kg m^2\"");
    jred([&"reduce", &folder.file("nothing.toml", nothing)])
        .ends(2)
        .says(&["inertia"]);
}
