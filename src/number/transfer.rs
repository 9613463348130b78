//! A quantity of a mechanism together with its transfer functions.

use core::ops::{Add, Mul, Neg, Sub};

use crate::math;

/// A quantity f(φ) with its transfer functions of first, second and third order: f, f′, f″, f‴, where ′ is d/dφ.
///
/// Arithmetic on `Transfer` follows the rules of differentiation (Leibniz, chain rule): a closed form written once in positions gives exact
/// velocities and accelerations, and J_red″, without finite differences.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Transfer {
    /// f
    pub value: f64,
    /// f′, the velocity analogue: ḟ = f′·ω
    pub d1: f64,
    /// f″: f̈ = f′·α + f″·ω²
    pub d2: f64,
    /// f‴
    pub d3: f64,
}

impl Transfer {
    /// A quantity independent of φ.
    #[must_use]
    pub const fn constant(value: f64) -> Self {
        Self {
            value,
            d1: 0.0,
            d2: 0.0,
            d3: 0.0,
        }
    }

    /// φ itself: f′ = 1.
    #[must_use]
    pub const fn variable(phi: f64) -> Self {
        Self {
            value: phi,
            d1: 1.0,
            d2: 0.0,
            d3: 0.0,
        }
    }

    /// Sine and cosine of an angle.
    #[must_use]
    pub fn sin_cos(self) -> (Self, Self) {
        let (s, c) = math::sin_cos(self.value);
        self.with_sin_cos(s, c)
    }

    /// Sine and cosine of an angle whose values `s` and `c` are known.
    pub(crate) fn with_sin_cos(self, s: f64, c: f64) -> (Self, Self) {
        let Self { d1, d2, d3, .. } = self;
        let sin = Self {
            value: s,
            d1: c * d1,
            d2: c * d2 - s * d1 * d1,
            d3: c * (d3 - d1 * d1 * d1) - 3.0 * s * d1 * d2,
        };
        let cos = Self {
            value: c,
            d1: -s * d1,
            d2: -s * d2 - c * d1 * d1,
            d3: -s * (d3 - d1 * d1 * d1) - 3.0 * c * d1 * d2,
        };
        (sin, cos)
    }

    /// Square root, from y² = f differentiated three times. The derivatives are infinite at f = 0, a dead point that the caller handles.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let y = math::sqrt(self.value);
        let d1 = self.d1 / (2.0 * y);
        let d2 = (self.d2 - 2.0 * d1 * d1) / (2.0 * y);
        let d3 = (self.d3 - 6.0 * d1 * d2) / (2.0 * y);
        Self {
            value: y,
            d1,
            d2,
            d3,
        }
    }

    /// Quotient, from q·g = f differentiated three times.
    #[must_use]
    pub fn over(self, g: Self) -> Self {
        let value = self.value / g.value;
        let d1 = (self.d1 - value * g.d1) / g.value;
        let d2 = (self.d2 - 2.0 * d1 * g.d1 - value * g.d2) / g.value;
        let d3 = (self.d3 - 3.0 * (d2 * g.d1 + d1 * g.d2) - value * g.d3) / g.value;
        Self { value, d1, d2, d3 }
    }

    /// The angle with this sine and cosine, which must satisfy s² + c² = 1: ψ′ = c·s′ − s·c′.
    #[must_use]
    pub fn angle(sin: Self, cos: Self) -> Self {
        let speed = cos * sin.derivative() - sin * cos.derivative();
        Self {
            value: math::atan2(sin.value, cos.value),
            d1: speed.value,
            d2: speed.d1,
            d3: speed.d2,
        }
    }

    /// f(g(φ)), the chain rule, where `self` is f with its derivatives with respect to g, at the value of `g`.
    #[must_use]
    pub fn after(self, g: Self) -> Self {
        Self {
            value: self.value,
            d1: self.d1 * g.d1,
            d2: self.d2 * g.d1 * g.d1 + self.d1 * g.d2,
            d3: self.d3 * g.d1 * g.d1 * g.d1 + 3.0 * self.d2 * g.d1 * g.d2 + self.d1 * g.d3,
        }
    }

    /// f′ with its transfer functions; its third order is unknown and left zero.
    pub(crate) const fn derivative(self) -> Self {
        Self {
            value: self.d1,
            d1: self.d2,
            d2: self.d3,
            d3: 0.0,
        }
    }

    /// Velocity ḟ = f′·ω.
    #[must_use]
    pub fn velocity(self, omega: f64) -> f64 {
        self.d1 * omega
    }

    /// Acceleration f̈ = f′·α + f″·ω².
    #[must_use]
    pub fn acceleration(self, omega: f64, alpha: f64) -> f64 {
        self.d1 * alpha + self.d2 * omega * omega
    }
}

impl Add for Transfer {
    type Output = Self;
    #[inline]
    fn add(self, g: Self) -> Self {
        Self {
            value: self.value + g.value,
            d1: self.d1 + g.d1,
            d2: self.d2 + g.d2,
            d3: self.d3 + g.d3,
        }
    }
}

impl Sub for Transfer {
    type Output = Self;
    #[inline]
    fn sub(self, g: Self) -> Self {
        self + -g
    }
}

impl Neg for Transfer {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl Mul<f64> for Transfer {
    type Output = Self;
    #[inline]
    fn mul(self, k: f64) -> Self {
        Self {
            value: self.value * k,
            d1: self.d1 * k,
            d2: self.d2 * k,
            d3: self.d3 * k,
        }
    }
}

impl Mul for Transfer {
    type Output = Self;
    #[inline]
    fn mul(self, g: Self) -> Self {
        let f = self;
        Self {
            value: f.value * g.value,
            d1: f.d1 * g.value + f.value * g.d1,
            d2: f.d2 * g.value + 2.0 * f.d1 * g.d1 + f.value * g.d2,
            d3: f.d3 * g.value + 3.0 * (f.d2 * g.d1 + f.d1 * g.d2) + f.value * g.d3,
        }
    }
}
