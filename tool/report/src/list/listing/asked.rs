//! The drive requested by name, and the reason for its rank.

use jred_file::text::problem::Result;

use super::explained;
use super::full::kilowatts;
use crate::answer::Answer;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::rounding::short;
use jred_file::number::words::counted;
use jred_sizing::select::size::{Candidate, Selection};

/// A drive and its place.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'c> {
    /// The drive.
    pub candidate: Candidate<'c>,
    /// Its rank among the drives that fit, from 1; `None`: it is refused.
    pub rank: Option<usize>,
}

impl<'c> Asked<'c> {
    /// The drive of this name: see [`explained`].
    ///
    /// # Errors
    /// No drive of that name.
    pub fn named(selection: &Selection<'c>, name: &str) -> Result<Option<Self>> {
        let found = explained(selection, Some(name))?;
        Ok(found.map(|candidate| Self::of(selection, candidate)))
    }

    fn of(selection: &Selection<'c>, candidate: Candidate<'c>) -> Self {
        let rank = if candidate.outcome.fails() {
            None
        } else {
            let fit = selection.first_fit(usize::MAX);
            fit.iter().position(|c| c.is_same_drive(&candidate))
        };
        Self {
            candidate,
            rank: rank.map(|k| k + 1),
        }
    }

    /// Its name, the reason for its rank, and the best drive.
    pub(super) fn blocks(&self, answer: &mut Answer, selection: &Selection) {
        answer.sentence(format!("Requested drive: {}", self.candidate.drive.name()));
        match self.rank {
            None => answer.sentence(self.violated(selection)),
            Some(rank) => self.ranked(answer, rank, selection),
        }
        match selection.fit.first() {
            Some(best) if self.rank != Some(1) => {
                answer.sentence(format!("The best drive is {}", best.drive.name()));
            }
            Some(_) => {}
            None => answer.sentence("No drive satisfies every rule"),
        }
    }

    /// The rules that it violates.
    fn violated(&self, selection: &Selection) -> String {
        let judged = selection.judged(&self.candidate);
        let broken = (judged.checks.iter()).filter(|check| check.verdict == RuleVerdict::Fail);
        // The values are in the table of the drive's rules.
        let broken = broken.map(|check| match check.used() {
            used if used.is_empty() => format!("{} {}", check.rule, check.against()),
            used => format!("{} {used}", check.rule),
        });
        format!(
            "refused; use of the limits that it violates: {}",
            broken.collect::<Vec<_>>().join(", ")
        )
    }

    /// A comparison with the drives ranked above it.
    fn ranked(&self, answer: &mut Answer, rank: usize, selection: &Selection) {
        let all = selection.fit.len() + selection.refused.len();
        let words = self.candidate.drive.motor.kind.vocabulary();
        answer.sentence(format!(
            "violates no rule: rank {rank} of {} ({all} in total); ranked: {}",
            counted(selection.fit.len(), "suitable drive", "suitable drives"),
            selection.ranking(words)
        ));
        // Only the default ranking uses values that every drive has.
        if rank > 1 && selection.ranking.is_none() {
            let before = selection.first_fit(rank - 1);
            let last = before.get(1..).and_then(<[_]>::last);
            for (other, place) in before.first().into_iter().chain(last).zip([1, rank - 1]) {
                answer.sentence(format!("rank {place}: {}", figures(other)));
            }
            answer.sentence(format!("rank {rank}: {}", figures(&self.candidate)));
        }
    }
}

/// The values that the default ranking uses.
fn figures(candidate: &Candidate) -> String {
    let outcome = &candidate.outcome;
    let power = candidate.drive.motor.rated_power();
    let power = power.map_or_else(|| "rated power unknown".to_owned(), kilowatts);
    let warnings = match outcome.warnings {
        0 => "no warning".to_owned(),
        n => counted(n as usize, "warning", "warnings"),
    };
    let drive = &candidate.drive;
    let amplifier = drive.amplifier.map_or_else(String::new, |amplifier| {
        format!(", amplifier {} A", short(amplifier.rated_current))
    });
    let gearbox = drive.gearbox.map_or_else(String::new, |gearbox| {
        let size = gearbox.size();
        let size = size.map_or_else(
            || "no data".to_owned(),
            |size| format!("{} N m", short(size)),
        );
        format!(", gearbox {size}")
    });
    let mass = drive.mass();
    let mass = mass.map_or_else(String::new, |mass| format!(", {} kg", short(mass)));
    format!(
        "{}, {power}, {warnings}{amplifier}{gearbox}{mass}",
        drive.name()
    )
}
