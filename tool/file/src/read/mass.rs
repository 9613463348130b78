//! `[[mass]]`: a mass fixed to a link, for example a counterweight or a tool.

use super::names::Names;
use crate::model::laden::{Attached, laden};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::{INERTIA, LENGTH, MASS};

/// The most masses of a machine.
const MOST: usize = 16;

/// The mechanism with the masses of the file.
pub(super) fn read(root: &Section, mechanism: AnyMechanism) -> Result<AnyMechanism> {
    let Some(item) = root.get("mass") else {
        return Ok(mechanism);
    };
    let sections = item.sections("[[mass]]")?;
    if let Some(surplus) = sections.get(MOST) {
        return Err(surplus
            .problem(format!("more than {MOST} masses"), "one too many")
            .help("combine what is fixed to the same link"));
    }
    let (mut masses, mut names) = (Vec::new(), Names::of("masses"));
    for section in &sections {
        names.add(section)?;
        let (_, mass) = attached(section, &mechanism, "mass")?;
        section.finish_with(|key| match key {
            "segments" | "during" => {
                Some("what is there for a part of the motion is a [[payload]]")
            }
            _ => None,
        })?;
        masses.push(mass);
    }
    laden(&mechanism, &masses).map_err(|error| {
        item.problem(&format!("cannot be used: {error}"), "here")
            .help(error.cure().to_string())
    })
}

/// A mass on a link, and its name; by default "`what` on" and the name of the link.
pub(super) fn attached(
    section: &Section,
    mechanism: &AnyMechanism,
    what: &str,
) -> Result<(String, Attached)> {
    let links = mechanism.link_names();
    let example = format!("on = \"{}\"", links.last().map_or("slider", String::as_str));
    let on = section.require("on", &example)?;
    let link = on.choice(links)?;
    let name = match section.get("name") {
        Some(item) => item.text("workpiece")?.to_owned(),
        None => format!("{what} on {}", on.text("slider")?),
    };
    let at = section.point("at", &LENGTH)?;
    let mass = section.quantity("mass", &MASS)?.positive()?;
    let inertia = match section.optional("inertia", &INERTIA)? {
        Some(value) => value.not_negative()?,
        None => 0.0,
    };
    Ok((
        name,
        Attached {
            link,
            at,
            mass,
            inertia,
        },
    ))
}
