//! A motion as the plan that firmware follows: as few rows as keep it to a share of its acceleration.

mod rows;

use jred::axis::Plan as Read;
use jred::axis::plan::{Errors, Knot, PlanError, encode, image_len};
use jred::table::{Constants, Shape};
use jred::{Domain, Model, Scale, Spline, Table, curves};

use crate::trace::Trace;
use rows::{Asked, RANGE, apart, bounds, halve, span, without_slivers};

/// Share of the greatest acceleration and speed by which a plan may be off, if nothing else is asked.
pub const SHARE: f64 = 1e-3;

/// A plan that is off by so much more than it may be is one of a motion that contradicts itself between two nodes.
const FAITHFUL: f64 = 1.5;

/// Times of rows are closer than this share of the whole only where the motion ends: twice what a plan resolves.
const CLOSE: f64 = 1.0 / 536_870_912.0;

/// A step of the motion shorter than 8 times those is not looked at: the time of a row is rounded by as much.
const LOOKED: f64 = 8.0;

/// Places in a step of the motion at which a plan is looked at.
const LOOKS: [f64; 5] = [0.02, 0.25, 0.5, 0.75, 0.98];

/// Rows that are halved, because they leave the stroke between two looks, before that is an error.
const HALVED: usize = 256;

/// Units of the time that a plan is asked for, in a second.
const UNITS: f64 = 1_099_511_627_776.0;

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
        let (nodes, slivers) = without_slivers(apart(trace.nodes(), close), bounds, domain);
        let asked = Asked {
            bounds,
            domain,
            slivers: &slivers,
        };
        let mut knots = asked.knots(&nodes);
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
        let (worst, most) = measure(&draft, trace, &asked, LOOKED * close)?;
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
            excess: excess(worst, asked.bounds),
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

/// What the image gives beside the motion, as firmware with numbers of double precision reads it; and its greatest speed and acceleration.
fn measure(
    words: &[u32],
    trace: &Trace,
    asked: &Asked,
    short: f64,
) -> Result<([Worst; 3], [f32; 2]), PlanError> {
    let domain = asked.domain;
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
            let looked = if asked.leaves_out(t as f64 / UNITS) {
                2
            } else {
                3
            };
            for ((worst, found), exact) in all.iter_mut().zip(found).zip(exact).take(looked) {
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
