//! A selection as comma-separated values.

use super::List;
use crate::comma;
use crate::size::Selection;

/// Columns, a row for every rule of every drive that is listed.
const COLUMNS: [&str; 11] = [
    "rank",
    "motor",
    "gearbox",
    "amplifier",
    "ratio",
    "verdict",
    "rule",
    "figure",
    "limit",
    "unit",
    "note",
];

/// Every rule of every drive that is listed as a row; "verdict" is the rule's.
pub fn csv(list: List, selection: &Selection) -> String {
    let fit = list.fit(selection);
    let refused = list.refused(selection);
    let ranks = (1..=fit.len()).map(|k| k.to_string());
    let ranks = ranks.chain(std::iter::repeat(String::new()));
    let mut text = comma::row(COLUMNS);
    for (rank, candidate) in ranks.zip(fit.iter().chain(&refused)) {
        let judged = selection.judged(candidate);
        let drive = &judged.drive;
        let rows = judged.checks.iter().map(|check| {
            [
                rank.clone(),
                drive.motor.key.clone(),
                drive.gearbox.map_or_else(String::new, |g| g.key.clone()),
                drive.amplifier.map_or_else(String::new, |a| a.key.clone()),
                comma::number(drive.ratio()),
                check.verdict.word().to_owned(),
                check.rule.to_owned(),
                comma::known(check.value),
                comma::known(check.limit),
                check.unit.to_owned(),
                check.note.clone(),
            ]
        });
        text += &comma::rows(rows);
    }
    text
}
