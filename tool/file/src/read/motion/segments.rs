//! The segments of a motion in sequence: open ends, and whether they fit together.

use jred::machine::motion::{End, Polynomial};

use crate::model::motion::{Motion, MotionSegment, Phase, Reach, change, fastest};
use crate::read::drive_link::DriveLink;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::text::value::Value;

use super::ends::Ends;
use super::join;
use super::segment::{self, SegmentDraft};
use super::{PrescribedCoordinate, closed, start};

/// The most segments of a motion.
const MAX_SEGMENTS: usize = 1000;

/// Share of the largest speed by which the speeds of two neighbours may differ: rounding in the file.
const CONTINUOUS: f64 = 1e-6;

/// The motion of a section with segments.
pub(super) fn read(
    section: &Section,
    cyclic: bool,
    prescribed: &PrescribedCoordinate,
) -> Result<Motion> {
    let drive = prescribed.axis;
    let start = start(section, prescribed)?;
    let item = section.need("segment")?;
    let parts = section.tables("segment")?;
    section.finish()?;
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
    let written = parts
        .iter()
        .map(|part| segment::read(part, prescribed))
        .collect::<Result<Vec<_>>>()?;
    join::check(section, &parts, &written, cyclic, prescribed)?;
    let chain = Chain {
        parts: &parts,
        written: &written,
        cyclic,
        drive,
    };
    let mut segments = chain.segments()?;
    chain.check_speeds(&segments)?;
    join::resolve(&written, &mut segments, start, prescribed);
    let motion = Motion::segments(start, &segments, cyclic).map_err(|(index, error)| {
        let part = parts.get(index).unwrap_or(section);
        part.titled(error, "this segment")
    })?;
    let motion = prescribed.of_tool(motion);
    chain.check_stroke(&motion, prescribed.drive)?;
    prescribed.check_reach(&motion, |index, what| {
        let part = parts.get(index).unwrap_or(section);
        part.problem(format!("{} {what}", part.title()), "this segment")
    })?;
    // A final join closes the cycle.
    if cyclic && !written.iter().any(|(written, _)| written.is_join()) {
        closed::check(section, &parts, &segments, start, prescribed)?;
    }
    Ok(motion)
}

/// The segments as written, in their order.
struct Chain<'a> {
    parts: &'a [Section<'a>],
    written: &'a [(SegmentDraft, Ends)],
    cyclic: bool,
    drive: DriveLink,
}

impl Chain<'_> {
    /// The index of the segment before (0) or after (1) segment `index`; in a cycle the last is before the first.
    fn neighbour(&self, index: usize, side: usize) -> Option<usize> {
        let count = self.written.len();
        match side {
            0 if index > 0 => Some(index - 1),
            1 if index + 1 < count => Some(index + 1),
            _ if !self.cyclic => None,
            0 => Some(count - 1),
            _ => Some(0),
        }
    }

    /// The speed at the start (0) or end (1) of a segment, if the segment gives it.
    fn own_speed(&self, index: usize, side: usize) -> Option<f64> {
        let (written, ends) = &self.written[index];
        match written {
            SegmentDraft::Known(segment) => Some(segment.ends()[side][0]),
            _ => ends.speeds[side].as_ref().map(|speed| speed.si),
        }
    }

    /// The speeds at the ends of a segment: its own, else those of its neighbours, else zero.
    fn speeds(&self, index: usize) -> [f64; 2] {
        [0, 1].map(|side| {
            let beyond = || {
                let neighbour = self.neighbour(index, side)?;
                self.own_speed(neighbour, 1 - side)
            };
            self.own_speed(index, side).or_else(beyond).unwrap_or(0.0)
        })
    }

    /// All segments with complete ends. Polynomials are last, because they take accelerations from their neighbours.
    fn segments(&self) -> Result<Vec<MotionSegment>> {
        let mut known: Vec<Option<MotionSegment>> = Vec::with_capacity(self.written.len());
        for (index, (written, ends)) in self.written.iter().enumerate() {
            let speeds = self.speeds(index);
            known.push(match written {
                SegmentDraft::Known(segment) => Some(segment.clone()),
                SegmentDraft::Polynomial { .. } => None,
                // A placeholder: its ends are those of the drive link, which are known last.
                SegmentDraft::Join { duration, .. } => Some(MotionSegment::dwell(*duration)),
                SegmentDraft::Trapezoid {
                    distance,
                    duration,
                    law,
                    shares,
                } => Some(if speeds.iter().all(|speed| speed.abs() <= 0.0) {
                    MotionSegment::law(*distance, *duration, *law)
                } else {
                    trapezoid(*distance, *duration, *shares, speeds)
                }),
                SegmentDraft::Limited {
                    distance,
                    limits,
                    speed,
                } => {
                    let largest = speed.as_ref();
                    self.check_limits(index, ends, speeds, distance.as_ref(), largest)?;
                    Some(match distance {
                        None => {
                            let (distance, phases) = change(speeds, limits);
                            MotionSegment::phases(distance, phases).within(*limits)
                        }
                        Some(distance) => {
                            let phases = fastest(distance.si, speeds, limits);
                            let phases = phases.map_err(|short| {
                                self.too_short(index, distance, speeds, short.least)
                            })?;
                            MotionSegment::phases(distance.si, phases).within(*limits)
                        }
                    })
                }
            });
        }
        let polynomial = |index: usize| {
            let (written, ends) = &self.written[index];
            let SegmentDraft::Polynomial { distance, duration } = *written else {
                return MotionSegment::dwell(0.0);
            };
            let speeds = self.speeds(index);
            let end = |side: usize| {
                let neighbour = self.neighbour(index, side);
                let beyond = neighbour.and_then(|neighbour| match &known[neighbour] {
                    Some(segment) => Some(segment.ends()[1 - side][1]),
                    None => self.written[neighbour].1.accelerations[1 - side],
                });
                End {
                    speed: speeds[side],
                    acceleration: ends.accelerations[side].or(beyond).unwrap_or(0.0),
                    jerk: ends.jerks[side],
                }
            };
            let course = Polynomial::between(distance, duration, end(0), end(1));
            MotionSegment::polynomial(distance, duration, course)
        };
        let segments = known.iter().enumerate();
        Ok(segments
            .map(|(index, segment)| segment.clone().unwrap_or_else(|| polynomial(index)))
            .collect())
    }

    /// Checks that end speeds are within the limit and in the direction of the move, and that a change of speed changes it.
    fn check_limits(
        &self,
        index: usize,
        ends: &Ends,
        speeds: [f64; 2],
        distance: Option<&Value>,
        largest: Option<&Value>,
    ) -> Result<()> {
        let title = self.parts[index].title();
        let drive = self.drive;
        if distance.is_none() && (speeds[1] - speeds[0]).abs() <= 0.0 {
            return Err(self.parts[index]
                .problem(
                    format!(
                        "{title} has no `move`, and the speed is {} at both ends",
                        drive.pace(speeds[0])
                    ),
                    "nothing changes",
                )
                .help("give `move`, or end_speed for a change of speed whose distance follows from the limits"));
        }
        for ((side, word), speed) in ["starts", "ends"].into_iter().enumerate().zip(speeds) {
            let place = ends.speeds[side]
                .as_ref()
                .map_or_else(|| self.parts[index].header(), Value::span);
            let source = match (&ends.speeds[side], side) {
                (Some(_), _) => "",
                (None, 0) => ", the speed at which the segment before it ends",
                (None, _) => ", the speed at which the segment after it starts",
            };
            if let Some(largest) = largest.filter(|most| speed.abs() > most.si * (1.0 + CONTINUOUS))
            {
                return Err(Problem::new(format!(
                    "{title} {word} at {}{source}, but `max_speed` is {}",
                    drive.pace(speed),
                    largest.shown()
                ))
                .at(place, "faster")
                .at(largest.span(), "the limit")
                .help("raise max_speed, or lower the speed at this end"));
            }
            if let Some(distance) = distance.filter(|distance| distance.si * speed < 0.0) {
                return Err(Problem::new(format!(
                    "{title} {word} at {}{source}, against its move of {}",
                    drive.pace(speed),
                    distance.shown()
                ))
                .at(place, "the other direction")
                .at(distance.span(), "the move")
                .help("first bring the speed to zero: a segment without `move`, with end_speed and the limits"));
            }
        }
        Ok(())
    }

    fn too_short(&self, index: usize, distance: &Value, speeds: [f64; 2], least: f64) -> Problem {
        let [from, to] = speeds.map(|speed| self.drive.pace(speed));
        distance
            .problem(
                &format!(
                    "is {}, but the change of speed from {from} to {to} takes {} within these limits",
                    distance.shown(),
                    self.drive.distance(least)
                ),
                "too short",
            )
            .at(self.parts[index].header(), "these limits")
            .help("lengthen the move, allow more acceleration or jerk, or change the speeds at its ends")
    }

    /// Checks that each segment starts at the speed with which the one before ends.
    fn check_speeds(&self, segments: &[MotionSegment]) -> Result<()> {
        let ends: Vec<[f64; 2]> = segments
            .iter()
            .map(|segment| segment.ends().map(|[speed, _]| speed))
            .collect();
        let mean = |segment: &MotionSegment| (segment.distance / segment.duration()).abs();
        let most = (segments.iter().map(mean)).chain(ends.iter().flatten().map(|v| v.abs()));
        let most = most.fold(0.0, f64::max);
        for (index, [_, before]) in ends.iter().enumerate() {
            let Some(next) = self.neighbour(index, 1) else {
                continue;
            };
            let after = ends[next][0];
            // A join starts with any speed; the last one ends with that of the cycle's start.
            let joined =
                self.written[next].0.is_join() || self.written[index].0.is_join() && next < index;
            if joined || (after - before).abs() <= CONTINUOUS * most {
                continue;
            }
            let pace = |speed: f64| {
                if speed.abs() <= CONTINUOUS * most {
                    "at rest".to_owned()
                } else {
                    format!("at {}", self.drive.pace(speed))
                }
            };
            let again = if next > index { "" } else { " the next cycle" };
            let takes = self.written[index].0.is_open() || self.written[next].0.is_open();
            return Err(Problem::new(format!(
                "{} ends {}, but number {} starts{again} {}",
                self.parts[index].title(),
                pace(*before),
                next + 1,
                pace(after)
            ))
            .at(self.parts[index].header(), format!("ends {}", pace(*before)))
            .at(self.parts[next].header(), format!("starts {}", pace(after)))
            .help(if takes {
                "give both the same speed with start_speed and end_speed, or leave one of them out: it is then taken from the other segment"
            } else {
                "put a segment between them that changes the speed: law = \"polynomial-5\" takes the speeds at its ends from its neighbours"
            }));
        }
        Ok(())
    }

    /// Checks that no move leaves the stroke of the drive link, at its end or between its ends.
    fn check_stroke(&self, motion: &Motion, drive: DriveLink) -> Result<()> {
        let reaches = motion.reaches();
        let outside = |reach: &&Reach| reach.of_drive && !drive.reaches(reach.position);
        for first in reaches.iter().filter(outside) {
            let index = first.segment;
            let Some(part) = self.parts.get(index) else {
                continue;
            };
            // A law of several pieces can turn back outside: the farthest position is reported.
            let of_segment = |reach: &&Reach| reach.segment == index;
            let beyond = |reach: &Reach| drive.beyond(reach.position);
            let reach = reaches.iter().filter(of_segment).filter(outside);
            let reach = reach.max_by(|a, b| beyond(a).total_cmp(&beyond(b)));
            let reach = reach.unwrap_or(first);
            let place = drive.coordinate.place(reach.position);
            let end = reaches.iter().rfind(of_segment);
            let verb = if end == Some(reach) {
                "ends"
            } else {
                "turns back"
            };
            let what = format!("{} {verb} at {place}", part.title());
            return Err(part
                .problem(
                    format!("{what}, outside the stroke, {}", drive.range()),
                    "leaves the stroke",
                )
                .help("shorten this move, start elsewhere, or lengthen the stroke"));
        }
        Ok(())
    }
}

/// Constant acceleration, constant speed, constant deceleration between two speeds; the middle speed follows from the distance.
fn trapezoid(
    distance: f64,
    duration: f64,
    [accelerate, decelerate]: [f64; 2],
    [first, last]: [f64; 2],
) -> MotionSegment {
    let mean = distance / duration - 0.5 * (accelerate * first + decelerate * last);
    let middle = mean / (1.0 - 0.5 * (accelerate + decelerate));
    let phase = |share: f64, from: f64, to: f64| {
        let duration = share * duration;
        Phase {
            duration,
            polynomial: Polynomial::constant_jerk([from, (to - from) / duration, 0.0]),
        }
    };
    let mut phases = vec![phase(accelerate, first, middle)];
    // The sum of the shares can be one except for rounding.
    let steady = 1.0 - accelerate - decelerate;
    if steady > 1e-12 {
        phases.push(phase(steady, middle, middle));
    }
    phases.push(phase(decelerate, middle, last));
    MotionSegment::phases(distance, phases)
}
