//! The results as tables in Markdown.

use std::fmt::Write as _;

use crate::Fault;
use crate::closed_loop::COUNTS;
use crate::feed_forward::Way;
use crate::machine::{CASES, Case, Deviation};
use crate::study::{Bench, PACES, Run};

/// Deviations of the machine from its model, at the pace of the file.
const DEVIATIONS: [(&str, Deviation); 5] = [
    ("J −20 %", Deviation::Inertia(0.8)),
    ("J +20 %", Deviation::Inertia(1.2)),
    ("friction −50 %", Deviation::Friction(0.5)),
    ("friction +50 %", Deviation::Friction(1.5)),
    ("payload", Deviation::Payload),
];

/// The table of a machine: RMS feedback torque by way over pace and deviation, and the following error.
pub(crate) fn table(case: Case) -> Result<String, Fault> {
    let file = case.read()?;
    let bench = Bench::new(case, &file)?;
    let mut text = format!(
        "**{}**, payload {} kg\n\n| feed-forward |",
        case.name, case.payload
    );
    for pace in PACES {
        let _ = write!(text, " {:.0} % |", 100.0 * pace);
    }
    for (name, _) in DEVIATIONS {
        let _ = write!(text, " {name} |");
    }
    let columns = PACES.len() + DEVIATIONS.len() + 1;
    let _ = writeln!(text, " error, mrad |\n|---|{}", "---:|".repeat(columns));
    let deviations = DEVIATIONS.map(|(_, deviation)| Run::with(deviation));
    let runs = PACES.map(Run::at).into_iter().chain(deviations);
    let runs: Vec<Run> = runs.chain([Run::NOMINAL]).collect();
    for way in Way::ALL {
        let _ = write!(text, "| {} |", way.name());
        let found = bench.found(way, &runs)?;
        if let Some((nominal, all)) = found.split_last() {
            for found in all {
                let _ = write!(text, " {} |", short(found.feedback));
            }
            let _ = writeln!(text, " {} |", short(1000.0 * nominal.error));
        }
    }
    Ok(text)
}

/// The machines side by side: what the table of jred is worth, and what its rest consists of.
pub(crate) fn summary() -> Result<String, Fault> {
    let finer = Run {
        counts: 16 * COUNTS,
        ..Run::NOMINAL
    };
    let stepped = Run {
        stepped: true,
        ..Run::NOMINAL
    };
    let unknown = Run::with(Deviation::Process);
    let rows = [
        ("constant J", Way::MeanInertia, Run::NOMINAL),
        ("jred, `f32`", Way::Float, Run::NOMINAL),
        ("jred, 16 times finer encoder", Way::Float, finer),
        ("jred, machine in fixed steps", Way::Float, stepped),
        (
            "constant J, unknown process load",
            Way::MeanInertia,
            unknown,
        ),
        ("jred, unknown process load", Way::Float, unknown),
    ];
    let mut columns = Vec::new();
    for case in CASES {
        let file = case.read()?;
        let bench = Bench::new(case, &file)?;
        let of = |way| {
            let runs: Vec<Run> = rows
                .iter()
                .filter(|row| row.1 == way)
                .map(|row| row.2)
                .collect();
            bench.found(way, &runs).map(Vec::into_iter)
        };
        let (mut constant, mut jred) = (of(Way::MeanInertia)?, of(Way::Float)?);
        let mut column = Vec::new();
        for (_, way, run) in rows {
            let found = if way == Way::Float {
                jred.next()
            } else {
                constant.next()
            };
            let known = run.deviation != Deviation::Process || case.is_idle();
            column.push(found.filter(|_| known).map(|found| found.feedback));
        }
        columns.push((case, column));
    }
    let mut text = "| RMS feedback torque, N m |".to_owned();
    for (case, _) in &columns {
        let _ = write!(text, " {} |", case.name);
    }
    text += "\n|---|---:|---:|---:|\n";
    for (k, (name, ..)) in rows.iter().enumerate() {
        let _ = write!(text, "| {name} |");
        for (_, column) in &columns {
            let found = column.get(k).copied().flatten();
            let _ = write!(text, " {} |", found.map(short).unwrap_or_default());
        }
        text += "\n";
    }
    text += "| constant J/jred |";
    for (_, column) in &columns {
        if let [Some(constant), Some(jred), ..] = column.as_slice() {
            let _ = write!(text, " {:.0} |", constant / jred);
        }
    }
    Ok(text + "\n")
}

/// Three digits.
pub(crate) fn short(value: f64) -> String {
    let digits = 2 - value.abs().max(1e-3).log10().floor() as i32;
    format!("{value:.*}", digits.clamp(0, 5) as usize)
}
