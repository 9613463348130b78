//! The torque that is usual in one part of the range.

use super::super::torque_count::{covariance, nearest};
use crate::number::Real;

/// Sums of the reference cycles in a bin, then what is usual there; torques in counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Bin {
    /// Ticks of the reference cycles.
    pub(super) ticks: u32,
    /// While learning the first torque, from which the sums count; later the mean.
    pub(super) mean: i32,
    sum: i64,
    squares: i64,
    /// After learning σ and a count, in counts; 0: not known.
    pub(super) deviation: f32,
    /// The least deviation from the mean that is no noise; 0: not known.
    pub(super) limit: i32,
    /// 2²⁴/σ, at most 2²⁴.
    pub(super) inverse: i32,
    /// The payload's torque; after learning without its mean over a cycle.
    pub(super) weight: i32,
}

/// Ticks without which a bin is not known.
const LEAST: u32 = 16;

impl Bin {
    /// Adds a torque of a reference cycle.
    #[inline]
    pub(super) fn learn(&mut self, torque: i32) {
        if self.ticks == 0 {
            self.mean = torque;
        }
        let off = i64::from(torque - self.mean);
        self.ticks = self.ticks.saturating_add(1);
        self.sum = self.sum.saturating_add(off);
        self.squares = self.squares.saturating_add(off * off);
    }

    /// Whether the reference cycles passed here often enough.
    pub(super) const fn is_known(&self) -> bool {
        self.ticks >= LEAST
    }

    /// 1/σ.
    pub(super) fn precision(&self) -> f32 {
        self.inverse as f32 / 16_777_216.0
    }

    /// Mean and variance relative to `mean`, in counts.
    pub(super) fn moments(&self) -> [f32; 2] {
        let mean = self.sum as f32 / self.ticks as f32;
        let variance = covariance(self.ticks, [self.sum; 2], self.squares);
        // A sum at its limit may leave less than 0.
        [mean, if variance > 0.0 { variance } else { 0.0 }]
    }

    /// Ends learning, with the variance of all bins as the least.
    pub(super) fn finish(&mut self, least: f32) {
        let [mean, variance] = self.moments();
        let variance = if variance > least { variance } else { least };
        self.mean += nearest(mean);
        self.deviation = Real::sqrt(variance) + 1.0;
        [self.sum, self.squares] = [0; 2];
    }

    /// With the multiple of σ that is no noise, after learning.
    pub(super) fn set_limit(&mut self, multiple: f32) {
        self.limit = (multiple * self.deviation) as i32;
        self.inverse = (16_777_216.0 / self.deviation) as i32;
    }
}
