//! A drive: a motor, alone or with a gearbox, at the input of the machine's drive train.

use super::{Amplifier, Gearbox, Motor};

/// A candidate: motor and, unless it is directly coupled, gearbox.
#[derive(Clone, Copy, Debug)]
pub struct Drive<'c> {
    /// The motor.
    pub motor: &'c Motor,
    /// The gearbox; `None`: directly coupled.
    pub gearbox: Option<&'c Gearbox>,
    /// The servo amplifier; `None`: not chosen.
    pub amplifier: Option<&'c Amplifier>,
}

impl Drive<'_> {
    /// Gear ratio between motor and drive train.
    pub fn ratio(&self) -> f64 {
        self.gearbox.map_or(1.0, |g| g.ratio)
    }

    /// Name for tables.
    pub fn name(&self) -> String {
        let mut name = match self.gearbox {
            Some(gearbox) => format!("{} + {}", self.motor.key, gearbox.key),
            None => format!("{}, direct", self.motor.key),
        };
        if let Some(amplifier) = self.amplifier {
            name += " on ";
            name += &amplifier.key;
        }
        name
    }

    /// Inertia of the rotor with its brake (kg·m²).
    pub fn rotor(&self) -> f64 {
        self.motor.rotor_with_brake()
    }
}
