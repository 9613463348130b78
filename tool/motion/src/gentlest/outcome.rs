//! The result for a solved move: its cost with the wait, the quality of the optimum, and the motion.

use jred::machine::motion::{End, Polynomial};
use jred_file::math;
use jred_file::model::motion::Phase;
use jred_file::number::quadrature::GAUSS_5;

use super::cost::Cost;
use super::mesh::Mesh;
use super::solve;
use super::task::{Solution, Stage};
use super::{Fault, GAP, LeastEffortMove, Objective, Optimum, Reason, bound};

/// A wait that costs less than moving slowly.
pub(super) struct Wait {
    duration: f64,
    at_end: bool,
    /// Holding torque there (N·m).
    torque: f64,
}

impl Wait {
    pub(super) fn new(duration: f64, held: &[f64; 2]) -> Self {
        let at_end = held[1].abs() <= held[0].abs();
        Self {
            duration,
            at_end,
            // At a moving end nothing is held: it never waits.
            torque: if duration > 0.0 {
                held[usize::from(at_end)]
            } else {
                0.0
            },
        }
    }
}

impl Solution<'_> {
    /// The result, with the relative change of the cost at the last mesh, and a lower bound on request.
    pub(super) fn finish(
        self,
        change: f64,
        waits: &Wait,
        prove: bool,
    ) -> Result<LeastEffortMove, Fault> {
        let Self {
            task,
            moving,
            scale,
            stage,
            mesh,
            found,
        } = self;
        let dynamics = task.dynamics;
        // The exact problem, without rounding.
        let exact = Stage {
            range: 0.0,
            cost: Cost {
                rounding: 0.0,
                ..stage.cost
            },
        };
        let rounded = task.problem(&mesh, moving, &scale, &stage);
        let problem = task.problem(&mesh, moving, &scale, &exact);
        let cost = problem.value(&found.x).ok_or(Fault::NotFound)?;
        // In N²·m²·s or J; for the peak in s.
        let size = match task.objective {
            Objective::Rms => scale.unit * scale.unit,
            Objective::Energy { copper } => copper * scale.unit * scale.unit,
            Objective::Peak => 1.0,
        };
        let [holding, ..] = exact.cost.torque(waits.torque / scale.unit);
        let held = size * holding * waits.duration;
        let viscous = mesh.stations.iter().any(|s| s.place.viscous > 0.0)
            || dynamics.actuator.coefficients.0[3] > 0.0;
        // A wait that costs nothing has a multiplier of zero.
        let waiting = waits.duration > 0.0;
        let multiplier = if waiting { -holding } else { found.multiplier };
        let whole = task.travel.ends().ramp == 0.0;
        let (mut bound, mut refuted) = (None, false);
        if prove && whole && task.objective != Objective::Peak {
            let value = bound::value([&problem, &rounded], &found, cost, multiplier)?;
            refuted = value.is_none();
            // A negative bound carries no information.
            let value = value.map(|value| size * moving * value + held);
            bound = value.filter(|bound| *bound >= 0.0);
        }
        let cost = size * moving * cost + held;
        // It may exceed the cost by rounding; more is refuted.
        let bound = bound.map(|bound| bound.min(cost));
        let bends = dynamics.bends();
        let convex = !viscous && !bends && !refuted && multiplier >= -1e-9 * found.cost;
        let proved =
            found.converged && convex || bound.is_some_and(|bound| cost - bound <= GAP * cost);
        let optimum = if proved {
            Optimum::Global
        } else if !found.converged {
            Optimum::Local(Reason::Ended)
        } else if refuted {
            Optimum::Local(Reason::Bound)
        } else if viscous {
            Optimum::Local(Reason::Viscous)
        } else if bends {
            Optimum::Local(Reason::Losses)
        } else if multiplier < 0.0 {
            Optimum::Local(Reason::LongTime)
        } else {
            Optimum::Local(Reason::Bound)
        };
        // The mean of any power is at most the peak.
        let peak = math::pow(found.cost, 1.0 / f64::from(stage.cost.power)) * scale.unit;
        // Valid for all motions, not for motions with a given ramp or with a wait.
        let of_all = task.objective == Objective::Peak && whole && !waiting;
        let least_peak = (of_all && proved).then_some(peak);
        let mut phases = phases(task.travel.distance, moving, &mesh, &found.x);
        if waiting {
            let still = Phase {
                duration: waits.duration,
                polynomial: Polynomial::constant_jerk([0.0; 3]),
            };
            let place = if waits.at_end { phases.len() } else { 0 };
            phases.insert(place, still);
        }
        Ok(LeastEffortMove {
            travel: *task.travel,
            moving,
            waits_at: task.travel.start
                + if waits.at_end {
                    task.travel.distance
                } else {
                    0.0
                },
            cost,
            bound,
            least_peak,
            per_second: -multiplier * size,
            optimum,
            discretisation: change,
            elements: mesh.elements.len(),
            law: None,
            phases,
        })
    }
}

/// Allowed error of a polynomial at half its time, for positions as a share of the path, for speeds as a share of the mean speed.
const POLYNOMIAL_ERROR: f64 = 1e-8;

/// Most halvings of a cell.
const HALVINGS: u32 = 16;

/// The motion as polynomials of fifth degree, one for each cell; more where the machine slows down so much within a cell that one is not enough.
fn phases(distance: f64, duration: f64, mesh: &Mesh, x: &[f64]) -> Vec<Phase> {
    let mut parts = Vec::with_capacity(mesh.cells.len());
    for &(index, ends) in &mesh.cells {
        let mut open = vec![(MotionSpan::new(mesh, x, index, ends), ends, 0)];
        while let Some((part, [from, to], depth)) = open.pop() {
            let middle = from.midpoint(to);
            let [first, second] = [[from, middle], [middle, to]]
                .map(|ends| (MotionSpan::new(mesh, x, index, ends), ends, depth + 1));
            if depth < HALVINGS && !part.meets([&first.0, &second.0]) {
                open.extend([second, first]);
            } else {
                parts.push(part);
            }
        }
    }
    // With smaller parts the integral of the time changes.
    let time: f64 = parts.iter().map(|part| part.time).sum();
    let phase = |part: &MotionSpan| {
        let [first, last] = part.states.map(|[_, speed, acceleration]| {
            let pace = time / duration;
            End::new(
                distance * speed * pace,
                distance * acceleration * pace * pace,
            )
        });
        let [start, end] = part.states.map(|[place, ..]| distance * place);
        let span = part.time / time * duration;
        Phase {
            duration: span,
            polynomial: Polynomial::between(end - start, span, first, last),
        }
    };
    parts.iter().map(phase).collect()
}

/// A cell or a part of it: shares of the path and of the time.
struct MotionSpan {
    time: f64,
    /// Position, speed and acceleration at both ends.
    states: [[f64; 3]; 2],
}

impl MotionSpan {
    fn new(mesh: &Mesh, x: &[f64], cell: usize, [from, to]: [f64; 2]) -> Self {
        let h = to - from;
        let time = GAUSS_5.iter().map(|[z, weight]| {
            let [w, ..] = solve::pace_at(mesh, x, cell, from + z * h);
            weight * h / w.sqrt()
        });
        let state = |u: f64| {
            let [g, slope, bend] = mesh.shape.at(u);
            let [w, change, _] = solve::pace_at(mesh, x, cell, u);
            [g, slope * w.sqrt(), bend * w + 0.5 * slope * change]
        };
        Self {
            time: time.sum(),
            states: [state(from), state(to)],
        }
    }

    /// Whether the polynomial from end to end agrees with its halves.
    fn meets(&self, [first, second]: [&Self; 2]) -> bool {
        let [[start, v, a], [end, w, b]] = self.states;
        let polynomial =
            Polynomial::between(end - start, self.time, End::new(v, a), End::new(w, b));
        let [way, speed, ..] = polynomial.at(first.time);
        let [middle, exact, _] = first.states[1];
        (first.time + second.time - self.time).abs() <= POLYNOMIAL_ERROR
            && (start + way - middle).abs() <= POLYNOMIAL_ERROR
            && (speed - exact).abs() <= POLYNOMIAL_ERROR
    }
}
