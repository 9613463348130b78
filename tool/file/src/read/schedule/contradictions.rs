//! Loads with the same name: one load with different values at different times or positions.

use std::f64::consts::TAU;

use jred::machine::Load;

use super::{ActivePart, MotionSegments, instants};
use crate::number::rounding::figure;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// Checks that loads of one name act on one link, and never two of them at the same instant and position.
pub(super) fn check_contradictions(acting: &[LoadActivity], course: &MotionSegments) -> Result<()> {
    let text = |acting: &LoadActivity, key: &'static str| {
        let item = acting.section.peek(key)?;
        item.text("").ok().map(str::to_owned)
    };
    for (k, second) in acting.iter().enumerate() {
        let Some(name) = text(second, "name") else {
            continue;
        };
        for first in &acting[..k] {
            if text(first, "name").as_ref() != Some(&name) {
                continue;
            }
            let contradict = |where_: &str, cure: &str| {
                Problem::new(format!("two loads have the name \"{name}\" {where_}"))
                    .at(first.section.header(), "the first")
                    .at(second.section.header(), "the second")
                    .help(cure)
            };
            if text(first, "on") != text(second, "on") {
                return Err(contradict(
                    "and act on different links",
                    "give each a name of its own: reports list loads by name",
                ));
            }
            if !first.meets(second) {
                continue;
            }
            if first.part.item.is_none() && second.part.item.is_none() {
                return Err(contradict(
                    "and act on the same link at the same time",
                    "loads of one name are one load with different values at different times or places: remove one, or give each a name \
                     of its own; they then act together",
                ));
            }
            let parts = [&first.part, &second.part];
            let spans = parts.map(|part| part.when.spans.clone().unwrap_or_default());
            let end = course.duration();
            let both = (instants(course, &spans.concat()).into_iter())
                .find(|now| parts.iter().all(|part| part.when.holds(now, end)));
            let Some(t) = both.and_then(|now| now.t) else {
                continue;
            };
            let segment = course.segments.iter().position(|[a, b]| *a <= t && t < *b);
            let place = segment.map_or_else(
                || format!("at t = {} s", figure(t)),
                |segment| format!("in segment {}", segment + 1),
            );
            return Err(contradict(
                &format!("and act on the same link {place}"),
                "loads of one name are one load with different values at different times: give each its own segments, times or direction, or a \
                 name of its own",
            ));
        }
    }
    Ok(())
}

/// A `[[load]]` of the file with the times and positions at which it acts.
pub(super) struct LoadActivity<'s> {
    section: Section<'s>,
    part: ActivePart<'s>,
    /// Positions from and to (rad or m), and the number of turns after which they recur (0: never); `None`: at all positions.
    window: Option<([f64; 2], u32)>,
}

impl<'s> LoadActivity<'s> {
    pub(super) fn new(section: Section<'s>, part: ActivePart<'s>, load: Option<&Load>) -> Self {
        let window = load.and_then(Load::window).map(|window| {
            let [from, .., to] = window.edges();
            ([from, to], window.turns())
        });
        Self {
            section,
            part,
            window,
        }
    }

    /// Whether both act at some position; a common end does not count.
    fn meets(&self, other: &Self) -> bool {
        let (Some(([a, b], turns)), Some(([c, d], others))) = (self.window, other.window) else {
            return true;
        };
        let rounding = 1e-9 * (b - a).min(d - c);
        if turns > 0 && others > 0 {
            // The distance between windows that recur after different numbers of turns takes all multiples of the greatest common divisor.
            let (mut common, mut rest) = (turns, others);
            while rest > 0 {
                (common, rest) = (rest, common % rest);
            }
            let period = f64::from(common) * TAU;
            let ahead = |from: f64, to: f64| (to - from).rem_euclid(period);
            ahead(a, c) < b - a - rounding || ahead(c, a) < d - c - rounding
        } else {
            a.max(c) < b.min(d) - rounding
        }
    }
}
