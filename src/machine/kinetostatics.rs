//! Kinetostatics: the force in every joint, and the drive torque, by d'Alembert's principle.
//!
//! Every link is isolated. Its active forces, the reactions of its joints and its inertia force F = −m·a_c with the moment M = −J_c·ψ̈ (1.1)-(1.8)
//! are in equilibrium (2.2)-(2.5):
//!
//! ```text
//! Σ F + Σ R − m·a_c = 0        Σ M_c − J_c·ψ̈ = 0        three equations a link
//! ```
//!
//! The unknowns, reactions and drive effort, are equal in number: one linear system. It uses neither J_red nor J_red′, so that comparing its drive
//! torque with the reduced equation (7.12) checks both.
//!
//! V. G. Nazarenko, *Dynamics of mechanisms*, Minsk 2002, chapters 1 and 2.

use crate::machine::Machine;
use crate::machine::error::MachineError;
use crate::machine::error::PoseError;
use crate::machine::joint::{Body, Joint, Joints, MAX_JOINTS, Wrench};
use crate::machine::joint_friction::FrictionState;
use crate::machine::link::{Frame, Link};
use crate::machine::mechanism::{Frames, Jointed, MAX_LINKS};
use crate::machine::reduction::TorqueTerms;
use crate::number::error::finite;
use crate::number::linear;

/// Greatest number of unknowns: three equations per link.
pub(super) const MOST: usize = 3 * MAX_LINKS;

/// The force in one joint, from its first body on its second: a force at a point and the moment about that point.
///
/// | joint | point |
/// |---|---|
/// | pin | the pin |
/// | guide | the second marker, the slider's own point; the moment keeps the slider parallel to the guide |
/// | rigid joint | the second marker |
/// | pin in a slot | the pin |
/// | transmission | where its effort acts on the second body: teeth in mesh, the end of a rope; for a moment only, the origin |
///
/// [Friction](crate::machine::JointFriction) in the joint is contained: along a guide or a slot, as a moment in a pin.
///
/// The test `joints_close_and_forces_balance` checks the balance of every link about each of these points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Reaction {
    /// Point of application, global (m).
    pub point: [f64; 2],
    /// Force, global components (N).
    pub force: [f64; 2],
    /// Moment about the point (N·m), counter-clockwise positive.
    pub moment: f64,
}

/// All forces of one instant.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Forces {
    /// The drive's torque on the drive link (N·m), or its force on a sliding drive link (N).
    pub drive: f64,
    /// The reaction in every joint, in the order of [`Jointed::joints`].
    pub reactions: heapless::Vec<Reaction, MAX_JOINTS>,
    /// Shaking force: the resultant −Σ m·a_c of the links' inertia forces (N).
    pub shaking_force: [f64; 2],
    /// Shaking moment of the links' inertia forces about the global origin (N·m).
    pub shaking_moment: f64,
}

impl<M: Jointed> Machine<M> {
    /// The forces at `phi` (rad) for the motion ω = `omega` (rad/s), α = `alpha` (rad/s²).
    ///
    /// Loads that oppose the motion and [friction in the joints](crate::machine::JointFriction) have the sign of ω, and are zero at rest. Needs about
    /// 30 kB of stack. Accuracy: 1e-10 of a column's largest value, compared with 50-digit golden data (tests `slider_crank_reactions_golden`,
    /// `four_bar_reactions_golden`), and the same for the drive torque compared with the reduced equation (test `dalembert_is_the_reduced_equation`).
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`; ω or α not finite; joints that do not leave exactly one degree of freedom, or are at a dead point or
    /// a [change point](Jointed::determined); [`PoseError::Jams`].
    pub fn forces(&self, phi: f64, omega: f64, alpha: f64) -> Result<Forces, MachineError> {
        let (omega, alpha) = (finite("speed", omega)?, finite("acceleration", alpha)?);
        let (frames, joints) = self.placed(phi)?;
        self.forces_in(&frames, &joints, [phi, omega, alpha])
    }

    /// Frames and joints where the forces are determined.
    fn placed(&self, phi: f64) -> Result<(Frames, Joints), PoseError> {
        let mechanism = self.mechanism();
        let frames = mechanism.frames(phi)?;
        let joints = mechanism.joints(phi, &frames)?;
        if mechanism.determined(phi) {
            Ok((frames, joints))
        } else {
            Err(PoseError::ChangePoint { phi })
        }
    }

    /// The forces for known frames of the links and joints; the motion must be finite.
    pub(crate) fn forces_in(
        &self,
        frames: &Frames,
        joints: &Joints,
        [phi, omega, alpha]: [f64; 3],
    ) -> Result<Forces, MachineError> {
        #[expect(clippy::large_stack_arrays, reason = "said in the documentation")]
        let (mut matrix, mut pivots): (Matrix, _) = ([0.0; MOST * MOST], [0; MOST]);
        let factors = (&mut matrix, &mut pivots);
        let equilibrium = Equilibrium::new(self, frames, joints, phi, factors)?;
        let mut balance = equilibrium.balance();
        self.add_active_forces(&mut balance, phi, omega)?;
        // The flywheel moves with the coordinate of the driven joint, like a rotor geared to it: between its two bodies, in either order. So it
        // changes the drive's effort, but no reaction.
        let driven = equilibrium.driven;
        let inertia = -self.flywheel() * driven.coordinate(frames).acceleration(omega, alpha);
        for on in &driven.unit_drive(frames) {
            balance.add(&on.times(inertia));
        }
        let (shaking_force, shaking_moment) = balance.add_inertia_forces(omega, alpha);
        let mut reactions: heapless::Vec<Reaction, MAX_JOINTS> =
            joints.iter().map(|_| Reaction::default()).collect();
        if !self.frictions().is_empty() {
            equilibrium.add_friction(&mut balance, omega, alpha, &mut reactions)?;
        }
        let solution = equilibrium.solve(&balance);

        let mut values = solution.iter().copied();
        for (joint, sum) in joints.iter().zip(&mut reactions) {
            let units = joint.unit_reactions(frames);
            // The force comes first, with no moment about its point.
            sum.point = units.first().map_or([0.0; 2], |[_, unit]| unit.point);
            for [_, on_second] in &units {
                sum.add(&on_second.times(values.next().unwrap_or_default()));
            }
        }
        Ok(Forces {
            drive: values.next().unwrap_or_default(),
            reactions,
            shaking_force,
            shaking_moment,
        })
    }

    /// The drive torque of a motion, term by term, with [friction in the joints](crate::machine::JointFriction) in its Coulomb term.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`; as [`friction_at`](Self::friction_at).
    pub fn torque(&self, phi: f64, omega: f64, alpha: f64) -> Result<TorqueTerms, MachineError> {
        let mut terms = self.bare_reduction(phi)?.torque(omega, alpha);
        terms.coulomb += self.friction_at(phi, omega, omega)?.torque(alpha)?[0];
        Ok(terms)
    }

    /// The friction in the joints at `phi` (rad) and the speed `omega` (rad/s), for any acceleration. `direction` is the sign of the motion, or of the
    /// motion that begins here from rest; 0: without friction.
    ///
    /// # Errors
    /// As [`forces`](Self::forces), if the machine has such friction; [`PoseError::Jams`].
    pub fn friction_at(
        &self,
        phi: f64,
        omega: f64,
        direction: f64,
    ) -> Result<FrictionState, MachineError> {
        if self.frictions().is_empty() || direction == 0.0 {
            return Ok(FrictionState::default());
        }
        let (frames, joints) = self.placed(phi)?;
        #[expect(clippy::large_stack_arrays, reason = "said in the documentation")]
        let (mut matrix, mut pivots): (Matrix, _) = ([0.0; MOST * MOST], [0; MOST]);
        let factors = (&mut matrix, &mut pivots);
        let equilibrium = Equilibrium::new(self, &frames, &joints, phi, factors)?;
        FrictionState::new(&equilibrium, omega, direction)
    }

    /// Gravity, loads and force elements.
    pub(super) fn add_active_forces(
        &self,
        balance: &mut Balance,
        phi: f64,
        omega: f64,
    ) -> Result<(), PoseError> {
        for (k, (link, frame)) in balance.links.iter().zip(balance.frames).enumerate() {
            let point = frame.point(link.com()).map(|c| c.value);
            let weight = self.gravity().map(|g| link.mass() * g);
            balance.add(&Wrench::force(Body::Link(k), point, weight));
        }
        for load in self.loads() {
            if let Some(frame) = balance.frames.get(load.link()) {
                balance.add(&load.wrench(frame, phi, omega));
            }
        }
        for element in self.elements() {
            let wrenches = element.wrenches(balance.frames, omega);
            for wrench in wrenches.ok_or(PoseError::EndsMeet { phi })? {
                balance.add(&wrench);
            }
        }
        Ok(())
    }
}

/// The matrix of the equations of equilibrium.
type Matrix = [f64; MOST * MOST];

/// The equations of equilibrium of all links at one position, solved for the reactions and the drive's effort.
pub(super) struct Equilibrium<'a, M> {
    pub(super) machine: &'a Machine<M>,
    pub(super) frames: &'a Frames,
    pub(super) joints: &'a Joints,
    pub(super) phi: f64,
    driven: &'a Joint,
    equations: usize,
    /// Its factors, and the pivots.
    factors: (&'a Matrix, &'a [usize; MOST]),
}

impl<'a, M: Jointed> Equilibrium<'a, M> {
    pub(super) fn new(
        machine: &'a Machine<M>,
        frames: &'a Frames,
        joints: &'a Joints,
        phi: f64,
        (matrix, pivots): (&'a mut Matrix, &'a mut [usize; MOST]),
    ) -> Result<Self, MachineError> {
        let mechanism = machine.mechanism();
        let links = mechanism.links();
        let equations = 3 * links.len();
        let unknowns = 1 + joints.iter().map(Joint::constraints).sum::<usize>();
        if unknowns != equations {
            return Err(MachineError::Mobility {
                links: links.len(),
                constraints: unknowns - 1,
            });
        }
        let Some(driven) = joints.get(mechanism.drive()) else {
            return Err(MachineError::NoSuchJoint {
                joint: mechanism.drive(),
                joints: joints.len(),
            });
        };
        let mut balance = Balance {
            links,
            frames,
            column: [0.0; MOST],
        };
        let mut columns = matrix.chunks_exact_mut(equations);
        let mut fill = |pair: &[Wrench; 2]| {
            balance.column = [0.0; MOST];
            balance.add(&pair[0]);
            balance.add(&pair[1]);
            if let Some(column) = columns.next() {
                column.copy_from_slice(&balance.column[..equations]);
            }
        };
        for joint in joints {
            joint.unit_reactions(frames).iter().for_each(&mut fill);
        }
        fill(&driven.unit_drive(frames));
        let used = &mut matrix[..equations * equations];
        if linear::factor(used, &mut pivots[..equations]) == 0.0 {
            return Err(PoseError::DeadPoint {
                phi,
                joint: mechanism.drive(),
            }
            .into());
        }
        Ok(Self {
            machine,
            frames,
            joints,
            phi,
            driven,
            equations,
            factors: (matrix, pivots),
        })
    }

    /// Adds the friction in the joints, and gives it joint by joint. Apart from [`Machine::forces`], so that machines without friction in their joints
    /// need no stack for it.
    #[inline(never)]
    fn add_friction(
        &self,
        balance: &mut Balance,
        omega: f64,
        alpha: f64,
        of_joints: &mut [Reaction],
    ) -> Result<(), MachineError> {
        let sliding = FrictionState::new(self, omega, omega)?;
        for (joint, [on_first, on_second]) in sliding.wrenches(alpha)? {
            balance.add(&on_first);
            balance.add(&on_second);
            if let Some(sum) = of_joints.get_mut(joint) {
                sum.add(&on_second);
            }
        }
        Ok(())
    }

    /// No forces.
    pub(super) fn balance(&self) -> Balance<'a> {
        Balance {
            links: self.machine.mechanism().links(),
            frames: self.frames,
            column: [0.0; MOST],
        }
    }

    /// Σ unknown reactions = −(active forces + inertia forces): the reactions in the order of the joints, then the drive's effort.
    pub(super) fn solve(&self, balance: &Balance) -> [f64; MOST] {
        let (n, (matrix, pivots)) = (self.equations, self.factors);
        let mut solution = balance.column.map(|f| -f);
        linear::solve(&matrix[..n * n], &pivots[..n], &mut solution[..n]);
        solution
    }
}

impl Reaction {
    fn add(&mut self, on_second: &Wrench) {
        self.force[0] += on_second.force[0];
        self.force[1] += on_second.force[1];
        self.moment += on_second.moment;
    }
}

/// Forces summed link by link: x, y, and the moment about the centre of mass.
pub(super) struct Balance<'a> {
    links: &'a [Link],
    frames: &'a Frames,
    column: [f64; MOST],
}

impl Balance<'_> {
    /// Adds a wrench to its link; wrenches on the ground are ignored.
    pub(super) fn add(&mut self, wrench: &Wrench) {
        let Some(link) = wrench.body.link() else {
            return;
        };
        if let (Some(properties), Some(frame), Some([x, y, moment])) = (
            self.links.get(link),
            self.frames.get(link),
            self.column.get_mut(3 * link..3 * link + 3),
        ) {
            *x += wrench.force[0];
            *y += wrench.force[1];
            *moment += wrench.moment_about(frame.point(properties.com()).map(|c| c.value));
        }
    }

    /// Adds every link's inertia force and moment, (1.1)-(1.8), and returns their resultant: force, and moment about the global origin.
    pub(super) fn add_inertia_forces(&mut self, omega: f64, alpha: f64) -> ([f64; 2], f64) {
        let (mut force, mut moment) = ([0.0; 2], 0.0);
        for (k, (link, frame)) in self.links.iter().zip(self.frames).enumerate() {
            let wrench = inertia_force(k, link, frame, omega, alpha);
            self.add(&wrench);
            force[0] += wrench.force[0];
            force[1] += wrench.force[1];
            moment += wrench.moment_about([0.0, 0.0]);
        }
        (force, moment)
    }
}

/// A link's inertia force F = −m·a_c at its centre of mass with the moment M = −J_c·ψ̈, (1.1), (1.2).
fn inertia_force(index: usize, link: &Link, frame: &Frame, omega: f64, alpha: f64) -> Wrench {
    let centre = frame.point(link.com());
    Wrench {
        body: Body::Link(index),
        point: centre.map(|c| c.value),
        force: centre.map(|c| -link.mass() * c.acceleration(omega, alpha)),
        moment: -link.inertia() * frame.psi.acceleration(omega, alpha),
    }
}
