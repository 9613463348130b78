//! The gentlest motion: of all motions over a path in a given time the one with the least RMS torque, energy or peak torque.
//!
//! ```text
//! minimise ∫ c(T) dt,   T = T(φ, v, a),   with ∫ dφ/v the given time
//! ```
//!
//! In x = v² this is ∫ c(T)/√x dφ, with T linear in (x′, x) at each φ. T²/√x and 1/√x are convex, so a stationary motion is the global optimum. Three
//! things disturb that: viscous friction (√x enters T), losses of gears (T bends where the power changes direction), and a time longer than the
//! unconstrained optimum (then the multiplier of the time is negative, as where a weight must be held). In every case [`bound`](self) gives a lower
//! bound for all motions from a verification function, and the gap to it.
//!
//! - [`mesh`](self): w, the square of the pace along the path, in cubic pieces, with the machine at Gauss points;
//! - [`solve`](self): Newton's method;
//! - [`bound`](self): the lower bound;
//! - [`task`](self): successive meshes, and time that is better spent waiting;
//! - [`waiting`](self): a wait on the path, where holding costs less than at the ends;
//! - [`scale`](self): the unit of the numbers, and the largest load;
//! - [`outcome`](self): cost, optimum and motion of a solution;
//! - [`cycle`]: the moves of a machine file, each in its own time, compared with the motion laws.

use jred_file::math;
use std::rc::Rc;

use jred::error::Error;
use jred_file::model::motion::Phase;

use self::outcome::Wait;
use self::task::{EffortTask, edges};
use crate::path_dynamics::PathDynamics;
pub use crate::path_dynamics::without_drive;

mod bound;
mod cost;
pub mod cycle;
mod mesh;
mod outcome;
mod ramps;
mod scale;
mod solve;
mod task;
mod waiting;

/// Quantity to minimise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Objective {
    /// ∫T² dt: the RMS torque, copper loss.
    Rms,
    /// ∫(copper·T² + max(T·ω, 0)) dt: copper loss and the mechanical power that the motor draws; returned power is not deducted.
    Energy {
        /// Copper loss per square of the torque (W/(N·m)²).
        copper: f64,
    },
    /// The peak of |T|, approximated by the mean of a high power ([`PEAK_POWER`]).
    Peak,
}

/// The power whose mean approximates the peak. The least peak of all motions is not less than the least of these means.
pub const PEAK_POWER: i32 = 64;

/// One move: a path in a given time, in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Travel {
    /// Start position (rad, or m).
    pub start: f64,
    /// Signed length.
    pub distance: f64,
    /// Duration (s).
    pub duration: f64,
    /// Speeds at the ends along the path (rad/s, or m/s); zero is rest.
    pub speeds: [f64; 2],
    /// With a ramp, the accelerations at moving ends, along the path (rad/s², or m/s²).
    pub accelerations: [f64; 2],
    /// Share of the time in which the acceleration rises from zero to its first peak, and falls from its last peak to zero; 0: it begins and ends
    /// with a jump. At a moving end, the share in which it leaves the given acceleration.
    pub ramp: f64,
    /// Whether the move repeats endlessly: the end is the start, at a speed to be found.
    pub ring: bool,
}

/// The form of the ends.
#[derive(Clone, Copy, Debug, PartialEq)]
struct EndConditions {
    /// Whether each end is at rest.
    rest: [bool; 2],
    ramp: f64,
    ring: bool,
}

impl Travel {
    fn ends(&self) -> EndConditions {
        EndConditions {
            rest: self.speeds.map(|speed| speed == 0.0 && !self.ring),
            ramp: if self.ring { 0.0 } else { self.ramp },
            ring: self.ring,
        }
    }
}

/// Why a motion could not be made.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// The machine cannot be placed somewhere.
    Machine(Error),
    /// A figure is zero, negative or not finite, which is not allowed.
    Figure(&'static str, f64),
    /// Nothing in motion has inertia.
    NoInertia,
    /// The method did not converge: no motion of finite cost was found.
    NotFound,
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Self::Machine(error)
    }
}

/// Quality of an optimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Optimum {
    /// No motion is better by more than the gap.
    Global,
    /// No nearby motion is better; distant ones may be. With the reason.
    Local(Reason),
}

/// Why an optimum may be local only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The time is longer than the unconstrained optimum: waiting before or after, where it is free, is better.
    LongTime,
    /// Viscous friction.
    Viscous,
    /// Losses of gears.
    Losses,
    /// The search did not converge: this is the best motion found.
    Ended,
    /// Another reason: the bound is too low.
    Bound,
    /// The final motion costs more than the search computed: its polynomials do not follow the solution.
    Written,
}

/// The gentlest motion of a move.
#[derive(Clone, Debug)]
pub struct LeastEffortMove {
    /// The move.
    pub travel: Travel,
    /// Time in motion (s): less than the duration of the move where waiting costs less than moving slowly.
    pub moving: f64,
    /// Where it waits for the rest of the time (rad, or m).
    pub waits_at: f64,
    /// ∫c dt: of the squared torque (N²·m²·s), of the power (J), or of the torque's high power in its own unit.
    pub cost: f64,
    /// Lower bound of the cost; for the RMS torque and the energy.
    pub bound: Option<f64>,
    /// Lower bound of the peak torque of all motions in this time (N·m), if the peak is minimised and the optimum is global.
    pub least_peak: Option<f64>,
    /// Cost of one more second; negative if it saves.
    pub per_second: f64,
    /// Quality of the optimum.
    pub optimum: Optimum,
    /// Relative change of the cost at the last halving of the mesh.
    pub discretisation: f64,
    /// Number of elements.
    pub elements: usize,
    /// The motion law, if one is better than the solution; the motion is then by this law.
    pub law: Option<&'static str>,
    /// The motion, as successive polynomials.
    pub phases: Vec<Phase>,
}

impl LeastEffortMove {
    /// (cost − bound)/cost.
    pub fn gap(&self) -> Option<f64> {
        let bound = self.bound?;
        Some(if self.cost > 0.0 {
            ((self.cost - bound) / self.cost).max(0.0)
        } else {
            0.0
        })
    }
}

/// Elements of the first mesh, and the largest number.
const FIRST: usize = 32;
const MOST: usize = 512;

/// The mesh is fine enough when halving it changes the cost by less than this share.
const MESH_TOLERANCE: f64 = 1e-9;

/// Largest gap of an optimum that counts as global.
pub const GAP: f64 = 1e-4;

/// The gentlest motion.
///
/// Accuracy: for a constant inertia ∫T² is that of φ ∝ 3τ² − 2τ³ to 1e-9 (test `constant_inertia_is_the_cubic`).
///
/// # Errors
/// See [`Fault`].
pub fn gentlest(
    dynamics: &PathDynamics,
    travel: &Travel,
    objective: Objective,
) -> Result<LeastEffortMove, Fault> {
    of(dynamics, travel, objective, true)
}

/// The same; `prove`: with the lower bound, which takes most of the time. Without it a motion that is not convex counts as local.
///
/// # Errors
/// See [`Fault`].
pub(crate) fn of(
    dynamics: &PathDynamics,
    travel: &Travel,
    objective: Objective,
    prove: bool,
) -> Result<LeastEffortMove, Fault> {
    let found = from_end_to_end(dynamics, travel, objective, Waiting::Allowed, prove);
    let may_wait = match &found {
        Ok(gentle) => gentle.optimum != Optimum::Global,
        Err(fault) => *fault == Fault::NotFound,
    };
    if may_wait {
        waiting::on_the_way(dynamics, travel, objective, found)
    } else {
        found
    }
}

/// Whether a move waits at one of its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Waiting {
    /// Where that costs less than moving slowly.
    Allowed,
    /// In any case.
    Required,
}

/// The gentlest motion that waits only at its ends, where they are at rest. With a lower bound on request.
fn from_end_to_end(
    dynamics: &PathDynamics,
    travel: &Travel,
    objective: Objective,
    waiting: Waiting,
    prove: bool,
) -> Result<LeastEffortMove, Fault> {
    for (what, value) in [
        ("distance", travel.distance.abs()),
        ("duration", travel.duration),
    ] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(Fault::Figure(what, value));
        }
    }
    for speed in travel.speeds {
        if !(speed >= 0.0 && speed.is_finite()) {
            return Err(Fault::Figure("speed", speed));
        }
    }
    if !(0.0..=0.25).contains(&travel.ramp) {
        return Err(Fault::Figure("ramp", travel.ramp));
    }
    let task = EffortTask {
        dynamics,
        travel,
        objective,
        edges: edges(dynamics, travel),
        ramps: [travel.ramp; 2],
        places: Rc::default(),
    };
    let task = task.fitted(travel.duration)?;
    let rests = travel.ends().rest.contains(&true);
    let held = task.held()?;
    let whole = if waiting == Waiting::Required {
        None
    } else {
        task.solve(travel.duration, FIRST, None)?
    };
    let mut solved = match whole {
        Some(whole) if !(rests && whole.waits(&held)) => whole,
        whole if rests => match task.shorter(&held) {
            // If no wait is found, the motion without one is used.
            Err(Fault::NotFound) => whole.ok_or(Fault::NotFound)?,
            found => found?,
        },
        _ => return Err(Fault::NotFound),
    };
    let moving = solved.moving;
    // In a shorter time the acceleration rises differently.
    let shorter = task.fitted(moving)?;
    if moving < travel.duration
        && let Some(again) = shorter.solve(moving, FIRST, None)?
    {
        solved = again;
    }
    let mut change = f64::INFINITY;
    let mut parts = FIRST;
    while parts < MOST && change > MESH_TOLERANCE {
        parts *= 2;
        let Some(next) = solved.task.solve(moving, parts, Some(&solved.start()))? else {
            break;
        };
        if !next.follows(&solved) {
            break;
        }
        let powers = [&solved, &next].map(|solved| solved.stage.cost.power);
        let [before, cost] = [&solved, &next].map(|solved| solved.found.cost);
        // If the torque can be zero, the rest is rounding.
        let torque = math::pow(cost, 1.0 / f64::from(powers[1]));
        change = if powers[0] != powers[1] {
            f64::INFINITY
        } else if torque > 1e-10 {
            ((cost - before) / cost).abs()
        } else {
            0.0
        };
        solved = next;
    }
    let waits = Wait::new(travel.duration - moving, &held);
    solved.finish(change, &waits, prove)
}
