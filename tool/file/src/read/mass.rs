//! `[[mass]]`: a mass fixed to a link, for example a counterweight or a tool.

use super::names::Names;
use crate::model::mechanism::AnyMechanism;
use crate::model::with_mass::{AttachedMass, laden};
use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::section::Section;

/// The mechanism with the masses of the file.
pub(super) fn read(root: &Section, mechanism: AnyMechanism) -> Result<AnyMechanism> {
    let Some(item) = root.get("mass") else {
        return Ok(mechanism);
    };
    let sections = root.tables("mass")?;
    let (mut masses, mut names) = (Vec::new(), Names::of("masses"));
    for section in &sections {
        names.add(section)?;
        let (_, mass) = attached(section, &mechanism, "mass")?;
        section.finish()?;
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
) -> Result<(String, AttachedMass)> {
    let (on, link) = link_of(section, mechanism)?;
    let name = match section.text("name")? {
        Some(name) => name.to_owned(),
        None => format!("{what} on {}", on.words_of_text()?),
    };
    let (at, mass, inertia) = (
        section.two("at")?,
        section.si("mass")?,
        section.si("inertia")?,
    );
    Ok((
        name,
        AttachedMass {
            link,
            at,
            mass,
            inertia,
        },
    ))
}

/// `on`: the link of a load or a mass, as its index.
pub(super) fn link_of<'a>(
    section: &Section<'a>,
    mechanism: &AnyMechanism,
) -> Result<(Item<'a>, usize)> {
    let links = mechanism.link_names();
    let last = links.last().map_or("slider", String::as_str);
    let on = section.get("on");
    let on = on.ok_or_else(|| section.missing("on", &format!("on = \"{last}\"")))?;
    let link = on.choice(links)?;
    Ok((on, link))
}
