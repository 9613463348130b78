//! Signs of the power over a cycle: energy put in and taken back, by stretches of the [tree](super::tree).

use super::Sample;
use super::extremes::Stretches;
use super::tree::Direction;
use crate::cycle::form::{Coefficients, LOADS};

impl Stretches<'_> {
    /// Work that the motor puts in and work that it takes back (J): ∫max(P, 0) and ∫max(−P, 0). Where the power keeps its
    /// sign over a stretch its work is a linear form; samples are looked at only around its zeros.
    pub(super) fn energies(self, c: &Coefficients, ratio: f64) -> [f64; 2] {
        let mut sums = [0.0; 2];
        if !self.tree.nodes.is_empty() {
            self.add_energy(c, self.slack(c), 0, &mut sums);
        }
        sums.map(|sum| sum * ratio)
    }

    fn add_energy(self, c: &Coefficients, slack: f64, index: usize, sums: &mut [f64; 2]) {
        let node = &self.tree.nodes[index];
        if node.speed[1] == 0.0 {
            return;
        }
        let mut add = |work: f64| {
            let [motoring, regenerative] = sums;
            *motoring += work.max(0.0);
            *regenerative += (-work).max(0.0);
        };
        let ends = self.ends(node, c);
        let reach: f64 = (0..LOADS).map(|k| c.0[k].abs() * node.reach[k]).sum();
        let one_sign =
            ends[0].min(ends[1]) - reach >= -slack || ends[0].max(ends[1]) + reach <= slack;
        if one_sign && node.direction != Direction::Any {
            add(c.torque(&node.energy));
        } else if node.second == 0 {
            for sample in &self.samples[node.first as usize..=node.last as usize] {
                add(sample.weight * sample.speed() * c.torque(&sample.loads()));
            }
        } else {
            self.add_energy(c, slack, index + 1, sums);
            self.add_energy(c, slack, node.second as usize, sums);
        }
    }

    /// Whether any sample's power is negative, by more than rounding.
    pub(super) fn regenerates(self, c: &Coefficients) -> bool {
        fn visit(stretches: Stretches, c: &Coefficients, slack: f64, index: usize) -> bool {
            let node = &stretches.tree.nodes[index];
            let back = |s: &Sample| s.speed() * c.torque(&s.loads()) < -slack * s.speed().abs();
            if [node.first, node.last]
                .iter()
                .any(|k| back(&stretches.samples[*k as usize]))
            {
                return true;
            }
            let [a, b] = stretches.ends(node, c);
            let reach: f64 = (0..LOADS).map(|k| c.0[k].abs() * node.reach[k]).sum();
            let only_driving = match node.direction {
                Direction::One(true) => a.min(b) - reach >= -slack,
                Direction::One(false) => a.max(b) + reach <= slack,
                Direction::Any => node.speed[1] == 0.0,
            };
            if only_driving {
                false
            } else if node.second == 0 {
                let samples = &stretches.samples[node.first as usize..=node.last as usize];
                samples.iter().any(back)
            } else {
                visit(stretches, c, slack, index + 1)
                    || visit(stretches, c, slack, node.second as usize)
            }
        }
        if self.tree.nodes.is_empty() {
            return false;
        }
        let slack = self.slack(c);
        match self.front.against_speed(&c.0, slack) {
            Ok(known) => known,
            Err(open) => (0..self.front.len)
                .filter(|k| open >> k & 1 == 1)
                .any(|k| visit(self, c, slack, self.front.nodes[k] as usize)),
        }
    }
}
