//! An independent search: polynomials with fourteen free coefficients over the time, by the Levenberg-Marquardt method.

use jred::mechanism::TrainOutput;
use jred_file::model::machine::MachineFile;
use jred_motion::gentlest::{Objective, Travel};

use super::{best, example, travel};

const COEFFICIENTS: usize = 14;
const POINTS: usize = 400;

/// Position, speed and acceleration: the law of third degree and τ²·(1 − τ)² times a series of Chebyshev's polynomials.
fn state(travel: &Travel, c: &[f64; COEFFICIENTS], tau: f64) -> [f64; 3] {
    let (d, t) = (travel.distance, travel.duration);
    let mut s = [
        tau * tau * (3.0 - 2.0 * tau),
        6.0 * tau * (1.0 - tau),
        6.0 - 12.0 * tau,
    ];
    let (q, q1) = (tau * (1.0 - tau), 1.0 - 2.0 * tau);
    let window = [q * q, 2.0 * q * q1, 2.0 * q1 * q1 - 4.0 * q];
    let z = 2.0 * tau - 1.0;
    let (mut before, mut own) = ([0.0; 3], [1.0, 0.0, 0.0]);
    for (k, c) in c.iter().enumerate() {
        s[0] += c * window[0] * own[0];
        s[1] += c * (window[1] * own[0] + window[0] * own[1]);
        s[2] += c * (window[2] * own[0] + 2.0 * window[1] * own[1] + window[0] * own[2]);
        // T_{k+1} = 2z·T_k − T_{k−1}; the first step is z. Derivatives by τ: dz/dτ = 2.
        let factor = if k == 0 { 1.0 } else { 2.0 };
        let next = [
            factor * z * own[0] - before[0],
            factor * (z * own[1] + 2.0 * own[0]) - before[1],
            factor * (z * own[2] + 4.0 * own[1]) - before[2],
        ];
        (before, own) = (own, next);
    }
    [travel.start + d * s[0], d * s[1] / t, d * s[2] / (t * t)]
}

/// √weight·T at points of equal weight between the ends.
fn torques(file: &MachineFile, travel: &Travel, c: &[f64; COEFFICIENTS]) -> Vec<f64> {
    let point = |k: usize| {
        let tau = (k as f64 + 0.5) / POINTS as f64;
        let [phi, omega, alpha] = state(travel, c, tau);
        let reduction = file.bare_reduction(phi).unwrap();
        let input = file.drive_train.input(&TrainOutput {
            torque: reduction.torque(omega, alpha).total(),
            torque_per_alpha: 0.0,
            omega,
            alpha,
            direction: omega,
        });
        input.torque * (travel.duration / POINTS as f64).sqrt()
    };
    (0..POINTS).map(point).collect()
}

/// The least ∫T² of the family, by the midpoint rule.
fn search(file: &MachineFile, travel: &Travel) -> f64 {
    let squares = |r: &[f64]| r.iter().map(|r| r * r).sum::<f64>();
    let mut c = [0.0; COEFFICIENTS];
    let mut r = torques(file, travel, &c);
    let mut damping = 1e-3;
    for _ in 0..80 {
        let columns: Vec<Vec<f64>> = (0..COEFFICIENTS)
            .map(|k| {
                let mut moved = c;
                moved[k] += 1e-6;
                let moved = torques(file, travel, &moved);
                moved.iter().zip(&r).map(|(a, b)| (a - b) / 1e-6).collect()
            })
            .collect();
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut rows: Vec<Vec<f64>> = (0..COEFFICIENTS)
            .map(|i| {
                let mut row: Vec<f64> = columns
                    .iter()
                    .map(|own| product(&columns[i], own))
                    .collect();
                row[i] *= 1.0 + damping;
                row.push(-product(&columns[i], &r));
                row
            })
            .collect();
        for k in 0..COEFFICIENTS {
            let pivot = rows[k].clone();
            for (i, row) in rows.iter_mut().enumerate() {
                if i != k {
                    let factor = row[k] / pivot[k];
                    row.iter_mut()
                        .zip(&pivot)
                        .for_each(|(x, p)| *x -= factor * p);
                }
            }
        }
        let mut moved = c;
        for (k, value) in moved.iter_mut().enumerate() {
            *value += rows[k][COEFFICIENTS] / rows[k][k];
        }
        let next = torques(file, travel, &moved);
        if squares(&next) < squares(&r) {
            (c, r) = (moved, next);
            damping *= 0.3;
        } else {
            damping *= 5.0;
        }
    }
    squares(&r)
}

/// For three machines no polynomial of fourteen coefficients has a lower cost, up to the error of the midpoint rule; they come close, so the search
/// works.
#[test]
fn no_polynomial_takes_less() {
    let loads = [
        ("press", 3.7, 2.2, 0.12),
        ("four-bar", 0.6, 2.6, 0.45),
        ("six-link", 1.0, 2.0, 0.3),
    ];
    for (name, start, distance, duration) in loads {
        let file = example(name, &[]);
        let travel = travel(start, distance, duration);
        let found = best(&file, &travel, Objective::Rms);
        let searched = search(&file, &travel);
        let ratio = found.cost / searched;
        assert!(
            ratio < 1.0 + 1e-4,
            "{name}: {} against {searched}",
            found.cost
        );
        assert!(ratio > 0.95, "{name}: {} against {searched}", found.cost);
    }
}
