//! The noise of a recorded motion: the scatter of its rows, and its effect on the curve through them.
//!
//! A row differs from the cubic through its four neighbours, two on each side, by a combination of five independent errors, for any motion:
//!
//! ```text
//! r = y − Σ L·y        σ² = r²/(1 + Σ L²)        L = −1/6, 4/6, 4/6, −1/6 at equal steps: 70/36
//! ```
//!
//! The median magnitude of these is 0.6745·σ for normal errors, and corners of the motion do not change it. Errors of rows make neighbouring r
//! alternate (their correlation is −0.8 at equal steps); where the motion itself bends faster than a cubic, neighbouring r have the same sign.
//!
//! For rows at steps h the interpolating spline has errors of 1.18·σ/h in its first derivative and 6·σ/h² in its second (RMS: the means over all
//! frequencies of its response to a sine), the smoothing spline with the cut-off ω has σ·√(h·ω³/(8·√2)) and σ·√(h·ω⁵/(8·√2)).

use crate::math;
use std::f64::consts::TAU;

use super::Motion;
use super::piece::PieceKind;
use crate::number::spline::Spline;

/// Median magnitude of normal errors with σ = 1.
const MEDIAN: f64 = 0.674_489_75;

/// Correlation of neighbouring rows above which the motion itself bends.
const ALTERNATES: f64 = -0.4;

/// Interpolating spline: errors of the first and the second derivative, times σ/h and σ/h².
const FIRST: f64 = 1.179_960;
const SECOND: f64 = 6.0;

/// Fewest rows for an estimate of the usual scatter.
const MIN_ROWS: usize = 32;

/// Share of the motion's acceleration that noise may have after smoothing.
const SMOOTHED_NOISE: f64 = 0.05;

/// Least ratio of successive cut-off frequencies.
const STEP: f64 = 1.25;

/// Noise of a recorded motion in its prescribed coordinate, all RMS values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Whether speeds were recorded, not positions.
    pub of_speeds: bool,
    /// Noise of the rows (rad or m, or per s).
    pub rows: f64,
    /// Noise of the speed (per s).
    pub speed: f64,
    /// Noise of the acceleration (per s²).
    pub acceleration: f64,
    /// The acceleration of the curve itself, including noise (per s²).
    pub of_acceleration: f64,
}

impl Motion {
    /// The noise of a recorded motion whose curve passes through every row; `None` if rows do not scatter, and for other motions.
    pub fn noise(&self) -> Option<Noise> {
        let (curve, of_speeds) = self.curve()?;
        let (t, y) = curve.points();
        let rows = scatter(&t, &y)?;
        let h = usual_step(&t)?;
        let order = if of_speeds { 1 } else { 2 };
        let [speed, acceleration] = if of_speeds {
            [rows, FIRST * rows / h]
        } else {
            [FIRST * rows / h, SECOND * rows / (h * h)]
        };
        Some(Noise {
            of_speeds,
            rows,
            speed,
            acceleration,
            of_acceleration: derivative(curve, &t, order),
        })
    }

    /// The highest cut-off frequency (Hz) of `smoothing` that reduces the noise to 5 % of the acceleration; `None` if no cut-off does.
    pub fn quiet_cutoff(&self, noise: &Noise) -> Option<f64> {
        let (curve, of_speeds) = self.curve()?;
        let (t, _) = curve.points();
        let order = if of_speeds { 1 } else { 2 };
        smoothing(curve, &t, order, noise.rows)
    }

    /// The curve through the rows of a recorded motion, and whether it is a curve of speeds.
    pub(super) fn curve(&self) -> Option<(&Spline, bool)> {
        match self.pieces.as_slice() {
            [piece] => match &piece.kind {
                PieceKind::Positions { curve, .. } => Some((curve, false)),
                PieceKind::Speeds { curve, .. } => Some((curve, true)),
                _ => None,
            },
            _ => None,
        }
    }
}

/// The median of the steps.
pub(super) fn usual_step(t: &[f64]) -> Option<f64> {
    middle(t.windows(2).map(|pair| pair[1] - pair[0]))
}

fn middle(figures: impl Iterator<Item = f64>) -> Option<f64> {
    let mut figures: Vec<f64> = figures.collect();
    figures.sort_by(f64::total_cmp);
    figures.get(figures.len() / 2).copied()
}

/// Deviation of each row, except the two at either end, from the cubic through its four neighbours, and the factor from the error of one row to that
/// of the deviation.
pub(super) fn residuals<'c>(t: &'c [f64], y: &'c [f64]) -> impl Iterator<Item = [f64; 2]> + 'c {
    t.windows(5).zip(y.windows(5)).map(|(t, y)| {
        let (mut missed, mut square) = (y[2], 1.0);
        for i in [0, 1, 3, 4] {
            let others = [0, 1, 3, 4].into_iter().filter(|j| *j != i);
            let weight: f64 = others.map(|j| (t[2] - t[j]) / (t[i] - t[j])).product();
            missed -= weight * y[i];
            square += weight * weight;
        }
        [missed, square.sqrt()]
    })
}

/// The median magnitude of the residuals above rounding, if there are enough; otherwise the rounding. Residuals at rest are rounding.
pub(super) fn usual(residuals: impl Iterator<Item = f64>, y: &[f64]) -> Option<f64> {
    let rounding = rounding(y);
    let sizes: Vec<f64> = (residuals.map(f64::abs))
        .filter(|r| *r > rounding)
        .collect();
    if sizes.len() < MIN_ROWS {
        return Some(rounding);
    }
    middle(sizes.into_iter())
}

/// Magnitude of a residual from the last digits of the numbers.
fn rounding(y: &[f64]) -> f64 {
    16.0 * f64::EPSILON * y.iter().fold(0.0_f64, |most, y| most.max(y.abs()))
}

/// σ of the rows, if they scatter.
fn scatter(t: &[f64], y: &[f64]) -> Option<f64> {
    let residuals: Vec<f64> = residuals(t, y).map(|[missed, of]| missed / of).collect();
    let middle = usual(residuals.iter().copied(), y)?;
    if middle <= rounding(y) {
        return None;
    }
    // At a corner the residual is not representative.
    let cut = |r: &f64| r.clamp(-4.0 * middle, 4.0 * middle);
    let products = residuals
        .windows(2)
        .map(|pair| cut(&pair[0]) * cut(&pair[1]));
    let squares = residuals.iter().map(|r| cut(r) * cut(r));
    let alternates = products.sum::<f64>() < ALTERNATES * squares.sum::<f64>();
    alternates.then_some(middle / MEDIAN)
}

/// RMS of a derivative of the curve at its rows.
fn derivative(curve: &Spline, t: &[f64], order: usize) -> f64 {
    let squares = t.iter().map(|t| curve.at(*t)[order].powi(2));
    (squares.sum::<f64>() / t.len() as f64).sqrt()
}

/// The highest cut-off (Hz) at which the noise of the acceleration is a small part of it.
fn smoothing(curve: &Spline, t: &[f64], order: usize, rows: f64) -> Option<f64> {
    let h = usual_step(t)?;
    let duration = curve.range()[1] - curve.range()[0];
    let [lowest, highest] = super::recording::cutoffs(t.len(), duration);
    let power = if order == 2 { 5 } else { 3 };
    let noise = |omega: f64| rows * (h * omega.powi(power) / 128.0_f64.sqrt()).sqrt();
    let mut cutoff = highest;
    while cutoff >= lowest {
        let omega = TAU * cutoff;
        let smooth = curve.smoothed(omega).ok()?;
        let allowed = SMOOTHED_NOISE * derivative(&smooth, t, order);
        if noise(omega) <= allowed {
            return Some(cutoff);
        }
        // A lower cut-off leaves no more of the acceleration, so the allowed noise does not grow.
        let allows = math::pow(allowed / noise(omega), 2.0 / f64::from(power));
        cutoff *= allows.min(1.0 / STEP);
    }
    None
}
