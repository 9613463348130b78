//! `[motion]`: the prescribed motion of the drive link.

use jred::machine::Machine;

use crate::model::mechanism::{AnyMechanism, NamedLoad};
use crate::model::motion::Motion;
use crate::text::file::Files;
use crate::text::problem::Result;
use crate::text::section::Section;

use super::drive_link::DriveLink;
use super::profile;

pub(super) mod closed;
mod ends;
mod join;
mod segment;
mod segments;
mod tool;

pub(super) use tool::PrescribedCoordinate;

/// The prescribed motion of a machine and its loads, if the file has one. The file of a profile is taken from `files`.
pub(super) fn read(
    root: &Section,
    files: &dyn Files,
    drive: DriveLink,
    loaded: (&Machine<AnyMechanism>, &[NamedLoad]),
) -> Result<Option<Motion>> {
    let Some(section) = root.maybe_table("motion")? else {
        return Ok(None);
    };
    let kind = section.word("type")?;
    section.choose(["constant-speed", "cycle", "point-to-point", "profile"][kind]);
    let prescribed = PrescribedCoordinate::read(&section, drive, loaded)?;
    let motion = match kind {
        0 => constant_speed(&section, &prescribed)?,
        1 => segments::read(&section, true, &prescribed)?,
        2 => segments::read(&section, false, &prescribed)?,
        _ => profile::read(&section, files, &prescribed)?,
    };
    Ok(Some(motion))
}

/// Start position of the motion.
fn start(section: &Section, prescribed: &PrescribedCoordinate) -> Result<f64> {
    let Some(start) = section.given("start")? else {
        return Ok(prescribed.start());
    };
    prescribed.check_start(&start)?;
    Ok(start.si)
}

/// The motion of another axis over the machine's time; its positions are lengths on a stroke.
pub(super) fn along(
    section: &Section,
    files: &dyn Files,
    axis: DriveLink,
    (machine, loads): (&Machine<AnyMechanism>, &[NamedLoad]),
) -> Result<Motion> {
    section.set_slides(true);
    let kind = section.word("type")?;
    section.choose(["cycle", "point-to-point", "profile"][kind]);
    let prescribed = PrescribedCoordinate {
        axis,
        drive: axis,
        tool: None,
        machine,
        loads,
    };
    match kind {
        0 => segments::read(section, true, &prescribed),
        1 => segments::read(section, false, &prescribed),
        _ => profile::read(section, files, &prescribed),
    }
}

fn constant_speed(section: &Section, prescribed: &PrescribedCoordinate) -> Result<Motion> {
    let axis = prescribed.axis;
    let Some(per_turn) = prescribed.per_turn() else {
        let kind = section.need("type")?;
        let what = match &prescribed.tool {
            None => format!(
                "is \"constant-speed\", but the drive link has a stroke, {}: it cannot move on forever",
                axis.range()
            ),
            Some(tool) => format!(
                "is \"constant-speed\", but {} goes from {} only: it cannot move on forever",
                tool.name(),
                axis.range()
            ),
        };
        return Err(kind
            .problem(&what, "not on a stroke")
            .help("use type = \"cycle\" with moves forth and back, or \"point-to-point\""));
    };
    let start = start(section, prescribed)?;
    let speed = section.value("speed")?;
    section.finish()?;
    if speed.si.abs() < axis.speed().smallest {
        return Err(speed
            .problem(
                &format!("is {}, but must not be zero", speed.shown()),
                "standstill",
            )
            .help("a negative speed turns clockwise; for a machine at rest, remove [motion]"));
    }
    Ok(prescribed.of_tool(Motion::constant_speed(start, speed.si, per_turn)))
}
