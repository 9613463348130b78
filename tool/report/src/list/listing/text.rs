//! A selection as text.

use comfy_table::{ColumnConstraint, ContentArrangement, Width};

use super::{Asked, Explanation, List};
use crate::table::output::text_table;
use jred_machine::analysis::duty::{Duty, Instant};
use jred_machine::model::machine::MachineFile;
use jred_machine::model::rule::Rule;
use jred_machine::model::rules::Verdict;
use jred_machine::model::site::Site;
use jred_machine::number::figures::Figures;
use jred_machine::number::rounding::{rounded, short, significant};
use jred_machine::number::words::counted;
use jred_machine::units::Vocabulary;
use jred_sizing::catalogue::MotorKind;
use jred_sizing::judge::Judged;
use jred_sizing::judge::check::Check;
use jred_sizing::select::size::Selection;

/// Width of the column "limit is".
const NOTE_WIDTH: u16 = 72;

/// Duty, best drive with every rule, ranking, and the refused ones if asked for; a drive that was asked for by name instead of the
/// best, with why it stands where it does.
pub fn text(
    list: List,
    file: &MachineFile,
    duty: &Duty,
    selection: &Selection,
    asked: Option<&Asked>,
    explanation: Option<&Explanation>,
) -> String {
    let input_power = |i: &Instant| i.input_torque * i.input_speed;
    let first = selection.fit.first().or(selection.refused.first());
    let shown = asked.map(|asked| &asked.candidate).or(first);
    let kind = shown.map_or(MotorKind::Rotary, |c| c.drive.motor.kind);
    let words = kind.vocabulary();
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
    let mut parts = vec![format!(
        "{}\n\n{}\n\nDuty at the input of the drive train, cycle {} s\n{input}\n",
        file.title,
        supply(&file.site),
        rounded(duty.duration)
    )];
    let all = selection.fit.len() + selection.refused.len();
    if let Some(asked) = asked {
        parts.push(asked_text(asked, selection));
    } else if let Some(best) = selection.fit.first() {
        let best = &selection.judged(best);
        parts.push(format!(
            "Best drive: {}\n{}",
            best.drive.name(),
            drive_text(best)
        ));
        let open = match selection.partly_checked() {
            0 => String::new(),
            open => {
                format!("; not fully checked (data missing): {open}")
            }
        };
        parts.push(format!(
            "\n{} of {} {} no rule{open}",
            selection.fit.len(),
            counted(all, "drive", "drives"),
            if selection.fit.len() == 1 {
                "violates"
            } else {
                "violate"
            }
        ));
        parts.push(ranking(list, selection, words));
        parts.extend(next_smaller(selection));
    } else if let Some(nearest) = selection.refused.first() {
        let nearest = &selection.judged(nearest);
        parts.push(format!(
            "None of {} satisfies every rule. The closest one: {}\n{}",
            counted(all, "drive", "drives"),
            nearest.drive.name(),
            drive_text(nearest)
        ));
    }
    if let Some(explanation) = explanation {
        parts.push(explanation.text(duty.duration));
    }
    if list.refused || list.all {
        parts.push("\nRefused".to_owned());
        for candidate in &list.refused(selection) {
            let reasons = selection.judged(candidate).reasons();
            parts.push(format!("  {}: {reasons}", candidate.drive.name()));
        }
    } else if !selection.refused.is_empty() {
        let explain = if explanation.is_some() {
            ""
        } else {
            "; --explain shows what would have to change"
        };
        parts.push(format!(
            "{} refused; --refused lists them with their reasons{explain}",
            counted(selection.refused.len(), "drive", "drives")
        ));
    }
    parts.join("\n") + "\n"
}

/// The supply that motors and amplifiers are judged at.
fn supply(site: &Site) -> String {
    match (site.mains_voltage, site.bus_voltage) {
        (Some(mains), Some(bus)) => {
            format!("Supply: {} V mains, DC bus {} V", short(mains), short(bus))
        }
        (_, Some(bus)) => format!("Supply: DC bus {} V", short(bus)),
        _ => "Supply: not given; using each motor at the voltage of its data. Give mains_voltage in [supply]".to_owned(),
    }
}

/// The drive that was asked for, every rule, and the best one's name.
fn asked_text(asked: &Asked, selection: &Selection) -> String {
    let judged = &selection.judged(&asked.candidate);
    let (name, place) = (judged.drive.name(), asked.place(selection));
    let best = match selection.fit.first() {
        Some(best) if asked.rank != Some(1) => format!("\nThe best drive is {}", best.drive.name()),
        Some(_) => String::new(),
        None => "\nNo drive satisfies every rule".to_owned(),
    };
    format!(
        "Requested drive: {name}\n{place}\n\n{}\n{best}",
        drive_text(judged)
    )
}

/// Why no smaller motor will do: the next smaller one, and the rules that it violates.
pub(crate) fn next_smaller(selection: &Selection) -> Option<String> {
    let next = &selection.judged(&selection.next_smaller()?);
    Some(format!(
        "next smaller motor, {} kW: {} is refused: {}",
        significant(next.rated_power()? / 1e3, 3),
        next.drive.name(),
        next.reasons()
    ))
}

fn ranking(list: List, selection: &Selection, words: &Vocabulary) -> String {
    let mut table = text_table(&[
        "rank",
        "motor",
        "made for",
        "gearbox",
        "rated [kW]",
        "RMS used",
        "peak used",
        "speed used",
        "λ max",
    ]);
    let shown = list.fit(selection);
    for (k, candidate) in shown.iter().enumerate() {
        table.add_row(rank_row(k + 1, &selection.judged(candidate)));
    }
    let others = shown.iter().any(|candidate| !candidate.drive.from_makers());
    let remark = if others { OTHERS } else { "" };
    format!("{table}\nranked: {}{remark}", selection.ranking(words))
}

/// What the mark in the ranking means.
const OTHERS: &str = "\n* figures not from the maker's own document";

/// A key of the catalogue, marked if its figures are not from the maker's own document.
fn marked(key: &str, from_maker: bool) -> String {
    let mark = if from_maker { "" } else { " *" };
    format!("{key}{mark}")
}

/// Rows of min, mean, max and RMS, each in its unit.
fn figures_table(rows: &[(String, Figures, f64)]) -> String {
    let mut table = text_table(&["", "min", "mean", "max", "RMS"]);
    for (name, figures, unit) in rows {
        // Rounding errors compared with the largest value are shown as zero.
        let noise = 1e-12 * figures.peak();
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
        rounded(duty.regenerative_energy),
        rules_table(judged)
    )
}

/// The rules that were checked as a table, the others in a line.
fn rules_table(judged: &Judged) -> String {
    let mut table = text_table(&[
        "rule", "figure", "limit", "used", "margin", "verdict", "limit is",
    ]);
    let open = |check: &&Check| check.verdict == Verdict::NotChecked;
    for check in judged.checks.iter().filter(|check| !open(check)) {
        table.add_row([
            check.rule.to_owned(),
            check.figure(),
            check
                .limit
                .map_or(String::new(), |limit| check.with_unit(limit)),
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
    // The last column alone is broken into lines.
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
    for assumed in &judged.assumptions {
        text += "\nwarning: ";
        text += assumed;
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

fn rank_row(rank: usize, judged: &Judged) -> [String; 9] {
    let drive = &judged.drive;
    let power = judged.rated_power();
    [
        rank.to_string(),
        marked(&drive.motor.key, drive.motor.from_maker),
        (drive.motor.made_for()).map_or("–".to_owned(), |made| made.words()),
        drive
            .gearbox
            .map_or("direct".to_owned(), |g| marked(&g.key, g.from_maker)),
        power.map_or("–".to_owned(), |power| significant(power / 1000.0, 3)),
        judged.used(Rule::RmsTorque),
        judged.used(Rule::PeakTorque),
        judged.used(Rule::Speed),
        short(judged.duty.inertia_ratio.max),
    ]
}
