//! The first screen: the drive, whether it can be ordered as it is, the limits that it uses most, and the next choices.

use std::fmt::Write as _;

use comfy_table::{CellAlignment, ContentArrangement};

use super::List;
use super::text::{doubt, kilowatts};
use crate::list::marks;
use crate::table::output::text_table;
use crate::table::screen::Screen;
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::rounding::short;
use jred_file::number::words::counted;
use jred_sizing::judge::Assessment;
use jred_sizing::judge::check::Check;
use jred_sizing::select::size::{Candidate, Selection};

/// Number of rules that are shown.
const SHOWN: usize = 3;

/// Number of rules that are shown for a drive that violates some.
const SHOWN_VIOLATED: usize = 6;

/// Factor between the rated powers of a drive and the next larger or smaller choice.
const STEP: f64 = 1.03;

/// Width of the name at the start of a line.
const NAME: usize = 11;

/// Width of the first screen in a pipe or a file.
const WIDTH: usize = 80;

impl Screen {
    fn narrow(self) -> Self {
        let width = self.width.or(Some(WIDTH));
        Self { width }
    }

    /// A name and its text.
    fn entry(self, text: &mut String, name: &str, says: &str) {
        let rest = " ".repeat(NAME + 1);
        self.narrow()
            .fill(text, &format!(" {name:<NAME$}"), &rest, says);
    }

    /// A sentence without a name.
    pub(super) fn says(self, text: &mut String, says: &str) {
        self.narrow().fill(text, "", "    ", says);
    }
}

/// The first screen of a drive: the best one, a requested one, or the closest one if none is suitable.
pub(super) fn brief(
    screen: Screen,
    file: &MachineFile,
    judged: &Assessment,
    warnings: &[String],
) -> String {
    let mut text = String::new();
    screen.says(&mut text, &file.title);
    text.push('\n');
    parts(screen, &mut text, judged);
    let missing = missing(file, judged);
    let order = if !judged.holds() {
        "no: it violates the limits below".to_owned()
    } else if missing.is_empty() {
        "as it is".to_owned()
    } else {
        format!("not yet: {}", missing.join("; "))
    };
    screen.entry(&mut text, "order", &order);
    text.push('\n');
    limits(screen, &mut text, judged);
    for warning in warnings {
        screen.says(&mut text, &format!("warning: {warning}"));
    }
    text
}

/// Motor, gearbox, amplifier, brake and resistor.
fn parts(screen: Screen, text: &mut String, judged: &Assessment) {
    let drive = &judged.drive;
    let named = |maker: &str, model: &str, key: &str, figures: &[String]| {
        let named = format!("{} {model}", maker.trim());
        let all: Vec<String> = std::iter::once(named)
            .chain(figures.iter().cloned())
            .collect();
        format!("{} ({key})", all.join(", "))
    };
    let [motor_key, gearbox_key, amplifier_key] = marks::drive(drive);
    let mut figures = Vec::new();
    figures.extend(judged.rated_power().map(kilowatts));
    figures.extend(drive.motor.made_for().map(|made| made.words()));
    let motor = named(&drive.motor.maker, &drive.motor.model, &motor_key, &figures);
    screen.entry(text, "motor", &motor);
    let gearbox = drive
        .gearbox
        .map_or("none, directly coupled".to_owned(), |g| {
            // Many makers include the ratio in the name.
            let ratio = (!g.model.contains("i=")).then(|| format!("i = {}", short(g.ratio)));
            named(&g.maker, &g.model, &gearbox_key, ratio.as_slice())
        });
    screen.entry(text, "gearbox", &gearbox);
    let amplifier = drive.amplifier.map_or(
        "not chosen: the catalogue has none for this motor".to_owned(),
        |a| {
            let current = format!("{} A", short(a.rated_current));
            named(&a.maker, &a.model, &amplifier_key, &[current])
        },
    );
    screen.entry(text, "amplifier", &amplifier);
    let of = |rule: Rule| judged.checks.iter().find(|check| check.id == rule);
    let brake = match of(Rule::BrakeTorque) {
        None => "not needed".to_owned(),
        Some(check) if check.verdict == RuleVerdict::NotChecked => judged.least_brake.map_or_else(
            || "needed; the catalogue gives none for this motor".to_owned(),
            |torque| {
                let words = &drive.motor.kind.vocabulary().torque;
                format!(
                    "at least {} {} is needed; the catalogue gives none for this motor",
                    short(torque / words.scale),
                    words.unit
                )
            },
        ),
        Some(check) => match check.bound() {
            Some(bound) => format!("of the motor, holds {} of {bound}", check.figure()),
            None => "of the motor".to_owned(),
        },
    };
    screen.entry(text, "brake", &brake);
    let resistor = match (
        judged.resistor,
        of(Rule::ResistorPower),
        of(Rule::BusVoltage),
    ) {
        (Some(r), ..) => named(&r.maker, &r.model, &marks::key(&r.key, r.from_maker), &[]),
        (None, Some(_), _) => "that of the machine file".to_owned(),
        (None, None, Some(bus)) if bus.verdict == RuleVerdict::NotChecked => {
            let energy = judged.duty.regenerative_energy;
            format!(
                "not known: {} J are fed back per cycle, and figures of the DC bus are missing",
                short(energy)
            )
        }
        (None, None, Some(bus)) if bus.verdict == RuleVerdict::Fail => {
            "needed, and none fits".to_owned()
        }
        _ => "not needed".to_owned(),
    };
    screen.entry(text, "resistor", &resistor);
}

/// Data that are missing before the drive can be ordered.
fn missing(file: &MachineFile, judged: &Assessment) -> Vec<String> {
    let drive = &judged.drive;
    let mut missing = Vec::new();
    if file.site.mains_voltage.is_none() && file.site.bus_voltage.is_none() {
        missing.push("give mains_voltage in [supply]".to_owned());
    }
    if drive.amplifier.is_none() {
        missing.push("choose the amplifier".to_owned());
    } else if !drive.is_paired() {
        missing.push("ask whether this amplifier runs this motor".to_owned());
    }
    if drive.motor.made_for().is_none() {
        missing.push("ask for which voltage the motor is made".to_owned());
    }
    let open: Vec<&str> = (judged.checks.iter())
        .filter(|check| check.verdict == RuleVerdict::NotChecked)
        .map(|check| check.rule)
        .collect();
    if !open.is_empty() {
        missing.push(format!("not checked for lack of data: {}", open.join(", ")));
    }
    if !drive.from_makers() {
        missing.push("compare the figures (*) with the makers' data sheets".to_owned());
    }
    missing
}

/// The rules that use most of their limits, or are violated, and the number of rules by verdict.
fn limits(screen: Screen, text: &mut String, judged: &Assessment) {
    let is = |verdict: RuleVerdict| move |check: &&Check| check.verdict == verdict;
    let fails = judged.checks.iter().any(|c| c.verdict == RuleVerdict::Fail);
    let mut shown: Vec<&Check> = if fails {
        judged.checks.iter().filter(is(RuleVerdict::Fail)).collect()
    } else {
        let checked = judged.checks.iter();
        checked.filter(|check| !check.used().is_empty()).collect()
    };
    // Warnings first; without this they would be lines of their own.
    shown.sort_by(|a, b| {
        let by_use = b.use_of_limit().total_cmp(&a.use_of_limit());
        b.verdict.cmp(&a.verdict).then(by_use)
    });
    shown.truncate(if fails { SHOWN_VIOLATED } else { SHOWN });
    let title = if fails {
        "violated limits"
    } else {
        "uses most of its limits"
    };
    let mut table = text_table(&[title, "figure", "limit", "used", "verdict"]);
    for check in &shown {
        table.add_row([
            check.rule.to_owned(),
            check.figure(),
            check.bound().unwrap_or_default(),
            check.used(),
            check.verdict.word().to_owned(),
        ]);
    }
    for column in 1..4 {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    if let Ok(width) = u16::try_from(screen.width.unwrap_or(WIDTH)) {
        table
            .set_content_arrangement(ContentArrangement::Dynamic)
            .set_width(width);
    }
    let _ = writeln!(text, "{table}");
    let count = |verdict| judged.checks.iter().filter(is(verdict)).count();
    let checked = count(RuleVerdict::Pass) + count(RuleVerdict::Warn) + count(RuleVerdict::Fail);
    let result = match (count(RuleVerdict::Fail), count(RuleVerdict::Warn)) {
        (0, 0) => "all satisfied".to_owned(),
        (0, n) => format!("all satisfied, {}", counted(n, "warning", "warnings")),
        (n, _) => format!("{n} violated"),
    };
    let open = match count(RuleVerdict::NotChecked) {
        0 => String::new(),
        n => format!("; {n} not checked"),
    };
    let assumed = match judged.assumptions.len() {
        0 => String::new(),
        n => format!("; {}", counted(n, "assumption", "assumptions")),
    };
    screen.says(
        text,
        &format!(
            "{}: {result}{open}{assumed}",
            counted(checked, "rule", "rules")
        ),
    );
    let in_table = |check: &&Check| shown.iter().any(|other| other.id == check.id);
    let warned = judged.checks.iter().filter(is(RuleVerdict::Warn));
    for check in warned.filter(|check| !in_table(check)) {
        let bound = check
            .bound()
            .map_or_else(String::new, |b| format!(", limit {b}"));
        screen.says(
            text,
            &format!("warning: {} {}{bound}", check.rule, check.figure()),
        );
    }
}

/// The next smaller and the next larger choice.
pub(super) fn choices(screen: Screen, selection: &Selection) -> String {
    let mut text = String::new();
    let Some(best) = selection.fit.first() else {
        return text;
    };
    let power = |candidate: &Candidate| candidate.drive.motor.rated_power();
    let own = power(best).unwrap_or(f64::INFINITY);
    let ranked = selection.first_of_motors(usize::MAX);
    let beside = |is_next: &dyn Fn(f64) -> bool, order: f64| {
        let others = ranked.iter().filter_map(|(rank, candidate)| {
            let power = power(candidate).filter(|power| is_next(*power))?;
            Some((*rank, candidate, power))
        });
        others.min_by(|a, b| (order * a.2).total_cmp(&(order * b.2)))
    };
    let certainty = |candidate: &Candidate| candidate.certainty().map_or("", doubt);
    if let Some((rank, smaller, power)) = beside(&|power| power < own / STEP, -1.0) {
        let says = format!(
            "{}, {}: rank {rank}; {}",
            kilowatts(power),
            smaller.drive.name(),
            certainty(smaller)
        );
        screen.entry(&mut text, "smaller", &says);
    } else if let Some(next) = selection.next_smaller() {
        let next = selection.judged(&next);
        let violated: Vec<String> = (next.checks.iter())
            .filter(|check| check.verdict == RuleVerdict::Fail)
            .map(|check| {
                format!("{} {}", check.rule, check.used())
                    .trim_end()
                    .to_owned()
            })
            .collect();
        let says = format!(
            "{}, {}: violates {}",
            kilowatts(next.rated_power().unwrap_or(0.0)),
            next.drive.name(),
            violated.join(", ")
        );
        screen.entry(&mut text, "smaller", &says);
    }
    if let Some((rank, larger, power)) = beside(&|power| power > own * STEP, 1.0) {
        let says = format!("{}, {}: rank {rank}", kilowatts(power), larger.drive.name());
        screen.entry(&mut text, "larger", &says);
    }
    text
}

/// The number of drives, and the options that show more.
pub(super) fn further(screen: Screen, selection: &Selection, list: List) -> String {
    let mut text = String::new();
    let [fit, refused] = [selection.fit.len(), selection.refused.len()];
    let hints: Vec<&str> = [
        (!list.full, "--full (duty, every rule, ranking)"),
        (!list.is_ranked && fit > 1, "--top 10"),
        (!list.refused && refused > 0, "--refused"),
        (!list.explained, "--explain"),
        (true, "--report FILE.html"),
    ]
    .into_iter()
    .filter_map(|(is_open, hint)| is_open.then_some(hint))
    .collect();
    let many = match fit {
        // The violated rules already tell.
        0 => String::new(),
        1 => format!("1 of {} drives satisfies every rule. ", fit + refused),
        _ => format!("{fit} of {} drives satisfy every rule. ", fit + refused),
    };
    screen.says(&mut text, &format!("{many}More: {}", hints.join(", ")));
    text
}
