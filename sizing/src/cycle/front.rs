//! A few stretches that cover the cycle, side by side in memory: one look tells which of them can hold a peak.

use pulp::{Arch, NullaryFnOnce};

use super::Sample;
use super::tree::{Direction, Node, Tree};
use crate::drive::LOADS;

/// Number of stretches. At this number the chords of a smooth cycle are some parts in a thousand from its loads.
pub(super) const WIDTH: usize = 32;

const _: () = assert!(WIDTH <= u32::BITS as usize, "a bit for each stretch");

/// The stretches: where they are in the tree, and what bounds a torque on them. Each array holds one figure of all stretches:
/// the compiler makes vector instructions of the loops, the widest that the processor has.
#[derive(Clone, Debug)]
pub(super) struct Front {
    vectors: Arch,
    /// Indices of the nodes in the order of time; those beyond `len` are not used.
    pub(super) nodes: [u32; WIDTH],
    /// How many there are.
    pub(super) len: usize,
    middle: [[f64; WIDTH]; LOADS],
    half: [[f64; WIDTH]; LOADS],
    reach: [[f64; WIDTH]; LOADS],
    /// Direction of speed: 1 or −1; 0 for both or rest.
    direction: [f64; WIDTH],
    /// Those at the first and at the last sample.
    directions: [[f64; WIDTH]; 2],
    /// Least and largest magnitude of the speed at the gearbox output.
    speeds: [[f64; WIDTH]; 2],
}

impl Front {
    pub(super) fn new(tree: &Tree, samples: &[Sample], largest: &[f64; LOADS]) -> Self {
        let mut front = Self {
            vectors: Arch::new(),
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
        self.vectors.dispatch(Bounds {
            front: self,
            c,
            bounds: &mut bounds,
        });
        bounds
    }

    /// Whether a torque c·x is against the speed anywhere, by more than `slack`: known where an end of a stretch shows it, or no
    /// stretch can hold it; else the stretches that can, a bit for each.
    pub(super) fn against_speed(&self, c: &[f64; LOADS], slack: f64) -> Result<bool, u32> {
        let mut least = [0.0; WIDTH];
        let lowest = self.vectors.dispatch(Signs {
            front: self,
            c,
            least: &mut least,
        });
        if lowest < -slack {
            return Ok(true);
        }
        let mut open = 0;
        for (k, least) in least.iter().enumerate().take(self.len) {
            let rests = self.speeds[1][k] == 0.0;
            // Both directions: the bound holds for neither.
            let both = self.direction[k] == 0.0 && !rests;
            open |= u32::from(!rests && (both || *least < -slack)) << k;
        }
        if open == 0 { Ok(false) } else { Err(open) }
    }

    /// The least of a line over the speed, its value at rest and its slope, on each stretch.
    pub(super) fn floors(&self, [start, slope]: [f64; 2]) -> [f64; WIDTH] {
        // One end of the speeds has it, the same one on every stretch.
        let speeds = &self.speeds[usize::from(slope < 0.0)];
        let mut floors = [0.0; WIDTH];
        for (floor, speed) in floors.iter_mut().zip(speeds) {
            *floor = start + slope * speed;
        }
        floors
    }
}

/// The kernel of [`Front::bounds`].
struct Bounds<'a> {
    front: &'a Front,
    c: &'a [f64; LOADS],
    bounds: &'a mut [f64; WIDTH],
}

impl NullaryFnOnce for Bounds<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { front, c, bounds } = self;
        let magnitude = c.map(f64::abs);
        for (k, bound) in bounds.iter_mut().enumerate() {
            // The larger magnitude of middle ± half is the sum of theirs.
            *bound = form(c, &front.middle, k).abs()
                + form(c, &front.half, k).abs()
                + form(&magnitude, &front.reach, k);
        }
    }
}

/// The kernel of [`Front::against_speed`]: the least T·sgn n at an end of a stretch, and what it does not fall below on each.
struct Signs<'a> {
    front: &'a Front,
    c: &'a [f64; LOADS],
    least: &'a mut [f64; WIDTH],
}

impl NullaryFnOnce for Signs<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let Self { front, c, least } = self;
        let magnitude = c.map(f64::abs);
        let [first, last] = &front.directions;
        let mut ends = [0.0f64; WIDTH];
        for (k, (least, end)) in least.iter_mut().zip(&mut ends).enumerate() {
            let (middle, half) = (form(c, &front.middle, k), form(c, &front.half, k));
            *end = (first[k] * (middle - half)).min(last[k] * (middle + half));
            *least = front.direction[k] * middle - half.abs() - form(&magnitude, &front.reach, k);
        }
        ends.iter().fold(0.0, |lowest, end| lowest.min(*end))
    }
}

#[inline(always)]
fn form(c: &[f64; LOADS], x: &[[f64; WIDTH]; LOADS], k: usize) -> f64 {
    c[0] * x[0][k] + (c[1] * x[1][k] + c[2] * x[2][k]) + (c[3] * x[3][k] + c[4] * x[4][k])
}
