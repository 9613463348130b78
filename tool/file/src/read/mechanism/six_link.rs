//! `type = "six-link"`: crank, block, slotted rocker, rod and slider.

use jred::mechanism::{Branch, SixLink, SixLinkDimensions};

use super::four_bar::blocked;
use super::parts::slide;
use super::{ROD, link, stopped, stroke};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let (centres, guide) = (section.si("centres")?, section.si("guide")?);
    let branch = section.pick("branch", [Branch::Right, Branch::Left])?;
    let crank = section.table("crank")?;
    let block = section.table("block")?;
    let rocker = section.table("rocker")?;
    let rod = section.table("rod")?;
    let slider = section.table("slider")?;
    let crank_length = crank.value("length")?;
    let (rocker_length, rod_length) = (rocker.si("length")?, rod.value("length")?);
    let dimensions = SixLinkDimensions {
        crank: crank_length.si,
        rocker: rocker_length,
        rod: rod_length.si,
        centres,
        // The core measures the guide downwards, as the published equations do.
        below: -guide,
    };
    let links = [
        link(&crank)?,
        link(&block)?,
        link(&rocker)?,
        link(&rod)?,
        slide(&slider)?,
    ];
    let mechanism = match stroke(section)? {
        Some((item, stroke)) => SixLink::over_stroke(dimensions, branch, stroke, links)
            .map_err(|error| stopped(section, &item, ROD, error))?,
        None => SixLink::new(dimensions, branch, links)
            .map_err(|error| blocked(section, &crank_length, &rod_length, error))?,
    };
    let names = ["crank", "block", "rocker", "rod", "slider"];
    let joints = [
        "crank pivot",
        "crank pin",
        "slot",
        "rocker pivot",
        "rocker pin",
        "slider pin",
        "guide",
    ];
    Ok(
        AnyMechanism::new(section.chosen(), mechanism, names, joints)
            .with_point("A", SixLink::CRANK, [dimensions.crank, 0.0])
            .with_point("B", SixLink::ROCKER, [dimensions.rocker, 0.0])
            .with_point("C", SixLink::SLIDER, [0.0, 0.0]),
    )
}
