//! Linkages: planar mechanisms of any topology, by continuation along φ.
//!
//! Every link has the coordinates x, y, ψ; every pair adds its constraint equations f(q, φ) = 0, (76), the drive one more. From an approximate
//! drawing Newton's method finds the first position. From there the linkage is followed along φ (79): a predictor from the transfer functions,
//! Newton's method as corrector, the step halved until it converges on the same branch. The transfer functions come from the differentiated
//! constraints (77), (78), not from differences.
//!
//! Kinematics chapter (equations (73)-(84)) of the lecture notes on planar mechanisms; the equations are solved group by
//! group, the groups of L. V. Assur.

mod assembly;
mod cam;
mod crossing;
mod error;
mod pair;
mod solver;
mod structure;
mod walk;

pub use assembly::Assembly;
pub use cam::PlacedCam;
pub use error::LinkageError;
pub use pair::Pair;

use crate::machine::error::MachineError;
use crate::machine::joint::{Body, Joint, MAX_JOINTS};
use crate::machine::link::{Frame, Link};
use crate::machine::mechanism::{Frames, MAX_LINKS};
use crate::math;
use crate::number::error::RangeError;
use crate::number::error::finite;
use crate::number::transfer::Transfer;

use cam::Cams;
use structure::{Equation, Structure};

/// s′ of a cam for the analysis of the structure, where any value except 0 and ±1 works.
const SLOPE: f64 = 0.618_033_988_749_895;

/// Position of a link: origin of its frame (m) and angle (rad).
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
    /// The frame of a link in this pose, at rest.
    #[must_use]
    pub fn frame(&self) -> Frame {
        Frame::turned(
            [self.x, self.y].map(Transfer::constant),
            Transfer::constant(self.psi),
        )
    }
}

/// Links and the pairs that connect them, one of them driven: the checked topology. At most `LINKS` ≤ 16 links, `PAIRS` pairs and `CAMS` cams.
///
/// [`assemble`](Self::assemble) turns it into a [`Mechanism`](crate::machine::Mechanism).
#[derive(Clone, Debug)]
pub struct Linkage<const LINKS: usize, const PAIRS: usize, const CAMS: usize = 0> {
    links: heapless::Vec<Link, LINKS>,
    pairs: heapless::Vec<Pair, PAIRS>,
    cams: Cams<CAMS>,
    drive: usize,
    structure: Structure<LINKS>,
    /// Largest distance in a link or between markers of the ground (m): the scale of lengths.
    size: f64,
}

impl<const LINKS: usize, const PAIRS: usize> Linkage<LINKS, PAIRS> {
    /// A linkage of `links`, connected by `pairs` and driven in pair number `drive`, a pin or a guide, whose free coordinate is φ: the angle (rad) or
    /// displacement (m) of its second marker against its first.
    ///
    /// # Errors
    /// Too many links or pairs; a number that is not finite; a pair on a link that does not exist; a drive that is neither pin nor guide; more or
    /// fewer than one degree of freedom, 3·n − Σ constraints ≠ 1; a link left free while others are constrained twice.
    pub fn new(links: &[Link], pairs: &[Pair], drive: usize) -> Result<Self, LinkageError> {
        Self::with_cams(links, pairs, &[], drive)
    }
}

impl<const LINKS: usize, const PAIRS: usize, const CAMS: usize> Linkage<LINKS, PAIRS, CAMS> {
    /// A linkage with cams, for [`Pair::Cam`]; otherwise as [`new`](Linkage::new).
    ///
    /// A cam's bearings are separate pairs: the cam turns about the point of its base, and the follower is guided as in its
    /// [`CamProfile`](super::CamProfile), relative to that point. The force of the pair acts along the common normal at the point of contact; a
    /// negative force (see [`contact_force`](crate::mechanism::cam::contact_force)) would need a groove.
    ///
    /// # Errors
    /// As [`new`](Linkage::new); too many cams; a pair of a cam that does not exist, or a cam with its base on the cam or the follower.
    pub fn with_cams(
        links: &[Link],
        pairs: &[Pair],
        cams: &[PlacedCam],
        drive: usize,
    ) -> Result<Self, LinkageError> {
        const { assert!(LINKS <= MAX_LINKS && PAIRS <= MAX_JOINTS) }
        let too_many = |what, capacity| RangeError::TooMany { what, capacity };
        let links = heapless::Vec::from_slice(links).map_err(|_| too_many("links", LINKS))?;
        let pairs: heapless::Vec<Pair, PAIRS> =
            heapless::Vec::from_slice(pairs).map_err(|_| too_many("joints", PAIRS))?;
        let cams = Cams::from_slice(cams).map_err(|_| too_many("cams", CAMS))?;
        let mut size = largest_distance(&pairs);
        let exists = |body: Body| match body.link().filter(|link| *link >= links.len()) {
            None => Ok(()),
            Some(link) => Err(MachineError::NoSuchLink {
                link,
                links: links.len(),
            }),
        };
        for cam in &cams {
            cam.base().check()?;
            exists(cam.base().body)?;
            size = size.max(cam.profile().base_radius());
        }
        for pair in &pairs {
            pair.check()?;
            pair.bodies().into_iter().try_for_each(exists)?;
            if let Pair::Cam { place, .. } = *pair {
                let cam = cams.get(place).ok_or(LinkageError::NoSuchCam {
                    cam: place,
                    cams: cams.len(),
                })?;
                if pair.bodies().contains(&cam.base().body) {
                    return Err(LinkageError::CamBase { cam: place });
                }
            }
        }
        let Some(driven) = pairs.get(drive) else {
            return Err(MachineError::NoSuchJoint {
                joint: drive,
                joints: pairs.len(),
            }
            .into());
        };
        if !matches!(
            driven,
            Pair::Joint(Joint::Revolute(_) | Joint::Prismatic(_))
        ) {
            return Err(LinkageError::NotADrive { joint: drive });
        }
        let phi = Transfer::constant(0.4);
        let evaluate = |equation: Equation, frames: &[Frame]| {
            if let Some(Pair::Cam {
                cam,
                follower,
                place,
            }) = pairs.get(usize::from(equation.pair))
                && let Some(placed) = cams.get(*place)
            {
                // A dwell would hide the follower's dependence on the cam.
                let sloped = |theta: Transfer| theta * SLOPE;
                return placed.equation([cam, follower], frames, sloped).d1;
            }
            solver::evaluate(&pairs, &cams, equation, frames, phi).d1
        };
        let structure = Structure::new(links.len(), &pairs, evaluate, drive)?;
        Ok(Self {
            links,
            pairs,
            cams,
            drive,
            structure,
            size: if size > 0.0 { size } else { 1.0 },
        })
    }

    /// The links.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// Sets another mass of a link: a new payload. The geometry stays the same.
    ///
    /// # Errors
    /// A link that does not exist.
    pub fn set_link(&mut self, index: usize, link: Link) -> Result<(), LinkageError> {
        let links = self.links.len();
        let slot = self.links.get_mut(index);
        *slot.ok_or(MachineError::NoSuchLink { link: index, links })? = link;
        Ok(())
    }

    /// The pairs.
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// The cams.
    pub fn cams(&self) -> &[PlacedCam] {
        &self.cams
    }

    /// Sizes of the groups of coordinates that are solved together, in the order of solving.
    pub fn group_sizes(&self) -> impl Iterator<Item = usize> + '_ {
        self.structure.groups().map(|group| group.size.into())
    }

    /// Checks an approximate drawing: one pose per link.
    fn drawing(&self, drawing: &[Pose]) -> Result<Frames, LinkageError> {
        if drawing.len() != self.links.len() {
            return Err(RangeError::BufferTooShort {
                needed: self.links.len(),
                given: drawing.len(),
            }
            .into());
        }
        for pose in drawing {
            finite("x in the drawing", pose.x)?;
            finite("y in the drawing", pose.y)?;
            finite("angle in the drawing", pose.psi)?;
        }
        Ok(drawing.iter().map(Pose::frame).collect())
    }
}

/// Largest distance between two markers of the same body, including the ground (m).
fn largest_distance(pairs: &[Pair]) -> f64 {
    let markers = || pairs.iter().flat_map(Pair::markers);
    let mut largest = 0.0_f64;
    for a in markers() {
        for b in markers().filter(|b| b.body == a.body) {
            let [x, y] = [b.at[0] - a.at[0], b.at[1] - a.at[1]];
            largest = largest.max(math::sqrt(x * x + y * y));
        }
    }
    largest
}
