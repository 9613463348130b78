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

use std::f64::consts::TAU;

use jred::Domain;
use jred::error::Error;
use jred::machine::{Link, MassProperties, Mechanism as _, PoseError};
use jred::mechanism::BuildError;

use crate::model::coordinate::Coordinate;
use crate::model::mechanism::AnyMechanism;
use crate::number::rounding::figure;
use crate::text::file::Files;

use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{ANGLE, INERTIA, LENGTH, MASS};

/// The types of mechanism in machine files.
const SLIDER_CRANK: &str = "slider-crank";
const GEAR_TRAIN: &str = "gear-train";
const BELT: &str = "belt";
const LINKAGE: &str = "linkage";
const SCOTCH_YOKE: &str = "scotch-yoke";
const INVERTED_SLIDER_CRANK: &str = "inverted-slider-crank";
const FRICTION_DRIVE: &str = "friction-drive";
const GENEVA: &str = "geneva";
const INDEXING_CAM: &str = "indexing-cam";
const DISC_CAM: &str = "disc-cam";
const FOUR_BAR: &str = "four-bar";
const SIX_LINK: &str = "six-link";
const TOGGLE_PRESS: &str = "toggle-press";
const RACK: &str = "rack-and-pinion";
const BALL_SCREW: &str = "ball-screw";
const HOIST: &str = "hoist";
const PLANETARY: &str = "planetary";
const PARALLEL_SHAFTS: &str = "parallel-shafts";
const REDUCED_CURVES: &str = "reduced-curves";
const BELT_AXIS: &str = "belt-axis";
const CONVEYOR: &str = "conveyor";
const FEED_ROLL: &str = "feed-roll";
const ROTARY_TABLE: &str = "rotary-table";
const WINDER: &str = "winder";

/// A reader of one type of mechanism; keys that it does not read are refused.
type Reader = fn(&Section) -> Result<AnyMechanism>;

/// A reader of a type that names a file in the machine file's folder.
type FileReader = fn(&Section, &dyn Files) -> Result<AnyMechanism>;

/// Each type with its reader and its own keys; no keys where they depend on other values.
const TYPES: [(&str, &[&str], Reader); 22] = [
    (
        SLIDER_CRANK,
        &["branch", "offset", "stroke", "crank", "rod", "slider"],
        slider_crank::read,
    ),
    (GEAR_TRAIN, &[], train::read_gears),
    (BELT, &[], train::read_belt),
    (
        LINKAGE,
        &[
            "drive",
            "drawn_at",
            "keep_branch",
            "stroke",
            "ground",
            "body",
            "joint",
        ],
        linkage::read,
    ),
    (
        SCOTCH_YOKE,
        &["slot_angle", "crank", "yoke"],
        scotch_yoke::read,
    ),
    (INVERTED_SLIDER_CRANK, &[], inverted_slider_crank::read),
    (
        GENEVA,
        &["slots", "centre_distance", "crank", "wheel"],
        geneva::read,
    ),
    (
        FOUR_BAR,
        &[
            "pivot",
            "side",
            "keep_branch",
            "stroke",
            "crank",
            "coupler",
            "rocker",
        ],
        four_bar::read,
    ),
    (
        SIX_LINK,
        &[
            "centres", "guide", "branch", "stroke", "crank", "block", "rocker", "rod", "slider",
        ],
        six_link::read,
    ),
    (
        TOGGLE_PRESS,
        &[
            "pivot", "guide", "knee", "branch", "stroke", "crank", "rod", "upper", "lower", "ram",
        ],
        toggle_press::read,
    ),
    (RACK, &["pinion", "rack", "stroke"], rack::read),
    (
        BALL_SCREW,
        &["lead", "screw", "nut", "stroke"],
        ball_screw::read,
    ),
    (
        HOIST,
        &["drum", "load", "counterweight", "stroke"],
        hoist::read,
    ),
    (
        PLANETARY,
        &[
            "input",
            "fixed",
            "centre_distance",
            "sun",
            "carrier",
            "ring",
            "planets",
        ],
        planetary::read,
    ),
    (PARALLEL_SHAFTS, &["drive", "driven"], parallel_shafts::read),
    (
        FRICTION_DRIVE,
        &["arrangement", "inertia", "power_flow", "stage"],
        friction_drive::read,
    ),
    (
        BELT_AXIS,
        &["pulley", "idler", "belt_mass", "carriage", "stroke"],
        traction::read_belt_axis,
    ),
    (
        CONVEYOR,
        &["drum", "idler", "belt_mass", "goods"],
        traction::read_conveyor,
    ),
    (
        FEED_ROLL,
        &["roll", "idler", "strip"],
        traction::read_feed_roll,
    ),
    (ROTARY_TABLE, &["table", "parts"], rotary_table::read),
    (INDEXING_CAM, &[], indexing_cam::read),
    (WINDER, &["core", "web", "full_diameter"], winder::read),
];

/// The types that are, or can be, read from a file of their own.
const FILE_TYPES: [(&str, FileReader); 2] = [
    (DISC_CAM, disc_cam::read),
    (REDUCED_CURVES, reduced_curves::read),
];

/// The types of mechanism that a machine file can have.
pub fn mechanism_types() -> impl Iterator<Item = &'static str> {
    let files = FILE_TYPES.iter().map(|(name, _)| *name);
    TYPES.iter().map(|(name, ..)| *name).chain(files)
}

/// The mechanism under this `gravity` (m/s²), and the inertia of its flywheel (kg·m²).
pub(super) fn read(
    section: &Section,
    gravity: [f64; 2],
    files: &dyn Files,
) -> Result<(AnyMechanism, f64)> {
    let kind = section
        .require("type", "type = \"slider-crank\"")?
        .choice(&mechanism_types().collect::<Vec<_>>())?;
    let flywheel = match section.optional("flywheel", &INERTIA)? {
        Some(value) => value.not_negative()?,
        None => 0.0,
    };
    let mechanism = match (TYPES.get(kind), kind.checked_sub(TYPES.len())) {
        (None, Some(file)) => FILE_TYPES[file].1(section, files)?,
        (kind, _) => {
            let (_, keys, read) = kind.unwrap_or(&TYPES[0]);
            if !keys.is_empty() {
                section.expects_only(keys);
            }
            read(section)?
        }
    };
    let mechanism = swing(section, mechanism)?;
    let elsewhere = |key: &str| match key {
        "efficiency" => Some("efficiency belongs to [[drive_train]]"),
        _ => None,
    };
    section.finish_with(elsewhere)?;
    let mut mechanism = mechanism
        .with_gravity_on_guides(gravity)
        .map_err(|error| core(section, error))?;
    if AXES.contains(&mechanism.kind()) {
        mechanism = mechanism.with_fact("axis", inclination(gravity));
    }
    Ok((mechanism, flywheel))
}

/// The types whose part slides along x.
const AXES: [&str; 5] = [RACK, BALL_SCREW, BELT_AXIS, CONVEYOR, FEED_ROLL];

/// Direction of the x axis under this `gravity` (m/s²), in words.
fn inclination([x, y]: [f64; 2]) -> String {
    let lies = if x == 0.0 && y == 0.0 {
        return "without gravity".to_owned();
    } else if x.abs() <= LEVEL * y.abs() {
        "horizontal".to_owned()
    } else if y.abs() <= LEVEL * x.abs() {
        "vertical".to_owned()
    } else {
        let rises = (-x).atan2(y.abs()).to_degrees();
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
    let [from, to] = item.pair([&ANGLE, &ANGLE])?;
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

/// Mass, moment of inertia and centre of mass of a crank or a rod.
fn link(section: &Section) -> Result<Link> {
    let mass = section.quantity("mass", &MASS)?.not_negative()?;
    let inertia = section.quantity("inertia", &INERTIA)?.not_negative()?;
    let com = section.point("com", &LENGTH)?;
    section.finish()?;
    Link::new(MassProperties { mass, inertia, com }).map_err(|error| core(section, error))
}

/// An error of the core without a key to show it at.
fn core(section: &Section, error: impl Into<Error>) -> Problem {
    section.titled(error, "in this table")
}
