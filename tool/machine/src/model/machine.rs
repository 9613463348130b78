//! A machine as described by a machine file, checked and in SI units.

use jred::machine::PoseError;
use std::fmt;
use std::sync::Arc;

use jred::machine::{Element, Frames, Jointed, Joints, Load, Mechanism};
use jred::mechanism::Train;
use jred::{Domain, Error, Link, Machine, Reduction};

use crate::model::coordinate::Coordinate;
use crate::model::motion::Motion;
use crate::model::rules::RuleSet;
use crate::model::site::Site;
use crate::model::tabulated::{Course, StandIn, Tabulated};
use crate::model::tolerance::Tolerance;
use crate::model::variator::Variator;

/// A mechanism that knows its joints and can be kept in a machine.
pub trait Inner: Jointed + fmt::Debug + Send + Sync {}

impl<M: Jointed + fmt::Debug + Send + Sync> Inner for M {}

/// A point of a link, with the name that tables and drawings use.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// Such as `B`.
    pub name: String,
    /// Index of the link.
    pub link: usize,
    /// Where it is in the link's frame (m).
    pub at: [f64; 2],
}

/// A joint in which two surfaces only press on each other, as a follower on its cam.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Index of the joint.
    pub joint: usize,
    /// Whether the file names it; otherwise it is the only one.
    pub named: bool,
    /// The pieces of the drive's range in which it is smooth.
    pub pieces: Vec<jred::mechanism::cam::Piece>,
}

/// A property of one kind of mechanism, such as the largest pressure angle of a cam.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Fact {
    /// Its name.
    pub label: String,
    /// The figure, its unit and where it is.
    pub text: String,
}

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
    stand_ins: usize,
    /// The stand-ins, as links, on which the weight of a payload acts.
    weights: Vec<usize>,
    contacts: Vec<Contact>,
    ropes: Vec<usize>,
    facts: Vec<Fact>,
}

impl AnyMechanism {
    /// A mechanism of the `kind` that machine files write as `type`, with a name for each link and each joint, in the order
    /// of the mechanism's own lists.
    pub fn new<S: Into<String>, J: Into<String>>(
        kind: &'static str,
        mechanism: impl Inner + 'static,
        links: impl IntoIterator<Item = S>,
        joints: impl IntoIterator<Item = J>,
    ) -> Self {
        Self {
            kind,
            // One that cannot be placed at all is refused by the reader, and by every question that follows.
            coordinate: Coordinate::of(&mechanism).unwrap_or(Coordinate::Angle),
            inner: Arc::new(mechanism),
            links: links.into_iter().map(Into::into).collect(),
            joints: joints.into_iter().map(Into::into).collect(),
            points: Vec::new(),
            outlines: Vec::new(),
            ground_points: Vec::new(),
            elements: Vec::new(),
            loads: Vec::new(),
            stand_ins: 0,
            weights: Vec::new(),
            contacts: Vec::new(),
            ropes: Vec::new(),
            facts: Vec::new(),
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

    /// With springs of its own, such as that which closes a cam.
    #[must_use]
    pub fn with_elements(mut self, elements: impl IntoIterator<Item = NamedElement>) -> Self {
        self.elements.extend(elements);
        self
    }

    /// With curves over the drive link's position: each becomes a link with its bearing and gearing, and a load or a spring.
    ///
    /// # Errors
    /// More links than a mechanism may have.
    pub fn with_stand_ins(mut self, stand_ins: &[StandIn]) -> Result<Self, Error> {
        let own = self.links.len();
        self.inner = Arc::new(Tabulated::new(Arc::clone(&self.inner), stand_ins)?);
        for (k, StandIn { name, course }) in stand_ins.iter().enumerate() {
            if let Some(load) = course.load(own + k)? {
                let name = name.clone();
                self.loads.push(NamedLoad { name, load });
            }
            if let Some(element) = course.spring(own + k)? {
                let name = name.clone();
                self.elements.push(NamedElement { name, element });
            }
            if matches!(course, Course::Weight { .. }) {
                self.weights.push(own + k);
            }
            self.links.push(name.clone());
            self.joints.push(format!("bearing of {name}"));
            self.joints.push(format!("gearing of {name}"));
        }
        self.stand_ins += stand_ins.len();
        Ok(self)
    }

    /// Number of links that are parts of the mechanism; those after them stand in for curves.
    pub fn own_links(&self) -> usize {
        self.links.len() - self.stand_ins
    }

    /// Whether a load is the weight of a payload: a part of the machine, not of its process.
    pub fn is_weight(&self, load: &Load) -> bool {
        self.weights.contains(&load.link())
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

    /// With one more joint, number `joint`, whose rope can only pull: its force on the second body is positive then.
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

    /// The mechanism's own springs.
    pub fn own_elements(&self) -> &[NamedElement] {
        &self.elements
    }

    /// The contacts that must not separate.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// How messages begin that are about the contact in this joint: with its name, if the file gives one.
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

    /// The `type` of the machine file.
    pub const fn kind(&self) -> &'static str {
        self.kind
    }

    /// The coordinate of its drive link.
    pub const fn coordinate(&self) -> Coordinate {
        self.coordinate
    }

    /// The names of the links, as loads and reports use them.
    pub fn link_names(&self) -> &[String] {
        &self.links
    }

    /// The names of the joints.
    pub fn joint_names(&self) -> &[String] {
        &self.joints
    }

    /// The points that have a name.
    pub fn points(&self) -> &[NamedPoint] {
        &self.points
    }

    /// The points of the ground that have a name, in global coordinates (m).
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
}

impl Jointed for AnyMechanism {
    fn joints(&self, phi: f64, frames: &Frames) -> Result<Joints, PoseError> {
        self.inner.joints(phi, frames)
    }
    fn drive(&self) -> usize {
        self.inner.drive()
    }
}

/// A load with the name that reports use.
#[derive(Clone, Debug)]
pub struct NamedLoad {
    /// Name from the file, or made from what the load does.
    pub name: String,
    /// The load.
    pub load: Load,
}

/// A spring or a damper with the name that reports use.
#[derive(Clone, Debug)]
pub struct NamedElement {
    /// Name from the file, or made from its ends.
    pub name: String,
    /// The spring or damper.
    pub element: Element,
}

/// The content of a machine file.
#[derive(Clone, Debug)]
pub struct MachineFile {
    /// Title for reports.
    pub title: String,
    /// The mechanism with gravity, loads and flywheel, *without* the drive train.
    pub machine: Machine<AnyMechanism>,
    /// Inertia of the flywheel on the drive link (kg·m²), contained in `machine`.
    pub flywheel: f64,
    /// The loads, in the order of the machine's.
    pub loads: Vec<NamedLoad>,
    /// The springs and dampers, in the order of the machine's.
    pub elements: Vec<NamedElement>,
    /// Fixed drive train between the motor's gearbox (or the motor) and the drive link; empty if there is none.
    pub drive_train: Train,
    /// Friction variator between the motor and the drive train, if there is one.
    pub variator: Option<Variator>,
    /// The prescribed motion, if the file has one.
    pub motion: Option<Motion>,
    /// The simulation for `jred simulate`, if the file has one.
    pub simulation: Option<Simulation>,
    /// Sizing rules, defaults unless the file overrides them.
    pub rules: RuleSet,
    /// Tolerances of quantities, from `[tolerance]`.
    pub tolerances: Vec<Tolerance>,
    /// Supply, surroundings, stiffness and tool.
    pub site: Site,
}

/// Where a torque acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shaft {
    /// At the motor, in front of the drive train.
    Motor,
    /// At the drive link.
    DriveLink,
}

/// A free motion under a motor torque.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// φ at the start (rad, or m of a link that slides).
    pub start_angle: f64,
    /// ω of the drive link at the start (rad/s).
    pub start_speed: f64,
    /// Length (s).
    pub duration: f64,
    /// Distance of the output points (s).
    pub output_step: f64,
    /// (speed (rad/s), torque (N·m)) at `at`, speeds rising; one point means a constant torque. Between points
    /// straight lines, beyond the ends the end's torque.
    pub torque: Vec<(f64, f64)>,
    /// Where the torque acts.
    pub at: Shaft,
    /// Inertia of the motor's rotor, at the motor shaft (kg·m²).
    pub rotor_inertia: f64,
    /// Relative tolerance of the integrator.
    pub tolerance: f64,
}

impl Simulation {
    /// Whether the motor drives a link that slides, without a stage that turns: its torque is then a force.
    pub fn drives_a_slide(&self, file: &MachineFile) -> bool {
        let coordinate = file.machine.mechanism().coordinate();
        let direct = self.at == Shaft::DriveLink || file.drive_train.stages().is_empty();
        coordinate == Coordinate::Length && direct
    }
}

impl MachineFile {
    /// The motion of a file that must have one.
    ///
    /// # Errors
    /// It has none.
    pub fn required_motion(&self) -> miette::Result<&Motion> {
        self.motion_or("")
    }

    /// The same where an option can stand in for it: `instead` is the beginning of the cure, such as `give --omega, or `.
    ///
    /// # Errors
    /// It has none.
    pub fn motion_or(&self, instead: &str) -> miette::Result<&Motion> {
        self.motion.as_ref().ok_or_else(|| {
            miette::miette!(
                help = format!(
                    "{instead}add a [motion], for example type = \"constant-speed\", speed = \"60 rpm\""
                ),
                "the machine file of \"{}\" has no [motion]",
                self.title
            )
        })
    }

    /// The reduced link at `phi` without the drive train, as [`Machine::bare_reduction`] gives it, but with the weight of
    /// payloads from tables in U′ and not among the process loads. U itself stays without it: a payload that varies with the
    /// position has none.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn bare_reduction(&self, phi: f64) -> Result<Reduction, Error> {
        let mut reduction = self.machine.bare_reduction(phi)?;
        let weight = self.payload_weight(phi)?;
        reduction.potential_slope += weight;
        reduction.process += weight;
        Ok(reduction)
    }

    /// Torque (N·m) of the drive link against the weight of payloads from tables, −m·g·r′; zero without such.
    ///
    /// # Errors
    /// The mechanism cannot be placed at `phi`.
    pub fn payload_weight(&self, phi: f64) -> Result<f64, Error> {
        let mechanism = self.machine.mechanism();
        if mechanism.weights.is_empty() {
            return Ok(0.0);
        }
        let frames = mechanism.frames(phi)?;
        let loads = self.machine.loads().iter();
        let weights = loads.filter(|load| mechanism.is_weight(load));
        let torques = weights.filter_map(|load| {
            let frame = frames.get(load.link())?;
            Some(-load.reduce(frame, phi).process)
        });
        Ok(torques.sum())
    }

    /// The machine with its drive train reduced to the drive link: what the motor's gearbox has to move.
    ///
    /// # Errors
    /// None for a machine file that was read without error.
    pub fn with_drive_train(&self) -> Result<Machine<AnyMechanism>, Error> {
        let ratio = self.drive_train.ratio();
        let train = self.drive_train.inertia_at_input() * ratio * ratio;
        Ok(self.machine.clone().with_flywheel(train)?)
    }
}
