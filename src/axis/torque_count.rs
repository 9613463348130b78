//! Torques as integers, for sums that never lose a digit.

use core::marker::PhantomData;

use super::AxisError;
use super::error::positive;
use crate::number::{Factor, Number, Quantity as _};
use crate::tick::MachineUnits;

/// Counts of the largest torque.
pub(super) const FULL: f32 = 1_048_576.0; // 2²⁰

/// Converts torques to counts: 2²⁰ for the largest torque, twice that at most.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct TorqueCount<N> {
    factor: Factor,
    /// Torque of a count (N·m).
    unit: f32,
    number: PhantomData<N>,
}

impl<N: Number> TorqueCount<N> {
    /// For torques up to `largest` (N·m).
    pub(super) fn new(
        largest: f32,
        model: &impl MachineUnits<Number = N>,
    ) -> Result<Self, AxisError> {
        let unit = positive("the largest torque", largest)? / FULL;
        let factor = Factor::to_count(model.scale().torque() / unit);
        let count = |factor| Self {
            factor,
            unit,
            number: PhantomData,
        };
        factor.map(count).ok_or(AxisError::OutOfRange {
            what: "the largest torque",
            value: largest,
            range: "near the torques of the machine",
        })
    }

    /// Limited to ±2²¹; `None` for NaN.
    #[inline]
    pub(super) fn of(&self, torque: N::Torque) -> Option<i32> {
        let none = N::Torque::default();
        let known = torque >= none || torque <= none;
        let count = torque.number().to_count(&self.factor);
        known.then(|| count.clamp(-(1 << 21), 1 << 21))
    }

    /// From counts to N·m.
    pub(super) fn si(&self, counts: f32) -> f32 {
        counts * self.unit
    }

    /// From N·m to the nearest count; 0 for NaN.
    pub(super) fn of_si(&self, torque: f32) -> i32 {
        nearest(torque / self.unit)
    }
}

/// The nearest count; 0 for NaN.
pub(super) fn nearest(counts: f32) -> i32 {
    (counts + if counts < 0.0 { -0.5 } else { 0.5 }) as i32
}

/// The covariance over these ticks of two figures with these sums, and this sum of their products. It is exact before the divisions: in single
/// precision the difference of two large means would have lost its digits.
pub(super) fn covariance(ticks: u32, [a, b]: [i64; 2], product: i64) -> f32 {
    let squared = i128::from(ticks) * i128::from(product) - i128::from(a) * i128::from(b);
    let ticks = ticks as f32;
    squared as f32 / ticks / ticks
}
