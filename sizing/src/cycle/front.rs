//! A few stretches that cover the cycle, side by side in memory: one look tells which of them can hold a peak.

use super::Sample;
use super::tree::{Node, Tree};
use crate::drive::LOADS;

/// Number of stretches. At this number the chords of a smooth cycle are some parts in a thousand from its loads.
pub(super) const WIDTH: usize = 32;

/// The stretches: where they are in the tree, and what bounds a torque on them. Each array holds one figure of all stretches:
/// the compiler makes vector instructions of the loops.
#[derive(Clone, Debug)]
pub(super) struct Front {
    /// Indices of the nodes in the order of time; those beyond `len` are not used.
    pub(super) nodes: [u32; WIDTH],
    /// How many there are.
    pub(super) len: usize,
    middle: [[f64; WIDTH]; LOADS],
    half: [[f64; WIDTH]; LOADS],
    reach: [[f64; WIDTH]; LOADS],
    /// Least and largest magnitude of the speed at the gearbox output.
    speeds: [[f64; WIDTH]; 2],
}

impl Front {
    pub(super) fn new(tree: &Tree, samples: &[Sample], largest: &[f64; LOADS]) -> Self {
        let mut front = Self {
            nodes: [0; WIDTH],
            len: 0,
            middle: [[0.0; WIDTH]; LOADS],
            half: [[0.0; WIDTH]; LOADS],
            reach: [[0.0; WIDTH]; LOADS],
            speeds: [[0.0; WIDTH]; 2],
        };
        let mut chosen = Vec::from_iter((!tree.nodes.is_empty()).then_some(0));
        let stray = |node: &Node| -> f64 {
            let shares = node.reach.iter().zip(largest);
            shares
                .map(|(r, x)| if *x > 0.0 { r / x } else { 0.0 })
                .sum()
        };
        // The stretch whose loads stray most from its chord is cut, again and again.
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
            front.speeds[0][place] = node.speed[0];
            front.speeds[1][place] = node.speed[1];
            for k in 0..LOADS {
                front.middle[k][place] = 0.5 * (from.loads[k] + to.loads[k]);
                front.half[k][place] = 0.5 * (to.loads[k] - from.loads[k]);
                front.reach[k][place] = node.reach[k];
            }
        }
        front
    }

    /// What |c·x| does not exceed on each stretch; zero beyond `len`.
    pub(super) fn bounds(&self, c: &[f64; LOADS]) -> [f64; WIDTH] {
        let mut bounds = [0.0; WIDTH];
        let magnitude = c.map(f64::abs);
        let form = |c: &[f64; LOADS], x: &[[f64; WIDTH]; LOADS], k: usize| {
            c[0] * x[0][k] + (c[1] * x[1][k] + c[2] * x[2][k]) + (c[3] * x[3][k] + c[4] * x[4][k])
        };
        for (k, bound) in bounds.iter_mut().enumerate() {
            // The larger magnitude of middle ± half is the sum of theirs.
            *bound = form(c, &self.middle, k).abs()
                + form(c, &self.half, k).abs()
                + form(&magnitude, &self.reach, k);
        }
        bounds
    }

    /// The least of a line over the speed, its value at rest and its slope, on each stretch.
    pub(super) fn floors(&self, [start, slope]: [f64; 2]) -> [f64; WIDTH] {
        // One end of the speeds has it, the same one on every stretch.
        let speeds = &self.speeds[usize::from(slope < 0.0)];
        speeds.map(|speed| start + slope * speed)
    }
}
