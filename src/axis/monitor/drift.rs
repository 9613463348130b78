//! A figure of each cycle that must not drift.

use crate::number::Real;

/// Two-sided CUSUM (E. S. Page, *Continuous inspection schemes*, Biometrika 41 (1954) 100) of one number a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Drift {
    cycles: u32,
    /// The first number, from which the sums count; then the mean.
    pub(super) mean: f32,
    sum: f32,
    squares: f32,
    /// 1/(2·σ); 0: not known, or the number is always the same.
    pub(super) scale: f32,
    /// Sums of what exceeds the allowance, upwards and downwards.
    sums: [f32; 2],
}

/// A deviation of a cycle that counts for nothing, in units of 2·σ.
const ALLOWANCE: f32 = 1.0;

impl Drift {
    /// Adds the number of a reference cycle.
    pub(super) fn learn(&mut self, number: f32) {
        if self.cycles == 0 {
            self.mean = number;
        }
        let off = number - self.mean;
        self.cycles = self.cycles.saturating_add(1);
        self.sum += off;
        self.squares += off * off;
    }

    /// Ends learning; `least` is a σ below the resolution of the numbers.
    pub(super) fn finish(&mut self, least: f32) {
        let cycles = self.cycles as f32;
        let mean = self.sum / cycles;
        let variance = (self.squares - mean * self.sum) / (cycles - 1.0);
        let deviation = if variance > 0.0 {
            Real::sqrt(variance)
        } else {
            0.0
        };
        let deviation = deviation + least;
        *self = Self {
            mean: self.mean + mean,
            scale: if deviation > 0.0 {
                0.5 / deviation
            } else {
                0.0
            },
            ..Self::default()
        };
    }

    /// Takes the number of a cycle: how far it is from the mean, and whether a sum exceeds the limit.
    pub(super) fn judge(&mut self, number: f32, limit: f32) -> (f32, bool) {
        let off = number - self.mean;
        let [up, down] = self.sums;
        let next = |sum: f32, off: f32| {
            let sum = sum + off * self.scale - ALLOWANCE;
            // Not beyond twice the limit, so that an alarm ends when its cause does.
            if sum > 2.0 * limit {
                2.0 * limit
            } else if sum > 0.0 {
                sum
            } else {
                0.0
            }
        };
        let sums = [next(up, off), next(down, -off)];
        self.sums = sums;
        (off, sums.iter().any(|sum| *sum > limit))
    }
}
