//! Taylor forms: a polynomial about the middle of a stretch, and a remainder over the stretch.

use std::ops::{Add, Mul, Neg, Sub};

use crate::interval::Interval;
use crate::series::{REMAINDER, Series};

/// A quantity over a stretch of φ with the middle m: for every position m + t of it
///
/// ```text
/// f(m + t) ∈ Σ atₖ·tᵏ + over_R·tᴿ,   k < R = REMAINDER
/// ```
///
/// `at` contains the coefficients in the middle, `over` the coefficients at all positions of the stretch: Lagrange's remainder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaylorForm {
    /// Coefficients in the middle.
    pub at: Series,
    /// Coefficients anywhere on the stretch.
    pub over: Series,
}

impl TaylorForm {
    /// A quantity that lies in an interval everywhere. It need not be constant, nor smooth; do not use its derivative.
    #[must_use]
    pub const fn somewhere(value: Interval) -> Self {
        Self {
            at: Series::constant(value),
            over: Series::constant(value),
        }
    }

    /// A number.
    #[must_use]
    pub const fn constant(value: f64) -> Self {
        Self::somewhere(Interval::of(value))
    }

    /// φ between two positions.
    #[must_use]
    pub fn variable([from, to]: [f64; 2]) -> Self {
        Self {
            at: Series::variable(Interval::of(from.midpoint(to))),
            over: Series::variable(Interval::between(from, to)),
        }
    }

    fn both(self, of: impl Fn(&Series) -> Series) -> Self {
        Self {
            at: of(&self.at),
            over: of(&self.over),
        }
    }

    /// f′
    #[must_use]
    pub fn derivative(&self) -> Self {
        self.both(Series::derivative)
    }

    /// f²
    #[must_use]
    pub fn square(&self) -> Self {
        self.both(Series::square)
    }

    /// √f
    #[must_use]
    pub fn sqrt(&self) -> Self {
        self.both(Series::sqrt)
    }

    /// f/g
    #[must_use]
    pub fn over(&self, g: &Self) -> Self {
        Self {
            at: self.at.over(&g.at),
            over: self.over.over(&g.over),
        }
    }

    /// Sine and cosine of an angle.
    #[must_use]
    pub fn sin_cos(&self) -> (Self, Self) {
        let ((sin, cos), (all_sin, all_cos)) = (self.at.sin_cos(), self.over.sin_cos());
        let form = |at, over| Self { at, over };
        (form(sin, all_sin), form(cos, all_cos))
    }

    /// The possible values, anywhere on the stretch.
    #[must_use]
    pub const fn values(&self) -> Interval {
        self.over.0[0]
    }

    /// |f|: where f may change its sign, the range from zero to its magnitude.
    #[must_use]
    pub fn magnitude(&self) -> Self {
        let values = self.values();
        if values.lo() >= 0.0 {
            *self
        } else if values.hi() <= 0.0 {
            -*self
        } else {
            Self::somewhere(Interval::between(0.0, values.size()))
        }
    }

    /// √(f² + g²): where both may be zero, the range from zero to the largest possible value.
    #[must_use]
    pub fn length(&self, g: &Self) -> Self {
        let squared = self.square() + g.square();
        if squared.values().lo() > 0.0 {
            return squared.sqrt();
        }
        let most = Interval::of(squared.values().hi().max(0.0)).sqrt();
        Self::somewhere(Interval::between(0.0, most.size()))
    }

    /// f(g(φ)) of a polynomial f = Σ cₖ·gᵏ.
    #[must_use]
    pub fn polynomial(&self, coefficients: &[f64]) -> Self {
        let start = Self::constant(0.0);
        let horner = |sum: Self, c: &f64| sum * *self + Self::constant(*c);
        coefficients.iter().rev().fold(start, horner)
    }

    /// Greatest width of the values at one position, on a stretch of this half width.
    #[must_use]
    pub fn slack(&self, half: f64) -> f64 {
        let mut width = 0.0;
        let mut power = 1.0;
        for term in &self.at.0[..REMAINDER] {
            width += term.width() * power;
            power *= half;
        }
        width + self.over.0[REMAINDER].size() * power
    }
}

impl Add for TaylorForm {
    type Output = Self;
    fn add(self, g: Self) -> Self {
        Self {
            at: self.at + g.at,
            over: self.over + g.over,
        }
    }
}

impl Sub for TaylorForm {
    type Output = Self;
    fn sub(self, g: Self) -> Self {
        self + -g
    }
}

impl Neg for TaylorForm {
    type Output = Self;
    fn neg(self) -> Self {
        self.both(|f| -*f)
    }
}

impl Mul for TaylorForm {
    type Output = Self;
    fn mul(self, g: Self) -> Self {
        Self {
            at: self.at * g.at,
            over: self.over * g.over,
        }
    }
}

impl Mul<f64> for TaylorForm {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        self.both(|f| *f * k)
    }
}
