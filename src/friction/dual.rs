//! Numbers with their gradient.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::math;

/// A number with its partial derivatives with respect to N variables: forward-mode differentiation.
///
/// Arithmetic follows the rules of differentiation: a formula written once gives its gradient to rounding, without finite differences. Start with
/// [`variable`](Self::variable) for each variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value.
    pub value: f64,
    /// Its partial derivatives, one per variable.
    pub slope: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// A number independent of all variables.
    #[must_use]
    pub const fn constant(value: f64) -> Self {
        Self {
            value,
            slope: [0.0; N],
        }
    }

    /// Variable number `index` at `value`; a constant if there is no such variable.
    #[must_use]
    pub fn variable(value: f64, index: usize) -> Self {
        let mut variable = Self::constant(value);
        if let Some(slope) = variable.slope.get_mut(index) {
            *slope = 1.0;
        }
        variable
    }

    /// All N variables at a place.
    #[must_use]
    pub fn variables(place: &[f64; N]) -> [Self; N] {
        let mut index = 0;
        place.map(|value| {
            let variable = Self::variable(value, index);
            index += 1;
            variable
        })
    }

    /// f(self) for a function with the given value and derivative there: the chain rule.
    #[must_use]
    pub fn through(self, value: f64, derivative: f64) -> Self {
        Self {
            value,
            slope: self.slope.map(|s| s * derivative),
        }
    }

    /// Sine and cosine.
    #[must_use]
    pub fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = math::sin_cos(self.value);
        (self.through(sin, cos), self.through(cos, -sin))
    }

    /// Square root; the derivatives are infinite at zero.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let root = math::sqrt(self.value);
        self.through(root, 0.5 / root)
    }

    /// Whether value and derivatives are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.value.is_finite() && self.slope.iter().all(|s| s.is_finite())
    }

    /// `value`, with the slopes a·self′ + b·other′.
    fn combine(self, other: Self, value: f64, [a, b]: [f64; 2]) -> Self {
        let mut slope = self.slope;
        for (s, o) in slope.iter_mut().zip(other.slope) {
            *s = a * *s + b * o;
        }
        Self { value, slope }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, self.value + other.value, [1.0, 1.0])
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.combine(other, self.value - other.value, [1.0, -1.0])
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, self.value * other.value, [other.value, self.value])
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        let [a, b] = [1.0 / other.value, -quotient / other.value];
        self.combine(other, quotient, [a, b])
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.through(-self.value, -1.0)
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        self.through(self.value + other, 1.0)
    }
}

impl<const N: usize> Sub<f64> for Dual<N> {
    type Output = Self;
    fn sub(self, other: f64) -> Self {
        self.through(self.value - other, 1.0)
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        self.through(self.value * other, other)
    }
}

impl<const N: usize> Div<f64> for Dual<N> {
    type Output = Self;
    fn div(self, other: f64) -> Self {
        self.through(self.value / other, 1.0 / other)
    }
}

impl<const N: usize> From<f64> for Dual<N> {
    fn from(value: f64) -> Self {
        Self::constant(value)
    }
}
