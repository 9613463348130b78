//! The range of a drive link that cannot turn fully: between dead points, over a stroke without any of them.

use core::f64::consts::TAU;

use super::four_bar::beyond;
use crate::Domain;
use crate::machine::error::PoseError;
use crate::mechanism::error::BuildError;

/// Margin to a dead point, as a share of the length that reaches it, so that rounding does not make a position within a stroke fail.
pub(super) const HAIR: f64 = 1e-12;

/// Relative gap of a joint at the start of a stroke, beyond a dead point.
const OPEN: f64 = 1e-9;

/// Crank angles (rad, 0 to 2π) of a mechanism's dead points.
pub(super) type DeadPoints = heapless::Vec<f64, 4>;

/// The range of a drive link over a stroke [from, to] (rad).
///
/// `gap` is the missing share of the `joint`'s length at its start; if not positive, the mechanism can be assembled there.
pub(super) fn over(
    [from, to]: [f64; 2],
    joint: usize,
    gap: [f64; 2],
    dead_points: &[f64],
) -> Result<Domain, BuildError> {
    let domain = Domain::stroke(from, to)?;
    let [gap, length] = gap;
    if gap > OPEN * length {
        return Err(PoseError::CannotAssemble {
            phi: from,
            joint,
            gap,
        }
        .into());
    }
    if gap > -HAIR * length {
        return Err(PoseError::DeadPoint { phi: from, joint }.into());
    }
    let ahead = dead_points.iter().map(|phi| from + beyond(phi - from));
    let phi = ahead.fold(f64::INFINITY, f64::min);
    if phi <= to {
        return Err(PoseError::DeadPoint { phi, joint }.into());
    }
    Ok(domain)
}

/// The range of crank angles (rad) between two dead points: around φ = 0 if the mechanism can be assembled there, otherwise the first one after it.
/// `None`: it cannot be assembled anywhere.
pub(super) fn between(dead_points: &[f64], assembled: bool) -> Option<[f64; 2]> {
    let least = |above: f64| {
        let others = dead_points.iter().copied().filter(|phi| *phi > above);
        others.fold(f64::INFINITY, f64::min)
    };
    let most = dead_points
        .iter()
        .copied()
        .fold(f64::NEG_INFINITY, f64::max);
    let first = least(f64::NEG_INFINITY);
    let range = if assembled {
        [most - TAU, first]
    } else {
        [first, least(first)]
    };
    (range[1] < f64::INFINITY && range[0] < range[1]).then_some(range)
}
