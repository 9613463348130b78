//! Extremes over a cycle without visiting every sample: branch and bound over the [tree](super::tree) of stretches.
//!
//! A stretch is examined only if its bound exceeds the best sample found so far. Where loads are smooth, the bound's excess over the true maximum
//! falls with the square of a stretch's length. So around a peak only a few stretches of each size must be examined: their number grows with the
//! logarithm of the number of samples, times the number of peaks of nearly equal height. The bounds are valid for any course; jumps, noise and
//! corners only cost time.
//!
//! A sample that exceeds the best by less than rounding (64 units of the last place of the terms of the torque) may be skipped. Otherwise a constant
//! torque would be examined sample by sample.

use std::ops::Range;

use super::floor::{ConstantLimit, FallingLimit, Floor, LinearLimit};
use super::front::Front;
use super::tree::{Direction, Node, Tree};
use super::{LoadSample, Peak};
use crate::cycle::form::{Coefficients, LOADS};
use crate::motor::envelope::Envelope;
use jred_analysis::duty::{Panel, Smooth};

/// Rounding of a torque and of its bound, as a share of the sum of its terms' largest magnitudes.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The samples and their stretches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretches<'c> {
    pub(super) samples: &'c [LoadSample],
    pub(super) tree: &'c Tree,
    pub(super) front: &'c Front,
    pub(super) largest: &'c [f64; LOADS],
    pub(super) smooth: &'c Smooth,
}

impl Stretches<'_> {
    /// The closest approach of the cycle to the envelope, or its largest excess; if some samples have no limit torque at all, the first of them.
    pub(super) fn peak(self, c: &Coefficients, ratio: f64, envelope: &Envelope) -> Option<Peak> {
        let (sample, peak) = self.sampled_peak(c, ratio, envelope)?;
        let used = |torque, speed| envelope.peak_used(torque, speed);
        Some(self.between(sample, c, ratio, used).unwrap_or(peak))
    }

    fn sampled_peak(
        self,
        c: &Coefficients,
        ratio: f64,
        envelope: &Envelope,
    ) -> Option<(usize, Peak)> {
        let top = self.tree.nodes.first()?.speed[1] * ratio;
        if let Some(limit) = envelope.level_up_to(top) {
            let known = limit.is_finite() && limit > 0.0;
            let level = ConstantLimit(if known { limit } else { 1.0 });
            let (sample, mut peak) = PeakSearch::new(self, c, ratio, level).run();
            peak.used = envelope.peak_used(peak.torque, peak.speed);
            return Some((sample, peak));
        }
        let [driving, braking] = [true, false].map(|driving| envelope.floor(driving, [0.0, top]));
        let [start, end] = [driving[0].min(braking[0]), driving[1].min(braking[1])];
        let least = start.min(end);
        let slope = (end - start) / self.tree.nodes.first()?.speed[1];
        let line = if slope.is_finite() {
            [start, slope]
        } else {
            [least, 0.0]
        };
        if least <= 0.0 {
            let positive_below = envelope.positive_below() / ratio;
            let beyond = ZeroLimitSearch {
                stretches: self,
                c,
                ratio,
                envelope,
                positive_below,
            };
            if let Some(beyond) = beyond.visit(0) {
                return Some(beyond);
            }
        }
        if let Some(lines) = envelope.straight_up_to(top) {
            let floor = LinearLimit { lines, line, least };
            return Some(PeakSearch::new(self, c, ratio, floor).run());
        }
        let floor = FallingLimit {
            envelope,
            line,
            least,
        };
        Some(PeakSearch::new(self, c, ratio, floor).run())
    }

    /// Largest value of |c·x|.
    pub(super) fn largest_magnitude(self, c: &Coefficients) -> f64 {
        if self.samples.is_empty() {
            return 0.0;
        }
        let (sample, peak) = PeakSearch::new(self, c, 1.0, ConstantLimit(1.0)).run();
        let between = self.between(sample, c, 1.0, |torque, _| torque.abs());
        between.unwrap_or(peak).torque.abs()
    }

    /// Least and largest value of c·x.
    pub(super) fn extremes(self, c: &Coefficients) -> [f64; 2] {
        let opposite = Coefficients(c.0.map(|c| -c));
        [-self.largest_value(&opposite), self.largest_value(c)]
    }

    fn largest_value(self, c: &Coefficients) -> f64 {
        let slack = self.slack(c);
        let reach = |node: &Node| node.reach_of(c) - slack;
        let bound = |node: &Node, ends: f64| ends + reach(node);
        let torque = |k: u32| c.torque(&self.samples[k as usize].loads());
        let (at, most) = self.largest(&bound, &torque);
        let between = self.between(at as usize, c, 1.0, |torque, _| torque);
        between.map_or(most, |peak| peak.torque)
    }

    /// Largest value of a function that rises with the magnitudes of torque and speed, among the samples.
    ///
    /// `current` is a current (A) of a torque (N·m) at a speed of the motor (rad/s); infinite: unknown.
    pub(super) fn largest_current(
        self,
        c: &Coefficients,
        ratio: f64,
        current: impl Fn(f64, f64) -> f64,
    ) -> f64 {
        let bound = |node: &Node, _: f64| {
            let [a, b] = self.ends(node, c).map(f64::abs);
            current(a.max(b) + node.reach_of(c), node.speed[1] * ratio)
        };
        let value = |k: u32| {
            let sample = &self.samples[k as usize];
            current(c.torque(&sample.loads()), sample.speed() * ratio)
        };
        self.largest(&bound, &value).1.max(0.0)
    }

    /// The sample with the largest value, and that value. `bound`: an upper bound of the value on a stretch, given the larger value at its ends.
    fn largest(
        self,
        bound: &impl Fn(&Node, f64) -> f64,
        value: &impl Fn(u32) -> f64,
    ) -> (u32, f64) {
        fn visit(
            nodes: &[Node],
            index: usize,
            bound: &impl Fn(&Node, f64) -> f64,
            value: &impl Fn(u32) -> f64,
            best: &mut (u32, f64),
        ) {
            let node = &nodes[index];
            let ends = [node.first, node.last].map(|k| (k, value(k)));
            let weigh = |best: &mut (u32, f64), (k, value): (u32, f64)| {
                if value > best.1 {
                    *best = (k, value);
                }
            };
            for end in ends {
                weigh(best, end);
            }
            if bound(node, ends[0].1.max(ends[1].1)) <= best.1 {
                return;
            }
            if node.second == 0 {
                (node.first..=node.last).for_each(|k| weigh(best, (k, value(k))));
            } else {
                visit(nodes, index + 1, bound, value, best);
                visit(nodes, node.second as usize, bound, value, best);
            }
        }
        let mut best = (0, f64::NEG_INFINITY);
        if !self.tree.nodes.is_empty() {
            visit(&self.tree.nodes, 0, bound, value, &mut best);
        }
        best
    }

    /// The peak between the samples next to the sample `k`, where `used` of the motor's torque and speed is largest; `None` if the sample itself is
    /// the peak. Panels in which the speed or the power changes sign are skipped: a polynomial across it would not be a torque.
    pub(super) fn between(
        self,
        k: usize,
        c: &Coefficients,
        ratio: f64,
        used: impl Fn(f64, f64) -> f64,
    ) -> Option<Peak> {
        if !self.smooth.knows_peaks() {
            return None;
        }
        // The last sample of a panel is the start of the next one, and the peak may lie on either side.
        let panels = self.smooth.panels_beside(k, self.samples.len());
        let panels = panels.filter_map(|range| self.panel(range));
        let peaks = panels.filter_map(|panel| self.peak_in(&panel, k, c, ratio, &used));
        peaks.max_by(|a, b| a.used.total_cmp(&b.used))
    }

    /// The peak in one panel.
    fn peak_in(
        self,
        panel: &Panel,
        k: usize,
        c: &Coefficients,
        ratio: f64,
        used: impl Fn(f64, f64) -> f64,
    ) -> Option<Peak> {
        let at = |k: usize| {
            let sample = &self.samples[k];
            (c.torque(&sample.loads()), sample.speed() * ratio)
        };
        let kind = |k: usize| {
            let [_, driving, back, _, sign] = self.samples[k].loads();
            [driving, back, sign].map(|x| x != 0.0)
        };
        let (first, rest) = panel.indices().split_first()?;
        if rest.iter().any(|k| kind(*k) != kind(*first)) {
            return None;
        }
        let score = |k: usize| {
            let (torque, speed) = at(k);
            used(torque, speed)
        };
        let torques = panel.values(|k| at(k).0);
        let speeds = panel.values(|k| at(k).1);
        let time = |k: usize| self.samples[k].t;
        let value = |x: f64| used(torques.at(x), speeds.at(x));
        let (x, used) = panel.peak(k, time, score, value)?;
        Some(Peak {
            used,
            torque: torques.at(x),
            speed: speeds.at(x),
        })
    }

    /// The panel of these samples.
    pub(super) fn panel(self, range: Range<usize>) -> Option<Panel> {
        Panel::of(range, |k| [self.samples[k].t, self.samples[k].weight])
    }

    pub(super) fn slack(self, c: &Coefficients) -> f64 {
        let terms = c.0.iter().zip(self.largest).map(|(c, x)| c.abs() * x);
        ROUNDING * terms.sum::<f64>()
    }

    /// The linear form at both ends of a stretch.
    pub(super) fn ends(self, node: &Node, c: &Coefficients) -> [f64; 2] {
        [node.first, node.last].map(|k| c.torque(&self.samples[k as usize].loads()))
    }
}

/// The search for the largest share of a limit.
struct PeakSearch<'s, F> {
    stretches: Stretches<'s>,
    c: &'s Coefficients,
    ratio: f64,
    floor: F,
    slack: f64,
    best: Peak,
    /// Index of the best sample.
    at: u32,
}

impl<'s, F: Floor> PeakSearch<'s, F> {
    fn new(stretches: Stretches<'s>, c: &'s Coefficients, ratio: f64, floor: F) -> Self {
        Self {
            slack: stretches.slack(c),
            stretches,
            c,
            ratio,
            floor,
            best: Peak {
                used: f64::NEG_INFINITY,
                torque: 0.0,
                speed: 0.0,
            },
            at: 0,
        }
    }

    fn run(mut self) -> (usize, Peak) {
        let front = self.stretches.front;
        let bounds = front.bounds(&self.c.0);
        let floors = front.floors(self.floor.line());
        let (mut first, mut most) = (0, f64::NEG_INFINITY);
        for (k, (bound, floor)) in bounds.iter().zip(&floors).take(front.len).enumerate() {
            let share = bound / floor.max(f64::MIN_POSITIVE);
            if share > most {
                (first, most) = (k, share);
            }
        }
        self.weigh_ends(front.nodes[first]);
        self.look(front.nodes[first] as usize);
        for (k, (bound, floor)) in bounds.iter().zip(&floors).take(front.len).enumerate() {
            if k != first && bound - self.slack > self.best.used * floor {
                self.look(front.nodes[k] as usize);
            }
        }
        (self.at as usize, self.best)
    }

    /// Evaluates both ends of a stretch, which may save much of the search.
    fn weigh_ends(&mut self, node: u32) {
        let node = &self.stretches.tree.nodes[node as usize];
        for end in [node.first, node.last] {
            self.weigh(end, self.floor.least());
        }
    }

    /// Examines a stretch if it may contain more than the best.
    fn look(&mut self, index: usize) {
        let node = &self.stretches.tree.nodes[index];
        let excess = self.excess(node);
        self.look_into(index, excess);
    }

    fn look_into(&mut self, index: usize, excess: f64) {
        if excess <= self.slack {
            return;
        }
        let nodes = &self.stretches.tree.nodes;
        let node = &nodes[index];
        if node.second == 0 {
            let least = self.least_on(node);
            for k in node.first..=node.last {
                self.weigh(k, least);
            }
            return;
        }
        let second = node.second as usize;
        let [one, two] = [index + 1, second].map(|k| self.excess(&nodes[k]));
        // The more promising half first: its result may exclude the other, whose bound is recomputed.
        if one >= two {
            self.look_into(index + 1, one);
            self.look(second);
        } else {
            self.look_into(second, two);
            self.look(index + 1);
        }
    }

    /// Lower bound of the limit on a stretch.
    fn least_on(&self, node: &Node) -> f64 {
        let [start, slope] = self.floor.line();
        (start + slope * node.speed[0]).min(start + slope * node.speed[1])
    }

    /// Keeps a sample if it is the best so far; `least` is a lower bound of its limit.
    fn weigh(&mut self, k: u32, least: f64) {
        let sample = &self.stretches.samples[k as usize];
        let torque = self.c.torque(&sample.loads());
        if torque.abs() <= self.best.used * least {
            return;
        }
        let speed = sample.speed() * self.ratio;
        let limit = self.floor.limit(torque, speed);
        // Most samples are decided without a division.
        if torque.abs() > self.best.used * limit {
            let used = if limit > 0.0 {
                torque.abs() / limit
            } else {
                0.0
            };
            if used > self.best.used {
                self.at = k;
                self.best = Peak {
                    used,
                    torque,
                    speed,
                };
            }
        }
    }

    /// An upper bound of |T| − u·M over a stretch, with u the best share so far and M the limit. If it is not positive, the stretch contains nothing
    /// better. For one sign of the torque, with M replaced by a chord below it, this is a linear form of the loads.
    fn excess(&self, node: &Node) -> f64 {
        let u = self.best.used;
        if u < 0.0 {
            return f64::INFINITY;
        }
        let c = &self.c.0;
        let torques = self.stretches.ends(node, self.c);
        let [least, largest] = node.speed;
        let speeds = [least * self.ratio, largest * self.ratio];
        let reach_without_speed = c[0].abs() * node.reach[0]
            + (c[1].abs() * node.reach[1] + c[2].abs() * node.reach[2])
            + c[4].abs() * node.reach[4];
        let reach = reach_without_speed + c[3].abs() * node.reach[3];
        let least_here = u * self.least_on(node);
        let side = |positive: bool| {
            let sign = if positive { 1.0 } else { -1.0 };
            let [a, b] = torques.map(|torque| sign * torque);
            let flat = a.max(b) + reach - least_here;
            if flat <= self.slack {
                return flat;
            }
            let driving = match node.direction {
                Direction::One(forwards) => forwards == positive,
                Direction::Any => true,
            };
            let [mut low, mut high] = self.floor.chord(driving, speeds);
            if node.direction == Direction::Any || !driving && least == 0.0 {
                // Both directions of power, rest counting as driving: the lowest limit.
                let [other_low, other_high] = self.floor.chord(!driving, speeds);
                low = low.min(high).min(other_low).min(other_high);
                high = low;
            }
            // M = low + slope·(|n| − least), and |n| is n itself or −n.
            let slope = (high - low) / (largest - least);
            if slope == 0.0 || !slope.is_finite() {
                let limit = low.min(high);
                // An unknown limit is infinite, and nothing exceeds it.
                return if limit.is_infinite() {
                    f64::NEG_INFINITY
                } else {
                    a.max(b) + reach - u * limit
                };
            }
            let limit = |k: u32| {
                let speed = self.stretches.samples[k as usize].speed().abs();
                u * (low + slope * (speed - least))
            };
            let forwards = matches!(node.direction, Direction::One(true));
            let coefficient = sign * c[3] - if forwards { u * slope } else { -u * slope };
            (a - limit(node.first)).max(b - limit(node.last))
                + reach_without_speed
                + coefficient.abs() * node.reach[3]
        };
        side(true).max(side(false))
    }
}

/// The search for the first sample without any limit torque.
struct ZeroLimitSearch<'s> {
    stretches: Stretches<'s>,
    c: &'s Coefficients,
    ratio: f64,
    envelope: &'s Envelope,
    /// Speed at the gearbox output below which the limit is positive in all directions.
    positive_below: f64,
}

impl ZeroLimitSearch<'_> {
    /// The first sample in a stretch at whose speed no torque is available.
    fn visit(&self, index: usize) -> Option<(usize, Peak)> {
        let node = &self.stretches.tree.nodes[index];
        if node.speed[1] < self.positive_below {
            return None;
        }
        if node.second > 0 {
            return (self.visit(index + 1)).or_else(|| self.visit(node.second as usize));
        }
        (node.first as usize..=node.last as usize).find_map(|k| {
            let sample = &self.stretches.samples[k];
            if sample.speed().abs() < self.positive_below {
                return None;
            }
            let torque = self.c.torque(&sample.loads());
            let speed = sample.speed() * self.ratio;
            let used = self.envelope.peak_used(torque, speed);
            let beyond = Peak {
                used,
                torque,
                speed,
            };
            used.is_infinite().then_some((k, beyond))
        })
    }
}

#[cfg(test)]
mod tests;
