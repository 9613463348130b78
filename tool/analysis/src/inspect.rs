//! `jred check`: checks that the mechanism is as intended and far enough from its dead points.
//!
//! Limits of the transmission index (see `inspect/transmission.rs`): the classical rule keeps the transmission angle above
//! 40° (H. Alt, *Der Übertragungswinkel und seine Bedeutung für das Konstruieren periodischer Getriebe*, Werkstattstechnik
//! 26, 1932; S. S. Balli and S. Chand, *Transmission angle in mechanisms*, Mechanism and Machine Theory 37, 2002), which is
//! an index of 0.643. Below 0.3, an angle of 17.5°, forces and play are more than three times those at 90°: the mechanism is
//! near a dead point, and the check fails.

use jred::Domain;
use jred::error::Error;
use jred::machine::{Body, Frame, Frames, Joint, Jointed as _, Joints, Mechanism as _};
use jred::mechanism::cam::lift_off;
use serde::Serialize;

use crate::warnings::warnings;
use jred_file::model::coordinate::{Coordinate, whole_range};
use jred_file::model::machine::{MachineFile, Machines};
use jred_file::model::mechanism::{AnyMechanism, Fact};
use jred_file::number::numerics;
use jred_file::number::rounding::short;

mod agreement;
mod centres;
mod course;
mod transmission;

pub use agreement::{Agreement, Inertia};
pub use centres::Travel;
pub use course::{MotionFindings, SegmentFinding};
use transmission::{Index, Structure};

/// Below this index a mechanism is too close to a dead point.
pub const NEAR_DEAD_POINT: f64 = 0.3;

/// sin 40°: textbooks recommend at least this transmission index.
pub const RECOMMENDED: f64 = 0.642_787_609_686_539_3;

/// An index that changes by less is constant.
const CONSTANT: f64 = 1e-9;

/// Allowed difference of the links' speeds after a turn, as a share of the size of the mechanism (or of the drive speed).
const CLOSURE_TOLERANCE: f64 = 1e-9;

/// Allowed difference of the two drive torques, as a share of the largest term.
const TORQUE_TOLERANCE: f64 = 1e-10;

/// Allowed difference of work and energy, as a share of the energy exchanged by the drive.
const BALANCE_TOLERANCE: f64 = 1e-9;

/// One joint.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct JointFinding {
    /// Its name.
    pub name: String,
    /// Pin, guide, and so on.
    pub kind: &'static str,
    /// The two bodies: the first acts on the second.
    pub bodies: [String; 2],
    /// Degrees of freedom that it removes.
    pub constraints: usize,
    /// Whether the drive moves it.
    pub driven: bool,
}

/// The smallest transmission index.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
pub struct Transmission {
    /// The index, 0 (dead point) to 1.
    pub index: f64,
    /// The transmission angle of a dyad with this index (deg); `None` for a contact or a mesh.
    #[serde(rename = "angle [deg]")]
    pub angle: Option<f64>,
    /// Position of the drive link (rad or m); `None` if the index is the same everywhere.
    pub at: Option<f64>,
    /// The links of the group.
    pub links: Vec<String>,
    /// Whether the determinant of every group keeps its sign, and so its branch.
    pub branch_kept: bool,
}

impl Transmission {
    /// Place of the smallest index as text.
    pub fn place(&self, coordinate: Coordinate) -> String {
        self.at.map_or_else(
            || "everywhere".to_owned(),
            |at| format!("at {}", coordinate.place(at)),
        )
    }
}

/// Result of the check.
#[derive(Clone, Debug)]
pub struct Findings {
    /// Title of the machine file.
    pub title: String,
    /// Type of the mechanism.
    pub kind: &'static str,
    /// Whether the drive link turns or slides.
    pub coordinate: Coordinate,
    /// Range of the drive link.
    pub domain: Domain,
    /// Number of its links.
    pub links: usize,
    /// Its joints.
    pub joints: Vec<JointFinding>,
    /// Difference of the links' speeds after a turn; `None` for a stroke.
    pub closure: Option<f64>,
    /// Travels of its links.
    pub travels: Vec<Travel>,
    /// The smallest transmission index; `None` without a group of links.
    pub transmission: Option<Transmission>,
    /// Its inertia.
    pub inertia: Inertia,
    /// Agreement of the methods.
    pub agreement: Agreement,
    /// The motion; `None` without one.
    pub motion: Option<MotionFindings>,
    /// Figures of its kind.
    pub facts: Vec<Fact>,
    /// Remarks.
    pub notes: Vec<String>,
}

impl Findings {
    /// Checks the machine.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere in its range.
    pub fn of(file: &MachineFile) -> Result<Self, Error> {
        let mechanism = file.machine.mechanism();
        let domain = mechanism.domain();
        let start = domain.position(0.0);
        let frames = mechanism.frames(start)?;
        let joints = mechanism.joints(start, &frames)?;
        let machine = file.with_drive_train()?;
        let machines = Machines::of(file)?;
        Ok(Self {
            title: file.title.clone(),
            kind: mechanism.kind(),
            coordinate: mechanism.coordinate(),
            domain,
            links: mechanism.own_links(),
            joints: joint_findings(mechanism, &joints),
            closure: closure(mechanism)?,
            travels: centres::travels(mechanism)?,
            transmission: transmission(file)?,
            inertia: agreement::inertia(file, &machine, &machines)?,
            agreement: agreement::agreement(file, &machines)?,
            motion: MotionFindings::of(file),
            facts: facts(file)?,
            notes: jred_file::model::variator::integrability_text(file)
                .into_iter()
                .chain(
                    warnings(file)?
                        .iter()
                        .map(|words| format!("warning: {words}")),
                )
                .chain(change_points(mechanism))
                .chain(file.scheduled().map(|item| item.what))
                .collect(),
        })
    }

    /// Degrees of freedom: 3·n − constraints.
    pub fn freedoms(&self) -> i64 {
        3 * self.links as i64 - self.constraints() as i64
    }

    /// Freedoms removed by the joints.
    pub fn constraints(&self) -> usize {
        self.joints.iter().map(|joint| joint.constraints).sum()
    }

    /// Names of the checks.
    pub fn checked(&self) -> Vec<&'static str> {
        let all = [
            (true, "one degree of freedom"),
            (self.closure.is_some(), "closure after a turn"),
            (
                self.transmission.is_some(),
                "distance from dead points, branch",
            ),
            (true, "two ways to the drive torque"),
            (self.agreement.energy.is_some(), "energy over the motion"),
        ];
        all.into_iter()
            .filter_map(|(done, what)| done.then_some(what))
            .collect()
    }

    /// Messages about violated rules.
    pub fn violations(&self) -> Vec<String> {
        let mut violations = Vec::new();
        if self.freedoms() != 1 {
            violations.push(format!(
                "{} degrees of freedom instead of one",
                self.freedoms()
            ));
        }
        if let Some(gap) = self.closure.filter(|gap| *gap > CLOSURE_TOLERANCE) {
            violations.push(format!("the mechanism does not close: after a turn, the speeds of its links differ by {gap:.1e}"));
        }
        if let Some(transmission) = &self.transmission {
            if transmission.index < NEAR_DEAD_POINT {
                violations.push(format!(
                    "too close to a dead point: transmission index {} {}, at least {NEAR_DEAD_POINT} is required",
                    short(transmission.index),
                    transmission.place(self.coordinate)
                ));
            }
            if !transmission.branch_kept {
                violations.push(
                    "the mechanism changes its branch: it passes through a dead point".to_owned(),
                );
            }
        }
        if self.agreement.dalembert > TORQUE_TOLERANCE {
            violations.push(format!(
                "drive torques by d'Alembert's principle and by reduction differ by {:.1e}",
                self.agreement.dalembert
            ));
        }
        if let Some(off) = self.agreement.energy.filter(|off| *off > BALANCE_TOLERANCE) {
            violations.push(format!(
                "work and energy over the motion differ by {off:.1e} of the energy that the drive moves"
            ));
        }
        violations
    }

    /// Whether every rule is satisfied.
    pub fn holds(&self) -> bool {
        self.violations().is_empty()
    }
}

/// Assumption for a linkage that passes change points.
pub fn change_points(mechanism: &AnyMechanism) -> Option<String> {
    let points = mechanism.change_points();
    let coordinate = mechanism.coordinate();
    let places: Vec<String> = (points.iter())
        .map(|point| coordinate.place(point.at))
        .collect();
    points.first().map(|first| {
        format!(
            "the linkage lies flat at {} and is taken to be guided there, so that it stays on its branch (a second crank, teeth, \
             another coupler); the forces in its joints are those without the guide: they grow towards these positions, and within \
             {} {} of them they are not determined",
            places.join(" and "),
            short(coordinate.shown(first.within)),
            coordinate.unit()
        )
    })
}

/// Properties of this kind of mechanism, and the speeds at which its followers lift off.
fn facts(file: &MachineFile) -> Result<Vec<Fact>, Error> {
    let mechanism = file.machine.mechanism();
    let mut facts = mechanism.facts().to_vec();
    if mechanism.coordinate() == Coordinate::Length {
        return Ok(facts);
    }
    // The direction of the motion; an oscillating cam has the limit of its forward direction.
    let direction = file.motion.as_ref().map_or(1.0, |motion| {
        motion.at(motion.duration()).phi - motion.at(0.0).phi
    });
    for contact in mechanism.contacts() {
        let joint = mechanism.contact_prefix(contact.joint);
        let pieces = contact.pieces.iter().copied();
        let text = match lift_off(&file.machine, contact.joint, pieces, direction)? {
            None => "none: contact is maintained at any constant speed".to_owned(),
            Some(limit) => format!(
                "{} rpm at {}",
                short(limit.omega * 60.0 / std::f64::consts::TAU),
                Coordinate::Angle.place(limit.phi)
            ),
        };
        facts.push(Fact {
            label: format!("{joint}constant speed at which the follower lifts off"),
            text,
        });
    }
    Ok(facts)
}

fn body_name(mechanism: &AnyMechanism, body: Body) -> String {
    match body {
        Body::Ground => "ground".to_owned(),
        Body::Link(k) => mechanism.link_names().get(k).cloned().unwrap_or_default(),
    }
}

fn joint_findings(mechanism: &AnyMechanism, joints: &[Joint]) -> Vec<JointFinding> {
    // Links that represent curves, each with two joints that remove its three freedoms, are not parts of the machine.
    let names = mechanism.joint_names().iter();
    let finding = |(k, (joint, name)): (usize, (&Joint, &String))| JointFinding {
        name: name.clone(),
        kind: match joint {
            Joint::Revolute(_) => "pin",
            Joint::Prismatic(_) => "guide",
            Joint::Fixed(_) => "rigid",
            Joint::PinInSlot(_) => "pin in slot",
            Joint::Transmission(_) => "transmission",
        },
        bodies: joint.bodies().map(|body| body_name(mechanism, body)),
        constraints: joint.constraints(),
        driven: k == mechanism.drive(),
    };
    joints.iter().zip(names).enumerate().map(finding).collect()
}

/// The size of a mechanism: the largest distance between two of its joints (m).
fn size(joints: &[Joint], frames: &Frames) -> f64 {
    let points: Vec<[f64; 2]> = joints
        .iter()
        .flat_map(|joint| points(joint, frames))
        .collect();
    let mut most = 0.0f64;
    for a in &points {
        for b in &points {
            most = most.max((a[0] - b[0]).hypot(a[1] - b[1]));
        }
    }
    if most > 0.0 { most } else { 1.0 }
}

/// The points of a joint.
fn points(joint: &Joint, frames: &Frames) -> Vec<[f64; 2]> {
    match joint {
        Joint::Revolute(m) | Joint::Prismatic(m) | Joint::Fixed(m) | Joint::PinInSlot(m) => {
            let of = |m: &jred::machine::Marker| m.position(frames).map(|c| c.value);
            m.iter().map(of).collect()
        }
        Joint::Transmission(_) => Vec::new(),
    }
}

/// Difference of the links' speeds from those one turn earlier: |r_c′| relative to the size of the mechanism, and ψ′. Positions may advance, as of a
/// rack, a nut or a planet, while the reduced curves still repeat.
fn closure(mechanism: &AnyMechanism) -> Result<Option<f64>, Error> {
    use std::f64::consts::TAU;
    if mechanism.domain() != Domain::Turn {
        return Ok(None);
    }
    let mut most = 0.0f64;
    for k in 0..8 {
        let phi = TAU * f64::from(k) / 8.0;
        let (now, later) = (mechanism.frames(phi)?, mechanism.frames(phi + TAU)?);
        let length = size(&mechanism.joints(phi, &now)?, &now);
        for ((a, b), link) in now.iter().zip(&later).zip(mechanism.links()) {
            let speed = |frame: &Frame| {
                let [x, y] = frame.point(link.com());
                x.d1.hypot(y.d1)
            };
            most = most.max((speed(b) - speed(a)).abs() / length);
            most = most.max((b.psi.d1 - a.psi.d1).abs() / a.psi.d1.abs().max(1.0));
        }
    }
    Ok(Some(most))
}

/// The smallest index over the motion, or over the whole range without one.
fn transmission(file: &MachineFile) -> Result<Option<Transmission>, Error> {
    const STEPS: usize = 1440;
    const SAMPLES: usize = 24;
    let mechanism = file.machine.mechanism();
    if !mechanism.change_points().is_empty() {
        // It passes its dead points, guided.
        return Ok(None);
    }
    let drive = mechanism.drive();
    let start = mechanism.domain().position(0.0);
    let joints = mechanism.joints(start, &mechanism.frames(start)?)?;
    let placed = |phi: f64| -> Result<(Joints, Frames, f64), Error> {
        let frames = mechanism.frames(phi)?;
        let joints = mechanism.joints(phi, &frames)?;
        let length = size(&joints, &frames);
        Ok((joints, frames, length))
    };
    let samples = whole_range(mechanism.domain(), SAMPLES)
        .map(placed)
        .collect::<Result<Vec<_>, Error>>()?;
    let structure = Structure::new(&joints, drive, mechanism.links().len(), &samples);
    let at = |phi: f64| -> Result<Vec<Index>, Error> {
        let (joints, frames, length) = placed(phi)?;
        Ok(structure.indices(&joints, &frames, length))
    };
    let places: Vec<f64> = match &file.motion {
        Some(motion) => (0..=STEPS)
            .map(|k| motion.at(motion.duration() * k as f64 / STEPS as f64).phi)
            .collect(),
        None => whole_range(mechanism.domain(), STEPS).collect(),
    };
    let values = places
        .iter()
        .map(|&phi| at(phi))
        .collect::<Result<Vec<_>, Error>>()?;
    let mut worst: Option<(f64, usize, usize)> = None;
    let mut branch_kept = true;
    for (k, row) in values.iter().enumerate() {
        for (block, index) in row.iter().enumerate() {
            if worst.is_none_or(|(least, ..)| index.value.abs() < least) {
                worst = Some((index.value.abs(), k, block));
            }
            let first = values.first().and_then(|first| first.get(block));
            let same = first.is_some_and(|first| first.value * index.value > 0.0);
            branch_kept &= !index.bilateral || same;
        }
    }
    let Some((_, k, block)) = worst else {
        return Ok(None);
    };
    let [low, high] = [places[k.saturating_sub(1)], places[(k + 1).min(STEPS)]];
    let index = |phi: f64| -> Result<f64, Error> {
        Ok(at(phi)?.get(block).map_or(1.0, |index| index.value.abs()))
    };
    let middle = numerics::least(index, low, high)?;
    let (phi, least) = if index(middle)? < index(places[k])? {
        (middle, index(middle)?)
    } else {
        (places[k], index(places[k])?)
    };
    let names = mechanism.link_names();
    let here = values[k].get(block).copied();
    let group = here.map_or(0, |index| index.group);
    let most = values
        .iter()
        .filter_map(|row| Some(row.get(block)?.value.abs()))
        .fold(0.0, f64::max);
    let shown = if mechanism.domain() == Domain::Turn {
        phi.rem_euclid(std::f64::consts::TAU)
    } else {
        phi
    };
    let links = structure.links(group);
    Ok(Some(Transmission {
        index: least,
        angle: here
            .is_some_and(|index| index.bilateral)
            .then(|| least.min(1.0).asin().to_degrees()),
        at: (most - least > CONSTANT).then_some(shown),
        links: links
            .iter()
            .filter_map(|&k| names.get(k).cloned())
            .collect(),
        branch_kept,
    }))
}
