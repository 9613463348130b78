//! `[[mechanism.segment]]`: the cam program.

use std::f64::consts::TAU;

use jred::mechanism::cam::{CamError, Program, Segment, Shape};

use crate::keys::cam::CAM_LAWS;
use crate::number::rounding::figure;
use crate::read::law;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// The laws beyond those of a motion of the drive link.
const CONSTANT_VELOCITY: usize = 10;
const POLYNOMIAL: usize = 11;

/// A segment as it is written.
enum SegmentDraft<'a> {
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

/// The cam program. Whether its rises are angles or lengths is set in the section.
pub(in crate::read::mechanism) fn read(section: &Section) -> Result<Program> {
    let parts = section.tables("segment")?;
    if parts.is_empty() {
        return Err(section.lacks("segment"));
    }
    let written = parts.iter().map(segment).collect::<Result<Vec<_>>>()?;
    let segments = resolved(&parts, &written)?;
    Program::new(&segments).map_err(|error| problem(section, &parts, &segments, &error))
}

fn segment<'a>(section: &Section<'a>) -> Result<SegmentDraft<'a>> {
    let Some((key, item)) = section.one_of(&["dwell", "rise", "return"]) else {
        return Err(section.missing(
            "rise",
            "rise = \"…\" or return = \"…\" with law and angle, or dwell = \"60 deg\"",
        ));
    };
    if key == "dwell" {
        let angle = item.value()?.si;
        section.finish_with(|key| match key {
            "angle" => Some("give the angle of a dwell as dwell = \"60 deg\""),
            "law" => Some("a dwell has no law"),
            _ => None,
        })?;
        return Ok(SegmentDraft::Known(Segment::dwell(angle)));
    }
    let size = item.value()?;
    let rise = if key == "rise" { size.si } else { -size.si };
    let angle = section.value("angle")?.si;
    let law = section.need("law")?;
    if law.is_word("table") {
        return Err(law
            .problem("is \"table\", which is no law of a segment", "not here")
            .help("a table is the whole program of a disc cam: write lift = \"lift.csv\" into [mechanism], in place of all segments"));
    }
    let word = law.word()?;
    section.choose(CAM_LAWS[word]);
    if word != POLYNOMIAL {
        size.check_positive()?;
    }
    let read = match word {
        CONSTANT_VELOCITY => SegmentDraft::Known(Segment::constant_velocity(angle, rise)),
        POLYNOMIAL => SegmentDraft::Polynomial {
            angle,
            rise,
            ends: ends(section)?,
            law,
        },
        _ => SegmentDraft::Known(Segment::law(law::read(section)?, angle, rise)),
    };
    section.finish()?;
    Ok(read)
}

/// [s′, s″] at both ends of a polynomial, as far as the file gives them.
fn ends(section: &Section) -> Result<[[Option<f64>; 2]; 2]> {
    Ok([
        [
            section.maybe("start_velocity")?,
            section.maybe("start_acceleration")?,
        ],
        [
            section.maybe("end_velocity")?,
            section.maybe("end_acceleration")?,
        ],
    ])
}

/// The segments; a polynomial takes ends that are not given from its neighbours.
fn resolved(parts: &[Section], written: &[SegmentDraft]) -> Result<Vec<Segment>> {
    let count = written.len();
    let resolve = |(index, one): (usize, &SegmentDraft)| {
        let (angle, rise, ends, law) = match one {
            SegmentDraft::Known(segment) => return Ok(*segment),
            SegmentDraft::Polynomial {
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
fn end_of(written: &SegmentDraft, side: usize) -> [Option<f64>; 2] {
    match written {
        SegmentDraft::Polynomial { ends, .. } => ends[side],
        SegmentDraft::Known(segment) => match segment.shape {
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
    error: &CamError,
) -> Problem {
    let degrees = |phi: f64| format!("{} deg", figure(phi.to_degrees()));
    // Rises in the unit of the key.
    let shown = |rise: f64| {
        if section.slides() {
            format!("{} mm", figure(rise * 1e3))
        } else {
            degrees(rise)
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
