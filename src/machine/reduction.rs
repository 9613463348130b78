//! The method of reduction: a machine replaced by one rotating link.
//!
//! ```text
//! J_red(φ) = Σ m·(x_c′² + y_c′²) + J_c·ψ′²          (6.4)
//! T_red(φ, ω) = Σ F·r′ + M·ψ′                        (6.2)
//!             = −U′(φ) + process(φ) − b(φ)·ω − c(φ)·sgn ω
//! J·α + ½·J′·ω² = T + T_red(φ, ω)                    (7.12), T: the drive's torque on the drive link
//! ```
//!
//! V. G. Nazarenko, *Dynamics of mechanisms*, Minsk 2002. For a sliding drive link read m_red for J, F for T (7.10).

use crate::machine::error::MachineError;
use crate::machine::error::PoseError;
use crate::number::error::RangeError;

use crate::machine::element::{Element, MAX_ELEMENTS};
use crate::machine::joint_friction::{JointFriction, MAX_FRICTIONS};
use crate::machine::load::Load;
use crate::machine::mechanism::{Frames, Jointed, MAX_LINKS, Mechanism};
use crate::math;
use crate::number::error::{finite, not_negative};

/// Greatest number of loads of a machine.
pub const MAX_LOADS: usize = 16;

/// The reduced link at one position.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct Reduction {
    /// J_red (kg·m²).
    pub inertia: f64,
    /// dJ/dφ (kg·m²/rad).
    pub inertia_slope: f64,
    /// d²J/dφ² (kg·m²/rad²).
    pub inertia_curvature: f64,
    /// Potential energy U of gravity and springs (J).
    pub potential_energy: f64,
    /// U′ (N·m).
    pub potential_slope: f64,
    /// Signed process torque (N·m), in +φ direction.
    pub process: f64,
    /// b in −b·ω (N·m·s/rad).
    pub viscous: f64,
    /// c in −c·sgn ω (N·m): Coulomb friction and every other load that opposes the motion.
    pub coulomb: f64,
}

impl Reduction {
    /// A link with the inertia [J, J′, J″] and without loads.
    #[must_use]
    pub const fn new([inertia, inertia_slope, inertia_curvature]: [f64; 3]) -> Self {
        Self {
            inertia,
            inertia_slope,
            inertia_curvature,
            potential_energy: 0.0,
            potential_slope: 0.0,
            process: 0.0,
            viscous: 0.0,
            coulomb: 0.0,
        }
    }

    /// [J, J′, J″], as for [`new`](Self::new).
    #[must_use]
    pub const fn inertias(&self) -> [f64; 3] {
        [self.inertia, self.inertia_slope, self.inertia_curvature]
    }

    /// Adds the potential energy [U, U′] (J, N·m).
    #[must_use]
    pub const fn with_potential_energy(self, [energy, slope]: [f64; 2]) -> Self {
        Self {
            potential_energy: energy,
            potential_slope: slope,
            ..self
        }
    }

    /// Adds a process torque (N·m) in +φ direction.
    #[must_use]
    pub const fn with_process(self, process: f64) -> Self {
        Self { process, ..self }
    }

    /// Adds b in −b·ω (N·m·s/rad).
    #[must_use]
    pub const fn with_viscous(self, viscous: f64) -> Self {
        Self { viscous, ..self }
    }

    /// Adds c in −c·sgn ω (N·m).
    #[must_use]
    pub const fn with_coulomb(self, coulomb: f64) -> Self {
        Self { coulomb, ..self }
    }

    /// The part of the reduced torque that is independent of ω: −U′ + process (N·m).
    #[must_use]
    pub fn load_torque(&self) -> f64 {
        self.process - self.potential_slope
    }

    /// Reduced torque T_red(φ, ω) (N·m); sgn 0 = 0.
    #[must_use]
    pub fn reduced_torque(&self, omega: f64) -> f64 {
        self.load_torque() - self.viscous * omega - self.coulomb * math::sign(omega)
    }

    /// Drive torque for the motion (ω, α), term by term.
    #[must_use]
    pub fn torque(&self, omega: f64, alpha: f64) -> TorqueTerms {
        TorqueTerms {
            acceleration: self.inertia * alpha,
            velocity: 0.5 * self.inertia_slope * omega * omega,
            potential: self.potential_slope,
            process: -self.process,
            viscous: self.viscous * omega,
            coulomb: self.coulomb * math::sign(omega),
        }
    }

    /// Acceleration α (rad/s²) by the drive torque `torque` (N·m) at speed ω (7.12).
    #[must_use]
    pub fn acceleration(&self, omega: f64, torque: f64) -> f64 {
        (torque + self.reduced_torque(omega) - 0.5 * self.inertia_slope * omega * omega)
            / self.inertia
    }
}

/// The drive torque for a motion, term by term (N·m). Their sum is the torque on the drive link.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TorqueTerms {
    /// J·α
    pub acceleration: f64,
    /// ½·J′·ω²
    pub velocity: f64,
    /// U′: against gravity
    pub potential: f64,
    /// Against the signed process loads
    pub process: f64,
    /// b·ω
    pub viscous: f64,
    /// c·sgn ω
    pub coulomb: f64,
}

impl TorqueTerms {
    /// The names of the terms, in the order of [`values`](Self::values).
    pub const NAMES: [&'static str; 6] = [
        "acceleration",
        "velocity",
        "potential",
        "process",
        "viscous",
        "coulomb",
    ];

    /// The terms, in the order of [`NAMES`](Self::NAMES) (N·m).
    #[must_use]
    pub const fn values(&self) -> [f64; 6] {
        [
            self.acceleration,
            self.velocity,
            self.potential,
            self.process,
            self.viscous,
            self.coulomb,
        ]
    }

    /// The drive torque (N·m).
    #[must_use]
    pub fn total(&self) -> f64 {
        self.values().iter().sum()
    }
}

/// A mechanism with gravity, loads and the inertia that turns with its drive link.
#[derive(Clone, Debug)]
pub struct Machine<M> {
    mechanism: M,
    gravity: [f64; 2],
    loads: heapless::Vec<Load, MAX_LOADS>,
    elements: heapless::Vec<Element, MAX_ELEMENTS>,
    flywheel: f64,
    frictions: heapless::Vec<JointFriction, MAX_FRICTIONS>,
}

impl<M: Mechanism> Machine<M> {
    /// The bare mechanism: no gravity, no loads.
    pub const fn new(mechanism: M) -> Self {
        Self {
            mechanism,
            gravity: [0.0, 0.0],
            loads: heapless::Vec::new(),
            elements: heapless::Vec::new(),
            flywheel: 0.0,
            frictions: heapless::Vec::new(),
        }
    }

    /// Adds gravity, as an acceleration vector (m/s²) in the mechanism's coordinates.
    ///
    /// # Errors
    /// A component that is not finite.
    pub fn with_gravity(mut self, gravity: [f64; 2]) -> Result<Self, MachineError> {
        self.gravity = [
            finite("gravity x", gravity[0])?,
            finite("gravity y", gravity[1])?,
        ];
        Ok(self)
    }

    /// Adds an inertia (kg·m²) that turns with the drive link: a flywheel, or the drive train reduced to the drive link. Repeated calls add up.
    ///
    /// # Errors
    /// An inertia negative or not finite.
    pub fn with_flywheel(mut self, inertia: f64) -> Result<Self, MachineError> {
        self.flywheel += not_negative("flywheel inertia", inertia)?;
        Ok(self)
    }

    /// Adds a load.
    ///
    /// # Errors
    /// A link that does not exist, or more than [`MAX_LOADS`] loads.
    pub fn with_load(mut self, load: Load) -> Result<Self, MachineError> {
        self.check_link(Some(load.link()))?;
        self.loads.push(load).map_err(|_| RangeError::TooMany {
            what: "loads",
            capacity: MAX_LOADS,
        })?;
        Ok(self)
    }

    /// Adds a spring or damper.
    ///
    /// # Errors
    /// A link that does not exist, or more than [`MAX_ELEMENTS`] elements.
    pub fn with_element(mut self, element: Element) -> Result<Self, MachineError> {
        for marker in element.between() {
            self.check_link(marker.body.link())?;
        }
        self.elements
            .push(element)
            .map_err(|_| RangeError::TooMany {
                what: "springs and dampers",
                capacity: MAX_ELEMENTS,
            })?;
        Ok(self)
    }

    /// Adds friction by a coefficient in a joint. It acts in [`forces`](Self::forces) and [`friction_at`](Self::friction_at); the reduced link at a
    /// position does not contain it, and tables of such a machine are refused.
    ///
    /// # Errors
    /// A joint that does not exist or is of another kind, or more than [`MAX_FRICTIONS`].
    pub fn with_friction(mut self, friction: JointFriction) -> Result<Self, MachineError>
    where
        M: Jointed,
    {
        let phi = self.mechanism.domain().position(0.0);
        let joints = self.mechanism.joints(phi, &self.mechanism.frames(phi)?)?;
        friction.check(&joints)?;
        self.frictions
            .push(friction)
            .map_err(|_| RangeError::TooMany {
                what: "joints with friction",
                capacity: MAX_FRICTIONS,
            })?;
        Ok(self)
    }

    fn check_link(&self, link: Option<usize>) -> Result<(), MachineError> {
        let links = self.mechanism.links().len();
        match link {
            Some(link) if link >= links => Err(MachineError::NoSuchLink { link, links }),
            _ => Ok(()),
        }
    }

    /// The mechanism.
    pub const fn mechanism(&self) -> &M {
        &self.mechanism
    }

    /// The loads.
    pub fn loads(&self) -> &[Load] {
        &self.loads
    }

    /// The positions (rad, or m) where the loads begin, reach their full value, begin to fall and end.
    pub fn load_edges(&self) -> impl Iterator<Item = f64> {
        let windows = self.loads.iter().filter_map(Load::window);
        windows.flat_map(|window| window.edges())
    }

    /// The springs and dampers.
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// The friction by a coefficient in its joints.
    pub fn frictions(&self) -> &[JointFriction] {
        &self.frictions
    }

    /// The same machine without friction by a coefficient.
    #[must_use]
    pub fn without_frictions(mut self) -> Self {
        self.frictions.clear();
        self
    }

    /// Refuses friction by a coefficient, which a curve over the position cannot contain.
    ///
    /// # Errors
    /// [`PoseError::NoCurve`].
    pub fn check_curves(&self) -> Result<(), PoseError> {
        match self.frictions.first() {
            Some(friction) => Err(PoseError::NoCurve {
                joint: friction.joint(),
            }),
            None => Ok(()),
        }
    }

    /// Gravity (m/s²).
    pub const fn gravity(&self) -> [f64; 2] {
        self.gravity
    }

    /// Inertia that turns with the drive link, in addition to the mechanism's own (kg·m²).
    pub const fn flywheel(&self) -> f64 {
        self.flywheel
    }

    /// Each link's share of [J, J′, J″], in the order of the mechanism's links.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn link_inertias(&self, phi: f64) -> Result<heapless::Vec<[f64; 3], MAX_LINKS>, PoseError> {
        let frames = self.mechanism.frames(phi)?;
        Ok(self.each_link(&frames).collect())
    }

    /// The reduced link at `phi` (rad), for any inertia: if only the slider has mass, it is zero at the dead centres.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn bare_reduction(&self, phi: f64) -> Result<Reduction, PoseError> {
        let frames = self.mechanism.frames(phi)?;
        let mut reduction = Reduction::new([self.flywheel, 0.0, 0.0]);
        for [inertia, slope, curvature] in self.each_link(&frames) {
            reduction.inertia += inertia;
            reduction.inertia_slope += slope;
            reduction.inertia_curvature += curvature;
        }
        for (link, frame) in self.mechanism.links().iter().zip(&frames) {
            let [energy, slope] = link.potential_energy(frame, self.gravity);
            reduction.potential_energy += energy;
            reduction.potential_slope += slope;
        }
        for load in &self.loads {
            if let Some(frame) = frames.get(load.link()) {
                let curves = load.reduce(frame, phi);
                reduction.process += curves.process;
                reduction.viscous += curves.viscous;
                reduction.coulomb += curves.coulomb;
            }
        }
        for element in &self.elements {
            let share = element.reduce(&frames).ok_or(PoseError::EndsMeet { phi })?;
            reduction.potential_energy += share.potential_energy[0];
            reduction.potential_slope += share.potential_energy[1];
            reduction.viscous += share.viscous;
        }
        Ok(reduction)
    }

    pub(super) fn each_link<'a>(
        &'a self,
        frames: &'a Frames,
    ) -> impl Iterator<Item = [f64; 3]> + 'a {
        let links = self.mechanism.links().iter();
        links
            .zip(frames)
            .map(|(link, frame)| link.reduced_inertia(frame))
    }
}
