//! `[[load]]`: loads on the links.

use std::ops::Range;

use jred::machine::{Action, Load, MAX_LOADS};

use crate::keys::loads::ACTIONS;
use crate::model::mechanism::{AnyMechanism, NamedLoad};

use super::drive_link::DriveLink;
use super::effect::Effect;
use super::mass::link_of;
use super::schedule::Entry;
use super::{load_table, window};
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{FORCE, Kind, TORQUE, VISCOUS_FORCE, VISCOUS_MOMENT};

/// Keys for the times at which a load acts, or a payload is carried.
pub(super) const SCHEDULE: [&str; 3] = ["segments", "during", "direction"];

/// All loads of the file, and which of them belong to each `[[load]]`. The loads of a table are among the mechanism's own, at these indices.
pub(super) fn read(
    root: &Section,
    mechanism: &AnyMechanism,
    drive: DriveLink,
    tables: &[Range<usize>],
) -> Result<(Vec<NamedLoad>, Vec<Entry>)> {
    let mut loads = mechanism.own_loads().to_vec();
    let mut sections = root.tables("load")?;
    let (mut of_tables, mut next) = (tables.iter(), loads.len());
    let mut entry = |section: &Section| {
        let loads = if load_table::is_table(section) {
            of_tables.next().cloned().unwrap_or_default()
        } else {
            next += 1;
            next - 1..next
        };
        Entry { loads }
    };
    let entries = sections.iter().map(&mut entry).collect();
    sections.retain(|section| !load_table::is_table(section));
    if let Some(surplus) = sections.get(MAX_LOADS.saturating_sub(loads.len())) {
        return Err(surplus
            .problem(format!("more than {MAX_LOADS} loads"), "one too many")
            .help("combine loads that act on the same link"));
    }
    for section in &sections {
        loads.push(load(section, mechanism, drive)?);
    }
    Ok((loads, entries))
}

/// `at_rest`: the load while the drive link is at rest, and whether that is static friction.
pub(super) fn at_rest(section: &Section, load: &Load, item: &Item) -> Result<(Load, bool)> {
    let (key, moving_item) = action_key(section)?;
    let found = match key {
        "viscous_force" | "viscous_moment" => {
            return Err(item
                .problem(&format!("is not used with `{key}`"), "remove this")
                .help("a viscous load is zero at rest"));
        }
        _ => action(key, item)?,
    };
    let friction = match (found, action(key, &moving_item)?) {
        (Action::OpposingForce(still), Action::OpposingForce(moving))
        | (Action::OpposingMoment(still), Action::OpposingMoment(moving)) => {
            if still < moving {
                let kind = if key == "opposing_force" {
                    &FORCE
                } else {
                    &TORQUE
                };
                let [still, moving] = [item.quantity(kind)?, moving_item.quantity(kind)?];
                let what = format!(
                    "is {}, less than the friction in motion, {}",
                    still.shown(),
                    moving.shown()
                );
                return Err(item
                    .problem(&what, "static friction")
                    .help("static friction is at least as large as friction in motion"));
            }
            true
        }
        _ => false,
    };
    let built = Load::new(load.link(), found)
        .and_then(|rest| rest.at(section.two("at").unwrap_or_default()));
    let rest = built.map_err(|error| {
        item.problem(&error.to_string(), "here")
            .help(error.cure().to_string())
    })?;
    Ok((
        load.window().map_or(rest, |window| rest.within(window)),
        friction,
    ))
}

fn load(section: &Section, mechanism: &AnyMechanism, drive: DriveLink) -> Result<NamedLoad> {
    let links = mechanism.link_names();
    let name = section.text("name")?;
    let (_, link) = link_of(section, mechanism)?;
    let (key, item) = action_key(section)?;
    let action = action(key, &item)?;
    let at = section.get("at");
    let point = section.two("at")?;
    let turns = window::turns(section, drive)?;
    let window = window::read(section, drive, turns)?;
    if let (Some(item), None) = (section.peek("turns"), &window) {
        return Err(item
            .problem("is given without `between`", "in which part of the turns?")
            .help("a load that acts everywhere is the same in every turn: add between = [\"340 deg\", \"500 deg\"] and a ramp, or remove `turns`"));
    }
    section.expects(&SCHEDULE);
    section.expects(&["at_rest"]);
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
        .map_err(|error| section.error(error, "in this load"))?;
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
    if let Some(given) = section.one_of(&ACTIONS) {
        return Ok(given);
    }
    let missing = format!(
        "`force` or another action is missing in {}",
        section.title()
    );
    Err(section.finish().err().unwrap_or_else(|| {
        section
            .problem(missing, "what does this load do?")
            .help(format!(
                "add exactly one of {}, such as opposing_force = \"150 N\"",
                ACTIONS.join(", ")
            ))
    }))
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
