//! The first screen: the drive, whether it can be ordered as it is, the limits that it uses most, and the next choices.

use super::full::{doubt, kilowatts};
use super::{Listing, table};
use crate::answer::Answer;
use crate::list::marks;
use crate::list::rule_words::note;
use crate::table::reading::ColumnKind::{Quantity, Share, Verdict, Words};
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

/// The parts of a drive, and whether it can be ordered.
pub(super) fn drive(answer: &mut Answer, file: &MachineFile, judged: &Assessment) {
    parts(answer, file, judged);
    answer.fact("order", order(file, judged));
}

/// Whether the drive can be ordered, and what is missing.
pub(crate) fn order(file: &MachineFile, judged: &Assessment) -> String {
    let (parts, questions) = (parts_missing(judged), questions(file, judged));
    if !judged.holds() {
        return "no: it violates limits".to_owned();
    }
    let parts =
        (!parts.is_empty()).then(|| format!("not complete: choose {}", parts.join(" and ")));
    let questions = (!questions.is_empty()).then(|| questions.join("; "));
    match (parts, questions) {
        (None, None) => "as it is".to_owned(),
        (Some(only), None) => only,
        (None, Some(questions)) => format!("first {questions}"),
        (Some(parts), Some(questions)) => format!("{parts}; then {questions}"),
    }
}

/// Motor, gearbox, amplifier, brake and resistor.
fn parts(answer: &mut Answer, file: &MachineFile, judged: &Assessment) {
    let drive = &judged.drive;
    let named = |maker: &str, model: &str, key: &str, figures: &[String]| {
        let named = format!("{} {model}", maker.trim());
        let all: Vec<String> = std::iter::once(named)
            .chain(figures.iter().cloned())
            .collect();
        format!("{} ({key})", all.join(", "))
    };
    let [motor_key, gearbox_key, amplifier_key] = marks::drive(drive, false);
    let mut figures = Vec::new();
    figures.extend(judged.rated_power().map(kilowatts));
    figures.extend(drive.motor.made_for().map(|made| made.words()));
    let motor = named(&drive.motor.maker, &drive.motor.model, &motor_key, &figures);
    answer.fact("motor", motor);
    let gearbox = drive
        .gearbox
        .map_or("none, directly coupled".to_owned(), |g| {
            // Many makers include the ratio in the name.
            let ratio = (!g.model.contains("i=")).then(|| format!("i = {}", short(g.ratio)));
            named(&g.maker, &g.model, &gearbox_key, ratio.as_slice())
        });
    answer.fact("gearbox", gearbox);
    let amplifier = drive.amplifier.map_or(
        "not chosen: the catalogue has none for this motor".to_owned(),
        |a| {
            let current = format!("{} A", short(a.rated_current));
            named(&a.maker, &a.model, &amplifier_key, &[current])
        },
    );
    answer.fact("amplifier", amplifier);
    let of = |rule: Rule| judged.checks.iter().find(|check| check.id == rule);
    let brake = match of(Rule::BrakeTorque) {
        None => "not needed".to_owned(),
        Some(check) if check.verdict == RuleVerdict::NotChecked => judged.least_brake.map_or_else(
            || "needed; the catalogue gives none".to_owned(),
            |torque| {
                let words = &drive.motor.kind.vocabulary().torque;
                format!(
                    "at least {} {} is needed; the catalogue gives none",
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
    answer.fact("brake", brake);
    let resistor = match (
        judged.resistor,
        of(Rule::ResistorPower),
        of(Rule::BusVoltage),
    ) {
        (Some(r), ..) => named(&r.maker, &r.model, &marks::key(&r.key, r.from_maker), &[]),
        (None, Some(_), _) if file.site.supply.brake_resistor.is_none() => {
            "internal, of the amplifier".to_owned()
        }
        (None, Some(_), _) => "that of the machine file".to_owned(),
        (None, None, Some(bus)) if bus.verdict == RuleVerdict::NotChecked => {
            let energy = judged.duty.regenerative_energy;
            format!(
                "not known: {} J come back per cycle; give capacitance, max_voltage and chopper_voltage in [supply]",
                short(energy)
            )
        }
        (None, None, Some(bus)) if bus.verdict == RuleVerdict::Fail => {
            "needed, and none fits".to_owned()
        }
        _ if file.site.supply.regenerative => {
            "none of its own: the supply or the common bus takes the energy".to_owned()
        }
        _ => "not needed".to_owned(),
    };
    answer.fact("resistor", resistor);
}

/// Rules without data that the answer names.
const NAMED: usize = 4;

/// Parts that the catalogue does not have.
fn parts_missing(judged: &Assessment) -> Vec<&'static str> {
    let open = |rule: Rule| {
        let mut checks = judged.checks.iter();
        checks.any(|check| check.id == rule && check.verdict == RuleVerdict::NotChecked)
    };
    [
        (judged.drive.amplifier.is_none(), "the amplifier"),
        (open(Rule::BrakeTorque), "the brake"),
    ]
    .into_iter()
    .filter_map(|(is_missing, part)| is_missing.then_some(part))
    .collect()
}

/// Data to ask for before the drive is ordered.
fn questions(file: &MachineFile, judged: &Assessment) -> Vec<String> {
    let drive = &judged.drive;
    let mut missing = Vec::new();
    if file.site.mains_voltage.is_none() && file.site.bus_voltage.is_none() {
        missing.push("give mains_voltage in [supply]".to_owned());
    }
    if drive.amplifier.is_some() && !drive.is_paired() {
        missing.push("ask whether this amplifier runs this motor".to_owned());
    }
    if drive.motor.made_for().is_none() {
        missing.push("ask for which voltage the motor is made".to_owned());
    }
    let open: Vec<&str> = (judged.checks.iter())
        .filter(|check| check.verdict == RuleVerdict::NotChecked && check.id != Rule::BrakeTorque)
        .map(|check| check.rule)
        .collect();
    if !open.is_empty() {
        let shown = open.len().min(NAMED);
        let more = match open.len() - shown {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let named = open[..shown].join(", ");
        missing.push(format!("ask for data of {named}{more}"));
    }
    if !drive.from_makers() {
        missing.push("compare the figures (*) with the makers' data sheets".to_owned());
    }
    missing
}

/// The rules that use most of their limits, or are violated, and the number of rules by verdict.
pub(super) fn limits(answer: &mut Answer, judged: &Assessment) {
    let of = |verdict: RuleVerdict| {
        let checks = judged.checks.iter();
        checks.filter(move |check| check.verdict == verdict)
    };
    let count = |verdict| of(verdict).count();
    let fails = count(RuleVerdict::Fail);
    let mut shown: Vec<&Check> = if fails > 0 {
        of(RuleVerdict::Fail).collect()
    } else {
        let checked = judged.checks.iter();
        checked.filter(|check| !check.used().is_empty()).collect()
    };
    // Warnings first; without this they would be lines of their own.
    shown.sort_by(|a, b| {
        let by_use = b.used.total_cmp(&a.used);
        b.verdict.cmp(&a.verdict).then(by_use)
    });
    shown.truncate(if fails > 0 { SHOWN_VIOLATED } else { SHOWN });
    let title = if fails > 0 {
        "violated limits"
    } else {
        "uses most of its limits"
    };
    let row = |check: &&Check| {
        let bound = check.bound().unwrap_or_default();
        let verdict = check.verdict.word().to_owned();
        let rule = check.rule.to_owned();
        [rule, check.figure(), bound, check.used(), verdict]
    };
    let header = [
        (title, Words),
        ("figure", Quantity),
        ("limit", Quantity),
        ("used", Share),
        ("verdict", Verdict),
    ];
    answer.table(table(header, shown.iter().map(row), 0));
    let checked = count(RuleVerdict::Pass) + count(RuleVerdict::Warn) + fails;
    let result = match (fails, count(RuleVerdict::Warn)) {
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
    let rules = counted(checked, "rule", "rules");
    answer.sentence(format!("{rules}: {result}{open}{assumed}"));
    let in_table = |check: &&Check| shown.iter().any(|other| other.id == check.id);
    for check in of(RuleVerdict::Warn).filter(|check| !in_table(check)) {
        answer.warning(format!("{} {}", check.rule, check.against()));
    }
}

/// The next smaller and the next larger choice.
fn choices(answer: &mut Answer, selection: &Selection) {
    let Some(best) = selection.fit.first() else {
        return;
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
    if let Some((rank, smaller, power)) = beside(&|power| power < own / STEP, -1.0) {
        let certainty = smaller.certainty().map_or("", doubt);
        let (power, name) = (kilowatts(power), smaller.drive.name());
        answer.fact(
            "smaller",
            format!("{power}, {name}: rank {rank}; {certainty}"),
        );
    } else if let Some(next) = selection.next_smaller() {
        let next = selection.judged(&next);
        let violated = (next.checks.iter()).filter(|check| check.verdict == RuleVerdict::Fail);
        let violated = violated.map(|check| format!("{} {}", check.rule, check.used()));
        let violated: Vec<String> = violated.map(|rule| rule.trim_end().to_owned()).collect();
        let power = kilowatts(next.rated_power().unwrap_or(0.0));
        let (name, violated) = (next.drive.name(), violated.join(", "));
        answer.fact("smaller", format!("{power}, {name}: violates {violated}"));
    }
    if let Some((rank, larger, power)) = beside(&|power| power > own * STEP, 1.0) {
        let (power, name) = (kilowatts(power), larger.drive.name());
        answer.fact("larger", format!("{power}, {name}: rank {rank}"));
    }
}

impl Listing<'_> {
    /// The next smaller and larger choice; if no drive is suitable, the `most` rules that most drives violate.
    pub(crate) fn others(&self, answer: &mut Answer, most: usize) {
        let selection = self.selection;
        if !selection.fit.is_empty() || self.count() == 1 {
            choices(answer, selection);
            return;
        }
        answer.sentence(format!(
            "None of {} satisfies every rule; this is the closest one. Violated:",
            counted(self.count(), "drive", "drives")
        ));
        for violation in selection.violations().into_iter().take(most) {
            let closest = &selection.judged(&violation.closest);
            let check = closest.checks.iter().find(|c| c.id == violation.rule);
            let figures = check.map_or_else(String::new, |check| {
                // A part is missing; the note names it.
                let note = if check.id.is_yes_or_no() {
                    format!(" ({})", note(check))
                } else {
                    String::new()
                };
                check.against() + &note
            });
            let rule = violation.rule.named(closest.drive.motor.kind.vocabulary());
            let alone = match violation.alone {
                0 => String::new(),
                n => format!(", {n} for no other reason"),
            };
            let drives = counted(violation.count, "drive", "drives");
            let name = closest.drive.name();
            answer.fact(
                rule,
                format!("{drives}{alone}; the closest, {name}: {figures}"),
            );
        }
    }

    /// The number of drives, and the options that show more.
    pub(super) fn further(&self, answer: &mut Answer) {
        let (list, selection) = (self.list, self.selection);
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
        answer.sentence(format!("{many}More: {}", hints.join(", ")));
    }
}
