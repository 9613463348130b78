//! The gentlest motion: of all motions over a way in a given time the one with the least RMS torque, energy or peak torque.
//!
//! ```text
//! minimise ∫ c(T) dt,   T = T(φ, v, a),   with ∫ dφ/v the given time
//! ```
//!
//! In x = v² it is ∫ c(T)/√x dφ with T a straight line in (x′, x) at each φ: T²/√x and 1/√x are convex, so a stationary motion is the
//! global optimum. Three things disturb that: viscous friction (√x enters T), the losses of gears (T bends where the power changes its
//! direction), and a time longer than the motion would take of itself (the multiplier of the time is negative, as where a weight must be
//! held). Whatever holds, [`bound`](self) gives a lower bound for all motions from a verification function, and the gap to it.
//!
//! - [`mesh`](self): w, the square of the pace along the path, in cubic pieces, the machine at Gauss points.
//! - [`solve`](self): Newton's method.
//! - [`bound`](self): the lower bound;
//! - [`task`](self): mesh after mesh, and the time that is better waited;
//! - [`waiting`](self): a wait on the way, where holding costs less than at the ends;
//! - [`scale`](self): the unit of its numbers, and its largest load;
//! - [`outcome`](self): cost, optimum and motion of what was found.

use std::rc::Rc;

use jred::Error;
use jred_machine::model::motion::Phase;

use self::outcome::Waits;
use self::task::{Task, edges};
use crate::way::Way;
pub use crate::way::without_drive;

mod bound;
mod cost;
mod mesh;
mod outcome;
mod ramps;
mod scale;
mod solve;
mod task;
mod waiting;

/// What is to be least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Objective {
    /// ∫T² dt: the RMS torque, copper loss.
    Rms,
    /// ∫(copper·T² + max(T·ω, 0)) dt: copper loss and the mechanical power that the motor draws; what flows back is not counted.
    Energy {
        /// Copper loss per square of the torque (W/(N·m)²).
        copper: f64,
    },
    /// The peak of |T|, as the mean of a high power of it ([`PEAK_POWER`]).
    Peak,
}

/// The power whose mean stands for the peak. The least peak of all motions is not less than the least of these means.
pub const PEAK_POWER: i32 = 64;

/// One move: a way in a time, in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Travel {
    /// Where it starts (rad, or m).
    pub start: f64,
    /// How far it goes, with its sign.
    pub distance: f64,
    /// How long it takes (s).
    pub duration: f64,
    /// Speeds at its ends along the way (rad/s, or m/s); zero is rest.
    pub speeds: [f64; 2],
    /// With a ramp, the accelerations at ends that move, along the way (rad/s², or m/s²).
    pub accelerations: [f64; 2],
    /// Share of the time in which the acceleration rises from zero to its first peak, and falls from its last one to zero; 0: it begins and ends with a
    /// jump. At an end that moves, the share in which it leaves what is given there.
    pub ramp: f64,
    /// Whether it goes on for ever: the end is the start, at a speed that is sought.
    pub ring: bool,
}

/// The form of the ends.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ends {
    rest: [bool; 2],
    ramp: f64,
    ring: bool,
}

impl Travel {
    fn ends(&self) -> Ends {
        Ends {
            rest: self.speeds.map(|speed| speed == 0.0 && !self.ring),
            ramp: if self.ring || self.ramp == 0.0 {
                0.0
            } else {
                self.ramp
            },
            ring: self.ring,
        }
    }
}

/// Why a motion could not be made.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// The machine cannot be placed somewhere.
    Machine(Error),
    /// A figure is zero, negative or not finite where it may not be.
    Figure(&'static str, f64),
    /// Nothing that moves has inertia.
    NoInertia,
    /// The method did not come to an end: no motion of finite cost was found.
    NotFound,
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Self::Machine(error)
    }
}

/// What is known of an optimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Optimum {
    /// No motion is better, by more than the gap.
    Global,
    /// Motions near it are not better; of others it is not known. The reason.
    Local(Reason),
}

/// Why an optimum may be local only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The time is longer than the motion takes of itself: waiting before or after it, where it is free, is better.
    LongTime,
    /// Viscous friction.
    Viscous,
    /// Losses of gears.
    Losses,
    /// The search did not come to its end: of the motions on the way this is the best.
    Ended,
    /// Something else: the bound is too low.
    Bound,
    /// The motion takes more than the search counted: its polynomials do not follow what was found.
    Written,
}

/// The gentlest motion of a move.
#[derive(Clone, Debug)]
pub struct Gentle {
    /// The move.
    pub travel: Travel,
    /// How long it moves (s): less than the time of the move where waiting costs less than to move slowly.
    pub moving: f64,
    /// Where it waits in the rest of the time (rad, or m).
    pub waits_at: f64,
    /// ∫c dt: of the square of the torque (N²·m²·s), of the power (J), of the torque's power in units of itself.
    pub cost: f64,
    /// No motion costs less; for the RMS torque and the energy.
    pub bound: Option<f64>,
    /// Lower bound on the peak torque of all motions in this time (N·m), where the peak is to be least and the optimum is global.
    pub least_peak: Option<f64>,
    /// What a second more costs: negative where it saves.
    pub per_second: f64,
    /// What is known of it.
    pub optimum: Optimum,
    /// Share by which the cost changed when the mesh was halved for the last time.
    pub discretisation: f64,
    /// Number of elements.
    pub elements: usize,
    /// The motion law that is better than what was found, if one is: then the motion is its.
    pub law: Option<&'static str>,
    /// The motion, in polynomials one after another.
    pub phases: Vec<Phase>,
}

impl Gentle {
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

/// Elements of the first mesh, and most of the last.
const FIRST: usize = 32;
const MOST: usize = 512;

/// The mesh is fine enough when halving it changes the cost by less than this share.
const FINE: f64 = 1e-9;

/// An optimum with a larger gap is not called global.
pub const GAP: f64 = 1e-4;

/// The gentlest motion.
///
/// Accuracy: for a constant inertia ∫T² is that of φ ∝ 3τ² − 2τ³ to 1e-9 (test `constant_inertia_is_the_cubic`).
///
/// # Errors
/// See [`Fault`].
pub fn gentlest(way: &Way, travel: &Travel, objective: Objective) -> Result<Gentle, Fault> {
    of(way, travel, objective, true)
}

/// The same, without the lower bound, which takes most of the time: a motion that is not convex counts as local.
///
/// # Errors
/// See [`Fault`].
pub(crate) fn unproved(way: &Way, travel: &Travel, objective: Objective) -> Result<Gentle, Fault> {
    of(way, travel, objective, false)
}

fn of(way: &Way, travel: &Travel, objective: Objective, prove: bool) -> Result<Gentle, Fault> {
    let found = from_end_to_end(way, travel, objective, [false, prove]);
    let may_wait = match &found {
        Ok(gentle) => gentle.optimum != Optimum::Global,
        Err(fault) => *fault == Fault::NotFound,
    };
    if may_wait {
        waiting::on_the_way(way, travel, objective, found)
    } else {
        found
    }
}

/// The gentlest motion that waits at its ends alone, where they are at rest; at one of them in any case if it must. With a lower
/// bound if that is wanted.
fn from_end_to_end(
    way: &Way,
    travel: &Travel,
    objective: Objective,
    [must_wait, prove]: [bool; 2],
) -> Result<Gentle, Fault> {
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
    let task = Task {
        way,
        travel,
        objective,
        edges: edges(way, travel),
        ramps: [travel.ramp; 2],
        places: Rc::default(),
    };
    let task = task.fitted(travel.duration)?;
    let rests = travel.ends().rest.contains(&true);
    let held = task.held()?;
    let whole = if must_wait {
        None
    } else {
        task.solve(travel.duration, FIRST, None)?
    };
    let mut solved = match whole {
        Some(whole) if !(rests && whole.waits(&held)) => whole,
        whole if rests => match task.shorter(&held) {
            // Where no wait is found, the motion without one will do.
            Err(Fault::NotFound) => whole.ok_or(Fault::NotFound)?,
            found => found?,
        },
        _ => return Err(Fault::NotFound),
    };
    let moving = solved.moving;
    // In a shorter time the acceleration rises otherwise.
    let shorter = task.fitted(moving)?;
    if moving < travel.duration
        && let Some(again) = shorter.solve(moving, FIRST, None)?
    {
        solved = again;
    }
    let mut change = f64::INFINITY;
    let mut parts = FIRST;
    while parts < MOST && change > FINE {
        parts *= 2;
        let Some(next) = solved.task.solve(moving, parts, Some(&solved.start()))? else {
            break;
        };
        if !next.follows(&solved) {
            break;
        }
        let powers = [&solved, &next].map(|solved| solved.stage.cost.power);
        let [before, cost] = [&solved, &next].map(|solved| solved.found.cost);
        // What is left of a torque that can be none is rounding.
        let torque = cost.powf(1.0 / f64::from(powers[1]));
        change = if powers[0] != powers[1] {
            f64::INFINITY
        } else if torque > 1e-10 {
            ((cost - before) / cost).abs()
        } else {
            0.0
        };
        solved = next;
    }
    let waits = Waits::new(travel.duration - moving, &held);
    solved.finish(change, &waits, prove)
}
