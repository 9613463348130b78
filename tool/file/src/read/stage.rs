//! Stages of gear trains and belts, in the mechanism and in the drive train.

use std::ops::Range;

use jred::machine::MAX_STAGES;
use jred::mechanism::{BeltDimensions, GearDimensions, Mesh, Stage, Train};
use jred::number::RangeError;

use super::variator::share;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// Whether a stage may have an efficiency.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Losses {
    /// In the mechanism: the reduction is lossless.
    None,
    /// In the drive train.
    Allowed,
}

/// A stage and its place in the file.
pub(super) struct StageEntry {
    stage: Stage,
    place: Range<usize>,
}

/// The stages of a table with `type = "gear-train"`.
pub(super) fn gears(section: &Section, losses: Losses) -> Result<Vec<StageEntry>> {
    let stages = section.tables("stage")?;
    stages
        .iter()
        .map(|stage| gear_pair(stage, losses))
        .collect()
}

fn gear_pair(section: &Section, losses: Losses) -> Result<StageEntry> {
    let [driver, driven] = [gear(section, "driver")?, gear(section, "driven")?];
    let mesh = section.pick("mesh", [Mesh::External, Mesh::Internal])?;
    let efficiency = efficiency(section, losses)?;
    section.finish()?;
    let stage = Stage::gears(GearDimensions {
        teeth: [driver.0, driven.0],
        inertias: [driver.1, driven.1],
        mesh,
    });
    entry(section, stage, efficiency)
}

fn gear(section: &Section, key: &'static str) -> Result<(u32, f64)> {
    let gear = section.table(key)?;
    let found = (gear.whole("teeth")?, gear.si("inertia")?);
    gear.finish()?;
    Ok(found)
}

/// The stage of a table with `type = "belt"`.
pub(super) fn belt(section: &Section, losses: Losses) -> Result<StageEntry> {
    let [driver, driven] = [pulley(section, "driver")?, pulley(section, "driven")?];
    let mass = section.si("belt_mass")?;
    let efficiency = efficiency(section, losses)?;
    let stage = Stage::belt(BeltDimensions {
        radii: [driver.0, driven.0],
        inertias: [driver.1, driven.1],
        mass,
    });
    entry(section, stage, efficiency)
}

/// The stage of a table with `type = "friction"`: a friction wheel, a V-belt or a disc, whose slip reduces the speed and thus the power. The torques
/// are in the ratio of the radii, so the efficiency is 1 − ε.
pub(super) fn friction(section: &Section) -> Result<StageEntry> {
    let item = section.need("ratio")?;
    let ratio = item.figure()?;
    if ratio.abs() < 1e-3 {
        return Err(item
            .problem(&format!("is {ratio}, too close to zero"), "nothing turns")
            .help(
                "write the output speed over the input speed; negative if the direction reverses",
            ));
    }
    let slip = section.get("slip").map_or(Ok(0.0), |item| share(&item))?;
    let (input, output) = (section.si("input_inertia")?, section.si("output_inertia")?);
    let stage = Stage::new(1.0 / (ratio * (1.0 - slip)), [input, output]);
    entry(section, stage, 1.0 - slip)
}

/// The stages with an additional inertia (kg·m²) after the last.
pub(super) fn with_load(mut stages: Vec<StageEntry>, inertia: f64) -> Result<Vec<StageEntry>> {
    if let Some(last) = stages.last_mut() {
        let [driver, driven] = last.stage.inertias();
        let efficiency = last.stage.efficiency();
        last.stage = Stage::new(last.stage.ratio(), [driver, driven + inertia])
            .and_then(|stage| stage.with_efficiency(efficiency))
            .map_err(Problem::of)?;
    }
    Ok(stages)
}

/// Lets the outputs of the stages turn as their inputs do: the sign of their ratios does not matter.
pub(super) fn forward(stages: &mut [StageEntry]) -> Result<()> {
    for entry in stages {
        let stage = &entry.stage;
        entry.stage = Stage::new(stage.ratio().abs(), stage.inertias())
            .and_then(|forward| forward.with_efficiency(stage.efficiency()))
            .map_err(Problem::of)?;
    }
    Ok(())
}

/// The stage of a table with `type = "ball-screw"`: 2π/lead (rad of the screw per m of the nut).
pub(super) fn screw(section: &Section) -> Result<StageEntry> {
    let lead = section.si("lead")?;
    let left = section.word("hand")? == 1;
    let ratio = std::f64::consts::TAU / lead;
    linear(section, if left { -ratio } else { ratio })
}

/// The stage of a table with `type = "rack"`: 1/radius (rad of the pinion per m of the rack).
pub(super) fn rack(section: &Section) -> Result<StageEntry> {
    let radius = section.si("radius")?;
    linear(section, 1.0 / radius)
}

/// A stage with the `ratio` (rad/m) from a rotating to a sliding part.
fn linear(section: &Section, ratio: f64) -> Result<StageEntry> {
    let (inertia, mass) = (section.si("inertia")?, section.si("mass")?);
    let efficiency = efficiency(section, Losses::Allowed)?;
    entry(section, Stage::new(ratio, [inertia, mass]), efficiency)
}

fn pulley(section: &Section, key: &'static str) -> Result<(f64, f64)> {
    let pulley = section.table(key)?;
    let found = (pulley.si("radius")?, pulley.si("inertia")?);
    pulley.finish()?;
    Ok(found)
}

fn efficiency(section: &Section, losses: Losses) -> Result<f64> {
    match losses {
        Losses::None => Ok(1.0),
        Losses::Allowed => section.si("efficiency"),
    }
}

/// One train of all stages.
pub(super) fn train(stages: Vec<StageEntry>) -> Result<Train> {
    if let Some(surplus) = stages.get(MAX_STAGES) {
        let most = MAX_STAGES;
        return Err(
            Problem::new(format!("more than {most} stages one after another"))
                .at(
                    surplus.place.clone(),
                    format!("stage {} of {}", most + 1, stages.len()),
                )
                .help(
                    "combine stages: multiply their ratios and refer their inertias to one shaft",
                ),
        );
    }
    let stages: Vec<Stage> = stages.into_iter().map(|placed| placed.stage).collect();
    Train::new(&stages).map_err(Problem::of)
}

/// The stage of this table, with its efficiency.
fn entry(
    section: &Section,
    stage: Result<Stage, RangeError>,
    efficiency: f64,
) -> Result<StageEntry> {
    let stage = stage.and_then(|stage| stage.with_efficiency(efficiency));
    Ok(StageEntry {
        stage: stage.map_err(|error| section.titled(error, "in this stage"))?,
        place: section.header(),
    })
}
