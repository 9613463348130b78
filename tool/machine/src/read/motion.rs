//! `[motion]`: the prescribed motion of the drive link.

use jred::Domain;
use jred::machine::motion::Law;
use std::f64::consts::TAU;

use crate::model::motion::{Motion, Segment};
use crate::text::file::Files;

use super::drive_link::DriveLink;
use super::profile;
use crate::number::rounding::figure;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{SHARE, TIME};

/// The most segments of a motion.
const MAX_SEGMENTS: usize = 1000;

/// A cycle closes if its moves miss a whole number of turns by less than this (turns).
const CLOSED: f64 = 1e-9;

/// The motion laws, as machine files write them.
pub(super) const LAWS: [&str; 7] = [
    "trapezoid",
    "polynomial-345",
    "cycloidal",
    "modified-sine",
    "modified-trapezoid",
    "polynomial-4567",
    "simple-sine",
];

/// The prescribed motion, if the file has one. A profile's file is looked for among `files`.
pub(super) fn read(root: &Section, files: &dyn Files, drive: DriveLink) -> Result<Option<Motion>> {
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
        1 => segments(&section, true, drive)?,
        2 => segments(&section, false, drive)?,
        _ => profile::read(&section, files, drive)?,
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

fn segments(section: &Section, cyclic: bool, drive: DriveLink) -> Result<Motion> {
    let start = start(section, drive)?;
    let item = section.require(
        "segment",
        "[[motion.segment]] once for each move = \"…\" and each dwell = \"…\"",
    )?;
    let parts = item.sections("[[motion.segment]]")?;
    finish(section)?;
    if parts.is_empty() || parts.len() > MAX_SEGMENTS {
        return Err(item
            .problem(
                &format!(
                    "has {} entries, but must have 1 to {MAX_SEGMENTS}",
                    parts.len()
                ),
                "segments",
            )
            .help("give a long motion as positions in a CSV file: type = \"profile\""));
    }
    let segments = parts
        .iter()
        .map(|part| segment(part, drive))
        .collect::<Result<Vec<_>>>()?;
    check_stroke(start, &parts, &segments, drive)?;
    if cyclic {
        check_closed(section, &parts, &segments, drive)?;
    }
    Motion::segments(start, &segments, cyclic).map_err(|(index, error)| {
        let part = parts.get(index).unwrap_or(section);
        part.problem(format!("{}: {error}", part.title()), "this segment")
            .help(error.cure().to_string())
    })
}

/// One move or one dwell.
fn segment(section: &Section, drive: DriveLink) -> Result<Segment> {
    let law_key = section.get("law");
    let (way, dwell) = (section.get("move"), section.get("dwell"));
    if let (Some(way), Some(dwell)) = (&way, &dwell) {
        return Err(
            Problem::new(format!("{} has both `move` and `dwell`", section.title()))
                .at(way.key_span(), "a move")
                .at(dwell.key_span(), "a pause")
                .help(
                    "write two [[motion.segment]] tables, one for the move and one for the dwell",
                ),
        );
    }
    if let Some(dwell) = dwell {
        let duration = dwell.quantity(&TIME)?.positive()?;
        if let Some(law) = law_key {
            return Err(
                Problem::new(format!("`law` is not used in {}, a dwell", section.title()))
                    .at(law.key_span(), "remove this")
                    .help("a dwell has only dwell = \"0.25 s\""),
            );
        }
        section.finish_with(|key| {
            (key == "duration").then_some("give the duration of a pause as dwell = \"0.25 s\"")
        })?;
        return Ok(Segment {
            distance: 0.0,
            duration,
            law: Law::default(),
        });
    }
    let Some(way) = way else {
        let example = if drive.slides() { "150 mm" } else { "360 deg" };
        return Err(section.missing(
            "move",
            &format!("move = \"{example}\" with law and duration, or dwell = \"0.25 s\""),
        ));
    };
    let distance = way.quantity(drive.position())?;
    if distance.si.abs() < drive.position().smallest {
        return Err(distance
            .problem("is zero, so nothing moves", "zero")
            .help("write a pause as dwell = \"0.25 s\", without law and duration"));
    }
    let duration = section.quantity("duration", &TIME)?.positive()?;
    let law = law(section)?;
    section.finish_with(|key| {
        matches!(key, "accelerate" | "decelerate")
            .then_some("only the law \"trapezoid\" uses these shares")
    })?;
    Ok(Segment {
        distance: distance.si,
        duration,
        law,
    })
}

/// The law of a segment, with the shares of a trapezoid.
pub(super) fn law(section: &Section) -> Result<Law> {
    let law = section.require("law", "law = \"polynomial-345\"")?;
    Ok(match law.choice(&LAWS)? {
        0 => {
            let keys = ["accelerate", "decelerate"];
            let mut shares = [1.0 / 3.0; 2];
            let mut place = law.span();
            for (key, share) in keys.into_iter().zip(&mut shares) {
                if let Some(value) = section.optional(key, &SHARE)? {
                    place = value.span();
                    *share = value.up_to(1.0)?;
                }
            }
            let [accelerate, decelerate] = shares;
            let law = Law::Trapezoid {
                accelerate,
                decelerate,
            };
            if law.check().is_err() {
                return Err(Problem::new(format!(
                    "`accelerate` and `decelerate` in {} add up to {} % of the duration",
                    section.title(),
                    figure((accelerate + decelerate) * 100.0)
                ))
                .at(place, "too large")
                .help(format!(
                    "at most 100 % in total: here {} % + {} % (a share not given is 1/3)",
                    figure(accelerate * 100.0),
                    figure(decelerate * 100.0)
                )));
            }
            law
        }
        1 => Law::Polynomial345,
        2 => Law::Cycloidal,
        3 => Law::ModifiedSine,
        4 => Law::ModifiedTrapezoid,
        5 => Law::Polynomial4567,
        _ => Law::SimpleSine,
    })
}

/// No move goes beyond the stroke. Every motion law goes from one end of its move to the other without turning back, so
/// the ends decide.
fn check_stroke(
    start: f64,
    parts: &[Section],
    segments: &[Segment],
    drive: DriveLink,
) -> Result<()> {
    let mut position = start;
    for (part, segment) in parts.iter().zip(segments) {
        position += segment.distance;
        if !drive.reaches(position) {
            return Err(part
                .problem(
                    format!(
                        "{} ends at {}, outside the stroke, {}",
                        part.title(),
                        drive.coordinate.place(position),
                        drive.range()
                    ),
                    "leaves the stroke",
                )
                .help(
                    "shorten this move, start elsewhere, or lengthen the stroke of the mechanism",
                ));
        }
    }
    Ok(())
}

/// A cycle on a stroke ends where it began.
fn check_returns(
    section: &Section,
    parts: &[Section],
    segments: &[Segment],
    drive: DriveLink,
) -> Result<()> {
    let sum: f64 = segments.iter().map(|s| s.distance).sum();
    let ways: f64 = segments.iter().map(|s| s.distance.abs()).sum();
    if sum.abs() <= CLOSED * ways {
        return Ok(());
    }
    let shown = |way: f64| {
        format!(
            "{} {}",
            figure(drive.coordinate.shown(way)),
            drive.coordinate.unit()
        )
    };
    let mut problem = section.problem(
        format!(
            "the moves of this cycle add up to {}, so it does not end where it started",
            shown(sum)
        ),
        "a cycle must close",
    );
    for (part, segment) in parts.iter().zip(segments).take(20) {
        if segment.distance != 0.0 {
            problem = problem.at(part.header(), shown(segment.distance));
        }
    }
    Err(problem.help(format!(
        "add a move of {}, or use type = \"point-to-point\" for a motion that does not repeat",
        shown(-sum)
    )))
}

/// A cycle ends where it began, or whole turns further on.
fn check_closed(
    section: &Section,
    parts: &[Section],
    segments: &[Segment],
    drive: DriveLink,
) -> Result<()> {
    if drive.domain != Domain::Turn {
        return check_returns(section, parts, segments, drive);
    }
    let turns = segments.iter().map(|s| s.distance).sum::<f64>() / TAU;
    let missing = turns.round() - turns;
    if missing.abs() <= CLOSED * segments.len() as f64 {
        return Ok(());
    }
    let degrees = |turns: f64| format!("{} deg", figure(turns * 360.0));
    let mut problem = section.problem(
        format!(
            "the moves of this cycle add up to {}, which is not a whole number of turns",
            degrees(turns)
        ),
        "a cycle must close",
    );
    let moves = parts
        .iter()
        .zip(segments)
        .filter(|(_, segment)| segment.distance != 0.0);
    for (part, segment) in moves.take(20) {
        problem = problem.at(part.header(), degrees(segment.distance / TAU));
    }
    Err(problem.help(format!(
        "add a move of {} to reach {}, or use type = \"point-to-point\" for a motion that does not repeat",
        degrees(missing),
        degrees(turns.round())
    )))
}
