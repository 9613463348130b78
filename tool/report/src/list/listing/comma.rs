//! A selection as comma-separated values.

use super::{Asked, List};
use jred_machine::number::csv;
use jred_sizing::select::size::{Candidate, Selection};

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

/// Every rule of every drive that is listed as a row; "verdict" is the rule's. The drive asked for comes first, with its rank if
/// it fits, and is left out of the list.
pub fn csv(list: List, selection: &Selection, asked: Option<&Asked>) -> String {
    let fit = list.fit(selection);
    let refused = list.refused(selection);
    let ranks = (1..=fit.len()).map(|k| k.to_string());
    let ranks = ranks.chain(std::iter::repeat(String::new()));
    let listed = ranks.zip(fit.iter().chain(&refused));
    let first = asked.map(|asked| {
        let rank = asked.rank.map_or_else(String::new, |rank| rank.to_string());
        (rank, &asked.candidate)
    });
    let is_first =
        |candidate: &Candidate| asked.is_some_and(|asked| asked.candidate.is_same_drive(candidate));
    let listed = listed.filter(|(_, candidate)| !is_first(candidate));
    let mut text = csv::row(COLUMNS);
    for (rank, candidate) in first.into_iter().chain(listed) {
        let judged = selection.judged(candidate);
        let drive = &judged.drive;
        let rows = judged.checks.iter().map(|check| {
            [
                rank.clone(),
                drive.motor.key.clone(),
                drive.gearbox.map_or_else(String::new, |g| g.key.clone()),
                drive.amplifier.map_or_else(String::new, |a| a.key.clone()),
                csv::number(drive.ratio()),
                check.verdict.word().to_owned(),
                check.rule.to_owned(),
                csv::known(check.value),
                csv::known(check.limit),
                check.unit.to_owned(),
                check.note.clone(),
            ]
        });
        text += &csv::rows(rows);
    }
    text
}
