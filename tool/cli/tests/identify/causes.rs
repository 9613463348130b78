//! `jred identify`: causes in the options, and torques in other units.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::fs;

use super::{COUNTED, example, of_text};
use crate::support::{jred_of, shipped};

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

/// A log of the drive link that is taken for one of the motor; and the log of one direction, whose V′ has friction in it, of the machine of the design.
#[test]
fn the_other_shaft_is_named_and_friction_is_no_deviation() {
    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string(shipped("press.toml")).unwrap();
    let file = jred_analysis::checked::read(&shipped("press.toml")).unwrap();
    let [log, machine] = ["log.csv", "press.toml"].map(|name| folder.path().join(name));
    fs::write(&machine, text).unwrap();
    let mut rows = "time [s],position [rad],torque [N m]\n".to_owned();
    for k in 0..20_000 {
        let t = f64::from(k) * 1e-3;
        let o = [2.8, 7.1, 13.2, 18.0];
        let a = [2.0, 1.2, 0.9, 0.6];
        let waves = || o.iter().zip(a);
        let phi = 9.4 * t - waves().map(|(o, a)| a / o * (o * t).cos()).sum::<f64>();
        let omega = 9.4 + waves().map(|(o, a)| a * (o * t).sin()).sum::<f64>();
        let alpha = waves().map(|(o, a)| a * o * (o * t).cos()).sum::<f64>();
        let at = file.bare_reduction(phi).unwrap();
        let torque = at.inertia * alpha
            + 0.5 * at.inertia_slope * omega * omega
            + at.potential_slope
            + at.viscous * omega
            + at.coulomb;
        writeln!(rows, "{t:.3},{phi:.6},{torque:.4}").unwrap();
    }
    fs::write(&log, rows).unwrap();
    let run = |options: &str| {
        let line = format!("identify {{}} --machine {{}} --delay 0ms {options}");
        jred_of(&line, [&log, &machine])
    };
    let run_of_link = run("--shaft link");
    assert_eq!(run_of_link.code, 0, "{}", run_of_link.out);
    let words = run_of_link
        .out
        .split("V' against the design")
        .nth(1)
        .unwrap();
    let off = words
        .split('%')
        .next()
        .unwrap()
        .split_whitespace()
        .last()
        .unwrap();
    assert!(off.parse::<f64>().unwrap() < 4.0, "{off}");
    let of_motor = run("");
    assert!(
        of_motor.out.contains("run again with --shaft link"),
        "{}",
        of_motor.out
    );
    let twice = jred_of("identify {} {} --machine {}", [&log, &log, &machine]);
    assert!(twice.err.contains("is given twice"), "{}", twice.err);
}
