//! Rounds the control points of a spline together.
//!
//! Separate rounding puts each point off by up to half a unit. The slope is a difference of neighbours, so that their errors add up and are divided
//! by the width of a cell. A point may be rounded the other way if that decreases the error of the slope. Over the turn the square of that error is
//!
//! ```text
//! ∫ (Σ eₖ·Bₖ′)² du = Σ eₖ·Mₖⱼ·eⱼ,   M = (2/3, −1/8, −1/5, −1/120) by |k − j|
//! ```
//!
//! with the errors e and the slopes B′ of the cubic B-spline. Sweeps over the points set each to the unit nearest to the minimum for its current
//! neighbours.

use super::{Layout, Word};
use crate::number::{Kernel, Role};

/// The products of slopes off the diagonal.
const BESIDE: [f64; 3] = [-1.0 / 8.0, -1.0 / 5.0, -1.0 / 120.0];
/// Number of points on each side with such products. Every turn has more points.
const REACH: usize = BESIDE.len();
/// The diagonal, slightly increased for the value: equal errors do not change the slope.
const DIAGONAL: f64 = 2.0 / 3.0 + 0.02;
const SWEEPS: usize = 6;

/// The control points of one curve among the words of a table.
pub(super) struct Points<'w, L: Layout> {
    pub(super) words: &'w mut [Word<L>],
    pub(super) role: Role,
    /// Index of the word with the first point.
    pub(super) first: usize,
    /// Words from one point to the next.
    pub(super) pitch: usize,
    /// The half of the word, if words contain halves.
    pub(super) upper: bool,
    /// Multiplier of the stored number.
    pub(super) gain: f64,
}

impl<L: Layout> Points<'_, L> {
    /// The stored point.
    fn get(&self, point: usize) -> Option<f64> {
        let word = *self.words.get(self.first + point * self.pitch)?;
        let stored = L::half(word, self.upper);
        Some(L::Number::exact(self.role, L::Number::raw(stored)) * self.gain)
    }

    /// Stores the number nearest to `value`; `None` if out of range.
    pub(super) fn set(&mut self, point: usize, value: f64) -> Option<()> {
        let stored = L::Number::word(self.role, value / self.gain)?;
        let slot = self.words.get_mut(self.first + point * self.pitch)?;
        *slot = L::with_half(*slot, self.upper, stored)?;
        Some(())
    }

    /// The error of the point [`REACH`] before `place`, around the turn; 0 outside a stroke.
    fn error(&self, place: usize, control: &[f64], period: Option<usize>) -> f64 {
        let point = match period {
            Some(period) => Some((place + period - REACH) % period),
            None => place.checked_sub(REACH),
        };
        let exact = |point: usize| Some((point, *control.get(point)?));
        point
            .and_then(exact)
            .and_then(|(point, exact)| Some(self.get(point)? - exact))
            .unwrap_or(0.0)
    }

    /// Rounds the points `control`, already stored with separate rounding; they repeat after `period`.
    pub(super) fn round_together(&mut self, control: &[f64], period: Option<usize>) {
        let points = period.unwrap_or(control.len());
        for _ in 0..SWEEPS {
            // The errors from three points before to three after: each is read once, and again when its point is set.
            let mut near = [0.0; 2 * REACH + 1];
            for place in 0..points + 2 * REACH {
                let [_, c, b, a, d, e, f] = near;
                near = [c, b, a, d, e, f, self.error(place, control, period)];
                let Some(point) = place.checked_sub(2 * REACH) else {
                    continue;
                };
                let [c, b, a, _, d, e, f] = near;
                let sums = [d + a, e + b, f + c];
                let pull: f64 = BESIDE.iter().zip(sums).map(|(k, sum)| k * sum).sum();
                let exact = control.get(point).copied().unwrap_or(0.0);
                // Out of range the point stays unchanged.
                let _ = self.set(point, exact - pull / DIAGONAL);
                near[REACH] = self.error(point + REACH, control, period);
            }
        }
        // The rows that close the turn.
        if let Some(period) = period {
            for point in period..control.len() {
                if let Some(value) = self.get(point - period) {
                    let _ = self.set(point, value);
                }
            }
        }
    }
}
