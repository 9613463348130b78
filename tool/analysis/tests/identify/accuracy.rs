//! The identified machine against the exact one.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use jred_analysis::identify::{Identified, identify, samples};

use super::plant::{CASES, Encoder, Plant, STEP, errors, four_bar, log, press};

#[test]
fn inertia_within_one_percent_and_torque_within_two() {
    for plant in [press(), four_bar()] {
        for (encoder, closed) in CASES {
            let log = log(&plant, encoder, closed, 1, 30.0);
            let found = identify(&log.samples, &log.options).unwrap();
            let [inertia, inside, torque] = errors(&plant, &found);
            println!(
                "{inertia:.4} {inside:.3} {torque:.4} d {:.3} ± {:.3} ms, K {} {:?}",
                found.delay.value * 1e3,
                found.delay.band * 1e3,
                found.harmonics,
                found.faults
            );
            assert!(inertia < 0.01, "J: {inertia}");
            assert!(torque < 0.02, "torque: {torque}");
            assert!(inside > 0.6, "inside the band: {inside}");
            // In closed loop the torque is held over a sample, on average half a sample late.
            let delay = if closed { 0.5e-3 } else { 1e-3 };
            assert!((found.delay.value - delay).abs() < 0.3e-3);
            assert_eq!(found.faults, [], "a clean log");
        }
    }
}

/// One case, with `JRED_EVERY_CASE=1` all eight: `cargo test --release -p jred-analysis --test tests -- --ignored band_holds --nocapture`.
#[test]
#[ignore = "200 logs of half a minute"]
fn the_band_holds_the_truth_in_95_percent_of_200_logs() {
    for (name, plant) in [("press", press()), ("four-bar", four_bar())] {
        for (encoder, closed) in CASES {
            let (mut covered, mut inertias, mut torques, mut alarms) =
                (0.0, Vec::new(), Vec::new(), 0);
            for seed in 0..200 {
                let log = log(&plant, encoder, closed, seed, 30.0);
                let found = identify(&log.samples, &log.options).unwrap();
                let [inertia, inside, torque] = errors(&plant, &found);
                covered += inside / 200.0;
                inertias.push(inertia);
                torques.push(torque);
                alarms += usize::from(!found.faults.is_empty());
            }
            inertias.sort_by(f64::total_cmp);
            torques.sort_by(f64::total_cmp);
            println!(
                "{name} {} {}: J median {:.2} %, 95 % {:.2} %, worst {:.2} %; torque 95 % {:.2} %, worst {:.2} %; inside {covered:.3}; alarms {alarms}",
                encoder.counts(),
                if closed { "closed" } else { "open" },
                100.0 * inertias[100],
                100.0 * inertias[190],
                100.0 * inertias[199],
                100.0 * torques[190],
                100.0 * torques[199],
            );
            assert!((0.93..=0.97).contains(&covered));
            assert!(inertias[199] < 0.01 && torques[190] < 0.02);
            if std::env::var_os("JRED_EVERY_CASE").is_none() {
                return;
            }
        }
    }
}

/// First coefficients of the example log's J and V′, by an implementation of the method in Python.
const INERTIA: [f64; 5] = [
    0.034_324_410_561_380_03,
    0.009_811_914_094_402_062,
    -0.000_419_913_026_025_741_5,
    -0.010_725_443_082_931_219,
    -0.015_987_534_490_991_58,
];
const POTENTIAL: [f64; 2] = [0.540_088_516_510_337_7, 0.031_269_714_485_250_62];

/// The log of the documentation, of a machine whose rocker is heavier than designed: `machines/four-bar-log.csv`. `JRED_BLESS=1` writes it.
#[test]
fn the_example_log() {
    let text = crate::reading::text_of("four-bar.toml");
    let heavier = crate::support::edited(&text, "mass = \"3.2 kg\"", "mass = \"3.5 kg\"");
    let plant = Plant {
        file: crate::reading::parse(&heavier).unwrap(),
        ..four_bar()
    };
    let log = log(&plant, Encoder::Coarse, false, 5, 20.0);
    let mut text = "time [s],position [counts],torque [N m]\n".to_owned();
    let rows = log.samples.position.iter().zip(&log.samples.torque);
    for (k, (position, torque)) in rows.enumerate().step_by(2) {
        let counts = (position * Encoder::Coarse.counts() / TAU).round();
        writeln!(text, "{:.3},{counts},{torque:.3}", k as f64 * STEP).unwrap();
    }
    let path = crate::reading::machine_path("four-bar-log.csv");
    if std::env::var_os("JRED_BLESS").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    // The same but for the last digit of a sine on another computer.
    let stored = std::fs::read_to_string(&path).unwrap();
    assert_eq!(stored.lines().count(), text.lines().count());
    for (a, b) in stored.lines().zip(text.lines()).skip(1) {
        let [a, b] = [a, b].map(|line| {
            let cells = line.split(',').map(|cell| cell.parse::<f64>().unwrap());
            cells.collect::<Vec<_>>()
        });
        let off = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
        assert!((a[0] - b[0]).abs() < 1e-9 && off.skip(1).all(|off| off <= 1.0));
    }
    let columns = stored.lines().skip(1).map(|line| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        [
            cells[0],
            cells[1] * TAU / Encoder::Coarse.counts(),
            cells[2],
        ]
    });
    let columns: Vec<[f64; 3]> = columns.collect();
    let column = |k: usize| columns.iter().map(|row| row[k]).collect::<Vec<_>>();
    let (samples, repairs) = samples(&column(0), &column(1), &column(2)).unwrap();
    assert_eq!(repairs, []);
    let found = identify(&samples, &log.options).unwrap();
    let [inertia, _, torque] = errors(&plant, &found);
    assert!(inertia < 0.01 && torque < 0.02, "{inertia} {torque}");
    // The same log through an implementation of the method in Python (NumPy, SciPy), which shares no code with this one.
    let near = |found: f64, other: f64, size: f64| (found - other).abs() < 1e-6 * size;
    assert_eq!(found.harmonics, 12);
    for (own, other) in found.inertia.iter().zip(INERTIA) {
        assert!(
            near(own.value, other, INERTIA[0]),
            "{own:?} instead of {other}"
        );
    }
    for (own, other) in found.potential.iter().zip(POTENTIAL) {
        assert!(
            near(own.value, other, POTENTIAL[0]),
            "{own:?} instead of {other}"
        );
    }
    assert!(near(found.viscous.value, 0.020_011_697_494_697_5, 0.02));
    assert!(near(found.coulomb.value, 0.399_771_479_434_825_94, 0.4));
    assert!(near(found.delay.value, 1.014_620_880_642_739_2e-3, 1e-3));
    assert!(near(found.torque_noise, 0.021_822_808_231_586_933, 0.02));
    assert!(near(found.inertia[0].band, 4.379_023_907_084_563e-5, 4e-5));
}

#[test]
fn repeats_of_a_log_in_steps_of_a_current() {
    // The servo of DaRUS reads its current in steps of 2.69 mA.
    const CURRENT: f64 = 2.69e-3;
    const PER_CURRENT: f64 = 1.8;
    let plant = four_bar();
    let runs: Vec<Identified> = (0..3)
        .map(|seed| {
            let mut log = log(&plant, Encoder::Coarse, false, 50 + seed, 30.0);
            for torque in &mut log.samples.torque {
                *torque = (*torque / PER_CURRENT / CURRENT).round() * CURRENT * PER_CURRENT;
            }
            identify(&log.samples, &log.options).unwrap()
        })
        .collect();
    let most = runs[0].largest_inertia();
    for k in 0..360 {
        let all = runs.iter().map(|run| run.curves[k].inertia.value);
        let [least, largest] = all.fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(x), b.max(x)]);
        assert!(
            largest - least < 0.01 * most,
            "J at {k} deg differs between the runs"
        );
    }
}

/// A torque that is 0.4 s late ends before the last positions, and those rows do not count.
#[test]
fn a_torque_beyond_the_end_does_no_harm() {
    let plant = four_bar();
    let mut late = log(&plant, Encoder::Fine, false, 13, 30.0);
    late.samples.torque.rotate_right(399);
    late.samples.torque[..399].fill(0.0);
    late.options.delay = Some(0.4);
    let found = identify(&late.samples, &late.options).unwrap();
    assert_eq!(found.faults, []);
    let [inertia, _, torque] = errors(&plant, &found);
    assert!(inertia < 0.01 && torque < 0.02, "{inertia} {torque}");
}
