//! Polynomials over a share from 0 to 1, with bounds of their magnitude over the whole range, not at samples.
//!
//! In Bernstein form a polynomial lies between the least and the largest of its coefficients; the first and the last one are its ends. When it is
//! halved, the coefficients approach it with the square of the width.

/// Share by which a bound may exceed the true maximum.
pub(super) const BOUND_TOLERANCE: f64 = 1e-5;

/// Halvings after which a bound is accepted as it is.
const DEEPEST: u32 = 24;

/// Converts coefficients in x to coefficients in s, x = from + width·s.
pub(super) fn moved<const N: usize>(mut c: [f64; N], from: f64, width: f64) -> [f64; N] {
    for i in 0..N {
        for j in (i..N.saturating_sub(1)).rev() {
            c[j] += from * c[j + 1];
        }
    }
    let mut power = 1.0;
    for c in &mut c {
        *c *= power;
        power *= width;
    }
    c
}

/// The derivative by x.
pub(super) fn slope<const N: usize, const M: usize>(c: &[f64; N]) -> [f64; M] {
    std::array::from_fn(|k| c.get(k + 1).map_or(0.0, |c| (k + 1) as f64 * c))
}

/// The difference of two polynomials in Bernstein form.
pub(super) fn apart<const N: usize>(one: [f64; N], other: [f64; N]) -> [f64; N] {
    let mut b: [f64; N] = std::array::from_fn(|k| one[k] - other[k]);
    let mut choose = 1.0;
    for (k, b) in b.iter_mut().enumerate() {
        *b /= choose;
        choose *= (N - 1 - k) as f64 / (k + 1) as f64;
    }
    for round in 1..N {
        for k in (round..N).rev() {
            b[k] += b[k - 1];
        }
    }
    b
}

/// Both halves, by de Casteljau.
fn halves<const N: usize>(mut b: [f64; N]) -> [[f64; N]; 2] {
    let mut first = b;
    for (k, first) in first.iter_mut().enumerate() {
        for i in 0..(N - k) * usize::from(k > 0) {
            b[i] = b[i].midpoint(b[i + 1]);
        }
        *first = b[0];
    }
    [first, b]
}

/// Bound of its magnitude by its coefficients, and its magnitude at its ends.
fn hull<const N: usize>(b: &[f64; N]) -> [f64; 2] {
    let most = b.iter().fold(0.0_f64, |most, b| most.max(b.abs()));
    [most, b[0].abs().max(b[N - 1].abs())]
}

/// Whether its magnitude stays within a bound.
pub(super) fn stays<const N: usize>(b: [f64; N], bound: f64) -> bool {
    stays_from(b, bound, 0)
}

fn stays_from<const N: usize>(b: [f64; N], bound: f64, depth: u32) -> bool {
    let [most, ends] = hull(&b);
    if most <= bound || ends > bound || depth == DEEPEST {
        return most <= bound;
    }
    halves(b)
        .into_iter()
        .all(|half| stays_from(half, bound, depth + 1))
}

/// A bound of the magnitude above `known`, and about where it is reached; `None` if it is not above.
pub(super) fn most_above<const N: usize>(b: [f64; N], known: f64) -> Option<[f64; 2]> {
    let mut found = [known, f64::NAN];
    look(b, [0.0, 1.0], 0, &mut found);
    (found[0] > known).then_some(found)
}

fn look<const N: usize>(b: [f64; N], [from, to]: [f64; 2], depth: u32, found: &mut [f64; 2]) {
    let [most, ends] = hull(&b);
    if most <= found[0] {
        return;
    }
    if most <= ends * (1.0 + BOUND_TOLERANCE) || depth == DEEPEST {
        let first = b[0].abs() > b[N - 1].abs();
        *found = [most, if first { from } else { to }];
        return;
    }
    let middle = from.midpoint(to);
    let [first, last] = halves(b);
    look(first, [from, middle], depth + 1, found);
    look(last, [middle, to], depth + 1, found);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (x − 0.3)·(x + 2)·(x − 5) from 0.1 on, 0.7 wide, against its values; its largest magnitude by a fine grid.
    #[test]
    fn a_cubic_and_its_bound() {
        let f = |x: f64| (x - 0.3) * (x + 2.0) * (x - 5.0);
        let c = [3.0, -9.1, -3.3, 1.0];
        let own = moved(c, 0.1, 0.7);
        let at = |s: f64| own.iter().rev().fold(0.0, |sum, c| sum * s + c);
        let mut most = 0.0_f64;
        for k in 0..=10_000 {
            let s = f64::from(k) * 1e-4;
            assert!((at(s) - f(0.1 + 0.7 * s)).abs() < 1e-14);
            most = most.max(at(s).abs());
        }
        let b = apart(own, [0.0; 4]);
        let [bound, _] = most_above(b, 0.0).unwrap();
        // Both are rounded.
        assert!(
            most <= bound * (1.0 + 1e-15) && bound <= (1.0 + 2.0 * BOUND_TOLERANCE) * most,
            "{bound} {most}"
        );
        assert!(stays(b, 1.001 * bound) && !stays(b, 0.999 * most));
        assert_eq!(most_above(b, 1.01 * most), None);
        let slope: [f64; 3] = slope(&c);
        for (found, expected) in slope.into_iter().zip([-9.1, -6.6, 3.0]) {
            assert!((found - expected).abs() < 1e-15);
        }
    }

    /// A polynomial whose extreme lies inside: s·(1 − s), a quarter in the middle.
    #[test]
    fn an_extreme_inside() {
        let [bound, at] = most_above(apart([0.0, 1.0, -1.0], [0.0; 3]), 0.1).unwrap();
        assert!(
            (0.25..0.250_01).contains(&bound) && (at - 0.5).abs() < 0.05,
            "{bound} {at}"
        );
    }
}
