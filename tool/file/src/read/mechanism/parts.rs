//! Parts common to several mechanisms: links that only slide, and wheels that only turn.

use jred::Domain;
use jred::machine::{Link, MassProperties, Mechanism as _};

use super::core;
use crate::model::axis::Axis;
use crate::model::coordinate::Coordinate;
use crate::model::mechanism::AnyMechanism;
use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::section::Section;

/// A link that slides without turning. Other keys of the section must have been read before.
pub(super) fn slide(section: &Section) -> Result<Link> {
    let properties = MassProperties {
        mass: section.si("mass")?,
        inertia: 0.0,
        com: section.two("com")?,
    };
    section.finish()?;
    Link::new(properties).map_err(|error| core(section, error))
}

/// A link that slides, and the friction coefficient of its guide.
pub(super) fn guided(section: &Section) -> Result<(Link, f64)> {
    let friction = section.figure("friction")?;
    Ok((slide(section)?, friction))
}

/// A part that turns about its own axis through its centre of mass. Other keys of the section must have been read before.
pub(super) fn wheel(section: &Section) -> Result<Link> {
    let properties = MassProperties {
        mass: section.si("mass")?,
        inertia: section.si("inertia")?,
        com: [0.0, 0.0],
    };
    section.finish()?;
    Link::new(properties).map_err(|error| core(section, error))
}

/// The two ends of a stroke.
pub(in crate::read) fn ends(item: &Item) -> Result<[f64; 2]> {
    let [from, to] = item.values()?;
    if to.si - from.si >= to.kind.smallest {
        return Ok([from.si, to.si]);
    }
    let (from, to) = (from.shown(), to.shown());
    let what = format!("runs from {from} to {to}, which is zero or backwards");
    let example = item.line();
    Err(item
        .problem(&what, "check these ends")
        .help(format!("the second end must be the larger one: {example}")))
}

/// A linear axis on the `stroke` of link number `link` along x (0) or y (1), if the file gives one. The link's displacement must be proportional to
/// the drive link's.
pub(super) fn linear_stroke(
    section: &Section,
    mechanism: AnyMechanism,
    link: usize,
    axis: usize,
) -> Result<AnyMechanism> {
    let Some(item) = section.get("stroke") else {
        return Ok(mechanism.open_ended(link));
    };
    let ends = ends(&item)?;
    let frames = mechanism
        .frames(0.0)
        .map_err(|error| core(section, error))?;
    let Some(frame) = frames.get(link) else {
        return Ok(mechanism);
    };
    let way = [frame.x, frame.y][axis];
    let [a, b] = ends.map(|end| (end - way.value) / way.d1);
    let stroke = [a.min(b), a.max(b)];
    Domain::stroke(stroke[0], stroke[1]).map_err(|error| core(section, error))?;
    let along = Axis::new(Coordinate::Length, ["x", "y"][axis], [way.value, way.d1]);
    Ok(mechanism.on_stroke(stroke).with_axis(along))
}
