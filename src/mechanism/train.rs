//! Gear trains and belt drives: shafts coupled by constant ratios.

use crate::Domain;
use crate::machine::error::PoseError;
use crate::machine::joint::{Body, Joint, Joints, Marker, Wrench};
use crate::machine::link::{Frame, Link};
use crate::machine::{Frames, Jointed, MAX_STAGES, Mechanism};
use crate::mechanism::error::BuildError;
use crate::number::error::RangeError;
use crate::number::error::{not_negative, positive};
use crate::number::transfer::Transfer;

/// Kind of mesh of two gears.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Mesh {
    /// Two external gears: the direction reverses.
    #[default]
    External,
    /// A gear in a ring gear: the direction stays.
    Internal,
}

/// Dimensions of a gear pair, the driver's first.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct GearDimensions {
    /// Numbers of teeth.
    pub teeth: [u32; 2],
    /// Inertias of the wheels (kg·m²).
    pub inertias: [f64; 2],
    /// Kind of mesh.
    pub mesh: Mesh,
}

/// Dimensions of an open belt over two pulleys, the driver's first.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BeltDimensions {
    /// Radii of the pulleys (m).
    pub radii: [f64; 2],
    /// Inertias of the pulleys (kg·m²).
    pub inertias: [f64; 2],
    /// Mass of the belt (kg); the notes' (5.9)-(5.16) give its weight P: mass = P/g.
    pub mass: f64,
}

/// One stage: two shafts, coupled by a gear pair or a belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    ratio: f64,
    driver: f64,
    driven: f64,
    efficiency: f64,
}

impl Stage {
    /// A lossless gear pair.
    ///
    /// # Errors
    /// Zero teeth, or an inertia negative or not finite.
    pub fn gears(dimensions: GearDimensions) -> Result<Self, RangeError> {
        let [driver, driven] = dimensions.teeth.map(f64::from);
        let driver = positive("teeth of the driver", driver)?;
        let driven = positive("teeth of the driven gear", driven)?;
        let sign = match dimensions.mesh {
            Mesh::External => -1.0,
            Mesh::Internal => 1.0,
        };
        Self::new(sign * driven / driver, dimensions.inertias)
    }

    /// A lossless open belt without slip.
    ///
    /// # Errors
    /// A radius not positive, or an inertia or the mass negative or not finite.
    pub fn belt(dimensions: BeltDimensions) -> Result<Self, RangeError> {
        let [driver, driven] = dimensions.radii;
        let driver = positive("radius of the driver pulley", driver)?;
        let driven = positive("radius of the driven pulley", driven)?;
        let [pulley, behind] = dimensions.inertias;
        let pulley = not_negative("inertia of the driver", pulley)?;
        let belt = not_negative("mass of the belt", dimensions.mass)? * driver * driver;
        Self::new(driven / driver, [pulley + belt, behind])
    }

    /// A lossless stage with the signed ratio i = ω_driver/ω_driven and the inertias on its two sides (kg·m²).
    ///
    /// # Errors
    /// A ratio of zero, a negative inertia, or a value not finite.
    pub fn new(ratio: f64, inertia: [f64; 2]) -> Result<Self, RangeError> {
        positive("ratio", crate::math::abs(ratio))?;
        Ok(Self {
            ratio,
            driver: not_negative("inertia of the driver", inertia[0])?,
            driven: not_negative("inertia of the driven side", inertia[1])?,
            efficiency: 1.0,
        })
    }

    /// The same stage with an efficiency η in (0, 1], for both directions of power.
    ///
    /// # Errors
    /// An efficiency outside (0, 1].
    pub fn with_efficiency(self, efficiency: f64) -> Result<Self, RangeError> {
        if positive("efficiency", efficiency)? > 1.0 {
            return Err(RangeError::OutOfRange {
                what: "efficiency",
                value: efficiency,
                min: 0.0,
                max: 1.0,
            });
        }
        Ok(Self { efficiency, ..self })
    }

    /// The same stage with an additional inertia on its driver's side (kg·m²), such as a flywheel.
    ///
    /// # Errors
    /// An inertia negative or not finite.
    pub fn with_flywheel(self, inertia: f64) -> Result<Self, RangeError> {
        let driver = self.driver + not_negative("inertia of the flywheel", inertia)?;
        Ok(Self { driver, ..self })
    }

    /// Signed ratio i = ω_driver/ω_driven.
    pub const fn ratio(&self) -> f64 {
        self.ratio
    }

    /// Efficiency η.
    pub const fn efficiency(&self) -> f64 {
        self.efficiency
    }

    /// Inertias of the driver's and of the driven side (kg·m²).
    pub const fn inertias(&self) -> [f64; 2] {
        [self.driver, self.driven]
    }
}

/// A chain of stages, from the drive link (shaft 0) to the output shaft. An empty train is a direct coupling.
///
/// As a [`Mechanism`] its links are the shafts and its reduced inertia is (6.9), J_red = J₁ + (J₂ + J₃)/i₁₂² + J₄/i₁₄²; a belt gives (5.16). Losses
/// are not part of the reduction: [`input`](Self::input) applies them, where the direction of power is known.
///
/// Accuracy: 1e-12 against exact rationals (tests `gear_train_golden`, `belt_drive_golden`).
#[derive(Clone, Debug, PartialEq)]
pub struct Train {
    stages: heapless::Vec<Stage, MAX_STAGES>,
    shafts: heapless::Vec<Link, { MAX_STAGES + 1 }>,
}

impl Train {
    /// A train of the given stages, in order from the drive link.
    ///
    /// # Errors
    /// More than [`MAX_STAGES`] stages.
    pub fn new(stages: &[Stage]) -> Result<Self, BuildError> {
        let stages = heapless::Vec::<Stage, MAX_STAGES>::from_slice(stages).map_err(|_| {
            RangeError::TooMany {
                what: "stages",
                capacity: MAX_STAGES,
            }
        })?;
        let mut shafts = heapless::Vec::new();
        let mut behind = 0.0; // the driven side of the previous stage turns with this shaft
        for stage in &stages {
            // Cannot fail: one shaft per stage, and the capacity is one more than the number of stages.
            let _ = shafts.push(Link::rotor(behind + stage.driver)?);
            behind = stage.driven;
        }
        let _ = shafts.push(Link::rotor(behind)?);
        Ok(Self { stages, shafts })
    }

    /// The stages, in order from the drive link.
    pub fn stages(&self) -> &[Stage] {
        &self.stages
    }

    /// Signed total ratio i = ω_input/ω_output.
    pub fn ratio(&self) -> f64 {
        self.stages.iter().map(Stage::ratio).product()
    }

    /// Product of the stages' efficiencies.
    pub fn efficiency(&self) -> f64 {
        self.stages.iter().map(Stage::efficiency).product()
    }

    /// Inertia of all shafts reduced to the input shaft (kg·m²), (6.9).
    pub fn inertia_at_input(&self) -> f64 {
        let mut ratio = 1.0;
        let mut sum = 0.0;
        for (k, shaft) in self.shafts.iter().enumerate() {
            sum += shaft.inertia() / (ratio * ratio);
            ratio *= self.stages.get(k).map_or(1.0, Stage::ratio);
        }
        sum
    }

    /// The torque of the input shaft for the output shaft's torque and motion.
    ///
    /// Shaft by shaft: T_in = T_out/(i·η) where power flows to the output and T_out·η/i where it flows back, by the
    /// [direction](TrainOutput::direction) of the motion; without a direction the first. The result contains the derivative of the input torque with
    /// respect to α, so that forward dynamics through the losses takes one Newton step.
    #[must_use]
    pub fn input(&self, output: &TrainOutput) -> TrainInput {
        self.input_by_stages(output, |_, _| ())
    }

    /// The same; `seen` receives each stage with its torque on the next shaft (N·m), from the output back.
    pub fn input_by_stages(
        &self,
        output: &TrainOutput,
        mut seen: impl FnMut(&Stage, f64),
    ) -> TrainInput {
        let mut input = TrainInput {
            torque: output.torque,
            torque_per_alpha: output.torque_per_alpha,
            loss: 0.0,
        };
        let (mut omega, mut alpha, mut ratio) = (output.omega, output.alpha, 1.0);
        let mut direction = output.direction;
        for stage in self.stages.iter().rev() {
            let delivered = input.torque + stage.driven * alpha;
            seen(stage, delivered);
            let loss = if delivered * direction < 0.0 {
                stage.efficiency
            } else {
                1.0 / stage.efficiency
            };
            let slope = input.torque_per_alpha + stage.driven * ratio;
            input.loss += delivered * omega * (loss - 1.0);
            omega *= stage.ratio;
            direction *= stage.ratio;
            alpha *= stage.ratio;
            ratio *= stage.ratio;
            input.torque = delivered / stage.ratio * loss + stage.driver * alpha;
            input.torque_per_alpha = slope / stage.ratio * loss + stage.driver * ratio;
        }
        input
    }
}

/// Torque and motion of the output shaft of a drive train.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrainOutput {
    /// Torque (N·m).
    pub torque: f64,
    /// Derivative of the torque with respect to α (kg·m²); 0 if [`TrainInput::torque_per_alpha`] is not used.
    pub torque_per_alpha: f64,
    /// Speed (rad/s).
    pub omega: f64,
    /// Acceleration (rad/s²).
    pub alpha: f64,
    /// Its sign decides the direction of power: ω itself, or at rest the direction in which the shaft starts. 0: it stays at rest, with the losses of
    /// driving.
    pub direction: f64,
}

/// Torque and losses at the input shaft of a drive train.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct TrainInput {
    /// Torque (N·m).
    pub torque: f64,
    /// Its derivative with respect to the acceleration of the *output* shaft (kg·m²).
    pub torque_per_alpha: f64,
    /// Power lost in the stages (W).
    pub loss: f64,
}

impl Jointed for Train {
    /// The bearing of every shaft, then the mesh or belt of every stage. A train has ratios, but no geometry: a mesh transmits a moment on each
    /// shaft, and the ground takes the difference.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let bearing =
            |shaft| Joint::Revolute([Marker::ground([0.0, 0.0]), Marker::on(shaft, [0.0, 0.0])]);
        let mesh = |(k, stage): (usize, &Stage)| {
            let driven = Wrench::moment(Body::Link(k + 1), 1.0);
            let driver = Wrench::moment(Body::Link(k), -1.0 / stage.ratio);
            Joint::Transmission([driver, driven])
        };
        let bearings = (0..self.shafts.len()).map(bearing);
        Ok(bearings
            .chain(self.stages.iter().enumerate().map(mesh))
            .collect())
    }
}

impl Mechanism for Train {
    fn links(&self) -> &[Link] {
        &self.shafts
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let input = Transfer::variable(crate::number::error::finite("input angle", phi)?);
        let mut frames = Frames::new();
        let mut ratio = 1.0;
        for k in 0..self.shafts.len() {
            // Cannot fail: a train has fewer shafts than `MAX_LINKS`.
            let _ = frames.push(Frame::turning([0.0, 0.0], input * (1.0 / ratio)));
            ratio *= self.stages.get(k).map_or(1.0, Stage::ratio);
        }
        Ok(frames)
    }
}
