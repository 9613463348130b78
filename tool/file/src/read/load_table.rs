//! `[[load]] table = "loads.csv"`: payload, thrust, forces and moments over a position.

use crate::math;
use std::ops::Range;

use jred::Domain;
use jred::machine::{MAX_LOADS, Window};

use super::curve_file::RowVariable;
use super::drive_link::DriveLink;
use super::effect::Effect;
use super::loads::SCHEDULE;
use super::{tool, window};
use crate::keys::loads::LOAD_TABLE;
use crate::model::coordinate::Coordinate;
use crate::model::machine::least_common_multiple;
use crate::model::mechanism::AnyMechanism;
use crate::model::virtual_link::{Direction, LinkPoint, TableVariable, VirtualLink};
use crate::number::spline::FitMethod;
use crate::text::columns::{CsvFile, Layout};
use crate::text::file::Files;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

mod curves;

/// Whether a `[[load]]` is a table.
pub(super) fn is_table(section: &Section) -> bool {
    section.peek("table").is_some()
}

/// The mechanism with the curves of all tables, and the mechanism's own loads that belong to each table.
pub(super) fn read(
    root: &Section,
    mut mechanism: AnyMechanism,
    drive: DriveLink,
    gravity: [f64; 2],
    files: &dyn Files,
) -> Result<(AnyMechanism, Vec<Range<usize>>, u32)> {
    let mut loads = Vec::new();
    let mut turns = 1;
    for section in root.tables("load")?.iter().filter(|s| is_table(s)) {
        section.vary(&LOAD_TABLE)?;
        let own = window::turns(section, drive)?;
        turns = least_common_multiple(turns, own);
        let stand_ins = table(section, &mechanism, drive, (gravity, own), files)?;
        let first = mechanism.own_loads().len();
        mechanism = mechanism
            .with_stand_ins(&stand_ins)
            .map_err(|error| section.titled(error, "this table"))?;
        if mechanism.own_loads().len() > MAX_LOADS {
            return Err(section
                .problem(format!("more than {MAX_LOADS} loads"), "one too many")
                .help("combine loads on the same link into one table"));
        }
        loads.push(first..mechanism.own_loads().len());
        let key = SCHEDULE.into_iter().find_map(|key| section.peek(key));
        if let (Some(key), true) = (key, stand_ins.iter().any(|s| s.course.is_payload())) {
            return Err(key
                .problem("is given for a table with a payload", "not of a payload")
                .help("write a [[payload]] for what is carried over a part of the motion"));
        }
    }
    Ok((mechanism, loads, turns))
}

/// The target of a table.
struct Target<'t> {
    mechanism: &'t AnyMechanism,
    drive: DriveLink,
    gravity: [f64; 2],
    name: &'t str,
    /// The point of a link, unless it acts on the drive link.
    on: Option<(Item<'t>, LinkPoint)>,
    /// The direction of the column Force.
    along: Option<(Item<'t>, Direction)>,
    /// The variable of the rows.
    over: TableVariable,
    rows: RowVariable,
    way: Option<(Item<'t>, FitMethod)>,
    window: Option<Window>,
    layout: Layout<'t>,
}

fn table(
    section: &Section,
    mechanism: &AnyMechanism,
    drive: DriveLink,
    (gravity, turns): ([f64; 2], u32),
    files: &dyn Files,
) -> Result<Vec<VirtualLink>> {
    let name = section.text("name")?.unwrap_or("load table");
    let item = section.need("table")?;
    let on = place(section, mechanism)?;
    let along = direction(section)?;
    if let (Some(over), None) = (section.peek("over"), &on) {
        return Err(over
            .problem("is given without `on`", "a force on which link?")
            .help("add on = \"slider\", the link on which the force acts"));
    }
    let (over, domain, of) = over(section, mechanism, drive)?;
    if let (Some(item), TableVariable::Point { .. }) = (section.peek("turns"), over) {
        return Err(item
            .problem(
                "is given for rows over the position of a point",
                "of rows over the drive link",
            )
            .help("give the rows over the drive link's angle, without `over`, or remove `turns`"));
    }
    let partly = section.word("outside")? == 1;
    let way = section.pick("curve", [FitMethod::Interpolating, FitMethod::Monotone])?;
    let way = section.get("curve").map(|item| (item, way));
    let target = Target {
        mechanism,
        drive,
        gravity,
        name,
        on,
        along,
        over,
        rows: RowVariable {
            domain,
            of,
            partly,
            turns,
        },
        way,
        window: window::read(section, drive, turns)?,
        layout: Layout::read(section)?,
    };
    section.expects(&SCHEDULE);
    section.finish()?;
    let file = CsvFile::open(&item, "loads.csv", files)?;
    curves::read(&file.text, &target).map_err(|fault| file.shows(fault))
}

/// `on` and `at`.
fn place<'t>(
    section: &Section<'t>,
    mechanism: &AnyMechanism,
) -> Result<Option<(Item<'t>, LinkPoint)>> {
    let links = mechanism.link_names();
    let at = section.get("at");
    let Some(on) = section.get("on") else {
        return match at {
            None => Ok(None),
            Some(at) => Err(at
                .problem("is given without `on`", "a point of which link?")
                .help("add on = \"slider\", the link on which the table acts")),
        };
    };
    let link = on.choice(links)?;
    let at = section.two("at")?;
    Ok(Some((on, LinkPoint { link, at })))
}

/// `angle` and `angle_on_link`.
fn direction<'t>(section: &Section<'t>) -> Result<Option<(Item<'t>, Direction)>> {
    let (fixed, turning) = (section.get("angle"), section.get("angle_on_link"));
    let unit = |item: &Item| {
        let (sin, cos) = math::sin_cos(item.value()?.si);
        // Removes the rounding of the other component at a right angle.
        let clean = |c: f64| if c.abs() < 1e-15 { 0.0 } else { c };
        Ok::<_, Problem>([cos, sin].map(clean))
    };
    Ok(match (fixed, turning) {
        (Some(item), _) => {
            let along = Direction::Fixed(unit(&item)?);
            Some((item, along))
        }
        (None, Some(item)) => {
            let along = Direction::OnLink(unit(&item)?);
            Some((item, along))
        }
        (None, None) => None,
    })
}

/// The variable of the rows, its range, and its name.
fn over(
    section: &Section,
    mechanism: &AnyMechanism,
    drive: DriveLink,
) -> Result<(TableVariable, Domain, String)> {
    let Some(item) = section.get("over") else {
        return Ok((
            TableVariable::Drive,
            drive.domain,
            "the drive link".to_owned(),
        ));
    };
    let section = section.table("over")?;
    let (name, link, at) = tool::place(&section, &section.need("point")?, mechanism)?;
    let (axis, zero) = (section.word("along")?, section.si("zero")?);
    section.finish()?;
    let over = TableVariable::Point {
        link,
        at,
        axis,
        zero,
    };
    let [from, to] = over.range(mechanism).map_err(|error| {
        item.problem(&format!("cannot be used: {error}"), "this point")
            .help(error.cure().to_string())
    })?;
    let letter = ["x", "y"][axis];
    if to - from <= 1e-9 {
        return Err(item
            .problem(
                &format!("is {letter} of {name}, which does not move"),
                "stands",
            )
            .help("name a point that moves along this axis"));
    }
    Ok((
        over,
        Domain::Stroke { from, to },
        format!("{letter} of {name}"),
    ))
}

impl Target<'_> {
    /// The coordinate of the rows.
    fn coordinate(&self) -> Coordinate {
        match self.over {
            TableVariable::Drive => self.drive.coordinate,
            TableVariable::Point { .. } => Coordinate::Length,
        }
    }

    /// Checks that the force or moment has an effect on the link.
    fn check_effect(&self, force: bool, fixed: bool) -> Result<LinkPoint> {
        let Some((item, place)) = &self.on else {
            return Err(Problem::new("a table acts on no link"));
        };
        let effect = Effect {
            link: place.link,
            point: place.at,
            force,
            fixed,
        };
        effect.check(self.mechanism, item)?;
        Ok(*place)
    }
}
