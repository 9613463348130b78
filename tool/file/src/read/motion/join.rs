//! `law = "join"`: from the end of a motion of the tool, through dead centres, to rest or to the start of the cycle. It is a polynomial of fifth
//! degree of the drive link's position.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::motion::{End, Polynomial, State};

use crate::model::motion::MotionSegment;
use crate::text::problem::Result;
use crate::text::section::Section;

use super::PrescribedCoordinate;
use super::ends::Ends;
use super::segment::SegmentDraft;

/// Share of a turn that counts as rounding, so that a join does not make one turn more.
const ROUNDING: f64 = 1e-9;

/// Checks the places of joins in the motion.
pub(super) fn check(
    section: &Section,
    parts: &[Section],
    written: &[(SegmentDraft, Ends)],
    cyclic: bool,
    prescribed: &PrescribedCoordinate,
) -> Result<()> {
    let Some(first) = written.iter().position(|(written, _)| written.is_join()) else {
        return Ok(());
    };
    let part = |index: usize| parts.get(index).unwrap_or(section);
    let last = written.len() - 1;
    if first == 0 {
        return Err(part(0)
            .problem(
                "a motion cannot begin with a join: nothing is before it",
                "joins nothing",
            )
            .help("begin the cycle with the segment that it leads to"));
    }
    for (index, (written, _)) in written.iter().enumerate() {
        let SegmentDraft::Join { to, .. } = written else {
            // After a join, the start of a tool's move is not known.
            if index > first && prescribed.tool.is_some() && !written.is_dwell() {
                return Err(part(index)
                    .problem(
                        format!(
                            "{} moves the tool behind a join, where only dwells and joins can follow",
                            part(index).title()
                        ),
                        "not here",
                    )
                    .at(part(first).header(), "the join")
                    .help("begin the cycle with the moves of the tool; one join leads back to their start"));
            }
            continue;
        };
        match to {
            None if !cyclic => {
                return Err(part(index)
                    .problem(
                        format!("{} leads nowhere", part(index).title()),
                        "no `to`",
                    )
                    .help("a motion that does not repeat has no start to go back to: give to = \"…\", the drive link's position at the end"));
            }
            None if index < last => {
                return Err(part(index)
                    .problem(
                        format!(
                            "{} leads to the start of the cycle, but other segments follow",
                            part(index).title()
                        ),
                        "not the last",
                    )
                    .help("give to = \"…\", the drive link's position at its end, or make it the last segment"));
            }
            _ => {}
        }
    }
    let closes = matches!(
        written.get(last),
        Some((SegmentDraft::Join { to: None, .. }, _))
    );
    if cyclic && !closes {
        return Err(part(last)
            .problem(
                "a cycle with joins must end with one that leads back to its start",
                "the last segment",
            )
            .help("add a segment with law = \"join\" and a duration, without `to`"));
    }
    Ok(())
}

/// Replaces the joins, and the dwells after them, by their motion of the drive link.
pub(super) fn resolve(
    written: &[(SegmentDraft, Ends)],
    segments: &mut [MotionSegment],
    start: f64,
    prescribed: &PrescribedCoordinate,
) {
    let state = |phi: f64, [omega, alpha]: [f64; 2]| State { phi, omega, alpha };
    let Some(origin) = segments.first().map(|first| first.ends()[0]) else {
        return;
    };
    let origin = prescribed.drive_state(state(start, origin));
    let mut position = start;
    // The drive link's state, from the first join on.
    let mut drive: Option<State<f64>> = None;
    let mut before = [0.0; 2];
    for ((written, _), segment) in written.iter().zip(segments) {
        if let SegmentDraft::Join { duration, to } = written {
            let from = drive.unwrap_or_else(|| prescribed.drive_state(state(position, before)));
            let target = to.as_ref().map_or(origin, |to| state(to.si, [0.0; 2]));
            let way = ahead(from, target, prescribed.drive.domain);
            let end = |state: State<f64>| End::new(state.omega, state.alpha);
            let course = Polynomial::between(way, *duration, end(from), end(target));
            *segment = MotionSegment::polynomial(way, *duration, course).of_drive(from.phi);
            drive = Some(state(from.phi + way, [target.omega, target.alpha]));
            continue;
        }
        before = segment.ends()[1];
        match &mut drive {
            Some(drive) => {
                drive.phi += segment.distance;
                [drive.omega, drive.alpha] = before;
            }
            None => position += segment.distance,
        }
    }
}

/// The distance between two positions. On a turn: to the next such position in the direction of motion.
fn ahead(from: State<f64>, to: State<f64>, domain: Domain) -> f64 {
    let way = to.phi - from.phi;
    if domain != Domain::Turn {
        return way;
    }
    let forwards = if from.omega == 0.0 {
        to.omega
    } else {
        from.omega
    } >= 0.0;
    let turns = way / TAU;
    let rest = if forwards {
        turns - turns.floor()
    } else {
        turns - turns.ceil()
    };
    // A target just behind, which would be a turn ahead, counts as reached.
    let rest = if 1.0 - rest.abs() < ROUNDING {
        0.0
    } else {
        rest
    };
    rest * TAU
}
