//! Rounds the control points of a spline together.
//!
//! A point rounded by itself is off by up to half a unit, and the slope takes differences of neighbours: their errors add up,
//! and are divided by the width of a cell. Points may be rounded the other way instead, where that makes the error of the slope
//! smaller. Over the turn its square is
//!
//! ```text
//! ∫ (Σ eₖ·Bₖ′)² du = Σ eₖ·Mₖⱼ·eⱼ,   M = (2/3, −1/8, −1/5, −1/120) by |k − j|
//! ```
//!
//! with the errors e and the slopes B′ of the cubic B-spline. Sweeps over the points take each to the unit that is nearest to
//! the minimum for its neighbours as they are.

use crate::scalar::Scalar;
use crate::table::Role;

/// The products of slopes beside the diagonal.
const BESIDE: [f64; 3] = [-1.0 / 8.0, -1.0 / 5.0, -1.0 / 120.0];
/// The diagonal, and a little more for the value: errors that are all the same do not change the slope.
const DIAGONAL: f64 = 2.0 / 3.0 + 0.02;
const SWEEPS: usize = 6;

/// Where the points of a curve lie among the words.
#[derive(Clone, Copy)]
pub(super) struct Places {
    /// Index of the first.
    pub(super) first: usize,
    /// From one to the next.
    pub(super) pitch: usize,
    /// After so many they repeat.
    pub(super) period: Option<usize>,
}

impl Places {
    fn of(self, point: usize) -> usize {
        self.first + point * self.pitch
    }
}

/// Rounds the points `control`, which `words` holds rounded one by one.
pub(super) fn round_together<S: Scalar>(
    role: Role,
    control: &[f64],
    words: &mut [S::Word],
    places: Places,
) {
    let points = places.period.unwrap_or(control.len());
    let exact = |point: usize| control.get(point).copied().unwrap_or(0.0);
    for _ in 0..SWEEPS {
        for point in 0..points {
            let error = |step: isize| {
                let neighbour = point.checked_add_signed(step).filter(|k| *k < points);
                let neighbour = match (neighbour, places.period) {
                    (Some(neighbour), _) => neighbour,
                    (None, Some(period)) => (point + period).saturating_add_signed(step) % period,
                    (None, None) => return 0.0,
                };
                words.get(places.of(neighbour)).map_or(0.0, |word| {
                    S::exact(role, S::raw(*word)) - exact(neighbour)
                })
            };
            let pull: f64 = (1isize..)
                .zip(BESIDE)
                .map(|(step, product)| product * (error(step) + error(-step)))
                .sum();
            let best = exact(point) - pull / DIAGONAL;
            let word = S::word(role, best);
            if let (Some(slot), Some(word)) = (words.get_mut(places.of(point)), word) {
                *slot = word;
            }
        }
    }
    // The rows that close the turn.
    if let Some(period) = places.period {
        for point in period..control.len() {
            let word = words.get(places.of(point - period)).copied();
            if let (Some(slot), Some(word)) = (words.get_mut(places.of(point)), word) {
                *slot = word;
            }
        }
    }
}
