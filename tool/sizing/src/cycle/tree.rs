//! The samples of a cycle as a tree of stretches, with bounds for each stretch.

use std::ops::Range;

use super::LoadSample;
use crate::cycle::form::{Coefficients, LOADS};

/// Most samples of a stretch that is not cut further.
const LEAF: usize = 16;

/// A step this many times larger than its neighbours is a jump (of an acceleration, or at a stop). Stretches are cut at jumps, because no chord
/// follows a jump.
const JUMP: f64 = 4.0;

/// Smallest step that can be a jump, as a share of the largest loads.
const SMALLEST_JUMP: f64 = 1e-6;

/// Directions of speed in a stretch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    /// One direction (this sign of the speed), and perhaps rest.
    One(bool),
    /// Both, or only rest.
    Any,
}

/// A stretch of samples.
///
/// Each load of a sample at time t differs from the chord between the first and the last sample of the stretch by at most `reach`. So the largest
/// value of a linear form c·x on the stretch is at most the larger of its two end values, plus ∑ |c_k|·reach_k. Where loads are smooth the reach
/// falls with the square of the stretch's length.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Index of the first sample.
    pub(super) first: u32,
    /// Index of the last sample.
    pub(super) last: u32,
    /// Index of the second half; the first half is the next node. Zero: the stretch is not cut.
    pub(super) second: u32,
    /// Directions of speed.
    pub(super) direction: Direction,
    /// Largest deviation of the loads from the chord.
    pub(super) reach: [f64; LOADS],
    /// Least and largest magnitude of the speed.
    pub(super) speed: [f64; 2],
    /// ∑ w·n·x; the energy is a linear form in it.
    pub(super) energy: [f64; LOADS],
}

/// The stretches, each before its halves.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
}

impl Tree {
    pub(super) fn new(samples: &[LoadSample], largest: &[f64; LOADS]) -> Self {
        Self::of_parts(samples, std::slice::from_ref(&(0..samples.len())), largest)
    }

    /// A tree of some of the samples, given as ranges in order.
    pub(super) fn of_parts(
        samples: &[LoadSample],
        parts: &[Range<usize>],
        largest: &[f64; LOADS],
    ) -> Self {
        let cuts = jumps(samples, largest);
        let count: usize = parts.iter().map(Range::len).sum();
        let pieces = count / LEAF * 2 + 2 * cuts.len().min(count) + parts.len();
        let mut tree = Self {
            nodes: Vec::with_capacity(2 * pieces + 1),
        };
        if count > 0 {
            tree.join(samples, &cuts, parts);
        }
        tree.nodes.shrink_to_fit();
        tree
    }

    /// Adds the stretches of some ranges; returns the index of the stretch that contains all.
    fn join(&mut self, samples: &[LoadSample], cuts: &[u32], parts: &[Range<usize>]) -> usize {
        if let [part] = parts {
            return self.build(samples, cuts, part.start, part.end - 1);
        }
        let own = self.nodes.len();
        let (before, after) = parts.split_at(parts.len() / 2);
        self.nodes
            .push(Node::leaf(samples, before[0].start, before[0].start));
        let one = self.join(samples, cuts, before);
        let two = self.join(samples, cuts, after);
        self.nodes[own] = Node::of_halves(samples, &self.nodes[one], &self.nodes[two], two);
        own
    }

    /// Adds the stretch from `first` to `last`, both included; returns its index.
    fn build(&mut self, samples: &[LoadSample], cuts: &[u32], first: usize, last: usize) -> usize {
        let own = self.nodes.len();
        let inside = {
            let from = cuts.partition_point(|&cut| (cut as usize) <= first);
            let to = cuts.partition_point(|&cut| (cut as usize) <= last);
            &cuts[from..to]
        };
        if inside.is_empty() && last - first < LEAF {
            self.nodes.push(Node::leaf(samples, first, last));
            return own;
        }
        let middle = usize::midpoint(first, last) + 1;
        let place = inside.partition_point(|&cut| (cut as usize) < middle);
        // The jump nearest to the middle, if any.
        let beside = [place.checked_sub(1), Some(place)];
        let nearest = beside.into_iter().flatten().filter_map(|k| inside.get(k));
        let cut = nearest
            .map(|&cut| cut as usize)
            .min_by_key(|cut| cut.abs_diff(middle))
            .unwrap_or(middle);
        self.nodes.push(Node::leaf(samples, first, first));
        let one = self.build(samples, inside, first, cut - 1);
        let two = self.build(samples, inside, cut, last);
        self.nodes[own] = Node::of_halves(samples, &self.nodes[one], &self.nodes[two], two);
        own
    }
}

/// The samples after a jump, in order.
fn jumps(samples: &[LoadSample], largest: &[f64; LOADS]) -> Vec<u32> {
    let scale = largest.map(|x| if x > 0.0 { 1.0 / x } else { 0.0 });
    let step = |a: &LoadSample, b: &LoadSample| -> f64 {
        let (a, b) = (a.loads(), b.loads());
        let steps = (0..LOADS).map(|k| (b[k] - a[k]).abs() * scale[k]);
        steps.fold(0.0, f64::max)
    };
    let mut cuts = Vec::new();
    let (mut before, mut here) = (0.0, 0.0);
    for (k, pair) in samples.windows(2).enumerate() {
        let after = step(&pair[0], &pair[1]);
        if k > 0 && here > SMALLEST_JUMP && here > JUMP * f64::max(before, after) {
            cuts.push(k as u32);
        }
        (before, here) = (here, after);
    }
    if here > SMALLEST_JUMP && here > JUMP * before {
        cuts.push(samples.len() as u32 - 1);
    }
    cuts
}

/// Deviation of a sample from the chord between two others.
fn astray(from: &LoadSample, to: &LoadSample, sample: &LoadSample) -> [f64; LOADS] {
    let span = to.t - from.t;
    let part = if span > 0.0 {
        (sample.t - from.t) / span
    } else {
        0.0
    };
    let [from, to, sample] = [from, to, sample].map(LoadSample::loads);
    std::array::from_fn(|k| {
        let chord = from[k] + part * (to[k] - from[k]);
        (sample[k] - chord).abs()
    })
}

impl Node {
    pub(super) fn leaf(samples: &[LoadSample], first: usize, last: usize) -> Self {
        let (from, to) = (&samples[first], &samples[last]);
        let mut node = Self {
            first: first as u32,
            last: last as u32,
            second: 0,
            direction: Direction::Any,
            reach: [0.0; LOADS],
            speed: [f64::INFINITY, 0.0],
            energy: [0.0; LOADS],
        };
        let [mut forwards, mut backwards] = [false; 2];
        for sample in &samples[first..=last] {
            let astray = astray(from, to, sample);
            let speed = sample.speed();
            for (reach, astray) in node.reach.iter_mut().zip(astray) {
                *reach = reach.max(astray);
            }
            for (energy, load) in node.energy.iter_mut().zip(sample.loads()) {
                *energy += sample.weight * speed * load;
            }
            let [least, largest] = &mut node.speed;
            (*least, *largest) = (least.min(speed.abs()), largest.max(speed.abs()));
            forwards |= speed > 0.0;
            backwards |= speed < 0.0;
        }
        if forwards != backwards {
            node.direction = Direction::One(forwards);
        }
        node
    }

    /// Largest deviation of c·x from its chord: ∑ |c_k|·reach_k.
    pub(super) fn reach_of(&self, c: &Coefficients) -> f64 {
        (0..LOADS).map(|k| c.0[k].abs() * self.reach[k]).sum()
    }

    fn of_halves(samples: &[LoadSample], one: &Self, two: &Self, second: usize) -> Self {
        let (from, to) = (&samples[one.first as usize], &samples[two.last as usize]);
        // The deviation of each half's chord from the whole chord is linear, so it is largest at the cut.
        let left = astray(from, to, &samples[one.last as usize]);
        let right = astray(from, to, &samples[two.first as usize]);
        let rest = |node: &Self| node.speed[1] == 0.0;
        let direction = match (one.direction, two.direction) {
            (a, b) if a == b => a,
            (a, _) if rest(two) => a,
            (_, b) if rest(one) => b,
            _ => Direction::Any,
        };
        Self {
            first: one.first,
            last: two.last,
            second: second as u32,
            direction,
            reach: std::array::from_fn(|k| (one.reach[k] + left[k]).max(two.reach[k] + right[k])),
            speed: [
                one.speed[0].min(two.speed[0]),
                one.speed[1].max(two.speed[1]),
            ],
            energy: std::array::from_fn(|k| one.energy[k] + two.energy[k]),
        }
    }
}
