//! The command line: exit codes, formats, and messages about mistakes.
// Copied figures, counts and zeros are exact.
#![allow(clippy::float_cmp)]

mod forms;
mod mistakes;
mod outputs;
mod why;

use std::io::Read as _;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::support::{
    COMMANDS, Folder, Run, edited, edited_press, jred, jred_of, jred_with, press_file, press_text,
    typed,
};

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
        .env("JRED_PROGRESS", "never")
        .output()
        .unwrap();
    let run = Run {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    };
    assert!(!run.message().contains("panicked"), "{}", run.err);
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
        ("c", "i32"),
        ("image", "i32"),
        ("rust", "i16"),
        ("json", "f32"),
    ] {
        let out = folder.path("table");
        let line = format!("--torque-error '0.5 N m' --format {format} --type {number}");
        let more = typed(&line);
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
    let file = file.to_str().unwrap();
    let some = ["size", file, "--motor", "f*m*", "--gearbox", "npt*"];
    let size = |more: &[&str]| jred_with(&[&some[..], more].concat());
    let done = size(&[]).ends(1);
    done_says(
        &done,
        &[
            "None of",
            "satisfies every rule; this is the closest one. Violated:\n",
            "  peak torque ",
            "  no: it violates limits",
            "FAIL",
            "--refused",
        ],
    );
    let done = size(&["--refused"]).ends(1);
    done_says(&done, &["\nRefused\n", "peak torque", " limit "]);
    // The limits to relax, with figures.
    let done = size(&["--full"]).ends(1);
    done_says(
        &done,
        &[
            "Closest refused drives, and what would have to change, one quantity at a time",
            "a limit of ",
            "process loads 100 %  no value from 50 % to 100 % helps; at 50 %, the best",
        ],
    );
    for format in ["csv", "json"] {
        size(&["--format", format]).ends(1);
    }
    let answer = size(&["--all", "--format", "json"]).json();
    assert_eq!(answer["fit"].as_array().unwrap().len(), 0);
    let refused = answer["refused"].as_array().unwrap().len();
    assert_eq!(answer["counts"]["refused"], refused);
    assert_eq!(answer["counts"]["drives"], refused);
    // Every refused drive violates a rule.
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
        "no table meets a torque error of 0.5 N m: type f32, up to 32 cells",
        "cells reach",
        "increase the allowed error",
    ]);
    assert!(!out.exists(), "a file was written nevertheless");
}

#[test]
fn rules_of_the_file_change_the_verdict() {
    let folder = Folder::new();
    let strict = format!("{}\n[rules]\nspeed = \"1 %\"\n", press_text());
    let strict = folder.file("strict.toml", strict);
    let done = jred([&"size", &strict, &"--full"]).ends(1);
    done_says(&done, &["1 % of"]);
    let count = |rules: &str| {
        let text = format!("{}\n[rules]\n{rules}\n", press_text());
        let answer = jred([&"size", &folder.file("m.toml", text), &"--format", &"json"]);
        answer.json()["counts"]["fit"].as_u64().unwrap()
    };
    let default = count("rms_torque = \"80 %\"");
    assert!(count("rms_torque = \"60 %\"") < default);
    assert!(count("rms_torque = \"100 %\"\npeak_torque = \"100 %\"") > default);
    // The given limit is printed.
    let text = format!("{}\n[rules]\ninertia_ratio = 7\n", press_text());
    let answer = jred([&"size", &folder.file("m.toml", text), &"--format", &"json"]).json();
    assert_eq!(answer["rules"]["limits"]["inertia_ratio"]["fail"], 7.0);
    let checks = answer["fit"][0]["checks"].as_array().unwrap();
    let check = checks
        .iter()
        .find(|c| c["rule"] == "inertia ratio")
        .unwrap();
    assert_eq!(check["limit"], 7.0);
}

/// `jred … | head -1`: a reader that stops is not an error.
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
    for command in COMMANDS {
        done_says(&help, &[command]);
        let help = run(&[command, "--help"]).ends(0);
        done_says(&help, &["Usage: jred", "Exit codes: 0"]);
        if !["merge", "catalogue", "new", "completion", "man"].contains(&command) {
            done_says(&help, &["--format"]);
        }
    }
    done_says(&run(&["--version"]).ends(0), &["jred 0."]);
}

#[test]
fn the_former_name_of_gentlest_is_accepted_and_not_shown() {
    let press = press_file();
    let [new, old] = ["gentlest", "retime"].map(|name| jred([&name, &press]).ends(0).out);
    assert_eq!(new, old);
    assert!(!run(&["--help"]).ends(0).out.contains("retime"));
}

#[test]
fn every_machine_of_the_folder_can_be_reduced() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let reduce = jred([&"reduce", &path, &"--format", &"csv"]);
            let text = std::fs::read_to_string(&path).unwrap();
            // With a variator the crank's angle is not a function of the drive's: refused, with the reason.
            if text.contains("[variator]") {
                assert!(
                    reduce.ends(2).message().contains("variator"),
                    "{}",
                    path.display()
                );
                continue;
            }
            let columns = reduce.ends(0).columns();
            let sliding = columns.names.iter().any(|name| name == "m_red [kg]");
            let inertia = columns.get(if sliding {
                "m_red [kg]"
            } else {
                "J_red [kg m^2]"
            });
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
        let out = jred([&"size", &press, &"--all-gearboxes", &"--top", &top]);
        let out = out.ends(0).out;
        let (_, table) = out.split_once("\n rank ").unwrap();
        let (table, _) = table.split_once("\nranked:").unwrap();
        let rows = table.lines().skip(2);
        // Below the list are the first drives of other classes of certainty.
        let listed = rows.map(|row| {
            row.split_whitespace()
                .next()
                .unwrap()
                .parse::<usize>()
                .unwrap()
        });
        listed
            .enumerate()
            .filter(|(k, rank)| *rank == k + 1)
            .count()
    };
    assert_eq!(ranks("0"), 0);
    assert_eq!(ranks("1"), 1);
    assert_eq!(ranks("7"), 7);
    let fit = jred([&"size", &press, &"--format", &"json"]).json();
    let listed = fit["fit"].as_array().unwrap();
    assert_eq!(listed.len(), 10);
    // Each motor once, with the rank of its first drive among all.
    let motors: std::collections::BTreeSet<_> =
        listed.iter().map(|d| d["motor"].as_str()).collect();
    assert_eq!(motors.len(), 10);
    let all = jred_of(
        "size {} --all-gearboxes --top 1000000 --nearest 0 --format json",
        [&press],
    )
    .json();
    let all = all["fit"].as_array().unwrap();
    assert!(
        all.iter()
            .zip(1..)
            .all(|(drive, rank)| drive["rank"] == rank)
    );
    for line in listed {
        let first = all.iter().find(|drive| drive["motor"] == line["motor"]);
        assert_eq!(first, Some(line));
    }
    assert_eq!(fit["refused"].as_array().unwrap().len(), 3);
    assert_eq!(
        ranks("1000000"),
        fit["counts"]["fit"].as_u64().unwrap() as usize
    );
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
    // A train with an unloaded output is a valid machine.
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
    // Constant speed without load needs no torque.
    let answer = jred([&"size", &file, &"--format", &"json"]).ends(0).json();
    assert_eq!(answer["input torque [N m]"]["rms"], 0.0);
    // A train without inertia is refused.
    let nothing = edited(light, "\"2 kg cm^2\"", "\"0 kg m^2\"");
    jred([&"reduce", &folder.file("nothing.toml", nothing)])
        .ends(2)
        .says(&["inertia"]);
}

/// At a speed above the cam's lift-off the figures are given with position and speed.
#[test]
fn a_speed_above_lift_off_is_not_passed_over() {
    let cam = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines/cam-translating.toml");
    let at = |speed: &str| jred([&"reduce", &cam, &"--reactions", &"--speed", &speed]).ends(0);
    let fast = at("600 rpm");
    for words in [
        "warning: the follower leaves the cam",
        "600 rpm",
        "by other means",
    ] {
        assert!(fast.message().contains(words), "{}", fast.message());
    }
    assert_eq!(at("300 rpm").message(), "");
    let folder = Folder::new();
    let out = folder.path("cam.jred");
    export(
        &cam,
        &typed("--torque-error '5 N m' --omega '600 rpm' --alpha '100 rad/s^2'"),
        &out,
    )
    .ends(0)
    .says(&["the follower leaves the cam"]);
}
