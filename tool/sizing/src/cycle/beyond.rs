//! Finds the samples with a large torque without visiting the others.

use super::Sample;
use super::extremes::Stretches;
use crate::cycle::form::{Coefficients, LOADS};

impl Stretches<'_> {
    /// Every sample at which |c·x| exceeds a bound, with c·x. Stretches that cannot contain one are skipped.
    pub(super) fn beyond(self, c: &Coefficients, bound: f64, mut take: impl FnMut(&Sample, f64)) {
        if !self.tree.nodes.is_empty() {
            self.look_beyond(c, bound, 0, &mut take);
        }
    }

    fn look_beyond(
        self,
        c: &Coefficients,
        bound: f64,
        index: usize,
        take: &mut impl FnMut(&Sample, f64),
    ) {
        let node = &self.tree.nodes[index];
        let [a, b] = self.ends(node, c);
        let reach: f64 = (0..LOADS).map(|k| c.0[k].abs() * node.reach[k]).sum();
        if a.abs().max(b.abs()) + reach < bound - self.slack(c) {
            return;
        }
        if node.second > 0 {
            self.look_beyond(c, bound, index + 1, take);
            self.look_beyond(c, bound, node.second as usize, take);
            return;
        }
        for sample in &self.samples[node.first as usize..=node.last as usize] {
            let torque = c.torque(&sample.loads());
            if torque.abs() > bound {
                take(sample, torque);
            }
        }
    }
}
