//! Polynomials between boundary conditions: the general transition of VDI 2143 Blatt 1, of fifth to seventh degree.

use crate::math::Real;

/// The derivatives at an end of a transition: all zero for rest (R), a speed for constant speed (G), an acceleration for a reversal (U), both for
/// motion (B).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct End<R = f64> {
    /// First derivative: the speed.
    pub speed: R,
    /// Second derivative: the acceleration.
    pub acceleration: R,
    /// Third derivative: the jerk; with `None` it follows from the other conditions, and the degree is one less.
    pub jerk: Option<R>,
}

impl<R: Real> End<R> {
    /// Speed and acceleration; the jerk is not given.
    pub const fn new(speed: R, acceleration: R) -> Self {
        Self {
            speed,
            acceleration,
            jerk: None,
        }
    }
}

/// Greatest number of coefficients: those of seventh degree.
const COEFFICIENTS: usize = 8;

/// s(t) = c₁·t + c₂·t² + … + c₇·t⁷.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Polynomial<R = f64> {
    coefficients: [R; COEFFICIENTS],
}

impl<R: Real> Polynomial<R> {
    /// Constant jerk from the speed `v` and the acceleration `a` on: v·t + a·t²/2 + j·t³/6. With j = 0 the acceleration is constant, with a = 0 as
    /// well the speed.
    #[must_use]
    pub fn constant_jerk([v, a, j]: [R; 3]) -> Self {
        let c = R::from_f64;
        let mut coefficients = [c(0.0); COEFFICIENTS];
        coefficients[1] = v;
        coefficients[2] = a / c(2.0);
        coefficients[3] = j / c(6.0);
        Self { coefficients }
    }

    /// From s(0) = 0 to s(`span`) = `rise` with the given derivatives at both ends: the polynomial of fifth degree, sixth if one end has a jerk,
    /// seventh if both have. The span must be positive.
    ///
    /// Accuracy: it meets its conditions to 1e-13 of the largest of their terms (test `polynomials_meet_their_ends`).
    #[must_use]
    pub fn between(rise: R, span: R, start: End<R>, end: End<R>) -> Self {
        let c = R::from_f64;
        let zero = c(0.0);
        // Derivatives with respect to z = t/span, and the number of given ones, including s.
        let by_z = |s: R, end: End<R>| {
            let [v, a] = [end.speed * span, end.acceleration * span * span];
            let j = end.jerk.unwrap_or(zero) * span * span * span;
            ([s, v, a, j], if end.jerk.is_some() { 4 } else { 3 })
        };
        let (first, known) = by_z(zero, start);
        let (last, asked) = by_z(rise, end);
        let mut coefficients = [zero; COEFFICIENTS];
        // Taylor's series at the start, …
        let mut factorial = 1.0;
        for (k, derivative) in first.into_iter().enumerate().take(known) {
            coefficients[k] = derivative / c(factorial);
            factorial *= (k + 1) as f64;
        }
        // … and z^m·Q(z) for the difference at the end, where p^(i)(1) = missing[i].
        let mut missing = last;
        for (i, missing) in missing.iter_mut().enumerate().take(asked) {
            for (k, &coefficient) in coefficients.iter().enumerate().take(known).skip(i) {
                *missing = *missing - coefficient * c(falling(k, i));
            }
        }
        // Q = z^(−m)·p, by Leibniz's rule at z = 1: (z^(−m))^(l) = (−1)^l·m·(m + 1) … (m + l − 1).
        let mut q = [zero; 4];
        for (i, q) in q.iter_mut().enumerate().take(asked) {
            let mut weight = 1.0;
            for l in 0..=i {
                // Here the weight is C(i, l)·(−1)^l·m … (m + l − 1).
                *q = *q + missing[i - l] * c(weight);
                weight *= -(((known + l) * (i - l)) as f64) / (l + 1) as f64;
            }
        }
        // Taylor's series of Q at z = 1, by Horner's rule in z − 1.
        let mut expanded = [zero; 4];
        for i in (0..asked).rev() {
            for k in (1..4).rev() {
                expanded[k] = expanded[k - 1] - expanded[k];
            }
            expanded[0] = q[i] / c(falling(i, i)) - expanded[0];
        }
        for (k, term) in expanded.into_iter().enumerate().take(asked) {
            coefficients[known + k] = term;
        }
        let mut power = c(1.0);
        for coefficient in &mut coefficients {
            *coefficient = *coefficient / power;
            power = power * span;
        }
        Self { coefficients }
    }

    /// [s, s′, s″, s‴] at `t`.
    #[must_use]
    pub fn at(&self, t: R) -> [R; 4] {
        let c = R::from_f64;
        let mut p = [c(0.0); 4];
        for &coefficient in self.coefficients.iter().rev() {
            p = [
                p[0] * t + coefficient,
                p[1] * t + p[0],
                p[2] * t + p[1],
                p[3] * t + p[2],
            ];
        }
        [p[0], p[1], c(2.0) * p[2], c(6.0) * p[3]]
    }
}

/// k·(k − 1) … (k − i + 1): the factor of the i-th derivative of the power k.
fn falling(k: usize, i: usize) -> f64 {
    ((k + 1 - i)..=k).fold(1.0, |product, factor| product * factor as f64)
}
