//! The request.

use jred::error::Error;
use jred::machine::Machine;

use crate::choice::{LayoutChoice, LayoutName, Number};
use crate::cost::Core;
use jred_file::model::machine::MachineFile;
use jred_file::model::mechanism::AnyMechanism;

/// The request. At least one of torque error and bytes is given; bytes only without edges.
#[derive(Clone, Debug)]
pub struct Task {
    /// Number type.
    pub number: Number,
    /// Layout.
    pub layout: LayoutChoice,
    /// The core that the firmware runs on: of the layouts that meet the error, one with the fewest instructions there is chosen.
    pub core: Core,
    /// Whether the firmware also needs accelerations.
    pub forward: bool,
    /// Whether fixed-point tables get the curve of 1/J.
    pub reciprocal: bool,
    /// Largest error of the drive torque (N·m, or N); without it, the least possible one.
    pub torque_error: Option<f64>,
    /// Most bytes of the image.
    pub max_bytes: Option<u32>,
    /// Largest number of cells to try.
    pub max_cells: u32,
    /// Largest speed (rad/s, or m/s).
    pub omega: f64,
    /// Largest acceleration (rad/s², or m/s²).
    pub alpha: f64,
    /// Inertia of rotor and gearbox at the input of the drive train (kg·m²).
    pub rotor: f64,
    /// Borders of pieces with a table each (rad, or m); empty for one table of the whole range.
    pub edges: Vec<f64>,
    /// Identifier of the machine in the image; if not given, derived from the title.
    pub machine: Option<u32>,
}

impl Task {
    /// Whether this type and layout are requested.
    pub(crate) fn asks(&self, number: Number, layout: LayoutName) -> bool {
        number == self.number && self.layout.allows(layout)
    }

    /// The machine with its drive train and with the rotor.
    pub(crate) fn whole_machine(&self, file: &MachineFile) -> Result<Machine<AnyMechanism>, Error> {
        let ratio = file.drive_train.ratio();
        let machine = file.with_drive_train()?;
        Ok(machine.with_flywheel(self.rotor * ratio * ratio)?)
    }
}
