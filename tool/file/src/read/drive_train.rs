//! `[[drive_train]]`: the fixed stages between the motor and the drive link.

use super::drive_link::DriveLink;
use super::names::Names;
use super::stage::{self, Losses};
use crate::model::drive_train::{Branch, DriveTrain};
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// The types of stage; the types from `FIRST_LINEAR` convert rotation into displacement.
const TYPES: [&str; 5] = ["gear-train", "belt", "friction", "ball-screw", "rack"];
const FIRST_LINEAR: usize = 3;

/// The most branches.
const MAX_BRANCHES: usize = 8;

/// One train of all tables, in order from the motor.
pub(super) fn read(root: &Section, drive: DriveLink) -> Result<DriveTrain> {
    let mut stages = Vec::new();
    let (mut branches, mut names) = (Vec::new(), Names::of("branches"));
    let mut linear: Option<(Item, &str)> = None;
    if let Some(item) = root.get("drive_train") {
        for section in root.tables("drive_train")? {
            let word = section.need("type")?;
            let kind = word.word()?;
            section.choose(TYPES[kind]);
            if let Some((before, name)) = &linear {
                return Err(word
                    .problem(
                        &format!("comes after a {name}, whose output slides"),
                        "nothing turns here",
                    )
                    .at(before.span(), "it slides from here on")
                    .help(format!("the {name} is the last stage: put it at the end")));
            }
            let before = stages.len();
            match kind {
                0 => stages.extend(stage::gears(&section, Losses::Allowed)?),
                1 => stages.push(stage::belt(&section, Losses::Allowed)?),
                2 => stages.push(stage::friction(&section)?),
                3 => stages.push(stage::screw(&section)?),
                _ => stages.push(stage::rack(&section)?),
            }
            if section.word("sense")? == 1 {
                stage::forward(&mut stages[before..])?;
            }
            if let Some(item) = section.get("branch") {
                for own in section.tables("branch")? {
                    names.add(&own)?;
                    let number = branches.len() + 1;
                    branches.push(branch(
                        &own,
                        number,
                        [before, stages.len()],
                        kind >= FIRST_LINEAR,
                    )?);
                }
                if branches.len() > MAX_BRANCHES {
                    let what = format!(
                        "is number {} of at most {MAX_BRANCHES} branches",
                        branches.len()
                    );
                    return Err(item
                        .problem(&what, "too many")
                        .help("combine branches: refer their inertias and torques to one shaft"));
                }
            }
            section.finish()?;
            if kind >= FIRST_LINEAR {
                linear = Some((word, TYPES[kind]));
            }
        }
        fits(&item, linear.as_ref(), drive, stages.is_empty())?;
    }
    DriveTrain::new(stage::train(stages)?, branches).map_err(Problem::of)
}

/// A shaft beside the chain, driven by the shaft before or after a stage.
fn branch(
    section: &Section,
    number: usize,
    [before, behind]: [usize; 2],
    slides: bool,
) -> Result<Branch> {
    let name = match section.text("name")? {
        Some(name) => name.to_owned(),
        None => format!("branch {number}"),
    };
    let driver = section.word("at")? == 1;
    if slides && !driver {
        return Err(section
            .problem(
                "this branch has no shaft to drive it: the part behind this stage slides",
                "slides",
            )
            .help("write at = \"driver\": the screw or the pinion drives the branch"));
    }
    let kind = section.word("type")?;
    section.choose(TYPES[kind]);
    let stages = match kind {
        0 => stage::gears(section, Losses::Allowed)?,
        1 => vec![stage::belt(section, Losses::Allowed)?],
        _ => vec![stage::friction(section)?],
    };
    let inertia = section.si("inertia")?;
    let (opposing, viscous) = (
        section.si("opposing_moment")?,
        section.si("viscous_moment")?,
    );
    section.finish()?;
    Ok(Branch {
        name,
        shaft: if driver { before } else { behind },
        train: stage::train(stage::with_load(stages, inertia)?)?,
        opposing,
        viscous,
    })
}

/// Checks that the last stage fits the motion of the drive link.
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
