//! Taylor series with interval coefficients: automatic differentiation.

use std::ops::{Add, Mul, Neg, Sub};

use crate::interval::Interval;

/// Coefficients of a series: f(φ + t) = Σ aₖ·tᵏ.
pub const TERMS: usize = 11;
/// The order of the remainder: the highest known order of a quantity that contains the second derivative of a coordinate.
pub const REMAINDER: usize = TERMS - 3;

/// aₖ = f⁽ᵏ⁾/k! for every position of an interval of φ, with the operations of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Series(pub [Interval; TERMS]);

impl Series {
    /// A quantity independent of φ.
    #[must_use]
    pub const fn constant(value: Interval) -> Self {
        let mut terms = [Interval::ZERO; TERMS];
        terms[0] = value;
        Self(terms)
    }

    /// φ itself.
    #[must_use]
    pub const fn variable(phi: Interval) -> Self {
        let mut terms = Self::constant(phi).0;
        terms[1] = Interval::ONE;
        Self(terms)
    }

    /// f′; the last coefficient is unknown, and is left zero.
    #[must_use]
    pub fn derivative(&self) -> Self {
        let mut terms = [Interval::ZERO; TERMS];
        for k in 1..TERMS {
            terms[k - 1] = self.0[k] * k as f64;
        }
        Self(terms)
    }

    /// f²
    #[must_use]
    pub fn square(&self) -> Self {
        let mut product = *self * *self;
        product.0[0] = self.0[0].square();
        product
    }

    /// √f, from y² = f; unbounded where f may be zero.
    #[must_use]
    pub fn sqrt(&self) -> Self {
        let mut y = [Interval::ZERO; TERMS];
        y[0] = self.0[0].sqrt();
        let double = y[0] * 2.0;
        for k in 1..TERMS {
            let mut sum = self.0[k];
            for j in 1..k {
                sum = sum - y[j] * y[k - j];
            }
            y[k] = sum / double;
        }
        Self(y)
    }

    /// f/g, from q·g = f.
    #[must_use]
    pub fn over(&self, g: &Self) -> Self {
        let mut q = [Interval::ZERO; TERMS];
        for k in 0..TERMS {
            let known = q.iter().take(k).zip(g.0.iter().take(k + 1).rev());
            let rest = known.fold(self.0[k], |rest, (q, g)| rest - *q * *g);
            q[k] = rest / g.0[0];
        }
        Self(q)
    }

    /// Sine and cosine of an angle.
    #[must_use]
    pub fn sin_cos(&self) -> (Self, Self) {
        let (s, c) = self.0[0].sin_cos();
        let (mut sin, mut cos) = (Self::constant(s), Self::constant(c));
        for k in 1..TERMS {
            (sin.0[k], cos.0[k]) = sin_cos_term(&self.0, &sin.0, &cos.0, k);
        }
        (sin, cos)
    }
}

/// The k-th coefficients of sine and cosine of ψ, from those before them: k·sₖ = Σ j·ψⱼ·cₖ₋ⱼ.
pub(crate) fn sin_cos_term(
    psi: &[Interval; TERMS],
    sin: &[Interval; TERMS],
    cos: &[Interval; TERMS],
    k: usize,
) -> (Interval, Interval) {
    let (mut s, mut c) = (Interval::ZERO, Interval::ZERO);
    for j in 1..=k {
        let weighted = psi[j] * j as f64;
        s = s + weighted * cos[k - j];
        c = c - weighted * sin[k - j];
    }
    let whole = Interval::of(k as f64);
    (s / whole, c / whole)
}

impl Add for Series {
    type Output = Self;
    fn add(mut self, g: Self) -> Self {
        for (a, b) in self.0.iter_mut().zip(g.0) {
            *a = *a + b;
        }
        self
    }
}

impl Sub for Series {
    type Output = Self;
    fn sub(self, g: Self) -> Self {
        self + -g
    }
}

impl Neg for Series {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|a| -a))
    }
}

impl Mul<f64> for Series {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        Self(self.0.map(|a| a * k))
    }
}

impl Mul<Interval> for Series {
    type Output = Self;
    fn mul(self, k: Interval) -> Self {
        Self(self.0.map(|a| a * k))
    }
}

impl Mul for Series {
    type Output = Self;
    fn mul(self, g: Self) -> Self {
        let mut terms = [Interval::ZERO; TERMS];
        for (k, term) in terms.iter_mut().enumerate() {
            for j in 0..=k {
                *term = *term + self.0[j] * g.0[k - j];
            }
        }
        Self(terms)
    }
}
