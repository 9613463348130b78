//! Parallel shafts: one drive shaft with several driven shafts side by side, a fan in contrast to the chain of a [`Train`](super::Train).
//!
//! ```text
//! ψ_k = φ/i_k        J_red = J₁ + Σ J_k/i_k²
//! ```
//!
//! (6.9) of Nazarenko, *Dynamics of mechanisms* (2002), with every stage on the drive shaft.

use super::dimensions::centred;
use crate::machine::error::PoseError;
use crate::machine::joint::{Body, Joint, Joints, Marker, Wrench};
use crate::machine::link::{Frame, Link};
use crate::machine::{Frames, Jointed, MAX_LINKS, Mechanism};
use crate::mechanism::error::BuildError;
use crate::number::error::RangeError;
use crate::number::error::{finite, positive};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// A driven shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivenShaft {
    /// Signed ratio i = ω_drive/ω_driven, not zero; negative if it turns against the drive shaft, as with a pair of external gears.
    pub ratio: f64,
    /// The shaft with everything that turns with it, balanced.
    pub link: Link,
}

/// A drive shaft with driven shafts: a line shaft, the rollers of a table, a timing belt round several pulleys.
///
/// Links: [`DRIVE`](Self::DRIVE), then the driven shafts in the given order, from 1 on; every frame at the origin, because the shafts have ratios,
/// but no positions. A driven shaft turns by 2π/i per turn of the drive shaft, and must be balanced.
///
/// Accuracy: 1e-13 (test `fan_textbook`).
#[derive(Clone, Debug, PartialEq)]
pub struct ParallelShafts {
    ratios: heapless::Vec<f64, { Self::MAX_DRIVEN }>,
    links: heapless::Vec<Link, MAX_LINKS>,
}

impl ParallelShafts {
    /// Index of the drive shaft.
    pub const DRIVE: usize = 0;
    /// Greatest number of driven shafts.
    pub const MAX_DRIVEN: usize = MAX_LINKS - 1;

    /// A `drive` shaft with `driven` shafts.
    ///
    /// # Errors
    /// A ratio of zero or not finite; a driven shaft whose centre of mass is off its axis; no driven shaft, or more than
    /// [`MAX_DRIVEN`](Self::MAX_DRIVEN).
    pub fn new(drive: Link, driven: &[DrivenShaft]) -> Result<Self, BuildError> {
        positive("number of driven shafts", driven.len() as f64)?;
        let mut shafts = Self {
            ratios: heapless::Vec::new(),
            links: heapless::Vec::from_iter([drive]),
        };
        for DrivenShaft { ratio, link } in driven {
            positive("size of the ratio", math::abs(*ratio))?;
            centred("driven shaft", link)?;
            shafts
                .ratios
                .push(*ratio)
                .map_err(|_| RangeError::TooMany {
                    what: "driven shafts",
                    capacity: Self::MAX_DRIVEN,
                })?;
            // Cannot fail: the capacity is one more than the number of ratios.
            let _ = shafts.links.push(*link);
        }
        Ok(shafts)
    }

    /// The signed ratios i = ω_drive/ω_driven.
    pub fn ratios(&self) -> &[f64] {
        &self.ratios
    }
}

impl Jointed for ParallelShafts {
    /// The bearing of every shaft, then the transmission to every driven shaft: a moment on each; the ground takes the difference.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let bearing =
            |shaft| Joint::Revolute([Marker::ground([0.0, 0.0]), Marker::on(shaft, [0.0, 0.0])]);
        let transmission = |(k, ratio): (usize, &f64)| {
            Joint::Transmission([
                Wrench::moment(Body::Link(Self::DRIVE), -1.0 / ratio),
                Wrench::moment(Body::Link(k + 1), 1.0),
            ])
        };
        let bearings = (0..self.links.len()).map(bearing);
        Ok(bearings
            .chain(self.ratios.iter().enumerate().map(transmission))
            .collect())
    }
}

impl Mechanism for ParallelShafts {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("drive shaft angle", phi)?);
        let turning = |angle| Frame::turning([0.0, 0.0], angle);
        let driven = self
            .ratios
            .iter()
            .map(|ratio| turning(angle * (1.0 / ratio)));
        Ok(core::iter::once(turning(angle)).chain(driven).collect())
    }
}
