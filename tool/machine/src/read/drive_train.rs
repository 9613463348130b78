//! `[[drive_train]]`: the fixed stages between the motor and the drive link.

use jred::mechanism::Train;

use super::drive_link::DriveLink;
use super::stage::{self, Losses};
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// The types of stage; those from `FIRST_LINEAR` on convert rotation into displacement.
const TYPES: [&str; 4] = ["gear-train", "belt", "ball-screw", "rack"];
const FIRST_LINEAR: usize = 2;

/// One train of all tables, in order from the motor.
pub(super) fn read(root: &Section, drive: DriveLink) -> Result<Train> {
    let mut stages = Vec::new();
    let mut linear: Option<(Item, &str)> = None;
    if let Some(item) = root.get("drive_train") {
        for section in item.sections("[[drive_train]]")? {
            let word = section.require("type", "type = \"belt\"")?;
            let kind = word.choice(&TYPES)?;
            if let Some((before, name)) = &linear {
                return Err(word
                    .problem(
                        &format!("comes after a {name}, whose output slides"),
                        "nothing turns here",
                    )
                    .at(before.span(), "it slides from here on")
                    .help(format!("the {name} is the last stage: put it at the end")));
            }
            match kind {
                0 => stages.extend(stage::gears(&section, Losses::Allowed)?),
                1 => stages.push(stage::belt(&section, Losses::Allowed)?),
                2 => stages.push(stage::screw(&section)?),
                _ => stages.push(stage::rack(&section)?),
            }
            let per_stage = |key: &str| {
                (key == "efficiency").then_some("in a gear train each stage has its own efficiency")
            };
            section.finish_with(per_stage)?;
            if kind >= FIRST_LINEAR {
                linear = Some((word, TYPES.get(kind).copied().unwrap_or_default()));
            }
        }
        fits(&item, linear.as_ref(), drive, stages.is_empty())?;
    }
    stage::train(stages)
}

/// The last stage moves as the drive link does.
fn fits(item: &Item, linear: Option<&(Item, &str)>, drive: DriveLink, empty: bool) -> Result<()> {
    match (linear, drive.slides()) {
        (Some((word, _)), false) => Err(word
            .problem(
                "converts rotation into displacement, but the drive link of this mechanism turns",
                "slides",
            )
            .help("use belts and gear trains; a screw or a rack is for a mechanism whose drive link slides")),
        (None, true) if !empty => Err(Problem::new(
            "the drive link slides, but every stage of [[drive_train]] turns",
        )
        .at(item.key_span(), "ends with a rotating shaft")
        .help(
            "end it with a stage that converts rotation into displacement: type = \"ball-screw\" with lead = \"10 \
             mm\", or type = \"rack\" with radius = \"30 mm\" of its pinion",
        )),
        _ => Ok(()),
    }
}
