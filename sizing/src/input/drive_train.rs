//! `[[drive_train]]`: the fixed stages between the motor and the drive link.

use jred::mechanism::Train;

use super::problem::Result;
use super::section::Section;
use super::stage::{self, Losses};

/// One train of all tables, in order from the motor.
pub(super) fn read(root: &Section) -> Result<Train> {
    let mut stages = Vec::new();
    if let Some(item) = root.get("drive_train") {
        for section in item.sections("[[drive_train]]")? {
            let kind = section
                .require("type", "type = \"belt\"")?
                .choice(&["gear-train", "belt"])?;
            if kind == 0 {
                stages.extend(stage::gears(&section, Losses::Allowed)?);
            } else {
                stages.push(stage::belt(&section, Losses::Allowed)?);
            }
            let per_stage = |key: &str| {
                (key == "efficiency").then_some("in a gear train each stage has its own efficiency")
            };
            section.finish_with(per_stage)?;
        }
    }
    stage::train(stages)
}
