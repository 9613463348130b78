//! Integrals of functions of torque and speed that have bends: a current beyond the knee of saturation, the loss of S1 torque with speed.
//!
//! Between the samples of a panel torque and speed are polynomials. Where the function bends within a panel, the panel's quadrature is not accurate
//! enough; the panel is then halved until it is.

use super::extremes::Stretches;
use crate::cycle::form::Coefficients;
use jred_analysis::duty::Panel;

/// Allowed error of the integral over a panel, as a share of it, and as a share of the reference value.
const PANEL_TOLERANCE: f64 = 1e-10;
const TOTAL_TOLERANCE: f64 = 1e-10;

/// A torque over the samples of a cycle.
pub(crate) struct TorqueIntegrals<'c> {
    stretches: Stretches<'c>,
    c: &'c Coefficients,
    ratio: f64,
}

impl<'c> TorqueIntegrals<'c> {
    pub(super) const fn new(stretches: Stretches<'c>, c: &'c Coefficients, ratio: f64) -> Self {
        Self {
            stretches,
            c,
            ratio,
        }
    }

    /// Torque and speed of the motor at a sample.
    fn at(&self, k: usize) -> [f64; 2] {
        let sample = &self.stretches.samples[k];
        [self.c.torque(&sample.loads()), sample.speed() * self.ratio]
    }

    /// The integral of a function over the whole cycle.
    pub(crate) fn over_all(&self, whole: f64, f: impl Fn(f64, f64) -> f64) -> f64 {
        let count = self.stretches.samples.len();
        let mut sum = 0.0;
        let mut k = 0;
        while k < count {
            let (part, next) = self.part(k, whole, &f);
            sum += part;
            k = next;
        }
        sum
    }

    /// The integral of a function over the panels of these samples, which are in order.
    pub(crate) fn over(&self, samples: &[usize], whole: f64, f: impl Fn(f64, f64) -> f64) -> f64 {
        let mut sum = 0.0;
        let mut done = 0;
        for &k in samples {
            if k >= done {
                let (part, next) = self.part(k, whole, &f);
                sum += part;
                done = next;
            }
        }
        sum
    }

    /// The integral of a function over the panels of these samples (in order), less their weighted sum.
    pub(crate) fn more(&self, samples: &[usize], whole: f64, f: impl Fn(f64, f64) -> f64) -> f64 {
        let mut sum = 0.0;
        let mut done = 0;
        for &k in samples {
            if k < done {
                continue;
            }
            if let Some((panel, end)) = self.panel(k) {
                sum += self.exact(&panel, whole, &f) - self.ruled(&panel, &f);
                done = end;
            }
        }
        sum
    }

    /// The integral over the panel of a sample, or the sample's own term of a sum if it has no panel; and the next sample.
    fn part(&self, k: usize, whole: f64, f: &impl Fn(f64, f64) -> f64) -> (f64, usize) {
        if let Some((panel, end)) = self.panel(k) {
            return (self.exact(&panel, whole, f), end);
        }
        let weight = self.stretches.samples[k].weight;
        let [torque, speed] = self.at(k);
        // A sample without weight adds nothing, even if the function has no value there.
        (
            if weight > 0.0 {
                weight * f(torque, speed)
            } else {
                0.0
            },
            k + 1,
        )
    }

    fn panel(&self, k: usize) -> Option<(Panel, usize)> {
        let range = (self.stretches.smooth).panel_of(k, self.stretches.samples.len())?;
        let end = range.end;
        Some((self.stretches.panel(range)?, end))
    }

    fn ruled(&self, panel: &Panel, f: &impl Fn(f64, f64) -> f64) -> f64 {
        let terms = panel.indices().iter().map(|&k| {
            let [torque, speed] = self.at(k);
            self.stretches.samples[k].weight * f(torque, speed)
        });
        terms.sum()
    }

    fn exact(&self, panel: &Panel, whole: f64, f: &impl Fn(f64, f64) -> f64) -> f64 {
        let values = panel.values(|k| {
            let [torque, speed] = self.at(k);
            f(torque, speed)
        });
        let found = panel.rule().estimate(values.known());
        let half = panel.half();
        let least = TOTAL_TOLERANCE * whole;
        let is_enough = half * found.error <= (PANEL_TOLERANCE * half * found.size).max(least);
        if is_enough || !found.error.is_finite() {
            return half * found.integral;
        }
        let torques = panel.values(|k| self.at(k)[0]);
        let speeds = panel.values(|k| self.at(k)[1]);
        let still = self.c.0.iter().all(|c| *c == 0.0);
        let between = |x: f64| f(if still { 0.0 } else { torques.at(x) }, speeds.at(x));
        let sum = panel
            .rule()
            .adaptive([-1.0, 1.0], (PANEL_TOLERANCE, least / half), &between);
        // Between the samples there may be a torque that no current gives.
        half * if sum.is_finite() { sum } else { found.integral }
    }
}

impl Stretches<'_> {
    /// Samples, in order, of all panels for whose range of speeds (rad/s, at the gearbox output, without sign) `is_open` is true.
    pub(super) fn at_speeds(self, is_open: &impl Fn([f64; 2]) -> bool) -> Vec<usize> {
        let mut found = Vec::new();
        if !self.tree.nodes.is_empty() {
            self.look_at_speeds(is_open, 0, &mut found);
        }
        found
    }

    fn look_at_speeds(
        self,
        is_open: &impl Fn([f64; 2]) -> bool,
        index: usize,
        found: &mut Vec<usize>,
    ) {
        let node = &self.tree.nodes[index];
        if !is_open(node.speed) {
            return;
        }
        if node.second == 0 {
            found.extend(node.first as usize..=node.last as usize);
            return;
        }
        self.look_at_speeds(is_open, index + 1, found);
        // The bend may lie between the samples of both halves.
        let last = self.tree.nodes[index + 1].last as usize;
        let [a, b] = [last, last + 1].map(|k| self.samples[k].speed().abs());
        if is_open([a.min(b), a.max(b)]) {
            found.push(last + 1);
        }
        self.look_at_speeds(is_open, node.second as usize, found);
    }
}
