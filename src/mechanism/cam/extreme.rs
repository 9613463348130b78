//! Extremes of a piecewise smooth curve.

use super::program::Piece;

/// The extreme of a quantity over the turn, and its place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Extreme {
    /// Angle of the cam (rad).
    pub phi: f64,
    /// The quantity there.
    pub value: f64,
}

/// Samples per piece. A dip narrower than a hundredth of a piece is missed; laws and geometry have no such dips.
const SAMPLES: u32 = 96;

/// Steps of the golden-section search, each 0.618 of the previous one: from two sample distances to 1e-12 of a piece.
const STEPS: u32 = 52;

/// The smallest value of `f` over the pieces: sampled, then refined by golden-section search in each piece around its smallest sample. At the ends of
/// a piece the value is the limit from inside.
pub(crate) fn smallest<E>(
    pieces: impl IntoIterator<Item = Piece>,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Extreme, E> {
    let mut best = Extreme {
        phi: 0.0,
        value: f64::INFINITY,
    };
    for piece in pieces {
        let mut at = |share: f64| {
            let phi = piece.inside(share);
            f(phi).map(|value| Extreme { phi, value })
        };
        let (mut lowest, mut place) = (at(0.0)?, 0);
        for k in 1..=SAMPLES {
            let here = at(f64::from(k) / f64::from(SAMPLES))?;
            if here.value < lowest.value {
                (lowest, place) = (here, k);
            }
        }
        let share = |k: u32| f64::from(k) / f64::from(SAMPLES);
        let refined = golden(
            share(place.saturating_sub(1)),
            share((place + 1).min(SAMPLES)),
            &mut at,
        )?;
        for found in [lowest, refined] {
            if found.value < best.value {
                best = found;
            }
        }
    }
    Ok(best)
}

/// Golden-section search between two shares of a piece.
fn golden<E>(
    mut low: f64,
    mut high: f64,
    mut at: impl FnMut(f64) -> Result<Extreme, E>,
) -> Result<Extreme, E> {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut a, mut b) = (high - RATIO * (high - low), low + RATIO * (high - low));
    let (mut f_a, mut f_b) = (at(a)?, at(b)?);
    for _ in 0..STEPS {
        if f_a.value < f_b.value {
            (high, b, f_b) = (b, a, f_a);
            a = high - RATIO * (high - low);
            f_a = at(a)?;
        } else {
            (low, a, f_a) = (a, b, f_b);
            b = low + RATIO * (high - low);
            f_b = at(b)?;
        }
    }
    Ok(if f_a.value < f_b.value { f_a } else { f_b })
}
