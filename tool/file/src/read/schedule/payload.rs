//! `[[payload]]`: a part that a link picks up and sets down.

use crate::math;
use jred::machine::Machine;
use jred::machine::Mechanism as _;

use super::{MotionSegments, joined, part};
use crate::model::mechanism::AnyMechanism;
use crate::model::motion::Motion;
use crate::model::schedule::Payload;
use crate::number::rounding::{figure, short};
use crate::read::mass::attached;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// Share of the largest speed of its attachment point over the motion below which a payload counts as at rest.
const AT_REST: f64 = 1e-6;

/// Instants of the motion at which the speed of the attachment point is evaluated.
const INSTANTS: u32 = 1000;

/// All payloads of the file.
pub(super) fn read(
    root: &Section,
    machine: &Machine<AnyMechanism>,
    course: &MotionSegments,
) -> Result<Vec<Payload>> {
    let sections = root.tables("payload")?;
    let mut payloads: Vec<Payload> = Vec::new();
    for (k, section) in sections.iter().enumerate() {
        let payload = payload(section, machine, course)?;
        for (earlier, header) in payloads.iter().zip(&sections[..k]) {
            if earlier.name == payload.name {
                check_once([earlier, &payload], [header, section])?;
            }
        }
        payloads.push(payload);
    }
    Ok(payloads)
}

/// Checks that a payload is not picked up again while one of the same name is carried.
fn check_once(payloads: [&Payload; 2], sections: [&Section; 2]) -> Result<()> {
    let [first, second] = payloads.map(|payload| payload.when.spans.clone().unwrap_or_default());
    let both = |[a, b]: &[f64; 2]| second.iter().any(|[c, d]| c < b && a < d);
    if !first.iter().any(both) {
        return Ok(());
    }
    Err(Problem::new(format!(
        "the payload \"{}\" is picked up while it is carried",
        payloads[0].name
    ))
    .at(sections[0].header(), "carried here")
    .at(sections[1].header(), "picked up again")
    .help("set it down before it is picked up again, or give the second one a name of its own"))
}

fn payload(
    section: &Section,
    machine: &Machine<AnyMechanism>,
    course: &MotionSegments,
) -> Result<Payload> {
    let (name, mass) = attached(section, machine.mechanism(), "payload")?;
    let while_moving = section.is("while_moving")?;
    let part = part(section, course)?;
    section.finish()?;
    let Some(item) = &part.item else {
        return Err(section.missing(
            "segments",
            "segments = [2, 3], over which it is carried, or during = [\"0.2 s\", \"0.5 s\"]; a mass that is always there is a [[mass]]",
        ));
    };
    let payload = Payload {
        name,
        mass,
        words: format!(
            "of {} kg is carried {}",
            short(mass.mass),
            part.words.join(", ")
        ),
        when: part.when,
    };
    let motion = course.required(item)?;
    let ends = ends(&payload, motion, item)?;
    if !while_moving {
        check_at_rest(&payload, machine, motion, ends, item)?;
    }
    Ok(payload)
}

/// Times of pick-up and set-down (s); `None` if it is always carried.
fn ends(payload: &Payload, motion: &Motion, item: &Item) -> Result<Option<[f64; 2]>> {
    let spans = joined(payload.when.spans.clone().unwrap_or_default());
    let end = motion.duration();
    match spans.as_slice() {
        [[from, to]] if motion.cyclic && *from <= 0.0 && *to >= end => Ok(None),
        [[from, to]] => Ok(Some([*from, *to])),
        [[zero, to], [from, last]] if motion.cyclic && *zero <= 0.0 && *last >= end => {
            Ok(Some([*from, *to]))
        }
        _ => Err(item
            .problem(
                &format!("lets \"{}\" be picked up more than once", payload.name),
                "not in one go",
            )
            .help("a payload is carried from one instant to another, in a cycle over its end too: write another [[payload]] for the second time")),
    }
}

/// Checks that it is at rest where it is picked up and where it is set down.
fn check_at_rest(
    payload: &Payload,
    machine: &Machine<AnyMechanism>,
    motion: &Motion,
    ends: Option<[f64; 2]>,
    item: &Item,
) -> Result<()> {
    let Some(ends) = ends else {
        return Ok(());
    };
    // Speeds of its attachment point (m/s) and of its rotation (rad/s).
    let speeds = |t: f64| {
        let state = motion.at(t);
        let frames = machine.mechanism().frames(state.phi).map_err(|error| {
            item.problem(&format!("cannot be used: {error}"), "here")
                .help(error.cure().to_string())
        })?;
        let frame = frames.get(payload.mass.link);
        let [x, y, turn] = frame.map_or([0.0; 3], |frame| {
            let [x, y] = frame.point(payload.mass.at);
            [x, y, frame.psi].map(|c| c.velocity(state.omega))
        });
        Ok::<_, Problem>([math::hypot(x, y), turn.abs()])
    };
    let mut most = [0.0f64; 2];
    for k in 0..=INSTANTS {
        let here = speeds(motion.duration() * f64::from(k) / f64::from(INSTANTS))?;
        most = [0, 1].map(|k| most[k].max(here[k]));
    }
    // The start and the end of a motion that does not repeat are not events.
    let at_ends = |t: &f64| !motion.cyclic && (*t <= 0.0 || *t >= motion.duration());
    let events = [("picked up", ends[0]), ("set down", ends[1])];
    for (what, t) in events.into_iter().filter(|(_, t)| !at_ends(t)) {
        let [speed, turn] = speeds(t)?;
        let turns = payload.mass.inertia > 0.0 && turn > AT_REST * most[1];
        if speed > AT_REST * most[0] || turns {
            let moving = if speed > AT_REST * most[0] {
                format!("{} m/s", short(speed))
            } else {
                format!("{} rad/s", short(turn))
            };
            return Err(item
                .problem(
                    &format!(
                        "lets \"{}\" be {what} at t = {} s, where its place moves at {moving}",
                        payload.name,
                        figure(t)
                    ),
                    "not at rest",
                )
                .help("choose segments that begin and end at rest; or write while_moving = true, if the payload comes and goes with the speed of its place, without an impact"));
        }
    }
    Ok(())
}
