//! The interpolant of all curves: a uniform cubic B-spline through samples.
//!
//! One control point per knot gives value, slope and curvature of the same C2 curve:
//!
//! ```text
//! f(u) = p0 + u·(p1 + u·(p2 + u·p3)),   u in [0, 1) within the cell
//! p0 = c₀ + 4c₁ + c₂    p1 = 3(c₂ − c₀)    p2 = 3(c₀ − 2c₁ + c₂)    p3 = (c₃ − c₀) + 3(c₁ − c₂)
//! ```
//!
//! where c₀…c₃ are four neighbouring control points, stored divided by six so that no division remains. The error of the value falls with the fourth
//! power of the cell's width, the error of the slope with the third. Interpolation of periodic samples by two recursive filters: M. Unser, *Splines:
//! a perfect fit for signal and image processing*, IEEE Signal Processing Magazine 16 (1999), equations (19)-(20).

use crate::math;
use crate::number::Ring;
use crate::number::error::RangeError;

/// Number of control points of a curve of `cells` cells: one per cell and three more, so that the four of any cell lie side by side.
#[must_use]
pub const fn control_points(cells: usize) -> usize {
    cells + 3
}

/// Least number of cells of a curve.
pub const MIN_CELLS: usize = 4;

/// Control points of the periodic curve through `samples` (one per cell, the first not repeated at the end).
///
/// # Errors
/// Fewer than [`MIN_CELLS`] samples, or a buffer of another length than samples + 3.
pub fn fit_periodic(samples: &[f64], control: &mut [f64]) -> Result<(), RangeError> {
    check_lengths(samples.len(), samples.len(), control.len())?;
    solve_periodic(4.0, samples, control);
    // The rows that close the turn.
    let cells = samples.len();
    for (to, from) in [(0, cells), (cells + 1, 1), (cells + 2, 2)] {
        let value = control.get(from).copied().unwrap_or(0.0);
        if let Some(slot) = control.get_mut(to) {
            *slot = value;
        }
    }
    Ok(())
}

/// Solves `x[k−1] + a·x[k] + x[k+1] = f[k]`, indices modulo their number, into `control[1..]`.
fn solve_periodic(a: f64, f: &[f64], control: &mut [f64]) {
    let cells = f.len();
    let pole = 0.5 * (math::sqrt(a * a - 4.0) - a);
    // Causal filter y[k] = f[k] + z·y[k−1], started with the periodic sum Σ z^j·f[−j].
    let at = |index: usize| f.get(index % cells).copied().unwrap_or(0.0);
    let wrap = 1.0 / (1.0 - power(pole, cells));
    let mut y = (0..cells)
        .rev()
        .fold(0.0, |sum, j| sum * pole + at(cells - j))
        * wrap;
    // Control point k of the formula above has index k + 1: the cell before the first needs one, too.
    if let Some(first) = control.get_mut(1) {
        *first = y;
    }
    for k in 1..cells {
        y = at(k) + pole * y;
        if let Some(slot) = control.get_mut(k + 1) {
            *slot = y;
        }
    }
    // Anticausal filter x[k] = y[k] + z·x[k+1], and the gain −z.
    let mut x = {
        let filtered = |index: usize| control.get(1 + index % cells).copied().unwrap_or(0.0);
        (0..cells)
            .rev()
            .fold(0.0, |sum, j| sum * pole + filtered(cells - 1 + j))
            * wrap
    };
    for slot in control.iter_mut().skip(1).take(cells).rev().enumerate() {
        let (k, slot) = slot;
        if k > 0 {
            x = *slot + pole * x;
        }
        *slot = -pole * x;
    }
}

/// Control points (in halves) of the periodic C1 quadratic through `samples` in the middle of every cell. Interpolation there keeps an even degree
/// well-posed; value and slope are then continuous at the knots.
///
/// # Errors
/// As [`fit_periodic`].
pub fn fit_quadratic_periodic(samples: &[f64], control: &mut [f64]) -> Result<(), RangeError> {
    let cells = samples.len();
    check_lengths(cells, cells, control.len())?;
    // (h₀ + 6·h₁ + h₂)/4 is the value in the middle.
    solve_periodic(6.0, samples, control);
    for slot in control.iter_mut() {
        *slot *= 4.0;
    }
    for (to, from) in [(0, cells), (cells + 1, 1), (cells + 2, 2)] {
        let value = control.get(from).copied().unwrap_or(0.0);
        if let Some(slot) = control.get_mut(to) {
            *slot = value;
        }
    }
    Ok(())
}

/// As [`fit_quadratic_periodic`], for a stroke: `samples` are the start, the middle of every cell, and the end.
///
/// # Errors
/// As [`fit_bounded`].
pub fn fit_quadratic_bounded(samples: &[f64], control: &mut [f64]) -> Result<(), RangeError> {
    let cells = samples.len().saturating_sub(2);
    check_lengths(samples.len(), cells, control.len())?;
    let f = |k: usize| samples.get(k).copied().unwrap_or(0.0);
    let (start, end) = (f(0), f(cells + 1));
    // h₋₁ = start − h₀ and hₙ = end − hₙ₋₁ lead to the tridiagonal system (1, 6, 1) with 5 in both corners; hₖ has index k + 1.
    let mut set = |k: usize, value: f64| {
        if let Some(slot) = control.get_mut(k) {
            *slot = value;
        }
    };
    // The eliminated rows: h[k] = right − pivot·h[k+1].
    let mut right = (4.0 * f(1) - start) / 5.0;
    set(1, right);
    for k in 1..cells {
        let last = k == cells - 1;
        let value = 4.0 * f(k + 1) - if last { end } else { 0.0 };
        let before = quadratic_pivot(k - 1);
        let pivot = 1.0 / (if last { 5.0 } else { 6.0 } - before);
        right = (value - right) * pivot;
        set(k + 1, right);
    }
    let get = |control: &[f64], k: usize| control.get(k).copied().unwrap_or(0.0);
    for k in (0..cells - 1).rev() {
        let value = get(control, k + 1) - quadratic_pivot(k) * get(control, k + 2);
        if let Some(slot) = control.get_mut(k + 1) {
            *slot = value;
        }
    }
    let (first, last) = (start - get(control, 1), end - get(control, cells));
    for (k, value) in [(0, first), (cells + 1, last), (cells + 2, 0.0)] {
        if let Some(slot) = control.get_mut(k) {
            *slot = value;
        }
    }
    Ok(())
}

/// Remaining coefficient of row k after elimination of the system (1, 6, 1) that begins with 5.
fn quadratic_pivot(k: usize) -> f64 {
    (0..k.min(20)).fold(0.2, |before, _| 1.0 / (6.0 - before))
}

/// Control points of the curve through `samples` at both ends and between (one more than cells), with not-a-knot ends: the first two and the last two
/// cells each share one cubic.
///
/// # Errors
/// Fewer than [`MIN_CELLS`] cells, or a buffer of another length than samples + 2.
pub fn fit_bounded(samples: &[f64], control: &mut [f64]) -> Result<(), RangeError> {
    let cells = samples.len().saturating_sub(1);
    check_lengths(samples.len(), cells, control.len())?;
    let f = |k: usize| samples.get(k).copied().unwrap_or(0.0);
    // With f[k] = c[k−1] + 4c[k] + c[k+1] (c in sixths), not-a-knot at knot 1 determines c[1] directly:
    let end = |f0: f64, f1: f64, f2: f64| (8.0 * f1 - f0 - f2) / 36.0;
    let first = end(f(0), f(1), f(2));
    let last = end(f(cells), f(cells - 1), f(cells - 2));
    // Between them a tridiagonal system (1, 4, 1), solved by elimination; control point k has index k + 1.
    let mut set = |k: usize, value: f64| {
        if let Some(slot) = control.get_mut(k) {
            *slot = value;
        }
    };
    set(2, first);
    set(cells, last);
    let mut right = first; // of the eliminated row: c[k] = right − pivot(k)·c[k+1]
    for k in 2..cells - 1 {
        right = (f(k) - right) * pivot(k);
        set(k + 1, right);
    }
    let mut next = last;
    for k in (2..cells - 1).rev() {
        if let Some(slot) = control.get_mut(k + 1) {
            next = *slot - pivot(k) * next;
            *slot = next;
        }
    }
    // The outer points from the interpolation at knots 1 and 0, and symmetrically at the other end.
    let get = |control: &[f64], k: usize| control.get(k).copied().unwrap_or(0.0);
    let c1 = f(1) - 4.0 * get(control, 2) - get(control, 3);
    let c0 = f(0) - 4.0 * c1 - get(control, 2);
    let d1 = f(cells - 1) - 4.0 * get(control, cells) - get(control, cells - 1);
    let d0 = f(cells) - 4.0 * d1 - get(control, cells);
    for (k, value) in [(1, c1), (0, c0), (cells + 1, d1), (cells + 2, d0)] {
        if let Some(slot) = control.get_mut(k) {
            *slot = value;
        }
    }
    Ok(())
}

/// Remaining coefficient after elimination of the system (1, 4, 1) at knot k ≥ 2: 1/4, 1/(4 − 1/4), … It reaches its limit 2 − √3 to the last bit
/// within 20 knots.
fn pivot(k: usize) -> f64 {
    (1..k.min(21)).fold(0.0, |before, _| 1.0 / (4.0 - before))
}

fn check_lengths(samples: usize, cells: usize, control: usize) -> Result<(), RangeError> {
    if cells < MIN_CELLS {
        return Err(RangeError::OutOfRange {
            what: "number of samples",
            value: samples as f64,
            min: (MIN_CELLS + samples - cells) as f64,
            max: f64::INFINITY,
        });
    }
    if control != control_points(cells) {
        return Err(RangeError::BufferTooShort {
            needed: control_points(cells),
            given: control,
        });
    }
    Ok(())
}

fn power(base: f64, exponent: usize) -> f64 {
    math::pow(base, exponent as f64)
}

/// A curve in double precision over the range 0 to 1: the reference for tables, and for recorded motions.
#[derive(Clone, Debug, PartialEq)]
pub struct CubicSpline<C> {
    control: C,
}

impl<C: AsRef<[f64]>> CubicSpline<C> {
    /// From control points computed by [`fit_periodic`] or [`fit_bounded`].
    ///
    /// # Errors
    /// Too few control points, or one that is not finite.
    pub fn new(control: C) -> Result<Self, RangeError> {
        let points = control.as_ref();
        if points.len() < control_points(MIN_CELLS) {
            return Err(RangeError::BufferTooShort {
                needed: control_points(MIN_CELLS),
                given: points.len(),
            });
        }
        if !points.iter().all(|c| c.is_finite()) {
            return Err(RangeError::NotFinite("a sample of the curve"));
        }
        Ok(Self { control })
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.control.as_ref().len() - 3
    }

    /// Value, first and second derivative with respect to x, for x in 0 to 1 (clamped).
    #[must_use]
    pub fn at(&self, x: f64) -> [f64; 3] {
        let cells = self.cells() as f64;
        let place = (x.clamp(0.0, 1.0)) * cells;
        let cell = math::floor(place).min(cells - 1.0).max(0.0);
        let u = place - cell;
        let points = self.control.as_ref().get(cell as usize..);
        let Some(&[c0, c1, c2, c3]) = points.and_then(|p| p.first_chunk()) else {
            return [0.0; 3];
        };
        let [p0, p1, p2, p3] = cubic([c0, c1, c2, c3], 1);
        [
            p0 + u * (p1 + u * (p2 + u * p3)),
            (p1 + u * (2.0 * p2 + u * 3.0 * p3)) * cells,
            (2.0 * p2 + u * 6.0 * p3) * cells * cells,
        ]
    }
}

/// The cubic of a cell from the control points (in sixths) of a uniform cubic B-spline; coefficient k times stepᵏ.
#[inline(always)]
pub(crate) fn cubic<R: Ring>([c0, c1, c2, c3]: [R; 4], step: i8) -> [R; 4] {
    // Differences of neighbours are exact in floating point, sums of points are not: the slope would lose digits.
    let (d0, d1, d2) = (c1 - c0, c2 - c1, c3 - c2);
    let (s0, s1) = (d1 - d0, d2 - d1);
    [
        c1.times(6) + s0,
        (d0 + d1).times(3 * step),
        s0.times(3 * step * step),
        (s1 - s0).times(step * step * step),
    ]
}
