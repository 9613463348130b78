//! A motion as the plan that firmware follows: the fewest rows that keep within a share of its acceleration.

mod motion_polynomial;
mod polynomial;
pub mod ramp;
mod rows;

use jred::Domain;
use jred::axis::plan::{Errors, Knot, PlanError, encode, image_len, with_ramp};

use crate::trace::Trace;
use motion_polynomial::MotionPolynomial;
use rows::{Bounds, PlanRequirements, apart, halve, without_slivers};

/// Default error of a plan, as a share of the greatest acceleration and speed.
pub const SHARE: f64 = 1e-3;

/// Least distance of row times, as a share of the whole, except at the end of the motion: twice the resolution of a plan.
const LEAST_SPACING: f64 = 1.0 / 536_870_912.0;

/// Most rows that are halved because they leave the stroke between two checks, before that is an error.
const HALVED: usize = 256;

/// A plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Its image.
    pub words: Vec<u32>,
    /// Number of rows, including the end row.
    pub rows: usize,
    /// Largest errors (rad, or m, and s) over the whole motion, as firmware in double precision computes it.
    pub errors: Errors,
    /// The greatest speed and acceleration.
    pub most: [f32; 2],
    /// The shortest ramp of the rate (s) that keeps the drive's torque, infinite if no ramp does; `None` without a drive.
    pub ramp: Option<f64>,
    /// The first error beyond its bound, if any: position, speed and acceleration of the motion contradict each other between two nodes.
    pub excess: Option<Excess>,
}

/// An error of a plan beyond its bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// The quantity.
    pub quantity: MotionQuantity,
    /// The error, and its bound (rad, or m, and s).
    pub error: f64,
    /// As `error`.
    pub allowed: f64,
    /// Time of the largest error (s).
    pub t: f64,
}

/// A quantity of a plan at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionQuantity {
    /// φ, or s.
    Position,
    /// ω, or v.
    Speed,
    /// α, or a.
    Acceleration,
}

/// The largest error of a plan, and its time.
#[derive(Clone, Copy, Debug, Default)]
struct LargestError {
    error: f64,
    t: f64,
}

impl Plan {
    /// A plan of a drive link's motion with this range. `share` is the allowed error relative to the greatest acceleration and speed; `machine` is
    /// the identifier in the machine's tables.
    ///
    /// # Errors
    /// The motion is too long, leaves the stroke, or needs more than 65,535 rows.
    pub fn new(trace: &Trace, domain: Domain, machine: u32, share: f64) -> Result<Self, PlanError> {
        let bounds = Bounds::of(trace.nodes(), share);
        let close = LEAST_SPACING * trace.duration();
        let (nodes, slivers) = without_slivers(apart(trace.nodes(), close), bounds.asked, domain);
        let asked = PlanRequirements {
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
            most: motion_polynomial::greatest(&draft),
            words: write(&knots, errors)?,
            errors,
            ramp: None,
            excess: first_excess(worst, asked.bounds.asked),
        })
    }

    /// The same with the shortest ramp of the rate (s), rounded up in the image.
    ///
    /// # Errors
    /// The ramp is negative or NaN.
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

    /// Its image as bytes.
    pub fn bytes(&self) -> Vec<u8> {
        self.words
            .iter()
            .flat_map(|word| word.to_le_bytes())
            .collect()
    }
}

/// The first quantity with an error above its bound.
fn first_excess(worst: [LargestError; 3], bounds: [f64; 3]) -> Option<Excess> {
    let quantities = [
        MotionQuantity::Position,
        MotionQuantity::Speed,
        MotionQuantity::Acceleration,
    ];
    let all = quantities.into_iter().zip(worst).zip(bounds);
    let mut beyond = all.filter(|((_, worst), bound)| worst.error > *bound);
    let ((quantity, LargestError { error, t }), allowed) = beyond.next()?;
    Some(Excess {
        quantity,
        error,
        allowed,
        t,
    })
}

/// The errors of the image against the motion, over all of its time: the difference of the polynomials of a row and of a step of the motion is one
/// polynomial, which is bounded.
fn measure(
    words: &[u32],
    trace: &Trace,
    asked: &PlanRequirements,
    close: f64,
) -> [LargestError; 3] {
    let rows = motion_polynomial::rows(words, asked.domain);
    let mut all = [LargestError::default(); 3];
    let mut later = rows.iter().peekable();
    for [before, after] in trace.steps() {
        let step = MotionPolynomial::step(before, after);
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
                // A corner lies where a row can begin, to a unit of its time; of two closer corners one is left.
                let is_corner = width <= close || asked.leaves_out(from.midpoint(to));
                let known = std::array::from_fn(|k| all[k].error - row.rounding[k]);
                let looked = if is_corner { 2 } else { 3 };
                let found = own.beside(&exact, known).into_iter().zip(row.rounding);
                for (worst, (found, rounding)) in all.iter_mut().zip(found).take(looked) {
                    if let Some([error, share]) = found {
                        *worst = LargestError {
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
