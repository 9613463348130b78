//! A few stretches that cover the cycle, contiguous in memory, so that one pass finds those that can contain a peak.

use super::LoadSample;
use super::tree::{Direction, Node, Tree};
use crate::cycle::form::LOADS;

/// Number of stretches. With this number the chords of a smooth cycle deviate from its loads by some parts in a thousand.
pub(super) const WIDTH: usize = 32;

const _: () = assert!(WIDTH <= u32::BITS as usize, "a bit for each stretch");

/// The stretches: their positions in the tree, and bounds of a torque on them. Each array contains one figure of all stretches, so that the compiler
/// vectorises the loops.
#[derive(Clone, Debug)]
pub(super) struct Front {
    /// Indices of the nodes in order of time; those beyond `len` are unused.
    pub(super) nodes: [u32; WIDTH],
    /// Number of stretches.
    pub(super) len: usize,
    pub(super) middle: [[f64; WIDTH]; LOADS],
    pub(super) half: [[f64; WIDTH]; LOADS],
    pub(super) reach: [[f64; WIDTH]; LOADS],
    /// Direction of speed: 1 or −1; 0 for both or rest.
    pub(super) direction: [f64; WIDTH],
    /// The directions at the first and at the last sample.
    pub(super) directions: [[f64; WIDTH]; 2],
    /// Least and largest magnitude of the speed at the gearbox output.
    pub(super) speeds: [[f64; WIDTH]; 2],
}

impl Front {
    pub(super) fn new(tree: &Tree, samples: &[LoadSample], largest: &[f64; LOADS]) -> Self {
        let mut front = Self {
            nodes: [0; WIDTH],
            len: 0,
            middle: [[0.0; WIDTH]; LOADS],
            half: [[0.0; WIDTH]; LOADS],
            reach: [[0.0; WIDTH]; LOADS],
            direction: [0.0; WIDTH],
            directions: [[0.0; WIDTH]; 2],
            speeds: [[0.0; WIDTH]; 2],
        };
        let mut chosen = Vec::from_iter((!tree.nodes.is_empty()).then_some(0));
        let stray = |node: &Node| -> f64 {
            let shares = node.reach.iter().zip(largest);
            shares
                .map(|(r, x)| if *x > 0.0 { r / x } else { 0.0 })
                .sum()
        };
        // Repeatedly splits the stretch whose loads deviate most from its chord.
        while chosen.len() < WIDTH {
            let cut = |k: &u32| tree.nodes[*k as usize].second > 0;
            let open = chosen.iter().enumerate().filter(|(_, k)| cut(k));
            let stray = |k: u32| stray(&tree.nodes[k as usize]);
            let Some((place, &node)) = open.max_by(|a, b| stray(*a.1).total_cmp(&stray(*b.1)))
            else {
                break;
            };
            chosen[place] = node + 1;
            chosen.push(tree.nodes[node as usize].second);
        }
        chosen.sort_unstable();
        front.len = chosen.len();
        for (place, &index) in chosen.iter().enumerate() {
            let node = &tree.nodes[index as usize];
            let (from, to) = (&samples[node.first as usize], &samples[node.last as usize]);
            front.nodes[place] = index;
            front.direction[place] = match node.direction {
                Direction::One(forwards) => f64::from(u8::from(forwards)) * 2.0 - 1.0,
                Direction::Any => 0.0,
            };
            front.speeds[0][place] = node.speed[0];
            front.speeds[1][place] = node.speed[1];
            for (end, sample) in [from, to].into_iter().enumerate() {
                let speed = sample.speed();
                front.directions[end][place] = if speed == 0.0 { 0.0 } else { speed.signum() };
            }
            let (from, to) = (from.loads(), to.loads());
            for k in 0..LOADS {
                front.middle[k][place] = 0.5 * (from[k] + to[k]);
                front.half[k][place] = 0.5 * (to[k] - from[k]);
                front.reach[k][place] = node.reach[k];
            }
        }
        front
    }

    /// Upper bound of |c·x| on each stretch; zero beyond `len`.
    pub(super) fn bounds(&self, c: &[f64; LOADS]) -> [f64; WIDTH] {
        let mut bounds = [0.0; WIDTH];
        let magnitude = c.map(f64::abs);
        for (k, bound) in bounds.iter_mut().enumerate() {
            *bound = self.bound(c, &magnitude, k);
        }
        bounds
    }

    /// Whether a torque c·x opposes the speed anywhere, by more than `slack`. It is decided if an end of a stretch shows it, or if no stretch can
    /// contain it; otherwise the error is a bit for each stretch that can.
    pub(super) fn against_speed(&self, c: &[f64; LOADS], slack: f64) -> Result<bool, u32> {
        let (lowest, least) = self.signs(c);
        if lowest < -slack {
            return Ok(true);
        }
        let mut open = 0;
        for (k, least) in least.iter().enumerate().take(self.len) {
            let rests = self.speeds[1][k] == 0.0;
            // With both directions the bound is valid for neither.
            let both = self.direction[k] == 0.0 && !rests;
            open |= u32::from(!rests && (both || *least < -slack)) << k;
        }
        if open == 0 { Ok(false) } else { Err(open) }
    }

    /// The least T·sgn n at an end of a stretch, and a lower bound on each stretch.
    fn signs(&self, c: &[f64; LOADS]) -> (f64, [f64; WIDTH]) {
        let magnitude = c.map(f64::abs);
        let [first, last] = &self.directions;
        let (mut least, mut ends) = ([0.0; WIDTH], [0.0f64; WIDTH]);
        for (k, (least, end)) in least.iter_mut().zip(&mut ends).enumerate() {
            let (middle, half) = (form(c, &self.middle, k), form(c, &self.half, k));
            *end = (first[k] * (middle - half)).min(last[k] * (middle + half));
            *least = self.direction[k] * middle - half.abs() - form(&magnitude, &self.reach, k);
        }
        (
            ends.iter().fold(0.0, |lowest: f64, end| lowest.min(*end)),
            least,
        )
    }

    /// Upper bound over all stretches of |c·x| minus a line over speed, given by its value at rest and its slope.
    pub(super) fn most_above(&self, c: &[f64; LOADS], line: [f64; 2]) -> f64 {
        let bounds = self.bounds(c);
        let above = bounds.iter().zip(self.floors(line));
        let above = above.map(|(bound, floor)| bound - floor);
        above.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Upper bound of |c·x| on a stretch: the larger magnitude of middle ± half is the sum of both magnitudes.
    fn bound(&self, c: &[f64; LOADS], magnitude: &[f64; LOADS], k: usize) -> f64 {
        form(c, &self.middle, k).abs()
            + form(c, &self.half, k).abs()
            + form(magnitude, &self.reach, k)
    }

    /// The end of the speed range at which a line of this slope is smallest, for each stretch; it is the same end on all.
    pub(super) const fn speeds_of_least(&self, slope: f64) -> &[f64; WIDTH] {
        let [least, most] = &self.speeds;
        if slope < 0.0 { most } else { least }
    }

    /// The minimum of a line over speed (value at rest, slope) on each stretch.
    pub(super) fn floors(&self, [start, slope]: [f64; 2]) -> [f64; WIDTH] {
        let speeds = self.speeds_of_least(slope);
        let mut floors = [0.0; WIDTH];
        for (floor, speed) in floors.iter_mut().zip(speeds) {
            *floor = start + slope * speed;
        }
        floors
    }
}

fn form(c: &[f64; LOADS], x: &[[f64; WIDTH]; LOADS], k: usize) -> f64 {
    c[0] * x[0][k] + (c[1] * x[1][k] + c[2] * x[2][k]) + (c[3] * x[3][k] + c[4] * x[4][k])
}

#[cfg(test)]
mod tests;
