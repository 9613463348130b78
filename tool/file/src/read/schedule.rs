//! Times at which loads act: `segments`, `during`, `direction` and `at_rest` in `[[load]]`; and carried parts: `[[payload]]`.

use std::ops::Range;

use jred::machine::Load;
use jred::machine::Machine;

use super::loads;
use crate::model::carriage::Carriage;
use crate::model::mechanism::{AnyMechanism, NamedLoad};
use crate::model::motion::Motion;
use crate::model::schedule::{Schedule, ScheduleInstant, ScheduledLoad, Travel, When};
use crate::number::rounding::figure;
use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::section::Section;

use contradictions::{LoadActivity, check_contradictions};

mod contradictions;
mod payload;

/// Instants per stretch of the motion at which loads are checked.
const INSTANTS: u32 = 64;

/// Most segments of a motion.
const MOST_SEGMENTS: u32 = 1000;

/// The motion of the file, as far as schedules refer to it.
struct MotionSegments<'m> {
    motion: Option<&'m Motion>,
    /// Start and end of its segments (s); empty if it has none.
    segments: Vec<[f64; 2]>,
}

/// The part of the motion in which something acts.
struct ActivePart<'s> {
    when: When,
    /// In words, for example "in segments 2 and 3".
    words: Vec<String>,
    /// The key that gives it.
    item: Option<Item<'s>>,
}

/// A load's entry in the file: the range of its loads among the machine's.
pub(super) struct Entry {
    pub(super) loads: Range<usize>,
}

/// The schedule of the file. `entries`: the `[[load]]` tables in their order.
pub(super) fn read(
    root: &Section,
    (entries, carriages): (&[Entry], Vec<Carriage>),
    named: &[NamedLoad],
    machine: &Machine<AnyMechanism>,
    motion: Option<&Motion>,
) -> Result<Schedule> {
    let course = MotionSegments::of(root, motion)?;
    let mut scheduled = Vec::new();
    let mut acting: Vec<LoadActivity> = Vec::new();
    for (section, entry) in root.tables("load")?.into_iter().zip(entries) {
        let part = part(&section, &course)?;
        let at_rest = section.get("at_rest");
        if part.item.is_some() || at_rest.is_some() {
            for load in entry.loads.clone() {
                let Some(NamedLoad { name, load: own }) = named.get(load) else {
                    continue;
                };
                scheduled.push(entry_of(
                    &section,
                    (name, load, own),
                    &part,
                    at_rest.as_ref(),
                )?);
            }
        }
        check_acts(&part, &course)?;
        let first = named
            .get(entry.loads.start)
            .filter(|_| !entry.loads.is_empty());
        acting.push(LoadActivity::new(
            section,
            part,
            first.map(|named| &named.load),
        ));
    }
    check_contradictions(&acting, &course)?;
    let payloads = payload::read(root, machine, &course)?;
    if scheduled.is_empty() && payloads.is_empty() && carriages.is_empty() {
        return Ok(Schedule::default());
    }
    Schedule::new(machine, (scheduled, payloads, carriages), motion)
        .map_err(|error| root.error(error, "in this machine"))
}

/// A load of the schedule.
fn entry_of(
    section: &Section,
    (name, load, own): (&str, usize, &Load),
    part: &ActivePart,
    at_rest: Option<&Item>,
) -> Result<ScheduledLoad> {
    let mut words = part.words.clone();
    let mut rest = None;
    let mut is_static_friction = false;
    if let Some(item) = at_rest {
        let (found, friction) = loads::at_rest(section, own, item)?;
        rest = Some(found);
        is_static_friction = friction;
        words.push(if friction {
            "with static friction from rest".to_owned()
        } else {
            "with a value of its own at rest".to_owned()
        });
    }
    Ok(ScheduledLoad {
        name: name.to_owned(),
        load,
        when: part.when.clone(),
        at_rest: rest,
        is_static_friction,
        words: format!("acts {}", words.join(", ")),
    })
}

impl<'m> MotionSegments<'m> {
    fn of(root: &Section, motion: Option<&'m Motion>) -> Result<Self> {
        let mut segments = Vec::new();
        if let (Some(item), Some(motion)) = (root.peek("motion"), motion) {
            let section = item.section("[motion]".into())?;
            if section.peek("segment").is_some() {
                let mut t = 0.0;
                for course in motion.courses() {
                    segments.push([t, t + course.duration]);
                    t += course.duration;
                }
                // The sum of the durations can differ from the whole by rounding.
                if let Some([_, end]) = segments.last_mut() {
                    *end = motion.duration();
                }
            }
        }
        Ok(Self { motion, segments })
    }

    fn required(&self, item: &Item) -> Result<&'m Motion> {
        self.motion.ok_or_else(|| {
            item.problem("is given, but the file has no [motion]", "when is that?")
                .help(
                    "add a [motion] with segments, or remove this key: what acts always needs none",
                )
        })
    }

    fn duration(&self) -> f64 {
        self.motion.map_or(0.0, Motion::duration)
    }
}

/// `segments`, `during` and `direction`.
fn part<'s>(section: &Section<'s>, course: &MotionSegments) -> Result<ActivePart<'s>> {
    let mut part = ActivePart {
        when: When::default(),
        words: Vec::new(),
        item: None,
    };
    let (segments, during) = (section.get("segments"), section.get("during"));
    let direction = section
        .describes("direction")
        .then(|| section.get("direction"));
    if let Some(item) = segments {
        let (spans, words) = of_segments(&item, course)?;
        (part.when.spans, part.when.by_segment) = (Some(spans), true);
        part.words.push(words);
        part.item = Some(item);
    }
    if let Some(item) = during {
        let (spans, words) = of_times(&item, course)?;
        part.when.spans = Some(spans);
        part.words.push(words);
        part.item = Some(item);
    }
    if let Some(item) = direction.flatten() {
        course.required(&item)?;
        let travel = [Travel::Forward, Travel::Backward];
        let words = ["forward", "backward"];
        let chosen = item.word()?;
        part.when.travel = Some(travel[chosen]);
        part.words.push(words[chosen].to_owned());
        part.item.get_or_insert(item);
    }
    Ok(part)
}

/// `segments = [2, 3]`
fn of_segments(item: &Item, course: &MotionSegments) -> Result<(Vec<[f64; 2]>, String)> {
    course.required(item)?;
    let count = course.segments.len();
    if count == 0 {
        return Err(item
            .problem("is given, but this motion has no segments", "which segments?")
            .help("write during = [\"0.2 s\", \"0.5 s\"], or a motion of the type \"cycle\" or \"point-to-point\""));
    }
    let mut numbers: Vec<usize> = Vec::new();
    for number in item.list("number", "[2, 3]")? {
        let k = number.count(MOST_SEGMENTS, "[2, 3]")? as usize;
        if k > count {
            return Err(number
                .problem(
                    &format!("is {k}, but the motion has {count} segments"),
                    "no such segment",
                )
                .help(
                    "segments are counted from 1 in the order of the file; `jred check` lists them",
                ));
        }
        if numbers.contains(&k) {
            return Err(number
                .problem(&format!("is {k} once more"), "twice")
                .help("name each segment once"));
        }
        numbers.push(k);
    }
    numbers.sort_unstable();
    let spans: Vec<[f64; 2]> = numbers
        .iter()
        .filter_map(|k| course.segments.get(k - 1).copied())
        .collect();
    Ok((joined(spans), in_segments(&numbers)))
}

/// For example "in segments 2, 3 and 5".
fn in_segments(numbers: &[usize]) -> String {
    let words: Vec<String> = numbers.iter().map(usize::to_string).collect();
    match words.as_slice() {
        [one] => format!("in segment {one}"),
        [first @ .., last] => format!("in segments {} and {last}", first.join(", ")),
        [] => String::new(),
    }
}

/// Sorted spans, with adjoining ones merged.
fn joined(spans: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let mut joined: Vec<[f64; 2]> = Vec::new();
    for [from, to] in spans {
        match joined.last_mut() {
            Some(last) if from <= last[1] => last[1] = to,
            _ => joined.push([from, to]),
        }
    }
    joined
}

/// `during = ["0.2 s", "0.5 s"]`; in a cycle it can extend past the end.
fn of_times(item: &Item, course: &MotionSegments) -> Result<(Vec<[f64; 2]>, String)> {
    let motion = course.required(item)?;
    let times = item.values()?;
    let end = motion.duration();
    for time in &times {
        if time.si < 0.0 || time.si > end * (1.0 + 1e-9) {
            return Err(time
                .problem(
                    &format!(
                        "is {}, but the motion lasts {} s",
                        time.shown(),
                        figure(end)
                    ),
                    "outside the motion",
                )
                .help("give times from 0 s to the end of the motion"));
        }
    }
    let words = format!("from {} to {}", times[0].shown(), times[1].shown());
    let [from, to] = [times[0].si, times[1].si.min(end)];
    let spans = if from < to {
        vec![[from, to]]
    } else if motion.cyclic && to < from {
        let spans = [[0.0, to], [from, end]];
        spans.into_iter().filter(|[a, b]| a < b).collect()
    } else {
        let cure = if motion.cyclic {
            "the second time must be another one; if it is smaller, it lies in the next cycle"
        } else {
            "the second time must be the larger one"
        };
        return Err(item
            .problem(&format!("runs {words}"), "check these times")
            .help(cure));
    };
    Ok((spans, words))
}

/// Instants over the whole motion, inside its stretches, which are also divided at these spans.
fn instants(course: &MotionSegments, spans: &[[f64; 2]]) -> Vec<ScheduleInstant> {
    let Some(motion) = course.motion else {
        return Vec::new();
    };
    let mut cuts: Vec<f64> = spans.iter().flatten().copied().collect();
    cuts.extend(motion.stretches().into_iter().flat_map(|(a, b)| [a, b]));
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    let mut found = Vec::new();
    for cut in cuts.windows(2) {
        for k in 0..INSTANTS {
            let t = cut[0] + (cut[1] - cut[0]) * (f64::from(k) + 0.5) / f64::from(INSTANTS);
            found.push(ScheduleInstant::of(t, motion.at(t).omega));
        }
    }
    found
}

/// Checks that a load acts at some instant of the motion.
fn check_acts(part: &ActivePart, course: &MotionSegments) -> Result<()> {
    let Some(item) = &part.item else {
        return Ok(());
    };
    let spans = part.when.spans.clone().unwrap_or_default();
    let end = course.duration();
    if (instants(course, &spans).iter()).any(|now| part.when.holds(now, end)) {
        return Ok(());
    }
    Err(item
        .problem(
            &format!(
                "means {}, but the drive link does not move in this direction then",
                part.words.join(", ")
            ),
            "never acts",
        )
        .help("forward is the direction in which the position of the drive link grows; `jred check` lists the segments"))
}
