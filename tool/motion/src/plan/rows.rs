//! Selects the nodes of a motion that become rows of its plan.

use jred_file::math;
use std::f64::consts::TAU;

use jred::Domain;
use jred::axis::plan::Knot;
use jred::machine::motion::State;

use super::motion_polynomial::MotionPolynomial;
use super::polynomial::BOUND_TOLERANCE;
use crate::trace::Node;

/// The allowed error of a position, as a share of the path, is this factor times the plan's share.
const POSITION_FACTOR: f64 = 0.1;

/// Half a unit at both ends of a row is an acceleration of at most 6 units over its length squared: the quintic's 60·s·(1 − s)·(1 − 2s) is 5.8.
const ROUNDING: f64 = 6.0;

/// A missed speed at an end of a row is an acceleration of at most this many times itself over the row's length: the quintic's 3.9, and a margin for
/// the missed position.
const MISS_FACTOR: f64 = 5.0;

/// Share of the range by which a row may exceed an end of the stroke at the checked points: rounding.
const STROKE_ROUNDING: f64 = 1e-9;

/// 2³²
pub(super) const RANGE: f64 = 4_294_967_296.0;

/// Relative errors of 32-bit integers for the greatest speed and the greatest acceleration, with the sums that produce them and the factors that
/// follow.
const DIGITS: [f64; 2] = [1.5 / 16_777_216.0, 1.0 / 4_194_304.0];

/// Relative resolution of the place in a row.
const PLACE: f64 = 1.0 / 1_073_741_824.0;

/// Allowed errors of position, speed and acceleration, as shares of the greatest values. The scales are at least the mean speed, and the acceleration
/// to the greatest speed within the motion: at constant speed an acceleration is only rounding.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// The allowed errors.
    pub(super) asked: [f64; 3],
    /// The greatest speed and acceleration.
    most: [f64; 2],
}

impl Bounds {
    /// Shares of a motion's greatest values.
    pub(super) fn of(nodes: &[Node], share: f64) -> Self {
        let most = |of: fn(&Node) -> f64| nodes.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let way = most(|node| node.phi) + most(|node| -node.phi);
        let time = nodes
            .last()
            .map_or(0.0, |node| node.t)
            .max(f64::MIN_POSITIVE);
        let speed = most(|node| node.omega.abs()).max(way / time);
        let acceleration = most(|node| node.alpha[0].abs().max(node.alpha[1].abs()));
        let acceleration = acceleration.max(speed / time);
        Self {
            asked: [
                POSITION_FACTOR * share * way,
                share * speed,
                share * acceleration,
            ],
            most: [speed, acceleration],
        }
    }

    /// Errors by rounding in a row of this length (s), with this polynomial of its acceleration.
    fn rounding(&self, length: f64, course: &MotionPolynomial, unit: f64) -> [f64; 3] {
        let [speed, acceleration] = self.most;
        let rounded = ROUNDING * unit / length;
        // Of the coefficients over the window 29 bits are left below the greatest sum.
        let window = math::exp2(math::log2(length).floor() + 1.0);
        let powers = course.acceleration.iter().rev();
        let raised = powers.fold(0.0, |sum, c| sum * window / length + c.abs());
        let fine = raised / 536_870_912.0;
        [
            4.0 * unit + PLACE * length * speed + 10.0 * window * window * fine,
            rounded + 8.0 * window * fine + DIGITS[0] * speed + PLACE * length * acceleration,
            rounded / length + MISS_FACTOR * PLACE * speed / length + DIGITS[1] * acceleration,
        ]
    }
}

/// The range in which positions of rows are counted (rad, or m).
pub(super) const fn span(domain: Domain) -> f64 {
    match domain {
        Domain::Turn => TAU,
        Domain::Stroke { from, to } => to - from,
    }
}

/// A unit of positions (rad, or m).
const fn unit(domain: Domain) -> f64 {
    span(domain) / RANGE
}

/// Nodes that a plan can distinguish: of two closer nodes one is kept, which continues as the second does.
pub(super) fn apart(nodes: &[Node], close: f64) -> Vec<Node> {
    let mut kept: Vec<Node> = Vec::with_capacity(nodes.len());
    for node in nodes {
        match kept.last_mut() {
            Some(before) if node.t - before.t < close => before.alpha[1] = node.alpha[1],
            _ => kept.push(*node),
        }
    }
    // The last node lies where the motion ends.
    if let (Some(end), Some(last)) = (nodes.last(), kept.last_mut()) {
        let before = last.alpha[0];
        *last = Node {
            alpha: [
                if last.t < end.t { before } else { end.alpha[0] },
                end.alpha[1],
            ],
            ..*end
        };
    }
    kept
}

/// A part of the motion between two jumps of the acceleration, or a jump and an end, that is too short for a row: rounding of positions would exceed
/// the allowed error of the acceleration.
#[derive(Clone, Copy, Debug)]
pub(super) struct TinyStep {
    /// Start and end time (s).
    t: [f64; 2],
    /// Error of the speed without it (rad/s, or m/s).
    speed: f64,
}

/// Least duration of a row (s): in a shorter one, rounding of positions exceeds the allowed error of the acceleration.
fn shortest([.., acceleration]: [f64; 3], domain: Domain) -> f64 {
    (ROUNDING * unit(domain) / acceleration).sqrt()
}

/// The nodes without slivers whose speed may be missed: the following part begins earlier; before the end, the preceding part continues.
pub(super) fn without_slivers(
    mut nodes: Vec<Node>,
    bounds: [f64; 3],
    domain: Domain,
) -> (Vec<Node>, Vec<TinyStep>) {
    let [_, speed, acceleration] = bounds;
    let short = shortest(bounds, domain);
    let end = nodes.len().saturating_sub(1);
    let is_cut = |k: &usize| {
        let [before, after] = nodes[*k].alpha;
        *k == end || (after - before).abs() > acceleration
    };
    let cuts: Vec<usize> = (1..nodes.len()).filter(is_cut).collect();
    let mut slivers = Vec::new();
    let mut stays = vec![true; nodes.len()];
    let mut from = 0;
    for to in cuts {
        let [first, last] = [nodes[from], nodes[to]];
        let length = last.t - first.t;
        let instead = if to == end {
            first.alpha[0]
        } else {
            last.alpha[1]
        };
        let missed = (last.omega - first.omega - instead * length).abs();
        if length >= short || missed > speed || from == 0 && to == end {
            from = to;
            continue;
        }
        if to == end {
            stays[from..to].fill(false);
            nodes[to].alpha[0] = instead;
        } else {
            stays[from + 1..=to].fill(false);
            nodes[from].alpha[1] = instead;
        }
        slivers.push(TinyStep {
            t: [first.t, last.t],
            speed: missed,
        });
    }
    let mut stays = stays.into_iter();
    nodes.retain(|_| stays.next().unwrap_or(true));
    joined(&mut nodes);
    (nodes, slivers)
}

/// Share of a step by which rounding may move the times of its ends.
const SAME_STEP: f64 = 1e-6;

/// Sets the steps to the times between the remaining nodes.
fn joined(nodes: &mut [Node]) {
    let mut before = None;
    for node in nodes {
        let length = before.replace(node.t).map_or(0.0, |t| node.t - t);
        if (length - node.step).abs() > SAME_STEP * length {
            node.step = length;
        }
    }
}

pub(super) struct PlanRequirements<'s> {
    /// Allowed errors of position, speed and acceleration.
    pub(super) bounds: Bounds,
    pub(super) domain: Domain,
    /// Parts omitted from the motion, in order of time.
    pub(super) slivers: &'s [TinyStep],
}

impl PlanRequirements<'_> {
    /// Error of the speed at an end of a row between these times, from an omitted sliver.
    fn missed(&self, [from, to]: [f64; 2]) -> f64 {
        let beside = |sliver: &&TinyStep| {
            sliver.t[0].total_cmp(&from).is_eq() || sliver.t[1].total_cmp(&to).is_eq()
        };
        let missed = self.slivers.iter().filter(beside);
        missed.map(|sliver| sliver.speed).sum()
    }

    /// Whether a time (s) lies in a sliver.
    pub(super) fn leaves_out(&self, t: f64) -> bool {
        let k = self.slivers.partition_point(|sliver| sliver.t[1] <= t);
        self.slivers.get(k).is_some_and(|sliver| sliver.t[0] <= t)
    }

    /// Allowed error of a row's polynomial between these times: the bounds less rounding, or the rounding itself where that takes more than half;
    /// more beside an omitted sliver.
    fn of_row(&self, ends: [f64; 2], course: &MotionPolynomial) -> [f64; 3] {
        let length = ends[1] - ends[0];
        let rounding = self.bounds.rounding(length, course, unit(self.domain));
        let missed = self.missed(ends);
        let more = [0.0, missed, MISS_FACTOR * missed / length];
        let asked = self.bounds.asked;
        std::array::from_fn(|k| {
            (asked[k] * (1.0 - BOUND_TOLERANCE) - rounding[k]).max(rounding[k]) + more[k]
        })
    }

    /// The knots of the plan: each row reaches as far as its polynomial keeps to the motion and to the stroke.
    pub(super) fn knots(&self, nodes: &[Node]) -> Vec<Knot> {
        let Some(last) = nodes.len().checked_sub(1) else {
            return Vec::new();
        };
        let short = shortest(self.bounds.asked, self.domain);
        let fits = |from: usize, to: usize| to == from + 1 || self.keeps(&nodes[from..=to]);
        let mut kept = vec![0];
        let mut from = 0;
        while from < last {
            // Doubles the reach, then bisects.
            let (mut reached, mut reach) = (from + 1, 2);
            while from + reach <= last && fits(from, from + reach) {
                (reached, reach) = (from + reach, 2 * reach);
            }
            let mut beyond = (from + reach).min(last + 1);
            while beyond - reached > 1 {
                let middle = reached.midpoint(beyond);
                if fits(from, middle) {
                    reached = middle;
                } else {
                    beyond = middle;
                }
            }
            // The rest before a corner may be so short that positions are too coarse: two rows of equal length instead.
            if nodes[reached].t - nodes[from].t < short
                && let [.., before, between] = kept.as_mut_slice()
            {
                let half = nodes[*before].t.midpoint(nodes[reached].t);
                let middle = nodes.partition_point(|node| node.t < half);
                let lies_between = *before < middle && middle < reached;
                if lies_between && fits(*before, middle) && fits(middle, reached) {
                    *between = middle;
                }
            }
            kept.push(reached);
            from = reached;
        }
        kept.into_iter().map(|k| knot(&nodes[k])).collect()
    }

    /// Whether the polynomial of fifth degree from the first node to the last keeps to every step between them, and to the stroke at the nodes and
    /// halfway between.
    fn keeps(&self, nodes: &[Node]) -> bool {
        let [Some(first), Some(last)] = [nodes.first(), nodes.last()] else {
            return true;
        };
        let through = MotionPolynomial::between(first, last);
        let length = last.t - first.t;
        let range = match self.domain {
            Domain::Turn => f64::NEG_INFINITY..=f64::INFINITY,
            Domain::Stroke { from, to } => {
                let beyond = STROKE_ROUNDING * (to - from);
                from - beyond..=to + beyond
            }
        };
        let bounds = self.of_row([first.t, last.t], &through);
        nodes.windows(2).all(|pair| {
            let [before, after] = [&pair[0], &pair[1]];
            let from = (before.t - first.t) / length;
            let width = (after.t - before.t) / length;
            let own = through.part(from, width, first.phi - before.phi);
            let middle = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125];
            let middle: f64 = own.position.iter().zip(middle).map(|(c, s)| c * s).sum();
            let end: f64 = own.position.iter().sum();
            let inside = [middle, end].map(|x| range.contains(&(before.phi + x)));
            inside == [true; 2] && own.keeps_to(&MotionPolynomial::step(before, after), bounds)
        })
    }
}

fn knot(node: &Node) -> Knot {
    Knot {
        t: node.t,
        position: node.phi,
        omega: node.omega,
        alpha: node.alpha,
    }
}

/// Splits a row in two: at its middle node, or halfway between its two nodes.
pub(super) fn halve(knots: &mut Vec<Knot>, nodes: &[Node], row: usize) {
    let (Some(from), Some(to)) = (knots.get(row), knots.get(row + 1)) else {
        return;
    };
    let first = nodes.partition_point(|node| node.t <= from.t);
    let behind = nodes.partition_point(|node| node.t < to.t);
    let middle = match nodes.get(first..behind) {
        Some(inner) if !inner.is_empty() => knot(&inner[inner.len() / 2]),
        _ => {
            let node = |knot: &Knot, step: f64| Node {
                t: knot.t,
                step,
                phi: knot.position,
                omega: knot.omega,
                alpha: knot.alpha,
            };
            let step = to.t - from.t;
            let State { phi, omega, alpha } = node(to, step).after(&node(from, 0.0), 0.5);
            Knot {
                t: from.t + 0.5 * step,
                position: phi,
                omega,
                alpha: [alpha; 2],
            }
        }
    };
    knots.insert(row + 1, middle);
}
