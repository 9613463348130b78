//! The interface of a mechanism: links, a range of the drive link, and positions with their transfer functions.

use super::joint::Joints;
use super::link::{Frame, Link};
use crate::Domain;
use crate::machine::error::PoseError;

/// Greatest number of links of a mechanism.
pub const MAX_LINKS: usize = 16;

/// Greatest number of stages of a gear train and of a friction drive.
pub const MAX_STAGES: usize = 8;

/// The frames of all links at one angle, in the order of [`Mechanism::links`].
pub type Frames = heapless::Vec<Frame, MAX_LINKS>;

/// A planar mechanism with one degree of freedom.
///
/// Implement it for your own mechanism: the rest (reduction, tables, model) works unchanged.
pub trait Mechanism {
    /// Mass properties of the moving links.
    fn links(&self) -> &[Link];

    /// Range of the drive link.
    fn domain(&self) -> Domain;

    /// Position of every link, with transfer functions, at the drive link's angle `phi` (rad).
    ///
    /// # Errors
    /// A dead point or a position that cannot be assembled; a mechanism checked when created returns neither within its domain.
    fn frames(&self, phi: f64) -> Result<Frames, PoseError>;

    /// The `k`-th of the drive link's positions (rad, or m), in order, where its transfer functions are not smooth, such as the ends of a cam's
    /// segments: a table is compared with the machine at and between them, however close they are. The default has no such positions.
    fn edge(&self, _k: usize) -> Option<f64> {
        None
    }
}

/// A mechanism with known joints, so that the force in every joint can be calculated ([`Machine::forces`](crate::machine::Machine::forces)).
pub trait Jointed: Mechanism {
    /// The joints at the drive link's angle `phi` (rad), with the links at `frames`. Their number and order do not depend on `phi`. Together they
    /// leave the links one degree of freedom.
    ///
    /// # Errors
    /// As [`frames`](Mechanism::frames).
    fn joints(&self, phi: f64, frames: &Frames) -> Result<Joints, PoseError>;

    /// Index of the driven joint: its coordinate is φ up to a constant.
    fn drive(&self) -> usize {
        0
    }

    /// Whether the joints alone determine the forces in them at `phi` (rad, or m). At a change point a linkage's motion continues, but its guide
    /// carries forces as well. True by default.
    fn determined(&self, _phi: f64) -> bool {
        true
    }
}

impl<M: Jointed + ?Sized> Jointed for &M {
    fn joints(&self, phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        (**self).joints(phi, frames)
    }
    fn drive(&self) -> usize {
        (**self).drive()
    }
    fn determined(&self, phi: f64) -> bool {
        (**self).determined(phi)
    }
}

impl<M: Mechanism + ?Sized> Mechanism for &M {
    fn links(&self) -> &[Link] {
        (**self).links()
    }
    fn domain(&self) -> Domain {
        (**self).domain()
    }
    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        (**self).frames(phi)
    }
    fn edge(&self, k: usize) -> Option<f64> {
        (**self).edge(k)
    }
}
