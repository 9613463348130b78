//! How a selection of drives is listed: as text, CSV or JSON.

use miette::{IntoDiagnostic as _, Result, miette};
use serde_json::{Value, json as object};

use crate::drive::{Judged, RPM};
use crate::duty::{Duty, Figures, Instant};
use crate::machine::MachineFile;
use crate::output::{rounded, short, text_table};
use crate::size::{RANKING, Selection};

/// How much of a selection the text lists.
#[derive(Clone, Copy, Debug)]
pub struct List {
    /// Number of ranked drives.
    pub top: usize,
    /// Every refused drive as well, with its reasons.
    pub refused: bool,
}

/// The selection for reading: duty, best drive with every rule, ranking, and the refused ones if asked for.
pub fn text(list: List, file: &MachineFile, duty: &Duty, selection: &Selection) -> String {
    let input_power = |i: &Instant| i.input_torque * i.input_speed;
    let input = figures_table(&[
        ("torque [N m]", duty.figures(|i| i.input_torque), 1.0),
        ("speed [rpm]", duty.figures(|i| i.input_speed), RPM),
        ("power [W]", duty.figures(input_power), 1.0),
        ("inertia [kg cm^2]", duty.figures(|i| i.input_inertia), 1e-4),
    ]);
    let mut parts = vec![format!(
        "{}\n\nDuty at the input of the drive train, cycle {} s\n{input}\n",
        file.title,
        rounded(duty.duration)
    )];
    let all = selection.fit.len() + selection.refused.len();
    if let Some(best) = selection.fit.first() {
        parts.push(format!(
            "Best drive: {}\n{}",
            best.drive.name(),
            drive_text(best)
        ));
        let open = match selection.partly_checked() {
            0 => String::new(),
            open => format!("; {open} of them have rules that the catalogue is too thin to check"),
        };
        parts.push(format!(
            "\n{} of {all} drives hold every rule{open}",
            selection.fit.len()
        ));
        let mut table = text_table(&[
            "rank",
            "motor",
            "gearbox",
            "rated [kW]",
            "RMS used",
            "peak used",
            "speed used",
            "λ max",
        ]);
        for (k, judged) in selection.fit.iter().take(list.top).enumerate() {
            table.add_row(rank_row(k + 1, judged));
        }
        parts.push(format!("{table}\nranked: {RANKING}"));
    } else if let Some(nearest) = selection.refused.first() {
        parts.push(format!(
            "No drive of {all} holds every rule. The one that misses by least: {}\n{}",
            nearest.drive.name(),
            drive_text(nearest)
        ));
    }
    if list.refused {
        parts.push("\nRefused".to_owned());
        for judged in &selection.refused {
            parts.push(format!("  {}: {}", judged.drive.name(), judged.reasons()));
        }
    } else if !selection.refused.is_empty() {
        parts.push(format!(
            "{} refused; --refused lists them with their reasons",
            selection.refused.len()
        ));
    }
    parts.join("\n") + "\n"
}

/// Rows of min, mean, max and RMS, each in its unit.
fn figures_table(rows: &[(&str, Figures, f64)]) -> String {
    let mut table = text_table(&["", "min", "mean", "max", "RMS"]);
    for (name, figures, unit) in rows {
        let cells = figures.values().map(|x| rounded(x / unit));
        table.add_row(std::iter::once((*name).to_owned()).chain(cells));
    }
    table.to_string()
}

/// A drive's duty and how every rule came out.
fn drive_text(judged: &Judged) -> String {
    let duty = &judged.duty;
    let figures = figures_table(&[
        ("motor torque [N m]", duty.torque, 1.0),
        ("motor speed [rpm]", duty.speed, RPM),
        ("motor power [W]", duty.power, 1.0),
        ("inertia ratio λ", duty.inertia_ratio, 1.0),
    ]);
    format!(
        "{figures}\nper cycle {} J put in, {} J regenerated\n\n{}",
        rounded(duty.motoring_energy),
        rounded(duty.regenerative_energy),
        rules_table(judged)
    )
}

fn rules_table(judged: &Judged) -> String {
    let mut table = text_table(&["rule", "figure", "limit", "used", "verdict", "limit is"]);
    for check in &judged.checks {
        table.add_row([
            check.rule.to_owned(),
            check.with_unit(check.value),
            check
                .limit
                .map_or(String::new(), |limit| check.with_unit(limit)),
            check.used(),
            check.verdict.word().to_owned(),
            check.note.clone(),
        ]);
    }
    let assumed = judged.assumptions.iter().map(|a| format!("\nmind: {a}"));
    table.to_string() + &assumed.collect::<String>()
}

fn rank_row(rank: usize, judged: &Judged) -> [String; 8] {
    let drive = &judged.drive;
    [
        rank.to_string(),
        drive.motor.key.clone(),
        drive.gearbox.map_or("direct".to_owned(), |g| g.key.clone()),
        format!("{:.2}", judged.rated_power() / 1000.0),
        judged.used("RMS torque"),
        judged.used("peak torque"),
        judged.used("speed"),
        short(judged.duty.inertia_ratio.max),
    ]
}

/// Every rule of every drive as a row.
///
/// # Errors
/// None that can be provoked: the writer writes to memory.
pub fn csv(selection: &Selection) -> Result<String> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    writer
        .write_record([
            "rank", "motor", "gearbox", "ratio", "verdict", "rule", "figure", "limit", "unit",
            "note",
        ])
        .into_diagnostic()?;
    let ranks = (1..=selection.fit.len()).map(|k| k.to_string());
    let ranks = ranks.chain(std::iter::repeat(String::new()));
    for (rank, judged) in ranks.zip(selection.fit.iter().chain(&selection.refused)) {
        for check in &judged.checks {
            let drive = &judged.drive;
            writer
                .write_record([
                    rank.as_str(),
                    &drive.motor.key,
                    drive.gearbox.map_or("", |g| g.key.as_str()),
                    &drive.ratio().to_string(),
                    check.verdict.word(),
                    check.rule,
                    &check.value.to_string(),
                    &check.limit.map_or(String::new(), |l| l.to_string()),
                    check.unit,
                    &check.note,
                ])
                .into_diagnostic()?;
        }
    }
    let bytes = writer.into_inner().map_err(|e| miette!("{e}"))?;
    String::from_utf8(bytes).into_diagnostic()
}

/// Everything, with every digit; `schema` names the version of this form.
pub fn json(file: &MachineFile, duty: &Duty, selection: &Selection) -> Value {
    let judged = |judged: &Judged| {
        let drive = &judged.drive;
        object!({
            "motor": drive.motor.key,
            "gearbox": drive.gearbox.map(|g| &g.key),
            "ratio": drive.ratio(),
            "rated power [W]": judged.rated_power(),
            "verdict": judged.verdict(),
            "duty": judged.duty,
            "checks": judged.checks,
            "assumptions": judged.assumptions,
        })
    };
    object!({
        "schema": "jred-size/1",
        "title": file.title,
        "cycle [s]": duty.duration,
        "drive link torque [N m]": duty.figures(|i| i.terms.total()),
        "drive link speed [rad/s]": duty.figures(|i| i.omega),
        "input torque [N m]": duty.figures(|i| i.input_torque),
        "input speed [rad/s]": duty.figures(|i| i.input_speed),
        "input inertia [kg m^2]": duty.figures(|i| i.input_inertia),
        "holding torque [N m]": duty.hold_torque,
        "rules": file.rules,
        "ranking": RANKING,
        "fit": selection.fit.iter().map(judged).collect::<Vec<_>>(),
        "refused": selection.refused.iter().map(judged).collect::<Vec<_>>(),
    })
}
