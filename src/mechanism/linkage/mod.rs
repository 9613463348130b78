//! Linkages: planar mechanisms of any topology, by continuation along φ.
//!
//! Every link has the coordinates x, y, ψ; every pair adds its constraint equations f(q, φ) = 0, (76), the drive one more.
//! From an approximate drawing Newton's method finds the first position. From there the linkage is followed along φ (79):
//! a predictor from the transfer functions, Newton's method as corrector, the step halved until it converges on the same
//! branch. The transfer functions come from the differentiated constraints (77), (78), never from differences.
//!
//! Kinematics chapter (equations (73)-(84)) of the lecture notes on planar mechanisms; the equations are solved group by
//! group, the groups of L. V. Assur.

mod pair;
mod solver;
mod structure;
mod walk;

pub use pair::Pair;
pub use walk::Assembly;

use crate::error::finite;
use crate::joint::Joint;
use crate::link::{Frame, Link};
use crate::transfer::Transfer;
use crate::{Error, math};

use structure::Structure;

/// Where a link is: origin of its frame (m) and angle (rad).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pose {
    /// x (m).
    pub x: f64,
    /// y (m).
    pub y: f64,
    /// ψ (rad).
    pub psi: f64,
}

impl Pose {
    /// A link that stands there.
    #[must_use]
    pub fn frame(&self) -> Frame {
        Frame::turned(
            [self.x, self.y].map(Transfer::constant),
            Transfer::constant(self.psi),
        )
    }
}

/// Links and the pairs that hold them together, with the drive in one of them: the topology, checked. At most `LINKS` ≤ 16
/// links and `PAIRS` pairs.
///
/// [`assemble`](Self::assemble) makes a [`Mechanism`](crate::Mechanism) of it.
#[derive(Clone, Debug)]
pub struct Linkage<const LINKS: usize, const PAIRS: usize> {
    links: heapless::Vec<Link, LINKS>,
    pairs: heapless::Vec<Pair, PAIRS>,
    drive: usize,
    structure: Structure<LINKS>,
    /// Largest distance in a link or between markers of the ground (m): what lengths are measured by.
    size: f64,
}

impl<const LINKS: usize, const PAIRS: usize> Linkage<LINKS, PAIRS> {
    /// A linkage of `links`, held by `pairs` and driven in pair number `drive`, a pin or a guide, whose free coordinate is
    /// φ: the angle (rad) or way (m) of its second marker against its first.
    ///
    /// # Errors
    /// Too many links or pairs; a number that is not finite; a pair on a link that does not exist; a drive that is no pin
    /// or guide; more or fewer than one degree of freedom, 3·n − Σ constraints ≠ 1; a link left free while others are held
    /// twice.
    pub fn new(links: &[Link], pairs: &[Pair], drive: usize) -> Result<Self, Error> {
        const { assert!(LINKS <= super::MAX_LINKS && PAIRS <= crate::joint::MAX_JOINTS) }
        let too_many = |what, capacity| Error::TooMany { what, capacity };
        let links = heapless::Vec::from_slice(links).map_err(|_| too_many("links", LINKS))?;
        let pairs: heapless::Vec<Pair, PAIRS> =
            heapless::Vec::from_slice(pairs).map_err(|_| too_many("joints", PAIRS))?;
        let mut size = 0.0_f64;
        for pair in &pairs {
            pair.check()?;
            for body in pair.bodies() {
                if let Some(link) = body.link().filter(|link| *link >= links.len()) {
                    return Err(Error::NoSuchLink {
                        link,
                        links: links.len(),
                    });
                }
            }
            for marker in pair.markers() {
                size = marker
                    .at
                    .iter()
                    .fold(size, |most, c| most.max(math::abs(*c)));
            }
        }
        let Some(driven) = pairs.get(drive) else {
            return Err(Error::NoSuchJoint {
                joint: drive,
                joints: pairs.len(),
            });
        };
        if !matches!(
            driven,
            Pair::Joint(Joint::Revolute(_) | Joint::Prismatic(_))
        ) {
            return Err(Error::NotADrive { joint: drive });
        }
        let phi = Transfer::constant(0.4);
        let evaluate =
            |equation, frames: &[Frame]| solver::evaluate(&pairs, equation, frames, phi).d1;
        let structure = Structure::new(links.len(), &pairs, evaluate, drive)?;
        Ok(Self {
            links,
            pairs,
            drive,
            structure,
            size: if size > 0.0 { size } else { 1.0 },
        })
    }

    /// The links.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// The same linkage with other masses: a new payload. The geometry stays.
    ///
    /// # Errors
    /// A link that does not exist.
    pub fn set_link(&mut self, index: usize, link: Link) -> Result<(), Error> {
        let links = self.links.len();
        let slot = self.links.get_mut(index);
        *slot.ok_or(Error::NoSuchLink { link: index, links })? = link;
        Ok(())
    }

    /// The pairs.
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// Sizes of the groups of coordinates that are solved together, in the order of solving.
    pub fn group_sizes(&self) -> impl Iterator<Item = usize> + '_ {
        self.structure.groups().map(|group| group.size.into())
    }

    /// Checks an approximate drawing: one pose a link.
    fn drawing(&self, drawing: &[Pose]) -> Result<[Frame; LINKS], Error> {
        if drawing.len() != self.links.len() {
            return Err(Error::BufferTooShort {
                needed: self.links.len(),
                given: drawing.len(),
            });
        }
        let mut frames = [Frame::GROUND; LINKS];
        for (frame, pose) in frames.iter_mut().zip(drawing) {
            finite("x in the drawing", pose.x)?;
            finite("y in the drawing", pose.y)?;
            finite("angle in the drawing", pose.psi)?;
            *frame = pose.frame();
        }
        Ok(frames)
    }
}
