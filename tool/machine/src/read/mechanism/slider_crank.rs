//! `type = "slider-crank"`.

use jred::Link;
use jred::machine::MassProperties;
use jred::mechanism::{Blocked, Branch, BuildError, SliderCrank, SliderCrankDimensions};

use crate::model::mechanism::AnyMechanism;

use super::{core, link};
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::{LENGTH, MASS};

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
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
    let slider = Link::new(MassProperties {
        mass,
        inertia: 0.0,
        com,
    })
    .map_err(|error| core(section, error))?;
    let dimensions = SliderCrankDimensions {
        crank: length,
        rod: rod_length.si,
        offset: offset.as_ref().map_or(0.0, |value| value.si),
    };
    let mechanism = SliderCrank::new(dimensions, branch, [crank, rod, slider]).map_err(|error| {
        let BuildError::Blocked(Blocked::TooShort { phi, shortest, .. }) = error else {
            return core(section, error);
        };
        let what = format!(
            "is too short for a full turn of the crank: it does not reach the guide at φ = {:.2}°",
            phi.to_degrees()
        );
        // It reaches the guide just so, and could fold there or go on.
        let through = if rod_length.si >= shortest * (1.0 - 1e-9) {
            "; if something guides it through this change point, describe it as type = \"linkage\" with keep_branch = true"
        } else {
            ""
        };
        rod_length.problem(&what, "too short").help(format!(
            "make the rod longer than crank + |offset| = {}, or reduce the crank or the offset{through}",
            rod_length.show(shortest)
        ))
    })?;
    let links = ["crank", "rod", "slider"];
    let joints = ["crank pivot", "crank pin", "slider pin", "guide"];
    Ok(
        AnyMechanism::new(super::SLIDER_CRANK, mechanism, links, joints)
            .with_point("A", SliderCrank::CRANK, [length, 0.0])
            .with_point("B", SliderCrank::SLIDER, [0.0, 0.0]),
    )
}
