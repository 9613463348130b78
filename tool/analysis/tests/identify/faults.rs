//! Faults of a log, and logs that do not determine the machine.

use std::f64::consts::TAU;

use jred_analysis::identify::{
    Fault, Obstacle, Options, Reading, RecordFault, Repair, Samples, against_design, identify,
    judge_reading, samples,
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

/// Many samples in a short time: 23 ms at 100 kHz; and 20 s whose times are in milliseconds, declared as microseconds.
#[test]
fn a_short_duration_is_refused_whatever_the_number_of_samples() {
    let run_up: Vec<f64> = (0..2300).map(|k| f64::from(k) * 1e-5).collect();
    let brief = Samples {
        step: 1e-5,
        position: run_up.iter().map(|t| 300.0 * t + 15e3 * t * t).collect(),
        torque: run_up.iter().map(|t| (300.0 * t).sin()).collect(),
        faulty: vec![false; 2300],
    };
    let refused = identify(&brief, &Options::default()).unwrap_err();
    assert!(matches!(
        refused,
        Obstacle::Short {
            rows: 0,
            needed: 480,
            ..
        }
    ));
    let mut declared = log(&press(), Encoder::Fine, false, 3, 20.0).samples;
    declared.step = 1e-6;
    let refused = identify(&declared, &Options::default()).unwrap_err();
    assert!(matches!(refused, Obstacle::Short { rows: 0, .. }));
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
        against_design(&mut found, &level.design());
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
    assert!((by / step - 5.0).abs() < 1.0, "{}", by / step);
    let reversed = found(&|samples| {
        for torque in &mut samples.torque {
            *torque = -*torque;
        }
    });
    assert_eq!(reversed.faults, [Fault::Reversed { position: None }]);
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
    assert!((rested.excitation.moving - 30.0).abs() < 0.1);
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

#[test]
fn a_slip_has_its_size_and_its_sign() {
    let plant = four_bar();
    let clean = log(&plant, Encoder::Coarse, false, 11, 30.0);
    let step = TAU / Encoder::Coarse.counts();
    for counts in [25, -25, 1] {
        let mut slipped = clean.samples.clone();
        for phi in &mut slipped.position[12_000..] {
            *phi += f64::from(counts) * step;
        }
        let faults = identify(&slipped, &clean.options).unwrap().faults;
        // One count is not certain.
        if counts == 1 {
            assert_eq!(faults, []);
            continue;
        }
        let [Fault::Slip { at, by, .. }] = faults[..] else {
            panic!("{counts} counts: {faults:?}");
        };
        assert!((at - 12.0).abs() < 1.1, "{at}");
        assert!((by / step - f64::from(counts)).abs() < 2.0, "{}", by / step);
    }
}

#[test]
fn cogging_that_was_not_asked_for_is_named() {
    for (mut plant, closed) in [(press(), false), (four_bar(), true)] {
        // A coarse encoder hides a small one.
        plant.cogging = plant.cogging.map(|part| 3.0 * part);
        for encoder in [Encoder::Coarse, Encoder::Fine] {
            let mut unasked = log(&plant, encoder, closed, 5, 30.0);
            unasked.options.cogging.clear();
            let found = identify(&unasked.samples, &unasked.options).unwrap();
            let [
                Fault::Cogging {
                    order: 36,
                    amplitude,
                },
            ] = found.faults[..]
            else {
                panic!("{encoder:?} {closed}: {:?}", found.faults);
            };
            // χ² > 40: two standard deviations of the amplitude are 32 % of it at most.
            let exact = plant.cogging[0].hypot(plant.cogging[1]);
            assert!(
                (amplitude - exact).abs() < 0.32 * exact,
                "{amplitude} instead of {exact}"
            );
        }
    }
    // Two orders, of which one was asked for.
    let plant = press();
    let mut two = log(&plant, Encoder::Fine, false, 5, 30.0);
    for (k, torque) in two.samples.torque.iter_mut().enumerate() {
        let [phi, ..] = motion((k as f64 - 1.0) * STEP, &VARIED, 1.5 * TAU, TAU / 2.0);
        *torque += 0.9 * (42.0 * phi).cos();
    }
    let found = identify(&two.samples, &two.options).unwrap();
    let [
        Fault::Cogging {
            order: 42,
            amplitude,
        },
    ] = found.faults[..]
    else {
        panic!("{:?}", found.faults);
    };
    assert!((amplitude - 0.9).abs() < 0.28, "{amplitude}");
}

#[test]
fn faulty_samples_of_a_late_torque_do_no_harm() {
    let plant = four_bar();
    let mut late = log(&plant, Encoder::Fine, false, 13, 30.0);
    let samples = &mut late.samples;
    samples.torque.rotate_right(10);
    // A drive at its limit may write another torque than it has.
    for k in (500..29_500).step_by(200) {
        samples.torque[k..k + 10].fill(60.0);
        samples.faulty[k..k + 10].fill(true);
    }
    let found = identify(samples, &late.options).unwrap();
    let [inertia, _, torque] = errors(&plant, &found);
    assert_eq!(found.faults, []);
    assert!(
        (found.delay.value - 11e-3).abs() < 0.3e-3,
        "{:?}",
        found.delay
    );
    assert!(inertia < 0.01 && torque < 0.02, "{inertia} {torque}");
}

/// A wrong sign is that of the column that has it. The press is symmetric: over −φ it is the same machine.
#[test]
fn a_reversed_column_is_named() {
    for (plant, symmetric) in [(press(), true), (four_bar(), false)] {
        let clean = log(&plant, Encoder::Fine, true, 17, 20.0);
        for of_position in [false, true] {
            let mut samples = clean.samples.clone();
            let column = if of_position {
                &mut samples.position
            } else {
                &mut samples.torque
            };
            for x in column.iter_mut() {
                *x = -*x;
            }
            let mut found = identify(&samples, &clean.options).unwrap();
            against_design(&mut found, &plant.design());
            let position = (!symmetric).then_some(of_position);
            assert_eq!(found.faults, [Fault::Reversed { position }]);
        }
    }
}

/// Counts of a turn that are given four times as many as there are, or half as many.
#[test]
fn wrong_counts_are_named() {
    let plant = four_bar();
    let design = plant.design();
    let clean = log(&plant, Encoder::Fine, false, 19, 15.0);
    let scaled = |by: f64| {
        let mut samples = clean.samples.clone();
        for phi in &mut samples.position {
            *phi *= by;
        }
        identify(&samples, &clean.options).ok()
    };
    for wrong in [0.25, 2.0] {
        let mut found = scaled(wrong).unwrap();
        against_design(&mut found, &design);
        judge_reading(
            &mut found,
            |_| design.clone(),
            |reading| match reading {
                Reading::Scaled(by) => scaled(wrong * by),
                Reading::OtherShaft => None,
            },
        );
        let [Fault::Scale { by }] = found.faults[..] else {
            panic!("{wrong}: {:?}", found.faults);
        };
        assert!((by * wrong - 1.0).abs() < 1e-12);
    }
    let mut right = scaled(1.0).unwrap();
    judge_reading(
        &mut right,
        |_| design.clone(),
        |_| panic!("a good log is not identified again"),
    );
    assert_eq!(right.faults, []);
    // No such fault is reported for another machine, although larger positions make its J smaller; a torque of half its size is reported.
    for (plant, by, torque) in [(press(), 1.0, false), (four_bar(), 0.5, true)] {
        let mut log = log(&plant, Encoder::Fine, false, 19, 15.0);
        for torque in &mut log.samples.torque {
            *torque *= by;
        }
        let read = |by: f64| {
            let mut samples = log.samples.clone();
            for phi in &mut samples.position {
                *phi *= by;
            }
            identify(&samples, &log.options).ok()
        };
        let mut found = read(1.0).unwrap();
        judge_reading(
            &mut found,
            |_| design.clone(),
            |reading| match reading {
                Reading::Scaled(by) => read(by),
                Reading::OtherShaft => None,
            },
        );
        match found.faults[..] {
            [Fault::Torque { by: found }] if torque => assert!((found - by).abs() < 0.02),
            [] if !torque => {}
            _ => panic!("{:?}", found.faults),
        }
    }
}

/// A rotor that was not taken out trebles a constant J: no torque is wrong, although J by a third is nearer than J less its mean.
#[test]
fn a_forgotten_rotor_is_no_wrong_torque() {
    let plant = four_bar();
    let log = log(&plant, Encoder::Fine, false, 19, 15.0);
    let mut found = identify(&log.samples, &log.options).unwrap();
    for (k, point) in (0u32..).zip(&mut found.curves) {
        point.inertia.value = 3.0 + 0.01 * f64::from(k).cos();
        point.potential_slope.value = 0.0;
    }
    judge_reading(&mut found, |_| vec![[1.0, 0.0]; 360], |_| None);
    assert_eq!(found.faults, []);
}
