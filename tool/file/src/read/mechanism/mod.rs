//! `[mechanism]`: the moving links.

mod ball_screw;
mod disc_cam;
mod four_bar;
mod friction_drive;
mod geneva;
mod hoist;
mod indexing_cam;
mod inverted_slider_crank;
mod linkage;
mod parallel_shafts;
pub(super) mod parts;
mod planetary;
mod rack;
mod reduced_curves;
mod rotary_table;
mod scotch_yoke;
mod six_link;
mod slider_crank;
mod toggle_press;
mod traction;
mod train;
mod winder;

use crate::math;
use std::f64::consts::TAU;

use jred::Domain;
use jred::error::Error;
use jred::machine::{Link, MassProperties, Mechanism as _, PoseError};
use jred::mechanism::BuildError;

use crate::keys::cam::DISC_CAM;
use crate::keys::linkage::LINKAGE;
use crate::keys::mechanism as keys;
use crate::model::coordinate::Coordinate;
use crate::model::drive_element::DriveElement;
use crate::model::mechanism::AnyMechanism;
use crate::number::rounding::figure;
use crate::text::file::Files;

use crate::read::drive_element;
use crate::text::item::Item;
use crate::text::key::KeyTable;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// A reader of one type of mechanism; keys that it does not read are refused.
#[derive(Clone, Copy)]
enum Reader {
    /// From the machine file alone.
    Text(fn(&Section) -> Result<AnyMechanism>),
    /// From a file that it names, too.
    Files(fn(&Section, &dyn Files) -> Result<AnyMechanism>),
}

/// The types with their keys and their readers.
const TYPES: [(&KeyTable, Reader); 24] = [
    (&keys::SLIDER_CRANK, Reader::Text(slider_crank::read)),
    (&keys::GEAR_TRAIN, Reader::Text(train::read_gears)),
    (&keys::BELT, Reader::Text(train::read_belt)),
    (&LINKAGE, Reader::Text(linkage::read)),
    (&keys::SCOTCH_YOKE, Reader::Text(scotch_yoke::read)),
    (
        &keys::INVERTED_SLIDER_CRANK,
        Reader::Text(inverted_slider_crank::read),
    ),
    (&keys::GENEVA, Reader::Text(geneva::read)),
    (&keys::FOUR_BAR, Reader::Text(four_bar::read)),
    (&keys::SIX_LINK, Reader::Text(six_link::read)),
    (&keys::TOGGLE_PRESS, Reader::Text(toggle_press::read)),
    (&keys::RACK_AND_PINION, Reader::Text(rack::read)),
    (&keys::BALL_SCREW, Reader::Text(ball_screw::read)),
    (&keys::HOIST, Reader::Text(hoist::read)),
    (&keys::PLANETARY, Reader::Text(planetary::read)),
    (&keys::PARALLEL_SHAFTS, Reader::Text(parallel_shafts::read)),
    (&keys::FRICTION_DRIVE, Reader::Text(friction_drive::read)),
    (&keys::BELT_AXIS, Reader::Text(traction::read_belt_axis)),
    (&keys::CONVEYOR, Reader::Text(traction::read_conveyor)),
    (&keys::FEED_ROLL, Reader::Text(traction::read_feed_roll)),
    (&keys::ROTARY_TABLE, Reader::Text(rotary_table::read)),
    (&keys::INDEXING_CAM, Reader::Text(indexing_cam::read)),
    (&keys::WINDER, Reader::Text(winder::read)),
    (&DISC_CAM, Reader::Files(disc_cam::read)),
    (&keys::REDUCED_CURVES, Reader::Files(reduced_curves::read)),
];

/// The types of mechanism that a machine file can have.
pub fn mechanism_types() -> impl Iterator<Item = &'static str> {
    TYPES.iter().map(|(table, _)| table.name)
}

/// The mechanism under this `gravity` (m/s²), the inertia of its flywheel (kg·m²), and its belt, screw or pinion, if the file gives its limits.
pub(super) fn read(
    section: &Section,
    gravity: [f64; 2],
    files: &dyn Files,
) -> Result<(AnyMechanism, f64, Option<DriveElement>)> {
    let kind = section
        .need("type")?
        .choice(&TYPES.map(|(table, _)| table.name))?;
    let (table, reader) = TYPES[kind];
    section.vary(table)?;
    let flywheel = section.si("flywheel")?;
    let mechanism = match reader {
        Reader::Text(read) => read(section)?,
        Reader::Files(read) => read(section, files)?,
    };
    let mechanism = swing(section, mechanism)?;
    let element = drive_element::of_mechanism(section, &mechanism)?;
    section.finish()?;
    let mut mechanism = mechanism
        .with_gravity_on_guides(gravity)
        .map_err(|error| core(section, error))?;
    if AXES.contains(&mechanism.kind()) {
        mechanism = mechanism.with_fact("axis", inclination(gravity));
    }
    Ok((mechanism, flywheel, element))
}

/// The types whose part slides along x.
const AXES: [&str; 5] = [
    keys::RACK_AND_PINION.name,
    keys::BALL_SCREW.name,
    keys::BELT_AXIS.name,
    keys::CONVEYOR.name,
    keys::FEED_ROLL.name,
];

/// Direction of the x axis under this `gravity` (m/s²), in words.
fn inclination([x, y]: [f64; 2]) -> String {
    let lies = if x == 0.0 && y == 0.0 {
        return "without gravity".to_owned();
    } else if x.abs() <= LEVEL * y.abs() {
        "horizontal".to_owned()
    } else if y.abs() <= LEVEL * x.abs() {
        "vertical".to_owned()
    } else {
        let rises = math::atan2(-x, y.abs()).to_degrees();
        format!("x rises by {} deg", figure(rises))
    };
    let upwards = match (lies == "vertical", x > 0.0) {
        (true, false) => ", x upwards",
        (true, true) => ", x downwards",
        _ => "",
    };
    format!(
        "{lies}{upwards}; the key gravity says so, and gravity = {{ inclination = \"90 deg\" }} makes it vertical"
    )
}

/// Share of gravity below which a component counts as zero.
const LEVEL: f64 = 1e-12;

/// Applies `stroke` to a drive link that turns: its range is a part of the turn. Mechanisms that cannot turn fully read a stroke of their own.
fn swing(section: &Section, mechanism: AnyMechanism) -> Result<AnyMechanism> {
    if mechanism.domain() != Domain::Turn || mechanism.coordinate() != Coordinate::Angle {
        return Ok(mechanism);
    }
    let Some((item, stroke)) = stroke(section)? else {
        return Ok(mechanism);
    };
    if !mechanism.contacts().is_empty() {
        return Err(item
            .problem("is not for a cam, which turns fully", "remove this")
            .help("a motion may swing over a part of the turn without it: write its moves in [motion]"));
    }
    Ok(mechanism.on_stroke(stroke))
}

/// `stroke` of a drive link that turns: two angles (rad), less than a turn apart.
fn stroke<'a>(section: &Section<'a>) -> Result<Option<(Item<'a>, [f64; 2])>> {
    let Some(item) = section.get("stroke") else {
        return Ok(None);
    };
    let [from, to] = item.values()?;
    let width = to.si - from.si;
    if width <= 0.0 || width >= TAU {
        return Err(item
            .problem(
                &format!("runs from {} to {}", from.shown(), to.shown()),
                "check these angles",
            )
            .help("the second angle must be the larger one, by less than a turn; a drive link that turns fully has no stroke"));
    }
    let stroke = [from.si, to.si];
    Ok(Some((item, stroke)))
}

/// A stroke that a mechanism cannot follow. `open` and `locked` describe the joint there, for example "the rod is perpendicular to the guide".
fn stopped(
    section: &Section,
    stroke: &Item,
    [open, locked]: [&str; 2],
    error: BuildError,
) -> Problem {
    let degrees = |phi: f64| format!("φ = {:.2}°", phi.to_degrees());
    match error {
        BuildError::Pose(PoseError::DeadPoint { phi, .. }) => stroke
            .problem(
                &format!("reaches a dead point at {}, where {locked}", degrees(phi)),
                "goes too far",
            )
            .help("end the stroke some degrees before it, or change the lengths"),
        BuildError::Pose(PoseError::CannotAssemble { phi, gap, .. }) => stroke
            .problem(
                &format!("starts at {}, where {open}: {gap:.6} m are missing", degrees(phi)),
                "cannot be assembled here",
            )
            .help("start the stroke at a position where the mechanism can be assembled, or change the lengths"),
        error => core(section, error),
    }
}

/// Descriptions for a mechanism whose last link no longer reaches its guide.
const ROD: [&str; 2] = [
    "the rod does not reach the guide",
    "the rod is perpendicular to the guide",
];

/// A link with its mass, its moment of inertia and its centre of mass.
fn link(section: &Section) -> Result<Link> {
    let properties = MassProperties {
        mass: section.si("mass")?,
        inertia: section.si("inertia")?,
        com: section.two("com")?,
    };
    section.finish()?;
    Link::new(properties).map_err(|error| core(section, error))
}

/// An error of the core without a key to show it at.
fn core(section: &Section, error: impl Into<Error>) -> Problem {
    section.titled(error, "in this table")
}
