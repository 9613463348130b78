//! The gentlest motion beside the laws, for reading, as CSV and as JSON.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::contact::of_retime;
use crate::list::kept;
use crate::table::output::Format;
use crate::table::sheet::Reading;
use jred_machine::model::axis::Axis;
use jred_machine::model::machine::MachineFile;
use jred_machine::model::rules::Verdict;
use jred_machine::number::rounding::{percent, short};
use jred_machine::units::Vocabulary;
use jred_motion::contact::Broken;
use jred_motion::gentlest::{Gentle, Optimum, Reason, Travel};
use jred_motion::retime::{Figures, Goal, LAWS, Request, Retimed};
use jred_sizing::judge::check::Check;
use jred_sizing::select::fit::input_kind;
use jred_sizing::study::cell::Cell;

/// Name and version of the form in JSON.
const SCHEMA: &str = "jred-retime/1";

/// Figures that differ by less are shown as the same.
const SAME: f64 = 5e-4;

/// What is shown.
#[derive(Debug)]
pub struct Shown<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// Name of the drive; `None`: the torque is that at the input of the drive train.
    pub drive: Option<String>,
    /// What was asked.
    pub request: &'a Request,
    /// The result.
    pub retimed: &'a Retimed,
    /// The contact that the motion loses.
    pub broken: Option<&'a Broken>,
    /// The rules of the drive in the gentlest motion; none without a drive.
    pub checks: &'a [Check],
    /// Which files were written.
    pub written: String,
}

/// The result in one of the formats; CSV is the motion alone.
pub fn write(shown: &Shown, format: Format) -> String {
    match format {
        Format::Csv => shown.retimed.trace.of_axis(&shown.file.axis()).profile(),
        Format::Table => text(shown),
        Format::Json => format!("{:#}\n", json(shown)),
    }
}

fn words(shown: &Shown) -> &'static Vocabulary {
    input_kind(shown.file).vocabulary()
}

/// What is to be least, in words.
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
fn rows(retimed: &Retimed) -> Vec<(&'static str, &Figures)> {
    let mut rows = vec![("as in the file", &retimed.own)];
    rows.extend(retimed.laws.iter().map(|row| (row.name, &row.figures)));
    rows.push(("gentlest", &retimed.best));
    rows
}

/// Column of the copper loss, and of the share of the drive's limits, where they are known.
fn columns(shown: &Shown) -> [bool; 2] {
    [shown.request.copper.is_some(), shown.drive.is_some()]
}

/// What the motion is, with which drive, and how its moves begin and end.
pub(crate) fn subject(shown: &Shown) -> String {
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

/// As the terminal shows it.
pub(crate) fn text(shown: &Shown) -> String {
    let words = words(shown);
    let Shown { retimed, .. } = shown;
    let mut text = format!("{}: {}\n\n", shown.file.title, subject(shown));
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
    let rows: Vec<Vec<Cell>> = rows(retimed)
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
    text += &Reading::table(&heads, &rows, 1);
    text.push('\n');
    describe(&mut text, shown, words);
    text += &shown.written;
    text
}

/// A line: its name, and what it says.
fn line(text: &mut String, name: &str, says: &str) {
    let _ = writeln!(text, "  {name:<12} {says}");
}

fn describe(text: &mut String, shown: &Shown, words: &Vocabulary) {
    let Shown {
        request, retimed, ..
    } = shown;
    let best = retimed.best.of(request.goal);
    let mut says = format!(
        "{} {}: {} in the file",
        short(best),
        unit(request.goal, words),
        less(best, retimed.own.of(request.goal))
    );
    if let Some(law) = retimed.best_law(request.goal) {
        let of = if retimed.laws.len() == LAWS.len() {
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
    line(text, "least", &says);
    line(text, "optimum", &optimum(shown, words));
    for (name, says) in kept::all_lines(shown.file, &retimed.chain) {
        line(text, name, &says);
    }
    for (k, gentle) in retimed.moves.iter().enumerate() {
        line(
            text,
            &format!("move {}", k + 1),
            &one_move(shown, gentle, request.goal),
        );
    }
    for (name, [own, best]) in &retimed.standing {
        let says = format!(
            "{name} stands still for {} s while the drive turns, in the file for {} s: a motion of the drive changes that; where it must last, give the file a motion with the dwell in [motion]",
            short(*best),
            short(*own)
        );
        line(text, "warning", &says);
    }
    if let Some(broken) = shown.broken {
        line(text, "warning", &of_retime(broken));
    }
    for check in violated(shown) {
        let whose = if check.id.follows_motion() {
            "motion"
        } else {
            "drive, whatever the motion"
        };
        let says = format!("{}: `jred size` refuses the {whose}", check.sentence());
        line(text, "not kept", &says);
    }
}

/// The rules that the motion violates.
fn violated<'a>(shown: &Shown<'a>) -> impl Iterator<Item = &'a Check> {
    let all = shown.checks.iter();
    all.filter(|check| check.verdict == Verdict::Fail)
}

/// `12 % less than`, or the other way round.
fn less(value: f64, than: f64) -> String {
    let share = if than > 0.0 { value / than - 1.0 } else { 0.0 };
    if share.abs() < SAME {
        return "the same as".to_owned();
    }
    let side = if share < 0.0 { "less" } else { "more" };
    format!("{} {side} than", percent(share.abs()))
}

fn optimum(shown: &Shown, words: &Vocabulary) -> String {
    let retimed = shown.retimed;
    let goal = shown.request.goal;
    let best = retimed.best.of(goal);
    let bound = retimed.bound.map(|bound| {
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
    match (retimed.optimum(), bound) {
        (Optimum::Global, Some((bound, gap))) if goal == Goal::Peak => {
            format!("global: no motion of these moves stays below {bound} {unit}; gap {gap:.0e}")
        }
        (Optimum::Global, Some((bound, gap))) => format!(
            "global: no motion of these moves takes less than {bound} {unit}; gap {gap:.0e}"
        ),
        (Optimum::Global, None) => {
            format!("global: the problem is convex, no motion of these moves{of} takes less")
        }
        (Optimum::Local(reason), bound) => {
            let near = if reason == Reason::Ended {
                "local: the best motion that was found; that none takes less is not proved because"
            } else {
                "local: no motion near it takes less; of others this is not proved because"
            };
            let mut says = format!("{near} {}", why(reason));
            if let Some((bound, _)) = bound {
                let _ = write!(says, "; none takes less than {bound} {unit}");
            }
            says
        }
    }
}

const fn why(reason: Reason) -> &'static str {
    match reason {
        Reason::LongTime => {
            "the time is longer than the motion takes of itself, so that it may be better to stay long where little resists"
        }
        Reason::Viscous => "viscous friction makes the problem non-convex",
        Reason::Losses => "the losses of gears make the problem non-convex",
        Reason::Ended => "the search did not come to its end",
        Reason::Bound => "the lower bound is not close enough",
        Reason::Written => "the motion takes more than the search counted",
    }
}

fn one_move(shown: &Shown, gentle: &Gentle, goal: Goal) -> String {
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
            ": moves for {} s and waits for {} s at {}, which takes less than moving more slowly",
            short(gentle.moving),
            short(waits),
            waits_at(gentle, &axis)
        );
    }
    if goal != Goal::Peak && waits == 0.0 {
        // Of the RMS torque, by how much it changes with one per cent of the time.
        let change = 0.01 * travel.duration * gentle.per_second / gentle.cost;
        if gentle.cost > 0.0 {
            let _ = write!(
                says,
                "; 1 % more time takes {} {} {}",
                percent_fine(change.abs()),
                if change < 0.0 { "off" } else { "more for" },
                match goal {
                    Goal::Energy => "its energy",
                    _ => "its copper loss",
                }
            );
        }
    }
    says
}

/// Where a move waits.
fn waits_at(gentle: &Gentle, axis: &Axis) -> String {
    let travel = &gentle.travel;
    let is = |end: f64| gentle.waits_at.total_cmp(&end).is_eq();
    if is(travel.start) {
        "its start".to_owned()
    } else if is(travel.start + travel.distance) {
        "its end".to_owned()
    } else {
        format!("{}, where holding takes least", axis.place(gentle.waits_at))
    }
}

/// A share in per cent, to two digits.
fn percent_fine(share: f64) -> String {
    format!("{} %", short((share * 1e4).round() / 100.0))
}

fn figures(figures: &Figures) -> Value {
    let known = |share: f64| Some(share).filter(|share| share.is_finite());
    json!({
        "rms_torque": figures.rms,
        "peak_torque": figures.peak,
        "peak_speed": figures.speed,
        "work_drawn": figures.drawn,
        "copper_loss": figures.copper,
        "share_of_limits": known(figures.used),
        "share_of_s1": known(figures.rms_used),
        "share_of_largest_speed": known(figures.speed_used),
    })
}

fn json(shown: &Shown) -> Value {
    let Shown {
        request, retimed, ..
    } = shown;
    let mut map = Map::new();
    map.insert("schema".into(), SCHEMA.into());
    map.insert("title".into(), shown.file.title.clone().into());
    map.insert("drive".into(), json!(shown.drive));
    map.insert("objective".into(), request.goal.word().into());
    let motions: Vec<Value> = rows(retimed)
        .into_iter()
        .map(|(name, own)| {
            let mut own = figures(own);
            own["motion"] = name.into();
            own
        })
        .collect();
    map.insert("motions".into(), motions.into());
    map.insert("least".into(), retimed.best.of(request.goal).into());
    map.insert("bound".into(), json!(retimed.bound));
    let (global, reason) = match retimed.optimum() {
        Optimum::Global => (true, None),
        Optimum::Local(reason) => (false, Some(why(reason))),
    };
    map.insert("global".into(), global.into());
    map.insert("local_because".into(), json!(reason));
    map.insert("contact_lost".into(), json!(shown.broken.map(of_retime)));
    let violated: Vec<&Check> = violated(shown).collect();
    map.insert("rules_not_kept".into(), json!(violated));
    let axis = shown.file.axis();
    map.insert("unit".into(), axis.coordinate.per().into());
    // The mean of a high power has no unit that says anything.
    let known = |figure: f64| Some(figure).filter(|_| request.goal != Goal::Peak);
    let moves = retimed.moves.iter().map(|gentle| {
        let Travel {
            start, distance, ..
        } = gentle.travel;
        let [start, end] = [start, start + distance].map(|phi| axis.position(phi));
        json!({
            "start": start,
            "distance": end - start,
            "law": gentle.law,
            "duration": gentle.travel.duration,
            "moving": gentle.moving,
            "waits_at": axis.position(gentle.waits_at),
            "cost": known(gentle.cost),
            "bound": gentle.bound,
            "cost_per_second": known(gentle.per_second),
            "discretisation": gentle.discretisation,
            "elements": gentle.elements,
        })
    });
    map.insert("moves".into(), moves.collect());
    map.insert("kept".into(), kept::json(shown.file, &retimed.chain));
    map.insert("not_kept".into(), kept::lost(shown.file, &retimed.chain));
    let trace = retimed.trace.of_axis(&axis);
    let nodes = trace.nodes().iter();
    let nodes =
        nodes.map(|node| json!([node.t, node.phi, node.omega, node.alpha[0], node.alpha[1]]));
    map.insert("nodes".into(), nodes.collect());
    Value::Object(map)
}
