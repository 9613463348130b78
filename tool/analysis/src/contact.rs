//! One-sided contacts: a follower presses on its cam, a rope pulls. Where the motion requires the opposite, the equations
//! still have a solution, but the real machine has lost contact.

mod over_motion;
mod words;

pub use over_motion::{ContactLoss, lost};

use jred::error::Error;
use jred::machine::{Machine, Mechanism as _};
use jred::mechanism::cam::{LiftOff, contact_force, lift_off};

use jred_file::model::coordinate::{Coordinate, positions};
use jred_file::model::mechanism::AnyMechanism;

/// A rope force above minus this value (N) is a rounding error, not slack.
const ROUNDING: f64 = 1e-6;

/// Number of positions at which a whole range is examined.
const POSITIONS: usize = 1440;

/// A joint that may separate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OneWay {
    /// Index of the joint.
    pub joint: usize,
    /// Whether it is a rope, which pulls; otherwise a cam contact, which presses.
    pub rope: bool,
}

/// A contact that has separated.
#[derive(Clone, Debug)]
pub struct Separation {
    /// Whether it is a rope.
    pub rope: bool,
    /// Name of the joint; `None` for the only cam contact of a mechanism.
    pub joint: Option<String>,
    /// Coordinate of the drive link.
    pub coordinate: Coordinate,
    /// Position of the drive link (rad, or m).
    pub phi: f64,
    /// Its speed (rad/s, or m/s).
    pub omega: f64,
    /// The required force (N), negative for a rope that would have to push.
    pub force: f64,
    /// The constant speed at which the follower of a cam that turns lifts off.
    pub lift_off: Option<LiftOff>,
}

impl OneWay {
    /// The one-way joints of a mechanism.
    pub fn all(mechanism: &AnyMechanism) -> Vec<Self> {
        let contacts = mechanism.contacts().iter().map(|contact| Self {
            joint: contact.joint,
            rope: false,
        });
        let ropes = mechanism
            .ropes()
            .iter()
            .map(|&joint| Self { joint, rope: true });
        contacts.chain(ropes).collect()
    }

    /// Force (N) of contact or rope at φ, ω, α; positive while contact is maintained.
    ///
    /// # Errors
    /// As [`contact_force`].
    pub fn force(
        self,
        machine: &Machine<AnyMechanism>,
        [phi, omega, alpha]: [f64; 3],
    ) -> Result<f64, Error> {
        Ok(contact_force(machine, self.joint, phi, omega, alpha)?)
    }

    /// A contact that separates somewhere in the range of the drive link at this speed and acceleration (rad/s, rad/s²; or m/s, m/s²), where its
    /// force is least.
    ///
    /// # Errors
    /// Errors of the machine.
    pub fn separation(
        machine: &Machine<AnyMechanism>,
        [omega, alpha]: [f64; 2],
    ) -> Result<Option<Separation>, Error> {
        for joint in Self::all(machine.mechanism()) {
            let mut worst = (f64::INFINITY, 0.0);
            for phi in positions(machine.mechanism().domain(), POSITIONS) {
                let force = joint.force(machine, [phi, omega, alpha])?;
                if force < worst.0 {
                    worst = (force, phi);
                }
            }
            let (force, phi) = worst;
            if !joint.holds(force) {
                return joint.parted(machine, [phi, omega], force).map(Some);
            }
        }
        Ok(None)
    }

    /// Whether contact is maintained at this force.
    pub fn holds(self, force: f64) -> bool {
        if self.rope {
            force >= -ROUNDING
        } else {
            force > 0.0
        }
    }

    /// The loss of contact at the state φ, ω with this force.
    ///
    /// # Errors
    /// Errors of the machine.
    pub fn parted(
        self,
        machine: &Machine<AnyMechanism>,
        [phi, omega]: [f64; 2],
        force: f64,
    ) -> Result<Separation, Error> {
        let mechanism = machine.mechanism();
        let coordinate = mechanism.coordinate();
        let mut contacts = mechanism.contacts().iter();
        let contact = contacts.find(|contact| !self.rope && contact.joint == self.joint);
        let is_named = contact.is_none_or(|contact| contact.named);
        let lift_off = match contact {
            Some(contact) if coordinate == Coordinate::Angle => {
                let bare = machine.clone().without_frictions();
                lift_off(&bare, self.joint, contact.pieces.iter().copied(), omega)?
            }
            _ => None,
        };
        let joint = mechanism.joint_names().get(self.joint);
        Ok(Separation {
            rope: self.rope,
            joint: joint.filter(|_| is_named).cloned(),
            coordinate,
            phi,
            omega,
            force,
            lift_off,
        })
    }
}
