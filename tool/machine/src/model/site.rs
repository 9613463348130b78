//! Where the drive is to stand: supply, surroundings, and what the machine says about its stiffness and its tool. All of it
//! comes from the machine file.

use crate::model::operation::Duty;
use crate::model::supply::Supply;
use crate::model::surroundings::Surroundings;

/// The surroundings of the drive.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Site {
    /// Voltage of the DC bus (V); `None`: each motor at the voltage of its data sheet.
    pub bus_voltage: Option<f64>,
    /// The rest of the supply.
    pub supply: Supply,
    /// What the motor is cooled by.
    pub surroundings: Surroundings,
    /// How the cycle is run: without end, or with rests.
    pub duty: Duty,
    /// Torsional stiffness of shafts and couplings, at the input of the drive train (N·m/rad); `None`: not given.
    pub shaft_stiffness: Option<f64>,
    /// Play of the drive train at the drive link (rad, or m of a link that slides); `None`: not given.
    pub train_play: Option<f64>,
    /// Where play matters; `None`: nowhere.
    pub tool: Option<Tool>,
}

/// Where play matters, and how much of it is allowed.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Name of the point or link.
    pub name: String,
    /// Index of the link.
    pub link: usize,
    /// What of the link moves.
    pub place: ToolPlace,
    /// Largest play (m, or rad where the link turns).
    pub play: f64,
}

/// What of the tool's link moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolPlace {
    /// A point of its frame (m).
    Point([f64; 2]),
    /// The link as a whole turns.
    Turning,
}
