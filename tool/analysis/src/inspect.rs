//! `jred check`: checks that the mechanism is as intended and far enough from its dead points.
//!
//! Limits of the transmission index (see `inspect/transmission.rs`): the classical rule keeps the transmission angle above
//! 40° (H. Alt, *Der Übertragungswinkel und seine Bedeutung für das Konstruieren periodischer Getriebe*, Werkstattstechnik
//! 26, 1932; S. S. Balli and S. Chand, *Transmission angle in mechanisms*, Mechanism and Machine Theory 37, 2002), which is
//! an index of 0.643. Below 0.3, an angle of 17.5°, forces and play are more than three times those at 90°: the mechanism is
//! near a dead point, and the check fails.

use jred::Domain;
use jred::error::Error;
use jred::machine::{Frame, Jointed as _, Mechanism as _};
use jred::mechanism::cam::{LiftOff, lift_off};
use jred_file::math;

use crate::warnings::warnings;
use jred_file::model::by_motion::ByMotion;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::{MachineFile, Machines};
use jred_file::model::mechanism::{AnyMechanism, ChangePoint, Contact, Fact};

mod agreement;
mod centres;
mod course;
mod joints;
mod smallest;
mod transmission;

pub use agreement::{Agreement, Inertia};
pub use centres::{Travel, TravelKind};
pub use course::{MotionFindings, SegmentFinding};
pub use joints::JointFinding;
pub use smallest::Transmission;

/// Below this index a mechanism is too close to a dead point.
pub const NEAR_DEAD_POINT: f64 = 0.3;

/// sin 40°: textbooks recommend at least this transmission index.
pub const RECOMMENDED: f64 = 0.642_787_609_686_539_3;

/// Allowed difference of the links' speeds after a turn, as a share of the size of the mechanism (or of the drive speed).
const CLOSURE_TOLERANCE: f64 = 1e-9;

/// Allowed difference of the two drive torques, as a share of the largest term.
const TORQUE_TOLERANCE: f64 = 1e-10;

/// Allowed difference of work and energy, as a share of the energy exchanged by the drive.
const BALANCE_TOLERANCE: f64 = 1e-9;

/// A violated rule.
#[derive(Clone, Debug)]
pub enum Violation {
    /// This number of degrees of freedom instead of one.
    Freedoms(i64),
    /// The speeds of the links differ after a turn, by this share.
    Closure(f64),
    /// The mechanism comes too close to a dead point.
    NearDeadPoint(Transmission),
    /// It passes through a dead point and changes its branch.
    BranchChanges,
    /// The two drive torques differ by this share.
    Torques(f64),
    /// Work and energy over the motion differ by this share.
    Energy(f64),
}

/// The constant speed at which the follower of a cam lifts off.
#[derive(Clone, Debug)]
pub struct ContactLimit {
    /// Name of the joint, if the file gives it one.
    pub joint: Option<String>,
    /// The speed; `None`: contact is maintained at any.
    pub limit: Option<LiftOff>,
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
    /// Where its followers lift off.
    pub lift_offs: Vec<ContactLimit>,
    /// About the integrability of its variator, in words.
    pub integrability: Option<String>,
    /// Possible mistakes.
    pub warnings: Vec<String>,
    /// Positions at which the linkage lies flat and is taken to be guided.
    pub change_points: Vec<ChangePoint>,
    /// Its parts that depend on the motion.
    pub scheduled: Vec<ByMotion>,
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
            joints: joints::findings(mechanism, &joints),
            closure: closure(mechanism)?,
            travels: centres::travels(mechanism)?,
            transmission: smallest::transmission(file)?,
            inertia: agreement::inertia(file, &machine, &machines)?,
            agreement: agreement::agreement(file, &machines)?,
            motion: MotionFindings::of(file),
            facts: mechanism.facts().to_vec(),
            lift_offs: lift_offs(file)?,
            integrability: jred_file::model::variator::integrability_text(file),
            warnings: warnings(file)?,
            change_points: mechanism.change_points().to_vec(),
            scheduled: file.scheduled().collect(),
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

    /// The violated rules.
    pub fn violations(&self) -> Vec<Violation> {
        let transmission = self.transmission.as_ref();
        let close = transmission.filter(|found| found.index < NEAR_DEAD_POINT);
        let changed = transmission.filter(|found| !found.branch_kept);
        let Agreement {
            dalembert, energy, ..
        } = self.agreement;
        let torques = Some(dalembert).filter(|off| *off > TORQUE_TOLERANCE);
        let closure = self.closure.filter(|gap| *gap > CLOSURE_TOLERANCE);
        let energy = energy.filter(|off| *off > BALANCE_TOLERANCE);
        let all = [
            (self.freedoms() != 1).then(|| Violation::Freedoms(self.freedoms())),
            closure.map(Violation::Closure),
            close.cloned().map(Violation::NearDeadPoint),
            changed.map(|_| Violation::BranchChanges),
            torques.map(Violation::Torques),
            energy.map(Violation::Energy),
        ];
        all.into_iter().flatten().collect()
    }

    /// Whether every rule is satisfied.
    pub fn holds(&self) -> bool {
        self.violations().is_empty()
    }
}

/// The speeds at which the followers of a cam that turns lift off.
fn lift_offs(file: &MachineFile) -> Result<Vec<ContactLimit>, Error> {
    let mechanism = file.machine.mechanism();
    if mechanism.coordinate() == Coordinate::Length {
        return Ok(Vec::new());
    }
    // The direction of the motion; an oscillating cam has the limit of its forward direction.
    let direction = file.motion.as_ref().map_or(1.0, |motion| {
        motion.at(motion.duration()).phi - motion.at(0.0).phi
    });
    let machine = file.machine.clone().without_frictions();
    let limit = |contact: &Contact| {
        let name = mechanism.joint_names().get(contact.joint);
        let pieces = contact.pieces.iter().copied();
        Ok(ContactLimit {
            joint: name.filter(|_| contact.named).cloned(),
            limit: lift_off(&machine, contact.joint, pieces, direction)?,
        })
    };
    mechanism.contacts().iter().map(limit).collect()
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
        let length = joints::size(&mechanism.joints(phi, &now)?, &now);
        for ((a, b), link) in now.iter().zip(&later).zip(mechanism.links()) {
            let speed = |frame: &Frame| {
                let [x, y] = frame.point(link.com());
                math::hypot(x.d1, y.d1)
            };
            most = most.max((speed(b) - speed(a)).abs() / length);
            most = most.max((b.psi.d1 - a.psi.d1).abs() / a.psi.d1.abs().max(1.0));
        }
    }
    Ok(Some(most))
}
