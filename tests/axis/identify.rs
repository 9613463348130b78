use core::f64::consts::TAU;

use jred::axis::{Found, FoundStatus, Identification, IdentificationSettings, Sampled};
use jred::harmonic::{Circular, terms};
use jred::table::{Shape, Table};
use jred::{CurveSet, Harmonic, Model, Phase, curves};

use super::plants::{
    BITS_12, COUNTS_10K, Encoder, FOUR_BAR, Motion, ORDER, PRESS, Plant, TICK, constant,
    controlled, other, recorded, repeated, swing, vary,
};

const SET: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS | terms::GENERAL;

/// With friction that varies.
const VARYING: CurveSet = SET | terms::COULOMB_COS;

/// Six harmonics for the press and ten for the four-bar; two for cogging.
const OF_PRESS: usize = 4 + 4 * 6 + 2;
const OF_FOUR_BAR: usize = 4 + 4 * 10 + 2;

/// Half a minute, in ticks.
const TICKS: usize = 30_000;

type Log = Vec<(Phase, f64)>;

fn mean(plant: &Plant) -> f64 {
    let inertia = |k: i32| (plant.curves)(f64::from(k) * TAU / 360.0)[0];
    (0..360).map(inertia).sum::<f64>() / 360.0
}

fn settings(plant: &Plant, encoder: Encoder) -> IdentificationSettings {
    IdentificationSettings {
        period: TICK as f32,
        max_speed: 14.0,
        inertia: 1.5 * mean(plant) as f32,
        torque_delay: TICK as f32,
        torque_noise: 0.01 * plant.rms as f32,
        angle_noise: encoder.noise() as f32,
        memory: f32::INFINITY,
    }
}

fn identification<T: Circular, const N: usize>(
    settings: &IdentificationSettings,
) -> Identification<T, N, 256, SET> {
    Identification::new(settings, &[ORDER]).unwrap()
}

/// As a program runs it: each tick in the interrupt, the solution in the background.
fn add<T: Circular, const N: usize>(
    identification: &mut Identification<T, N, 256, SET>,
    log: &[(Phase, f64)],
) {
    for (k, (phase, torque)) in log.iter().enumerate() {
        identification.add(*phase, T::from_f64(*torque));
        if k % 400 == 399 {
            let found = identification.equations().solve();
            identification.adopt(&found);
        }
    }
}

fn found<T: Circular, const N: usize>(
    settings: &IdentificationSettings,
    log: &[(Phase, f64)],
) -> Found<T, N> {
    let mut identification = identification(settings);
    add(&mut identification, log);
    identification.equations().solve()
}

/// Errors in shares: the largest of J, how much of J lies in the band, the widest band, and the largest of the feed-forward in another motion.
#[derive(Debug)]
struct Score {
    inertia: f64,
    covered: f64,
    band: f64,
    feed_forward: f64,
}

fn score<T: Circular, const N: usize>(plant: &Plant, found: &Found<T, N>) -> Score {
    let (mut worst, mut most, mut band, mut inside) = (0.0_f64, 0.0_f64, 0.0_f64, 0);
    for k in 0..360 {
        let phi = f64::from(k) * TAU / 360.0;
        let exact = (plant.curves)(phi)[0];
        let [inertia, width] = found.inertia(Phase::from_radians(phi)).map(T::to_f64);
        let off = (inertia - exact).abs();
        worst = worst.max(off);
        most = most.max(exact);
        band = band.max(width);
        inside += u32::from(off <= width);
    }
    let words: Vec<f32> = found.words().iter().map(|word| word.to_f32()).collect();
    let table = Table::new(&words, Shape::harmonics((words.len() as u32 - 4) / 4, SET)).unwrap();
    let model = Model::<Harmonic<f32>, SET>::new(table).unwrap();
    let cogging = found.coefficients[N - 2..]
        .iter()
        .map(|value| value.to_f64());
    let [cos, sin] = [0, 1].map(|k| cogging.clone().nth(k).unwrap());
    let (mut off, mut peak) = (0.0_f64, 0.0_f64);
    for k in 0..6000 {
        let motion = other(f64::from(k) * 2e-3);
        let [phi, omega, alpha] = motion;
        let torque = model.torque(Phase::from_radians(phi), omega as f32, alpha as f32);
        let (s, c) = (f64::from(ORDER) * phi).sin_cos();
        let exact = plant.torque(motion);
        off = off.max((f64::from(torque) + cos * c + sin * s - exact).abs());
        peak = peak.max(exact.abs());
    }
    Score {
        inertia: worst / most,
        covered: f64::from(inside) / 360.0,
        band: band / most,
        feed_forward: off / peak,
    }
}

/// A record of a machine, by its name's parts, and what is right of it.
fn check<const N: usize>(plant: &Plant, encoder: Encoder, closed: bool, seed: u64) -> Score {
    let mut settings = settings(plant, encoder);
    let log = if closed {
        // Between the command and its effect, half a period.
        settings.torque_delay = 0.5 * TICK as f32;
        controlled(plant, encoder, vary, seed, TICKS)
    } else {
        recorded(plant, encoder, vary, seed, TICKS)
    };
    let found = found::<f32, N>(&settings, &log);
    assert_eq!(found.status, FoundStatus::Good);
    assert!(found.residual > 0.85 && found.residual < 1.1, "{found:?}");
    assert!(found.one_way && found.jumps == 0);
    score(plant, &found)
}

#[test]
fn the_plants_are_exact() {
    for plant in [PRESS, FOUR_BAR] {
        let mut squares = 0.0;
        for k in 0..TICKS {
            squares += plant.torque(vary(k as f64 * TICK)).powi(2);
        }
        let rms = (squares / TICKS as f64).sqrt();
        assert!((rms / plant.rms - 1.0).abs() < 0.01, "{rms}");
        for k in 0..100 {
            let (phi, h) = (f64::from(k) * TAU / 100.0, 1e-5);
            let [after, before] = [phi + h, phi - h].map(|phi| (plant.curves)(phi)[0]);
            let slope = (after - before) / (2.0 * h);
            assert!((slope - (plant.curves)(phi)[1]).abs() < 1e-9);
        }
    }
}

#[test]
fn a_machine_is_identified() {
    for encoder in [BITS_12, COUNTS_10K] {
        for closed in [false, true] {
            for score in [
                check::<OF_PRESS>(&PRESS, encoder, closed, 1),
                check::<OF_FOUR_BAR>(&FOUR_BAR, encoder, closed, 1),
            ] {
                assert!(score.inertia < 0.01 && score.band < 0.01, "{score:?}");
                assert!(score.feed_forward < 0.02, "{score:?}");
                assert!(score.covered > 0.6, "{score:?}");
            }
        }
    }
}

/// Twenty bits: accelerations are far beyond the noise, and no jumps.
#[test]
fn a_fine_encoder_does_better() {
    let fine = Encoder {
        counts: 1_048_576.0,
        jitter: 0.0,
    };
    let score = check::<OF_PRESS>(&PRESS, fine, false, 1);
    assert!(
        score.inertia < 0.003 && score.feed_forward < 0.005,
        "{score:?}"
    );
    assert!(score.covered > 0.6, "{score:?}");
}

/// The figures of `docs/identify-on-the-machine.md`: one case, with `JRED_EVERY_CASE=1` all eight.
#[test]
#[ignore = "200 records of half a minute"]
fn the_band_holds_for_two_hundred_records() {
    fn run<const N: usize>(name: &str, plant: &Plant, encoder: Encoder, closed: bool) {
        let scores: Vec<_> = (1..=200)
            .map(|seed| check::<N>(plant, encoder, closed, seed))
            .collect();
        let sorted = |of: fn(&Score) -> f64| {
            let mut values: Vec<_> = scores.iter().map(of).collect();
            values.sort_by(f64::total_cmp);
            [values[100], values[190], values[199]].map(|value| 100.0 * value)
        };
        let covered = scores.iter().map(|score| score.covered).sum::<f64>() / 200.0;
        let (inertia, torque) = (
            sorted(|score| score.inertia),
            sorted(|score| score.feed_forward),
        );
        println!("{name} {closed}: J {inertia:.2?} torque {torque:.2?} covered {covered:.3}");
        assert!(inertia[2] < 1.0 && torque[2] < 2.0);
        assert!((0.93..0.97).contains(&covered), "{covered}");
    }
    for (name, encoder) in [("12 bits", BITS_12), ("10,000", COUNTS_10K)] {
        for closed in [false, true] {
            run::<OF_PRESS>(name, &PRESS, encoder, closed);
            if std::env::var_os("JRED_EVERY_CASE").is_none() {
                return;
            }
            run::<OF_FOUR_BAR>(name, &FOUR_BAR, encoder, closed);
        }
    }
}

#[test]
fn single_precision_finds_the_same() {
    let (settings, log) = (
        settings(&PRESS, BITS_12),
        recorded(&PRESS, BITS_12, vary, 3, TICKS),
    );
    let single = found::<f32, OF_PRESS>(&settings, &log);
    let double = found::<f64, OF_PRESS>(&settings, &log);
    let pairs = single.coefficients.iter().zip(double.coefficients);
    for ((a, b), error) in pairs.zip(double.standard_error) {
        // A small part of what is uncertain anyway.
        assert!((f64::from(*a) - b).abs() <= 0.1 * error, "{a} {b} {error}");
    }
    for (a, b) in single.standard_error.iter().zip(double.standard_error) {
        assert!((f64::from(*a) - b).abs() <= 0.01 * b, "{a} {b}");
    }
}

/// Forward and back: standstill is left out.
#[test]
fn reversals_are_identified() {
    let log = recorded(&PRESS, BITS_12, swing, 1, TICKS);
    let found = found::<f32, OF_PRESS>(&settings(&PRESS, BITS_12), &log);
    assert_eq!(found.status, FoundStatus::Good);
    assert!(!found.one_way);
    let score = score(&PRESS, &found);
    assert!(
        score.inertia < 0.01 && score.feed_forward < 0.02,
        "{score:?}"
    );
}

/// Of a change, the share exp(−t/τ) is left after t, if the motion says the same about every machine all the time: of a torque sensor that suddenly shows half as much again.
#[test]
fn older_samples_fade() {
    let memory = 20.0;
    let settings = IdentificationSettings {
        memory,
        ..settings(&PRESS, BITS_12)
    };
    let mut log = recorded(&PRESS, BITS_12, repeated, 1, 100_000);
    for (_, torque) in &mut log[60_000..] {
        *torque *= 1.5;
    }
    let mut identification = identification::<f32, OF_PRESS>(&settings);
    add(&mut identification, &log[..60_000]);
    let before = identification.equations().solve();
    // The noise is weighted as before: not adopted.
    for (phase, torque) in &log[60_000..] {
        identification.add(*phase, *torque as f32);
    }
    let after = identification.equations().solve();
    assert_eq!(after.status, FoundStatus::Disturbed);
    assert!(after.residual > 5.0);
    let share = |found: &Found<f32, OF_PRESS>| f64::from(found.coefficients[0]) / mean(&PRESS);
    let left = (1.5 - share(&after)) / (1.5 - share(&before));
    let measured = -40.0 / left.ln();
    assert!(
        (measured / f64::from(memory) - 1.0).abs() < 0.1,
        "{measured}"
    );
}

fn status(motion: Motion, ticks: usize, change: impl Fn(&mut Log)) -> Found<f32, OF_PRESS> {
    let mut log = recorded(&PRESS, BITS_12, motion, 1, ticks);
    change(&mut log);
    found(&settings(&PRESS, BITS_12), &log)
}

#[test]
fn a_motion_that_says_too_little_is_named() {
    let unchanged = |_: &mut Log| ();
    assert_eq!(status(vary, 4000, unchanged).status, FoundStatus::TooShort);
    let same = status(constant, TICKS, unchanged);
    assert_eq!(same.status, FoundStatus::SameSpeed, "{}", same.speed_spread);
    let part = status(
        |time| [(3.0 * time).sin(), 3.0 * (3.0 * time).cos(), 0.0],
        TICKS,
        unchanged,
    );
    assert!(
        matches!(part.status, FoundStatus::NotVisited(_)),
        "{:?}",
        part.status
    );
    let nothing = status(|_| [0.0; 3], TICKS, unchanged);
    assert_eq!(nothing.status, FoundStatus::TooShort);
    assert!(nothing.coefficients.iter().all(|value| value.is_finite()));
}

/// 3 % of the samples more than 5 % beyond the stated speed are too many, 1 % are not; those that are left out do no harm.
#[test]
fn a_speed_beyond_the_stated_one_is_named() {
    let log = recorded(&PRESS, BITS_12, vary, 1, TICKS);
    let mut speeds: Vec<_> = (0..TICKS).map(|k| vary(k as f64 * TICK)[1]).collect();
    speeds.sort_by(f64::total_cmp);
    for (share, status) in [
        (0.01, FoundStatus::Good),
        (0.03, FoundStatus::TooFast),
        (0.5, FoundStatus::TooFast),
    ] {
        let at = ((1.0 - share) * TICKS as f64) as usize;
        let settings = IdentificationSettings {
            max_speed: (speeds[at] / 1.05) as f32,
            ..settings(&PRESS, BITS_12)
        };
        let found = found::<f32, OF_PRESS>(&settings, &log);
        assert_eq!(found.status, status, "{share}");
        assert!(share > 0.1 || score(&PRESS, &found).inertia < 0.01);
    }
}

/// Two to four turns a minute are motion for a machine that is no faster.
#[test]
fn a_slow_machine_moves() {
    let slow: Motion = |time| {
        let [phi, omega, alpha] = vary(time / 30.0);
        [phi, omega / 30.0, alpha / 900.0]
    };
    let encoder = Encoder {
        counts: 65_536.0,
        jitter: 0.0,
    };
    let log = recorded(&PRESS, encoder, slow, 1, TICKS);
    let rows = |max_speed| {
        let settings = IdentificationSettings {
            max_speed,
            ..settings(&PRESS, encoder)
        };
        found::<f32, OF_PRESS>(&settings, &log).rows
    };
    assert!(rows(0.5) > 7000 && rows(14.0) < 5000);
}

/// A repeated step of the law 3-4-5 by an angle in a time, and a rest.
fn steps(time: f64, by: f64, during: f64, rest: f64) -> [f64; 3] {
    let cycle = during + rest;
    let u = ((time % cycle) / during).min(1.0);
    let lift = u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u);
    let speed = 30.0 * (u * (1.0 - u)).powi(2);
    let alpha = 60.0 * u * (1.0 - 3.0 * u + 2.0 * u * u);
    let done = (time / cycle).floor();
    [
        0.4 + by * (done + lift),
        by * speed / during,
        by * alpha / (during * during),
    ]
}

/// The law of Bestehorn: u − sin(2π·u)/2π.
fn bestehorn(time: f64) -> [f64; 3] {
    let u = time % 1.0;
    let (s, c) = (TAU * u).sin_cos();
    [0.4 + TAU * time - s, TAU * (1.0 - c), TAU * TAU * s]
}

/// A crank that runs up in a quarter of its 0.8 s, down in another, and rests.
fn crank(time: f64) -> [f64; 3] {
    let (w, up) = (TAU / 0.6, 0.2);
    let t = time % 1.3;
    let done = 0.4 + TAU * (time / 1.3).floor();
    let left = (0.8 - t).max(0.0);
    if t < up {
        [done + 0.5 * w * t * t / up, w * t / up, w / up]
    } else if left > up {
        [done + w * (t - 0.5 * up), w, 0.0]
    } else {
        let alpha = if left > 0.0 { -w / up } else { 0.0 };
        [
            done + TAU - 0.5 * w * left * left / up,
            w * left / up,
            alpha,
        ]
    }
}

/// Over a turn and back.
fn to_and_fro(time: f64) -> [f64; 3] {
    let w = 0.3 * TAU;
    let (s, c) = (w * time).sin_cos();
    [
        0.5 * TAU * (1.0 - c),
        0.5 * TAU * w * s,
        0.5 * TAU * w * w * c,
    ]
}

/// A cycle that repeats has one speed at each angle, however it accelerates, rests or returns.
#[test]
fn repeated_cycles_have_the_same_speed() {
    let cycles: [(&str, Motion); 6] = [
        ("3-4-5", |time| steps(time, TAU, 1.0, 0.0)),
        ("Bestehorn", bestehorn),
        ("half a turn", |time| steps(time, 0.5 * TAU, 0.6, 0.4)),
        ("turn and rest", |time| steps(time, TAU, 1.0, 0.5)),
        ("crank", crank),
        ("to and fro", to_and_fro),
    ];
    for (name, motion) in cycles {
        let found = status(motion, TICKS, |_| ());
        let said = (name, found.speed_spread);
        assert_eq!(found.status, FoundStatus::SameSpeed, "{said:?}");
    }
    for motion in [vary, other, repeated, swing] {
        let found = status(motion, TICKS, |_| ());
        assert_ne!(found.status, FoundStatus::SameSpeed);
        assert!(found.speed_spread > 0.1, "{}", found.speed_spread);
    }
}

#[test]
fn signals_that_are_wrong_are_named() {
    let reversed = status(vary, TICKS, |log| {
        for (_, torque) in log {
            *torque = -*torque;
        }
    });
    assert_eq!(reversed.status, FoundStatus::Reversed);
    let late = status(vary, TICKS, |log| {
        let torques: Vec<_> = log.iter().map(|(_, torque)| *torque).collect();
        for ((_, torque), earlier) in log.iter_mut().skip(8).zip(torques) {
            *torque = earlier;
        }
    });
    assert_eq!(late.status, FoundStatus::Disturbed, "{}", late.residual);
    // A slip by two degrees.
    let slipped = status(vary, TICKS, |log| {
        for (phase, _) in log.iter_mut().skip(15_000) {
            *phase = Phase::from_bits(phase.to_bits().wrapping_add(1 << 25));
        }
    });
    assert_eq!(slipped.jumps, 1);
}

#[test]
fn missed_ticks_and_nan_leave_the_rest_right() {
    let mut log = recorded(&PRESS, COUNTS_10K, vary, 1, TICKS);
    for k in (1000..29_000).step_by(3000) {
        // Five ticks that never came.
        log.drain(k..k + 5);
        log[k + 1500].1 = [f64::NAN, f64::INFINITY][k % 2];
    }
    let found = found::<f32, OF_PRESS>(&settings(&PRESS, COUNTS_10K), &log);
    assert_eq!(found.status, FoundStatus::Good);
    assert_eq!((found.refused, found.jumps), (10, 10));
    let score = score(&PRESS, &found);
    assert!(
        score.inertia < 0.01 && score.feed_forward < 0.02,
        "{score:?}"
    );
}

#[test]
fn a_sample_says_what_became_of_it() {
    let mut kept = identification::<f32, OF_PRESS>(&settings(&PRESS, BITS_12));
    for k in 0..10u32 {
        assert_eq!(kept.add(Phase::from_bits(k << 20), 1.0), Sampled::Added);
    }
    assert_eq!(kept.add(Phase::from_bits(1 << 31), 1.0), Sampled::Jumped);
    assert_eq!(
        kept.add(Phase::from_bits(1 << 31), f32::NAN),
        Sampled::NotFinite
    );
}

#[test]
fn settings_that_cannot_be_are_refused() {
    let good = settings(&PRESS, BITS_12);
    let refused =
        |settings| Identification::<f32, OF_PRESS, 256, SET>::new(&settings, &[ORDER]).is_err();
    assert!(!refused(good));
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(refused(IdentificationSettings {
            period: bad,
            ..good
        }));
        assert!(refused(IdentificationSettings {
            max_speed: bad,
            ..good
        }));
        assert!(refused(IdentificationSettings {
            inertia: bad,
            ..good
        }));
        assert!(refused(IdentificationSettings {
            torque_noise: bad,
            ..good
        }));
        assert!(refused(IdentificationSettings {
            angle_noise: bad,
            ..good
        }));
        let memory = if bad > 0.0 { 0.5 } else { bad };
        assert!(refused(IdentificationSettings { memory, ..good }));
        let torque_delay = if bad == 0.0 { 0.1 } else { bad };
        assert!(refused(IdentificationSettings {
            torque_delay,
            ..good
        }));
    }
    assert!(refused(IdentificationSettings {
        max_speed: 200.0,
        ..good
    }));
    // Another number of coefficients, a shorter ring, and friction that varies.
    assert!(Identification::<f32, 31, 256, SET>::new(&good, &[ORDER]).is_err());
    assert!(Identification::<f32, OF_PRESS, 256, SET>::new(&good, &[]).is_err());
    assert!(Identification::<f32, OF_PRESS, 64, SET>::new(&good, &[ORDER]).is_err());
    assert!(Identification::<f32, 34, 256, VARYING>::new(&good, &[]).is_err());
    // Cogging of an order that is 0, one of the load's six, or given twice.
    let cogging =
        |orders: [u32; 2]| Identification::<f32, { OF_PRESS + 2 }, 256, SET>::new(&good, &orders);
    assert!(cogging([7, 36]).is_ok());
    for orders in [[0, 36], [36, 1], [6, 36], [36, 36]] {
        let error = cogging(orders).unwrap_err().to_string();
        let value = orders[usize::from(orders[0] == 36)];
        assert_eq!(
            error,
            format!(
                "an order of the cogging is {value}, but must be above the harmonics of the load, and given once"
            )
        );
    }
}
