//! Site of the drive from the machine file: supply, surroundings, stiffness and tool.

use crate::model::operation::Duty;
use crate::model::supply::{MAINS_TOLERANCE, Supply, rectified};
use crate::model::surroundings::Surroundings;

/// The surroundings of the drive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Site {
    /// Voltage of the DC bus (V); `None`: each motor at the voltage of its data sheet.
    pub bus_voltage: Option<f64>,
    /// Voltage of the mains that the bus is rectified from (V); `None`: not given, or the bus voltage was given itself.
    pub mains_voltage: Option<f64>,
    /// The rest of the supply.
    pub supply: Supply,
    /// Ambient conditions of the motor.
    pub surroundings: Surroundings,
    /// Operation: continuous, short-time or intermittent.
    pub duty: Duty,
    /// Torsional stiffness of shafts and couplings, at the input of the drive train (N·m/rad); `None`: not given.
    pub shaft_stiffness: Option<f64>,
    /// Play of the drive train at the drive link (rad, or m of a link that slides); `None`: not given.
    pub train_play: Option<f64>,
    /// The tool, where backlash matters; `None`: none.
    pub tool: Option<Tool>,
}

impl Site {
    /// Highest voltage of the DC bus without braking (V): the rectified mains at the upper end of their tolerance, or the bus
    /// voltage where that was given itself.
    pub fn highest_supply(&self) -> Option<f64> {
        let mains = self
            .mains_voltage
            .map(|mains| MAINS_TOLERANCE * rectified(mains));
        mains.or(self.bus_voltage)
    }
}

/// The tool: where backlash matters, and how much is allowed.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Name of the point or link.
    pub name: String,
    /// Index of the link.
    pub link: usize,
    /// The part of the link whose motion matters.
    pub place: ToolPlace,
    /// Largest play (m, or rad where the link turns).
    pub play: f64,
}

/// The part of the tool's link whose motion matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolPlace {
    /// A point of its frame (m).
    Point([f64; 2]),
    /// The link as a whole turns.
    Turning,
}
