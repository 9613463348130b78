//! Stages of gear trains and belts, in the mechanism and in the drive train.

use std::ops::Range;

use jred::machine::MAX_STAGES;
use jred::mechanism::{BeltDimensions, GearDimensions, Mesh, Stage, Train};
use jred::number::RangeError;

use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{INERTIA, LENGTH, MASS, SHARE};

/// Whether a stage may have an efficiency.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Losses {
    /// In the mechanism: the reduction is lossless.
    None,
    /// In the drive train.
    Allowed,
}

/// A stage and its place in the file.
pub(super) struct Placed {
    stage: Stage,
    place: Range<usize>,
}

/// The stages of a table with `type = "gear-train"`.
pub(super) fn gears(section: &Section, losses: Losses) -> Result<Vec<Placed>> {
    let inner = section
        .title()
        .trim_start_matches('[')
        .split(']')
        .next()
        .unwrap_or_default();
    let title = format!("[[{inner}.stage]]");
    let item = section.require(
        "stage",
        &format!(
            "{title} with driver = {{ teeth = 18, inertia = \"2 kg cm^2\" }} and driven = {{ … }}"
        ),
    )?;
    let stages = item.sections(&title)?;
    if stages.is_empty() {
        return Err(item
            .problem("is empty", "here")
            .help("a gear train has at least one stage"));
    }
    stages
        .iter()
        .map(|stage| gear_pair(stage, losses))
        .collect()
}

fn gear_pair(section: &Section, losses: Losses) -> Result<Placed> {
    section.expects(&["driver", "driven"]);
    let (driver, driver_inertia) = gear(section, "driver")?;
    let (driven, driven_inertia) = gear(section, "driven")?;
    let mesh = match section.get("mesh") {
        Some(item) if item.choice(&["external", "internal"])? == 1 => Mesh::Internal,
        _ => Mesh::External,
    };
    let efficiency = efficiency(section, losses)?;
    finish(section, losses)?;
    Stage::gears(GearDimensions {
        teeth: [driver, driven],
        inertias: [driver_inertia, driven_inertia],
        mesh,
    })
    .and_then(|stage| stage.with_efficiency(efficiency))
    .map(|stage| Placed {
        stage,
        place: section.header(),
    })
    .map_err(|error| core(section, error))
}

fn gear(section: &Section, key: &'static str) -> Result<(u32, f64)> {
    let example = format!("{key} = {{ teeth = 18, inertia = \"2 kg cm^2\" }}");
    let gear = section
        .require(key, &example)?
        .section(format!("`{key}` of {}", section.title()))?;
    let teeth = gear.require("teeth", "teeth = 18")?.count(100_000, "18")?;
    let inertia = gear.quantity("inertia", &INERTIA)?.not_negative()?;
    gear.finish()?;
    Ok((teeth, inertia))
}

/// The stage of a table with `type = "belt"`.
pub(super) fn belt(section: &Section, losses: Losses) -> Result<Placed> {
    section.expects(&["driver", "driven"]);
    let (driver, driver_inertia) = pulley(section, "driver")?;
    let (driven, driven_inertia) = pulley(section, "driven")?;
    let mass = match section.optional("belt_mass", &MASS)? {
        Some(value) => value.not_negative()?,
        None => 0.0,
    };
    let efficiency = efficiency(section, losses)?;
    Stage::belt(BeltDimensions {
        radii: [driver, driven],
        inertias: [driver_inertia, driven_inertia],
        mass,
    })
    .and_then(|stage| stage.with_efficiency(efficiency))
    .map(|stage| Placed {
        stage,
        place: section.header(),
    })
    .map_err(|error| core(section, error))
}

/// The stage of a table with `type = "friction"`: a friction wheel, a V-belt or a disc, whose slip reduces the speed and thus the power. The torques
/// are in the ratio of the radii, so the efficiency is 1 − ε.
pub(super) fn friction(section: &Section) -> Result<Placed> {
    let item = section.require(
        "ratio",
        "ratio = 0.5, the output speed over the input speed without slip",
    )?;
    let ratio = item.number([-1e3, 1e3], "0.5")?;
    if ratio.abs() < 1e-3 {
        return Err(item
            .problem(&format!("is {ratio}, too close to zero"), "nothing turns")
            .help(
                "write the output speed over the input speed; negative if the direction reverses",
            ));
    }
    let slip = match section.get("slip") {
        Some(item) => super::variator::share(&item)?,
        None => 0.0,
    };
    let input = section
        .quantity("input_inertia", &INERTIA)?
        .not_negative()?;
    let output = section
        .quantity("output_inertia", &INERTIA)?
        .not_negative()?;
    Stage::new(1.0 / (ratio * (1.0 - slip)), [input, output])
        .and_then(|stage| stage.with_efficiency(1.0 - slip))
        .map(|stage| Placed {
            stage,
            place: section.header(),
        })
        .map_err(|error| core(section, error))
}

/// The stages with an additional inertia (kg·m²) after the last.
pub(super) fn with_load(mut stages: Vec<Placed>, inertia: f64) -> Result<Vec<Placed>> {
    if let Some(last) = stages.last_mut() {
        let [driver, driven] = last.stage.inertias();
        let efficiency = last.stage.efficiency();
        last.stage = Stage::new(last.stage.ratio(), [driver, driven + inertia])
            .and_then(|stage| stage.with_efficiency(efficiency))
            .map_err(Problem::of)?;
    }
    Ok(stages)
}

/// The stage of a table with `type = "ball-screw"`: 2π/lead (rad of the screw per m of the nut).
pub(super) fn screw(section: &Section) -> Result<Placed> {
    let lead = section.quantity("lead", &LENGTH)?.positive()?;
    let left = match section.get("hand") {
        Some(item) => item.choice(&["right", "left"])? == 1,
        None => false,
    };
    let ratio = std::f64::consts::TAU / lead;
    linear(section, if left { -ratio } else { ratio })
}

/// The stage of a table with `type = "rack"`: 1/radius (rad of the pinion per m of the rack).
pub(super) fn rack(section: &Section) -> Result<Placed> {
    let radius = section.quantity("radius", &LENGTH)?.positive()?;
    linear(section, 1.0 / radius)
}

/// A stage with the `ratio` (rad/m) from a rotating to a sliding part.
fn linear(section: &Section, ratio: f64) -> Result<Placed> {
    let inertia = section.quantity("inertia", &INERTIA)?.not_negative()?;
    let mass = match section.optional("mass", &MASS)? {
        Some(value) => value.not_negative()?,
        None => 0.0,
    };
    let efficiency = efficiency(section, Losses::Allowed)?;
    section.finish()?;
    Stage::new(ratio, [inertia, mass])
        .and_then(|stage| stage.with_efficiency(efficiency))
        .map(|stage| Placed {
            stage,
            place: section.header(),
        })
        .map_err(|error| core(section, error))
}

fn pulley(section: &Section, key: &'static str) -> Result<(f64, f64)> {
    let example = format!("{key} = {{ radius = \"40 mm\", inertia = \"6 kg cm^2\" }}");
    let pulley = section
        .require(key, &example)?
        .section(format!("`{key}` of {}", section.title()))?;
    if let Some(diameter) = pulley.peek("diameter") {
        return Err(diameter
            .problem(
                "is not used: a pulley is given by its radius",
                "remove this",
            )
            .help("give half the pitch diameter: radius = \"40 mm\""));
    }
    let radius = pulley.quantity("radius", &LENGTH)?.positive()?;
    let inertia = pulley.quantity("inertia", &INERTIA)?.not_negative()?;
    pulley.finish()?;
    Ok((radius, inertia))
}

fn efficiency(section: &Section, losses: Losses) -> Result<f64> {
    if losses == Losses::None {
        return Ok(1.0);
    }
    section
        .optional("efficiency", &SHARE)?
        .map_or(Ok(1.0), |value| value.up_to(1.0))
}

/// Reports unknown keys of a stage.
fn finish(section: &Section, losses: Losses) -> Result<()> {
    section.finish_with(|key| {
        (key == "efficiency" && losses == Losses::None)
            .then_some("efficiency belongs to [[drive_train]]")
    })
}

/// One train of all stages.
pub(super) fn train(stages: Vec<Placed>) -> Result<Train> {
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

fn core(section: &Section, error: RangeError) -> Problem {
    section.titled(error, "in this stage")
}
