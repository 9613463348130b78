//! One `[[motion.segment]]` as written.

use jred::machine::motion::Law;

use crate::keys::motion::MOTION_LAWS;
use crate::model::motion::{MotionSegment, MoveLimits};
use crate::read::drive_link::DriveLink;
use crate::read::law;
use crate::text::item::Item;
use crate::text::key::SPEED;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::text::value::Value;

use super::PrescribedCoordinate;
use super::ends::Ends;

const CONSTANT_SPEED: &str = "constant-speed";
const JERK_LIMITED: &str = "jerk-limited";
const TRAPEZOID: &str = "trapezoid";
const JOIN: &str = "join";

/// The keys of limits.
const LIMITS: [&str; 4] = [
    "max_speed",
    "max_acceleration",
    "max_deceleration",
    "max_jerk",
];

/// A segment, as far as the file defines it.
pub(super) enum SegmentDraft {
    /// Completely defined.
    Known(MotionSegment),
    /// A polynomial over a distance in a duration.
    Polynomial { distance: f64, duration: f64 },
    /// Constant acceleration, speed and deceleration in shares of the duration.
    Trapezoid {
        distance: f64,
        duration: f64,
        law: Law,
        shares: [f64; 2],
    },
    /// As fast as limits allow: over a distance, or for a change of speed.
    Limited {
        distance: Option<Value>,
        limits: MoveLimits,
        /// Largest speed as the file gives it; optional for a change of speed.
        speed: Option<Value>,
    },
    /// A polynomial of the drive link's position, to rest at the position `to` or to the start of the cycle.
    Join { duration: f64, to: Option<Value> },
}

impl SegmentDraft {
    /// Whether its end speeds can come from its neighbours.
    pub(super) const fn is_open(&self) -> bool {
        !matches!(self, Self::Known(_))
    }

    pub(super) const fn is_join(&self) -> bool {
        matches!(self, Self::Join { .. })
    }

    /// A pause.
    pub(super) fn is_dwell(&self) -> bool {
        matches!(self, Self::Known(segment) if segment.distance == 0.0)
    }
}

/// One move or one dwell, and the values of its ends.
pub(super) fn read(
    section: &Section,
    prescribed: &PrescribedCoordinate,
) -> Result<(SegmentDraft, Ends)> {
    let drive = prescribed.axis;
    let law_key = section.get("law");
    let (way, dwell) = (section.get("move"), section.get("dwell"));
    if let Some(dwell) = dwell {
        let segment = pause(section, &dwell, law_key)?;
        return Ok((SegmentDraft::Known(segment), Ends::default()));
    }
    // An unknown law is reported after a missing distance.
    let word = law_key.as_ref().and_then(|law| law.word().ok());
    let law = word.map(|word| MOTION_LAWS[word]);
    if law == Some(JOIN) {
        section.choose(JOIN);
        return join(section, way, prescribed.drive);
    }
    let moves_without = [CONSTANT_SPEED, JERK_LIMITED, TRAPEZOID];
    if way.is_none() && !law.is_some_and(|law| moves_without.contains(&law)) {
        let example = if drive.slides() { "150 mm" } else { "360 deg" };
        return Err(section.missing(
            "move",
            &format!("move = \"{example}\" with law and duration, or dwell = \"0.25 s\""),
        ));
    }
    let distance = way.map(|way| way.value()).transpose()?;
    if let Some(zero) = distance
        .as_ref()
        .filter(|distance| distance.si.abs() < distance.kind.smallest)
    {
        return Err(zero
            .problem(&stands(zero), "no move")
            .help("write a pause as dwell = \"0.25 s\", without law and duration"));
    }
    // Without a law and a duration, the duration is reported first: every law needs one.
    let Some(law_key) = law_key else {
        section.value("duration")?;
        return Err(section.lacks("law"));
    };
    let law = MOTION_LAWS[law_key.word()?];
    section.choose(law);
    let read = by_law(section, &law_key, law, distance)?;
    let limited = matches!(read.0, SegmentDraft::Limited { .. });
    section.finish_with(|key| match key {
        "accelerate" | "decelerate" if limited => {
            Some("shares of a duration are for a trapezoid whose duration is given")
        }
        "duration" if limited => Some("the duration follows from the limits"),
        _ => None,
    })?;
    Ok(read)
}

/// A move by the named law.
fn by_law(
    section: &Section,
    law_key: &Item,
    law: &str,
    distance: Option<Value>,
) -> Result<(SegmentDraft, Ends)> {
    let has_limits = || LIMITS.iter().any(|key| section.peek(key).is_some());
    Ok(match law {
        CONSTANT_SPEED => (steady(section, distance)?, Ends::default()),
        JERK_LIMITED => (limited(section, distance, true)?, Ends::speeds(section)?),
        TRAPEZOID if distance.is_none() || has_limits() => {
            (limited(section, distance, false)?, Ends::speeds(section)?)
        }
        TRAPEZOID => {
            let law = law::read(section)?;
            let (distance, duration) = timed(section, distance)?;
            let shares = match law {
                Law::Trapezoid {
                    accelerate,
                    decelerate,
                } => [accelerate, decelerate],
                _ => [0.5; 2],
            };
            let written = SegmentDraft::Trapezoid {
                distance,
                duration,
                law,
                shares,
            };
            (written, Ends::speeds(section)?)
        }
        "polynomial-5" | "polynomial-6" | "polynomial-7" => {
            let (distance, duration) = timed(section, distance)?;
            let ends = Ends::of_polynomial(section, law_key, law)?;
            (SegmentDraft::Polynomial { distance, duration }, ends)
        }
        _ => {
            let (distance, duration) = timed(section, distance)?;
            let law = law::read(section)?;
            let segment = MotionSegment::law(distance, duration, law);
            (SegmentDraft::Known(segment), Ends::default())
        }
    })
}

/// A polynomial that joins the segments before and after it.
fn join(section: &Section, way: Option<Item>, drive: DriveLink) -> Result<(SegmentDraft, Ends)> {
    if let Some(way) = way {
        return Err(way
            .problem("is not used by the law \"join\": it goes to `to`, or to the start of the cycle", "remove this")
            .help("to = \"180 deg\" is the drive link's position at its end, where it is then at rest"));
    }
    let duration = section.value("duration")?.si;
    section.set_slides(drive.slides());
    let to = section.given("to")?;
    if let Some(to) = to.as_ref().filter(|to| !drive.reaches(to.si)) {
        let what = format!("is {}, outside the stroke, {}", to.shown(), drive.range());
        return Err(to
            .problem(&what, "out of reach")
            .help("give a position within the stroke"));
    }
    section.finish_with(|key| match key {
        "start_speed" | "end_speed" | "start_acceleration" | "end_acceleration" => Some(
            "a join has the speed and acceleration of what it joins; where `to` is given, it ends at rest",
        ),
        _ => None,
    })?;
    Ok((SegmentDraft::Join { duration, to }, Ends::default()))
}

fn pause(section: &Section, dwell: &Item, law: Option<Item>) -> Result<MotionSegment> {
    let duration = dwell.value()?.si;
    if let Some(law) = law {
        return Err(
            Problem::new(format!("`law` is not used in {}, a dwell", section.title()))
                .at(law.key_span(), "remove this")
                .help("a dwell has only dwell = \"0.25 s\""),
        );
    }
    section.finish_with(|key| {
        (key == "duration").then_some("give the duration of a pause as dwell = \"0.25 s\"")
    })?;
    Ok(MotionSegment::dwell(duration))
}

/// Distance and duration, for a law that needs both.
fn timed(section: &Section, distance: Option<Value>) -> Result<(f64, f64)> {
    let distance = distance.map_or_else(
        || Err(section.missing("move", "move = \"…\", the distance")),
        |distance| Ok(distance.si),
    )?;
    Ok((distance, section.value("duration")?.si))
}

/// The message about a distance or a speed that is too small for any motion.
fn stands(value: &Value) -> String {
    if value.si == 0.0 {
        return "is zero, so nothing moves".to_owned();
    }
    format!(
        "is {}, too small for any machine: nothing moves",
        value.shown()
    )
}

/// Two of distance, speed and duration.
fn steady(section: &Section, distance: Option<Value>) -> Result<SegmentDraft> {
    let (speed, duration) = (section.given("speed")?, section.given("duration")?);
    if let Some(zero) = (speed.as_ref()).filter(|speed| speed.si.abs() < speed.kind.smallest) {
        return Err(zero
            .problem(&stands(zero), "no move")
            .help("write a pause as dwell = \"0.25 s\", without law and speed"));
    }
    let (way, duration, speed) = match (distance, duration, speed) {
        (Some(way), Some(duration), None) => (way.si, duration.si, way.si / duration.si),
        (None, Some(duration), Some(speed)) => (speed.si * duration.si, duration.si, speed.si),
        (Some(way), None, Some(speed)) => {
            if way.si * speed.si < 0.0 {
                let what = format!("is {}, against the move of {}", speed.shown(), way.shown());
                return Err(speed
                    .problem(&what, "the other direction")
                    .at(way.span(), "the move")
                    .help("give both the same sign: negative is backwards"));
            }
            (way.si, way.si / speed.si, speed.si)
        }
        (Some(_), Some(duration), Some(_)) => {
            return Err(duration
                .problem("is given together with `move` and `speed`", "one too many")
                .help("give two of the three: the third follows"));
        }
        _ => {
            return Err(section.missing(
                "speed",
                &format!(
                    "speed = \"{}\" with `move` or `duration`; or `move` with `duration`",
                    SPEED[usize::from(section.slides())].example
                ),
            ));
        }
    };
    Ok(SegmentDraft::Known(MotionSegment::constant_speed(
        way, duration, speed,
    )))
}

/// The limits of a move, or of a change of speed.
fn limited(section: &Section, distance: Option<Value>, with_jerk: bool) -> Result<SegmentDraft> {
    // A change of speed is limited by the speeds of its ends.
    let speed = if distance.is_some() {
        Some(section.value("max_speed")?)
    } else {
        section.given("max_speed")?
    };
    let acceleration = section.value("max_acceleration")?.si;
    let deceleration = section.maybe("max_deceleration")?.unwrap_or(acceleration);
    let jerk = if with_jerk {
        Some(section.value("max_jerk")?.si)
    } else {
        None
    };
    let limits = MoveLimits {
        speed: speed.as_ref().map_or(f64::INFINITY, |speed| speed.si),
        acceleration,
        deceleration,
        jerk,
    };
    Ok(SegmentDraft::Limited {
        distance,
        limits,
        speed,
    })
}
