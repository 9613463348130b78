//! `jred identify`: causes in the options, and torques in other units.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::fs;

use super::{COUNTED, example, of_text};
use crate::support::shipped;

/// An answer to a log of this text, with single spaces.
fn words(text: &str, options: &str) -> (i32, String) {
    let folder = tempfile::tempdir().unwrap();
    let run = of_text(folder.path(), text, options);
    let words: Vec<&str> = run.out.split_whitespace().collect();
    (run.code, words.join(" "))
}

#[test]
fn torques_in_per_mille_of_the_rated_torque_are_those_in_newton_metres() {
    let (_, expected) = words(&example(|phi, torque| [phi, torque]), COUNTED);
    let options = format!("{COUNTED} --rated-torque 2.4Nm");
    for (unit, size) in [("per mille", 1e-3), ("%", 1e-2), ("0.1%", 1e-3)] {
        let shares = example(|phi, torque| [phi, torque / 2.4 / size]);
        let shares = shares.replacen("torque [N m]", &format!("torque [{unit}]"), 1);
        assert_eq!(words(&shares, &options).1, expected);
    }
}

#[test]
fn a_cause_in_the_options_is_named() {
    let (code, out) = words(
        &example(|phi, torque| [phi, torque]),
        "--counts-per-turn 8192 --cogging 36",
    );
    assert!(
        code == 1 && out.contains("give --counts-per-turn 4096") && !out.contains("another unit"),
        "{out}"
    );
    let cogging = example(|counts, torque| {
        let phi = counts * TAU / 4096.0;
        [counts, torque + 0.5 * (36.0 * phi).cos()]
    });
    let (code, out) = words(&cogging, "--counts-per-turn 4096");
    assert!(
        code == 0 && out.contains("run again with --cogging 36"),
        "{out}"
    );
    assert!(!words(&cogging, COUNTED).1.contains("not asked for"));
}

/// The motion of the example log, with which a rotor of 0.06 kg·m² is added to its torque.
#[test]
fn a_rotor_that_was_not_taken_out_is_named() {
    const WAVES: [[f64; 3]; 4] = [
        [0.37, 0.35, 0.3],
        [0.83, 0.25, 1.1],
        [1.93, 0.22, 2.0],
        [3.17, 0.18, 0.7],
    ];
    let text = fs::read_to_string(shipped("four-bar-log.csv")).unwrap();
    let mut heavier = "time [s],position [counts],torque [N m]\n".to_owned();
    for line in text.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let alpha = WAVES.iter().map(|[hertz, share, phase]| {
            let o = TAU * hertz;
            -PI * share * o * (o * (cells[0] - 1e-3) + phase).sin()
        });
        let torque = cells[2] + 0.06 * alpha.sum::<f64>();
        writeln!(heavier, "{},{},{torque}", cells[0], cells[1]).unwrap();
    }
    let (_, out) = words(&heavier, COUNTED);
    let more = out
        .split("J has a constant of ")
        .nth(1)
        .and_then(|rest| rest.split(' ').next());
    let more: f64 = more.unwrap_or_else(|| panic!("{out}")).parse().unwrap();
    // The rocker is heavier than designed as well: 0.001 in the mean.
    assert!((more - 0.06).abs() < 0.003, "{more}");
    assert!(
        out.contains("more than the design")
            && out.contains("--rotor-inertia")
            && !out.contains("another unit"),
        "{out}"
    );
}
