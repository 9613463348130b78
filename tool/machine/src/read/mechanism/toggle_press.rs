//! `type = "toggle-press"`: knuckle-joint press.

use jred::mechanism::{Branch, TogglePress, TogglePressDimensions};

use super::four_bar::{blocked, length, side};
use super::link;
use super::parts::slide;
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::LENGTH;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let item = section.require("pivot", "pivot = [\"-250 mm\", \"400 mm\"]")?;
    let pivot = item.pair([&LENGTH, &LENGTH])?.map(|value| value.si);
    let guide = section.quantity("guide", &LENGTH)?.si;
    let knee = side(section.get("knee"))?;
    let branch = match section.get("branch") {
        Some(item) if item.choice(&["right", "left"])? == 1 => Branch::Left,
        _ => Branch::Right,
    };
    let (crank, rod, upper, lower, ram) = (
        section.section("crank")?,
        section.section("rod")?,
        section.section("upper")?,
        section.section("lower")?,
        section.section("ram")?,
    );
    let (crank_length, lower_length) = (length(&crank)?, length(&lower)?);
    let dimensions = TogglePressDimensions {
        crank: crank_length.si,
        rod: length(&rod)?.si,
        upper: length(&upper)?.si,
        lower: lower_length.si,
        pivot,
        guide,
    };
    let links = [
        link(&crank)?,
        link(&rod)?,
        link(&upper)?,
        link(&lower)?,
        slide(&ram)?,
    ];
    let mechanism = TogglePress::new(dimensions, knee, branch, links)
        .map_err(|error| blocked(section, &crank_length, &lower_length, error))?;
    let names = ["crank", "rod", "upper", "lower", "ram"];
    let joints = [
        "crank pivot",
        "crank pin",
        "knuckle, rod",
        "upper pivot",
        "knuckle, lower link",
        "ram pin",
        "guide",
    ];
    Ok(
        AnyMechanism::new(super::TOGGLE_PRESS, mechanism, names, joints)
            .with_point("A", TogglePress::CRANK, [dimensions.crank, 0.0])
            .with_point("K", TogglePress::UPPER, [dimensions.upper, 0.0])
            .with_point("P", TogglePress::UPPER, [0.0, 0.0])
            .with_point("R", TogglePress::RAM, [0.0, 0.0]),
    )
}
