//! A screw drive in closed form: ball screw, roller screw, trapezoidal screw.
//!
//! The screw turns in fixed bearings; its nut carries a carriage along x:
//!
//! ```text
//! x = h·φ/2π        J_red = J₁ + m₂·(h/2π)²        h: lead, the nut's travel a turn
//! ```
//!
//! The screw's axis lies *in* the plane, along x; its link turns by φ in the reduction's sense, like the shafts of a train. The nut does not return
//! after a turn, but J and every force of a constant load are periodic, so that the drive link's range is a turn. U grows with every turn when
//! gravity has a component along the screw. A spring on the nut is not periodic: the reduction is then right at every φ, but must not be tabulated
//! over a turn.

use crate::machine::error::PoseError;
use crate::machine::{Frames, Jointed, Mechanism};
use crate::mechanism::error::BuildError;
use core::f64::consts::TAU;

use super::dimensions::centred;
use crate::machine::joint::{Body, Joint, Joints, Marker, Wrench};
use crate::machine::link::{Frame, Link};
use crate::number::error::{finite, positive};
use crate::number::transfer::Transfer;
use crate::{Domain, math};

/// A screw drive, driven at the screw.
///
/// Links: [`SCREW`](Self::SCREW) (frame at the origin), [`NUT`](Self::NUT) (nut with carriage and load, frame on the screw's
/// axis, parallel to the global axes, at the origin for φ = 0). The drive is lossless: friction is a load on the nut.
///
/// Accuracy: 1e-13 (test `ball_screw_textbook`).
#[derive(Clone, Debug, PartialEq)]
pub struct BallScrew {
    lead: f64,
    links: [Link; 2],
}

impl BallScrew {
    /// Index of the screw.
    pub const SCREW: usize = 0;
    /// Index of the nut.
    pub const NUT: usize = 1;

    /// A screw drive with the `lead` h (m per turn; negative: φ > 0 moves the nut along −x) and the links screw, nut.
    ///
    /// # Errors
    /// A lead of zero or not finite; a screw whose centre of mass is off its axis.
    pub fn new(lead: f64, links: [Link; 2]) -> Result<Self, BuildError> {
        positive("size of the lead", math::abs(lead))?;
        centred("screw", &links[0])?;
        Ok(Self { lead, links })
    }

    /// Lead h (m per turn).
    pub const fn lead(&self) -> f64 {
        self.lead
    }

    /// h/2π: travel of the nut per angle of the screw (m/rad).
    #[must_use]
    pub fn transmission(&self) -> f64 {
        self.lead / TAU
    }
}

impl Jointed for BallScrew {
    /// Bearings: ground and screw, with the thrust as a force along x; guide: ground and nut, with its moment about the origin of the nut's frame;
    /// thread: the axial force on the nut. The guide also takes the thread's torque F·h/2π about the screw's axis, which is not in the plane of the
    /// forces.
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let origin = [0.0, 0.0];
        let on_nut = Wrench::force(Body::Link(Self::NUT), origin, [1.0, 0.0]);
        let on_screw = Wrench {
            moment: -self.transmission(),
            ..on_nut.times(-1.0).acting_on(Body::Link(Self::SCREW))
        };
        Ok(Joints::from_iter([
            Joint::Revolute([Marker::ground(origin), Marker::on(Self::SCREW, origin)]),
            Joint::Prismatic([Marker::ground(origin), Marker::on(Self::NUT, origin)]),
            Joint::Transmission([on_screw, on_nut]),
        ]))
    }
}

impl Mechanism for BallScrew {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        Domain::Turn
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let angle = Transfer::variable(finite("screw angle", phi)?);
        let nut = [angle * self.transmission(), Transfer::constant(0.0)];
        Ok(Frames::from_iter([
            Frame::turning([0.0, 0.0], angle),
            Frame::translating(nut),
        ]))
    }
}
