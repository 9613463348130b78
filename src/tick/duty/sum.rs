//! Sums that keep their digits.

use crate::math::Real;

/// A compensated sum (Kahan): `low` is the rounding error of the last addition, and enters the next.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Sum<R> {
    high: R,
    low: R,
}

impl<R: Real> Sum<R> {
    pub(super) fn zero() -> Self {
        let zero = R::from_f64(0.0);
        Self {
            high: zero,
            low: zero,
        }
    }

    #[inline]
    pub(super) fn value(self) -> R {
        self.high
    }

    #[inline]
    pub(super) fn add(&mut self, term: R) {
        let term = term + self.low;
        let sum = self.high + term;
        self.low = term - (sum - self.high);
        self.high = sum;
    }
}
