//! `jred identify`: logs that are refused, and the way of a log to a firmware table.

mod causes;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::support::{Run, jred_of, shipped};

/// The command on a log of this text.
fn of_text(folder: &Path, text: &str, options: &str) -> Run {
    let log = folder.join("log.csv");
    fs::write(&log, text).unwrap();
    let line = format!("identify {{}} --machine {{}} {options}");
    jred_of(&line, [&log, &shipped("four-bar.toml")])
}

/// Ten seconds of a motion, with one row changed.
fn rows(row: usize, change: impl Fn(f64) -> String, omega: impl Fn(f64) -> f64) -> String {
    let mut text = "time [s],position [rad],torque [N m]\n".to_owned();
    let mut phi = 0.0;
    for k in 0..5000 {
        let t = f64::from(k) * 0.002;
        phi += 0.002 * omega(t);
        let time = if k as usize + 1 == row {
            change(t)
        } else {
            t.to_string()
        };
        let torque = (3.0 * phi).sin();
        writeln!(text, "{time},{phi:.5},{torque:.4}").unwrap();
    }
    text
}

#[test]
fn a_log_that_cannot_be_used_says_why_and_what_to_do() {
    let even = |_: f64| 9.0;
    let as_it_is = |t: f64| t.to_string();
    let swing = |t: f64| 2.0 * (3.0 * t).cos();
    let cases = [
        (
            rows(0, as_it_is, even),
            "",
            [
                "at each angle the speed is always the same",
                "vary the speed from turn to turn",
            ],
        ),
        (
            rows(0, as_it_is, swing),
            "",
            ["are not visited", "let the drive link turn fully"],
        ),
        (
            rows(70, |_| "0.001".to_owned(), even),
            "",
            [
                "the time does not increase: row 70",
                "sort the rows by time",
            ],
        ),
        (
            rows(70, |_| "NaN".to_owned(), even),
            "",
            ["row 70: \"NaN\" in the column", "or delete the row"],
        ),
        (
            rows(70, |_| String::new(), even),
            "",
            [
                "row 70: the column \"time [s]\" is empty",
                "or delete the row",
            ],
        ),
    ];
    refused(&cases);
}

#[test]
fn torques_that_cannot_be_used_say_why() {
    let four_bar = "% Time s, Goal Current mA, Present Current mA, Present Voltage V, Present Position rad, Present Velocity rad/s\n0,1,2,3,4,5\n0.001,1,2,3,4,5\n";
    let cases = [
        (
            "time [s],position [rad],torque [N m]\n0,0,2.5\n0.001,0.1,2.5\n0.002,0.2,2.5\n0.003,0.3,2.5\n".to_owned(),
            "",
            [
                "the torque is 2.5 N m in every row",
                "log the torque or the current that acts",
            ],
        ),
        (
            "time [s],position [rad],torque [per mille]\n0,0,1\n0.001,0.1,1\n".to_owned(),
            "",
            [
                "is a share of the rated torque",
                "give the rated torque of the drive",
            ],
        ),
        (
            "time [s],position [rad],torque [N m]\n0,0,1\n0.001,0.1,1\n".to_owned(),
            "--rated-torque 2.4Nm",
            [
                "--rated-torque is given, but the log has no torque in per mille or % of it",
                "leave out --rated-torque",
            ],
        ),
        (
            example_every(12),
            "--counts-per-turn 4096",
            [
                "has too few samples",
                "at least 500 samples a second",
            ],
        ),
        (
            example(|phi, torque| [phi, torque.clamp(-10.0, 1.0)]),
            "--counts-per-turn 4096",
            [
                "samples at the torque limit 1 N m are left out",
                "raise the torque limit",
            ],
        ),
        (
            "time [s],position [rad],torque [N m]\n0,0,1\n0.001,0.1,1\n".to_owned(),
            "",
            ["is too short", "record 30 s"],
        ),
        (
            four_bar.to_owned(),
            "",
            [
                "has a current, and its torque is not given",
                "--torque-constant",
            ],
        ),
        (
            four_bar.to_owned(),
            "--torque-constant 1.8Nm/A",
            ["is too short: 2", "record 30 s"],
        ),
        (
            "time [s],position [counts],torque [N m]\n0,0,1\n0.001,1,1\n".to_owned(),
            "",
            ["is in counts", "--counts-per-turn"],
        ),
    ];
    refused(&cases);
}

/// Each log, with these options, is refused with these words.
fn refused(cases: &[(String, &str, [&str; 2])]) {
    let folder = tempfile::tempdir().unwrap();
    for (text, options, expected) in cases {
        let run = of_text(folder.path(), text, options);
        assert_eq!(run.code, 2, "{}", run.err);
        // Lines are wrapped.
        let words: Vec<&str> = run.err.split_whitespace().collect();
        let shown = words.join(" ").replace("│ ", "");
        for expected in expected {
            assert!(shown.contains(expected), "no {expected:?} in {}", run.err);
        }
    }
}

#[test]
fn from_the_example_log_to_a_firmware_table() {
    let folder = tempfile::tempdir().unwrap();
    let options = "--counts-per-turn 4096 --cogging 36";
    let line = format!("identify {{}} --machine {{}} {options}");
    let files: [&dyn AsRef<std::ffi::OsStr>; 2] =
        [&shipped("four-bar-log.csv"), &shipped("four-bar.toml")];
    let run = jred_of(&line, files);
    assert_eq!(run.code, 0, "{}", run.err);
    for words in ["no cogging above the order 24: add (", "·cos 36φ + ("] {
        assert!(run.out.contains(words), "{}", run.out);
    }
    let answer = jred_of(&format!("{line} --format json"), files).json();
    // The rocker has 3.5 kg instead of 3.2 kg; the largest difference of J is that mass on the path of its centre.
    let deviation = answer["deviation"].as_f64().unwrap();
    assert!((0.03..0.09).contains(&deviation), "{deviation}");
    let curves = jred_of(&format!("{line} --format csv"), files);
    fs::write(folder.path().join("identified.csv"), curves.out).unwrap();
    let machine = folder.path().join("identified.toml");
    let text = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"reduced-curves\"\nfile = \"identified.csv\"\nrange = \"turn\"\n";
    fs::write(&machine, text).unwrap();
    let exported = jred_of(
        "export {} --torque-error 0.05Nm --omega 120rpm --alpha 30rad/s^2 --format rust",
        [&machine],
    );
    assert_eq!(exported.code, 0, "{}", exported.err);
    let page = folder.path().join("page.html");
    let run = jred_of(
        &format!("{line} --report {{}}"),
        [files[0], files[1], &page],
    );
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(
        fs::read_to_string(&page)
            .unwrap()
            .contains("Designed and identified curves")
    );
}

/// The example log with its columns changed.
fn example(change: impl Fn(f64, f64) -> [f64; 2]) -> String {
    let text = fs::read_to_string(shipped("four-bar-log.csv")).unwrap();
    let mut changed = "time [s],position [counts],torque [N m]\n".to_owned();
    for line in text.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let [position, torque] = change(cells[1], cells[2]);
        writeln!(changed, "{},{position},{torque}", cells[0]).unwrap();
    }
    changed
}

/// The example log with every so-manieth row.
fn example_every(rows: usize) -> String {
    let text = fs::read_to_string(shipped("four-bar-log.csv")).unwrap();
    let mut lines = text.lines();
    let header = lines.next().unwrap();
    let kept = lines.step_by(rows);
    [header]
        .into_iter()
        .chain(kept)
        .collect::<Vec<_>>()
        .join("\n")
}

const COUNTED: &str = "--counts-per-turn 4096 --cogging 36";

#[test]
fn reversed_columns_and_another_zero_are_named_with_their_option() {
    let folder = tempfile::tempdir().unwrap();
    let run = |text: &str, options: &str| {
        let run = of_text(folder.path(), text, &format!("{COUNTED} {options}"));
        (
            run.code,
            run.out.split_whitespace().collect::<Vec<_>>().join(" "),
        )
    };
    let back = example(|phi, torque| [-phi, torque]);
    let (code, out) = run(&back, "");
    assert_eq!(code, 1);
    assert!(
        out.contains("the position has the wrong sign") && out.contains("with --reverse-position"),
        "{out}"
    );
    let (code, out) = run(&back, "--reverse-torque");
    assert_eq!(code, 1);
    assert!(
        out.contains("without --reverse-torque and with --reverse-position"),
        "{out}"
    );
    let right = run(&back, "--reverse-position");
    assert_eq!(right.0, 0, "{}", right.1);
    let negative = example(|phi, torque| [phi, -torque]);
    let (code, out) = run(&negative, "");
    assert!(
        code == 1 && out.contains("the torque has the wrong sign"),
        "{out}"
    );
    // 512 counts are 45 degrees.
    let other = example(|phi, torque| [phi + 512.0, torque]);
    let (code, out) = run(&other, "");
    let shown = out
        .split("--zero \"")
        .nth(1)
        .and_then(|rest| rest.split(' ').next());
    let zero: f64 = shown.unwrap_or_else(|| panic!("{out}")).parse().unwrap();
    assert!(code == 1 && (zero - 45.0).abs() < 1.0, "{zero}");
    assert_eq!(run(&other, "--zero 45deg").0, 0);
    let mirrored = example(|phi, torque| [512.0 - phi, torque]);
    assert_eq!(run(&mirrored, "--reverse-position --zero 45deg").1, right.1);
    let two = folder.path().join("two.csv");
    fs::write(&two, &other).unwrap();
    let line = format!("identify {{}} {{}} --machine {{}} {COUNTED}");
    let both = jred_of(
        &line,
        [
            &shipped("four-bar-log.csv"),
            &two,
            &shipped("four-bar.toml"),
        ],
    );
    assert!(
        both.code == 2 && both.err.contains("different zeros"),
        "{}",
        both.err
    );
}

#[test]
fn negative_friction_of_one_direction_becomes_a_load_and_is_said() {
    let folder = tempfile::tempdir().unwrap();
    // A mean load of −2 N·m: c of the log is 0.4 − 2.
    let text = example(|phi, torque| [phi, torque - 2.0]);
    let run = of_text(folder.path(), &text, COUNTED);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(
        run.out.contains("Coulomb friction is negative"),
        "{}",
        run.out
    );
    let csv = of_text(folder.path(), &text, &format!("{COUNTED} --format csv"));
    let row = csv.out.lines().nth(1).unwrap();
    let cells: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap()).collect();
    assert!((cells[2] - 1.6).abs() < 0.15 && cells[5] == 0.0, "{row}");
    // The load of weight has no mean: a file of reduced curves is refused otherwise.
    let potential = csv.out.lines().skip(1).map(|row| {
        let cell = row.split(',').nth(3).unwrap();
        cell.parse::<f64>().unwrap()
    });
    assert!(potential.sum::<f64>().abs() / 360.0 < 1e-6);
}

#[test]
fn options_out_of_range_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let text = example(|phi, torque| [phi, torque]);
    for (options, expected) in [
        ("--delay 1s", "longer than 50 ms"),
        ("--cogging 36,48,36", "the order 36 twice"),
    ] {
        let run = of_text(
            folder.path(),
            &text,
            &format!("--counts-per-turn 4096 {options}"),
        );
        assert!(run.code == 2 && run.err.contains(expected), "{}", run.err);
    }
}
