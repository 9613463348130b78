//! Site of the drive from the machine file: supply, surroundings, stiffness and tool.

use crate::model::operation::Duty;
use crate::model::supply::{MAINS_TOLERANCE, Supply, rectified};
use crate::model::surroundings::Surroundings;

/// The site of the drive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Site {
    /// Voltage of the DC bus (V); `None`: each motor at the voltage of its data sheet.
    pub bus_voltage: Option<f64>,
    /// Mains voltage from which the bus is rectified (V); `None`: not given, or the bus voltage is given directly.
    pub mains_voltage: Option<f64>,
    /// The rest of the supply.
    pub supply: Supply,
    /// Ambient conditions of the motor.
    pub surroundings: Surroundings,
    /// Operation: continuous, short-time or intermittent.
    pub duty: Duty,
    /// Emergency stops per hour by the brake alone; `None`: not given.
    pub emergency_stops: Option<f64>,
    /// Share of the motor's peak torque with which the drive stops the machine; `None`: such a stop is not judged.
    pub drive_stop: Option<f64>,
    /// Torsional stiffness of shafts and couplings, at the input of the drive train (N·m/rad); `None`: not given.
    pub shaft_stiffness: Option<f64>,
    /// Backlash of the drive train at the drive link (rad, or m of a sliding link); `None`: not given.
    pub train_play: Option<f64>,
    /// The tool for the backlash rule, if given.
    pub tool: Option<Tool>,
}

impl Site {
    /// Highest voltage of the DC bus without braking (V): the rectified mains at their upper tolerance, or the bus voltage if that is given directly.
    pub fn highest_supply(&self) -> Option<f64> {
        let mains = self
            .mains_voltage
            .map(|mains| MAINS_TOLERANCE * rectified(mains));
        mains.or(self.bus_voltage)
    }
}

/// The tool for the backlash rule, with its allowed backlash.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Name of the point or link.
    pub name: String,
    /// Index of the link.
    pub link: usize,
    /// The part of the link whose motion matters.
    pub place: ToolPlace,
    /// Largest backlash (m, or rad for a turning link).
    pub play: f64,
}

/// The part of the tool's link whose motion matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolPlace {
    /// A point of its frame (m).
    Point([f64; 2]),
    /// The rotation of the link.
    Turning,
}
