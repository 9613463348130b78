//! The voltage of the supply against the largest voltage that motor and amplifier are made for.
//!
//! Figure: the highest voltage of the DC bus from the supply, rectified mains at their upper tolerance. Rating: the voltage of the data sheet
//! ([`Motor::made_for`]). The rule for the bus voltage judges the additional rise by braking.

use crate::catalogue::{Amplifier, Motor};
use jred_file::model::rules::Finding;
use jred_file::model::site::Site;

/// The findings of a motor on an amplifier at a supply; neither depends on the rest of the drive.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Voltages {
    /// The motor at the machine file's supply, else at the amplifier's.
    pub(crate) motor: Finding,
    /// The amplifier at the machine file's supply; `None` without an amplifier.
    pub(crate) amplifier: Option<Finding>,
}

impl Voltages {
    pub(crate) fn new(motor: &Motor, amplifier: Option<&Amplifier>, site: &Site) -> Self {
        let plant = site.highest_supply();
        let supply = plant.or_else(|| amplifier?.highest_supply());
        let against =
            |supply: Option<f64>, largest| Finding::against(supply.unwrap_or(f64::NAN), largest);
        Self {
            motor: against(supply, motor.made_for().map(|made| made.largest)),
            amplifier: amplifier
                .map(|amplifier| against(plant, amplifier.made_for().map(|made| made.largest))),
        }
    }
}
