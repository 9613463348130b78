//! `[[mechanism.segment]]`: the cam program.

use std::f64::consts::TAU;

use jred::mechanism::cam::{CamError, MAX_SEGMENTS, Program, Segment, Shape};

use crate::number::rounding::figure;
use crate::read::law;
use crate::text::item::{Item, Value};
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::{ANGLE, CAM_ACCELERATION, CAM_TURNING, CAM_VELOCITY, Kind, LENGTH, SHARE};

/// The laws beyond those of a motion of the drive link.
const CONSTANT_VELOCITY: &str = "constant-velocity";
const POLYNOMIAL: &str = "polynomial-5";

/// A segment as it is written.
enum Written<'a> {
    /// A complete segment.
    Known(Segment),
    /// A polynomial with [s′, s″] at its start and end, as far as the file gives them.
    Polynomial {
        angle: f64,
        rise: f64,
        ends: [[Option<f64>; 2]; 2],
        law: Item<'a>,
    },
}

/// The cam program. `header`: title of its segments in messages; `oscillating`: rises are angles.
pub(in crate::read::mechanism) fn read(
    section: &Section,
    header: &str,
    oscillating: bool,
) -> Result<Program> {
    let item = section.require(
        "segment",
        &format!("{header} once for each rise = \"…\", return = \"…\" and dwell = \"…\""),
    )?;
    let parts = item.sections(header)?;
    if parts.is_empty() || parts.len() > MAX_SEGMENTS {
        let what = format!(
            "has {} entries, but must have 1 to {MAX_SEGMENTS}",
            parts.len()
        );
        return Err(item
            .problem(&what, "segments")
            .help("one turn of the cam is made of rises, dwells and returns"));
    }
    let way = if oscillating { &ANGLE } else { &LENGTH };
    let written = parts
        .iter()
        .map(|part| segment(part, way, oscillating))
        .collect::<Result<Vec<_>>>()?;
    let segments = resolved(&parts, &written)?;
    Program::new(&segments).map_err(|error| problem(section, &parts, &segments, way, &error))
}

fn segment<'a>(
    section: &Section<'a>,
    way: &'static Kind,
    oscillating: bool,
) -> Result<Written<'a>> {
    let keys = ["dwell", "rise", "return"];
    let given: Vec<_> = keys
        .into_iter()
        .filter_map(|key| section.get(key).map(|item| (key, item)))
        .collect();
    let (key, item) = match given.as_slice() {
        [one] => one,
        [] => {
            return Err(section.missing(
                "rise",
                "rise = \"…\" or return = \"…\" with law and angle, or dwell = \"60 deg\"",
            ));
        }
        [(first, one), (second, other), ..] => {
            return Err(Problem::new(format!(
                "{} has both `{first}` and `{second}`",
                section.title()
            ))
            .at(one.key_span(), *first)
            .at(other.key_span(), *second)
            .help("write a separate segment for each"));
        }
    };
    if *key == "dwell" {
        let angle = item.quantity(&ANGLE)?.positive()?;
        section.finish_with(|key| match key {
            "angle" => Some("give the angle of a dwell as dwell = \"60 deg\""),
            "law" => Some("a dwell has no law"),
            _ => None,
        })?;
        return Ok(Written::Known(Segment::dwell(angle)));
    }
    let size = item.quantity(way)?;
    let rise = if *key == "rise" { size.si } else { -size.si };
    let angle = section.quantity("angle", &ANGLE)?.positive()?;
    let law = section.require("law", "law = \"cycloidal\"")?;
    if law.is_word("table") {
        return Err(law
            .problem("is \"table\", which is no law of a segment", "not here")
            .help("a table is the whole program of a disc cam: write lift = \"lift.csv\" into [mechanism], in place of all segments"));
    }
    let names = law::LAWS.into_iter().chain([CONSTANT_VELOCITY, POLYNOMIAL]);
    let names: Vec<&str> = names.collect();
    let read = match names.get(law.choice(&names)?).copied() {
        Some(CONSTANT_VELOCITY) => {
            positive(size)?;
            Written::Known(Segment::constant_velocity(angle, rise))
        }
        Some(POLYNOMIAL) => Written::Polynomial {
            angle,
            rise,
            ends: ends(section, oscillating)?,
            law,
        },
        _ => {
            positive(size)?;
            Written::Known(Segment::law(law::read(section)?, angle, rise))
        }
    };
    section.finish_with(|key| match key {
        "accelerate" | "decelerate" => Some("only the law \"trapezoid\" uses these shares"),
        "sine" | "constant" | "cosine" => {
            Some("only the law \"sine-constant-cosine\" uses these shares")
        }
        "start_velocity" | "end_velocity" | "start_acceleration" | "end_acceleration" => {
            Some("only the law \"polynomial-5\" uses these end values")
        }
        "duration" => Some("a cam program is defined over the angle of the cam"),
        _ => None,
    })?;
    Ok(read)
}

/// Checks that a rise or a return is greater than zero.
fn positive(size: Value) -> Result<()> {
    size.positive().map(|_| ())
}

/// [s′, s″] at both ends of a polynomial, as far as the file gives them.
fn ends(section: &Section, oscillating: bool) -> Result<[[Option<f64>; 2]; 2]> {
    let (velocity, acceleration) = if oscillating {
        (&SHARE, &CAM_TURNING)
    } else {
        (&CAM_VELOCITY, &CAM_ACCELERATION)
    };
    let read = |key, kind| Ok::<_, Problem>(section.optional(key, kind)?.map(|value| value.si));
    Ok([
        [
            read("start_velocity", velocity)?,
            read("start_acceleration", acceleration)?,
        ],
        [
            read("end_velocity", velocity)?,
            read("end_acceleration", acceleration)?,
        ],
    ])
}

/// The segments; a polynomial takes ends that are not given from its neighbours.
fn resolved(parts: &[Section], written: &[Written]) -> Result<Vec<Segment>> {
    let count = written.len();
    let resolve = |(index, one): (usize, &Written)| {
        let (angle, rise, ends, law) = match one {
            Written::Known(segment) => return Ok(*segment),
            Written::Polynomial {
                angle,
                rise,
                ends,
                law,
            } => (*angle, *rise, *ends, law),
        };
        let neighbours = [(index + count - 1) % count, (index + 1) % count];
        let mut found = [[0.0; 2]; 2];
        for (side, neighbour) in neighbours.into_iter().enumerate() {
            let near = end_of(&written[neighbour], 1 - side);
            for order in 0..2 {
                let value = ends[side][order].or(near[order]);
                // An acceleration that neither gives is zero.
                found[side][order] = match value {
                    Some(value) => value,
                    None if order == 1 => 0.0,
                    None => {
                        let key = ["start_velocity", "end_velocity"][side];
                        let what = format!("needs `{key}` in {}", parts[index].title());
                        let problem = law.problem(&what, "this end is open");
                        return Err(problem.help(format!(
                            "the neighbour, {}, does not give the velocity either: give it in one of the two",
                            parts[neighbour].title()
                        )));
                    }
                };
            }
        }
        Ok(Segment::polynomial(angle, rise, found[0], found[1]))
    };
    written.iter().enumerate().map(resolve).collect()
}

/// [s′, s″] at the start (0) or the end (1) of a segment, as far as known.
fn end_of(written: &Written, side: usize) -> [Option<f64>; 2] {
    match written {
        Written::Polynomial { ends, .. } => ends[side],
        Written::Known(segment) => match segment.shape {
            Shape::Dwell => [Some(0.0); 2],
            Shape::Law(law) => {
                let bend = segment.rise / (segment.angle * segment.angle);
                [Some(0.0), Some(law.at(side as f64)[2] * bend)]
            }
            Shape::Polynomial { start, end } => [start, end][side].map(Some),
        },
    }
}

/// Faults of the program, shown at its segments.
fn problem(
    section: &Section,
    parts: &[Section],
    segments: &[Segment],
    way: &Kind,
    error: &CamError,
) -> Problem {
    let degrees = |phi: f64| format!("{} deg", figure(phi.to_degrees()));
    // Rises in the unit of the key.
    let shown = |rise: f64| {
        if way.unit == ANGLE.unit {
            degrees(rise)
        } else {
            format!("{} mm", figure(rise * 1e3))
        }
    };
    let part = |index: usize| parts.get(index).unwrap_or(section);
    let labelled = |mut problem: Problem, label: &dyn Fn(&Segment) -> String| {
        for (part, segment) in parts.iter().zip(segments) {
            problem = problem.at(part.header(), label(segment));
        }
        problem
    };
    match *error {
        CamError::NotOneTurn { sum } => {
            let message = format!(
                "the segments of the cam cover {}, but must cover exactly one turn",
                degrees(sum)
            );
            let verb = if sum < TAU { "add" } else { "take off" };
            labelled(Problem::new(message), &|segment| degrees(segment.angle))
                .help(format!("{verb} {}", degrees((TAU - sum).abs())))
        }
        CamError::NotClosed { segment, gap } => {
            let message = format!(
                "after a turn of the cam, the follower is {} off",
                shown(gap)
            );
            labelled(Problem::new(message), &|segment| shown(segment.rise)).help(format!(
                "rises and returns must add up to the same stroke: change the rise in {} by {}",
                part(segment).title(),
                shown(-gap)
            ))
        }
        CamError::VelocityJump {
            segment,
            phi,
            from,
            to,
        } => {
            let next = (segment + 1) % parts.len();
            let label = |v: f64| format!("{} per rad", shown(v));
            Problem::new(format!(
                "the follower's velocity jumps at φ = {}",
                degrees(phi)
            ))
            .at(part(segment).header(), label(from))
            .at(part(next).header(), label(to))
            .help("put a segment with law = \"polynomial-5\" between them: it takes its end velocities from its neighbours")
        }
        _ => section.error(*error, "in this cam program"),
    }
}
