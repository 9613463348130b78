//! `type = "six-link"`: crank, block, slotted rocker, rod and slider.

use jred::mechanism::{Branch, SixLink, SixLinkDimensions};

use super::four_bar::{blocked, length};
use super::parts::slide;
use super::{ROD, link, stopped, stroke};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::LENGTH;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let centres = section.quantity("centres", &LENGTH)?.positive()?;
    let guide = section
        .optional("guide", &LENGTH)?
        .map_or(0.0, |value| value.si);
    let branch = match section.get("branch") {
        Some(item) if item.choice(&["right", "left"])? == 1 => Branch::Left,
        _ => Branch::Right,
    };
    let (crank, block, rocker, rod, slider) = (
        section.section("crank")?,
        section.section("block")?,
        section.section("rocker")?,
        section.section("rod")?,
        section.section("slider")?,
    );
    let crank_length = length(&crank)?;
    let (rocker_length, rod_length) = (length(&rocker)?, length(&rod)?);
    let dimensions = SixLinkDimensions {
        crank: crank_length.si,
        rocker: rocker_length.si,
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
    Ok(AnyMechanism::new(super::SIX_LINK, mechanism, names, joints)
        .with_point("A", SixLink::CRANK, [dimensions.crank, 0.0])
        .with_point("B", SixLink::ROCKER, [dimensions.rocker, 0.0])
        .with_point("C", SixLink::SLIDER, [0.0, 0.0]))
}
