//! The contact force between cam and follower, and the speed at which it vanishes.
//!
//! At constant speed the contact force is a polynomial in ω, with terms from d'Alembert's principle at every φ:
//!
//! ```text
//! N(φ, ω) = a(φ) + c(φ)·ω + b(φ)·ω²        a: springs, weight, loads    c: dampers    b: inertia
//! ```
//!
//! so that the follower lifts off at φ at the smallest positive root, and the machine's limit is the smallest root over the turn.

use crate::machine::error::MachineError;
use core::f64::consts::TAU;
use core::fmt;

use super::extreme::smallest;
use super::program::{Piece, within_turn};
use crate::machine::reduction::MAX_LOADS;
use crate::machine::{Joint, Jointed, Machine};
use crate::math;
use crate::number::error::finite;

/// Limit of plausible speeds (rad/s); contact lost beyond it, by rounding, does not count as lost.
const FASTEST: f64 = 1e6;

/// The slowest constant speed at which the follower leaves the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LiftOff {
    /// Angle at which the contact force vanishes first (rad).
    pub phi: f64,
    /// The speed (rad/s), not negative; zero if nothing presses the follower on the cam there even at rest.
    pub omega: f64,
}

impl fmt::Display for LiftOff {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let phi = self.phi.to_degrees();
        if self.omega > 0.0 {
            write!(
                f,
                "the follower lifts off at φ = {phi:.2}° above {:.1} rpm: stiffer spring, more preload, or a slower machine",
                self.omega * 60.0 / TAU
            )
        } else {
            write!(
                f,
                "nothing presses the follower on the cam at φ = {phi:.2}°: add a spring, or more preload"
            )
        }
    }
}

/// The force (N) between the two bodies of joint number `contact`, positive for compression, at `phi` (rad) for the motion ω = `omega` (rad/s), α =
/// `alpha` (rad/s²).
///
/// # Errors
/// A joint that does not exist or is not a contact, and as [`Machine::forces`].
pub fn contact_force<M: Jointed>(
    machine: &Machine<M>,
    contact: usize,
    phi: f64,
    omega: f64,
    alpha: f64,
) -> Result<f64, MachineError> {
    let mechanism = machine.mechanism();
    let frames = mechanism.frames(phi)?;
    let joints = mechanism.joints(phi, &frames)?;
    let Some(Joint::Transmission([_, unit])) = joints.get(contact) else {
        return Err(MachineError::NoSuchJoint {
            joint: contact,
            joints: joints.len(),
        });
    };
    let state = [phi, finite("speed", omega)?, finite("acceleration", alpha)?];
    let forces = machine.forces_in(&frames, &joints, state)?;
    let reaction = forces.reactions.get(contact).map_or([0.0; 2], |r| r.force);
    Ok(reaction[0] * unit.force[0] + reaction[1] * unit.force[1])
}

/// The slowest constant speed, and its place, at which joint number `contact` loses contact; `None` if it keeps contact at every speed up to 1e6
/// rad/s. `pieces` are the smooth pieces of the turn, [`Program::pieces`](super::Program::pieces); the edges of loads that act over a part of the
/// turn are added here. `direction` is the cam's, +1 counter-clockwise.
///
/// Accuracy: the root at every φ is exact to rounding, φ is found to 1e-8 (tests `lift_off_of_a_circular_cam`, `contact_vanishes_at_lift_off`).
///
/// # Errors
/// As [`contact_force`]; friction by a coefficient in the joints.
pub fn lift_off<M: Jointed>(
    machine: &Machine<M>,
    contact: usize,
    pieces: impl Iterator<Item = Piece> + Clone,
    direction: f64,
) -> Result<Option<LiftOff>, MachineError> {
    // Friction by a coefficient bends the polynomial.
    machine.check_curves()?;
    let direction = if direction < 0.0 { -1.0 } else { 1.0 };
    // The three speeds that define the polynomial should be near the limit, where every term is significant.
    let rough = first(machine, contact, pieces.clone(), 100.0 * direction)?;
    match rough {
        Some(LiftOff { omega, .. }) if omega > 0.0 => {
            first(machine, contact, pieces, omega * direction)
        }
        other => Ok(other),
    }
}

/// The limit from the forces at ½, 1 and 2 times the speed `scale`.
fn first<M: Jointed>(
    machine: &Machine<M>,
    contact: usize,
    pieces: impl Iterator<Item = Piece>,
    scale: f64,
) -> Result<Option<LiftOff>, MachineError> {
    let edges = load_edges(machine);
    let slowness = |phi: f64| {
        let at = |speed: f64| contact_force(machine, contact, phi, speed, 0.0);
        let forces = [at(scale / 2.0)?, at(scale)?, at(2.0 * scale)?];
        // Smallest where the limit is lowest: smooth, and zero without a limit.
        let limit = math::abs(scale) * vanishing(forces);
        Ok::<_, MachineError>(if limit < FASTEST { -1.0 / limit } else { 0.0 })
    };
    let found = smallest(pieces.flat_map(|piece| Cut::new(piece, &edges)), slowness)?;
    Ok((found.value < 0.0).then_some(LiftOff {
        phi: found.phi,
        omega: -1.0 / found.value,
    }))
}

/// The speed, in units of the second force's speed, where the polynomial through the forces at ½, 1 and 2 vanishes; zero if it is not positive at
/// rest, infinite if it never vanishes.
fn vanishing([half, one, two]: [f64; 3]) -> f64 {
    let b = ((two - one) - 2.0 * (one - half)) / 1.5;
    let c = (two - one) - 3.0 * b;
    let a = one - c - b;
    if a <= 0.0 {
        return 0.0;
    }
    let under_root = c * c - 4.0 * a * b;
    if under_root < 0.0 {
        return f64::INFINITY;
    }
    let below = math::sqrt(under_root) - c;
    if below > 0.0 {
        2.0 * a / below
    } else {
        f64::INFINITY
    }
}

type Edges = heapless::Vec<f64, { 4 * MAX_LOADS }>;

/// The angles where a load begins or ends to change, within the turn, in order.
fn load_edges<M: Jointed>(machine: &Machine<M>) -> Edges {
    let mut edges: Edges = machine.load_edges().map(within_turn).collect();
    edges.sort_unstable_by(f64::total_cmp);
    edges
}

/// A piece cut at edges.
struct Cut<'a> {
    from: f64,
    to: f64,
    edges: core::slice::Iter<'a, f64>,
}

impl<'a> Cut<'a> {
    fn new(piece: Piece, edges: &'a [f64]) -> Self {
        Self {
            from: piece.from,
            to: piece.to,
            edges: edges.iter(),
        }
    }
}

impl Iterator for Cut<'_> {
    type Item = Piece;

    fn next(&mut self) -> Option<Piece> {
        const HAIR: f64 = 1e-9;
        let from = self.from;
        if self.to - from <= HAIR {
            return None;
        }
        let inside = |edge: &&f64| **edge > from + HAIR && **edge < self.to - HAIR;
        let to = self.edges.find(inside).copied().unwrap_or(self.to);
        self.from = to;
        Some(Piece { from, to })
    }
}
