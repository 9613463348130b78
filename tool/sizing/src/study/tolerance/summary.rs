//! Summary of a Monte Carlo study.

use super::ToleranceVerdict;
use crate::cell::Cell;
use jred_file::number::words::Word as _;

/// Two-sided 95 % of the normal distribution.
const Z: f64 = 1.959_963_984_540_054;

/// A probability from a count, with Wilson's interval of 95 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probability {
    /// k/n.
    pub share: f64,
    /// Ends of the interval.
    pub interval: [f64; 2],
}

impl Probability {
    /// The probability of `k` out of `n`; `None` if `n` is zero.
    pub fn new(k: u64, n: u64) -> Option<Self> {
        if n == 0 {
            return None;
        }
        let (k, n) = (k as f64, n as f64);
        let middle = k + 0.5 * Z * Z;
        let half = Z * (k * (n - k) / n + 0.25 * Z * Z).sqrt();
        let end = |x: f64| (x / (n + Z * Z)).clamp(0.0, 1.0);
        Some(Self {
            share: k / n,
            interval: [end(middle - half), end(middle + half)],
        })
    }
}

/// A quantile of values in rising order, interpolated linearly (type 7 of Hyndman and Fan); `None` without values.
pub fn quantile(sorted: &[f64], part: f64) -> Option<f64> {
    let place = part * sorted.len().checked_sub(1)? as f64;
    let below = place.floor() as usize;
    let low = *sorted.get(below)?;
    let high = sorted.get(below + 1).copied().unwrap_or(low);
    let rest = place - place.floor();
    // Two equal infinite shares have no difference.
    Some(if rest == 0.0 || low.total_cmp(&high).is_eq() {
        low
    } else {
        low + (high - low) * rest
    })
}

/// Counts and values, gathered row by row.
#[derive(Clone, Debug)]
pub struct Summary {
    /// Column of the verdict; the rules begin two columns after it.
    verdict: usize,
    /// Machines.
    pub machines: u64,
    /// Machines in which every rule is satisfied.
    pub hold: u64,
    /// Machines without a violation, but with a rule that cannot be checked although it can be for the nominal machine.
    pub unchecked: u64,
    /// Machines that the reader refused.
    pub refused: u64,
    /// For every rule the shares of its limit.
    pub shares: Vec<Vec<f64>>,
}

impl Summary {
    /// For rows with the verdict in this column, and this number of rules.
    pub fn new(verdict: usize, rules: usize) -> Self {
        Self {
            verdict,
            machines: 0,
            hold: 0,
            unchecked: 0,
            refused: 0,
            shares: vec![Vec::new(); rules],
        }
    }

    /// Machines that could be built as drawn.
    pub const fn built(&self) -> u64 {
        self.machines - self.refused
    }

    /// Adds a row.
    pub fn add(&mut self, cells: &[Cell]) {
        self.machines += 1;
        let verdict = cells.get(self.verdict).and_then(Cell::text);
        match verdict.and_then(ToleranceVerdict::of_word) {
            Some(ToleranceVerdict::Holds) => self.hold += 1,
            Some(ToleranceVerdict::Broken) => {}
            Some(ToleranceVerdict::NotChecked) => self.unchecked += 1,
            Some(ToleranceVerdict::Refused) | None => self.refused += 1,
        }
        for (shares, cell) in self
            .shares
            .iter_mut()
            .zip(cells.iter().skip(self.verdict + 2))
        {
            shares.extend(cell.number());
        }
    }
}
