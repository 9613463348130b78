//! A drive: a motor, alone or with a gearbox, at the input of the machine's drive train.

use super::pairing::of_one_maker;
use super::{Amplifier, Gearbox, Motor};

/// A candidate: motor and, unless it is directly coupled, gearbox.
#[derive(Clone, Copy, Debug)]
pub struct Drive<'c> {
    /// The motor.
    pub motor: &'c Motor,
    /// The gearbox; `None`: directly coupled.
    pub gearbox: Option<&'c Gearbox>,
    /// The servo amplifier; `None`: no amplifier chosen.
    pub amplifier: Option<&'c Amplifier>,
}

/// Identifies a drive of a catalogue by the indices of motor, gearbox and amplifier, packed because a selection keeps one for every drive. Ids rise
/// in the order of [`Catalogue::drives`](super::Catalogue::drives).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct DriveId(u64);

/// Bits of the index of an amplifier and of a gearbox; the remaining bits are for the motor.
const AMPLIFIER: u32 = 16;
const GEARBOX: u32 = 24;

impl DriveId {
    /// `amplifier` is its index among the amplifiers of the motor.
    pub(super) const fn new(motor: usize, gearbox: Option<usize>, amplifier: usize) -> Self {
        let gearbox = match gearbox {
            Some(index) => index as u64 + 1,
            None => 0,
        };
        debug_assert!(gearbox >> GEARBOX == 0 && amplifier >> AMPLIFIER == 0);
        Self((motor as u64) << (GEARBOX + AMPLIFIER) | gearbox << AMPLIFIER | amplifier as u64)
    }

    /// Index of the motor.
    pub const fn motor(self) -> usize {
        (self.0 >> (GEARBOX + AMPLIFIER)) as usize
    }

    /// Index of the gearbox; `None`: directly coupled.
    pub const fn gearbox(self) -> Option<usize> {
        let gearbox = self.0 >> AMPLIFIER & ((1 << GEARBOX) - 1);
        (gearbox as usize).checked_sub(1)
    }
}

/// Value of a part, zero without the part; `None` if not given.
fn part<T>(part: Option<&T>, of: impl Fn(&T) -> Option<f64>) -> Option<f64> {
    part.map_or(Some(0.0), of)
}

/// The sum; `None` if a part has no data.
fn sum(parts: [Option<f64>; 3]) -> Option<f64> {
    parts.into_iter().sum()
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

    /// Whether all its figures come from its makers' own documents.
    pub fn from_makers(&self) -> bool {
        self.motor.from_maker
            && self.gearbox.is_none_or(|gearbox| gearbox.from_maker)
            && self.amplifier.is_none_or(|amplifier| amplifier.from_maker)
    }

    /// Whether the amplifier is known to be made for the motor: a list of the catalogue names it, or both are from one maker.
    pub fn is_paired(&self) -> bool {
        self.motor.amplifiers_listed
            || (self.amplifier).is_none_or(|amplifier| of_one_maker(self.motor, amplifier))
    }

    /// Mass of motor, gearbox and amplifier (kg); `None` if one has no data.
    pub fn mass(&self) -> Option<f64> {
        sum([
            self.motor.mass,
            part(self.gearbox, |g| g.mass),
            part(self.amplifier, |a| a.mass),
        ])
    }

    /// Price of motor, gearbox and amplifier, in the currency of the catalogue; `None` if one has no data.
    pub fn price(&self) -> Option<f64> {
        sum([
            self.motor.price,
            part(self.gearbox, |g| g.price),
            part(self.amplifier, |a| a.price),
        ])
    }

    /// Inertia of the rotor with its brake (kg·m²).
    pub fn rotor(&self) -> f64 {
        self.motor.rotor_with_brake()
    }
}
