//! From points to pieces.

use super::FitMethod;
use super::banded::System;

/// The steps between knots.
fn steps(x: &[f64]) -> Vec<f64> {
    x.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// Mean slopes of the pieces.
fn slopes(y: &[f64], h: &[f64]) -> Vec<f64> {
    let rises = y.windows(2).map(|pair| pair[1] - pair[0]);
    rises.zip(h).map(|(rise, h)| rise / h).collect()
}

/// Pieces over the range of the points.
pub(super) fn bounded(x: &[f64], y: &[f64], way: FitMethod) -> Vec<[f64; 4]> {
    let h = steps(x);
    match way {
        FitMethod::Interpolating => by_curvature(y, &h, &cubic(y, &h, [false; 2])),
        FitMethod::Level => by_curvature(y, &h, &cubic(y, &h, [true; 2])),
        FitMethod::Resting => {
            let free = by_curvature(y, &h, &cubic(y, &h, [false; 2]));
            by_curvature(y, &h, &cubic(y, &h, rests(&free, &h)))
        }
        FitMethod::Monotone => {
            let mean = slopes(y, &h);
            let last = mean.len() - 1;
            let inner = (1..y.len() - 1).map(|k| steffen([mean[k - 1], mean[k]], [h[k - 1], h[k]]));
            let first = end_slope([mean[0], mean[1]], [h[0], h[1]]);
            let end = end_slope([mean[last], mean[last - 1]], [h[last], h[last - 1]]);
            let tangents: Vec<f64> = [first].into_iter().chain(inner).chain([end]).collect();
            by_slope(y, &h, &at_zero(y, tangents))
        }
        FitMethod::Smoothing(cutoff) => {
            let stiffness = cutoff.powi(-4);
            let (values, curvature) = smooth_bounded(y, &h, stiffness);
            by_curvature(&values, &h, &curvature)
        }
    }
}

/// Pieces over one period; `knots` has one more knot, the end.
pub(super) fn periodic(knots: &[f64], y: &[f64], way: FitMethod) -> Vec<[f64; 4]> {
    let h = steps(knots);
    let closed = |values: &[f64]| -> Vec<f64> {
        let first = values.first().copied();
        values.iter().copied().chain(first).collect()
    };
    let n = y.len();
    let mean = slopes(&closed(y), &h);
    match way {
        FitMethod::Monotone => {
            let before = |k: usize| (k + n - 1) % n;
            let tangent = |k: usize| steffen([mean[before(k)], mean[k]], [h[before(k)], h[k]]);
            let tangents = at_zero(y, (0..n).map(tangent).collect());
            by_slope(&closed(y), &h, &closed(&tangents))
        }
        FitMethod::Interpolating | FitMethod::Level | FitMethod::Resting => {
            let (_, curvature) = ring(y, &h, &mean, 0.0);
            by_curvature(&closed(y), &h, &closed(&curvature))
        }
        FitMethod::Smoothing(cutoff) => {
            let (values, curvature) = ring(y, &h, &mean, cutoff.powi(-4));
            by_curvature(&closed(&values), &h, &closed(&curvature))
        }
    }
}

/// Cubic pieces from values and second derivatives at the knots.
fn by_curvature(y: &[f64], h: &[f64], m: &[f64]) -> Vec<[f64; 4]> {
    let piece = |k: usize| {
        let (h, rise) = (h[k], y[k + 1] - y[k]);
        let slope = rise / h - h * (2.0 * m[k] + m[k + 1]) / 6.0;
        [y[k], slope, m[k] / 2.0, (m[k + 1] - m[k]) / (6.0 * h)]
    };
    (0..h.len()).map(piece).collect()
}

/// Cubic pieces from values and slopes at the knots.
fn by_slope(y: &[f64], h: &[f64], t: &[f64]) -> Vec<[f64; 4]> {
    let piece = |k: usize| {
        let h = h[k];
        let mean = (y[k + 1] - y[k]) / h;
        let [a, b] = [t[k], t[k + 1]];
        [
            y[k],
            a,
            (3.0 * mean - 2.0 * a - b) / h,
            (a + b - 2.0 * mean) / (h * h),
        ]
    };
    (0..h.len()).map(piece).collect()
}

/// Slope between two pieces with mean slopes s: zero at an extreme, else the parabola's, at most twice the flatter one.
fn steffen(s: [f64; 2], h: [f64; 2]) -> f64 {
    if s[0] * s[1] <= 0.0 {
        return 0.0;
    }
    let parabola = (s[0] * h[1] + s[1] * h[0]) / (h[0] + h[1]);
    let most = 2.0 * s[0].abs().min(s[1].abs());
    parabola.clamp(-most, most)
}

/// Slope at an end: that of the parabola through three points, not opposite to the first piece and at most twice its slope.
fn end_slope(s: [f64; 2], h: [f64; 2]) -> f64 {
    let parabola = s[0] + (s[0] - s[1]) * h[0] / (h[0] + h[1]);
    if parabola * s[0] <= 0.0 {
        0.0
    } else {
        parabola.clamp(-2.0 * s[0].abs(), 2.0 * s[0].abs())
    }
}

/// Makes a curve level where it is zero, so that it stays on its side.
fn at_zero(y: &[f64], mut tangents: Vec<f64>) -> Vec<f64> {
    for (tangent, _) in tangents.iter_mut().zip(y).filter(|(_, y)| **y == 0.0) {
        *tangent = 0.0;
    }
    tangents
}

/// Second derivatives of a spline: at each end level, or with the outer two pieces being one cubic.
fn cubic(y: &[f64], h: &[f64], level: [bool; 2]) -> Vec<f64> {
    let mean = slopes(y, h);
    let last = h.len() - 1;
    let (first, value) = if level[0] {
        ([0.0, 0.0, 2.0 * h[0], h[0], 0.0], 6.0 * mean[0])
    } else {
        ([0.0, 0.0, h[1], -(h[0] + h[1]), h[0]], 0.0)
    };
    let (mut rows, mut right) = (vec![first], vec![value]);
    for k in 1..=last {
        rows.push([0.0, h[k - 1], 2.0 * (h[k - 1] + h[k]), h[k], 0.0]);
        right.push(6.0 * (mean[k] - mean[k - 1]));
    }
    let (end, value) = if level[1] {
        ([0.0, h[last], 2.0 * h[last], 0.0, 0.0], -6.0 * mean[last])
    } else {
        (
            [h[last], -(h[last - 1] + h[last]), h[last - 1], 0.0, 0.0],
            0.0,
        )
    };
    rows.push(end);
    right.push(value);
    System { rows, right }.solve()
}

/// Whether a curve rests at each of its ends: its slope there is at most a quarter of that of the outer chord, or opposite to it. Under a constant
/// acceleration from rest it is zero; at constant speed it is that of the chord.
fn rests(pieces: &[[f64; 4]], h: &[f64]) -> [bool; 2] {
    let still = |slope: f64, chord: f64| slope * chord <= 0.25 * chord * chord;
    let [first, last] = [0, h.len() - 1].map(|k| {
        let ([_, b, c, d], h) = (pieces[k], h[k]);
        let end = b + h * (2.0 * c + 3.0 * d * h);
        ([b, end], b + h * (c + d * h))
    });
    [still(first.0[0], first.1), still(last.0[1], last.1)]
}

/// Column k of Q, which takes values to jumps of the slope: its entries at the knots k − 1, k, k + 1.
fn jump(before: f64, after: f64) -> [f64; 3] {
    [1.0 / before, -1.0 / before - 1.0 / after, 1.0 / after]
}

/// Row of R + λ·Qᵀ·W⁻¹·Q and the two columns of Q for the knot between the steps `h[1]` and `h[2]`; `h[0]` and `h[3]` are the outer steps, the
/// weights belong to the three knots.
fn reinsch(h: [f64; 4], weights: [f64; 3], stiffness: f64) -> [f64; 5] {
    let [before, this, after] = [[h[0], h[1]], [h[1], h[2]], [h[2], h[3]]].map(|[a, b]| jump(a, b));
    let [w0, w1, w2] = weights;
    let bend = [
        this[0] * before[1] / w0 + this[1] * before[2] / w1,
        this[0] * this[0] / w0 + this[1] * this[1] / w1 + this[2] * this[2] / w2,
        this[1] * after[0] / w1 + this[2] * after[1] / w2,
    ];
    [
        stiffness * this[0] * before[0] / w0,
        h[1] / 6.0 + stiffness * bend[0],
        (h[1] + h[2]) / 3.0 + stiffness * bend[1],
        h[2] / 6.0 + stiffness * bend[2],
        stiffness * this[2] * after[2] / w2,
    ]
}

/// Smoothed values and second derivatives around a ring; without stiffness the values themselves.
fn ring(y: &[f64], h: &[f64], mean: &[f64], stiffness: f64) -> (Vec<f64>, Vec<f64>) {
    let n = y.len();
    let step = |k: usize, offset: usize| h[(k + n + offset - 2) % n];
    let weight = |k: usize, offset: usize| f64::midpoint(step(k, offset), step(k, offset + 1));
    let row = |k: usize| {
        reinsch(
            [step(k, 0), step(k, 1), step(k, 2), step(k, 3)],
            [weight(k, 0), weight(k, 1), weight(k, 2)],
            stiffness,
        )
    };
    let system = System {
        rows: (0..n).map(row).collect(),
        right: (0..n).map(|k| mean[k] - mean[(k + n - 1) % n]).collect(),
    };
    let curvature = system.solve_ring();
    let at = |k: usize| curvature[k % n];
    let value = |k: usize| {
        let pull = (at(k + 1) - at(k)) / step(k, 2) - (at(k) - at(k + n - 1)) / step(k, 1);
        y[k] - stiffness * pull / weight(k, 1)
    };
    ((0..n).map(value).collect(), curvature)
}

/// Smoothed values and second derivatives of a chain, straight at its ends.
fn smooth_bounded(y: &[f64], h: &[f64], stiffness: f64) -> (Vec<f64>, Vec<f64>) {
    let n = y.len();
    let mean = slopes(y, h);
    // Beyond the ends the steps continue; their coefficients are zero.
    let step = |k: usize, offset: usize| {
        let index = (k + offset).saturating_sub(2).min(h.len() - 1);
        h[index]
    };
    let weight = |k: usize| match k {
        0 => h[0] / 2.0,
        k if k == n - 1 => h[n - 2] / 2.0,
        k => f64::midpoint(h[k - 1], h[k]),
    };
    let row = |k: usize| {
        let mut row = reinsch(
            [step(k, 0), step(k, 1), step(k, 2), step(k, 3)],
            [weight(k - 1), weight(k), weight(k + 1)],
            stiffness,
        );
        for (offset, value) in row.iter_mut().enumerate() {
            // The second derivative at the first and the last point is zero.
            if !(1..n - 1).contains(&(k + offset).saturating_sub(2)) {
                *value = 0.0;
            }
        }
        row
    };
    let system = System {
        rows: (1..n - 1).map(row).collect(),
        right: (1..n - 1).map(|k| mean[k] - mean[k - 1]).collect(),
    };
    let mut curvature = vec![0.0];
    curvature.extend(system.solve());
    curvature.push(0.0);
    let pull = |k: usize| {
        let after = if k + 1 < n {
            (curvature[k + 1] - curvature[k]) / h[k]
        } else {
            0.0
        };
        let before = if k > 0 {
            (curvature[k] - curvature[k - 1]) / h[k - 1]
        } else {
            0.0
        };
        after - before
    };
    let value = |k: usize| y[k] - stiffness * pull(k) / weight(k);
    ((0..n).map(value).collect(), curvature)
}
