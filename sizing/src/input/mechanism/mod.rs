//! `[mechanism]`: what moves.

mod slider_crank;
mod train;

use jred::{Error, Link};

use crate::machine::AnyMechanism;

use super::kind::{INERTIA, LENGTH, MASS};
use super::problem::{Problem, Result};
use super::section::Section;

/// The types of mechanism, as machine files write them.
const SLIDER_CRANK: &str = "slider-crank";
const GEAR_TRAIN: &str = "gear-train";
const BELT: &str = "belt";

/// A reader of one type of mechanism: it takes every key that it knows and leaves the rest to be refused.
type Reader = fn(&Section) -> Result<AnyMechanism>;

/// Every type with its reader.
const TYPES: [(&str, Reader); 3] = [
    (SLIDER_CRANK, slider_crank::read),
    (GEAR_TRAIN, train::read_gears),
    (BELT, train::read_belt),
];

/// The mechanism and the inertia of its flywheel (kg·m²).
pub(super) fn read(section: &Section) -> Result<(AnyMechanism, f64)> {
    let kind = section
        .require("type", "type = \"slider-crank\"")?
        .choice(&TYPES.map(|(name, _)| name))?;
    let flywheel = match section.optional("flywheel", &INERTIA)? {
        Some(value) => value.not_negative()?,
        None => 0.0,
    };
    let (_, reader) = TYPES.get(kind).unwrap_or(&TYPES[0]);
    let mechanism = reader(section)?;
    let elsewhere = |key: &str| match key {
        "efficiency" => Some("efficiency belongs to [[drive_train]]"),
        _ => None,
    };
    section.finish_with(elsewhere)?;
    Ok((mechanism, flywheel))
}

/// Mass, moment of inertia and centre of mass of a crank or a rod.
fn link(section: &Section) -> Result<Link> {
    let mass = section.quantity("mass", &MASS)?.not_negative()?;
    let inertia = section.quantity("inertia", &INERTIA)?.not_negative()?;
    let com = section.point("com", &LENGTH)?;
    section.finish()?;
    Link::new(mass, inertia, com).map_err(|error| core(section, &error))
}

/// An error of the core that no key is known for.
fn core(section: &Section, error: &Error) -> Problem {
    section.problem(format!("{}: {error}", section.title()), "in this table")
}
