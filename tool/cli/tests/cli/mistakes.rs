//! Messages about mistakes.

use super::{export, run};
use crate::support::{Folder, jred, phrases, press_file, press_text, rows, typed};

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
    // Larger than the reader allows.
    let large = folder.file("large.toml", "# filler\n".repeat(1_200_000));
    jred([&"reduce", &large])
        .ends(2)
        .says(&["it has", "the maximum is"]);
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
        .says(&["has no [motion]", "add a [motion]"]);
    jred([&"reduce", &no_motion, &"--over", &"time"])
        .ends(2)
        .says(&["has no [motion]", "add a [motion]"]);
    jred([&"simulate", &no_simulation])
        .ends(2)
        .says(&["has no [simulation]", "add a [simulation]"]);
    let out = folder.path("out");
    export(&no_motion, &["--torque-error", "1 N m"], &out)
        .ends(2)
        .says(&["has no [motion]", "give --omega"]);
    export(
        &no_motion,
        &typed("--torque-error '1 N m' --omega '90 rpm' --alpha '50 rad/s^2'"),
        &out,
    )
    .ends(0);
    jred([&"reduce", &no_motion]).ends(0);
    jred([&"size", &no_simulation]).ends(0);
}

#[test]
fn wrong_command_lines() {
    let press = format!("'{}'", press_file().display());
    let cases = "
        => jred new slider-crank | jred --help
        weigh PRESS => unrecognized subcommand | Usage
        size => <FILE>
        size PRESS --fromat csv => --fromat | --format
        size PRESS --steps 15 => 15 | 16
        size PRESS --steps 1e3 => invalid
        size PRESS --top -1 => -1
        reduce PRESS --positions 1 => 1 | 2
        reduce PRESS --positions 1000001 => 1000000
        reduce PRESS --format xml => xml | table | csv | json
        reduce PRESS --over space => space | angle | time
        export PRESS --out x => --torque-error | --max-bytes
        export PRESS --torque-error '1 N m' --type q31 => q31 | f32 | i32 | i16
        export PRESS --torque-error '1 N m' --layout linear => linear | auto | spline16 | quadratic
        export PRESS --torque-error '1 N m' --reciprocal maybe => maybe | yes | no
        export PRESS --max-bytes -1 => -1
    ";
    for [arguments, words] in rows(cases) {
        let arguments = arguments.replace("PRESS", &press);
        let done = run(&typed(&arguments)).ends(2);
        done.says(&phrases(&words));
        assert!(done.out.is_empty(), "{}", done.out);
    }
}

#[test]
fn wrong_quantities_on_the_command_line() {
    let folder = Folder::new();
    let out = folder.path("out");
    let ok = ["--torque-error", "1 N m", "--omega", "90 rpm"];
    let cases = "
        --torque-error => 0.5 => no unit | N m
        --torque-error => -1 N m => greater than zero
        --torque-error => 0 N m => greater than zero
        --torque-error => nan N m => --torque-error
        --torque-error => NaN => --torque-error
        --torque-error => inf N m => --torque-error
        --torque-error => 1e999 N m => --torque-error
        --torque-error => 1 N => N m
        --torque-error => 1 kg m^2 => N m
        --torque-error => => --torque-error
        --omega => 90 => no unit | rpm
        --omega => -90 rpm => greater than zero
        --omega => 90 Hz => rpm
        --omega => 90 N m => rpm
        --alpha => fast => --alpha | fast
        --max-cells => 3 => 4
        --max-cells => 65536 => 65535
        --max-bytes => many => many | --max-bytes
    ";
    for [option, value, words] in rows(cases) {
        let mut more: Vec<String> = ok.map(String::from).into();
        if let Some(at) = more.iter().position(|o| *o == option) {
            more.drain(at..=at + 1);
        }
        more.push(format!("{option}={value}"));
        let more: Vec<&str> = more.iter().map(String::as_str).collect();
        let done = export(&press_file(), &more, &out).ends(2);
        done.says(&phrases(&words));
        assert!(!out.exists());
    }
    // A negative number is a value, not an unknown option.
    for number in ["-1", "0x123456789", "4294967296", "press"] {
        let more = [&ok[..], &["--machine-id", number]].concat();
        let done = export(&press_file(), &more, &out).ends(2);
        done.says(&["--machine-id", "a whole number from 1 to 4294967295"]);
    }
}

/// An invalid acceleration is refused, not replaced.
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
        &["simulate", "--report"],
        &["export", "--torque-error", "1 N m", "--out"],
    ] {
        let mut arguments = command.to_vec();
        let press = press_file();
        arguments.extend([nowhere.to_str().unwrap(), press.to_str().unwrap()]);
        let done = run(&arguments).ends(2);
        done.says(&["cannot write", "out.html", "help: "]);
    }
}

/// A mistake on the command line never overwrites the machine file.
#[test]
fn the_machine_file_is_never_overwritten() {
    let folder = Folder::new();
    let mut lost = Vec::new();
    for options in [
        &["size", "--report"] as &[&str],
        &["simulate", "--report"],
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

/// Commands whose curves have no acceleration refuse friction by a coefficient; the others go on.
#[test]
fn friction_by_a_coefficient_is_refused_by_name() {
    let folder = Folder::new();
    let friction =
        "[[friction]]\njoint = \"guide\"\ncoefficient = 0.1\nguide_length = \"150 mm\"\n";
    let text = press_text();
    let (before, after) = text.split_once("[motion]").unwrap();
    let press = folder.file("press.toml", format!("{before}{friction}\n[motion]{after}"));
    for (command, more) in [
        ("export", "--torque-error '1 N m'"),
        ("fastest", ""),
        ("gentlest", ""),
        ("balance", "--counterweight 'crank, 20 kg, 250 mm'"),
        ("size", "--motion best"),
    ] {
        let mut arguments = vec![command, press.to_str().unwrap()];
        arguments.extend(typed(more));
        run(&arguments).ends(2).says(&[
            "friction in joint \"guide\" depends on the acceleration",
            "opposing_force",
        ]);
    }
    for command in ["check", "reduce", "size", "simulate"] {
        jred([&command, &press]).ends(0);
    }
}
