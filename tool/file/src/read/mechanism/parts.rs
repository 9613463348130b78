//! Parts common to several mechanisms: links that only slide, and wheels that only turn.

use jred::Domain;
use jred::machine::{Link, MassProperties, Mechanism as _};

use super::core;
use crate::model::axis::Axis;
use crate::model::coordinate::Coordinate;
use crate::model::mechanism::AnyMechanism;
use crate::text::item::{Item, Value};
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::{INERTIA, Kind, LENGTH, MASS};

/// Largest friction coefficient of a guide.
const MOST_FRICTION: f64 = 2.0;

/// Mass and centre of mass of a link that slides without turning. Other keys of the section must have been read before.
pub(super) fn slide(section: &Section) -> Result<Link> {
    let mass = section.quantity("mass", &MASS)?.not_negative()?;
    let com = section.point("com", &LENGTH)?;
    let turns = |key: &str| {
        (key == "inertia").then_some("this part does not turn, so it has no moment of inertia")
    };
    section.finish_with(turns)?;
    Link::new(MassProperties {
        mass,
        inertia: 0.0,
        com,
    })
    .map_err(|error| core(section, error))
}

/// A link that slides, and the friction coefficient of its guide.
pub(super) fn guided(section: &Section) -> Result<(Link, f64)> {
    let friction = section
        .get("friction")
        .map_or(Ok(0.0), |item| item.number([0.0, MOST_FRICTION], "0.05"))?;
    Ok((slide(section)?, friction))
}

/// Moment of inertia of a part that turns about its own axis through its centre of mass, and its mass for the bearing forces. Other keys of the
/// section must have been read before.
pub(super) fn wheel(section: &Section) -> Result<Link> {
    let mass = mass(section)?;
    let inertia = section.quantity("inertia", &INERTIA)?.not_negative()?;
    let balanced = |key: &str| {
        (key == "com").then_some("this part is balanced: its centre of mass is on its axis")
    };
    section.finish_with(balanced)?;
    Link::new(MassProperties {
        mass,
        inertia,
        com: [0.0, 0.0],
    })
    .map_err(|error| core(section, error))
}

/// The mass (kg) of a part; zero if not given.
pub(super) fn mass(section: &Section) -> Result<f64> {
    section
        .optional("mass", &MASS)?
        .map_or(Ok(0.0), Value::not_negative)
}

/// The two ends of a stroke.
pub(in crate::read) fn ends(item: &Item, kind: &'static Kind, example: &str) -> Result<[f64; 2]> {
    let [from, to] = item.pair([kind, kind])?;
    if to.si - from.si >= kind.smallest {
        return Ok([from.si, to.si]);
    }
    let (from, to) = (from.shown(), to.shown());
    let what = format!("runs from {from} to {to}, which is zero or backwards");
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
    let ends = ends(&item, &LENGTH, "stroke = [\"0 mm\", \"800 mm\"]")?;
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
