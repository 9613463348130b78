//! A motion as the plan that firmware follows: as few rows as keep it to a share of its acceleration.

use std::f64::consts::TAU;

use jred::axis::Plan as Read;
use jred::axis::plan::{Errors, Knot, PlanError, encode, image_len};
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

/// A step of the motion shorter than 8 times `CLOSE` is not looked at: the time of a row is rounded by as much.
const LOOKED: f64 = 8.0;

/// Places in a step of the motion at which a plan is looked at.
const LOOKS: [f64; 5] = [0.02, 0.25, 0.5, 0.75, 0.98];

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
    /// Whether it is off by no more than was asked. Otherwise position, speed and acceleration of the motion contradict each other between two nodes.
    pub faithful: bool,
}

impl Plan {
    /// Of a motion of the drive link with this range. `share` is that of the greatest acceleration, and of the greatest speed, by which it may be off; `machine` the
    /// identifier that the machine's tables have.
    ///
    /// # Errors
    /// A motion that is too long, leaves the stroke, or needs more than 65,535 rows.
    pub fn new(trace: &Trace, domain: Domain, machine: u32, share: f64) -> Result<Self, PlanError> {
        let knots = knots(trace.nodes(), share);
        let mut words = vec![0; image_len(knots.len())];
        encode(&knots, domain, machine, Errors::default(), &mut words)?;
        let (errors, most) = measure(&words, trace, domain)?;
        encode(&knots, domain, machine, errors, &mut words)?;
        let [_, speed, acceleration] = bounds(trace.nodes(), share);
        let within = |error: f32, bound: f64| f64::from(error) <= FAITHFUL * bound;
        Ok(Self {
            faithful: within(errors.speed, speed) && within(errors.acceleration, acceleration),
            rows: knots.len(),
            words,
            errors,
            most,
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

/// The knots of the plan: from each one as far as the polynomial through both keeps to the motion.
fn knots(nodes: &[Node], share: f64) -> Vec<Knot> {
    let nodes = apart(nodes);
    let bounds = bounds(&nodes, share);
    let Some(last) = nodes.len().checked_sub(1) else {
        return Vec::new();
    };
    let mut from = 0;
    let mut kept = vec![knot(&nodes[0])];
    while from < last {
        let fits = |to: usize| to == from + 1 || keeps(&nodes[from..=to], bounds);
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

/// By how much position, speed and acceleration may be off.
fn bounds(nodes: &[Node], share: f64) -> [f64; 3] {
    let most = |of: fn(&Node) -> f64| nodes.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    [
        OF_WAY * share * (most(|node| node.phi) + most(|node| -node.phi)),
        share * most(|node| node.omega.abs()),
        share * most(|node| node.alpha[0].abs().max(node.alpha[1].abs())),
    ]
}

/// Nodes that a plan tells apart: of two that are closer one, which goes on as the second does.
fn apart(nodes: &[Node]) -> Vec<Node> {
    let close = CLOSE * nodes.last().map_or(0.0, |node| node.t);
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

/// Whether the polynomial from the first node to the last keeps to the nodes between, and to the middles of their steps.
fn keeps(nodes: &[Node], [position, speed, acceleration]: [f64; 3]) -> bool {
    let [first, inner @ .., last] = nodes else {
        return true;
    };
    let through = Quintic::of(first, last);
    let near = |t: f64, phi: f64, omega: f64, alpha: f64| {
        let [x, v, a] = through.at(t - first.t);
        (first.phi + x - phi).abs() <= position
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

/// The polynomial of the fifth degree through two states.
struct Quintic {
    length: f64,
    omega: f64,
    /// Coefficients of s² to s⁵ of the position (rad, or m).
    coefficients: [f64; 4],
}

impl Quintic {
    fn of(from: &Node, to: &Node) -> Self {
        let length = to.t - from.t;
        let (omega, half) = (from.omega, 0.5 * from.alpha[1] * length * length);
        let way = to.phi - from.phi - omega * length - half;
        let gained = (to.omega - omega) * length - 2.0 * half;
        let raised = to.alpha[0] * length * length - 2.0 * half;
        Self {
            length,
            omega,
            coefficients: [
                half,
                10.0 * way - 4.0 * gained + 0.5 * raised,
                -15.0 * way + 7.0 * gained - raised,
                6.0 * way - 3.0 * gained + 0.5 * raised,
            ],
        }
    }

    /// The way, speed and acceleration.
    fn at(&self, t: f64) -> [f64; 3] {
        let [a, b, c, d] = self.coefficients;
        let s = t / self.length;
        [
            self.omega * t + s * s * (a + s * (b + s * (c + s * d))),
            self.omega + s * (2.0 * a + s * (3.0 * b + s * (4.0 * c + s * 5.0 * d))) / self.length,
            (2.0 * a + s * (6.0 * b + s * (12.0 * c + s * 20.0 * d))) / (self.length * self.length),
        ]
    }
}

/// What the image gives beside the motion, as firmware with numbers of double precision reads it; and its greatest speed and acceleration.
fn measure(words: &[u32], trace: &Trace, domain: Domain) -> Result<(Errors, [f32; 2]), PlanError> {
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
        Domain::Turn => (0.0, TAU),
        Domain::Stroke { from, to } => (from, to - from),
    };
    let mut errors = [0.0_f64; 3];
    let short = LOOKED * CLOSE * trace.duration();
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
            for ((worst, found), exact) in errors.iter_mut().zip(found).zip(exact) {
                *worst = worst.max((found - exact).abs());
            }
        }
    }
    let [position, speed, acceleration] = errors.map(|error| (error as f32).next_up());
    let errors = Errors {
        position,
        speed,
        acceleration,
    };
    Ok((errors, plan.most()))
}
