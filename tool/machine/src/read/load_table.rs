//! `[[load]] table = "loads.csv"`: payload, thrust and torque over the drive link's position.

use jred::machine::MAX_LOADS;

use super::curve_file::Positions;
use super::drive_link::DriveLink;
use crate::model::coordinate::Coordinate;
use crate::model::mechanism::AnyMechanism;
use crate::model::tabulated::{Course, StandIn};
use crate::number::spline::{MIN_POINTS, Way};
use crate::text::columns;
use crate::text::columns::{CsvFile, Format, Known, known};
use crate::text::csv;
use crate::text::file::Files;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{ANGLE, FORCE, INERTIA, LENGTH, MASS, TORQUE};

const POSITION: usize = 0;
const PAYLOAD: usize = 1;
const THRUST: usize = 2;
const TORQUE_COLUMN: usize = 3;

/// The columns of a table on the drive link itself.
const fn on_drive(coordinate: Coordinate) -> ([Known; 4], &'static str) {
    match coordinate {
        Coordinate::Angle => (
            [
                known(&["Position", "phi", "φ"], &ANGLE),
                known(&["Payload"], &INERTIA),
                known(&["Thrust"], &TORQUE),
                known(&["Torque"], &TORQUE),
            ],
            "\"Position [deg],Payload [kg m^2],Thrust [N m],Torque [N m]\" (the position and at least one other)",
        ),
        Coordinate::Length => (
            [
                known(&["Position", "s"], &LENGTH),
                known(&["Payload"], &MASS),
                known(&["Thrust"], &FORCE),
                known(&["Torque", "Force"], &FORCE),
            ],
            "\"Position [mm],Payload [kg],Thrust [N],Force [N]\" (the position and at least one other)",
        ),
    }
}

/// The columns of a table on a link.
const fn on_link(coordinate: Coordinate) -> ([Known; 4], &'static str) {
    let (mut columns, _) = on_drive(coordinate);
    columns[PAYLOAD].kind = &MASS;
    columns[THRUST].kind = &FORCE;
    let example = match coordinate {
        Coordinate::Angle => {
            "\"Position [deg],Payload [kg],Thrust [N],Torque [N m]\" (the position and at least one other)"
        }
        Coordinate::Length => {
            "\"Position [mm],Payload [kg],Thrust [N],Force [N]\" (the position and at least one other)"
        }
    };
    (columns, example)
}

/// Whether a `[[load]]` is a table.
pub(super) fn is_table(section: &Section) -> bool {
    section.peek("table").is_some()
}

/// The mechanism with the curves of all tables.
pub(super) fn read(
    root: &Section,
    mut mechanism: AnyMechanism,
    drive: DriveLink,
    gravity: [f64; 2],
    files: &dyn Files,
) -> Result<AnyMechanism> {
    let Some(item) = root.get("load") else {
        return Ok(mechanism);
    };
    for section in item.sections("[[load]]")?.iter().filter(|s| is_table(s)) {
        let stand_ins = table(section, &mechanism, drive, gravity, files)?;
        mechanism = mechanism.with_stand_ins(&stand_ins).map_err(|error| {
            section
                .problem(format!("{}: {error}", section.title()), "this table")
                .help(error.cure().to_string())
        })?;
        if mechanism.own_loads().len() > MAX_LOADS {
            return Err(section
                .problem(format!("more than {MAX_LOADS} loads"), "one too many")
                .help("combine loads on the same link into one table"));
        }
    }
    Ok(mechanism)
}

fn table(
    section: &Section,
    mechanism: &AnyMechanism,
    drive: DriveLink,
    gravity: [f64; 2],
    files: &dyn Files,
) -> Result<Vec<StandIn>> {
    let name = match section.get("name") {
        Some(item) => item.text("pressing force")?,
        None => "load table",
    };
    let item = section.require("table", "table = \"loads.csv\"")?;
    let links = &mechanism.link_names()[..mechanism.own_links()];
    let link = section.get("on").map(|on| on.choice(links)).transpose()?;
    section.finish_with(|key| match key {
        "force" | "moment" | "opposing_force" | "opposing_moment" | "viscous_force"
        | "viscous_moment" => {
            Some("a table already says what acts; write this in a separate [[load]]")
        }
        "between" | "ramp" => Some("the rows of a table already say where it acts"),
        "at" => Some("a table acts at the origin of its link's frame"),
        _ => None,
    })?;
    let file = CsvFile::open(&item, "loads.csv", files)?;
    let target = Target {
        link,
        gravity,
        name,
    };
    curves(&file.text, drive, &target).map_err(|problem| file.shows(problem))
}

/// On what a table acts.
struct Target<'t> {
    link: Option<usize>,
    gravity: [f64; 2],
    name: &'t str,
}

fn curves(text: &str, drive: DriveLink, target: &Target) -> Result<Vec<StandIn>> {
    let (known, example) = match target.link {
        Some(_) => on_link(drive.coordinate),
        None => on_drive(drive.coordinate),
    };
    let format = Format {
        known: &known,
        ignored: |_| false,
        example,
        min_rows: MIN_POINTS,
    };
    let columns = columns::read(text, &format)?;
    let header = |message: &str| {
        Problem::new(message)
            .at(csv::header_place(text), "header")
            .help(format!(
                "the first line gives column names with units: {example}"
            ))
    };
    if columns.get(POSITION).is_none() {
        return Err(header("the column for the position is missing"));
    }
    let positions = Positions::of(&columns, drive)?;
    let mut stand_ins = Vec::new();
    let mut add = |what: &str, course: Course| {
        let name = format!("{}: {what}", target.name);
        stand_ins.push(StandIn { name, course });
    };
    if let Some(payload) = positions.magnitudes(
        PAYLOAD,
        true,
        "a payload is a mass or an inertia: write zero where there is none",
    )? {
        let mass = positions.curve(&payload, Way::Monotone)?;
        match target.link {
            None => add("payload", Course::Inertia(mass)),
            Some(link) => {
                for (axis, letter) in ["x", "y"].into_iter().enumerate() {
                    let mass = mass.clone();
                    add(
                        &format!("payload {letter}"),
                        Course::Payload { mass, link, axis },
                    );
                }
                if target.gravity.iter().any(|g| *g != 0.0) {
                    let gravity = target.gravity;
                    add(
                        "weight",
                        Course::Weight {
                            mass,
                            link,
                            gravity,
                        },
                    );
                }
            }
        }
    }
    if let Some(thrust) = positions.magnitudes(
        THRUST,
        true,
        "a thrust always opposes the motion: give its magnitude; a force with a sign belongs in the column Torque",
    )? {
        let force = positions.curve(&thrust, Way::Monotone)?;
        let course = match target.link {
            Some(link) => Course::Thrust { force, link },
            None => Course::Opposing(force),
        };
        add("thrust", course);
    }
    if let Some(torque) = positions.values(TORQUE_COLUMN)? {
        let torque = positions.curve(&torque, Way::Monotone)?;
        add("torque", Course::Torque(torque));
    }
    if stand_ins.is_empty() {
        return Err(header("there is no column other than the position"));
    }
    Ok(stand_ins)
}
