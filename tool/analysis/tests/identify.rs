//! Logs of machines whose curves are known exactly, with the noise of a drive.
//!
//! The plant is not the identified model: its J, J′ and V′ are those of the mechanism, its motion is integrated here (Runge-Kutta), its encoder
//! counts, and its torque is logged late.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use jred::machine::Reducible as _;
use jred::mechanism::TrainOutput;
use jred_analysis::identify::{
    Fault, Identified, Obstacle, Options, RecordFault, Repair, Samples, against_design, identify,
    referred, samples, without_drive,
};
use jred_file::model::machine::MachineFile;

use crate::reading::machine;

const STEP: f64 = 1e-3;

/// Amplitude share, frequency (Hz) and phase of a motion's waves.
type Waves = [[f64; 3]; 4];

/// 60 to 120 rpm.
const VARIED: Waves = [
    [0.37, 0.35, 0.3],
    [0.83, 0.25, 1.1],
    [1.93, 0.22, 2.0],
    [3.17, 0.18, 0.7],
];

/// 50 to 130 rpm, at other frequencies.
const OTHER: Waves = [
    [0.29, 0.3, 0.9],
    [1.13, 0.3, 0.1],
    [2.41, 0.25, 1.3],
    [3.67, 0.2, 2.2],
];

/// φ, ω, α.
fn motion(t: f64, waves: &Waves, mean: f64, swing: f64) -> [f64; 3] {
    waves.iter().fold(
        [mean * t + 0.4, mean, 0.0],
        |[phi, omega, alpha], [hertz, share, phase]| {
            let o = TAU * hertz;
            let (s, c) = (o * t + phase).sin_cos();
            [
                phi + swing * share / o * s,
                omega + swing * share * c,
                alpha - swing * share * o * s,
            ]
        },
    )
}

/// A machine without process loads, with friction and cogging that are known.
struct Plant {
    file: MachineFile,
    viscous: f64,
    coulomb: f64,
    cogging: [f64; 2],
}

const COGGING: f64 = 36.0;

fn press() -> Plant {
    Plant {
        file: machine("press.toml"),
        viscous: 0.4,
        coulomb: 3.0,
        cogging: [0.25, 0.2],
    }
}

fn four_bar() -> Plant {
    Plant {
        file: machine("four-bar.toml"),
        viscous: 0.02,
        coulomb: 0.4,
        cogging: [0.04, 0.03],
    }
}

impl Plant {
    /// J, J′, and the torque that does not accelerate.
    fn at(&self, phi: f64, omega: f64) -> [f64; 3] {
        let reduction = self.file.machine.reduction(phi).unwrap();
        let (s, c) = (COGGING * phi).sin_cos();
        let sign = if omega == 0.0 { 0.0 } else { omega.signum() };
        [
            reduction.inertia,
            reduction.inertia_slope,
            reduction.potential_slope
                + self.viscous * omega
                + self.coulomb * sign
                + self.cogging[0] * c
                + self.cogging[1] * s,
        ]
    }

    fn torque(&self, [phi, omega, alpha]: [f64; 3]) -> f64 {
        let [j, slope, load] = self.at(phi, omega);
        j * alpha + 0.5 * slope * omega * omega + load
    }

    fn inertias(&self) -> Vec<f64> {
        let phi = (0..360).map(|k| f64::from(k) * TAU / 360.0);
        phi.map(|phi| self.at(phi, 0.0)[0]).collect()
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Encoder {
    /// 4096 counts.
    Coarse,
    /// 10,000 counts with a noise of 0.7 counts.
    Fine,
}

impl Encoder {
    const fn counts(self) -> f64 {
        match self {
            Self::Coarse => 4096.0,
            Self::Fine => 10_000.0,
        }
    }
}

fn gauss(rng: &mut ChaCha8Rng) -> f64 {
    let [u, v]: [f64; 2] = [rng.random(), rng.random()];
    (-2.0 * (1.0 - u).ln()).sqrt() * (TAU * v).cos()
}

struct Log {
    samples: Samples,
    options: Options,
}

/// A log of `seconds`: open loop, the motion is the reference; closed loop, a controller of 8 Hz on the counted position drives the machine.
fn log(plant: &Plant, encoder: Encoder, closed: bool, seed: u64, seconds: f64) -> Log {
    log_of(plant, encoder, closed, seed, seconds, |t| {
        motion(t, &VARIED, 1.5 * TAU, TAU / 2.0)
    })
}

fn log_of(
    plant: &Plant,
    encoder: Encoder,
    closed: bool,
    seed: u64,
    seconds: f64,
    reference: impl Fn(f64) -> [f64; 3],
) -> Log {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let count = (seconds / STEP).round() as usize;
    let step = TAU / encoder.counts();
    let zero: f64 = rng.random::<f64>() * step;
    let counted = |phi: f64, rng: &mut ChaCha8Rng| {
        let noise = if encoder == Encoder::Fine {
            0.7 * step * gauss(rng)
        } else {
            0.0
        };
        ((phi + zero + noise) / step).round() * step - zero
    };
    let (mut position, mut torque) = (Vec::new(), Vec::new());
    let inertias = plant.inertias();
    let mean = inertias.iter().sum::<f64>() / inertias.len() as f64;
    let [mut phi, mut omega, _] = reference(0.0);
    let (mut filtered, mut before) = (omega, None);
    for k in 0..count {
        let t = k as f64 * STEP;
        let wanted = reference(t);
        if !closed {
            position.push(counted(wanted[0], &mut rng));
            torque.push(plant.torque(reference(t - STEP)));
            continue;
        }
        let y = counted(phi, &mut rng);
        if let Some(before) = before {
            filtered += STEP / (3e-3 + STEP) * ((y - before) / STEP - filtered);
        }
        before = Some(y);
        let drive = mean * (2500.0 * (wanted[0] - y) + 80.0 * (wanted[1] - filtered) + wanted[2]);
        position.push(y);
        torque.push(drive);
        let slope = |[phi, omega]: [f64; 2]| {
            let [j, slope, load] = plant.at(phi, omega);
            [omega, (drive - load - 0.5 * slope * omega * omega) / j]
        };
        for _ in 0..2 {
            let h = STEP / 2.0;
            let at = [phi, omega];
            let by = |k: [f64; 2], h: f64| [at[0] + h * k[0], at[1] + h * k[1]];
            let k1 = slope(at);
            let k2 = slope(by(k1, h / 2.0));
            let k3 = slope(by(k2, h / 2.0));
            let k4 = slope(by(k3, h));
            phi += h / 6.0 * (k1[0] + 2.0 * k2[0] + 2.0 * k3[0] + k4[0]);
            omega += h / 6.0 * (k1[1] + 2.0 * k2[1] + 2.0 * k3[1] + k4[1]);
        }
    }
    if closed {
        // The log has it a sample late.
        torque.rotate_right(1);
        torque[0] = torque[1];
    }
    let rms = (torque.iter().map(|t| t * t).sum::<f64>() / torque.len() as f64).sqrt();
    for t in &mut torque {
        *t += 0.01 * rms * gauss(&mut rng);
    }
    Log {
        samples: Samples {
            step: STEP,
            faulty: vec![false; count],
            position,
            torque,
        },
        options: Options {
            cogging: vec![COGGING as u32],
            delay: None,
            encoder_step: Some(step),
        },
    }
}

/// Largest error of J, share of the angles inside the band, peak error of the torque of another motion, all against the exact plant.
fn errors(plant: &Plant, found: &Identified) -> [f64; 3] {
    let exact = plant.inertias();
    let most = exact.iter().copied().fold(0.0, f64::max);
    let (mut worst, mut inside) = (0.0f64, 0);
    for (point, exact) in found.curves.iter().zip(&exact) {
        let error = (point.inertia.value - exact).abs();
        worst = worst.max(error / most);
        inside += usize::from(error <= point.inertia.band);
    }
    let states = (0..6000).map(|k| motion(f64::from(k) * 2e-3, &OTHER, 1.5 * TAU, 4.0));
    let (mut peak, mut largest) = (0.0f64, 0.0f64);
    for state in states {
        let torque = plant.torque(state);
        largest = largest.max(torque.abs());
        peak = peak.max((found.torque(state[0], state[1], state[2]) - torque).abs());
    }
    [worst, inside as f64 / 360.0, peak / largest]
}

const CASES: [(Encoder, bool); 4] = [
    (Encoder::Coarse, false),
    (Encoder::Coarse, true),
    (Encoder::Fine, false),
    (Encoder::Fine, true),
];

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

/// The log of a motor with a rotor behind a drive train with losses, made from that of the drive link by the drive train's own torques.
#[test]
fn a_log_of_the_motor_gives_the_machine_alone() {
    let text = crate::reading::text_of("press.toml");
    let lossy = crate::support::edited(&text, "efficiency = \"97 %\"", "efficiency = \"80 %\"");
    let plant = Plant {
        file: crate::reading::parse(&lossy).unwrap(),
        ..press()
    };
    let train = &plant.file.drive_train;
    let ratio = train.ratio();
    assert!((train.efficiency() - 0.8).abs() < 1e-12);
    // As much as the machine itself has.
    let rotor = 0.5 * plant.inertias()[0] / (ratio * ratio);
    let inertia = plant.file.train_inertia() + rotor * ratio * ratio;
    let mut log = log(&plant, Encoder::Fine, false, 4, 30.0);
    for (k, torque) in log.samples.torque.iter_mut().enumerate() {
        let [_, omega, alpha] = motion((k as f64 - 1.0) * STEP, &VARIED, 1.5 * TAU, TAU / 2.0);
        let output = TrainOutput {
            torque: *torque,
            omega,
            alpha,
            direction: omega,
            ..TrainOutput::default()
        };
        *torque = train.input(&output).torque + rotor * ratio * alpha;
    }
    for position in &mut log.samples.position {
        *position *= ratio;
    }
    referred(&mut log.samples, &plant.file, rotor);
    let mut found = identify(&log.samples, &log.options).unwrap();
    let [with, ..] = errors(&plant, &found);
    let (mut heavy, least) = (found.clone(), plant.inertias());
    // A rotor as heavy as the whole log, and a little more than the smallest J.
    let taken = least.iter().copied().fold(f64::MAX, f64::min) + inertia;
    without_drive(&mut heavy, &plant.file, 1.02 * taken / (ratio * ratio));
    let [Fault::NotPositive { at, inertia: below }] = heavy.faults[..] else {
        panic!("{:?}", heavy.faults);
    };
    let exact = plant.at(at, 0.0)[0];
    let removed = plant.file.train_inertia() + 1.02 * taken;
    assert!(below < 0.0 && (below - (exact + inertia - removed)).abs() < 0.01 * taken);
    assert!(heavy.excitation.band > found.excitation.band);
    assert!(with > 0.03, "{with}");
    without_drive(&mut found, &plant.file, rotor);
    let [inertia, inside, torque] = errors(&plant, &found);
    assert!(inertia < 0.01 && torque < 0.02, "{inertia} {torque}");
    assert!(inside > 0.6, "{inside}");
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
    let swing = |t: f64| {
        let (s, c) = (4.0 * t).sin_cos();
        [1.0 + s, 4.0 * c, -16.0 * s]
    };
    let Obstacle::NotVisited { from, to } = refused(swing, 20.0) else {
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
    let mut twice = time.clone();
    twice[500] = twice[499];
    let (_, repairs) = samples(&twice, &position, &torque).unwrap();
    assert!(matches!(
        repairs[0],
        Repair::Duplicates { count: 1, row: 501 }
    ));
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
