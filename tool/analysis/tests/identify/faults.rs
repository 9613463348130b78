//! Faults of a log, and logs that do not determine the machine.

use std::f64::consts::TAU;

use jred::machine::Reducible as _;
use jred_analysis::identify::{
    Fault, Obstacle, Options, RecordFault, Repair, Samples, against_design, identify, samples,
};

use super::plant::{Encoder, Plant, STEP, VARIED, errors, four_bar, log, log_of, motion, press};

/// A log of the press, and what it must give in place of a result or beside it.
fn refused(reference: impl Fn(f64) -> [f64; 3], seconds: f64) -> Obstacle {
    let log = log_of(&press(), Encoder::Fine, false, 3, seconds, reference);
    identify(&log.samples, &log.options).unwrap_err()
}

#[test]
fn a_log_that_does_not_determine_the_machine_says_why() {
    let varied = |t| motion(t, &VARIED, 1.5 * TAU, TAU / 2.0);
    assert!(matches!(refused(varied, 0.3), Obstacle::Short { .. }));
    assert!(matches!(refused(varied, 2.0), Obstacle::Short { .. }));
    let constant = |t: f64| [1.5 * TAU * t, 1.5 * TAU, 0.0];
    assert!(
        matches!(refused(constant, 20.0), Obstacle::SameSpeed { variation } if variation < 0.01)
    );
    // A cycle that repeats identically after a run-up: φ + 0.4·sin φ = 9·t.
    let cycle = |t: f64| {
        let mut phi = 9.0 * t;
        for _ in 0..50 {
            phi = 9.0 * t - 0.4 * phi.sin();
        }
        let (s, c) = phi.sin_cos();
        let omega = 9.0 / (1.0 + 0.4 * c);
        [phi, omega, 0.4 * s * omega * omega / (1.0 + 0.4 * c)]
    };
    let same = refused(cycle, 20.0);
    assert!(
        matches!(same, Obstacle::SameSpeed { variation } if variation < 0.03),
        "{same:?}"
    );
    let swing = |t: f64| {
        let (s, c) = (4.0 * t).sin_cos();
        [1.0 + s, 4.0 * c, -16.0 * s]
    };
    let Obstacle::NotVisited {
        from,
        to,
        left_out: false,
    } = refused(swing, 20.0)
    else {
        panic!("angles from 2 rad on are not visited");
    };
    assert!(
        (from - 2.0).abs() < 0.1 && (to - TAU).abs() < 0.1,
        "{from} to {to}"
    );
}

/// Another zero of a machine without weight is seen in J alone.
#[test]
fn another_zero_is_found_with_and_without_weight() {
    for gravity in ["0 m/s^2", "-9.81 m/s^2"] {
        let text = crate::reading::text_of("four-bar.toml");
        let text = crate::support::edited(&text, "\"-9.81 m/s^2\"", &format!("{gravity:?}"));
        let level = Plant {
            file: crate::reading::parse(&text).unwrap(),
            ..four_bar()
        };
        let mut turned = log(&level, Encoder::Fine, false, 7, 30.0);
        for phi in &mut turned.samples.position {
            *phi += TAU / 8.0;
        }
        let mut found = identify(&turned.samples, &turned.options).unwrap();
        let each = (0..360).map(|k| level.file.machine.reduction(f64::from(k).to_radians()));
        let design = each.map(|at| {
            let at = at.unwrap();
            [at.inertia, at.potential_slope]
        });
        against_design(&mut found, &design.collect::<Vec<_>>());
        let [Fault::Zero { by }] = found.faults[..] else {
            panic!("{gravity}: {:?}", found.faults);
        };
        assert!((by - TAU / 8.0).abs() < 0.005, "{by}");
    }
}

#[test]
fn faults_are_found() {
    let plant = press();
    let clean = log(&plant, Encoder::Fine, false, 7, 30.0);
    let found = |change: &dyn Fn(&mut Samples)| {
        let mut samples = clean.samples.clone();
        change(&mut samples);
        identify(&samples, &clean.options).unwrap()
    };
    let step = TAU / Encoder::Fine.counts();
    let slipped = found(&|samples| {
        for phi in &mut samples.position[15_000..] {
            *phi += 5.0 * step;
        }
    });
    let [Fault::Slip { at, by, .. }] = slipped.faults[..] else {
        panic!("{:?}", slipped.faults);
    };
    assert!((at - 15.0).abs() < 1.1, "{at}");
    assert!(
        (by / step + 5.0).abs() < 1.0 || (by / step - 5.0).abs() < 1.0,
        "{}",
        by / step
    );
    let reversed = found(&|samples| {
        for torque in &mut samples.torque {
            *torque = -*torque;
        }
    });
    assert_eq!(reversed.faults, [Fault::Reversed { position: false }]);
    // A spike stands out of the noise in the rows, each is one fault, and its neighbours stay.
    let linkage = four_bar();
    let mut light = log(&linkage, Encoder::Fine, false, 7, 30.0);
    for k in 1..30 {
        light.samples.torque[997 * k] += if k % 2 == 0 { 20.0 } else { -20.0 };
    }
    let spiked = identify(&light.samples, &light.options).unwrap();
    assert!(
        matches!(spiked.faults[..], [Fault::Spikes { count: 29, first }] if (first - 0.997).abs() < 0.03),
        "{:?}",
        spiked.faults
    );
    assert!(errors(&linkage, &spiked)[0] < 0.01);
    // Rest with an encoder that counts to and fro is no second direction.
    let mut resting = clean.samples.clone();
    let end = resting.position[29_999];
    resting
        .position
        .extend((0..10_000).map(|k| end + step * f64::from([0, 2, 0, -2][k % 4])));
    resting.torque.resize(40_000, 0.0);
    resting.faulty.resize(40_000, false);
    let rested = identify(&resting, &clean.options).unwrap();
    assert_eq!(rested.mean_load, None);
    assert!(
        (rested.excitation.turns - 45.0).abs() < 0.5,
        "{}",
        rested.excitation.turns
    );
    // The encoder of one turn, with a gap in which it turns more than half a turn; and the same with an encoder that counts turns.
    let times = || (0..30_000).map(|k| f64::from(k) * STEP);
    let gapped: Vec<f64> = times().filter(|t| !(5.0..5.5).contains(t)).collect();
    let rows = |of: &[f64], change: fn(f64) -> f64| -> Vec<f64> {
        let kept = times().zip(of).filter(|(t, _)| !(5.0..5.5).contains(t));
        kept.map(|(_, x)| change(*x)).collect()
    };
    let torque = rows(&clean.samples.torque, |x| x);
    let within = rows(&clean.samples.position, |x| x.rem_euclid(TAU));
    let Err(RecordFault::Turns { row, gap, longest }) = samples(&gapped, &within, &torque) else {
        panic!("turns are lost");
    };
    assert!(row == 5001 && (gap - 0.501).abs() < 1e-9 && (0.15..0.5).contains(&longest));
    let counted = rows(&clean.samples.position, |x| x);
    let (read, repairs) = samples(&gapped, &counted, &torque).unwrap();
    assert!(matches!(repairs[..], [Repair::Gaps { count: 1, .. }]));
    assert!((read.position[29_999] - clean.samples.position[29_999]).abs() < 1e-9);
    // Steps of more than half a turn, of a fast motor that counts turns, stay.
    let fast: Vec<f64> = clean.samples.position.iter().map(|x| 400.0 * x).collect();
    let all: Vec<f64> = times().collect();
    let (read, _) = samples(&all, &fast, &clean.samples.torque).unwrap();
    assert!((read.position[29_999] - fast[29_999]).abs() < 1e-6);
    // Cogging of a low order is a harmonic of V′: above the order that the noise suggests.
    let low = Options {
        cogging: vec![18, 36],
        ..clean.options.clone()
    };
    let lower = identify(&clean.samples, &low).unwrap();
    assert!(lower.harmonics >= 18 && lower.cogging.len() == 1);
    // A delay far from the usual one is searched for.
    let late = found(&|samples| samples.torque.rotate_right(5));
    assert!((late.delay.value - 6e-3).abs() < 0.3e-3, "{:?}", late.delay);
    assert!(errors(&plant, &late)[0] < 0.01);
}
