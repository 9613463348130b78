//! A row of a recorded motion that does not match its neighbours.
//!
//! A wrong value makes the rows around it deviate from the cubic through their neighbours as (1, −4, 6, −4, 1)/6, a jump of the position as (1, −3,
//! 3, −1)/6, and a jump of the speed at a row as (1, −2, 1)/6: the sign of the middle row is opposite to both neighbours. A jump of the acceleration,
//! which a motion may have, never gives this pattern.

use super::Motion;
use super::noise::{residuals, usual, usual_step};

/// Residuals next to that of an outlier, as shares of it.
const BESIDE: [f64; 2] = [-1.1, -0.3];

/// Ratio of an outlier's residual to the usual one. Among a million rows with normal errors the largest ratio is 7.3.
const UNUSUAL: f64 = 12.0;

/// Share of the largest acceleration elsewhere from which the false acceleration matters.
const LEAST_SHARE: f64 = 0.3;

/// Second derivative at a row of the spline through 1 there and 0 elsewhere, times h²: 6·(√3 − 1).
const SPLINE_BEND: f64 = 4.392_305;

/// Rows on either side of a row that it influences.
const NEIGHBOURS: usize = 8;

/// An outlier row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlier {
    /// Index of the row, from 0.
    pub row: usize,
    /// Time since the first row (s).
    pub t: f64,
    /// Whether speeds were recorded, not positions.
    pub of_speeds: bool,
    /// Its deviation from the cubic through its neighbours (rad or m, or per s).
    pub by: f64,
    /// The largest acceleration of the curve near it, and away from it (per s²).
    pub accelerations: [f64; 2],
}

impl Motion {
    /// The largest outlier of a recorded motion; `None` without outliers.
    pub fn outlier(&self) -> Option<Outlier> {
        let (curve, of_speeds) = self.curve()?;
        let (mut t, mut y) = curve.points();
        let (rows, h, end) = (t.len(), usual_step(&t)?, self.duration());
        // In a cycle every row has neighbours; otherwise the three rows at either end are not judged.
        let before = if self.cyclic && rows > 2 * NEIGHBOURS {
            let more = |from: usize, shift: f64, t: &mut Vec<f64>, y: &mut Vec<f64>| {
                let added: Vec<[f64; 2]> = (from..from + 3).map(|k| [t[k] + shift, y[k]]).collect();
                t.extend(added.iter().map(|[t, _]| t));
                y.extend(added.iter().map(|[_, y]| y));
            };
            more(0, end, &mut t, &mut y);
            more(rows - 3, -end, &mut t, &mut y);
            t.rotate_right(3);
            y.rotate_right(3);
            3
        } else {
            0
        };
        let missed: Vec<f64> = residuals(&t, &y).map(|[missed, _]| missed).collect();
        let usual = usual(missed.iter().copied(), &y)?;
        let (k, by) = (missed.windows(3).enumerate())
            .filter(|(_, near)| {
                let beside = |r: f64| (BESIDE[0]..=BESIDE[1]).contains(&(r / near[1]));
                near[1].abs() > UNUSUAL * usual && beside(near[0]) && beside(near[2])
            })
            .map(|(k, near)| (k, near[1]))
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        // Two rows before the first window, one before its middle residual.
        let row = (k + 3 + rows - before) % rows;
        let order = if of_speeds { 1 } else { 2 };
        let mut accelerations = [0.0_f64; 2];
        for (k, t) in t[before..before + rows].iter().enumerate() {
            let apart = k.abs_diff(row);
            let apart = if self.cyclic {
                apart.min(rows - apart)
            } else {
                apart
            };
            let most = &mut accelerations[usize::from(apart > NEIGHBOURS)];
            *most = most.max(curve.at(*t)[order].abs());
        }
        let wrong = by.abs()
            * if of_speeds {
                1.0 / h
            } else {
                SPLINE_BEND / (h * h)
            };
        (wrong > LEAST_SHARE * accelerations[1]).then_some(Outlier {
            row,
            t: t[before + row],
            of_speeds,
            by,
            accelerations,
        })
    }
}
