//! Numerical methods that several commands use.

pub mod dormand_prince;

use std::cell::Cell;

use super::quadrature::CENTRED_GAUSS_5;

/// Number of steps after which the bracket is reduced to rounding.
const THIRDS: u32 = 80;

/// The most halvings of one [`integral`]: a curve that is only rounding must not be halved without end.
const MOST_HALVINGS: u32 = 20_000;

/// The sign of a direction; zero if it is zero.
#[inline]
pub fn sign(direction: f64) -> f64 {
    if direction == 0.0 {
        0.0
    } else {
        direction.signum()
    }
}

/// The zero of a rising, piecewise smooth function, from its value and slope: the drive train's efficiencies change sides with its power, friction with
/// the forces in the joints. Steps that go back and forth over bends are replaced by bisection.
///
/// # Errors
/// Those of `f`.
pub fn newton<E>(mut f: impl FnMut(f64) -> Result<[f64; 2], E>) -> Result<f64, E> {
    let (mut x, mut around) = (0.0f64, [f64::NEG_INFINITY, f64::INFINITY]);
    for count in 0..100 {
        let [value, slope] = f(x)?;
        around[usize::from(value > 0.0)] = x;
        let step = value / slope;
        let from = x;
        x -= step;
        let [low, high] = around;
        if count > 20 && !(low < x && x < high) && low.is_finite() && high.is_finite() {
            x = low.midpoint(high);
        }
        if (x - from).abs() <= 1e-15 * x.abs() {
            break;
        }
    }
    Ok(x)
}

/// The position of the minimum of `f` between `low` and `high`, where it has only one, by thirds. It is accurate to rounding, because no step reuses
/// earlier positions as in [`golden_section`].
///
/// # Errors
/// Those of `f`.
pub fn least<E>(f: impl Fn(f64) -> Result<f64, E>, mut low: f64, mut high: f64) -> Result<f64, E> {
    for _ in 0..THIRDS {
        let third = (high - low) / 3.0;
        if f(low + third)? < f(high - third)? {
            high -= third;
        } else {
            low += third;
        }
    }
    Ok(low.midpoint(high))
}

/// Golden section, for expensive values: each step needs one value and leaves 0.618 of the range in which `f` has one minimum. Returns the last two
/// inner positions with their values. `is_less` compares values; the search ends early if the two `are_enough`.
///
/// # Errors
/// Those of `f`.
pub fn golden_section<T, E>(
    f: impl Fn(f64) -> Result<T, E>,
    [mut low, mut high]: [f64; 2],
    steps: u32,
    is_less: impl Fn(&T, &T) -> bool,
    are_enough: impl Fn(&T, &T) -> bool,
) -> Result<[(f64, T); 2], E> {
    const SECTION: f64 = 0.381_966_011_250_105_1;
    let at = |x: f64| Ok((x, f(x)?));
    let mut left = at(low + SECTION * (high - low))?;
    let mut right = at(high - SECTION * (high - low))?;
    for _ in 0..steps {
        if is_less(&left.1, &right.1) {
            high = right.0;
            right = left;
            left = at(low + SECTION * (high - low))?;
        } else {
            low = left.0;
            left = right;
            right = at(high - SECTION * (high - low))?;
        }
        if are_enough(&left.1, &right.1) {
            break;
        }
    }
    Ok([left, right])
}

/// The border between `a`, where `before` is true, and `b`, where it is false.
///
/// # Errors
/// Those of `before`.
pub fn edge<E>(before: impl Fn(f64) -> Result<bool, E>, a: f64, b: f64) -> Result<f64, E> {
    let [a, b] = sides(before, a, b)?;
    Ok(a.midpoint(b))
}

/// The last places on both sides of this border: `before` is true at the first and false at the second.
///
/// # Errors
/// Those of `before`.
pub fn sides<E>(
    before: impl Fn(f64) -> Result<bool, E>,
    mut a: f64,
    mut b: f64,
) -> Result<[f64; 2], E> {
    for _ in 0..60 {
        let middle = a.midpoint(b);
        if before(middle)? {
            a = middle;
        } else {
            b = middle;
        }
    }
    Ok([a, b])
}

/// The zero of `f` between `a` and `b`, where it has the values `fa` and `fb` of opposite signs, to a relative accuracy of `share`: inverse quadratic
/// interpolation, or bisection where that is not safe (T. R. Chandrupatla, Advances in Engineering Software 28, 1997).
///
/// # Errors
/// Those of `f`.
pub fn zero<E>(
    f: impl Fn(f64) -> Result<f64, E>,
    [mut a, mut b]: [f64; 2],
    [mut fa, mut fb]: [f64; 2],
    share: f64,
) -> Result<f64, E> {
    let mut t = 0.5;
    for _ in 0..100 {
        let x = a + t * (b - a);
        let fx = f(x)?;
        let (c, fc);
        if (fx > 0.0) == (fa > 0.0) {
            (c, fc) = (a, fa);
        } else {
            (c, fc) = (b, fb);
            (b, fb) = (a, fa);
        }
        (a, fa) = (x, fx);
        let (best, least) = if fa.abs() < fb.abs() {
            (a, fa)
        } else {
            (b, fb)
        };
        let part = share * best.abs() / (b - a).abs();
        if least == 0.0 || part > 0.5 {
            return Ok(best);
        }
        let xi = (a - b) / (c - b);
        let phi = (fa - fb) / (fc - fb);
        t = if phi * phi < xi && (1.0 - phi).powi(2) < 1.0 - xi {
            fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        } else {
            0.5
        };
        t = t.clamp(part, 1.0 - part);
    }
    Ok(a)
}

/// The integral of `f` from `a` to `b` to about `tolerance`: Gauss-Legendre quadrature with five points over `panels` equal parts, each halved while
/// its halves disagree, so that jumps and bends of the curve are isolated.
///
/// # Errors
/// Those of `f`.
pub fn integral<E>(
    f: impl Fn(f64) -> Result<f64, E>,
    [a, b]: [f64; 2],
    panels: u32,
    tolerance: f64,
) -> Result<f64, E> {
    const DEEPEST: u32 = 32;
    let halvings = Cell::new(MOST_HALVINGS);
    let place = |k: u32| a + (b - a) * f64::from(k) / f64::from(panels);
    let mut sum = 0.0;
    for k in 0..panels {
        let ends = [place(k), place(k + 1)];
        let whole = gauss(&f, ends)?;
        sum += halved(
            &f,
            ends,
            whole,
            tolerance / f64::from(panels),
            DEEPEST,
            &halvings,
        )?;
    }
    Ok(sum)
}

/// The integral of a smooth `f` from `a` to `b` by Gauss-Legendre quadrature with five points.
///
/// # Errors
/// Those of `f`.
pub fn gauss<E>(f: &impl Fn(f64) -> Result<f64, E>, [a, b]: [f64; 2]) -> Result<f64, E> {
    let (middle, half) = (a.midpoint(b), 0.5 * (b - a));
    let mut sum = 0.0;
    for [x, weight] in CENTRED_GAUSS_5 {
        sum += weight * f(middle + half * x)?;
    }
    Ok(half * sum)
}

fn halved<E>(
    f: &impl Fn(f64) -> Result<f64, E>,
    [a, b]: [f64; 2],
    whole: f64,
    tolerance: f64,
    depth: u32,
    halvings: &Cell<u32>,
) -> Result<f64, E> {
    let middle = a.midpoint(b);
    let [left, right] = [gauss(f, [a, middle])?, gauss(f, [middle, b])?];
    let left_over = halvings.get();
    let rounding = 2.0 * f64::EPSILON * (left.abs() + right.abs());
    if depth == 0 || left_over == 0 || (left + right - whole).abs() <= tolerance.max(rounding) {
        return Ok(left + right);
    }
    halvings.set(left_over - 1);
    let half = 0.5 * tolerance;
    Ok(halved(f, [a, middle], left, half, depth - 1, halvings)?
        + halved(f, [middle, b], right, half, depth - 1, halvings)?)
}

#[cfg(test)]
#[expect(
    clippy::disallowed_methods,
    reason = "functions of another library than the code's"
)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn sure<T>(result: Result<T, Infallible>) -> T {
        match result {
            Ok(value) => value,
            Err(never) => match never {},
        }
    }

    #[test]
    fn jumps_and_bends_are_closed_in() {
        let kink = |x: f64| Ok::<f64, Infallible>((x - 0.3).abs());
        let found = sure(integral(kink, [0.0, 1.0], 7, 1e-12));
        assert!((found - (0.045 + 0.245)).abs() < 1e-12, "{found}");
        let step = |x: f64| Ok::<f64, Infallible>(if x < 0.3 { 2.0 } else { -1.0 });
        let found = sure(integral(step, [0.0, 1.0], 7, 1e-12));
        assert!((found - (0.6 - 0.7)).abs() < 1e-10, "{found}");
    }

    #[test]
    fn a_smooth_curve_is_exact_to_rounding() {
        let found = sure(integral(
            |x| Ok::<f64, Infallible>(x.exp()),
            [-1.0, 2.0],
            4,
            1e-13,
        ));
        assert!((found - (2f64.exp() - (-1f64).exp())).abs() < 1e-13);
    }

    /// A function that is only rounding noise ends after a limited number of bisections.
    #[test]
    fn noise_ends() {
        let calls = Cell::new(0u32);
        let noise = |x: f64| {
            calls.set(calls.get() + 1);
            Ok::<f64, Infallible>((x * 1e9).sin())
        };
        sure(integral(noise, [0.0, 1.0], 4, 1e-15));
        assert!(calls.get() < 20 * MOST_HALVINGS + 200, "{}", calls.get());
    }

    /// A few evaluations for a smooth curve, and no more than bisection for one that jumps.
    #[test]
    fn zeros() {
        let calls = Cell::new(0u32);
        let cubic = |x: f64| {
            calls.set(calls.get() + 1);
            Ok::<f64, Infallible>(x.powi(3) - 2.0)
        };
        let found = sure(zero(cubic, [1.0, 2.0], [-1.0, 6.0], 1e-15));
        assert!((found - 2f64.cbrt()).abs() < 1e-15, "{found}");
        assert!(calls.get() <= 12, "{}", calls.get());
        let step = |x: f64| Ok::<f64, Infallible>(if x < 0.7 { 3.0 } else { -1e-9 });
        let found = sure(zero(step, [0.0, 1.0], [3.0, -1e-9], 1e-15));
        assert!((found - 0.7).abs() < 2e-15, "{found}");
    }

    #[test]
    fn minima_and_edges() {
        let found = sure(least(
            |x: f64| Ok::<f64, Infallible>((x - 0.7).abs()),
            0.0,
            1.0,
        ));
        assert!((found - 0.7).abs() < 1e-12);
        let found = sure(edge(|x: f64| Ok::<bool, Infallible>(x < 0.7), 0.0, 1.0));
        assert!((found - 0.7).abs() < 1e-15);
    }
}
