//! The common period of cycles.
//!
//! Periods are decimal input values or quotients of them, as floating-point numbers. Two periods match if integer multiples of them agree to within
//! the tolerance of the search over phases. Long common periods must agree to within rounding, because any two numbers are nearly in the ratio of
//! large enough integers.

use super::curve::PowerCurve;

/// Largest number of cycles of an axis in a common period that is searched for the worst phases.
pub const MOST_CYCLES: u32 = 256;

/// Largest number of cycles that is tried for a common period.
pub const LOOKED_AT: u32 = 100_000;

/// Relative tolerance with which periods must match.
const PERIOD_TOLERANCE: f64 = 1e-9;

/// The same for long common periods: a few rounding errors. Among 100 000 numbers of cycles one fits by chance in one of a thousand pairs.
const LONG_PERIOD_TOLERANCE: f64 = 1e-13;

/// Whether cycles repeat together.
#[derive(Clone, Debug, PartialEq)]
pub enum Common {
    /// They do, within [`MOST_CYCLES`].
    Searched {
        /// The shortest common period (s).
        period: f64,
        /// Cycles of each axis in it.
        cycles: Vec<u32>,
    },
    /// They do, but not within [`MOST_CYCLES`].
    TooLong {
        /// The shortest common period (s).
        period: f64,
        /// Cycles of each axis in it.
        cycles: Vec<u32>,
    },
    /// Not within [`LOOKED_AT`] cycles.
    None,
}

impl Common {
    /// The common period of these curves.
    pub(super) fn of(curves: &[PowerCurve]) -> Self {
        let periods: Vec<f64> = curves.iter().map(PowerCurve::period).collect();
        if let Some((period, cycles)) = shortest(&periods, MOST_CYCLES, PERIOD_TOLERANCE) {
            return Self::Searched { period, cycles };
        }
        match shortest(&periods, LOOKED_AT, LONG_PERIOD_TOLERANCE) {
            Some((period, cycles)) => Self::TooLong { period, cycles },
            None => Self::None,
        }
    }

    /// The curves over the common period; empty if that is not searched.
    pub(super) fn repeated(&self, curves: &[PowerCurve]) -> Vec<PowerCurve> {
        let Self::Searched { cycles, .. } = self else {
            return Vec::new();
        };
        let each = curves.iter().zip(cycles);
        each.map(|(curve, count)| curve.repeated(*count)).collect()
    }

    /// Largest phase (s) of each axis up to which the bus behaves differently.
    ///
    /// Only the phases between the axes matter, and time may start at any cycle of any axis. So the phase of an axis counts up to the greatest common
    /// divisor of its own period and the common period of the axes before it. With n₁ and n₂ cycles of two axes in the common period T that is
    /// T/(n₁·n₂).
    pub(super) fn reach(&self) -> Vec<f64> {
        let Self::Searched { period, cycles } = self else {
            return Vec::new();
        };
        let mut before = 0;
        let reach = cycles.iter().map(|own| {
            // lcm(own, before); before is zero only for the first axis, whose phase is the reference.
            let parts = f64::from(*own) * f64::from(before / divisor(*own, before));
            before = divisor(*own, before);
            if parts > 0.0 { period / parts } else { 0.0 }
        });
        reach.collect()
    }
}

/// The greatest common divisor; of zero and a number, the number.
const fn divisor(a: u32, b: u32) -> u32 {
    let (mut a, mut b) = (a, b);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

fn shortest(periods: &[f64], most: u32, fit: f64) -> Option<(f64, Vec<u32>)> {
    let first = *periods.first()?;
    (1..=most).find_map(|count| {
        let whole = first * f64::from(count);
        let cycles = periods.iter().map(|period| {
            let times = whole / period;
            let near = times.round();
            let fits =
                (1.0..=f64::from(most)).contains(&near) && (times - near).abs() <= fit * near;
            fits.then_some(near as u32)
        });
        Some((whole, cycles.collect::<Option<Vec<u32>>>()?))
    })
}
