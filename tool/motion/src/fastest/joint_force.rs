//! The force in a joint as a limit.
//!
//! At a place the reaction is the sum of a part independent of the motion (weight, loads, springs), inertia forces by the squared speed and by the
//! acceleration, and viscous friction:
//!
//! ```text
//! R = r₀ + r₁·v + r₂·v² + r₃·a = c + r₃·a,   |R| ≤ F
//! ```
//!
//! Motion-opposing friction is part of r₀ with the sign that it has during the motion, also at its start and end.
//!
//! With e = r₃/|r₃| the limit leaves one interval of accelerations at each speed, a = (−c·e ± √(F² − (c×e)²))/|r₃|, or no acceleration where |c×e| >
//! F. Where r₃ vanishes, it limits the speed only: |c| ≤ F. An example is the dead centre of a slider that is the only moving mass.

use jred_file::math;
use std::ops::Deref;

use jred::error::Error;
use jred::machine::MAX_JOINTS;

use jred_file::model::machine::MachineFile;
use jred_file::model::schedule::ScheduleInstant;

use super::NoMotion;
use super::field::{Field, speed};
use super::track::Track;
use crate::path_dynamics::Place;
use crate::trace::Trace;

/// Share of the largest speed that counts as speed zero but keeps the friction of the motion.
const CREEP: f64 = 1e-100;

/// Kinds of terms of a reaction: without motion, by v, by v², by a.
const TERMS: usize = 4;

/// The largest force in each joint of a mechanism (N), in the order of its joints; initially unlimited.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointForces([f64; MAX_JOINTS]);

impl Default for JointForces {
    fn default() -> Self {
        Self([f64::INFINITY; MAX_JOINTS])
    }
}

impl JointForces {
    /// With a limit (N) for a joint; of two limits the smaller one applies.
    #[must_use]
    pub fn with(mut self, joint: usize, force: f64) -> Self {
        if let Some(own) = self.0.get_mut(joint) {
            *own = own.min(force);
        }
        self
    }

    /// Without the limit of a joint.
    #[must_use]
    pub fn without(mut self, joint: usize) -> Self {
        if let Some(own) = self.0.get_mut(joint) {
            *own = f64::INFINITY;
        }
        self
    }

    /// Whether a joint has a limit.
    pub fn is_some(&self) -> bool {
        self.limits().next().is_some()
    }

    /// Number of limited joints.
    pub fn count(&self) -> usize {
        self.limits().count()
    }

    /// The limited joints, with their limits.
    fn limits(&self) -> impl Iterator<Item = (usize, f64)> {
        let all = self.0.iter().copied().enumerate();
        all.filter(|(_, force)| force.is_finite())
    }
}

/// The reaction of a joint at a place, and its limit.
#[derive(Clone, Copy, Debug)]
pub struct JointForce {
    /// Index of the joint.
    pub joint: usize,
    /// Its limit (N).
    pub limit: f64,
    /// r₀ to r₃ (N, N·s/rad, N·s²/rad², N·s²/rad), along the path.
    terms: [[f64; 2]; TERMS],
}

/// The sum of vectors, each times its factor.
fn sum<const N: usize>(factors: [f64; N], vectors: [[f64; 2]; N]) -> [f64; 2] {
    let parts = factors.into_iter().zip(vectors);
    parts.fold([0.0; 2], |[x, y], (k, [u, v])| [x + k * u, y + k * v])
}

impl JointForce {
    /// Force (N) at a speed and an acceleration along the path.
    pub fn at(&self, v: f64, acceleration: f64) -> f64 {
        let [x, y] = sum([1.0, v, v * v, acceleration], self.terms);
        math::hypot(x, y)
    }

    /// Change of the force by the acceleration (N·s²/rad, or N·s²/m): |r₃|.
    pub fn by_acceleration(&self) -> f64 {
        let [.., [x, y]] = self.terms;
        math::hypot(x, y)
    }

    /// Least and largest acceleration at a speed; the least is the larger one if the interval is empty.
    fn accelerations(&self, v: f64) -> [f64; 2] {
        let [.., along] = self.terms;
        let [x, y] = sum([1.0, v, v * v, 0.0], self.terms);
        let size = self.by_acceleration();
        if size <= 0.0 {
            let open = math::hypot(x, y) <= self.limit;
            return if open {
                [f64::NEG_INFINITY, f64::INFINITY]
            } else {
                [f64::MAX, f64::MIN]
            };
        }
        let [e_x, e_y] = along.map(|r| r / size);
        let (inline, across) = (x * e_x + y * e_y, (x * e_y - y * e_x).abs());
        let half = if across <= self.limit {
            ((self.limit - across) * (self.limit + across)).sqrt()
        } else {
            self.limit - across
        };
        [(-inline - half) / size, (-inline + half) / size]
    }
}

/// The largest force that a motion reaches in a limited joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointForcePeak {
    /// Index of the joint.
    pub joint: usize,
    /// Its limit (N).
    pub limit: f64,
    /// The force (N).
    pub force: f64,
    /// Position (rad, or m).
    pub phi: f64,
    /// Time (s).
    pub t: f64,
    /// Whether the machine is at rest there.
    pub stands: bool,
}

impl JointForcePeak {
    /// Refuses a pause in which the force exceeds its limit.
    ///
    /// # Errors
    /// The force exceeds its limit during a pause.
    pub fn kept_at_rest(&self, file: &MachineFile) -> Result<(), NoMotion> {
        if !self.stands || self.force <= self.limit * (1.0 + ROUNDED) {
            return Ok(());
        }
        Err(NoMotion::JointForce {
            joint: self.name(file).to_owned(),
            phi: self.phi,
            forces: [self.force, self.limit],
            stands: true,
            axis: file.axis(),
        })
    }

    /// Name of the joint.
    pub fn name<'a>(&self, file: &'a MachineFile) -> &'a str {
        let names = file.machine.mechanism().joint_names();
        names.get(self.joint).map_or("", String::as_str)
    }
}

/// Share of a limit that is rounding.
const ROUNDED: f64 = 1e-9;

/// Parts of a step of a motion at whose ends its forces are evaluated.
const PARTS: u32 = 4;

/// Share of a step by which its ends are moved inwards: at a dead centre friction reverses, and the step's acceleration belongs to the force of its
/// own side.
const INSIDE: f64 = 1e-6;

/// The largest forces that a motion reaches in the limited joints, pauses included: each at the nodes and between them. In a pause there is no
/// motion-opposing friction; the forces are those of weight, loads and springs.
///
/// # Errors
/// The mechanism cannot be placed somewhere, or its forces are not determined.
pub fn reached(
    file: &MachineFile,
    forces: &JointForces,
    trace: &Trace,
) -> Result<Vec<JointForcePeak>, Error> {
    let first = |(joint, limit): (usize, f64)| JointForcePeak {
        joint,
        limit,
        force: 0.0,
        phi: 0.0,
        t: 0.0,
        stands: false,
    };
    let mut all: Vec<JointForcePeak> = forces.limits().map(first).collect();
    if all.is_empty() {
        return Ok(all);
    }
    for [a, b] in trace.steps() {
        let heading = b.phi - a.phi;
        let stands = heading == 0.0;
        let now = ScheduleInstant {
            omega: Some(if stands { 0.0 } else { heading.signum() }),
            ..ScheduleInstant::default()
        };
        for k in 0..=PARTS {
            let share = (f64::from(k) / f64::from(PARTS)).clamp(INSIDE, 1.0 - INSIDE);
            let state = b.after(a, share);
            let omega = if stands {
                0.0
            } else {
                // At rest friction has the sign of the motion.
                state.omega.abs().max(CREEP) * heading.signum()
            };
            let machine = file.machine_at(&now, state.phi)?;
            let found = machine.forces(state.phi, omega, state.alpha)?;
            for own in &mut all {
                let force = found.reactions.get(own.joint);
                let force = force.map_or(0.0, |own| math::hypot(own.force[0], own.force[1]));
                if force > own.force {
                    *own = JointForcePeak {
                        force,
                        phi: state.phi,
                        t: a.t + share * b.step,
                        stands,
                        ..*own
                    };
                }
            }
        }
    }
    Ok(all)
}

/// A place of the path with its limited forces. Between three places every quantity is the parabola through them.
#[derive(Clone, Copy, Debug)]
pub struct Spot<'c> {
    place: Place,
    forces: &'c [[JointForce; 3]],
    weights: [f64; 3],
}

impl Deref for Spot<'_> {
    type Target = Place;

    fn deref(&self) -> &Place {
        &self.place
    }
}

impl<'c> Spot<'c> {
    /// A place, and the forces at three places with their weights here.
    pub const fn new(place: Place, forces: &'c [[JointForce; 3]], weights: [f64; 3]) -> Self {
        Self {
            place,
            forces,
            weights,
        }
    }

    /// The forces.
    pub fn forces(&self) -> impl Iterator<Item = JointForce> {
        let weights = self.weights;
        self.forces.iter().map(move |three| JointForce {
            terms: std::array::from_fn(|k| sum(weights, three.map(|force| force.terms[k]))),
            ..three[0]
        })
    }

    /// The joints with the accelerations that their limits allow at z = ½·v².
    pub fn intervals(&self, z: f64) -> impl Iterator<Item = (usize, [f64; 2])> {
        let v = if self.forces.is_empty() {
            0.0
        } else {
            speed(z)
        };
        self.forces()
            .map(move |force| (force.joint, force.accelerations(v)))
    }
}

impl Field<'_, '_> {
    /// The limited forces at a position.
    ///
    /// # Errors
    /// The mechanism cannot be placed there, or its forces are not determined.
    pub fn forces(&self, phi: f64) -> Result<Vec<JointForce>, Error> {
        let forces = &self.limits.forces;
        if !forces.is_some() {
            return Ok(Vec::new());
        }
        let dynamics = self.dynamics;
        let machine = dynamics.file.machine_at(&dynamics.now(), phi)?;
        let reactions = |v: f64, a: f64| {
            let found = machine.forces(phi, v * dynamics.direction, a * dynamics.direction)?;
            Ok::<_, Error>(found.reactions)
        };
        // Each term is evaluated where it dominates, so that it is not lost in another term.
        let (top, _) = self.top();
        let unit = if top.is_finite() { top } else { 1.0 };
        let square = unit * unit;
        let slow = reactions(CREEP * unit, 0.0)?;
        let pushed = reactions(CREEP * unit, square)?;
        let [once, twice] = [reactions(unit, 0.0)?, reactions(2.0 * unit, 0.0)?];
        let own = |(joint, limit): (usize, f64)| {
            let all = [&slow, &pushed, &once, &twice].map(|found| found.get(joint));
            let [slow, pushed, once, twice] =
                all.map(|found| found.map_or([0.0; 2], |own| own.force));
            let at = |factors: [f64; 3], unit: f64| {
                sum(factors, [slow, once, twice]).map(|force| force / unit)
            };
            JointForce {
                joint,
                limit,
                terms: [
                    slow,
                    at([-1.5, 2.0, -0.5], unit),
                    at([0.5, -1.0, 0.5], square),
                    sum([-1.0, 1.0], [slow, pushed]).map(|force| force / square),
                ],
            }
        };
        Ok(forces.limits().map(own).collect())
    }
}

/// The place of the path at which a force most exceeds its limit without speed and acceleration: position and force.
pub fn without_motion(track: &Track) -> Option<(f64, JointForce)> {
    let share = |force: &JointForce| force.at(0.0, 0.0) / force.limit;
    let at = |u: f64| track.cells.iter().map(move |cell| cell.spot(u));
    let spots = [0.0, 0.5, 1.0].into_iter().flat_map(at);
    let all = spots.flat_map(|spot| {
        let phi = spot.phi;
        spot.forces()
            .map(move |force| (phi, force))
            .collect::<Vec<_>>()
    });
    let worst = all.max_by(|a, b| share(&a.1).total_cmp(&share(&b.1)));
    worst.filter(|(_, force)| share(force) > 1.0)
}
