//! Motions from CSV files.

use std::f64::consts::TAU;
use std::fmt::Write;

use crate::reader;
use crate::reading::belt_drive;

use super::{data, parse, rendered};

/// A belt drive that is the same after whole turns only.
fn machine(file: &str, more: &str) -> String {
    belt_drive(&format!(
        "[[load]]\non = \"shaft-1\"\nopposing_moment = \"1 N m\"\nbetween = [\"20 deg\", \"60 deg\"]\nramp = \"5 deg\"\n\
         [motion]\ntype = \"profile\"\nfile = \"{file}\"\n{more}"
    ))
}

/// Writes a CSV file beside a machine file and reads the machine.
fn report(csv: &str, more: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("profile.csv"), csv).unwrap();
    match reader::parse("machine.toml", &machine("profile.csv", more), folder.path()) {
        Ok(file) => format!("accepted, {} s", file.motion.unwrap().duration()),
        Err(report) => {
            let text = rendered(&report);
            if std::env::var_os("SHOW_REPORTS").is_some() {
                println!("{text}");
            }
            text
        }
    }
}

/// Eight equal steps of one turn in 0.8 s.
fn turn(header: &str, row: impl Fn(usize) -> Option<String>) -> String {
    let mut csv = format!("{header}\n");
    for k in 0..=8 {
        let line = row(k).unwrap_or_else(|| format!("{:.1},{}", k as f64 * 0.1, k * 45));
        writeln!(csv, "{line}").unwrap();
    }
    csv
}

#[test]
fn a_recorded_turn_is_read() {
    let file = parse(&machine("turn.csv", "")).unwrap();
    let motion = file.motion.unwrap();
    assert!(motion.cyclic);
    assert!((motion.duration() - 2.0).abs() < 1e-12);
    // phi = 2π·z + 0.5·sin(2π·z), in the file in degrees with six digits
    for k in 0..40 {
        let z = f64::from(k) / 40.0;
        let state = motion.at(2.0 * z);
        assert!((state.phi - (TAU * z + 0.5 * (TAU * z).sin())).abs() < 1e-6);
        assert!((state.omega - TAU * (0.5 + 0.25 * (TAU * z).cos())).abs() < 1e-3);
    }
    assert!(data().join("turn.csv").exists());
}

#[test]
fn units_order_and_byte_order_mark_of_the_columns_are_free() {
    assert_eq!(
        report(&turn("t [s],phi [deg]", |_| None), ""),
        "accepted, 0.8 s"
    );
    let swapped = turn("\u{feff}phi [rad], t [ms]", |k| {
        Some(format!("{},{}", k as f64 * TAU / 8.0, k * 100))
    });
    assert_eq!(report(&swapped, ""), "accepted, 0.8 s");
    let half = turn("t [s],phi [deg]", |k| {
        Some(format!("{:.1},{}", k as f64 * 0.1, k * 10))
    });
    assert_eq!(report(&half, "cyclic = false"), "accepted, 0.8 s");
}

#[test]
fn wrong_profiles_are_shown_in_the_csv_file() {
    let at =
        |wrong: usize, line: &'static str| move |k: usize| (k == wrong).then(|| line.to_owned());
    let header = "t [s],phi [deg]";
    let cases: [(String, &str, &[&str]); 14] = [
        (
            turn("t [s],phi [deg]", |k| {
                Some(format!("{:.1},{}", k as f64 * 0.1, k * 40))
            }),
            "",
            &[
                "40 deg short of a whole number of turns",
                "profile.csv:2",
                "cyclic = false",
            ],
        ),
        (
            turn(header, at(8, "3.41,360")),
            "",
            &["a gap", "row 9", "2.71 s", "0.1 s", "profile.csv:10"],
        ),
        (
            turn(header, at(4, "0.3,180")),
            "",
            &["does not increase", "row 5", "profile.csv:6"],
        ),
        (
            turn(header, at(4, "0.4,abc")),
            "",
            &["row 5: \"abc\"", "phi [deg]", "decimal point"],
        ),
        (
            turn(header, at(4, "0.4,nan")),
            "",
            &["\"nan\"", "not a finite number"],
        ),
        (
            turn(header, at(4, "0.4,")),
            "",
            &[
                "row 5: the column \"phi [deg]\" is empty",
                "leave no cell empty",
            ],
        ),
        (
            turn(header, at(4, "0,4,180")),
            "",
            &["row 5 has 3 values", "decimals have a point"],
        ),
        (
            turn("t,phi [deg]", |_| None),
            "",
            &["the column \"t\" has no unit", "t [s]", "profile.csv:1"],
        ),
        (
            turn("t [s];phi [deg]", |_| None),
            "",
            &["row 1 has 1 value,", "2 columns", "as the header does"],
        ),
        (
            turn("t [s],phi [dge]", |_| None),
            "",
            &["unknown unit \"dge\"", "did you mean \"deg\""],
        ),
        (
            turn("t [s],t [ms]", |_| None),
            "",
            &["duplicate column \"t\""],
        ),
        (
            format!("{header}\n0,0\n1,90\n2,180\n3,360\n"),
            "",
            &["has 4 rows", "at least 5"],
        ),
        (
            String::new(),
            "",
            &["is an empty file", "column names with units"],
        ),
        (
            turn(header, |_| None),
            "cyclic = \"yes\"",
            &[
                "`cyclic` in [motion] must be true or false",
                "without quotes",
            ],
        ),
    ];
    for (csv, more, words) in cases {
        let report = report(&csv, more);
        for word in words {
            assert!(report.contains(word), "{word:?} is not in\n{report}");
        }
    }
}

#[test]
fn a_profile_that_cannot_be_read_is_shown_in_the_machine_file() {
    for (file, words) in [
        ("none.csv", ["no such file", "looked for"]),
        (".", ["is a folder", "name the file"]),
    ] {
        let report = rendered(&parse(&machine(file, "")).unwrap_err());
        for word in words
            .iter()
            .chain(&["machine.toml:13", "`file` in [motion]"])
        {
            assert!(report.contains(word), "{word:?} is not in\n{report}");
        }
    }
}

/// Position, speed and acceleration of a parabola up and a parabola down: rows at the corners are enough, and the jumps of the acceleration
/// stay.
#[test]
fn a_profile_with_states_keeps_its_corners() {
    let rows = |more: &str| {
        format!(
            "t [s],phi [deg],n [deg/s],alpha [deg/s^2]\n0,0,0,720\n0.5,90,360,720\n0.5,90,360,-720\n1,180,0,-720\n1,180,0,0\n{more}"
        )
    };
    let rest = rows("1.5,180,0,0\n");
    assert_eq!(report(&rest, "cyclic = false"), "accepted, 1.5 s");
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("profile.csv"), &rest).unwrap();
    let text = machine("profile.csv", "cyclic = false");
    let file = reader::parse("machine.toml", &text, folder.path()).unwrap();
    let motion = file.motion.unwrap();
    for k in 0..=300 {
        let t = f64::from(k) * 0.005;
        let expected = match t {
            t if t < 0.5 => [360.0 * t * t, 720.0 * t, 720.0],
            t if t < 1.0 => [180.0 - 360.0 * (1.0 - t).powi(2), 720.0 * (1.0 - t), -720.0],
            _ => [180.0, 0.0, 0.0],
        };
        let found = motion.at(t);
        let found = [found.phi, found.omega, found.alpha].map(f64::to_degrees);
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-10, "{t}: {found} {expected}");
        }
    }
    assert_eq!(motion.stretches().len(), 3);
    let asked = [
        (
            rows("1.5,180,0,0\n"),
            "smoothing = \"4 Hz\"\ncyclic = false",
            "the file has positions and speeds",
        ),
        (
            rows("1,180,0,1\n"),
            "cyclic = false",
            "t = 1 s does not increase",
        ),
        (
            rows("0.9,180,0,0\n"),
            "cyclic = false",
            "t = 0.9 s does not increase",
        ),
        (
            rows("1.5,250,0,0\n"),
            "cyclic = false",
            "row 6: phi = 250 deg does not follow from the speeds",
        ),
        (
            rows("1.5,180,90,0\n"),
            "cyclic = false",
            "does not follow from the",
        ),
        (
            rows("1.5,180,0,0\n"),
            "",
            "180 deg short of a whole number of turns",
        ),
    ];
    for (rows, more, words) in asked {
        let said = report(&rows, more);
        assert!(said.contains(words), "{said}");
    }
    // A speed in the wrong unit.
    let wrong = rest.replace("[deg/s]", "[rpm]");
    let said = report(&wrong, "cyclic = false");
    assert!(said.contains("does not follow from"), "{said}");
    let two = rest.replace("alpha [deg/s^2]", "x");
    assert!(report(&two, "").contains("unknown column"));
}
