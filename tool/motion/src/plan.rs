//! A motion as the plan that firmware follows: as few rows as keep it to a share of its acceleration.

mod course;
mod polynomial;
pub mod ramp;
mod rows;

use jred::Domain;
use jred::axis::plan::{Errors, Knot, PlanError, encode, image_len, with_ramp};

use crate::trace::Trace;
use course::Course;
use rows::{Asked, Bounds, apart, halve, without_slivers};

/// Share of the greatest acceleration and speed by which a plan may be off, if nothing else is asked.
pub const SHARE: f64 = 1e-3;

/// Times of rows are closer than this share of the whole only where the motion ends: twice what a plan resolves.
const CLOSE: f64 = 1.0 / 536_870_912.0;

/// Rows that are halved, because they leave the stroke between two looks, before that is an error.
const HALVED: usize = 256;

/// A plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Its image.
    pub words: Vec<u32>,
    /// Rows, with that of the end.
    pub rows: usize,
    /// What it is off by at most (rad, or m, and s), as firmware with numbers of double precision computes it, over the whole motion.
    pub errors: Errors,
    /// The greatest speed and acceleration.
    pub most: [f32; 2],
    /// The shortest ramp of the rate (s) with which it keeps the torque of its drive, infinite if none does; `None`: the drive is not known.
    pub ramp: Option<f64>,
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
        let bounds = Bounds::of(trace.nodes(), share);
        let close = CLOSE * trace.duration();
        let (nodes, slivers) = without_slivers(apart(trace.nodes(), close), bounds.asked, domain);
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
        let worst = measure(&draft, trace, &asked, close);
        let [position, speed, acceleration] = worst.map(|worst| (worst.error as f32).next_up());
        let errors = Errors {
            position,
            speed,
            acceleration,
        };
        Ok(Self {
            rows: knots.len(),
            most: course::greatest(&draft),
            words: write(&knots, errors)?,
            errors,
            ramp: None,
            excess: first_excess(worst, asked.bounds.asked),
        })
    }

    /// The same with the shortest ramp of the rate (s), which its image states rounded up.
    ///
    /// # Errors
    /// A ramp that is negative or NaN.
    pub fn with_ramp(mut self, ramp: Option<f64>) -> Result<Self, PlanError> {
        if let Some(ramp) = ramp {
            let least = ramp as f32;
            let up = if f64::from(least) < ramp {
                least.next_up()
            } else {
                least
            };
            with_ramp(&mut self.words, up)?;
        }
        self.ramp = ramp;
        Ok(self)
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
fn first_excess(worst: [Worst; 3], bounds: [f64; 3]) -> Option<Excess> {
    let quantities = [Quantity::Position, Quantity::Speed, Quantity::Acceleration];
    let all = quantities.into_iter().zip(worst).zip(bounds);
    let mut beyond = all.filter(|((_, worst), bound)| worst.error > *bound);
    let ((quantity, Worst { error, t }), allowed) = beyond.next()?;
    Some(Excess {
        quantity,
        error,
        allowed,
        t,
    })
}

/// What the image gives beside the motion, over all of its time: the polynomials of a row and of a step of the motion differ by one, of which a bound is found.
fn measure(words: &[u32], trace: &Trace, asked: &Asked, close: f64) -> [Worst; 3] {
    let rows = course::rows(words, asked.domain);
    let mut all = [Worst::default(); 3];
    let mut later = rows.iter().peekable();
    for pair in trace.nodes().windows(2) {
        let [before, after] = [&pair[0], &pair[1]];
        if after.step <= 0.0 {
            continue;
        }
        let step = Course::step(before, after);
        while let Some(row) = later.peek() {
            let [from, to] = [before.t.max(row.t[0]), after.t.min(row.t[1])];
            let width = to - from;
            if width > 0.0 {
                let own = (row.course).part(
                    (from - row.t[0]) / row.window,
                    width / row.window,
                    row.position - before.phi,
                );
                let exact = step.part((from - before.t) / after.step, width / after.step, 0.0);
                // A corner lies where a row can begin, to a unit of its time; of two that are closer one is left.
                let is_corner = width <= close || asked.leaves_out(from.midpoint(to));
                let known = std::array::from_fn(|k| all[k].error - row.rounding[k]);
                let looked = if is_corner { 2 } else { 3 };
                let found = own.beside(&exact, known).into_iter().zip(row.rounding);
                for (worst, (found, rounding)) in all.iter_mut().zip(found).take(looked) {
                    if let Some([error, share]) = found {
                        *worst = Worst {
                            error: error + rounding,
                            t: from + share * width,
                        };
                    }
                }
            }
            // The next row begins in this step, or the next step in this row.
            if row.t[1] > after.t {
                break;
            }
            later.next();
        }
    }
    all
}
