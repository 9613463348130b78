//! `type = "gear-train"` and `type = "belt"`: shafts coupled by constant ratios.

use jred::machine::Mechanism as _;

use crate::model::mechanism::AnyMechanism;
use crate::read::stage;
use crate::read::stage::{Losses, StageEntry};
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read_gears(section: &Section) -> Result<AnyMechanism> {
    train(section, stage::gears(section, Losses::None)?)
}

pub(super) fn read_belt(section: &Section) -> Result<AnyMechanism> {
    train(section, vec![stage::belt(section, Losses::None)?])
}

fn train(section: &Section, stages: Vec<StageEntry>) -> Result<AnyMechanism> {
    let train = stage::train(stages)
        .map_err(|problem| problem.at(section.header(), "in this mechanism"))?;
    let shafts = train.links().len();
    let links = (1..=shafts).map(|k| format!("shaft-{k}"));
    let bearings = (1..=shafts).map(|k| format!("bearings of shaft-{k}"));
    let meshes = (1..shafts).map(|k| format!("stage {k}"));
    Ok(AnyMechanism::new(
        section.chosen(),
        train,
        links,
        bearings.chain(meshes),
    ))
}
