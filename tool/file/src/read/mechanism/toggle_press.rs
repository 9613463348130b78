//! `type = "toggle-press"`: knuckle-joint press.

use jred::machine::PoseError;
use jred::mechanism::{Branch, BuildError, TogglePress, TogglePressDimensions};

use super::four_bar::{blocked, length, side};
use super::parts::slide;
use super::{link, stopped, stroke};
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
    let mechanism = match stroke(section)? {
        Some((item, stroke)) => TogglePress::over_stroke(dimensions, knee, branch, stroke, links)
            .map_err(|error| {
            // Joint 2 is the knuckle; there the rod pushes the upper link.
            let words = match error {
                BuildError::Pose(
                    PoseError::DeadPoint { joint: 2, .. }
                    | PoseError::CannotAssemble { joint: 2, .. },
                ) => [
                    "rod and upper link do not meet",
                    "rod and upper link are in line",
                ],
                _ => [
                    "the lower link does not reach the guide",
                    "the lower link is perpendicular to the guide",
                ],
            };
            stopped(section, &item, words, error)
        })?,
        None => TogglePress::new(dimensions, knee, branch, links)
            .map_err(|error| blocked(section, &crank_length, &lower_length, error))?,
    };
    let names = ["crank", "rod", "upper", "lower", "ram"];
    let joints = [
        "crank pivot",
        "crank pin",
        "knuckle of the rod",
        "upper pivot",
        "knuckle of the lower link",
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
