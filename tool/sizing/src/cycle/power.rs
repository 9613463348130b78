//! Signs of the power over a cycle: energy supplied and returned, by stretches of the [tree](super::tree).

use std::convert::Infallible;

use super::LoadSample;
use super::extremes::Stretches;
use super::tree::Direction;
use crate::cycle::form::Coefficients;
use jred_file::number::numerics;

/// Work supplied and returned (J), in order of time.
#[derive(Default)]
struct Work {
    sums: [f64; 2],
    /// The first sample of the last panel in which the power changes sign.
    mended: Option<usize>,
}

impl Stretches<'_> {
    /// Work that the motor supplies and work that it takes back (J): ∫max(P, 0) and ∫max(−P, 0). Where the power keeps its sign over a stretch, its
    /// work is a linear form; samples are visited only around its zeros. In a panel with a zero the quadrature is valid for neither part; the
    /// polynomial through its samples is integrated instead.
    pub(super) fn energies(self, c: &Coefficients, ratio: f64) -> [f64; 2] {
        let mut work = Work::default();
        if !self.tree.nodes.is_empty() {
            self.add_energy(c, self.slack(c), 0, &mut work);
        }
        work.sums.map(|sum| sum * ratio)
    }

    fn add_energy(self, c: &Coefficients, slack: f64, index: usize, work: &mut Work) {
        let node = &self.tree.nodes[index];
        if node.speed[1] == 0.0 {
            return;
        }
        let mut add = |energy: f64| {
            let [motoring, regenerative] = &mut work.sums;
            *motoring += energy.max(0.0);
            *regenerative += (-energy).max(0.0);
        };
        let ends = self.ends(node, c);
        let reach = node.reach_of(c);
        let one_sign =
            ends[0].min(ends[1]) - reach >= -slack || ends[0].max(ends[1]) + reach <= slack;
        if one_sign && node.direction != Direction::Any {
            add(c.torque(&node.energy));
        } else if node.second == 0 {
            for sample in &self.samples[node.first as usize..=node.last as usize] {
                add(sample.weight * sample.power(c));
            }
            for k in node.first..node.last {
                self.mend(c, k as usize, work);
            }
        } else {
            self.add_energy(c, slack, index + 1, work);
            self.mend(c, self.tree.nodes[index + 1].last as usize, work);
            self.add_energy(c, slack, node.second as usize, work);
        }
    }

    /// Where the power changes sign between the sample `k` and the next: adds the difference to the panel's quadrature to both parts.
    fn mend(self, c: &Coefficients, k: usize, work: &mut Work) {
        let power = |k: usize| self.samples[k].power(c);
        let [before, after] = [power(k), power(k + 1)];
        // A sample itself may be zero.
        if (before > 0.0) == (after > 0.0) {
            return;
        }
        let count = self.samples.len();
        // The zero may also lie between a panel's left border, which is the last sample of the previous panel, and its first sample.
        let Some(range) = self.smooth.panel_of(k + 1, count) else {
            return;
        };
        // Once per panel.
        if work.mended.replace(range.start) == Some(range.start) {
            return;
        }
        let Some(panel) = self.panel(range.clone()) else {
            return;
        };
        let over = panel.values(power);
        let mut places = vec![-1.0];
        places.extend(range.map(|k| panel.place(self.samples[k].t)));
        places.push(1.0);
        let mut ends = vec![-1.0];
        for pair in places.windows(2) {
            let powers = [over.at(pair[0]), over.at(pair[1])];
            if powers[1] == 0.0 {
                ends.push(pair[1]);
            } else if powers[0] * powers[1] < 0.0 {
                let at = |x: f64| Ok::<f64, Infallible>(over.at(x));
                let Ok(zero) = numerics::zero(at, [pair[0], pair[1]], powers, f64::EPSILON);
                ends.push(zero);
            }
        }
        ends.push(1.0);
        let mut exact = [0.0; 2];
        for pair in ends.windows(2) {
            let part = panel.half() * panel.rule().over([pair[0], pair[1]], |x| over.at(x));
            exact[0] += part.max(0.0);
            exact[1] += (-part).max(0.0);
        }
        let weighed = panel.indices().iter();
        let weighed = weighed.map(|k| self.samples[*k].weight * power(*k));
        let ruled = weighed.fold([0.0; 2], |[plus, minus], part| {
            [plus + part.max(0.0), minus + (-part).max(0.0)]
        });
        for ((sum, exact), ruled) in work.sums.iter_mut().zip(exact).zip(ruled) {
            *sum += exact - ruled;
        }
    }

    /// Whether any sample's power is negative, by more than rounding; `first` are checked first.
    pub(super) fn regenerates(self, c: &Coefficients, first: [Option<usize>; 2]) -> bool {
        fn visit(stretches: Stretches, c: &Coefficients, slack: f64, index: usize) -> bool {
            let node = &stretches.tree.nodes[index];
            let back = |s: &LoadSample| s.gives_back(c, slack);
            if [node.first, node.last]
                .iter()
                .any(|k| back(&stretches.samples[*k as usize]))
            {
                return true;
            }
            let [a, b] = stretches.ends(node, c);
            let reach = node.reach_of(c);
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
