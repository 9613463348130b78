//! A motion as the plan that firmware follows: as few rows as keep it to a share of its acceleration.

use std::f64::consts::TAU;

use jred::axis::Plan as Read;
use jred::axis::plan::{Errors, Knot, PlanError, encode, image_len};
use jred::machine::motion::{End, Polynomial, State};
use jred::table::{Constants, Shape};
use jred::{Domain, Model, Scale, Spline, Table, curves};

use crate::trace::{Node, Trace};

/// Share of the greatest acceleration and speed by which a plan may be off, if nothing else is asked.
pub const SHARE: f64 = 1e-3;

/// Share of that by which a position may be, of the way.
const OF_WAY: f64 = 0.1;

/// A plan that is off by so much more than it may be is one of a motion that contradicts itself between two nodes.
const FAITHFUL: f64 = 1.5;

/// Times of rows are closer than this share of the whole only where the motion ends: twice what a plan resolves.
const CLOSE: f64 = 1.0 / 536_870_912.0;

/// A step of the motion shorter than 8 times those is not looked at: the time of a row is rounded by as much.
const LOOKED: f64 = 8.0;

/// Half a unit at both ends of a row is at most 6 units over its length squared as an acceleration: the quintic's 60·s·(1 − s)·(1 − 2s) is 5.8.
const ROUNDING: f64 = 6.0;

/// Places in a step of the motion at which a plan is looked at.
const LOOKS: [f64; 5] = [0.02, 0.25, 0.5, 0.75, 0.98];

/// Share of the range by which a row that is looked at may be beyond an end of the stroke: rounding.
const BEYOND: f64 = 1e-9;

/// Rows that are halved, because they leave the stroke between two looks, before that is an error.
const HALVED: usize = 256;

/// Units of the time that a plan is asked for, in a second.
const UNITS: f64 = 1_099_511_627_776.0;

/// 2³²
const RANGE: f64 = 4_294_967_296.0;

/// A plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Its image.
    pub words: Vec<u32>,
    /// Rows, with that of the end.
    pub rows: usize,
    /// What it is off by at most (rad, or m, and s), as the firmware computes it, at five places of every step of the motion.
    pub errors: Errors,
    /// The greatest speed and acceleration.
    pub most: [f32; 2],
    /// Where it is off by more than was asked, if it is: position, speed and acceleration of the motion contradict each other between two nodes.
    pub excess: Option<Excess>,
}

/// A quantity by which a plan is off more than it may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// Which one.
    pub quantity: Quantity,
    /// By how much it is off, and how much it may be (rad, or m, and s).
    pub error: f64,
    /// As `error`.
    pub allowed: f64,
    /// When it is off the most (s).
    pub t: f64,
}

/// What a plan gives at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// φ, or s.
    Position,
    /// ω, or v.
    Speed,
    /// α, or a.
    Acceleration,
}

/// What a plan is off by, and when that is.
#[derive(Clone, Copy, Debug, Default)]
struct Worst {
    error: f64,
    t: f64,
}

impl Plan {
    /// Of a motion of the drive link with this range. `share` is that of the greatest acceleration, and of the greatest speed, by which it may be off; `machine` the
    /// identifier that the machine's tables have.
    ///
    /// # Errors
    /// A motion that is too long, leaves the stroke, or needs more than 65,535 rows.
    pub fn new(trace: &Trace, domain: Domain, machine: u32, share: f64) -> Result<Self, PlanError> {
        let bounds = bounds(trace.nodes(), share);
        let close = CLOSE * trace.duration();
        let nodes = apart(trace.nodes(), close);
        let mut knots = knots(&nodes, bounds, domain);
        let write = |knots: &[Knot], errors| {
            let mut words = vec![0; image_len(knots.len())];
            encode(knots, domain, machine, errors, &mut words).map(<[u32]>::to_vec)
        };
        let mut halved = 0;
        let draft = loop {
            match write(&knots, Errors::default()) {
                Err(PlanError::Stroke(row)) if halved < HALVED => {
                    halve(&mut knots, &nodes, row as usize);
                    halved += 1;
                }
                other => break other?,
            }
        };
        let (worst, most) = measure(&draft, trace, domain, LOOKED * close)?;
        let [position, speed, acceleration] = worst.map(|worst| (worst.error as f32).next_up());
        let errors = Errors {
            position,
            speed,
            acceleration,
        };
        Ok(Self {
            rows: knots.len(),
            words: write(&knots, errors)?,
            errors,
            most,
            excess: excess(worst, bounds),
        })
    }

    /// Its image, byte by byte.
    pub fn bytes(&self) -> Vec<u8> {
        self.words
            .iter()
            .flat_map(|word| word.to_le_bytes())
            .collect()
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

/// The first quantity that is off by more than its bound.
fn excess(worst: [Worst; 3], bounds: [f64; 3]) -> Option<Excess> {
    let quantities = [Quantity::Position, Quantity::Speed, Quantity::Acceleration];
    let all = quantities.into_iter().zip(worst).zip(bounds);
    let mut beyond = all.filter(|((_, worst), bound)| worst.error > FAITHFUL * bound);
    let ((quantity, Worst { error, t }), allowed) = beyond.next()?;
    Some(Excess {
        quantity,
        error,
        allowed,
        t,
    })
}

/// The knots of the plan: from each one as far as the polynomial through both keeps to the motion, and to the stroke.
fn knots(nodes: &[Node], bounds: [f64; 3], domain: Domain) -> Vec<Knot> {
    let Some(last) = nodes.len().checked_sub(1) else {
        return Vec::new();
    };
    let mut from = 0;
    let mut kept = vec![knot(&nodes[0])];
    while from < last {
        let fits = |to: usize| to == from + 1 || keeps(&nodes[from..=to], bounds, domain);
        // Twice as far each time, then the last place between.
        let (mut reached, mut reach) = (from + 1, 2);
        while from + reach <= last && fits(from + reach) {
            (reached, reach) = (from + reach, 2 * reach);
        }
        let mut beyond = (from + reach).min(last + 1);
        while beyond - reached > 1 {
            let middle = reached.midpoint(beyond);
            if fits(middle) {
                reached = middle;
            } else {
                beyond = middle;
            }
        }
        kept.push(knot(&nodes[reached]));
        from = reached;
    }
    kept
}

/// Makes two rows of one: at its middle node, or halfway between the two that it has.
fn halve(knots: &mut Vec<Knot>, nodes: &[Node], row: usize) {
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

/// By how much position, speed and acceleration may be off: shares of the greatest that there are, and at least of the mean speed, and of what takes the greatest speed in the time of the
/// motion: at constant speed an acceleration is nothing but rounding.
fn bounds(nodes: &[Node], share: f64) -> [f64; 3] {
    let most = |of: fn(&Node) -> f64| nodes.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let way = most(|node| node.phi) + most(|node| -node.phi);
    let time = nodes
        .last()
        .map_or(0.0, |node| node.t)
        .max(f64::MIN_POSITIVE);
    let speed = most(|node| node.omega.abs()).max(way / time);
    let acceleration = most(|node| node.alpha[0].abs().max(node.alpha[1].abs()));
    [
        OF_WAY * share * way,
        share * speed,
        share * acceleration.max(speed / time),
    ]
}

/// The range in which positions of rows are counted (rad, or m).
const fn span(domain: Domain) -> f64 {
    match domain {
        Domain::Turn => TAU,
        Domain::Stroke { from, to } => to - from,
    }
}

/// A unit of positions (rad, or m).
const fn unit(domain: Domain) -> f64 {
    span(domain) / RANGE
}

/// Nodes that a plan tells apart: of two that are closer one, which goes on as the second does.
fn apart(nodes: &[Node], close: f64) -> Vec<Node> {
    let mut kept: Vec<Node> = Vec::with_capacity(nodes.len());
    for node in nodes {
        match kept.last_mut() {
            Some(before) if node.t - before.t < close => before.alpha[1] = node.alpha[1],
            _ => kept.push(*node),
        }
    }
    // The end is where the motion ends.
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

/// Whether the polynomial of the fifth degree from the first node to the last keeps to the nodes between, and to the middles of their steps.
fn keeps(nodes: &[Node], [position, speed, acceleration]: [f64; 3], domain: Domain) -> bool {
    let [first, inner @ .., last] = nodes else {
        return true;
    };
    let through = Polynomial::between(
        last.phi - first.phi,
        last.t - first.t,
        End::new(first.omega, first.alpha[1]),
        End::new(last.omega, last.alpha[0]),
    );
    let range = match domain {
        Domain::Turn => f64::NEG_INFINITY..=f64::INFINITY,
        Domain::Stroke { from, to } => {
            let beyond = BEYOND * (to - from);
            from - beyond..=to + beyond
        }
    };
    // What rounding the positions of both ends takes can be exceeded as well.
    let length = last.t - first.t;
    let rounded = ROUNDING * unit(domain) / length;
    let (speed, acceleration) = (speed.max(rounded), acceleration.max(rounded / length));
    let near = |t: f64, phi: f64, omega: f64, alpha: f64| {
        let [x, v, a, _] = through.at(t - first.t);
        range.contains(&(first.phi + x))
            && (first.phi + x - phi).abs() <= position
            && (v - omega).abs() <= speed
            && (a - alpha).abs() <= acceleration
    };
    let at_nodes = inner.iter().all(|node| {
        node.alpha
            .iter()
            .all(|alpha| near(node.t, node.phi, node.omega, *alpha))
    });
    at_nodes
        && nodes.windows(2).all(|pair| {
            let [before, after] = [&pair[0], &pair[1]];
            let step = after.t - before.t;
            let state = after.after(before, 0.5);
            near(before.t + 0.5 * step, state.phi, state.omega, state.alpha)
        })
}

/// What the image gives beside the motion, as firmware with numbers of double precision reads it; and its greatest speed and acceleration.
fn measure(
    words: &[u32],
    trace: &Trace,
    domain: Domain,
    short: f64,
) -> Result<([Worst; 3], [f32; 2]), PlanError> {
    // A machine with this range, whatever its inertia: a plan takes range and units of it.
    let table = [1.0 / 6.0; 7];
    let shape = Shape::<Spline<f64>> {
        set: curves::INERTIA,
        cells: 4,
        domain,
        scale: Scale::SI,
        constants: Constants::default(),
    };
    let model = Table::new(&table, shape).and_then(Model::<_, { curves::INERTIA }>::new);
    let model = model.map_err(|error| PlanError::Image(error.into()))?;
    let plan = Read::new(words, &model)?;
    let (from, span) = match domain {
        Domain::Turn => (0.0, span(domain)),
        Domain::Stroke { from, .. } => (from, span(domain)),
    };
    let mut all = [Worst::default(); 3];
    for pair in trace.nodes().windows(2) {
        let [before, after] = [&pair[0], &pair[1]];
        let step = after.t - before.t;
        if step < short {
            continue;
        }
        for share in LOOKS {
            let t = ((before.t + share * step) * UNITS) as u64;
            let share = (t as f64 / UNITS - before.t) / step;
            let exact = after.after(before, share);
            let place = plan.at(t).value;
            let turned = f64::from(place.turns) + f64::from(place.motion.phase.to_bits()) / RANGE;
            let found = [from + turned * span, place.motion.omega, place.motion.alpha];
            let exact = [exact.phi, exact.omega, exact.alpha];
            for ((worst, found), exact) in all.iter_mut().zip(found).zip(exact) {
                let error = (found - exact).abs();
                if error > worst.error {
                    *worst = Worst {
                        error,
                        t: t as f64 / UNITS,
                    };
                }
            }
        }
    }
    Ok((all, plan.most()))
}
