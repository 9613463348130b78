//! `type = "rotary-table"`: a table with parts on a pitch circle.

use jred::Domain;
use jred::machine::Link;
use jred::machine::MassProperties;

use super::{core, parts};
use crate::model::mechanism::AnyMechanism;
use crate::model::tabulated::DriveLinkAlone;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::{INERTIA, LENGTH, MASS};

/// Most parts of one kind.
const MOST_PARTS: u32 = 1000;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let mechanism = DriveLinkAlone::new(Domain::Turn, false, read_table(section)?);
    Ok(AnyMechanism::new(
        super::ROTARY_TABLE,
        mechanism,
        ["table"],
        ["table bearing"],
    ))
}

/// A table with its parts, balanced.
pub(super) fn read_table(section: &Section) -> Result<Link> {
    let table = section.section("table")?;
    let mut mass = parts::mass(&table)?;
    let mut inertia = match (table.get("diameter"), table.get("inertia")) {
        (Some(item), None) => {
            if table.peek("mass").is_none() {
                return Err(table.missing("mass", "mass = \"60 kg\""));
            }
            let diameter = item.quantity(&LENGTH)?.positive()?;
            mass * diameter * diameter / 8.0
        }
        (Some(item), Some(_)) => {
            return Err(item
                .problem("is not used: the inertia is given", "remove this")
                .help("give the inertia, or the diameter and the mass of a disc"));
        }
        _ => table.quantity("inertia", &INERTIA)?.not_negative()?,
    };
    table.finish()?;
    if let Some(item) = section.get("parts") {
        for group in item.sections("[[mechanism.parts]]")? {
            let [m, j] = group_of_parts(&group)?;
            mass += m;
            inertia += j;
        }
    }
    let properties = MassProperties {
        mass,
        inertia,
        com: [0.0, 0.0],
    };
    Link::new(properties).map_err(|error| core(section, error))
}

/// Mass (kg) and moment of inertia about the table's axis (kg·m²) of equal parts, spread evenly over a pitch circle.
fn group_of_parts(group: &Section) -> Result<[f64; 2]> {
    group.expects(&["count", "mass", "pitch_circle", "inertia"]);
    let count = group.require("count", "count = 8")?;
    let count = f64::from(count.count(MOST_PARTS, "8")?);
    let mass = group.quantity("mass", &MASS)?.not_negative()?;
    let pitch_circle = group.quantity("pitch_circle", &LENGTH)?.not_negative()?;
    let own = match group.optional("inertia", &INERTIA)? {
        Some(value) => value.not_negative()?,
        None => 0.0,
    };
    group.finish()?;
    let radius = 0.5 * pitch_circle;
    Ok([count * mass, count * (own + mass * radius * radius)])
}
