//! Motors that fit the machine's input: rotary or linear.

use jred_file::problem;
use jred_file::text::problem::Result;

use crate::catalogue::{Catalogue, MotorKind};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;

/// Kind of motor at the input: a sliding drive link without a drive train needs a linear motor.
pub fn input_kind(file: &MachineFile) -> MotorKind {
    let coordinate = file.machine.mechanism().coordinate();
    if coordinate == Coordinate::Angle || !file.drive_train.stages().is_empty() {
        MotorKind::Rotary
    } else {
        MotorKind::Linear
    }
}

/// Keeps only the motors for the input of the machine: rotary or linear.
///
/// # Errors
/// The catalogue has no such motor.
pub fn fit_input(catalogue: &mut Catalogue, file: &MachineFile) -> Result<()> {
    let kind = input_kind(file);
    catalogue.keep_kind(kind);
    if !catalogue.motors.is_empty() {
        return Ok(());
    }
    Err(match kind {
        MotorKind::Linear => problem!(
            help = "give a catalogue with linear motors (docs/catalogue.md: kind = linear), or add a stage that \
                    converts rotation into displacement: [[drive_train]] with type = \"ball-screw\" and lead = \"10 \
                    mm\", or type = \"rack\" and the radius of its pinion; `jred reduce --over time` shows the \
                    required force",
            "the drive link slides, but the catalogue contains rotary motors only"
        ),
        MotorKind::Rotary => problem!(
            help = "give a catalogue with rotary motors",
            "the input of the machine turns, but the catalogue contains linear motors only"
        ),
    })
}
