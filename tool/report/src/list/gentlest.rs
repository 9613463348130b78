//! The motion of least effort, compared with the motion laws.

use std::fmt::Write as _;

pub(crate) use self::data::GentlestData;
use super::contact::of_gentlest;
use crate::answer::Answer;
use crate::list::kept;
use crate::list::rule_words::sentence;
use crate::table::reading::Reading;
use jred_file::model::axis::Axis;
use jred_file::model::machine::MachineFile;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::rounding::{percent, short};
use jred_file::units::Vocabulary;
use jred_motion::contact::ContactLimits;
use jred_motion::gentlest::cycle::{Figures, GentlestResult, Goal, LAWS, Request};
use jred_motion::gentlest::{LeastEffortMove, Optimum, Reason};
use jred_sizing::cell::Cell;
use jred_sizing::judge::check::Check;
use jred_sizing::select::fit::input_kind;

mod data;
mod obstacle;

pub use obstacle::problem;

/// Figures that differ by less are shown as the same.
const FIGURE_TOLERANCE: f64 = 5e-4;

/// The content of the listing.
#[derive(Debug)]
pub struct GentlestView<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// Name of the drive; `None`: the torque is at the input of the drive train.
    pub drive: Option<String>,
    /// The request.
    pub request: &'a Request,
    /// The result.
    pub gentlest: &'a GentlestResult,
    /// The contact that the motion loses.
    pub broken: Option<&'a ContactLimits>,
    /// The rules of the drive in the gentlest motion; empty without a drive.
    pub checks: &'a [Check],
}

fn words(shown: &GentlestView) -> &'static Vocabulary {
    input_kind(shown.file).vocabulary()
}

/// Name of the objective.
fn goal(goal: Goal, words: &Vocabulary) -> String {
    match goal {
        Goal::Rms => format!("RMS {}", words.torque),
        Goal::Energy => "copper loss and work drawn".to_owned(),
        Goal::Peak => format!("peak {}", words.torque),
    }
}

fn unit(goal: Goal, words: &Vocabulary) -> &'static str {
    match goal {
        Goal::Energy => "J",
        _ => words.torque.unit,
    }
}

/// The rows of the comparison: the file's own motion, the others, the gentlest.
fn rows(gentlest: &GentlestResult) -> Vec<(&'static str, &Figures)> {
    let mut rows = vec![("as in the file", &gentlest.own)];
    rows.extend(gentlest.laws.iter().map(|row| (row.name, &row.figures)));
    rows.push(("gentlest", &gentlest.best));
    rows
}

/// Whether there are columns for the copper loss, and for the shares of the drive's limits.
fn columns(shown: &GentlestView) -> [bool; 2] {
    [shown.request.copper.is_some(), shown.drive.is_some()]
}

/// The motion, its drive, and the ends of its moves.
pub(crate) fn subject(shown: &GentlestView) -> String {
    let words = words(shown);
    let drive = shown.drive.as_ref().map_or_else(
        || "at the input of the drive train".to_owned(),
        |drive| format!("with {drive}"),
    );
    let ramp = shown.request.ramp;
    let ends = if ramp > 0.0 {
        let share = percent(ramp);
        format!(", its acceleration zero at the ends of moves, with ramps of {share} of their time")
    } else {
        String::new()
    };
    format!(
        "the motion with the least {}, {drive}{ends}",
        goal(shown.request.goal, words)
    )
}

/// The result: its figure first, then the motions compared, then each move.
pub fn answer(shown: &GentlestView) -> Answer<'static> {
    let words = words(shown);
    let GentlestView { gentlest, .. } = shown;
    let title = format!("{}: {}", shown.file.title, subject(shown));
    let mut answer = Answer::new(shown.file.title.clone(), &data::data(shown)).titled(title);
    answer.csv(gentlest.trace.of_axis(&shown.file.axis()).profile());
    describe(&mut answer, shown, words);
    answer.heading("the motions compared");
    let [copper, limits] = columns(shown);
    let mut heads = vec![
        "motion".to_owned(),
        format!("RMS {}", words.torque.label()),
        format!("peak {}", words.torque.label()),
        format!("peak {}", words.speed.label()),
        "work drawn [J]".to_owned(),
    ];
    heads.extend(copper.then(|| "copper loss [J]".to_owned()));
    if limits {
        heads.push("RMS of S1 [%]".to_owned());
        heads.push("peak of limit [%]".to_owned());
        heads.push("speed of largest [%]".to_owned());
    }
    let rows: Vec<Vec<Cell>> = rows(gentlest)
        .into_iter()
        .map(|(name, figures)| {
            let mut cells: Vec<Cell> = vec![
                name.into(),
                figures.rms.into(),
                figures.peak.into(),
                (figures.speed / words.speed.scale).into(),
                figures.drawn.into(),
            ];
            if copper {
                cells.push(figures.copper.into());
            }
            if limits {
                let used = [figures.rms_used, figures.used, figures.speed_used];
                cells.extend(used.map(|used| Cell::from(100.0 * used)));
            }
            cells
        })
        .collect();
    answer.table(Reading::new(heads, rows, 1));
    answer
}

fn describe(answer: &mut Answer, shown: &GentlestView, words: &Vocabulary) {
    let GentlestView {
        request, gentlest, ..
    } = shown;
    let best = gentlest.best.of(request.goal);
    let mut says = format!(
        "{} {}: {} in the file",
        short(best),
        unit(request.goal, words),
        less(best, gentlest.own.of(request.goal))
    );
    if let Some(law) = gentlest.best_law(request.goal) {
        let of = if gentlest.laws.len() == LAWS.len() {
            "with the best law,"
        } else {
            "with"
        };
        let _ = write!(
            says,
            ", {} {of} {}",
            less(best, law.figures.of(request.goal)),
            law.name
        );
    }
    answer.fact("least", says);
    answer.fact("optimum", optimum(shown, words));
    for (name, says) in kept::all_lines(shown.file, &gentlest.chain) {
        answer.fact(name, says);
    }
    for (k, gentle) in gentlest.moves.iter().enumerate() {
        let says = one_move(shown, gentle, request.goal);
        answer.fact(format!("move {}", k + 1), says);
    }
    let trace = gentlest.trace.of_axis(&shown.file.axis());
    if let (true, Some((node, jump))) = (request.ramp == 0.0, trace.largest_jump()) {
        let unit = trace.coordinate.pick("rad/s^2", "m/s^2");
        let says = format!(
            "the acceleration jumps, most at t = {} s, by {} {unit}; with --ends zero it does not",
            short(node.t),
            short(jump)
        );
        answer.fact("ends", says);
    }
    for (name, [own, best]) in &gentlest.standing {
        let says = format!(
            "{name} rests for {} s while the drive turns, in the file for {} s: a new motion of the drive changes that; to keep a dwell, prescribe it in [motion]",
            short(*best),
            short(*own)
        );
        answer.warning(says);
    }
    if let Some(broken) = shown.broken {
        answer.warning(of_gentlest(broken));
    }
    for check in violated(shown) {
        let whose = if check.id.follows_motion() {
            "motion"
        } else {
            "drive, whatever the motion"
        };
        let says = format!("{}: `jred size` refuses the {whose}", sentence(check));
        answer.fact("not kept", says);
    }
}

/// The rules that the motion violates.
fn violated<'a>(shown: &'a GentlestView) -> impl Iterator<Item = &'a Check> {
    let all = shown.checks.iter();
    all.filter(|check| check.verdict == RuleVerdict::Fail)
}

/// `12 % less than`, or the other way round.
fn less(value: f64, than: f64) -> String {
    let share = if than > 0.0 { value / than - 1.0 } else { 0.0 };
    if share.abs() < FIGURE_TOLERANCE {
        return "the same as".to_owned();
    }
    let side = if share < 0.0 { "less" } else { "more" };
    format!("{} {side} than", percent(share.abs()))
}

fn optimum(shown: &GentlestView, words: &Vocabulary) -> String {
    let gentlest = shown.gentlest;
    let goal = shown.request.goal;
    let best = gentlest.best.of(goal);
    let bound = gentlest.bound.map(|bound| {
        let gap = if best > 0.0 {
            ((best - bound) / best).max(1e-16)
        } else {
            1e-16
        };
        (short(bound), gap)
    });
    let of = if shown.request.ramp > 0.0 {
        " with ramps of this form"
    } else {
        ""
    };
    let unit = unit(goal, words);
    match (gentlest.optimum(), bound) {
        (Optimum::Global, Some((bound, gap))) => {
            format!("global: no motion of these moves is below {bound} {unit}; gap {gap:.0e}")
        }
        (Optimum::Global, None) => {
            format!("global: the problem is convex, so no motion of these moves{of} is better")
        }
        (Optimum::Local(reason), bound) => {
            let near = if reason == Reason::Ended {
                "local: the best motion found; not proved to be global, because"
            } else {
                "local: no nearby motion is better; not proved to be global, because"
            };
            let mut says = format!("{near} {}", why(reason));
            if let Some((bound, _)) = bound {
                let _ = write!(says, "; the lower bound is {bound} {unit}");
            }
            says
        }
    }
}

const fn why(reason: Reason) -> &'static str {
    match reason {
        Reason::LongTime => {
            "the given time is longer than the unconstrained optimum, so that waiting where the resistance is low may be better"
        }
        Reason::Viscous => "viscous friction makes the problem non-convex",
        Reason::Losses => "the losses of gears make the problem non-convex",
        Reason::Ended => "the search did not converge",
        Reason::Bound => "the lower bound is not close enough",
        Reason::Written => "the written motion costs more than the search computed",
    }
}

fn one_move(shown: &GentlestView, gentle: &LeastEffortMove, goal: Goal) -> String {
    let axis = shown.file.axis();
    let travel = &gentle.travel;
    let mut says = format!(
        "{} to {} in {} s",
        axis.place(travel.start),
        axis.place(travel.start + travel.distance),
        short(travel.duration)
    );
    if let Some(law) = gentle.law {
        let kind = if LAWS.iter().any(|(name, _)| *name == law) {
            "the law "
        } else {
            ""
        };
        let _ = write!(says, ": {kind}{law}");
    }
    let waits = travel.duration - gentle.moving;
    if waits > 0.0 {
        let _ = write!(
            says,
            ": moves for {} s and waits for {} s at {}, which costs less than moving more slowly",
            short(gentle.moving),
            short(waits),
            waits_at(gentle, &axis)
        );
    }
    if goal != Goal::Peak && waits == 0.0 {
        // Change of the copper loss per 1 % of the time.
        let change = 0.01 * travel.duration * gentle.per_second / gentle.cost;
        if gentle.cost > 0.0 {
            let _ = write!(
                says,
                "; 1 % more time {} its {} by {}",
                if change < 0.0 { "reduces" } else { "increases" },
                match goal {
                    Goal::Energy => "energy",
                    _ => "copper loss",
                },
                percent_fine(change.abs())
            );
        }
    }
    says
}

/// Where a move waits.
fn waits_at(gentle: &LeastEffortMove, axis: &Axis) -> String {
    let travel = &gentle.travel;
    let is = |end: f64| gentle.waits_at.total_cmp(&end).is_eq();
    if is(travel.start) {
        "its start".to_owned()
    } else if is(travel.start + travel.distance) {
        "its end".to_owned()
    } else {
        format!("{}, where holding costs least", axis.place(gentle.waits_at))
    }
}

/// A share in per cent, to two digits.
fn percent_fine(share: f64) -> String {
    format!("{} %", short((share * 1e4).round() / 100.0))
}
