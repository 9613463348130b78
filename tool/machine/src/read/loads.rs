//! `[[load]]`: what acts on the links.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::{Action, Load, MAX_LOADS, Mechanism as _, Window};

use crate::model::mechanism::{AnyMechanism, NamedLoad};

use super::drive_link::DriveLink;
use super::load_table;
use crate::text::item::{Item, Value};
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{ANGLE, FORCE, Kind, LENGTH, TORQUE, VISCOUS_FORCE, VISCOUS_MOMENT};

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
    let window = match drive.domain {
        Domain::Turn => window(section)?,
        Domain::Stroke { .. } => stretch(section, drive)?,
    };
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
    let movement = Movement::of(mechanism, link);
    if movement.slides && !of_a_force {
        return Err(item
            .problem(
                &format!("does nothing: \"{link_name}\" does not turn"),
                "acts on a link that only slides",
            )
            .help(format!(
                "use force, opposing_force or viscous_force for \"{link_name}\", or choose another link in `on`"
            )));
    }
    if key == "force" && !movement.closes {
        return Err(item
            .problem(
                &format!(
                    "acts in a fixed direction on \"{link_name}\", which does not move in the same way in every turn of the drive link"
                ),
                "does not repeat with each turn",
            )
            .help("a load must repeat with every turn of the drive link: use moment, or opposing_force"));
    }
    if movement.pivots && of_a_force && point == [0.0, 0.0] {
        return Err(item
            .problem(
                &format!("does nothing: it acts on the fixed pivot of \"{link_name}\""),
                "acts on the pivot",
            )
            .help("give the point where it acts, in the link's frame: at = [\"30 mm\", \"0 mm\"], or use a moment"));
    }
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

/// Motion of a link, as far as loads depend on it.
struct Movement {
    /// It never turns.
    slides: bool,
    /// The origin of its frame never moves.
    pivots: bool,
    /// After every turn of the drive link, it has the same position and motion.
    closes: bool,
}

impl Movement {
    /// Looked up at places spread over the drive link's range by the golden ratio, none of them special.
    fn of(mechanism: &AnyMechanism, link: usize) -> Self {
        let domain = mechanism.domain();
        let mut movement = Self {
            slides: true,
            pivots: true,
            closes: true,
        };
        for k in 1..=16 {
            let phi = domain.position((f64::from(k) * 0.618_033_988_749_895).fract());
            let frame = |phi| Some(*mechanism.frames(phi).ok()?.get(link)?);
            let Some(now) = frame(phi) else { continue };
            movement.slides &= now.psi.d1 == 0.0;
            movement.pivots &= now.x.d1 == 0.0 && now.y.d1 == 0.0;
            if let (Domain::Turn, Some(later)) = (domain, frame(phi + TAU)) {
                let turns = (later.psi.value - now.psi.value) / TAU;
                movement.closes &= (turns - turns.round()).abs() < 1e-9;
                // A rack may be elsewhere after a turn, but must move as before.
                let same = |a: f64, b: f64| (a - b).abs() <= 1e-9 * (1.0 + a.abs());
                movement.closes &= same(now.x.d1, later.x.d1) && same(now.y.d1, later.y.d1);
            }
        }
        movement
    }
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

/// The part of the turn in which the load acts.
fn window(section: &Section) -> Result<Option<Window>> {
    let (between, ramp) = (section.get("between"), section.optional("ramp", &ANGLE)?);
    let (between, ramp) = match (between, ramp) {
        (None, None) => return Ok(None),
        (Some(between), Some(ramp)) => (between, ramp),
        (Some(_), None) => {
            return Err(section.missing(
                "ramp",
                "ramp = \"10 deg\": the angle over which the load rises and falls",
            ));
        }
        (None, Some(_)) => {
            return Err(section.missing(
                "between",
                "between = [\"315 deg\", \"360 deg\"]: where the load acts",
            ));
        }
    };
    long_enough(&ramp, TAU)?;
    let [from, to] = between.pair([&ANGLE, &ANGLE])?;
    let end = if to.si < from.si { to.si + TAU } else { to.si };
    let width = end - from.si;
    if width <= 0.0 || width > TAU * (1.0 + 1e-12) {
        return Err(between
            .problem("must span more than zero and at most one turn", "check these angles")
            .help(format!(
                "the load acts from the first angle to the second; a smaller second angle means one turn later: here \
                 the span is {}",
                to.show(width)
            )));
    }
    // Kept a hair below one turn, so that rounding cannot make it wider.
    let start = from.si.rem_euclid(TAU);
    let end = start + width.min(TAU * (1.0 - 1e-14));
    if width < 2.0 * ramp.si {
        let what = format!(
            "is {}, too long for the range of {}",
            ramp.shown(),
            from.show(width)
        );
        let help = format!(
            "the load rises over one ramp and falls over another: write at most {}",
            ramp.show(width / 2.0)
        );
        // Rounding may leave two ramps a hair wider than the range.
        if width < 2.0 * ramp.si * (1.0 - 1e-12) {
            return Err(ramp
                .problem(&what, "too long")
                .at(between.span(), "range")
                .help(help));
        }
    }
    let ramp = ramp.si.min((end - start) / 2.0);
    Window::new(Domain::Turn, [start, end], ramp)
        .map(Some)
        .map_err(|error| {
            between.problem(&format!("is not possible: {error}"), "check these angles")
        })
}

/// A ramp that a table can tell from a jump.
fn long_enough(ramp: &Value, span: f64) -> Result<()> {
    ramp.check_positive()?;
    let least = Window::SHORTEST_RAMP * span;
    if ramp.si < least {
        return Err(ramp
            .problem(
                &format!("is {}, as steep as a jump", ramp.shown()),
                "too short",
            )
            .help(format!(
                "write at least {}, a millionth of the drive link's range",
                ramp.show(least)
            )));
    }
    Ok(())
}

/// The part of the stroke in which the load acts.
fn stretch(section: &Section, drive: DriveLink) -> Result<Option<Window>> {
    let kind = drive.position();
    let (between, ramp) = (section.get("between"), section.optional("ramp", kind)?);
    let (between, ramp) = match (between, ramp) {
        (None, None) => return Ok(None),
        (Some(between), Some(ramp)) => (between, ramp),
        (Some(_), None) => {
            let example = format!(
                "ramp = \"{}\": the way over which the load rises and falls",
                kind.example
            );
            return Err(section.missing("ramp", &example));
        }
        (None, Some(_)) => {
            let example = format!(
                "between = [\"{}\", …]: where the load acts, within the stroke {}",
                kind.example,
                drive.range()
            );
            return Err(section.missing("between", &example));
        }
    };
    long_enough(&ramp, drive.domain.span())?;
    let [from, to] = between.pair([kind, kind])?;
    let width = to.si - from.si;
    if width <= 0.0 {
        return Err(between
            .problem(
                &format!("runs from {} to {}", from.shown(), to.shown()),
                "check these ends",
            )
            .help("on a stroke, the second position must be the larger one"));
    }
    let Domain::Stroke {
        from: start,
        to: end,
    } = drive.domain
    else {
        return Ok(None);
    };
    if to.si <= start || from.si >= end {
        return Err(between
            .problem(
                &format!("is outside the stroke, {}", drive.range()),
                "never reached",
            )
            .help("give positions within the stroke; positions beyond its ends are allowed"));
    }
    if width < 2.0 * ramp.si * (1.0 - 1e-12) {
        return Err(ramp
            .problem(
                &format!(
                    "is {}, too long for the range of {}",
                    ramp.shown(),
                    from.show(width)
                ),
                "too long",
            )
            .at(between.span(), "range")
            .help(format!(
                "the load rises over one ramp and falls over another: write at most {}",
                ramp.show(width / 2.0)
            )));
    }
    Window::new(drive.domain, [from.si, to.si], ramp.si.min(width / 2.0))
        .map(Some)
        .map_err(|error| {
            between.problem(
                &format!("is not possible: {error}"),
                "check these positions",
            )
        })
}
