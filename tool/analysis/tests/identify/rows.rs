//! Rows of a log become samples at equal steps.

use std::f64::consts::TAU;

use jred_analysis::identify::{RecordFault, Repair, identify, samples};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use super::plant::{Encoder, errors, log, press};

#[test]
fn rows_become_samples() {
    let time: Vec<f64> = (0..1000).map(|k| f64::from(k) * 1e-3).collect();
    let position: Vec<f64> = time.iter().map(|t| (9.0 * t).rem_euclid(TAU)).collect();
    let torque: Vec<f64> = time.iter().map(|t| (3.0 * t).sin()).collect();
    let (whole, repairs) = samples(&time, &position, &torque).unwrap();
    assert_eq!(repairs, []);
    assert!((whole.step - 1e-3).abs() < 1e-12);
    // An encoder of one turn is unwrapped.
    assert!((whole.position[999] - 9.0 * 0.999).abs() < 1e-9);
    let without = |rows: std::ops::Range<usize>| {
        let cut = |of: &[f64]| [&of[..rows.start], &of[rows.end..]].concat();
        samples(&cut(&time), &cut(&position), &cut(&torque)).unwrap()
    };
    let (gap, repairs) = without(400..450);
    assert!(
        matches!(
            repairs[..],
            [Repair::Gaps {
                count: 1,
                row: 401,
                ..
            }]
        ),
        "{repairs:?}"
    );
    assert_eq!(gap.position.len(), 1000);
    assert_eq!(gap.faulty.iter().filter(|faulty| **faulty).count(), 50);
    assert!((gap.position[425] - 9.0 * 0.425).abs() < 1e-9);
    let doubled = |of: &[f64]| [&of[..500], &of[499..]].concat();
    let (one, repairs) = samples(&doubled(&time), &doubled(&position), &doubled(&torque)).unwrap();
    assert!(matches!(
        repairs[..],
        [Repair::Duplicates { count: 1, row: 501 }]
    ));
    assert_eq!(one, whole);
    // A time twice, with values of their own, is a wrong time.
    let mut twice = time.clone();
    twice[500] = twice[499];
    let (late, repairs) = samples(&twice, &position, &torque).unwrap();
    assert!(
        matches!(repairs[..], [Repair::Jitter { by, equal: true }] if (by - 1e-3).abs() < 1e-5),
        "{repairs:?}"
    );
    assert!((late.position[700] - 9.0 * 0.7).abs() < 1e-9);
    twice[500] = 0.1;
    assert!(matches!(
        samples(&twice, &position, &torque).unwrap_err(),
        RecordFault::Backwards { row: 501, .. }
    ));
    let limited: Vec<f64> = torque.iter().map(|torque| torque.min(0.08)).collect();
    let (limited, repairs) = samples(&time, &position, &limited).unwrap();
    assert!(
        matches!(repairs[..], [Repair::Saturated { torque: 0.08, .. }]),
        "{repairs:?}"
    );
    assert!(limited.faulty[500] && !limited.faulty[0]);
}

/// A log whose times are changed row by row, and the error of J from it.
fn timed(rows: impl Fn(&mut ChaCha8Rng, usize) -> Option<f64>) -> (f64, Vec<Repair>) {
    let plant = press();
    let log = log(&plant, Encoder::Fine, false, 9, 30.0);
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut kept = [Vec::new(), Vec::new(), Vec::new()];
    for k in 0..log.samples.position.len() {
        if let Some(time) = rows(&mut rng, k) {
            kept[0].push(time);
            kept[1].push(log.samples.position[k]);
            kept[2].push(log.samples.torque[k]);
        }
    }
    let (read, repairs) = samples(&kept[0], &kept[1], &kept[2]).unwrap();
    let found = identify(&read, &log.options).unwrap();
    assert_eq!(found.faults, []);
    (errors(&plant, &found)[0], repairs)
}

#[test]
fn scattered_times_of_equal_steps_do_no_harm() {
    // ±0.3 ms of the clock of a PC, which is 50 ppm fast.
    let jitter = |rng: &mut ChaCha8Rng, k: usize| {
        Some(k as f64 * 1.00005e-3 + 0.6e-3 * (rng.random::<f64>() - 0.5))
    };
    let (error, repairs) = timed(jitter);
    assert!(error < 0.01, "{error}");
    assert!(
        matches!(repairs[..], [Repair::Jitter { by, equal: true }] if (0.25e-3..0.4e-3).contains(&by)),
        "{repairs:?}"
    );
    // A recorder that writes three rows at once.
    let (error, repairs) = timed(|_, k| Some((k - k % 3) as f64 * 1e-3));
    assert!(error < 0.01, "{error}");
    assert!(
        matches!(repairs[..], [Repair::Jitter { by, equal: true }] if (0.9e-3..2.1e-3).contains(&by)),
        "{repairs:?}"
    );
    // A fifth of the samples is missing, with jitter.
    let missing = |rng: &mut ChaCha8Rng, k: usize| {
        let late = 0.2e-3 * rng.random::<f64>();
        (rng.random::<f64>() > 0.2).then_some(k as f64 * 1e-3 + late)
    };
    let (error, repairs) = timed(missing);
    assert!(error < 0.01, "{error}");
    let [Repair::Gaps { count, longest, .. }] = repairs[..] else {
        panic!("{repairs:?}");
    };
    // A gap begins after a row that is there, before one that is missing: 0.8·0.2 of 30,000.
    assert!(
        (count as f64 - 4800.0).abs() < 200.0 && longest < 12e-3,
        "{repairs:?}"
    );
}

#[test]
fn samples_at_scattered_instants_are_interpolated() {
    // The instants of the samples scatter, and their times say so.
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let time: Vec<f64> = (0..5000)
        .map(|k| f64::from(k) * 1e-3 + 0.5e-3 * (rng.random::<f64>() - 0.5))
        .collect();
    let position: Vec<f64> = time.iter().map(|t| 9.0 * t).collect();
    let torque: Vec<f64> = time.iter().map(|t| (3.0 * t).sin()).collect();
    let (read, repairs) = samples(&time, &position, &torque).unwrap();
    assert!(
        matches!(repairs[..], [Repair::Jitter { equal: false, .. }]),
        "{repairs:?}"
    );
    // A line stays a line; its beginning is that of the clock.
    let first = read.position[0];
    for (k, phi) in read.position.iter().enumerate().skip(1).take(4990) {
        assert!(
            (phi - first - 9.0 * k as f64 * read.step).abs() < 9.0 * 0.3e-3,
            "{k}"
        );
    }
    let second = read
        .position
        .windows(3)
        .skip(10)
        .take(4900)
        .map(|p| (p[2] - 2.0 * p[1] + p[0]).abs());
    assert!(second.fold(0.0, f64::max) < 9.0 * 0.05e-3);
}

#[test]
fn a_constant_torque_and_lost_times_are_refused() {
    let time: Vec<f64> = (0..1000).map(|k| f64::from(k) * 1e-3).collect();
    let position: Vec<f64> = time.iter().map(|t| 9.0 * t).collect();
    let same = samples(&time, &position, &vec![2.5; 1000]).unwrap_err();
    assert_eq!(same, RecordFault::Constant { torque: 2.5 });
    let two = samples(&time[..2], &position[..2], &[1.0, 2.0]).unwrap().0;
    assert!(two.position.len() == 2 && (two.step - 1e-3).abs() < 1e-12);
    let once = samples(&[1.0; 9], &position[..9], &time[..9]).unwrap_err();
    assert_eq!(once, RecordFault::Empty);
    // Twenty rows at once.
    let torque: Vec<f64> = time.iter().map(|t| (3.0 * t).sin()).collect();
    let late: Vec<f64> = (0..1000).map(|k| f64::from(k - k % 20) * 1e-3).collect();
    let lost = samples(&late, &position, &torque).unwrap_err();
    assert_eq!(lost, RecordFault::Scattered);
}

/// A row with another angle is one wrong value, and not a reason to leave the turns as they are; a counter that overflows is refused.
#[test]
fn turns_are_unwrapped_beside_wrong_values() {
    let time: Vec<f64> = (0..3000).map(|k| f64::from(k) * 1e-3).collect();
    let torque: Vec<f64> = time.iter().map(|t| (3.0 * t).sin()).collect();
    let within: Vec<f64> = time.iter().map(|t| (9.0 * t).rem_euclid(TAU)).collect();
    for wrong in [500f64.to_radians(), 65_535.0 / 4096.0 * TAU, -40.5 * TAU] {
        let mut position = within.clone();
        position[1000] = wrong;
        let (read, _) = samples(&time, &position, &torque).unwrap();
        for (k, (read, t)) in read.position.iter().zip(&time).enumerate() {
            let off = (read - 9.0 * t).abs();
            assert!(off < if k == 1000 { 3.2 } else { 1e-9 }, "{k}: {off}");
        }
    }
    // 16 bits of 4096 counts a turn are 16 turns.
    let overflowing: Vec<f64> = time
        .iter()
        .map(|t| (90.0 * t).rem_euclid(16.0 * TAU))
        .collect();
    let fault = samples(&time, &overflowing, &torque).unwrap_err();
    let RecordFault::Jump { row: 1119, by } = fault else {
        panic!("{fault:?}");
    };
    assert!((by / TAU + 16.0).abs() < 0.1, "{by}");
}
