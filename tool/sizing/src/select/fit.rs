//! Motors that fit the machine's input: turning ones, or linear ones.

use miette::{IntoDiagnostic as _, Result, miette};

use crate::catalogue::{Catalogue, MotorKind};
use jred_machine::model::coordinate::Coordinate;
use jred_machine::model::machine::MachineFile;

/// What the machine is driven by at its input: a drive link that slides, without a drive train, takes a linear motor.
///
/// # Errors
/// The mechanism cannot be placed.
pub fn input_kind(file: &MachineFile) -> Result<MotorKind> {
    let coordinate = Coordinate::of(file.machine.mechanism()).into_diagnostic()?;
    if coordinate == Coordinate::Angle || !file.drive_train.stages().is_empty() {
        Ok(MotorKind::Rotary)
    } else {
        Ok(MotorKind::Linear)
    }
}

/// Leaves the motors that fit the machine's input: turning ones, or linear ones.
///
/// # Errors
/// There are none.
pub fn fit_input(catalogue: &mut Catalogue, file: &MachineFile) -> Result<()> {
    let kind = input_kind(file)?;
    catalogue.keep_kind(kind);
    if !catalogue.motors.is_empty() {
        return Ok(());
    }
    Err(match kind {
        MotorKind::Linear => miette!(
            help = "give a catalogue with linear motors (docs/catalogue.md: kind = linear), or add what turns the rotation \
                    into a displacement: [[drive_train]] with type = \"ball-screw\" and lead = \"10 mm\", or type = \"rack\" \
                    and the radius of its pinion; `jred reduce --over time` gives the force itself",
            "the drive link slides, and the motors of the catalogue turn: it holds no linear motor"
        ),
        MotorKind::Rotary => miette!(
            help = "give a catalogue with motors that turn",
            "the input of the machine turns, and the catalogue holds linear motors only"
        ),
    })
}
