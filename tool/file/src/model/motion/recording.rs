//! Rows of a recorded motion, and the curve through them.

use crate::number::spline::{FitMethod, Spline, SplineError};

/// Whether a recorded motion repeats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Repetition {
    /// It does not.
    Open,
    /// It does, and advances by this per cycle (rad, or m): whole turns, or zero.
    After(f64),
}

/// Rows of a recorded motion.
#[derive(Clone, Copy, Debug)]
pub struct Recording<'r> {
    /// Times from 0, rising, the last at the end of the motion (s).
    pub times: &'r [f64],
    /// Positions or speeds.
    pub values: &'r [f64],
    /// Angular frequency at which smoothing halves an amplitude (rad/s); `None`: the curve passes through every row.
    pub cutoff: Option<f64>,
    /// Whether it repeats: then its last row equals its first, a cycle later.
    pub closing: Repetition,
}

impl Recording<'_> {
    pub(super) fn duration(&self) -> Result<f64, SplineError> {
        match self.times {
            [first, .., last] if *first == 0.0 && *last > 0.0 => Ok(*last),
            _ => Err(SplineError::NotRising),
        }
    }

    /// The curve, by default of the method `exact`.
    pub(super) fn curve(&self, values: &[f64], exact: FitMethod) -> Result<Spline, SplineError> {
        let way = self.cutoff.map_or(exact, FitMethod::Smoothing);
        match (self.closing, self.times) {
            (Repetition::After(_), [times @ .., duration]) if values.len() == self.times.len() => {
                Spline::periodic(times, &values[..times.len()], *duration, way)
            }
            _ => Spline::bounded(self.times, values, way),
        }
    }
}

/// The fewest rows in a period of the cut-off frequency, and the fewest such periods in a recording.
const ROWS_PER_CUTOFF: f64 = 4.0;
const CUTOFFS: f64 = 2.0;

/// The lowest and the highest cut-off frequency (Hz) that this number of rows over a time (s) can resolve.
pub fn cutoffs(rows: usize, duration: f64) -> [f64; 2] {
    let rate = rows.saturating_sub(1) as f64 / duration;
    [CUTOFFS / duration, rate / ROWS_PER_CUTOFF]
}
