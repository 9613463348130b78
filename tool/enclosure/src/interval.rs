//! Intervals that contain the exact result, including rounding.
//!
//! Every bound is moved outward by one unit of the last place after each operation: IEEE 754 rounds sums, products, quotients and roots to the
//! nearest number, so that the exact result lies between the neighbours of the computed one. Sine and cosine of libm are off by less than one unit of
//! the last place, and are moved by two.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// All numbers from `lo` to `hi`. NaN and values beyond all numbers become [`ALL`](Self::ALL).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interval {
    lo: f64,
    hi: f64,
}

/// For larger angles, or over more than a turn, sine and cosine are bounded only by ±1.
const LARGEST_ANGLE: f64 = 1e6;

impl Interval {
    /// 0
    pub const ZERO: Self = Self::of(0.0);
    /// 1
    pub const ONE: Self = Self::of(1.0);
    /// Every number, such as for a quotient by an interval that contains zero.
    pub const ALL: Self = Self {
        lo: f64::NEG_INFINITY,
        hi: f64::INFINITY,
    };

    /// One number.
    #[must_use]
    pub const fn of(value: f64) -> Self {
        Self {
            lo: value,
            hi: value,
        }
    }

    /// Between two numbers, in any order.
    #[must_use]
    pub fn between(a: f64, b: f64) -> Self {
        // min and max ignore NaN.
        if a.is_nan() || b.is_nan() {
            return Self::checked(f64::NAN, f64::NAN);
        }
        Self::checked(a.min(b), a.max(b))
    }

    /// Numbers that differ from `middle` by at most `radius`.
    #[must_use]
    pub fn around(middle: f64, radius: f64) -> Self {
        Self::outward(middle - radius, middle + radius)
    }

    /// From `-size` to `size`.
    #[must_use]
    pub fn within(size: f64) -> Self {
        Self::between(-size, size)
    }

    /// 2π
    #[must_use]
    pub fn turn() -> Self {
        // The double is 2.4e-16 below 2π.
        Self {
            lo: TAU,
            hi: TAU.next_up(),
        }
    }

    const fn checked(lo: f64, hi: f64) -> Self {
        if lo <= hi && lo.is_finite() && hi.is_finite() {
            Self { lo, hi }
        } else {
            Self::ALL
        }
    }

    fn outward(lo: f64, hi: f64) -> Self {
        Self::checked(lo.next_down(), hi.next_up())
    }

    /// The least number.
    #[must_use]
    pub const fn lo(self) -> f64 {
        self.lo
    }

    /// The greatest number.
    #[must_use]
    pub const fn hi(self) -> f64 {
        self.hi
    }

    /// A number in the middle.
    #[must_use]
    pub fn middle(self) -> f64 {
        let middle = self.lo.midpoint(self.hi);
        if middle.is_finite() { middle } else { 0.0 }
    }

    /// The greatest magnitude.
    #[must_use]
    pub const fn size(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// The least magnitude.
    #[must_use]
    pub const fn least_size(self) -> f64 {
        if self.contains(0.0) {
            0.0
        } else {
            self.lo.abs().min(self.hi.abs())
        }
    }

    /// Distance of the ends, rounded up.
    #[must_use]
    pub fn width(self) -> f64 {
        (self.hi - self.lo).next_up()
    }

    /// Whether both ends are finite.
    #[must_use]
    pub const fn is_bounded(self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }

    /// Whether it contains a number.
    #[must_use]
    pub const fn contains(self, value: f64) -> bool {
        self.lo <= value && value <= self.hi
    }

    /// Whether it lies in another interval without touching its ends.
    #[must_use]
    pub const fn is_inside(self, other: Self) -> bool {
        other.lo < self.lo && self.hi < other.hi
    }

    /// The intersection. If it is empty, the first interval: then one of them is wrong, and no conclusion is possible.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let (lo, hi) = (self.lo.max(other.lo), self.hi.min(other.hi));
        if lo <= hi { Self { lo, hi } } else { self }
    }

    /// The smallest interval that contains both.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    /// x²
    #[must_use]
    pub fn square(self) -> Self {
        let (least, most) = (self.least_size(), self.size());
        let found = Self::outward(least * least, most * most);
        Self {
            lo: found.lo.max(0.0),
            ..found
        }
    }

    /// xⁿ
    #[must_use]
    pub fn power(self, n: usize) -> Self {
        let mut product = Self::ONE;
        for _ in 0..n / 2 {
            product = product * self.square();
        }
        if n % 2 == 1 { product * self } else { product }
    }

    /// √x of the numbers from zero on; [`ALL`](Self::ALL) if it contains a negative number.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.lo < 0.0 {
            return Self::ALL;
        }
        let found = Self::outward(self.lo.sqrt(), self.hi.sqrt());
        Self {
            lo: found.lo.max(0.0),
            ..found
        }
    }

    /// Sine and cosine.
    #[must_use]
    pub fn sin_cos(self) -> (Self, Self) {
        (self.wave(libm::sin, FRAC_PI_2), self.wave(libm::cos, 0.0))
    }

    /// A sine whose greatest value is at `crest`.
    fn wave(self, f: fn(f64) -> f64, crest: f64) -> Self {
        let unit = Self { lo: -1.0, hi: 1.0 };
        if self.size() > LARGEST_ANGLE || self.hi - self.lo > TAU {
            return unit;
        }
        let end = |x: f64| {
            let y = f(x);
            Self {
                lo: y.next_down().next_down(),
                hi: y.next_up().next_up(),
            }
        };
        let mut found = end(self.lo).hull(end(self.hi));
        // Half turns from the crest: integers are crests and troughs, included if they may lie within.
        let slack = 1e-9;
        let first = ((self.lo - crest) / PI - slack).ceil();
        let last = ((self.hi - crest) / PI + slack).floor();
        let mut k = first;
        while k <= last {
            found = found.hull(Self::of(if k.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }));
            k += 1.0;
        }
        Self {
            lo: found.lo.max(-1.0),
            hi: found.hi.min(1.0),
        }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::outward(self.lo + other.lo, self.hi + other.hi)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::outward(self.lo - other.hi, self.hi - other.lo)
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            lo: -self.hi,
            hi: -self.lo,
        }
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let zero = |x: Self| x.lo == 0.0 && x.hi == 0.0;
        if !self.is_bounded() || !other.is_bounded() {
            return Self::ALL;
        }
        if zero(self) || zero(other) {
            return Self::ZERO;
        }
        let [a, b, c, d] = [
            self.lo * other.lo,
            self.lo * other.hi,
            self.hi * other.lo,
            self.hi * other.hi,
        ];
        Self::outward(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}

impl Mul<f64> for Interval {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        self * Self::of(k)
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if !self.is_bounded() || !other.is_bounded() || other.contains(0.0) {
            return Self::ALL;
        }
        let [a, b, c, d] = [
            self.lo / other.lo,
            self.lo / other.hi,
            self.hi / other.lo,
            self.hi / other.hi,
        ];
        Self::outward(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}
