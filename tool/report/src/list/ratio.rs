//! Gear ratios for every motor as a sheet.

mod obstacle;

use crate::answer::sheet::Sheet;
use crate::table::reading::Reading;
use jred_file::model::rule::Rule;
use jred_file::number::rounding::{short, significant};
use jred_sizing::cell::Cell;
use jred_sizing::select::ratio::{Gear, Range};
use jred_sizing::study::ratio::{MotorRatio, Ratios};

/// Name and version of the form in JSON, and its columns.
pub(crate) const FORM: &str = "jred-ratio/1";
pub(crate) const COLUMNS: [&str; 14] = [
    "motor",
    "rated power [W]",
    "alpha [W/s]",
    "beta [W/s]",
    "best ratio",
    "RMS torque there [N m]",
    "RMS ratio from",
    "RMS ratio to",
    "ratio from",
    "ended by",
    "ratio to",
    "ended by (above)",
    "gearboxes",
    "why none",
];

const READING: [&str; 8] = [
    "motor",
    "rated [kW]",
    "alpha/beta",
    "best ratio",
    "RMS [N m]",
    "RMS ratio",
    "ratio",
    "limited by: gearboxes; or why none",
];

/// The ranges of every motor; with `top`, those of the first `top` suitable motors.
pub fn sheet(study: &Ratios, mut rows: Vec<MotorRatio>, top: Option<usize>) -> Sheet {
    let share = study.rms_share();
    let gear = match study.gear {
        Gear::IDEAL => "no inertia and no losses in the gearbox".to_owned(),
        Gear {
            inertia,
            efficiency,
        } => format!(
            "a gearbox with {} % efficiency and {} kg cm^2 at its input",
            short(efficiency * 100.0),
            short(inertia * 1e4)
        ),
    };
    let mut notes = vec![
            format!(
                "alpha: (rated torque × {})²/J, the accelerating factor; beta: the load factor. A motor with alpha \
                 below beta is too small at any ratio.",
                short(share)
            ),
            "best ratio: the ratio with the smallest RMS torque, which is listed as RMS. RMS ratio: range in which \
             that torque is within the limit for the rated torque. Ratio: range in which the motor satisfies every \
             rule (S1 torque at its speed, peak torque, speed, holding torque and inertia ratio); limited by: the rule \
             violated below and above the range, or the reason why no ratio satisfies them."
                .to_owned(),
            "gearboxes: those in the catalogue with a ratio in the range; in brackets: the drive violates a rule \
             because of the limits, inertia or losses of the gearbox."
                .to_owned(),
        ];
    if rows.iter().any(|row| row.best.is_none()) {
        notes.push(
            "no best ratio and no beta: nothing accelerates, and the RMS torque falls with every larger ratio; or \
             nothing loads the output, and it falls with every smaller one. The RMS ratio is open on that side."
                .to_owned(),
        );
    }
    if let Some(top) = top {
        let all = rows.len();
        rows.retain(|row| row.found.is_ok());
        let hold = rows.len();
        rows.truncate(top);
        notes.push(format!(
                "--top: {} of {hold} ranges in which a motor satisfies every rule; motors without a suitable ratio: {}.",
                rows.len(),
                all - hold
            ));
    }
    Sheet {
        schema: FORM,
        title: format!(
            "{}: gear ratio for every motor in the catalogue, with {gear}",
            study.file.title
        ),
        columns: COLUMNS.map(str::to_owned).to_vec(),
        reading: Some(Reading::new(
            READING,
            rows.iter().map(reading),
            READING.len() - 1,
        )),
        rows: rows.iter().map(cells).collect(),
        notes,
        lead: 0,
    }
}

/// Every figure.
fn cells(row: &MotorRatio) -> Vec<Cell> {
    let found = row.found.as_ref().ok();
    let ended = |rule: Option<Rule>| rule.map_or(Cell::Empty, |rule| rule.name().into());
    let text = |text: String| {
        if text.is_empty() {
            Cell::Empty
        } else {
            text.into()
        }
    };
    let [alpha, beta] = row.factors();
    vec![
        row.motor.key.as_str().into(),
        row.motor.rated_power().into(),
        alpha.into(),
        beta.into(),
        row.best.into(),
        row.rms_torque().into(),
        row.rms.map(|[from, _]| from).into(),
        // Empty if the range is open.
        row.rms.map(|[_, to]| to).into(),
        found.map(|found| found.range[0]).into(),
        ended(found.and_then(|found| found.below)),
        found.map(|found| found.range[1]).into(),
        ended(found.and_then(|found| found.above)),
        text(gearboxes(row)),
        text(why(row)),
    ]
}

/// For reading: ranges in one cell, and the reason in place of a missing range.
fn reading(row: &MotorRatio) -> Vec<Cell> {
    let range = |range: Range| -> Cell {
        let [from, to] = range.map(|x| significant(x, 3));
        match range {
            [0.0, f64::INFINITY] => "any".into(),
            [_, f64::INFINITY] => format!("{from} or more").into(),
            [0.0, _] => format!("{to} or less").into(),
            _ => format!("{from} to {to}").into(),
        }
    };
    let [alpha, beta] = row.factors();
    let factors = alpha.zip(beta).map(|(alpha, beta)| alpha / beta);
    let mut cells = vec![
        row.motor.key.as_str().into(),
        row.motor.rated_power().map(|power| power / 1000.0).into(),
        factors.into(),
        row.best.into(),
        row.rms_torque().into(),
        row.rms.map_or_else(|| "none".into(), range),
    ];
    match &row.found {
        Ok(found) => {
            let name = |rule: Option<Rule>| rule.map_or("-", Rule::name);
            let [below, above] = [name(found.below), name(found.above)];
            cells.push(range(found.range));
            let ends = format!("{below} / {above}: {}", gearboxes(row));
            cells.push(ends.trim_end_matches([':', ' ']).into());
        }
        Err(_) => cells.extend(["none".into(), why(row).into()]),
    }
    cells
}

/// Why there is no range.
fn why(row: &MotorRatio) -> String {
    match &row.found {
        Ok(_) => String::new(),
        Err(obstacle) => obstacle.as_ref().map_or_else(
            || "narrower than the step of the search".to_owned(),
            obstacle::words,
        ),
    }
}

/// The keys of the gearboxes; in brackets if the drive violates a rule.
fn gearboxes(row: &MotorRatio) -> String {
    let names = row.gearboxes.iter().map(|(gearbox, fits)| match fits {
        true => gearbox.key.clone(),
        false => format!("({})", gearbox.key),
    });
    names.collect::<Vec<_>>().join(" ")
}
