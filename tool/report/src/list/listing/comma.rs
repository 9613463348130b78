//! A selection as comma-separated values.

use super::{Asked, List};
use jred_machine::number::csv;
use jred_sizing::judge::Judged;
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

/// Every rule of every drive that is listed as a row, part by part, a drive each; "verdict" is the rule's. The drive asked for comes
/// first, with its rank if it fits, and is left out of the list.
pub fn csv<'c>(
    list: List,
    selection: &'c Selection<'c>,
    asked: Option<&Asked<'c>>,
) -> impl Iterator<Item = String> {
    let (fit, refused) = (list.fit(selection), list.refused(selection));
    let ranks = (1..=fit.len()).map(|k| k.to_string());
    let ranks = ranks.chain(std::iter::repeat(String::new()));
    let listed = ranks.zip(fit.into_iter().chain(refused));
    let first = asked.map(|asked| {
        let rank = asked.rank.map_or_else(String::new, |rank| rank.to_string());
        (rank, asked.candidate)
    });
    let asked = first.as_ref().map(|(_, candidate)| *candidate);
    let is_first =
        move |candidate: &Candidate| asked.is_some_and(|asked| asked.is_same_drive(candidate));
    let listed = listed.filter(move |(_, candidate)| !is_first(candidate));
    let drives = first.into_iter().chain(listed);
    let drives = drives.map(|(rank, candidate)| rows(&rank, &selection.judged(&candidate)));
    std::iter::once(csv::row(COLUMNS)).chain(drives)
}

fn rows(rank: &str, judged: &Judged) -> String {
    let drive = &judged.drive;
    let rows = judged.checks.iter().map(|check| {
        [
            rank.to_owned(),
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
    csv::rows(rows)
}
