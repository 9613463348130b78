//! The results as tables in Markdown.

use std::fmt::Write as _;

use crate::Fault;
use crate::feed_forward::Way;
use crate::machine::{CASES, Case, Deviation};
use crate::study::{Bench, Found, PACES, Solver};

/// Deviations of the machine from its model, at the pace of the file.
const DEVIATIONS: [(&str, Deviation); 5] = [
    ("J −20 %", Deviation::Inertia(0.8)),
    ("J +20 %", Deviation::Inertia(1.2)),
    ("friction −50 %", Deviation::Friction(0.5)),
    ("friction +50 %", Deviation::Friction(1.5)),
    ("payload", Deviation::Payload),
];

/// The pace of the file, whose following error is listed.
const OWN: f64 = 1.0;

/// The table of a machine: RMS feedback torque by way over pace and deviation, and the following error.
pub(crate) fn table(case: Case) -> Result<String, Fault> {
    let file = case.read()?;
    let bench = Bench::new(case, &file)?;
    let mut text = format!("**{}**, payload {} kg\n\n| feed-forward |", case.name, case.payload);
    for pace in PACES {
        let _ = write!(text, " {:.0} % |", 100.0 * pace);
    }
    for (name, _) in DEVIATIONS {
        let _ = write!(text, " {name} |");
    }
    let columns = PACES.len() + DEVIATIONS.len() + 1;
    let _ = writeln!(text, " error, mrad |\n|---|{}", "---:|".repeat(columns));
    for way in Way::ALL {
        let found = |pace, deviation| bench.found(way, pace, deviation, Solver::DormandPrince);
        let _ = write!(text, "| {} |", way.name());
        for pace in PACES {
            let _ = write!(text, " {} |", short(found(pace, Deviation::None)?.feedback));
        }
        for (_, deviation) in DEVIATIONS {
            let _ = write!(text, " {} |", short(found(OWN, deviation)?.feedback));
        }
        let error = 1000.0 * found(OWN, Deviation::None)?.error;
        let _ = writeln!(text, " {} |", short(error));
    }
    Ok(text)
}

/// What the tables leave open, in sentences.
pub(crate) fn remarks() -> Result<String, Fault> {
    let mut text = String::new();
    for case in CASES {
        let file = case.read()?;
        let bench = Bench::new(case, &file)?;
        let found = |way, solver| bench.found(way, OWN, Deviation::None, solver);
        let [jred, constant] = [Way::Float, Way::MeanInertia].map(|way| found(way, Solver::DormandPrince));
        let stepped = found(Way::Float, Solver::Stepped)?.feedback;
        let [jred, constant] = [jred?, constant?].map(|found: Found| found.feedback);
        let _ = writeln!(
            text,
            "- {}: {:.0} times less feedback torque with jred than with constant J; with the machine in fixed steps {} N m",
            case.name,
            constant / jred,
            short(stepped)
        );
        if case.has_process() {
            for way in [Way::MeanInertia, Way::Float] {
                let found = bench.found(way, OWN, Deviation::Process, Solver::DormandPrince)?;
                let _ = writeln!(
                    text,
                    "- {} with a process load that no feed-forward knows, {}: {} N m",
                    case.name,
                    way.name(),
                    short(found.feedback)
                );
            }
        }
    }
    Ok(text)
}

/// Three digits.
pub(crate) fn short(value: f64) -> String {
    let digits = 2 - value.abs().max(1e-3).log10().floor() as i32;
    format!("{value:.*}", digits.clamp(0, 4) as usize)
}
