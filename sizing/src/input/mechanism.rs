//! `[mechanism]`: what moves.

use jred::mechanism::{Branch, SliderCrank, Train};
use jred::{Error, Link};

use crate::machine::AnyMechanism;

use super::kind::{INERTIA, LENGTH, MASS};
use super::problem::Result;
use super::section::Section;
use super::stage::{self, Losses};

/// The mechanism and the inertia of its flywheel (kg·m²).
pub(super) fn read(section: &Section) -> Result<(AnyMechanism, f64)> {
    let types = ["slider-crank", "gear-train", "belt"];
    let kind = section
        .require("type", "type = \"slider-crank\"")?
        .choice(&types)?;
    let flywheel = match section.optional("flywheel", &INERTIA)? {
        Some(value) => value.not_negative()?,
        None => 0.0,
    };
    let mechanism = match kind {
        0 => AnyMechanism::SliderCrank(slider_crank(section)?),
        1 => AnyMechanism::Train(train(section, stage::gears(section, Losses::None)?)?),
        _ => AnyMechanism::Train(train(section, vec![stage::belt(section, Losses::None)?])?),
    };
    let elsewhere = |key: &str| match key {
        "efficiency" => Some("efficiency belongs to [[drive_train]]"),
        _ => None,
    };
    section.finish_with(elsewhere)?;
    Ok((mechanism, flywheel))
}

fn train(section: &Section, stages: Vec<stage::Placed>) -> Result<Train> {
    stage::train(stages).map_err(|problem| problem.at(section.header(), "in this mechanism"))
}

fn slider_crank(section: &Section) -> Result<SliderCrank> {
    let branches = ["right", "left"];
    let branch = match section.get("branch") {
        Some(item) if item.choice(&branches)? == 1 => Branch::Left,
        _ => Branch::Right,
    };
    let offset = section.optional("offset", &LENGTH)?;
    let (crank, rod, slider) = (
        section.section("crank")?,
        section.section("rod")?,
        section.section("slider")?,
    );
    let length = crank.quantity("length", &LENGTH)?.positive()?;
    let crank = link(&crank)?;
    let rod_length = rod.quantity("length", &LENGTH)?;
    rod_length.check_positive()?;
    let rod = link(&rod)?;
    let mass = slider.quantity("mass", &MASS)?.not_negative()?;
    let com = slider.point("com", &LENGTH)?;
    let turns = |key: &str| {
        (key == "inertia").then_some("the slider does not turn, so it has no moment of inertia")
    };
    slider.finish_with(turns)?;
    let slider = Link::new(mass, 0.0, com).map_err(|error| core(section, &error))?;
    let offset_si = offset.as_ref().map_or(0.0, |value| value.si);
    SliderCrank::new(length, rod_length.si, offset_si, branch, [crank, rod, slider]).map_err(|error| {
        let Error::CannotTurn { phi, shortest_rod } = error else {
            return core(section, &error);
        };
        let what = format!(
            "is too short for a full turn of the crank: it no longer reaches the guide at φ = {:.2}°",
            phi.to_degrees()
        );
        rod_length.problem(&what, "too short").help(format!(
            "make the rod longer than crank + |offset| = {}, or shorten the crank or the offset",
            rod_length.show(shortest_rod)
        ))
    })
}

/// Mass, moment of inertia and centre of mass of a crank or a rod.
fn link(section: &Section) -> Result<Link> {
    let mass = section.quantity("mass", &MASS)?.not_negative()?;
    let inertia = section.quantity("inertia", &INERTIA)?.not_negative()?;
    let com = section.point("com", &LENGTH)?;
    section.finish()?;
    Link::new(mass, inertia, com).map_err(|error| core(section, &error))
}

/// An error of the core that no key is known for.
fn core(section: &Section, error: &Error) -> super::problem::Problem {
    section.problem(format!("{}: {error}", section.title()), "in this table")
}
