//! A selection as comma-separated values.

use miette::{IntoDiagnostic as _, Result, miette};

use super::List;
use crate::size::Selection;

/// Every rule of every drive that is listed as a row.
///
/// # Errors
/// None that can be provoked: the writer writes to memory.
pub fn csv(list: List, selection: &Selection) -> Result<String> {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    writer
        .write_record([
            "rank", "motor", "gearbox", "ratio", "verdict", "rule", "figure", "limit", "unit",
            "note",
        ])
        .into_diagnostic()?;
    let fit = list.fit(selection);
    let refused = list.refused(selection);
    let ranks = (1..=fit.len()).map(|k| k.to_string());
    let ranks = ranks.chain(std::iter::repeat(String::new()));
    for (rank, candidate) in ranks.zip(fit.iter().chain(&refused)) {
        let judged = selection.judged(candidate);
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
                    &check.value.map_or(String::new(), |v| v.to_string()),
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
