//! Rack and pinion in closed form.
//!
//! Pinion axis O = (0, 0), pitch radius r; the rack's pitch line is y = −r, and the rack slides along x:
//!
//! ```text
//! x = r·φ        J_red = J₁ + m₂·r²        U′ = −m₂·g_x·r, the pinion balanced
//! ```
//!
//! The rack does not return after a turn, but J, J′ and every force of a constant or position-independent load are periodic, so that the drive link's
//! range is a turn. U grows with every turn when gravity has a component along the rack. A spring on the rack is not periodic: the reduction is then
//! right at every φ, but must not be tabulated over a turn.

use crate::machine::error::PoseError;
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use core::f64::consts::TAU;

use crate::Domain;
use crate::machine::joint::{Body, Joint, Joints, Marker};
use crate::machine::link::{Frame, Link};
use crate::number::error::{finite, positive};
use crate::number::transfer::Transfer;

/// A rack driven by a pinion.
///
/// Links: [`PINION`](Self::PINION) (frame at O, u along +x at φ = 0), [`RACK`](Self::RACK) (frame on the pitch line, parallel to the global axes,
/// below O at φ = 0). φ > 0 moves the rack along +x. A carriage with the pinion, on a fixed rack, has the same equation: assign its mass to the rack.
///
/// Accuracy: 1e-13 (test `rack_textbook`).
#[derive(Clone, Debug, PartialEq)]
pub struct RackAndPinion {
    radius: f64,
    links: [Link; 2],
}

impl RackAndPinion {
    /// Index of the pinion.
    pub const PINION: usize = 0;
    /// Index of the rack.
    pub const RACK: usize = 1;

    /// A rack and pinion with the pinion's pitch `radius` r (m) and the links pinion, rack.
    ///
    /// # Errors
    /// A radius that is not positive.
    pub fn new(radius: f64, links: [Link; 2]) -> Result<Self, BuildError> {
        Ok(Self {
            radius: positive("pitch radius", radius)?,
            links,
        })
    }

    /// Pitch radius r (m).
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// Travel of the rack per turn of the pinion, 2π·r (m).
    #[must_use]
    pub fn travel(&self) -> f64 {
        TAU * self.radius
    }
}

impl Jointed for RackAndPinion {
    /// O: ground and pinion; guide: ground and rack, with its moment about the origin of the rack's frame; mesh: the tangential tooth force on the
    /// rack, at the pitch point. The pressure angle adds a force across the rack, which pushes it away from the pinion for both directions of the
    /// load; it does no work, and is left to the design of the bearings.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let pitch_point = [0.0, -self.radius];
        let bodies = [Body::Link(Self::PINION), Body::Link(Self::RACK)];
        Ok(Joints::from_iter([
            Joint::Revolute([
                Marker::ground([0.0, 0.0]),
                Marker::on(Self::PINION, [0.0, 0.0]),
            ]),
            Joint::Prismatic([
                Marker::ground(pitch_point),
                Marker::on(Self::RACK, [0.0, 0.0]),
            ]),
            Joint::contact(bodies, pitch_point, [1.0, 0.0]),
        ]))
    }
}

impl Mechanism for RackAndPinion {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("pinion angle", phi)?);
        let rack = [angle * self.radius, Transfer::constant(-self.radius)];
        Ok(Frames::from_iter([
            Frame::turning([0.0, 0.0], angle),
            Frame::translating(rack),
        ]))
    }
}
