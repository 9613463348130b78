//! A selection as comma-separated values.

use super::Listing;
use crate::answer::Answer;
use crate::list::rule_words::note;
use jred_file::number::csv;
use jred_sizing::judge::Assessment;
use jred_sizing::select::size::{Candidate, Certainty};

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
pub(super) fn answer(shown: Listing) -> Answer {
    let mut answer = Answer::words(&shown.file.title);
    answer.csv_parts(move || {
        let (list, selection) = (shown.list, shown.selection);
        let fit = list.ranked(selection).into_iter();
        let fit = fit.map(|(rank, candidate)| (Some(rank), candidate));
        let refused = list.refused(selection).into_iter();
        let listed = fit.chain(refused.map(|candidate| (None, candidate)));
        let first = shown.asked.map(|asked| (asked.rank, asked.candidate));
        let is_first = move |candidate: &Candidate| {
            first.is_some_and(|(_, asked)| asked.is_same_drive(candidate))
        };
        let listed = listed.filter(move |(_, candidate)| !is_first(candidate));
        let drives = first
            .into_iter()
            .chain(listed)
            .map(move |(rank, candidate)| {
                let rank = rank.map_or_else(String::new, |rank| rank.to_string());
                let certainty = candidate.certainty().map_or("", Certainty::word);
                rows(&rank, certainty, &selection.judged(&candidate))
            });
        Box::new(std::iter::once(csv::row(COLUMNS)).chain(drives))
    });
    answer
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
            note(check),
            certainty.to_owned(),
            csv::known(drive.mass()),
            csv::known(judged.price()),
            judged.resistor.map_or_else(String::new, |r| r.key.clone()),
        ]
    });
    csv::rows(rows)
}
