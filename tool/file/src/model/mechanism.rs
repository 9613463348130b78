//! Any mechanism that a machine file can name, with the names of its parts.

mod parts;

use std::any::Any;
use std::fmt;
use std::sync::Arc;

use jred::Domain;
use jred::error::Error;
use jred::machine::PoseError;
use jred::machine::{Action, Frames, Jointed, Joints, Link, Load, Mechanism};
use jred::mechanism::linkage::Pair;

use crate::model::axis::Axis;
use crate::model::coordinate::Coordinate;
use crate::model::stroke::StrokeMechanism;
use crate::model::virtual_link::{CurveMechanism, LinkCurve, VirtualLink};
use crate::model::with_mass::WithMass;

pub use parts::{ChangePoint, Contact, Fact, NamedElement, NamedLoad, NamedPoint};

/// A mechanism that knows its joints and can be stored in a machine.
pub trait Inner: Jointed + fmt::Debug + Send + Sync + Any {}

impl<M: Jointed + fmt::Debug + Send + Sync + Any> Inner for M {}

/// Any mechanism that a machine file can name, with the names of its parts.
#[derive(Clone, Debug)]
pub struct AnyMechanism {
    kind: &'static str,
    coordinate: Coordinate,
    inner: Arc<dyn Inner>,
    links: Vec<String>,
    joints: Vec<String>,
    points: Vec<NamedPoint>,
    outlines: Vec<(usize, Vec<[f64; 2]>)>,
    ground_points: Vec<(String, [f64; 2])>,
    elements: Vec<NamedElement>,
    loads: Vec<NamedLoad>,
    /// Number of leading loads that may drive the machine as well as resist it: the pull of a web.
    pulls: usize,
    /// Links on guides along x, with their friction coefficient times mass (kg).
    friction: Vec<(usize, f64)>,
    stand_ins: usize,
    /// The virtual links on which the weight of a payload acts.
    pub(super) weights: Vec<usize>,
    contacts: Vec<Contact>,
    ropes: Vec<usize>,
    /// A link with limited travel whose end the file does not give.
    open_ended: Option<usize>,
    /// The coordinate in which its stroke is given, if not the drive link's.
    pub(super) axis: Option<Axis>,
    facts: Vec<Fact>,
    /// The pairs of a linkage: the closure of each of its joints.
    pairs: Vec<Pair>,
    /// Positions at which a linkage is flat and passes on its branch.
    change_points: Vec<ChangePoint>,
}

impl AnyMechanism {
    /// A mechanism of the `kind` that machine files write as `type`, with a name for each link and each joint, in the order of the mechanism's own
    /// lists.
    pub fn new<S: Into<String>, J: Into<String>>(
        kind: &'static str,
        mechanism: impl Inner + 'static,
        links: impl IntoIterator<Item = S>,
        joints: impl IntoIterator<Item = J>,
    ) -> Self {
        Self::of(kind, Arc::new(mechanism), links, joints)
    }

    /// The same of a mechanism on the heap.
    pub(crate) fn of<S: Into<String>, J: Into<String>>(
        kind: &'static str,
        inner: Arc<dyn Inner>,
        links: impl IntoIterator<Item = S>,
        joints: impl IntoIterator<Item = J>,
    ) -> Self {
        Self {
            kind,
            // A mechanism that cannot be placed at all is refused by the reader, and by every later call.
            coordinate: Coordinate::of(&inner.as_ref()).unwrap_or(Coordinate::Angle),
            inner,
            links: links.into_iter().map(Into::into).collect(),
            joints: joints.into_iter().map(Into::into).collect(),
            points: Vec::new(),
            outlines: Vec::new(),
            ground_points: Vec::new(),
            elements: Vec::new(),
            loads: Vec::new(),
            pulls: 0,
            friction: Vec::new(),
            stand_ins: 0,
            weights: Vec::new(),
            contacts: Vec::new(),
            ropes: Vec::new(),
            open_ended: None,
            axis: None,
            facts: Vec::new(),
            pairs: Vec::new(),
            change_points: Vec::new(),
        }
    }

    /// With the pairs of its joints, including gears and racks.
    #[must_use]
    pub(crate) fn with_pairs(mut self, pairs: &[Pair]) -> Self {
        self.pairs = pairs.to_vec();
        self
    }

    /// The pairs of a linkage, in the order of its joints; empty for other mechanisms.
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// The mechanism without its virtual links and on its whole range, and the curves of all virtual links in the order of these links.
    pub fn bare(&self) -> (&dyn Inner, Vec<&LinkCurve>) {
        let mut inner = self.inner.as_ref();
        let mut courses = Vec::new();
        loop {
            let any: &dyn Any = inner;
            if let Some(tabulated) = any.downcast_ref::<CurveMechanism>() {
                courses.splice(0..0, tabulated.courses());
                inner = tabulated.inner();
            } else if let Some(part) = any.downcast_ref::<StrokeMechanism>() {
                inner = part.inner();
            } else if let Some(laden) = any.downcast_ref::<WithMass>() {
                inner = laden.inner().inner.as_ref();
            } else {
                return (inner, courses);
            }
        }
    }

    /// With one more named point, `at` [u, v] (m) of link number `link`.
    #[must_use]
    pub fn with_point(mut self, name: impl Into<String>, link: usize, at: [f64; 2]) -> Self {
        let name = name.into();
        self.points.push(NamedPoint { name, link, at });
        self
    }

    /// With one more closed outline, points [u, v] (m) of link number `link`: a cam's profile, a wheel's pitch circle. A link
    /// that has outlines is drawn by them.
    #[must_use]
    pub fn with_outline(mut self, link: usize, outline: Vec<[f64; 2]>) -> Self {
        self.outlines.push((link, outline));
        self
    }

    /// With one more named point of the ground, in global coordinates (m).
    #[must_use]
    pub fn with_ground_point(mut self, name: impl Into<String>, at: [f64; 2]) -> Self {
        self.ground_points.push((name.into(), at));
        self
    }

    /// The same mechanism on a part of its range.
    #[must_use]
    pub(crate) fn on_stroke(mut self, stroke: [f64; 2]) -> Self {
        self.inner = Arc::new(StrokeMechanism::new(Arc::clone(&self.inner), stroke));
        self
    }

    /// With a link of limited travel whose end the file does not give.
    #[must_use]
    pub(crate) const fn open_ended(mut self, link: usize) -> Self {
        self.open_ended = Some(link);
        self
    }

    /// The link of limited travel whose end the file does not give.
    pub const fn open_end(&self) -> Option<usize> {
        self.open_ended
    }

    /// With own loads, such as the pull of a web.
    #[must_use]
    pub fn with_loads(mut self, loads: impl IntoIterator<Item = NamedLoad>) -> Self {
        self.loads.extend(loads);
        self.pulls = self.loads.len();
        self
    }

    /// With own springs, such as one that closes a cam.
    #[must_use]
    pub fn with_elements(mut self, elements: impl IntoIterator<Item = NamedElement>) -> Self {
        self.elements.extend(elements);
        self
    }

    /// With dry friction in the guide along x of link number `link`: the friction coefficient times the `mass` (kg) that rests
    /// on the guide.
    #[must_use]
    pub(crate) fn with_friction(mut self, link: usize, mass: f64) -> Self {
        if mass > 0.0 {
            self.friction.push((link, mass));
        }
        self
    }

    /// With the friction of its guides as loads, in this `gravity` (m/s²): only its component normal to the guide presses.
    ///
    /// # Errors
    /// The friction force is not finite.
    pub(crate) fn with_gravity_on_guides(mut self, gravity: [f64; 2]) -> Result<Self, Error> {
        for (link, mass) in std::mem::take(&mut self.friction) {
            let force = mass * gravity[1].abs();
            if force > 0.0 {
                let name = self.links.get(link).map_or("", String::as_str);
                self.loads.push(NamedLoad {
                    name: format!("guide friction of {name}"),
                    load: Load::new(link, Action::OpposingForce(force))?,
                });
            }
        }
        Ok(self)
    }

    /// With curves over the drive link's position: each becomes a virtual link with its bearing and gearing, and a load or a spring.
    ///
    /// # Errors
    /// There are more links than a mechanism may have.
    pub fn with_stand_ins(mut self, stand_ins: &[VirtualLink]) -> Result<Self, Error> {
        let own = self.links.len();
        self.inner = Arc::new(CurveMechanism::new(Arc::clone(&self.inner), stand_ins)?);
        for (k, stand_in) in stand_ins.iter().enumerate() {
            let VirtualLink { name, course, .. } = stand_in;
            if let Some(load) = course.load(own + k)? {
                let name = name.clone();
                let load = match stand_in.window {
                    Some(window) => load.within(window),
                    None => load,
                };
                self.loads.push(NamedLoad { name, load });
            }
            if let Some(element) = course.spring(own + k)? {
                let name = name.clone();
                self.elements.push(NamedElement { name, element });
            }
            if matches!(course, LinkCurve::Weight { .. }) {
                self.weights.push(own + k);
            }
            self.links.push(name.clone());
            self.joints.push(format!("bearing of {name}"));
            self.joints.push(format!("gearing of {name}"));
        }
        self.stand_ins += stand_ins.len();
        Ok(self)
    }

    /// The same parts, moved by another mechanism with the same links and joints.
    #[must_use]
    pub(crate) fn with_inner(mut self, inner: impl Inner + 'static) -> Self {
        self.inner = Arc::new(inner);
        self
    }

    /// Number of links that are parts of the mechanism; the later ones represent curves.
    pub fn own_links(&self) -> usize {
        self.links.len() - self.stand_ins
    }

    /// Number of joints that are parts of the mechanism; after them come the bearing and the gearing of each virtual link.
    pub fn own_joints(&self) -> usize {
        self.joints.len() - 2 * self.stand_ins
    }

    /// Whether a load is the weight of a payload: a part of the machine, not of its process.
    pub fn is_weight(&self, load: &Load) -> bool {
        self.weights.contains(&load.link())
    }

    /// Number of leading own loads that drive the machine as often as they resist it.
    pub const fn pulls(&self) -> usize {
        self.pulls
    }

    /// The mechanism's own loads.
    pub fn own_loads(&self) -> &[NamedLoad] {
        &self.loads
    }

    /// With one more contact that must not separate.
    #[must_use]
    pub fn with_contact(mut self, contact: Contact) -> Self {
        self.contacts.push(contact);
        self
    }

    /// With one more joint that is a rope and can only pull: its force on the second body is positive then.
    #[must_use]
    pub fn with_rope(mut self, joint: usize) -> Self {
        self.ropes.push(joint);
        self
    }

    /// With one more property for `jred check` to show.
    #[must_use]
    pub fn with_fact(mut self, label: impl Into<String>, text: impl Into<String>) -> Self {
        let (label, text) = (label.into(), text.into());
        self.facts.push(Fact { label, text });
        self
    }

    /// With its change points.
    #[must_use]
    pub fn with_change_points(mut self, points: Vec<ChangePoint>) -> Self {
        self.change_points = points;
        self
    }

    /// The positions at which the linkage is flat and passes on its branch: the forces in its joints are not determined there.
    pub fn change_points(&self) -> &[ChangePoint] {
        &self.change_points
    }

    /// The mechanism's own springs.
    pub fn own_elements(&self) -> &[NamedElement] {
        &self.elements
    }

    /// The contacts that must not separate.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Prefix of messages about the contact in this joint: its name, if the file gives one.
    pub fn contact_prefix(&self, joint: usize) -> String {
        let named = self.contacts.iter().any(|c| c.joint == joint && c.named);
        let name = self.joints.get(joint).filter(|_| named);
        name.map_or_else(String::new, |name| format!("joint \"{name}\": "))
    }

    /// The joints that are ropes.
    pub fn ropes(&self) -> &[usize] {
        &self.ropes
    }

    /// The figures of its kind.
    pub fn facts(&self) -> &[Fact] {
        &self.facts
    }

    /// The mechanism itself, if it is of this type and has no curves over the position.
    pub fn inner<M: Mechanism + 'static>(&self) -> Option<&M> {
        (self.inner.as_ref() as &dyn Any).downcast_ref()
    }

    /// The `type` of the machine file.
    pub const fn kind(&self) -> &'static str {
        self.kind
    }

    /// The coordinate of its drive link.
    pub const fn coordinate(&self) -> Coordinate {
        self.coordinate
    }

    /// The names of the links that are parts of the mechanism, as loads and reports use them.
    pub fn link_names(&self) -> &[String] {
        self.links.get(..self.own_links()).unwrap_or_default()
    }

    /// The same, followed by the names of the curves that virtual links represent.
    pub fn names(&self) -> &[String] {
        &self.links
    }

    /// The names of the joints that are parts of the mechanism.
    pub fn joint_names(&self) -> &[String] {
        self.joints.get(..self.own_joints()).unwrap_or_default()
    }

    /// The named points.
    pub fn points(&self) -> &[NamedPoint] {
        &self.points
    }

    /// The named points of the ground, in global coordinates (m).
    pub fn ground_points(&self) -> &[(String, [f64; 2])] {
        &self.ground_points
    }

    /// The outlines of link number `link`.
    pub fn outlines(&self, link: usize) -> impl Iterator<Item = &[[f64; 2]]> {
        let own = self.outlines.iter().filter(move |(k, _)| *k == link);
        own.map(|(_, outline)| outline.as_slice())
    }
}

impl Mechanism for AnyMechanism {
    fn links(&self) -> &[Link] {
        self.inner.links()
    }
    fn domain(&self) -> Domain {
        self.inner.domain()
    }
    fn frames(&self, phi: f64) -> Result<Frames, PoseError> {
        self.inner.frames(phi)
    }
    fn edge(&self, k: usize) -> Option<f64> {
        self.inner.edge(k)
    }
}

impl Jointed for AnyMechanism {
    fn joints(&self, phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        self.inner.joints(phi, frames)
    }
    fn drive(&self) -> usize {
        self.inner.drive()
    }
    fn determined(&self, phi: f64) -> bool {
        self.inner.determined(phi)
    }
}
