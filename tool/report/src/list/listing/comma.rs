//! A selection as comma-separated values.

use super::{Asked, List};
use jred_file::number::csv;
use jred_sizing::judge::Assessment;
use jred_sizing::select::size::{Candidate, Certainty, Selection};

/// Columns; a row for every rule of every listed drive.
const COLUMNS: [&str; 15] = [
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
    "certainty",
    "mass [kg]",
    "price",
    "brake resistor",
];

/// A row for every rule of every listed drive, in parts of one drive. "verdict" is that of the rule, "certainty" that of a suitable drive; "brake
/// resistor" is the one chosen from the catalogue. A requested drive comes first, with its rank if it is suitable, and is left out of the list.
pub fn csv<'c>(
    list: List,
    selection: &'c Selection<'c>,
    asked: Option<&Asked<'c>>,
) -> impl Iterator<Item = String> {
    let fit = list.ranked(selection).into_iter();
    let refused = list.refused(selection).into_iter();
    let listed = (fit.map(|(rank, candidate)| (rank.to_string(), candidate)))
        .chain(refused.map(|candidate| (String::new(), candidate)));
    let first = asked.map(|asked| {
        let rank = asked.rank.map_or_else(String::new, |rank| rank.to_string());
        (rank, asked.candidate)
    });
    let asked = first.as_ref().map(|(_, candidate)| *candidate);
    let is_first =
        move |candidate: &Candidate| asked.is_some_and(|asked| asked.is_same_drive(candidate));
    let listed = listed.filter(move |(_, candidate)| !is_first(candidate));
    let drives = first.into_iter().chain(listed);
    let drives = drives.map(|(rank, candidate)| {
        let certainty = candidate.certainty().map_or("", Certainty::word);
        rows(&rank, certainty, &selection.judged(&candidate))
    });
    std::iter::once(csv::row(COLUMNS)).chain(drives)
}

fn rows(rank: &str, certainty: &str, judged: &Assessment) -> String {
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
            certainty.to_owned(),
            csv::known(drive.mass()),
            csv::known(judged.price()),
            judged.resistor.map_or_else(String::new, |r| r.key.clone()),
        ]
    });
    csv::rows(rows)
}
