//! `type = "toggle-press"`: knuckle-joint press.

use jred::machine::PoseError;
use jred::mechanism::{Branch, BuildError, Side, TogglePress, TogglePressDimensions};

use super::four_bar::blocked;
use super::parts::slide;
use super::{link, stopped, stroke};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let (pivot, guide) = (section.two("pivot")?, section.si("guide")?);
    let knee = section.pick("knee", [Side::Left, Side::Right])?;
    let branch = section.pick("branch", [Branch::Right, Branch::Left])?;
    let crank = section.table("crank")?;
    let rod = section.table("rod")?;
    let upper = section.table("upper")?;
    let lower = section.table("lower")?;
    let ram = section.table("ram")?;
    let (crank_length, lower_length) = (crank.value("length")?, lower.value("length")?);
    let dimensions = TogglePressDimensions {
        crank: crank_length.si,
        rod: rod.si("length")?,
        upper: upper.si("length")?,
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
        AnyMechanism::new(section.chosen(), mechanism, names, joints)
            .with_point("A", TogglePress::CRANK, [dimensions.crank, 0.0])
            .with_point("K", TogglePress::UPPER, [dimensions.upper, 0.0])
            .with_point("P", TogglePress::UPPER, [0.0, 0.0])
            .with_point("R", TogglePress::RAM, [0.0, 0.0]),
    )
}
