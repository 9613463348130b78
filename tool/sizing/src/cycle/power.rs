//! Signs of the power over a cycle: energy put in and taken back, by stretches of the [tree](super::tree).

use super::Sample;
use super::extremes::Stretches;
use super::tree::Direction;
use crate::cycle::form::{Coefficients, LOADS};
use jred_machine::number::parabola::Parabola;

impl Stretches<'_> {
    /// Work that the motor puts in and work that it takes back (J): ∫max(P, 0) and ∫max(−P, 0). Where the power keeps its
    /// sign over a stretch its work is a linear form; samples are looked at only around its zeros. There Simpson's rule does not
    /// hold for either part: those of the parabola through its three samples are taken.
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
            for k in node.first..node.last {
                self.mend(c, k as usize, sums);
            }
        } else {
            self.add_energy(c, slack, index + 1, sums);
            self.mend(c, self.tree.nodes[index + 1].last as usize, sums);
            self.add_energy(c, slack, node.second as usize, sums);
        }
    }

    /// Where the power changes its sign between the sample `k` and the next: adds to both parts what they differ by from what
    /// Simpson's rule makes of them.
    fn mend(self, c: &Coefficients, k: usize, sums: &mut [f64; 2]) {
        let power = |k: usize| {
            let sample = &self.samples[k];
            sample.speed() * c.torque(&sample.loads())
        };
        let sign = |k: usize| power(k).partial_cmp(&0.0);
        let changes = |k: usize| sign(k) != sign(k + 1);
        if !changes(k) {
            return;
        }
        let Some([a, b, d]) = self.simpson(k) else {
            return;
        };
        // Once for three samples.
        if (a..k).any(changes) {
            return;
        }
        let three = [a, b, d];
        let times = three.map(|k| self.samples[k].t);
        let powers = three.map(power);
        let parabola = Parabola::through(times, powers);
        let [from, _, to] = times;
        let zeros: Vec<f64> = parabola.zeros(from, to).collect();
        let ends: Vec<f64> = [from].into_iter().chain(zeros).chain([to]).collect();
        let parts = ends.windows(2).map(|w| parabola.integral(w[0], w[1]));
        let exact = parts.fold([0.0; 2], |[plus, minus], part| {
            [plus + part.max(0.0), minus + (-part).max(0.0)]
        });
        let weight = (to - from) / 6.0;
        for (sum, (sign, exact)) in sums.iter_mut().zip([1.0, -1.0].into_iter().zip(exact)) {
            let [a, b, d] = powers.map(|power| (sign * power).max(0.0));
            *sum += exact - weight * (a + 4.0 * b + d);
        }
    }

    /// The three samples of Simpson's rule that the step from the sample `k` to the next belongs to. Samples between them, which
    /// have no weight, only resolve a peak.
    fn simpson(self, k: usize) -> Option<[usize; 3]> {
        let stretch = self.smooth.stretch(k, self.samples.len())?;
        let weighs = |k: &usize| self.samples[*k].weight > 0.0;
        let before = |k: usize| (stretch.start..k).rev().find(weighs);
        let after = |k: usize| (k..stretch.end).find(weighs);
        let (left, right) = (before(k + 1)?, after(k + 1)?);
        // The middle of the three has four times the weight of an end, or twice that of one that two threes share.
        if self.samples[left].weight > self.samples[right].weight {
            Some([before(left)?, left, right])
        } else {
            Some([left, right, after(right + 1)?])
        }
    }

    /// Whether any sample's power is negative, by more than rounding; `first` are looked at first.
    pub(super) fn regenerates(self, c: &Coefficients, first: [Option<usize>; 2]) -> bool {
        fn visit(stretches: Stretches, c: &Coefficients, slack: f64, index: usize) -> bool {
            let node = &stretches.tree.nodes[index];
            let back = |s: &Sample| s.gives_back(c, slack);
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
        let mut first = first.into_iter().flatten();
        if first.any(|k| self.samples[k].gives_back(c, slack)) {
            return true;
        }
        match self.front.against_speed(&c.0, slack) {
            Ok(known) => known,
            Err(open) => (0..self.front.len)
                .filter(|k| open >> k & 1 == 1)
                .any(|k| visit(self, c, slack, self.front.nodes[k] as usize)),
        }
    }
}
