//! `[mechanism]`: the moving links.

mod ball_screw;
mod disc_cam;
mod four_bar;
mod friction_drive;
mod geneva;
mod hoist;
mod inverted_slider_crank;
mod linkage;
mod parallel_shafts;
mod parts;
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

use jred::machine::MassProperties;
use jred::{Error, Link};

use crate::model::mechanism::AnyMechanism;
use crate::text::file::Files;

use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{INERTIA, LENGTH, MASS};

/// The types of mechanism, as machine files write them.
const SLIDER_CRANK: &str = "slider-crank";
const GEAR_TRAIN: &str = "gear-train";
const BELT: &str = "belt";
const LINKAGE: &str = "linkage";
const SCOTCH_YOKE: &str = "scotch-yoke";
const INVERTED_SLIDER_CRANK: &str = "inverted-slider-crank";
const FRICTION_DRIVE: &str = "friction-drive";
const GENEVA: &str = "geneva";
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

/// A reader of one that names a file in the machine file's folder.
type FileReader = fn(&Section, &dyn Files) -> Result<AnyMechanism>;

/// Every type with its reader.
const TYPES: [(&str, Reader); 22] = [
    (SLIDER_CRANK, slider_crank::read),
    (GEAR_TRAIN, train::read_gears),
    (BELT, train::read_belt),
    (LINKAGE, linkage::read),
    (SCOTCH_YOKE, scotch_yoke::read),
    (INVERTED_SLIDER_CRANK, inverted_slider_crank::read),
    (GENEVA, geneva::read),
    (FOUR_BAR, four_bar::read),
    (SIX_LINK, six_link::read),
    (TOGGLE_PRESS, toggle_press::read),
    (DISC_CAM, disc_cam::read),
    (RACK, rack::read),
    (BALL_SCREW, ball_screw::read),
    (HOIST, hoist::read),
    (PLANETARY, planetary::read),
    (PARALLEL_SHAFTS, parallel_shafts::read),
    (FRICTION_DRIVE, friction_drive::read),
    (BELT_AXIS, traction::read_belt_axis),
    (CONVEYOR, traction::read_conveyor),
    (FEED_ROLL, traction::read_feed_roll),
    (ROTARY_TABLE, rotary_table::read),
    (WINDER, winder::read),
];

/// Every type that is read from a file of its own.
const FILE_TYPES: [(&str, FileReader); 1] = [(REDUCED_CURVES, reduced_curves::read)];

/// The types of mechanism that machine files can name.
pub fn mechanism_types() -> impl Iterator<Item = &'static str> {
    let files = FILE_TYPES.iter().map(|(name, _)| *name);
    TYPES.iter().map(|(name, _)| *name).chain(files)
}

/// The mechanism, in this `gravity` (m/s²), and the inertia of its flywheel (kg·m²).
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
        (reader, _) => reader.unwrap_or(&TYPES[0]).1(section)?,
    };
    let elsewhere = |key: &str| match key {
        "efficiency" => Some("efficiency belongs to [[drive_train]]"),
        _ => None,
    };
    section.finish_with(elsewhere)?;
    let mechanism = mechanism
        .with_gravity_on_guides(gravity)
        .map_err(|error| core(section, error))?;
    Ok((mechanism, flywheel))
}

/// Mass, moment of inertia and centre of mass of a crank or a rod.
fn link(section: &Section) -> Result<Link> {
    let mass = section.quantity("mass", &MASS)?.not_negative()?;
    let inertia = section.quantity("inertia", &INERTIA)?.not_negative()?;
    let com = section.point("com", &LENGTH)?;
    section.finish()?;
    Link::new(MassProperties { mass, inertia, com }).map_err(|error| core(section, error))
}

/// An error of the core that no key is known for.
fn core(section: &Section, error: impl Into<Error>) -> Problem {
    let error = error.into();
    let problem = section.problem(format!("{}: {error}", section.title()), "in this table");
    match error.cure().to_string() {
        cure if cure.is_empty() => problem,
        cure => problem.help(cure),
    }
}
