//! One-sided contacts: a follower presses on its cam, a rope pulls. Where the motion requires the opposite, the equations
//! still have a solution, but the real machine has lost contact.

mod over_motion;

pub use over_motion::{ContactLoss, lost};

use std::f64::consts::TAU;

use jred::error::Error;
use jred::machine::{Machine, Mechanism as _};
use jred::mechanism::cam::{contact_force, lift_off};

use jred_file::model::coordinate::{Coordinate, positions};
use jred_file::model::mechanism::AnyMechanism;
use jred_file::number::rounding::figure;

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

/// A contact that has separated: where, and the cure.
#[derive(Clone, Debug)]
pub struct Separation {
    /// The contact that separates.
    pub what: String,
    /// Position and speed.
    pub state: String,
    /// The required force.
    pub force: String,
    /// Cure.
    pub cure: String,
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

    /// Warning about a contact that separates somewhere in the range of the drive link at this speed and acceleration (rad/s, rad/s²; or m/s, m/s²),
    /// for results computed as if it did not.
    ///
    /// # Errors
    /// Errors of the machine.
    pub fn warning(
        machine: &Machine<AnyMechanism>,
        [omega, alpha]: [f64; 2],
    ) -> Result<Option<String>, Error> {
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
                let parted = joint.parted(machine, [phi, omega], force)?;
                return Ok(Some(format!(
                    "warning: {} ({}): {}; results are valid only if contact is maintained by other means",
                    parted.what, parted.state, parted.force
                )));
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

    /// Why contact is lost at the state φ, ω with this force.
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
        let name = mechanism.joint_names().get(self.joint);
        let coordinate = mechanism.coordinate();
        let state = match coordinate {
            Coordinate::Length => format!("{}, {} m/s", coordinate.place(phi), figure(omega)),
            Coordinate::Angle => {
                let degrees = if self.rope { phi } else { phi.rem_euclid(TAU) }.to_degrees();
                format!("φ = {degrees:.2}°, {} rpm", figure(omega * 60.0 / TAU))
            }
        };
        if self.rope {
            return Ok(Separation {
                what: format!("the {} goes slack", name.map_or("rope", String::as_str)),
                state,
                force: format!(
                    "it would have to push with {} N, but a rope can only pull",
                    figure(-force)
                ),
                cure: "accelerate or brake more gently, or hang more weight on this rope"
                    .to_owned(),
            });
        }
        let joint = mechanism.contact_prefix(self.joint);
        Ok(Separation {
            what: format!("{joint}the follower leaves the cam"),
            state,
            force: format!("the contact force would be {} N", figure(force)),
            cure: self.cam_cure(machine, coordinate, omega)?,
        })
    }

    fn cam_cure(
        self,
        machine: &Machine<AnyMechanism>,
        coordinate: Coordinate,
        omega: f64,
    ) -> Result<String, Error> {
        const FORM: &str = "write closure = \"form\" for a grooved or conjugate cam, which guides the follower on both sides";
        if coordinate == Coordinate::Length {
            return Ok(format!(
                "use a stiffer spring, more preload or a slower motion; {FORM}"
            ));
        }
        let contacts = machine.mechanism().contacts();
        let Some(contact) = contacts.iter().find(|c| c.joint == self.joint) else {
            return Ok(FORM.to_owned());
        };
        let pieces = contact.pieces.iter().copied();
        let limit = lift_off(machine, self.joint, pieces, omega)?;
        let cure = limit.map_or_else(
            || "the follower would not lift off: accelerate more gently, or add preload".to_owned(),
            |limit| limit.to_string(),
        );
        Ok(format!("at constant speed: {cure}; {FORM}"))
    }
}
