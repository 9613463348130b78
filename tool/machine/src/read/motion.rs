//! `[motion]`: the prescribed motion of the drive link.

use jred::{Domain, Machine};

use crate::model::mechanism::AnyMechanism;
use crate::model::motion::Motion;
use crate::text::file::Files;
use crate::text::problem::Result;
use crate::text::section::Section;

use super::drive_link::DriveLink;
use super::profile;

pub(super) mod closed;
mod ends;
mod segment;
mod segments;

/// The prescribed motion, if the file has one. A profile's file is looked for among `files`.
pub(super) fn read(
    root: &Section,
    files: &dyn Files,
    drive: DriveLink,
    machine: &Machine<AnyMechanism>,
) -> Result<Option<Motion>> {
    let Some(item) = root.get("motion") else {
        return Ok(None);
    };
    let section = item.section("[motion]".into())?;
    let types = ["constant-speed", "cycle", "point-to-point", "profile"];
    let motion = match section
        .require("type", "type = \"cycle\"")?
        .choice(&types)?
    {
        0 => constant_speed(&section, drive)?,
        1 => segments::read(&section, true, drive, machine)?,
        2 => segments::read(&section, false, drive, machine)?,
        _ => profile::read(&section, files, drive, machine)?,
    };
    Ok(Some(motion))
}

/// Reports keys that the type of motion does not have.
pub(super) fn finish(section: &Section) -> Result<()> {
    section.finish_with(|key| match key {
        "segment" => Some("segments are for the types \"cycle\" and \"point-to-point\""),
        "speed" => Some("a speed is for the type \"constant-speed\""),
        "file" | "cyclic" | "step" | "smoothing" | "close_within" => {
            Some("a file and its options are for the type \"profile\"")
        }
        _ => None,
    })
}

/// Where the motion starts: at zero, or at the beginning of the stroke.
fn start(section: &Section, drive: DriveLink) -> Result<f64> {
    let Some(start) = section.optional("start", drive.position())? else {
        return Ok(match drive.domain {
            Domain::Turn => 0.0,
            Domain::Stroke { from, .. } => from,
        });
    };
    if drive.reaches(start.si) {
        return Ok(start.si);
    }
    let what = format!(
        "is {}, outside the stroke, {}",
        start.shown(),
        drive.range()
    );
    Err(start
        .problem(&what, "out of reach")
        .help("start at a position within the stroke"))
}

fn constant_speed(section: &Section, drive: DriveLink) -> Result<Motion> {
    if drive.domain != Domain::Turn {
        let kind = section.require("type", "type = \"cycle\"")?;
        return Err(kind
            .problem(
                &format!(
                    "is \"constant-speed\", but the drive link has a stroke, {}: it cannot move on forever",
                    drive.range()
                ),
                "not on a stroke",
            )
            .help("use type = \"cycle\" with moves forth and back, or \"point-to-point\""));
    }
    let start = start(section, drive)?;
    let speed = section.quantity("speed", drive.speed())?;
    finish(section)?;
    if speed.si.abs() < drive.speed().smallest {
        return Err(speed
            .problem(
                &format!("is {}, but must not be zero", speed.shown()),
                "standstill",
            )
            .help("a negative speed turns clockwise; for a machine at rest, remove [motion]"));
    }
    Ok(Motion::constant_speed(start, speed.si))
}
