//! A selection as text.

use std::fmt::Write as _;

use comfy_table::{ColumnConstraint, ContentArrangement, Width};

use super::brief::{brief, choices, further};
use super::{Asked, Explanation, List};
use crate::list::marks;
use crate::table::output::text_table;
use jred_analysis::duty::{Duty, Instant};
use jred_file::model::machine::MachineFile;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Verdict;
use jred_file::model::site::Site;
use jred_file::number::figures::Figures;
use jred_file::number::rounding::{cleared, rounded, short, significant};
use jred_file::number::words::counted;
use jred_file::units::Vocabulary;
use jred_sizing::catalogue::Drive;
use jred_sizing::judge::check::Check;
use jred_sizing::judge::{Judged, cure};
use jred_sizing::select::size::{Candidate, Certainty, Class, Gap, Selection};

/// Number of rules on the first screen if no drive satisfies all.
const MOST_VIOLATED: usize = 2;

/// Width of the column "limit is".
const NOTE_WIDTH: u16 = 72;

/// Duty, best drive with every rule, ranking, and the refused drives on request. A drive requested by name replaces the best one, with the reason for
/// its rank.
pub fn text(
    list: List,
    file: &MachineFile,
    duty: &Duty,
    selection: &Selection,
    warnings: &[String],
    asked: Option<&Asked>,
    explanation: Option<&Explanation>,
) -> String {
    let first = selection.fit.first().or(selection.refused.first());
    let Some(shown) = asked.map(|asked| &asked.candidate).or(first) else {
        return String::new();
    };
    let words = shown.drive.motor.kind.vocabulary();
    let all = selection.fit.len() + selection.refused.len();
    let judged = &selection.judged(shown);
    let mut parts = vec![brief(list.screen, file, judged, warnings)];
    if let Some(asked) = asked {
        parts.push(asked_text(asked, selection));
    } else if selection.fit.is_empty() && all > 1 {
        let mut text = format!(
            "None of {} satisfies every rule; this is the closest one. Violated:\n",
            counted(all, "drive", "drives")
        );
        let most = if list.full { usize::MAX } else { MOST_VIOLATED };
        for line in violations(selection).into_iter().take(most) {
            list.screen.says(&mut text, &line);
        }
        parts.push(text);
    } else {
        parts.push(choices(list.screen, selection));
    }
    if list.full {
        parts.push(full(file, duty, judged));
    }
    let is_whole = list.full && asked.is_none() && !selection.fit.is_empty();
    if is_whole {
        if all > 1 {
            parts.push(counts(selection) + "\n");
        }
        parts.extend(not_checked(selection, words).map(|text| text + "\n"));
    }
    if is_whole || list.is_ranked && !selection.fit.is_empty() {
        parts.push(ranking(list, selection, words) + "\n");
    }
    if is_whole {
        parts.extend(smaller(selection).into_iter().map(|line| line + "\n"));
    }
    if let Some(explanation) = explanation {
        parts.push(explanation.text(duty.duration));
    }
    if list.refused || list.all {
        parts.push("Refused\n".to_owned());
        for candidate in &list.refused(selection) {
            let reasons = selection.judged(candidate).reasons();
            parts.push(format!("  {}: {reasons}\n", candidate.drive.name()));
        }
    }
    if all > 1 {
        parts.push(further(list.screen, selection, list));
    }
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    parts.concat()
}

/// The duty at the input, and all data of a drive.
fn full(file: &MachineFile, duty: &Duty, judged: &Judged) -> String {
    let input_power = |i: &Instant| i.input_torque * i.input_speed;
    let words = judged.drive.motor.kind.vocabulary();
    let input = figures_table(&[
        (words.torque.label(), duty.figures(|i| i.input_torque), 1.0),
        (
            words.speed.label(),
            duty.figures(|i| i.input_speed),
            words.speed.scale,
        ),
        ("power [W]".to_owned(), duty.figures(input_power), 1.0),
        (
            words.inertia.label(),
            duty.figures(|i| i.input_inertia),
            words.inertia.scale,
        ),
    ]);
    format!(
        "\n{}\n\nDuty at the {}, cycle {} s\n{input}\n\n{}\n{}\n\n",
        supply(&file.site),
        file.input_name(),
        rounded(duty.duration),
        judged.drive.name(),
        drive_text(judged)
    )
}

/// The supply for which motors and amplifiers are judged.
fn supply(site: &Site) -> String {
    match (site.mains_voltage, site.bus_voltage) {
        (Some(mains), Some(bus)) => {
            format!("Supply: {} V mains, DC bus {} V", short(mains), short(bus))
        }
        (_, Some(bus)) => format!("Supply: DC bus {} V", short(bus)),
        _ => "Supply: not given; using each motor at the voltage of its data. Give mains_voltage in [supply]".to_owned(),
    }
}

/// The requested drive with its rules, and the name of the best one.
fn asked_text(asked: &Asked, selection: &Selection) -> String {
    let (name, place) = (asked.candidate.drive.name(), asked.place(selection));
    let best = match selection.fit.first() {
        Some(best) if asked.rank != Some(1) => format!("\nThe best drive is {}", best.drive.name()),
        Some(_) => String::new(),
        None => "\nNo drive satisfies every rule".to_owned(),
    };
    format!("Requested drive: {name}\n{place}{best}\n")
}

/// For each violated rule the number of drives that violate it, and the closest of them.
pub(crate) fn violations(selection: &Selection) -> Vec<String> {
    let lines = selection.violations().into_iter().map(|violation| {
        let closest = &selection.judged(&violation.closest);
        let check = closest.checks.iter().find(|c| c.id == violation.rule);
        let figures = check.map_or_else(String::new, |check| {
            let limit = check
                .bound()
                .map_or_else(String::new, |b| format!(", limit {b}"));
            // A part is missing; the note names it.
            let note = if check.id.is_yes_or_no() {
                format!(" ({})", check.note)
            } else {
                String::new()
            };
            format!("{}{limit}{note}", check.figure())
        });
        let words = closest.drive.motor.kind.vocabulary();
        let alone = match violation.alone {
            0 => String::new(),
            n => format!(", {n} for no other reason"),
        };
        format!(
            "  {}: {}{alone}; the closest, {}: {figures}",
            violation.rule.named(words),
            counted(violation.count, "drive", "drives"),
            closest.drive.name(),
        )
    });
    lines.collect()
}

/// The number of suitable drives by certainty, with the first drive of each.
fn counts(selection: &Selection) -> String {
    let all = selection.fit.len() + selection.refused.len();
    let mut text = format!(
        "{} of {} {} no rule:",
        selection.fit.len(),
        counted(all, "drive", "drives"),
        if selection.fit.len() == 1 {
            "violates"
        } else {
            "violate"
        }
    );
    for class in selection.classes() {
        text += "\n  ";
        text += &class_text(&class);
    }
    text
}

/// The suitable drives of one certainty in a line.
pub(crate) fn class_text(class: &Class) -> String {
    let drive = &class.first.drive;
    let power = drive.motor.rated_power();
    let power = power.map_or_else(String::new, |power| format!(", {}", kilowatts(power)));
    format!(
        "{} {}; the first is rank {}: {}{power}",
        class.count,
        certainty(class.certainty),
        class.rank,
        drive.name()
    )
}

/// A power (W) as lists have it.
pub(super) fn kilowatts(power: f64) -> String {
    format!("{} kW", significant(power / 1e3, 3))
}

/// The certainty of a drive's data.
const fn certainty(certainty: Certainty) -> &'static str {
    match certainty {
        Certainty::Makers => "with the makers' own figures, of known voltage",
        Certainty::Others => "with figures that are not all the makers' own (*), of known voltage",
        Certainty::Pairing => {
            "whose amplifier no source pairs with the motor (†), of known voltage"
        }
        Certainty::Voltage => "of unknown voltage (–)",
    }
}

/// Why a drive ranks lower than others.
pub(super) const fn doubt(certainty: Certainty) -> &'static str {
    match certainty {
        Certainty::Makers => "it is larger",
        Certainty::Others => {
            "its figures are not all the makers' own; check them against the data sheets"
        }
        Certainty::Pairing => "no source pairs this amplifier with this motor; ask the makers",
        Certainty::Voltage => "the catalogue does not give its voltage class; ask the makers",
    }
}

/// The rules that are not checked for some of the suitable drives, with the cure.
fn not_checked(selection: &Selection, words: &Vocabulary) -> Option<String> {
    let gaps = selection.gaps();
    if gaps.is_empty() {
        return None;
    }
    let whole = selection.fit.len() - selection.partly_checked();
    let mut text = format!(
        "checked by all rules: {}; not checked, because data are missing:",
        counted(whole, "drive", "drives")
    );
    for gap in &gaps {
        text += "\n  ";
        text += &gap_text(gap, words);
    }
    Some(text)
}

/// A rule that is not checked for some drives.
pub(crate) fn gap_text(gap: &Gap, words: &Vocabulary) -> String {
    format!(
        "{}: {} (no data: {}); needs {}",
        gap.rule.named(words),
        counted(gap.count, "drive", "drives"),
        gap.missing,
        cure(gap.rule)
    )
}

/// Smaller suitable motors, which rank lower because their data are less certain; then the next smaller one with the rules that it violates.
pub(crate) fn smaller(selection: &Selection) -> Vec<String> {
    let power = |candidate: &Candidate| candidate.drive.motor.rated_power();
    let mut least = selection
        .fit
        .first()
        .and_then(power)
        .unwrap_or(f64::INFINITY);
    let mut lines = Vec::new();
    // Under another ranking the first drive of a class is not its smallest.
    let by_size = selection.ranking.is_none();
    for class in selection.classes().iter().filter(|_| by_size) {
        if let Some(power) = power(&class.first).filter(|power| *power < least) {
            least = power;
            lines.push(format!(
                "smaller motor, {}: {} violates no rule either, but ranks lower ({}): {}",
                kilowatts(power),
                class.first.drive.name(),
                class.rank,
                doubt(class.certainty)
            ));
        }
    }
    lines.extend(next_smaller(selection));
    lines
}

/// The next smaller motor, and the rules that it violates.
fn next_smaller(selection: &Selection) -> Option<String> {
    let next = &selection.judged(&selection.next_smaller()?);
    Some(format!(
        "next smaller motor, {}: {} is refused: {}",
        kilowatts(next.rated_power()?),
        next.drive.name(),
        next.reasons()
    ))
}

fn ranking(list: List, selection: &Selection, words: &Vocabulary) -> String {
    let shown = list.ranked(selection);
    let judged = shown.iter();
    let judged: Vec<(usize, Judged)> = judged
        .map(|(rank, candidate)| (*rank, selection.judged(candidate)))
        .collect();
    let resistors = judged.iter().any(|(_, judged)| judged.resistor.is_some());
    let mut head = vec![
        "rank",
        "motor",
        "made for",
        "gearbox",
        "ratio",
        "amplifier",
        "rated [kW]",
        "mass [kg]",
        "price",
        "RMS used",
        "peak used",
        "speed used",
        "λ max",
    ];
    if resistors {
        head.push("brake resistor");
    }
    let mut table = text_table(&head);
    for (rank, judged) in &judged {
        let mut row = rank_row(*rank, judged).to_vec();
        if resistors {
            row.push(
                judged
                    .resistor
                    .map_or("–".to_owned(), |r| marks::key(&r.key, r.from_maker)),
            );
        }
        table.add_row(row);
    }
    let drives: Vec<Drive> = shown.iter().map(|(_, c)| c.drive).collect();
    let mut remarks = String::new();
    for line in marks::legend(&drives) {
        let _ = write!(remarks, "\n{line}");
    }
    if resistors {
        remarks +=
            "\nbrake resistor: the smallest of the catalogue that fits; the price contains it";
    }
    let more = selection.fit.len() - shown.len();
    if more > 0 && !list.all && !list.all_gearboxes {
        let _ = write!(
            remarks,
            "\n{}: other gearboxes and amplifiers, or larger motors; --all-gearboxes lists every gearbox, --top N more motors",
            counted(more, "more drive fits", "more drives fit")
        );
    }
    if selection.fit.len() + selection.refused.len() > 1 {
        remarks = format!("\nranked: {}{remarks}", selection.ranking(words));
    }
    format!("{table}{remarks}")
}

/// Rows of min, mean, max and RMS, each in its unit.
fn figures_table(rows: &[(String, Figures, f64)]) -> String {
    let mut table = text_table(&["", "min", "mean", "max", "RMS"]);
    for (name, figures, unit) in rows {
        // Values below the sixth digit of the largest one are shown as zero.
        let noise = 5e-6 * figures.peak();
        let cells = figures
            .values()
            .map(|x| rounded(if x.abs() <= noise { 0.0 } else { x / unit }));
        table.add_row(std::iter::once(name.clone()).chain(cells));
    }
    table.to_string()
}

/// Duty of a drive and the verdict of every rule.
fn drive_text(judged: &Judged) -> String {
    let duty = &judged.duty;
    let words = judged.drive.motor.kind.vocabulary();
    let figures = figures_table(&[
        (format!("motor {}", words.torque.label()), duty.torque, 1.0),
        (
            format!("motor {}", words.speed.label()),
            duty.speed,
            words.speed.scale,
        ),
        ("motor power [W]".to_owned(), duty.power, 1.0),
        (
            format!("{} ratio λ", words.inertia),
            duty.inertia_ratio,
            1.0,
        ),
    ]);
    format!(
        "{figures}\nper cycle: {} J supplied, {} J regenerated\n\n{}",
        rounded(duty.motoring_energy),
        rounded(cleared(duty.regenerative_energy, duty.motoring_energy)),
        rules_table(judged)
    )
}

/// The checked rules as a table, the others in a line.
fn rules_table(judged: &Judged) -> String {
    let mut table = text_table(&[
        "rule", "figure", "limit", "used", "margin", "verdict", "limit is",
    ]);
    let open = |check: &&Check| check.verdict == Verdict::NotChecked;
    for check in judged.checks.iter().filter(|check| !open(check)) {
        table.add_row([
            check.rule.to_owned(),
            check.figure(),
            check.bound().unwrap_or_default(),
            check.used(),
            margin(check),
            check.verdict.word().to_owned(),
            check.note.clone(),
        ]);
    }
    let missing: Vec<String> = judged
        .checks
        .iter()
        .filter(open)
        .map(|check| format!("{} ({})", check.rule, check.note))
        .collect();
    // Only the last column is wrapped.
    table
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(1000);
    if let Some(column) = table.column_mut(6) {
        column.set_constraint(ColumnConstraint::UpperBoundary(Width::Fixed(NOTE_WIDTH)));
    }
    let mut text = table.to_string();
    if !missing.is_empty() {
        text += "\nnot checked: ";
        text += &missing.join("; ");
    }
    for warning in judged.warnings() {
        text += "\nwarning: ";
        text += &warning;
    }
    text
}

/// Margin in percent.
pub(crate) fn margin(check: &Check) -> String {
    match check.margin() {
        Some(margin) if margin > -9.995 => format!("{:+.0} %", margin * 100.0),
        Some(_) => "< -999 %".to_owned(),
        None => String::new(),
    }
}

/// A figure of the catalogue, or a dash without data.
pub(crate) fn figure(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), short)
}

fn rank_row(rank: usize, judged: &Judged) -> [String; 13] {
    let drive = &judged.drive;
    let power = judged.rated_power();
    let [motor, gearbox, amplifier] = marks::drive(drive);
    [
        rank.to_string(),
        motor,
        marks::made_for(drive),
        gearbox,
        rounded(drive.ratio()),
        amplifier,
        power.map_or("–".to_owned(), |power| significant(power / 1000.0, 3)),
        figure(drive.mass()),
        figure(judged.price()),
        judged.used(Rule::RmsTorque),
        judged.used(Rule::PeakTorque),
        judged.used(Rule::Speed),
        short(judged.duty.inertia_ratio.max),
    ]
}
