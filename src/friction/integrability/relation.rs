//! The relation between positions that belongs to a holonomic constraint.

use super::{Dual, coefficients};
use crate::number::quadrature;
use crate::{Error, math};

/// Φ(to) − Φ(from) of a total differential θ = dΦ (III.10), along the straight line: ∫ Σ C_i·Δx_i ds.
///
/// Only for constraints that [`test`](super::test) found exact or constant: else it depends on the line. Gauss-Legendre
/// rule of five points on 64 cells.
///
/// # Errors
/// A coefficient that is not finite on the way, or all of them zero.
pub fn potential<const N: usize>(
    form: impl Fn(&[Dual<N>; N]) -> [Dual<N>; N],
    from: [f64; N],
    to: [f64; N],
) -> Result<f64, Error> {
    quadrature::integrate(0.0, 1.0, 64, |s| {
        let c = coefficients(&form, &between(&from, &to, s))?;
        let steps = from.iter().zip(&to).map(|(a, b)| b - a);
        Ok(c.iter().zip(steps).map(|(c, step)| c.value * step).sum())
    })
}

/// Where variable number `dependent` arrives when the others go from `from` to `to` in a straight line and the constraint
/// holds: dx_d = −Σ C_i·dx_i/C_d, by `steps` steps of the classical Runge-Kutta method. `to[dependent]` is not read.
///
/// For a holonomic constraint, integrating factor or not, this is the relation between the positions; for a non-holonomic
/// one the result depends on the line.
///
/// # Errors
/// No variable of that number, no steps, a coefficient that is not finite, or a place where the dependent variable's
/// coefficient is zero.
pub fn dependent<const N: usize>(
    form: impl Fn(&[Dual<N>; N]) -> [Dual<N>; N],
    from: [f64; N],
    to: [f64; N],
    dependent: usize,
    steps: u32,
) -> Result<f64, Error> {
    let Some(start) = from.get(dependent).copied() else {
        return Err(Error::OutOfRange {
            what: "number of the dependent variable",
            value: dependent as f64,
            min: 0.0,
            max: N.saturating_sub(1) as f64,
        });
    };
    if steps == 0 {
        return Err(Error::NotPositive("number of steps", 0.0));
    }
    let rate = |s: f64, value: f64| {
        let mut place = between(&from, &to, s);
        if let Some(own) = place.get_mut(dependent) {
            *own = value;
        }
        let c = coefficients(&form, &place)?;
        let own = c.get(dependent).map_or(0.0, |c| c.value);
        if own == 0.0 {
            let what = "size of the dependent variable's coefficient";
            return Err(Error::NotPositive(what, math::abs(own)));
        }
        let steps = from.iter().zip(&to).map(|(a, b)| b - a);
        let others = c.iter().zip(steps).enumerate();
        let sum: f64 = others
            .filter(|(k, _)| *k != dependent)
            .map(|(_, (c, step))| c.value * step)
            .sum();
        Ok(-sum / own)
    };
    let h = 1.0 / f64::from(steps);
    let mut value = start;
    for step in 0..steps {
        let s = f64::from(step) * h;
        let k1 = rate(s, value)?;
        let k2 = rate(s + h / 2.0, value + h / 2.0 * k1)?;
        let k3 = rate(s + h / 2.0, value + h / 2.0 * k2)?;
        let k4 = rate(s + h, value + h * k3)?;
        value += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    Ok(value)
}

fn between<const N: usize>(from: &[f64; N], to: &[f64; N], s: f64) -> [f64; N] {
    let mut place = *from;
    for (x, end) in place.iter_mut().zip(to) {
        *x += s * (end - *x);
    }
    place
}
