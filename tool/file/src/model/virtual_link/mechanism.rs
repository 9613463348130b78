//! Mechanisms with virtual links: any mechanism with virtual links after its own ones, or a single drive link.

use std::sync::Arc;

use jred::Domain;
use jred::error::Error;
use jred::machine::{
    Body, Frame, Frames, Joint, Jointed, Joints, Link, MAX_LINKS, Marker, Mechanism, PoseError,
    Wrench,
};
use jred::number::{RangeError, Transfer};

use super::{LinkCurve, VirtualLink};
use crate::model::mechanism::Inner;

/// A mechanism with virtual links after its own links.
#[derive(Clone, Debug)]
pub(crate) struct CurveMechanism {
    inner: Arc<dyn Inner>,
    links: Vec<Link>,
    courses: Vec<LinkCurve>,
    edges: Vec<f64>,
}

impl CurveMechanism {
    pub(crate) fn new(inner: Arc<dyn Inner>, stand_ins: &[VirtualLink]) -> Result<Self, Error> {
        let mut links = inner.links().to_vec();
        for stand_in in stand_ins {
            links.push(Link::rotor(stand_in.course.inertia())?);
        }
        if links.len() > MAX_LINKS {
            return Err(RangeError::TooMany {
                what: "links, of which each curve takes one",
                capacity: MAX_LINKS,
            }
            .into());
        }
        let courses = stand_ins.iter().map(|s| s.course.clone()).collect();
        let own = (0..).map_while(|k| inner.edge(k));
        let edges = own.chain(stand_ins.iter().flat_map(|s| s.edges.iter().copied()));
        Ok(Self {
            edges: edges.collect(),
            inner,
            links,
            courses,
        })
    }

    /// The mechanism without virtual links.
    pub(crate) fn inner(&self) -> &dyn Inner {
        self.inner.as_ref()
    }

    /// The curves, in the order of their links.
    pub(crate) fn courses(&self) -> &[LinkCurve] {
        &self.courses
    }

    /// Number of the mechanism's own links.
    fn own(&self) -> usize {
        self.links.len() - self.courses.len()
    }
}

impl Mechanism for CurveMechanism {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        self.inner.domain()
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        let mut frames = self.inner.frames(phi)?;
        let own = frames.len();
        for course in &self.courses {
            let psi = course.psi(phi, &frames[..own]);
            // Cannot fail: `new` counted the links.
            let _ = frames.push(Frame::turning([0.0, 0.0], psi));
        }
        Ok(frames)
    }

    fn edge(&self, k: usize) -> Option<f64> {
        self.edges.get(k).copied()
    }
}

impl Jointed for CurveMechanism {
    /// The joints of the mechanism, then the bearing and the gearing of each virtual link.
    fn joints(&self, phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        let own = self.own();
        let inner: Frames = frames.iter().take(own).copied().collect();
        let mut joints = self.inner.joints(phi, &inner)?;
        let drive = match joints.get(self.inner.drive()) {
            Some(joint) => joint.unit_drive(frames)[1],
            None => Wrench::moment(Body::Ground, 0.0),
        };
        let rotors = frames.iter().enumerate().skip(own);
        for ((k, rotor), course) in rotors.zip(&self.courses) {
            let bearing = [Marker::ground([0.0, 0.0]), Marker::on(k, [0.0, 0.0])];
            let gearing = [
                course.gearing(phi, &inner, rotor, drive),
                Wrench::moment(Body::Link(k), 1.0),
            ];
            for joint in [Joint::Revolute(bearing), Joint::Transmission(gearing)] {
                // Cannot fail: two joints per link.
                let _ = joints.push(joint);
            }
        }
        Ok(joints)
    }

    fn drive(&self) -> usize {
        self.inner.drive()
    }
    fn determined(&self, phi: f64) -> bool {
        self.inner.determined(phi)
    }
}

/// A single drive link, on its bearing or guide.
#[derive(Clone, Debug)]
pub(crate) struct DriveLinkAlone {
    domain: Domain,
    slides: bool,
    links: [Link; 1],
}

impl DriveLinkAlone {
    pub(crate) fn new(domain: Domain, slides: bool, link: Link) -> Self {
        Self {
            domain,
            slides,
            links: [link],
        }
    }
}

impl Mechanism for DriveLinkAlone {
    fn links(&self) -> &[Link] {
        &self.links
    }

    fn domain(&self) -> Domain {
        self.domain
    }

    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        if !phi.is_finite() {
            return Err(RangeError::NotFinite("position of the drive link").into());
        }
        let at = Transfer::variable(phi);
        let frame = if self.slides {
            Frame::translating([at, Transfer::constant(0.0)])
        } else {
            Frame::turning([0.0, 0.0], at)
        };
        Ok(Frames::from_iter([frame]))
    }
}

impl Jointed for DriveLinkAlone {
    fn joints(&self, _phi: f64, _frames: &Frames) -> Result<Joints, PoseError> {
        let ends = [Marker::ground([0.0, 0.0]), Marker::on(0, [0.0, 0.0])];
        let joint = if self.slides {
            Joint::Prismatic(ends)
        } else {
            Joint::Revolute(ends)
        };
        Ok(Joints::from_iter([joint]))
    }
}
