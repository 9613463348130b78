//! Loads of one name: one load that has other values at other times or places.

use std::f64::consts::TAU;

use jred::machine::Load;

use super::{Course, Part, instants};
use crate::number::rounding::figure;
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// Loads of one name are parts of one load: on one link, and no two of them act at the same instant in the same place.
pub(super) fn check_contradictions(acting: &[Acting], course: &Course) -> Result<()> {
    let text = |acting: &Acting, key: &'static str| {
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

/// A `[[load]]` of the file: when it acts, and where.
pub(super) struct Acting<'s> {
    section: Section<'s>,
    part: Part<'s>,
    /// From which position to which (rad, or m), and after how many turns that comes again, 0: never; `None`: everywhere.
    window: Option<([f64; 2], u32)>,
}

impl<'s> Acting<'s> {
    pub(super) fn new(section: Section<'s>, part: Part<'s>, load: Option<&Load>) -> Self {
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

    /// Whether there are positions at which both act; those at which one ends and the other begins are none.
    fn meets(&self, other: &Self) -> bool {
        let (Some(([a, b], turns)), Some(([c, d], others))) = (self.window, other.window) else {
            return true;
        };
        let rounding = 1e-9 * (b - a).min(d - c);
        if turns > 0 && others > 0 {
            // Windows that come again after other numbers of turns are apart by any multiple of what divides both.
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
