//! Friction drives with constant ratios and slips: shafts with α_k = j_k·α₁ (III.18).

use super::{Arrangement, FrictionError, MAX_SHAFTS, Stage};
use crate::Domain;
use crate::machine::MAX_STAGES;
use crate::machine::error::PoseError;
use crate::machine::joint::{Body, Joint, Joints, Marker, Wrench};
use crate::machine::link::{Frame, Link};
use crate::machine::mechanism::{Frames, Jointed, Mechanism};
use crate::number::error::{RangeError, finite};
use crate::number::transfer::Transfer;

/// A chain or a fan of friction stages as a mechanism: its links are the shafts, shaft 1 is the drive link.
///
/// Only constant ratios and slips make the angles functions of the drive angle; for all others use [`friction::Drive`](crate::friction::Drive). The
/// contacts are ideal here: slip changes the ratio without a loss, as in (6.2), (6.4) with j. For the loss use the drive's equation with
/// [`Contact::Slipping`](crate::friction::Contact::Slipping).
///
/// Each shaft's frame is at [0, 0] with the angle ψ_k = j_k·φ: a friction drive has ratios, but no geometry.
///
/// Accuracy: 1e-13 against a gear train of the same ratios (test `constant_ratios_are_a_train`).
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionDrive {
    arrangement: Arrangement,
    /// j of each stage.
    stages: heapless::Vec<f64, MAX_STAGES>,
    shafts: heapless::Vec<Link, MAX_SHAFTS>,
}

impl FrictionDrive {
    /// Stages in order from shaft 1, and the inertia of every shaft (kg·m²), one more than stages.
    ///
    /// # Errors
    /// No stage or too many, a varying stage, a number of inertias that does not match, or an inertia that is negative or not finite.
    pub fn new(
        arrangement: Arrangement,
        stages: &[Stage],
        inertias: &[f64],
    ) -> Result<Self, FrictionError> {
        if stages.is_empty() {
            return Err(RangeError::NotPositive("number of friction stages", 0.0).into());
        }
        let mut coefficients = heapless::Vec::new();
        for (stage, given) in stages.iter().enumerate() {
            let speed = given
                .constant()
                .ok_or(FrictionError::VaryingRatio { stage })?;
            coefficients.push(speed).map_err(|_| RangeError::TooMany {
                what: "friction stages",
                capacity: MAX_STAGES,
            })?;
        }
        let expected = stages.len() + 1;
        if inertias.len() != expected {
            return Err(RangeError::OutOfRange {
                what: "number of inertias",
                value: inertias.len() as f64,
                min: expected as f64,
                max: expected as f64,
            }
            .into());
        }
        Ok(Self {
            arrangement,
            stages: coefficients,
            shafts: inertias
                .iter()
                .map(|inertia| Link::rotor(*inertia))
                .collect::<Result<_, RangeError>>()?,
        })
    }

    /// Arrangement of the stages.
    pub const fn arrangement(&self) -> Arrangement {
        self.arrangement
    }

    /// j_k = ω_k/ω₁ of every shaft.
    #[must_use]
    pub fn coefficients(&self) -> heapless::Vec<f64, MAX_SHAFTS> {
        let mut all = heapless::Vec::new();
        let _ = all.push(1.0); // one place more than stages
        for (k, speed) in self.stages.iter().enumerate() {
            let first = all.get(self.first_shaft(k)).copied().unwrap_or(1.0);
            let _ = all.push(first * speed);
        }
        all
    }

    fn first_shaft(&self, stage: usize) -> usize {
        match self.arrangement {
            Arrangement::Chain => stage,
            Arrangement::Fan => 0,
        }
    }
}

impl Jointed for FrictionDrive {
    /// The bearing of every shaft, then the contact of every stage: a moment on each shaft, and the ground takes the difference.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let bearing =
            |shaft| Joint::Revolute([Marker::ground([0.0, 0.0]), Marker::on(shaft, [0.0, 0.0])]);
        let contact = |(k, speed): (usize, &f64)| {
            let second = Wrench::moment(Body::Link(k + 1), 1.0);
            let first = Wrench::moment(Body::Link(self.first_shaft(k)), -speed);
            Joint::Transmission([first, second])
        };
        let bearings = (0..self.shafts.len()).map(bearing);
        Ok(bearings
            .chain(self.stages.iter().enumerate().map(contact))
            .collect())
    }
}

impl Mechanism for FrictionDrive {
    fn links(&self) -> &[Link] {
        &self.shafts
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("input angle", phi)?);
        let turned = |j: &f64| Frame::turning([0.0, 0.0], angle * *j);
        Ok(self.coefficients().iter().map(turned).collect())
    }
}
