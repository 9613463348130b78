//! Savitzky-Golay filters of degree 4, and the noise of an encoder.

use super::matrix::{Matrix, dot};

/// Number of coefficients of a polynomial of degree 4.
const TERMS: usize = 5;

/// Position, speed and acceleration.
pub(super) struct Smooth {
    pub(super) position: Vec<f64>,
    pub(super) speed: Vec<f64>,
    pub(super) acceleration: Vec<f64>,
}

/// The powers 0…4 of `u`, differentiated `times` times.
fn powers(u: f64, times: usize) -> [f64; TERMS] {
    std::array::from_fn(|k| {
        if k < times {
            return 0.0;
        }
        let falling: f64 = (k + 1 - times..=k).map(|factor| factor as f64).product();
        falling * u.powi((k - times) as i32)
    })
}

/// Weights of the samples −half…half: the derivative, `times` times, at sample `at` of the polynomial that fits them best.
fn taps(half: usize, at: isize, times: usize, step: f64) -> Vec<f64> {
    let scale = half as f64;
    let places = || (-(half as isize)..=half as isize).map(|j| j as f64 / scale);
    let mut normal = Matrix::zeros(TERMS, TERMS);
    for u in places() {
        let row = powers(u, 0);
        for (i, a) in row.iter().enumerate() {
            for (k, b) in row.iter().enumerate() {
                normal.row_mut(i)[k] += a * b;
            }
        }
    }
    let unit = powers(at as f64 / scale, times).map(|x| x / (scale * step).powi(times as i32));
    // Five different places at least determine the polynomial.
    let Some(inverse) = normal.inverse() else {
        return vec![0.0; 2 * half + 1];
    };
    let weights = inverse.transposed_times(&unit);
    places().map(|u| dot(&powers(u, 0), &weights)).collect()
}

/// Sum of the squares of the weights of a speed.
pub(super) fn speed_noise(half: usize, step: f64) -> f64 {
    let taps = taps(half, 0, 1, step);
    dot(&taps, &taps)
}

/// Half window of a filter whose gain at `cutoff` (Hz) is −3 dB: (2·half + 1 samples, R. W. Schafer, 2011).
pub(super) fn half_window(cutoff: f64, step: f64) -> usize {
    let half = (TERMS as f64 / (2.0 * cutoff * step) + 4.6) / 3.2;
    (half.round() as usize).max(4)
}

/// Smooths; near the ends with the polynomial of the last whole window.
pub(super) fn smooth(y: &[f64], step: f64, half: usize) -> Smooth {
    let half = half.min((y.len().saturating_sub(1)) / 2).max(2);
    let [position, speed, acceleration] = [0, 1, 2].map(|times| {
        let window = 2 * half + 1;
        let centre = taps(half, 0, times, step);
        let begin = (0..half).map(|k| dot(&taps(half, k as isize - half as isize, times, step), y));
        let last = &y[y.len().saturating_sub(window)..];
        let end = (1..=half).map(|k| dot(&taps(half, k as isize, times, step), last));
        let inner = y.windows(window).map(|part| dot(&centre, part));
        begin.chain(inner).chain(end).collect()
    });
    Smooth {
        position,
        speed,
        acceleration,
    }
}

/// Standard deviation of white noise on a smooth signal, by its fourth differences: the mean over all, or, if a few faults would spoil that mean, the
/// median over a hundred blocks.
pub(super) fn noise(y: &[f64], faulty: &[bool]) -> f64 {
    let fourth = y.windows(5).zip(faulty.windows(5));
    let squares: Vec<f64> = fourth
        .filter(|(_, faulty)| !faulty.contains(&true))
        .map(|(y, _)| (y[0] - 4.0 * y[1] + 6.0 * y[2] - 4.0 * y[3] + y[4]).powi(2) / 70.0)
        .collect();
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    if squares.len() < 200 {
        return if squares.is_empty() {
            0.0
        } else {
            mean(&squares).sqrt()
        };
    }
    let count = squares.len();
    let mut blocks: Vec<f64> = (0..100)
        .map(|b| mean(&squares[b * count / 100..(b + 1) * count / 100]))
        .collect();
    blocks.sort_by(f64::total_cmp);
    let median = f64::midpoint(blocks[49], blocks[50]);
    let all = mean(&squares);
    let spoilt = faulty.contains(&true) || all > 1.5 * median && median > 0.0;
    (if spoilt { median } else { all }).sqrt()
}
