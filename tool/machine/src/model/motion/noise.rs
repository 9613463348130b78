//! The noise of a recorded motion: how far its rows scatter, and what the curve through them makes of it.
//!
//! A row misses the cubic through its four neighbours, two on each side, by a combination of five independent errors, whatever the motion:
//!
//! ```text
//! r = y − Σ L·y        σ² = r²/(1 + Σ L²)        L = −1/6, 4/6, 4/6, −1/6 at equal steps: 70/36
//! ```
//!
//! The middle magnitude of these is 0.6745·σ of normal errors, and corners of the motion do not move it. Errors of rows make neighbouring r
//! alternate (their correlation is −0.8 at equal steps); where the motion itself bends faster than a cubic they go together.
//!
//! Of rows at steps h the interpolating spline makes errors of 1.18·σ/h in its first derivative and 6·σ/h² in its second (RMS: the means
//! over all frequencies of its response to a sine), the smoothing one with the cut-off ω σ·√(h·ω³/(8·√2)) and σ·√(h·ω⁵/(8·√2)).

use std::f64::consts::TAU;

use super::Motion;
use super::piece::Kind;
use crate::number::spline::Spline;

/// Middle magnitude of normal errors of one.
const MIDDLE: f64 = 0.674_489_75;

/// Correlation of neighbouring rows above which it is the motion that bends.
const ALTERNATES: f64 = -0.4;

/// Of the interpolating spline: errors of the first and the second derivative, times σ/h and σ/h².
const FIRST: f64 = 1.179_960;
const SECOND: f64 = 6.0;

/// The fewest rows that tell how much rows usually scatter.
const SOME: usize = 32;

/// Share of the acceleration of the motion that noise may have after smoothing.
const QUIET: f64 = 0.05;

/// Cut-off frequencies that are tried lie in this ratio at least.
const STEP: f64 = 1.25;

/// Noise of a recorded motion, all RMS values, of what it prescribes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Whether speeds were recorded, not positions.
    pub of_speeds: bool,
    /// Of the rows (rad or m, or per s).
    pub rows: f64,
    /// Of the speed (per s).
    pub speed: f64,
    /// Of the acceleration (per s²).
    pub acceleration: f64,
    /// The acceleration of the curve itself, noise included (per s²).
    pub of_acceleration: f64,
}

impl Motion {
    /// The noise of a recorded motion whose curve goes through every row; `None` where rows do not scatter, and of other motions.
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

    /// The highest cut-off frequency (Hz) of `smoothing` that leaves the noise 5 % of the acceleration; `None`: there is none.
    pub fn quiet_cutoff(&self, noise: &Noise) -> Option<f64> {
        let (curve, of_speeds) = self.curve()?;
        let (t, _) = curve.points();
        let order = if of_speeds { 1 } else { 2 };
        smoothing(curve, &t, order, noise.rows)
    }

    /// The curve through the rows of a recorded motion, and whether it is one of speeds.
    pub(super) fn curve(&self) -> Option<(&Spline, bool)> {
        match self.pieces.as_slice() {
            [piece] => match &piece.kind {
                Kind::Positions { curve, .. } => Some((curve, false)),
                Kind::Speeds { curve, .. } => Some((curve, true)),
                _ => None,
            },
            _ => None,
        }
    }
}

/// The middle one of the steps.
pub(super) fn usual_step(t: &[f64]) -> Option<f64> {
    middle(t.windows(2).map(|pair| pair[1] - pair[0]))
}

fn middle(figures: impl Iterator<Item = f64>) -> Option<f64> {
    let mut figures: Vec<f64> = figures.collect();
    figures.sort_by(f64::total_cmp);
    figures.get(figures.len() / 2).copied()
}

/// How far each row but the two at either end misses the cubic through its four neighbours, and how many errors of one row that is.
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

/// The middle magnitude of those residuals that are more than rounding, where there are some: a rest has none; else the rounding.
pub(super) fn usual(residuals: impl Iterator<Item = f64>, y: &[f64]) -> Option<f64> {
    let rounding = rounding(y);
    let sizes: Vec<f64> = (residuals.map(f64::abs))
        .filter(|r| *r > rounding)
        .collect();
    if sizes.len() < SOME {
        return Some(rounding);
    }
    middle(sizes.into_iter())
}

/// Magnitude of a residual that is one of the last digits of the numbers themselves.
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
    // Where a corner is, a residual is no measure of the rest.
    let cut = |r: &f64| r.clamp(-4.0 * middle, 4.0 * middle);
    let products = residuals
        .windows(2)
        .map(|pair| cut(&pair[0]) * cut(&pair[1]));
    let squares = residuals.iter().map(|r| cut(r) * cut(r));
    let alternates = products.sum::<f64>() < ALTERNATES * squares.sum::<f64>();
    alternates.then_some(middle / MIDDLE)
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
        let allowed = QUIET * derivative(&smooth, t, order);
        if noise(omega) <= allowed {
            return Some(cutoff);
        }
        // A lower cut-off leaves no more of the acceleration, and may have no more noise than that allows.
        let allows = (allowed / noise(omega)).powf(2.0 / f64::from(power));
        cutoff *= allows.min(1.0 / STEP);
    }
    None
}
