//! Finds the samples with a large torque without visiting the others.

use super::extremes::Stretches;
use crate::cycle::form::Coefficients;

impl Stretches<'_> {
    /// Every sample at which |c·x| exceeds a bound, by its index. Stretches that cannot contain one are skipped.
    pub(super) fn beyond(self, c: &Coefficients, bound: f64, mut take: impl FnMut(usize)) {
        if !self.tree.nodes.is_empty() {
            self.look_beyond(c, bound, 0, &mut take);
        }
    }

    fn look_beyond(self, c: &Coefficients, bound: f64, index: usize, take: &mut impl FnMut(usize)) {
        let node = &self.tree.nodes[index];
        let [a, b] = self.ends(node, c);
        if a.abs().max(b.abs()) + node.reach_of(c) < bound - self.slack(c) {
            return;
        }
        if node.second > 0 {
            self.look_beyond(c, bound, index + 1, take);
            self.look_beyond(c, bound, node.second as usize, take);
            return;
        }
        for k in node.first as usize..=node.last as usize {
            if c.torque(&self.samples[k].loads()).abs() > bound {
                take(k);
            }
        }
    }
}
