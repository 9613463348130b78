//! Friction by a coefficient in guides, slots and pins: as large as the force in the joint allows.
//!
//! ```text
//! guide, slot   f = μ·(|N| + P)                    along it; with bearings at a distance l: f = μ·(max(|N|, 2·|M|/l) + P)
//! pin           f = μ·r·(|F| + P)                  a moment
//! drive         T_f = sgn ω · Σ f_k·|s_k′|         s: coordinate of the joint (m, or rad)
//! ```
//!
//! The forces N, M, F follow from d'Alembert's principle and depend on all friction efforts f ≥ 0 linearly, R = R₀ + R_α·α + G·f. So f solves
//!
//! ```text
//! f = c·(h(R₀ + R_α·α + G·f) + P)                  c = μ or μ·r;   h: a norm in each joint
//! ```
//!
//! With K = c·h(G) ≥ 0, entry by entry, |h(a) − h(b)| ≤ h(a − b) makes the right-hand side a contraction if the spectral radius of K is below 1: there
//! is one solution for every load, and the iteration converges to it. Otherwise the position is refused. With one joint, some loads then have two
//! solutions and others have no solution: self-locking (P. Painlevé, *Leçons sur le frottement*, 1895). The radius is below 1 exactly if w = 1 + K·w
//! has a solution w > 0 (A. Berman, R. J. Plemmons, *Nonnegative Matrices in the Mathematical Sciences*, theorem 6.2.3), which is iterated too; above 0.99
//! that takes too long, and the position counts as locked.
//!
//! Coulomb's law with the sign of the motion: no stiction, zero at rest. μ of a pin is that of bearing tables, M = μ·r·F. For dry contact along a
//! line with the coefficient tan ρ, where the friction circle has the radius r·sin ρ, it is sin ρ.

use crate::machine::error::{MachineError, PoseError};
use crate::machine::joint::{Joint, Joints, Wrench};
use crate::machine::kinetostatics::{Equilibrium, MOST};
use crate::machine::mechanism::Jointed;
use crate::math;
use crate::number::error::{RangeError, finite, not_negative, positive};

/// Greatest number of joints with friction by a coefficient.
pub const MAX_FRICTIONS: usize = 16;

/// A slope of a joint's coordinate (m/rad, or 1) below which it does not slide: rounding.
const SLIDES: f64 = 1e-12;

/// Most steps of an iteration, which at a spectral radius of 0.99 leave 1e-17 of the error.
const STEPS: usize = 4000;

/// A change that is rounding, as a share of the terms' magnitudes.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Friction by a coefficient in one joint.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct JointFriction {
    joint: usize,
    /// c: μ, or μ·r of a pin.
    factor: f64,
    /// 2/l of a guide with a length.
    per_moment: f64,
    preload: f64,
    is_pin: bool,
}

impl JointFriction {
    /// Friction in a pin with the coefficient `coefficient` at its `radius` (m).
    ///
    /// # Errors
    /// A coefficient negative or not finite, a radius not positive.
    pub fn pin(joint: usize, coefficient: f64, radius: f64) -> Result<Self, RangeError> {
        let guide = Self::guide(joint, coefficient, None)?;
        Ok(Self {
            factor: guide.factor * positive("pin radius", radius)?,
            is_pin: true,
            ..guide
        })
    }

    /// Friction in a guide or a slot. With a `length` (m), the distance of the outer bearings on both sides of the slider's point, the moment in the
    /// guide presses on them as well; a slot has no moment.
    ///
    /// # Errors
    /// A coefficient negative or not finite, a length not positive.
    pub fn guide(joint: usize, coefficient: f64, length: Option<f64>) -> Result<Self, RangeError> {
        let length = length.map(|length| positive("guide length", length));
        Ok(Self {
            joint,
            factor: not_negative("coefficient of friction", coefficient)?,
            per_moment: length.transpose()?.map_or(0.0, |length| 2.0 / length),
            preload: 0.0,
            is_pin: false,
        })
    }

    /// With a force (N) that presses besides the joint's own, as the preload of a guide or the force of a seal.
    ///
    /// # Errors
    /// A force negative or not finite.
    pub fn with_preload(self, preload: f64) -> Result<Self, RangeError> {
        let preload = not_negative("preload", preload)?;
        Ok(Self { preload, ..self })
    }

    /// Index of the joint.
    #[must_use]
    pub const fn joint(&self) -> usize {
        self.joint
    }

    /// Refuses a joint of another kind.
    pub(super) fn check(&self, joints: &Joints) -> Result<(), MachineError> {
        match (joints.get(self.joint), self.is_pin) {
            (Some(Joint::Revolute(_)), true)
            | (Some(Joint::Prismatic(_) | Joint::PinInSlot(_)), false) => Ok(()),
            _ => Err(MachineError::NoSuchJoint {
                joint: self.joint,
                joints: joints.len(),
            }),
        }
    }

    /// c·h of the joint's reaction, and its gradient; at zero the gradient is zero.
    fn effort(&self, [a, b]: [f64; 2]) -> (f64, [f64; 2]) {
        let size = if self.is_pin {
            math::sqrt(a * a + b * b)
        } else {
            math::abs(a).max(math::abs(b))
        };
        let gradient = match (self.is_pin, math::abs(a) >= math::abs(b)) {
            (true, _) if size > 0.0 => [a / size, b / size],
            (false, true) => [math::sign(a), 0.0],
            (false, false) => [0.0, math::sign(b)],
            _ => [0.0; 2],
        };
        (self.factor * size, gradient.map(|g| self.factor * g))
    }
}

/// One joint with friction at a position and speed.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Contact {
    friction: JointFriction,
    /// |s′|
    slope: f64,
    /// Wrenches of a unit of friction on the two bodies.
    unit: [Wrench; 2],
    /// R₀, R_α and a row of G.
    base: [f64; 2],
    per_alpha: [f64; 2],
    influence: [[f64; 2]; MAX_FRICTIONS],
}

type Efforts = [f64; MAX_FRICTIONS];

/// Friction in the joints at a position and speed, for every acceleration: [`Machine::friction_at`](crate::machine::Machine::friction_at).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrictionState {
    contacts: heapless::Vec<Contact, MAX_FRICTIONS>,
    phi: f64,
    direction: f64,
    steepest: f64,
}

impl FrictionState {
    pub(super) fn new<M: Jointed>(
        equilibrium: &Equilibrium<M>,
        omega: f64,
        direction: f64,
    ) -> Result<Self, MachineError> {
        let Equilibrium {
            machine,
            frames,
            joints,
            phi,
            ..
        } = *equilibrium;
        let direction = math::sign(direction);
        let mut state = Self {
            phi,
            direction,
            ..Self::default()
        };
        if direction == 0.0 {
            return Ok(state);
        }
        let reaction = |friction: &JointFriction, solution: &[f64; MOST]| {
            let before = joints.iter().take(friction.joint);
            let first = before.map(Joint::constraints).sum::<usize>();
            let second = if friction.is_pin {
                1.0
            } else {
                friction.per_moment
            };
            let at = |k: usize| solution.get(k).copied().unwrap_or_default();
            [at(first), second * at(first + 1)]
        };
        let mut balance = equilibrium.balance();
        machine.add_active_forces(&mut balance, phi, omega)?;
        balance.add_inertia_forces(omega, 0.0);
        let base = equilibrium.solve(&balance);
        let mut balance = equilibrium.balance();
        balance.add_inertia_forces(0.0, 1.0);
        let per_alpha = equilibrium.solve(&balance);
        for friction in machine.frictions() {
            let Some(joint) = joints.get(friction.joint) else {
                continue;
            };
            let slope = joint.coordinate(frames).d1;
            let slides = math::abs(slope) > SLIDES;
            let against = if slides {
                -direction * math::sign(slope)
            } else {
                0.0
            };
            // Cannot fail: a machine has no more.
            let _ = state.contacts.push(Contact {
                friction: *friction,
                slope: math::abs(slope),
                unit: joint.unit_drive(frames).map(|wrench| wrench.times(against)),
                base: reaction(friction, &base),
                per_alpha: reaction(friction, &per_alpha),
                influence: [[0.0; 2]; MAX_FRICTIONS],
            });
        }
        for k in 0..state.contacts.len() {
            let mut balance = equilibrium.balance();
            for wrench in state.contacts.get(k).iter().flat_map(|c| &c.unit) {
                balance.add(wrench);
            }
            let by_unit = equilibrium.solve(&balance);
            for contact in &mut state.contacts {
                contact.influence[k] = reaction(&contact.friction, &by_unit);
            }
        }
        state.steepest = state.bound()?;
        Ok(state)
    }

    /// Checks that the friction is determined for every load, and returns a bound of |dT_f/dα|.
    fn bound(&self) -> Result<f64, PoseError> {
        let [mut weights, mut slopes] = [[0.0; MAX_FRICTIONS]; 2];
        for _ in 0..STEPS {
            let mut change = 0.0f64;
            let before = [weights, slopes];
            for (k, contact) in self.contacts.iter().enumerate() {
                let own = |reaction| contact.friction.effort(reaction).0;
                [weights[k], slopes[k]] = [1.0, own(contact.per_alpha)];
                for (j, influence) in contact.influence.iter().enumerate() {
                    weights[k] += own(*influence) * before[0][j];
                    slopes[k] += own(*influence) * before[1][j];
                }
                change = change.max((weights[k] - before[0][k]) / weights[k]);
            }
            if change <= ROUNDING {
                let each = self.contacts.iter().zip(slopes);
                return Ok(each.map(|(contact, slope)| contact.slope * slope).sum());
            }
        }
        Err(self.jams())
    }

    /// The error at the joint whose friction acts on itself most.
    fn jams(&self) -> PoseError {
        let own = |(k, contact): (usize, &Contact)| {
            let (own, _) = contact.friction.effort(contact.influence[k]);
            (own, contact.friction.joint)
        };
        let each = self.contacts.iter().enumerate().map(own);
        let (_, joint) = each.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
        PoseError::Jams {
            phi: self.phi,
            joint,
        }
    }

    /// The efforts, and their derivatives by α, which contract alike, by iteration.
    fn efforts(&self, alpha: f64) -> Result<[Efforts; 2], PoseError> {
        let alpha = finite("acceleration", alpha)?;
        let [mut efforts, mut slopes] = [[0.0; MAX_FRICTIONS]; 2];
        for _ in 0..STEPS {
            let before = [efforts, slopes];
            let mut settled = true;
            for (k, contact) in self.contacts.iter().enumerate() {
                let JointFriction {
                    factor, preload, ..
                } = contact.friction;
                let (mut reaction, mut by_alpha) = ([0.0; 2], contact.per_alpha);
                let mut size = preload;
                for axis in 0..2 {
                    let each = contact.influence.iter().zip(before[0]);
                    let terms = [contact.base[axis], contact.per_alpha[axis] * alpha];
                    for term in terms.into_iter().chain(each.map(|(by, f)| by[axis] * f)) {
                        reaction[axis] += term;
                        size += math::abs(term);
                    }
                    let each = contact.influence.iter().zip(before[1]);
                    by_alpha[axis] += each.map(|(by, slope)| by[axis] * slope).sum::<f64>();
                }
                let (effort, [p, q]) = contact.friction.effort(reaction);
                efforts[k] = effort + factor * preload;
                slopes[k] = p * by_alpha[0] + q * by_alpha[1];
                let off = math::abs(efforts[k] - before[0][k]);
                settled &= off <= ROUNDING * factor * size;
            }
            if settled {
                return Ok([efforts, slopes]);
            }
        }
        Err(self.jams())
    }

    /// The drive's torque against the friction (N·m, or N) at an acceleration of the drive link (rad/s², or m/s²), with the sign of the motion, and its
    /// derivative by the acceleration (kg·m², or kg). Its power is the loss.
    ///
    /// # Errors
    /// [`PoseError::Jams`] within rounding of it; an acceleration that is not finite.
    pub fn torque(&self, alpha: f64) -> Result<[f64; 2], PoseError> {
        Ok(self.efforts(alpha)?.map(|efforts| {
            let each = self.contacts.iter().zip(efforts);
            self.direction
                * each
                    .map(|(contact, effort)| contact.slope * effort)
                    .sum::<f64>()
        }))
    }

    /// Checks that every torque of the drive gives one acceleration, for this `inertia` (kg·m², or kg) at the drive link: the torque then rises with
    /// the acceleration everywhere, because the inertia exceeds a bound of |dT_f/dα|.
    ///
    /// # Errors
    /// [`PoseError::Jams`]: friction may grow faster with the acceleration than the force of inertia.
    pub fn check(&self, inertia: f64) -> Result<(), PoseError> {
        if self.steepest < inertia || self.contacts.is_empty() {
            Ok(())
        } else {
            Err(self.jams())
        }
    }

    /// The joints with their wrenches of friction on the first and second body.
    pub(super) fn wrenches(
        &self,
        alpha: f64,
    ) -> Result<impl Iterator<Item = (usize, [Wrench; 2])> + '_, PoseError> {
        let [efforts, _] = self.efforts(alpha)?;
        let each = self.contacts.iter().zip(efforts);
        Ok(each.map(|(contact, effort)| {
            let wrenches = contact.unit.map(|wrench| wrench.times(effort));
            (contact.friction.joint, wrenches)
        }))
    }
}
