//! `[[load]]`: what acts on the links.

use jred::machine::{Action, Load, MAX_LOADS};

use crate::model::mechanism::{AnyMechanism, NamedLoad};

use super::drive_link::DriveLink;
use super::effect::Effect;
use super::{load_table, window};
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{FORCE, Kind, LENGTH, TORQUE, VISCOUS_FORCE, VISCOUS_MOMENT};

/// Keys for the action of a load.
const ACTIONS: [&str; 6] = [
    "force",
    "moment",
    "opposing_force",
    "opposing_moment",
    "viscous_force",
    "viscous_moment",
];

/// All loads of the file.
pub(super) fn read(
    root: &Section,
    mechanism: &AnyMechanism,
    drive: DriveLink,
) -> Result<Vec<NamedLoad>> {
    let mut loads = mechanism.own_loads().to_vec();
    let Some(item) = root.get("load") else {
        return Ok(loads);
    };
    let mut sections = item.sections("[[load]]")?;
    sections.retain(|section| !load_table::is_table(section));
    if let Some(surplus) = sections.get(MAX_LOADS.saturating_sub(loads.len())) {
        return Err(surplus
            .problem(format!("more than {MAX_LOADS} loads"), "one too many")
            .help("combine loads that act on the same link"));
    }
    for section in &sections {
        loads.push(load(section, mechanism, drive)?);
    }
    Ok(loads)
}

fn load(section: &Section, mechanism: &AnyMechanism, drive: DriveLink) -> Result<NamedLoad> {
    let links = mechanism.link_names();
    let name = section
        .get("name")
        .map(|item| item.text("pressing force"))
        .transpose()?;
    let example = format!("on = \"{}\"", links.last().map_or("slider", String::as_str));
    let on = section.require("on", &example)?;
    let link = on.choice(links)?;
    let (key, item) = action_key(section)?;
    let action = action(key, &item)?;
    let at = section.get("at");
    let point = section.point("at", &LENGTH)?;
    let window = window::read(section, drive)?;
    section.finish()?;

    let link_name = links.get(link).map_or("", String::as_str);
    let of_a_force = key.ends_with("force");
    if let (Some(at), false) = (&at, of_a_force) {
        return Err(Problem::new(format!(
            "`at` is not used with `{key}` in {}",
            section.title()
        ))
        .at(at.key_span(), "remove this")
        .help("a moment acts on the link as a whole; only forces have a point of application"));
    }
    let effect = Effect {
        link,
        point,
        force: of_a_force,
        fixed: key == "force",
    };
    effect.check(mechanism, &item)?;
    let mut load = Load::new(link, action)
        .and_then(|load| load.at(point))
        .map_err(|error| {
            section
                .problem(error.to_string(), "in this load")
                .help(error.cure().to_string())
        })?;
    if let Some(window) = window {
        load = load.within(window);
    }
    let name = name.map_or_else(
        || format!("{} on {link_name}", key.replace('_', " ")),
        ToOwned::to_owned,
    );
    Ok(NamedLoad { name, load })
}

/// The one key with the action of the load.
fn action_key<'a>(section: &Section<'a>) -> Result<(&'static str, Item<'a>)> {
    let mut found = ACTIONS
        .into_iter()
        .filter_map(|key| Some((key, section.get(key)?)));
    let Some((key, item)) = found.next() else {
        let missing = format!(
            "`force` or another action is missing in {}",
            section.title()
        );
        return Err(section.finish().err().unwrap_or_else(|| {
            section
                .problem(missing, "what does this load do?")
                .help(format!(
                    "add exactly one of {}, such as opposing_force = \"150 N\"",
                    ACTIONS.join(", ")
                ))
        }));
    };
    if let Some((second, other)) = found.next() {
        return Err(Problem::new(format!(
            "{} has both `{key}` and `{second}`",
            section.title()
        ))
        .at(item.key_span(), "one action")
        .at(other.key_span(), "another action")
        .help("write a separate [[load]] for each"));
    }
    Ok((key, item))
}

fn action(key: &str, item: &Item) -> Result<Action> {
    let size = |kind: &'static Kind| {
        let value = item.quantity(kind)?;
        if value.si < 0.0 {
            let what = format!("is {}, but must not be negative", value.shown());
            return Err(value.problem(&what, "negative").help(
                "it always acts against the motion: give only its magnitude; for a load with a direction use `force` \
                 or `moment`",
            ));
        }
        Ok(value.si)
    };
    Ok(match key {
        "force" => Action::Force(item.pair([&FORCE, &FORCE])?.map(|value| value.si)),
        "moment" => Action::Moment(item.quantity(&TORQUE)?.si),
        "opposing_force" => Action::OpposingForce(size(&FORCE)?),
        "opposing_moment" => Action::OpposingMoment(size(&TORQUE)?),
        "viscous_force" => Action::ViscousForce(size(&VISCOUS_FORCE)?),
        _ => Action::ViscousMoment(size(&VISCOUS_MOMENT)?),
    })
}
