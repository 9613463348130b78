//! From coefficients to the half-words that are nearest in the tick's own arithmetic.
//!
//! Separate rounding of the coefficients lets their errors add up at the end of the cell, and ignores the fraction that a lower half adds to the
//! upper one. So all neighbouring pairs are tried, with the start that centres the error.

use super::row::word;
use crate::math;

/// A word, and the start of its curve: 0 for a line, which contains its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Halves {
    pub(super) start: i32,
    pub(super) word: u32,
}

/// Places in a cell where errors are evaluated. A quadratic has one extreme between the ends.
const PLACES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// The fraction that a lower half adds to the upper one.
fn fraction(lower: i16) -> f64 {
    f64::from(lower.cast_unsigned()) / 65_536.0
}

fn nearest(value: f64) -> f64 {
    math::floor(value + 0.5)
}

fn i16_of(value: f64) -> Option<i16> {
    (f64::from(i16::MIN)..=f64::from(i16::MAX))
        .contains(&value)
        .then_some(value as i16)
}

/// The integer that centres these errors, and the largest remaining error.
fn centre(errors: impl Iterator<Item = f64>) -> (f64, f64) {
    let (least, most) = errors.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), e| {
        (least.min(e), most.max(e))
    });
    let shift = nearest(-0.5 * (least + most));
    (shift, math::abs(least + shift).max(math::abs(most + shift)))
}

/// The word of the line start + rise·u, in units of its upper half; `None` if it does not fit.
pub(super) fn line([start, rise]: [f64; 2]) -> Option<u32> {
    let mut best: Option<(f64, u32)> = None;
    for step in [0.0, -1.0, 1.0] {
        let Some(lower) = i16_of(nearest(rise) + step) else {
            continue;
        };
        // The tick's floor subtracts half a unit on average.
        let first = fraction(lower) - 0.5 - start;
        let (upper, error) = centre([first, first + f64::from(lower) - rise].into_iter());
        let Some(upper) = i16_of(upper) else { continue };
        if best.is_none_or(|(least, _)| error < least) {
            best = Some((error, word(upper.cast_unsigned(), lower.cast_unsigned())));
        }
    }
    best.map(|(_, word)| word)
}

/// The word of p₁ and p₂, and the start, of p₀ + p₁·u + p₂·u² in units of the start, to which the tick adds `more`; `None` if it does not fit. The
/// tick rounds the result down.
pub(super) fn quadratic([p0, p1, p2]: [f64; 3], more: f64) -> Option<Halves> {
    const STEPS: [f64; 3] = [0.0, -1.0, 1.0];
    let mut best: Option<(f64, Halves)> = None;
    for step in STEPS {
        let Some(lower) = i16_of(nearest(p2) + step) else {
            continue;
        };
        // The floor of the line subtracts half a unit on average; so does the result's.
        let slope = fraction(lower) - 0.5 - p1;
        for step in STEPS {
            let upper = nearest(-slope - (f64::from(lower) - p2)) + step;
            let (start, error) = centre(PLACES.into_iter().map(|u| {
                let line = upper + slope + u * (f64::from(lower) - p2);
                more - 0.5 - p0 + u * line
            }));
            let Some(upper) = i16_of(upper) else { continue };
            if best.is_none_or(|(least, _)| error < least) {
                let halves = Halves {
                    start: start as i32,
                    word: word(upper.cast_unsigned(), lower.cast_unsigned()),
                };
                best = Some((error, halves));
            }
        }
    }
    best.map(|(_, halves)| halves)
}
