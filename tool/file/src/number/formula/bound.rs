//! Bounds of a formula over intervals of its variables.

use crate::math;
use jred_enclosure::Interval;

use super::{Expression, FUNCTIONS, Formula, Operation};

/// Largest relative error of libm's functions, with a margin.
const FUNCTION_ERROR: f64 = 8.0 * f64::EPSILON;

/// Largest whole exponent that is multiplied out.
const LARGEST_EXPONENT: f64 = 64.0;

impl Formula {
    /// An interval that contains all its values while each variable is anywhere in its interval; all numbers if there may be a pole.
    pub fn bounds(&self, variables: &[Interval]) -> Interval {
        bounds(&self.root, variables)
    }
}

fn bounds(node: &Expression, variables: &[Interval]) -> Interval {
    match node {
        Expression::Number(number) => Interval::of(*number),
        Expression::Variable(k) => variables.get(*k).copied().unwrap_or(Interval::ALL),
        Expression::Negative(inner) => -bounds(inner, variables),
        Expression::Call(function, inner) => {
            let inner = bounds(inner, variables);
            if inner.is_bounded() {
                FUNCTIONS[*function].1.1(inner)
            } else {
                Interval::ALL
            }
        }
        Expression::Pair(operation, pair) => {
            let [a, b] = [&pair[0], &pair[1]].map(|node| bounds(node, variables));
            match operation {
                Operation::Plus => a + b,
                Operation::Minus => a - b,
                Operation::Times if pair[0] == pair[1] => a.square(),
                Operation::Times => a * b,
                Operation::Over => a / b,
                Operation::Power => power(a, b),
            }
        }
    }
}

/// aᵇ: by products for a whole exponent, otherwise only for positive a.
fn power(a: Interval, b: Interval) -> Interval {
    if !a.is_bounded() || !b.is_bounded() {
        return Interval::ALL;
    }
    let exponent = b.lo();
    if b.hi() - b.lo() > 0.0 {
        return if a.lo() > 0.0 {
            exp(b * ln(a))
        } else {
            Interval::ALL
        };
    }
    if exponent.fract() == 0.0 && exponent.abs() <= LARGEST_EXPONENT {
        let whole = a.power(exponent.abs() as usize);
        return if exponent < 0.0 {
            Interval::ONE / whole
        } else {
            whole
        };
    }
    if a.lo() > 0.0 || (a.lo() == 0.0 && exponent > 0.0) {
        let [low, high] = [a.lo(), a.hi()].map(|x| rounded(math::pow(x, exponent)));
        return low.hull(high);
    }
    Interval::ALL
}

/// A value of libm, with its error.
fn rounded(value: f64) -> Interval {
    Interval::around(value, FUNCTION_ERROR * value.abs())
}

/// A rising function.
fn rising(x: Interval, f: fn(f64) -> f64) -> Interval {
    rounded(f(x.lo())).hull(rounded(f(x.hi())))
}

pub(super) fn tan(x: Interval) -> Interval {
    let (sin, cos) = x.sin_cos();
    let quotient = sin / cos;
    // Between two poles it rises.
    if quotient.is_bounded() {
        quotient.and(rising(x, math::tan))
    } else {
        quotient
    }
}

pub(super) fn atan(x: Interval) -> Interval {
    rising(x, math::atan)
}

pub(super) fn tanh(x: Interval) -> Interval {
    rising(x, math::tanh)
}

pub(super) fn exp(x: Interval) -> Interval {
    if x.is_bounded() {
        rising(x, math::exp)
    } else {
        Interval::ALL
    }
}

pub(super) fn ln(x: Interval) -> Interval {
    if x.lo() > 0.0 {
        rising(x, math::ln)
    } else {
        Interval::ALL
    }
}
