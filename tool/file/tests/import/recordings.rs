//! Recorded motions: speeds and positions at any times, with noise, and how cycles close.

use std::f64::consts::TAU;
use std::fmt::Write;

use jred_file::model::motion::Motion;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use super::parse;
use crate::reading::belt_drive;
use crate::support::budget;

/// A belt drive that is the same after whole turns only.
fn machine(more: &str) -> String {
    belt_drive(&format!(
        "[[load]]\non = \"shaft-1\"\nopposing_moment = \"1 N m\"\nbetween = [\"20 deg\", \"60 deg\"]\nramp = \"5 deg\"\n\
         [motion]\ntype = \"profile\"\nfile = \"log.csv\"\n{more}"
    ))
}

fn read(csv: &str, more: &str) -> Result<Motion, String> {
    parse(&machine(more), &[("log.csv", csv)]).map(|file| file.motion.unwrap())
}

const DURATION: f64 = 0.8;

/// φ = 2π·(z − 0.12·sin(2πz)), z = t/T: one turn.
fn exact(t: f64) -> [f64; 3] {
    let (z, w) = (t / DURATION, TAU / DURATION);
    let (sin, cos) = (TAU * z).sin_cos();
    [
        TAU * (z - 0.12 * sin),
        w * (1.0 - 0.12 * TAU * cos),
        w * w * 0.12 * TAU * sin,
    ]
}

/// Times that wander around equal steps, the ends in place.
fn times(rows: usize, jitter: f64) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    (0..=rows)
        .map(|k| {
            let off = if k == 0 || k == rows {
                0.0
            } else {
                random.random_range(-jitter..=jitter)
            };
            DURATION * (k as f64 + off) / rows as f64
        })
        .collect()
}

fn worst(motion: &Motion) -> [f64; 3] {
    let mut worst = [0.0f64; 3];
    for k in 0..=3000 {
        let t = DURATION * f64::from(k) / 3000.0;
        let state = motion.at(t);
        let found = [state.phi, state.omega, state.alpha];
        for (worst, (a, b)) in worst.iter_mut().zip(found.into_iter().zip(exact(t))) {
            *worst = worst.max((a - b).abs());
        }
    }
    worst
}

/// A recording of positions with a wandering clock: errors of order h⁴, h³, h² of the spline, with h the largest step.
#[test]
fn uneven_times_need_no_resampling() {
    let rows = 200;
    let mut csv = String::from("t [s],phi [rad]\n");
    for t in times(rows, 0.3) {
        writeln!(csv, "{t:e},{:e}", exact(t)[0]).unwrap();
    }
    let motion = read(&csv, "").unwrap();
    let (h, w) = (1.6 * DURATION / rows as f64, TAU / DURATION);
    let fourth = 0.12 * TAU * w.powi(4);
    let [phi, omega, alpha] = worst(&motion);
    println!("phi {phi:.1e} rad, omega {omega:.1e} rad/s, alpha {alpha:.1e} rad/s^2");
    assert!(
        phi < 5.0 / 384.0 * fourth * h.powi(4) && phi > 1e-10,
        "{phi:e}"
    );
    assert!(
        omega < fourth * h.powi(3) / 8.0 && omega > 1e-8,
        "{omega:e}"
    );
    assert!(
        alpha < fourth * h.powi(2) / 2.0 && alpha > 1e-5,
        "{alpha:e}"
    );
}

/// Speeds: the position is the integral of the spline, and ends after a whole turn.
#[test]
fn speeds_are_integrated() {
    let mut csv = String::from("time [ms];n [rpm]\n");
    for t in times(200, 0.3) {
        let rpm = exact(t)[1] * 30.0 / std::f64::consts::PI;
        writeln!(
            csv,
            "{};{}",
            (t * 1e3).to_string().replace('.', ","),
            rpm.to_string().replace('.', ",")
        )
        .unwrap();
    }
    let motion = read(&csv, "start = \"0 deg\"").unwrap();
    assert!(motion.cyclic);
    let [phi, omega, alpha] = worst(&motion);
    println!("phi {phi:.1e} rad, omega {omega:.1e} rad/s, alpha {alpha:.1e} rad/s^2");
    assert!(
        phi < 1e-7 && omega < 1e-5 && alpha < 1e-2,
        "{phi:e} {omega:e} {alpha:e}"
    );
    let [start, end] = [motion.at(0.0), motion.at(DURATION)];
    assert!((end.phi - start.phi - TAU).abs() < 1e-12);
    assert!((end.omega - start.omega).abs() < 1e-9 && (end.alpha - start.alpha).abs() < 1e-6);
    let later = read(&csv, "start = \"30 deg\"").unwrap();
    assert!((later.at(0.3).phi - motion.at(0.3).phi - 30f64.to_radians()).abs() < 1e-12);
}

/// Without a time column, at a fixed step; not repeating.
#[test]
fn rows_at_a_fixed_step_need_no_times() {
    let mut csv = String::from("omega [rad/s]\n");
    for k in 0..=50 {
        // ω = 40·t³: a cubic comes back exactly, φ = 10·t⁴.
        let t = f64::from(k) * 2e-3;
        writeln!(csv, "{:e}", 40.0 * t * t * t).unwrap();
    }
    let motion = read(&csv, "step = \"2 ms\"\ncyclic = false").unwrap();
    assert!((motion.duration() - 0.1).abs() < 1e-15);
    for k in 1..100 {
        let t = f64::from(k) * 1e-3;
        let state = motion.at(t);
        assert!((state.phi - 10.0 * t.powi(4)).abs() < 1e-14, "{t}");
        assert!(
            (state.alpha - 120.0 * t * t).abs() < 1e-9,
            "{t}: {}",
            state.alpha
        );
    }
}

/// Noise on the speed: the acceleration of the curve through every row is worthless, the smoothed one is not; and smoothing takes
/// off what its response says.
#[test]
fn smoothing_makes_a_log_usable() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut csv = String::from("t [s],omega [rad/s]\n");
    let clean = times(800, 0.2);
    for (k, t) in clean.iter().enumerate() {
        let noise = if k == 0 || k == 800 {
            0.0
        } else {
            random.random_range(-0.02..0.02)
        };
        writeln!(csv, "{t:e},{:e}", exact(*t)[1] + noise).unwrap();
    }
    let rough = read(&csv, "close_within = \"0.5 deg\"").unwrap();
    let smooth = read(&csv, "smoothing = \"20 Hz\"\nclose_within = \"0.5 deg\"").unwrap();
    let (rough, smooth) = (worst(&rough), worst(&smooth));
    let peak = 0.12 * TAU * (TAU / DURATION).powi(2);
    println!(
        "acceleration of {peak:.1}: off by {:.2} as it is, {:.2} smoothed at 20 Hz",
        rough[2], smooth[2]
    );
    assert!(rough[2] > 0.5 * peak, "{}", rough[2]);
    assert!(smooth[2] < budget::SMOOTHED_LOG * peak, "{}", smooth[2]);
    // The noise itself adds up to 0.02/√3·√(0.8 s·1 ms) rad.
    assert!(smooth[0] < 1e-3, "{:e}", smooth[0]);
}

/// A cycle that misses its end is refused, with the width to allow; then it closes.
#[test]
fn a_cycle_that_does_not_close_says_by_how_much() {
    let mut csv = String::from("t [s],omega [rad/s]\n");
    for k in 0..=100 {
        let t = DURATION * f64::from(k) / 100.0;
        writeln!(csv, "{t:e},{:e}", exact(t)[1] * 1.002).unwrap();
    }
    let refused = read(&csv, "").unwrap_err();
    for word in [
        "deg beyond a whole number of turns",
        "close_within = \"0.76 deg\"",
        "cyclic = false",
    ] {
        assert!(refused.contains(word), "{word:?} is not in\n{refused}");
    }
    let motion = read(&csv, "close_within = \"0.76 deg\"").unwrap();
    assert!((motion.at(DURATION).phi - motion.at(0.0).phi - TAU).abs() < 1e-12);
    // The constant speed that closes it.
    let taken = motion.at(0.2).omega - 1.002 * exact(0.2)[1];
    assert!((taken + 0.002 * TAU / DURATION).abs() < 1e-6, "{taken}");
    assert!(read(&csv, "cyclic = false").is_ok());
}
