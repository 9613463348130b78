//! `type = "rotary-table"`: a table with parts on a pitch circle.

use jred::Domain;
use jred::machine::Link;
use jred::machine::MassProperties;

use super::core;
use crate::model::mechanism::AnyMechanism;
use crate::model::virtual_link::DriveLinkAlone;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let mechanism = DriveLinkAlone::new(Domain::Turn, false, read_table(section)?);
    Ok(AnyMechanism::new(
        section.chosen(),
        mechanism,
        ["table"],
        ["table bearing"],
    ))
}

/// A table with its parts, balanced.
pub(super) fn read_table(section: &Section) -> Result<Link> {
    let table = section.table("table")?;
    let mut mass = table.si("mass")?;
    let mut inertia = match (table.get("diameter"), table.get("inertia")) {
        (Some(item), None) => {
            if table.peek("mass").is_none() {
                return Err(table.lacks("mass"));
            }
            let diameter = item.value()?.si;
            mass * diameter * diameter / 8.0
        }
        (Some(item), Some(_)) => {
            return Err(item
                .problem("is not used: the inertia is given", "remove this")
                .help("give the inertia, or the diameter and the mass of a disc"));
        }
        _ => table.value("inertia")?.si,
    };
    table.finish()?;
    for group in section.tables("parts")? {
        let [m, j] = group_of_parts(&group)?;
        mass += m;
        inertia += j;
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
    let (count, mass) = (f64::from(group.whole("count")?), group.si("mass")?);
    let (pitch_circle, own) = (group.si("pitch_circle")?, group.si("inertia")?);
    group.finish()?;
    let radius = 0.5 * pitch_circle;
    Ok([count * mass, count * (own + mass * radius * radius)])
}
