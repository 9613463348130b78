//! One `[[motion.segment]]` as written.

use jred::machine::motion::Law;

use crate::model::motion::{Limits, Segment};
use crate::read::drive_link::DriveLink;
use crate::read::law;
use crate::text::item::{Item, Value};
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;
use crate::units::kind::TIME;

use super::Prescribed;
use super::ends::Ends;

/// The laws in addition to those from rest to rest.
const CONSTANT_SPEED: &str = "constant-speed";
const POLYNOMIALS: [&str; 3] = ["polynomial-5", "polynomial-6", "polynomial-7"];
const JERK_LIMITED: &str = "jerk-limited";
const TRAPEZOID: &str = "trapezoid";
pub(super) const JOIN: &str = "join";

/// The keys of limits.
const LIMITS: [&str; 4] = [
    "max_speed",
    "max_acceleration",
    "max_deceleration",
    "max_jerk",
];

/// A segment, as far as the file defines it.
pub(super) enum Written {
    /// Completely defined.
    Known(Segment),
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
        limits: Limits,
        /// Largest speed as the file gives it; optional for a change of speed.
        speed: Option<Value>,
    },
    /// A polynomial of the drive link's position, to rest at the position `to` or to the start of the cycle.
    Join { duration: f64, to: Option<Value> },
}

impl Written {
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
pub(super) fn read(section: &Section, prescribed: &Prescribed) -> Result<(Written, Ends)> {
    let drive = prescribed.axis;
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
        let segment = pause(section, &dwell, law_key)?;
        return Ok((Written::Known(segment), Ends::default()));
    }
    if law_key.as_ref().is_some_and(|law| law.is_word(JOIN)) {
        return join(section, way, prescribed.drive);
    }
    let moves_without = law_key.as_ref().is_some_and(|law| {
        law.is_word(CONSTANT_SPEED) || law.is_word(JERK_LIMITED) || law.is_word(TRAPEZOID)
    });
    if way.is_none() && !moves_without {
        let example = if drive.slides() { "150 mm" } else { "360 deg" };
        return Err(section.missing(
            "move",
            &format!("move = \"{example}\" with law and duration, or dwell = \"0.25 s\""),
        ));
    }
    let distance = way.map(|way| way.quantity(drive.position())).transpose()?;
    if let Some(zero) = distance
        .as_ref()
        .filter(|distance| distance.si.abs() < drive.position().smallest)
    {
        return Err(zero
            .problem(&stands(zero), "no move")
            .help("write a pause as dwell = \"0.25 s\", without law and duration"));
    }
    // Without a law and a duration, the duration is reported first: every law needs one.
    let Some(law_key) = law_key else {
        section.quantity("duration", &TIME)?.positive()?;
        return Err(section.missing("law", "law = \"polynomial-345\""));
    };
    let read = by_law(section, &law_key, distance, drive)?;
    let limited = matches!(read.0, Written::Limited { .. });
    section.finish_with(|key| explain(key, limited))?;
    Ok(read)
}

/// A move by the named law.
fn by_law(
    section: &Section,
    law_key: &Item,
    distance: Option<Value>,
    drive: DriveLink,
) -> Result<(Written, Ends)> {
    let names = law::LAWS
        .into_iter()
        .chain([CONSTANT_SPEED, JERK_LIMITED, JOIN])
        .chain(POLYNOMIALS);
    let names: Vec<&str> = names.collect();
    let name = names.get(law_key.choice(&names)?).copied();
    Ok(match name {
        Some(CONSTANT_SPEED) => (steady(section, distance, drive)?, Ends::default()),
        Some(JERK_LIMITED) => (
            limited(section, distance, true, drive)?,
            Ends::speeds(section, drive)?,
        ),
        Some(TRAPEZOID)
            if distance.is_none() || LIMITS.iter().any(|key| section.peek(key).is_some()) =>
        {
            (
                limited(section, distance, false, drive)?,
                Ends::speeds(section, drive)?,
            )
        }
        Some(TRAPEZOID) => {
            let law = law::read(section)?;
            let (distance, duration) = timed(section, distance)?;
            let shares = match law {
                Law::Trapezoid {
                    accelerate,
                    decelerate,
                } => [accelerate, decelerate],
                _ => [0.5; 2],
            };
            let written = Written::Trapezoid {
                distance,
                duration,
                law,
                shares,
            };
            (written, Ends::speeds(section, drive)?)
        }
        Some(word) if POLYNOMIALS.contains(&word) => {
            let (distance, duration) = timed(section, distance)?;
            let ends = Ends::of_polynomial(section, law_key, word, drive)?;
            (Written::Polynomial { distance, duration }, ends)
        }
        _ => {
            let (distance, duration) = timed(section, distance)?;
            let law = law::read(section)?;
            (
                Written::Known(Segment::law(distance, duration, law)),
                Ends::default(),
            )
        }
    })
}

/// Explains keys that a move does not have.
fn explain(key: &str, limited: bool) -> Option<&'static str> {
    match key {
        "accelerate" | "decelerate" if limited => {
            Some("shares of a duration are for a trapezoid whose duration is given")
        }
        "accelerate" | "decelerate" => Some("only the law \"trapezoid\" uses these shares"),
        "sine" | "constant" | "cosine" => {
            Some("only the law \"sine-constant-cosine\" uses these shares")
        }
        "duration" if limited => Some("the duration follows from the limits"),
        "speed" => Some("a speed is for the law \"constant-speed\""),
        "start_speed" | "end_speed" => Some(
            "the laws \"polynomial-5\", \"polynomial-6\", \"polynomial-7\", \"trapezoid\" and \"jerk-limited\" have speeds at their ends",
        ),
        "start_acceleration" | "end_acceleration" => Some(
            "the laws \"polynomial-5\", \"polynomial-6\" and \"polynomial-7\" have accelerations at their ends",
        ),
        "start_jerk" | "end_jerk" => {
            Some("\"polynomial-6\" has the jerk at one end, \"polynomial-7\" at both")
        }
        "max_jerk" if limited => Some("for a limited jerk write law = \"jerk-limited\""),
        key if LIMITS.contains(&key) => {
            Some("limits are for the laws \"trapezoid\" and \"jerk-limited\"")
        }
        _ => None,
    }
}

/// A polynomial that joins the segments before and after it.
fn join(section: &Section, way: Option<Item>, drive: DriveLink) -> Result<(Written, Ends)> {
    if let Some(way) = way {
        return Err(way
            .problem("is not used by the law \"join\": it goes to `to`, or to the start of the cycle", "remove this")
            .help("to = \"180 deg\" is the drive link's position at its end, where it is then at rest"));
    }
    let duration = section.quantity("duration", &TIME)?.positive()?;
    let to = section.optional("to", drive.position())?;
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
    Ok((Written::Join { duration, to }, Ends::default()))
}

fn pause(section: &Section, dwell: &Item, law: Option<Item>) -> Result<Segment> {
    let duration = dwell.quantity(&TIME)?.positive()?;
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
    Ok(Segment::dwell(duration))
}

/// Distance and duration, for a law that needs both.
fn timed(section: &Section, distance: Option<Value>) -> Result<(f64, f64)> {
    let distance = distance.map_or_else(
        || Err(section.missing("move", "move = \"…\", the distance")),
        |distance| Ok(distance.si),
    )?;
    Ok((distance, section.quantity("duration", &TIME)?.positive()?))
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
fn steady(section: &Section, distance: Option<Value>, drive: DriveLink) -> Result<Written> {
    let speed = section.optional("speed", drive.speed())?;
    let duration = section.optional("duration", &TIME)?;
    if let Some(duration) = &duration {
        duration.check_positive()?;
    }
    if let Some(zero) = (speed.as_ref()).filter(|speed| speed.si.abs() < drive.speed().smallest) {
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
                    drive.speed().example
                ),
            ));
        }
    };
    Ok(Written::Known(Segment::constant_speed(
        way, duration, speed,
    )))
}

/// The limits of a move, or of a change of speed.
fn limited(
    section: &Section,
    distance: Option<Value>,
    with_jerk: bool,
    drive: DriveLink,
) -> Result<Written> {
    // A change of speed is limited by the speeds of its ends.
    let speed = if distance.is_some() {
        Some(section.quantity("max_speed", drive.speed())?)
    } else {
        section.optional("max_speed", drive.speed())?
    };
    if let Some(speed) = &speed {
        speed.check_positive()?;
    }
    let acceleration = section
        .quantity("max_acceleration", drive.acceleration())?
        .positive()?;
    let deceleration = section.optional("max_deceleration", drive.acceleration())?;
    let deceleration = deceleration.map_or(Ok(acceleration), Value::positive)?;
    let jerk = if with_jerk {
        Some(section.quantity("max_jerk", drive.jerk())?.positive()?)
    } else {
        None
    };
    let limits = Limits {
        speed: speed.as_ref().map_or(f64::INFINITY, |speed| speed.si),
        acceleration,
        deceleration,
        jerk,
    };
    Ok(Written::Limited {
        distance,
        limits,
        speed,
    })
}
