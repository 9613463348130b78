//! `[motion]`: how the drive link is to go.

use std::f64::consts::TAU;
use std::path::Path;

use jred::motion::Law;

use crate::motion::{Motion, Segment};

use super::kind::{ANGLE, ANGULAR_SPEED, SHARE, TIME};
use super::problem::{Problem, Result, figure};
use super::profile;
use super::section::Section;

/// The most segments of a motion.
const MAX_SEGMENTS: usize = 1000;

/// A cycle closes if its moves miss a whole number of turns by less than this (turns).
const CLOSED: f64 = 1e-9;

const LAWS: [&str; 4] = ["trapezoid", "polynomial-345", "cycloidal", "modified-sine"];

/// The prescribed motion, if the file has one. A profile's file is looked for in `folder`.
pub(super) fn read(root: &Section, folder: &Path) -> Result<Option<Motion>> {
    let Some(item) = root.get("motion") else {
        return Ok(None);
    };
    let section = item.section("[motion]".into())?;
    let types = ["constant-speed", "cycle", "point-to-point", "profile"];
    let motion = match section
        .require("type", "type = \"cycle\"")?
        .choice(&types)?
    {
        0 => constant_speed(&section)?,
        1 => segments(&section, true)?,
        2 => segments(&section, false)?,
        _ => profile::read(&section, folder)?,
    };
    Ok(Some(motion))
}

/// Reports keys that the type of motion does not have.
pub(super) fn finish(section: &Section) -> Result<()> {
    section.finish_with(|key| match key {
        "segment" => Some("segments belong to the types \"cycle\" and \"point-to-point\""),
        "speed" => Some("a speed belongs to the type \"constant-speed\""),
        "file" | "cyclic" => Some("a file belongs to the type \"profile\""),
        "start" => Some("a profile starts at its first position"),
        _ => None,
    })
}

fn start(section: &Section) -> Result<f64> {
    Ok(section
        .optional("start", &ANGLE)?
        .map_or(0.0, |value| value.si))
}

fn constant_speed(section: &Section) -> Result<Motion> {
    let start = start(section)?;
    let speed = section.quantity("speed", &ANGULAR_SPEED)?;
    finish(section)?;
    if speed.si.abs() < ANGULAR_SPEED.smallest {
        return Err(speed
            .problem(
                &format!("is {}, but must not be zero", speed.shown()),
                "standstill",
            )
            .help("a negative speed turns clockwise; for a machine at rest leave [motion] out"));
    }
    Ok(Motion::constant_speed(start, speed.si))
}

fn segments(section: &Section, cyclic: bool) -> Result<Motion> {
    let start = start(section)?;
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
            .help("give a long motion as recorded positions: type = \"profile\" with a CSV file"));
    }
    let segments = parts.iter().map(segment).collect::<Result<Vec<_>>>()?;
    if cyclic {
        check_closed(section, &parts, &segments)?;
    }
    Motion::segments(start, &segments, cyclic).map_err(|(index, error)| {
        let part = parts.get(index).unwrap_or(section);
        part.problem(format!("{}: {error}", part.title()), "this segment")
    })
}

/// One move or one dwell.
fn segment(section: &Section) -> Result<Segment> {
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
            return Err(Problem::new(format!(
                "`law` has no meaning in {}, a dwell",
                section.title()
            ))
            .at(law.key_span(), "remove this")
            .help("a dwell is only dwell = \"0.25 s\""));
        }
        section.finish_with(|key| {
            (key == "duration").then_some("the duration of a pause is written dwell = \"0.25 s\"")
        })?;
        return Ok(Segment {
            distance: 0.0,
            duration,
            law: Law::default(),
        });
    }
    let Some(way) = way else {
        return Err(section.missing(
            "move",
            "move = \"360 deg\" with law and duration, or dwell = \"0.25 s\"",
        ));
    };
    let distance = way.quantity(&ANGLE)?;
    if distance.si.abs() < ANGLE.smallest {
        return Err(distance
            .problem("is zero, so nothing moves", "zero")
            .help("write a pause as dwell = \"0.25 s\", without law and duration"));
    }
    let duration = section.quantity("duration", &TIME)?.positive()?;
    let law = law(section)?;
    section.finish_with(|key| {
        matches!(key, "accelerate" | "decelerate")
            .then_some("only the law \"trapezoid\" has these shares")
    })?;
    Ok(Segment {
        distance: distance.si,
        duration,
        law,
    })
}

fn law(section: &Section) -> Result<Law> {
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
            let sum = accelerate + decelerate;
            if sum > 1.0 + 1e-6 {
                return Err(Problem::new(format!(
                    "`accelerate` and `decelerate` in {} are together {} % of the duration",
                    section.title(),
                    figure(sum * 100.0)
                ))
                .at(place, "too large")
                .help(format!(
                    "together at most 100 %: here {} % + {} % (a share that is not given is 1/3)",
                    figure(accelerate * 100.0),
                    figure(decelerate * 100.0)
                )));
            }
            Law::Trapezoid {
                accelerate: accelerate as f32,
                decelerate: decelerate as f32,
            }
        }
        1 => Law::Polynomial345,
        2 => Law::Cycloidal,
        _ => Law::ModifiedSine,
    })
}

/// A cycle ends where it began, or whole turns further on.
fn check_closed(section: &Section, parts: &[Section], segments: &[Segment]) -> Result<()> {
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
