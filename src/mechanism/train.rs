//! Gear trains and belt drives: shafts coupled by constant ratios.

use super::{Frames, Mechanism};
use crate::error::{not_negative, positive};
use crate::link::{Frame, Link};
use crate::transfer::Transfer;
use crate::{Domain, Error};

/// How two gears mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Mesh {
    /// Two external gears: the direction reverses.
    #[default]
    External,
    /// A gear in a ring gear: the direction stays.
    Internal,
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
    /// A gear pair with numbers of teeth `[driver, driven]` and inertias of the two wheels (kg·m²), lossless.
    ///
    /// # Errors
    /// No teeth, or an inertia negative or not finite.
    pub fn gears(teeth: [u32; 2], inertia: [f64; 2], mesh: Mesh) -> Result<Self, Error> {
        let driver = positive("teeth of the driver", f64::from(teeth[0]))?;
        let driven = positive("teeth of the driven gear", f64::from(teeth[1]))?;
        let sign = match mesh {
            Mesh::External => -1.0,
            Mesh::Internal => 1.0,
        };
        Self::new(sign * driven / driver, inertia)
    }

    /// An open belt without slip over pulleys of `radius` `[driver, driven]` (m) and `inertia` (kg·m²), with the
    /// belt's `mass` (kg), lossless. The notes' (5.9)-(5.16) give the belt's weight P: mass = P/g.
    ///
    /// # Errors
    /// A radius not positive, or an inertia or the mass negative or not finite.
    pub fn belt(radius: [f64; 2], inertia: [f64; 2], mass: f64) -> Result<Self, Error> {
        let driver = positive("radius of the driver pulley", radius[0])?;
        let driven = positive("radius of the driven pulley", radius[1])?;
        let belt = not_negative("mass of the belt", mass)? * driver * driver;
        Self::new(driven / driver, [inertia[0] + belt, inertia[1]])
    }

    /// A stage with the signed ratio i = ω_driver/ω_driven and the inertias on its two sides (kg·m²), lossless.
    ///
    /// # Errors
    /// A ratio of zero, an inertia negative, or anything not finite.
    pub fn new(ratio: f64, inertia: [f64; 2]) -> Result<Self, Error> {
        positive("ratio", crate::math::abs(ratio))?;
        Ok(Self {
            ratio,
            driver: not_negative("inertia of the driver", inertia[0])?,
            driven: not_negative("inertia of the driven side", inertia[1])?,
            efficiency: 1.0,
        })
    }

    /// The same stage with an efficiency η in (0, 1], valid in both directions of power.
    ///
    /// # Errors
    /// An efficiency outside (0, 1].
    pub fn with_efficiency(self, efficiency: f64) -> Result<Self, Error> {
        if positive("efficiency", efficiency)? > 1.0 {
            return Err(Error::OutOfRange {
                what: "efficiency",
                value: efficiency,
                min: 0.0,
                max: 1.0,
            });
        }
        Ok(Self { efficiency, ..self })
    }

    /// Signed ratio i = ω_driver/ω_driven.
    pub const fn ratio(&self) -> f64 {
        self.ratio
    }

    /// Efficiency η.
    pub const fn efficiency(&self) -> f64 {
        self.efficiency
    }
}

/// A chain of stages, from the drive link (shaft 0) to the output shaft. An empty train is a direct coupling.
///
/// As a [`Mechanism`] its links are the shafts and its reduced inertia is (6.9),
/// J_red = J₁ + (J₂ + J₃)/i₁₂² + J₄/i₁₄²; a belt gives (5.16). Losses do not belong to the reduction: they are
/// applied by [`input_torque`](Self::input_torque), where the direction of power is known.
///
/// Accuracy: 1e-12 against exact rationals (tests `gear_train_golden`, `belt_drive_golden`).
#[derive(Clone, Debug, PartialEq)]
pub struct Train {
    stages: heapless::Vec<Stage, { Self::MAX_STAGES }>,
    shafts: heapless::Vec<Link, { Self::MAX_STAGES + 1 }>,
}

impl Train {
    /// The most stages of a train.
    pub const MAX_STAGES: usize = 8;

    /// A train of the given stages, in order from the drive link.
    ///
    /// # Errors
    /// More than [`MAX_STAGES`](Self::MAX_STAGES) stages.
    pub fn new(stages: &[Stage]) -> Result<Self, Error> {
        let stages =
            heapless::Vec::<Stage, { Self::MAX_STAGES }>::from_slice(stages).map_err(|_| {
                Error::TooMany {
                    what: "stages",
                    capacity: Self::MAX_STAGES,
                }
            })?;
        let mut shafts = heapless::Vec::new();
        let mut behind = 0.0; // the driven side of the stage before turns with this shaft
        for stage in &stages {
            // Cannot fail: one shaft a stage, and one place more than stages.
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

    /// Torque at the input (N·m) for `torque` (N·m) delivered at the output shaft, which moves with `omega` (rad/s)
    /// and `alpha` (rad/s²): shaft by shaft, T_in = T_out/(i·η) where power flows to the output and T_out·η/i
    /// where it flows back.
    #[must_use]
    pub fn input_torque(&self, torque: f64, omega: f64, alpha: f64) -> f64 {
        let (mut torque, mut omega, mut alpha) = (torque, omega, alpha);
        for stage in self.stages.iter().rev() {
            torque += stage.driven * alpha;
            let loss = if torque * omega < 0.0 {
                stage.efficiency
            } else {
                1.0 / stage.efficiency
            };
            omega *= stage.ratio;
            alpha *= stage.ratio;
            torque = torque / stage.ratio * loss + stage.driver * alpha;
        }
        torque
    }
}

impl Mechanism for Train {
    fn links(&self) -> &[Link] {
        &self.shafts
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, Error> {
        let input = Transfer::variable(crate::error::finite("input angle", phi)?);
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
