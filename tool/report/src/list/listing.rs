//! The answer of `jred size`: a selection of drives.

mod asked;
mod bill;
mod brief;
mod choice;
mod comma;
mod explanation;
mod full;
mod json;
mod remedy;

use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_sizing::judge::Assessment;
use jred_sizing::select::size::{Candidate, Selection};

use crate::answer::Answer;
use crate::list::suited::MotionChoice;
use crate::table::output::Format;
use crate::table::reading::{ColumnKind, Reading};
use jred_sizing::cell::Cell;

pub use asked::Asked;
pub(crate) use bill::bill;
pub(crate) use brief::order;
pub use choice::{List, explained};
pub use explanation::Explanation;
pub(crate) use explanation::{changes, contributions};
pub(crate) use full::rules;
pub(crate) use json::SizeData;

/// Number of rules on the first screen if no drive satisfies all.
const MOST_VIOLATED: usize = 2;

/// Width of the first screen in a pipe or a file.
const NARROW: usize = 80;

/// A selection of drives with everything that its answer contains.
#[derive(Clone, Copy, Debug)]
pub struct Listing<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// Its duty.
    pub duty: &'a Duty,
    /// The judged drives.
    pub selection: &'a Selection<'a>,
    /// Possible mistakes in the machine file.
    pub warnings: &'a [String],
    /// The motion that the drives are judged with, if it was computed for them.
    pub motion: Option<&'a MotionChoice>,
    /// The drive requested by name.
    pub asked: Option<&'a Asked<'a>>,
    /// Contributions and changes.
    pub explanation: Option<&'a Explanation>,
    /// Its extent.
    pub list: List,
}

impl<'a> Listing<'a> {
    /// The answer in one format; the others would judge all listed drives once more.
    pub fn answer(self, format: Format) -> Answer<'a> {
        let title = &self.file.title;
        let mut answer = match format {
            Format::Json => json::answer(self),
            Format::Table => Answer::words(title),
            Format::Csv => comma::answer(self),
        };
        if format == Format::Table
            && let Some(shown) = self.shown()
        {
            self.read(&mut answer, &shown);
        }
        answer
    }

    /// The whole answer for reading, with the values of its CSV.
    pub fn answer_with_values(self) -> Answer<'a> {
        let mut answer = comma::answer(self);
        let list = List {
            full: true,
            ..self.list
        };
        if let Some(shown) = self.shown() {
            Self { list, ..self }.read(&mut answer, &shown);
        }
        answer
    }

    /// The requested drive, the best one, or the closest one if none is suitable.
    pub fn shown(&self) -> Option<Candidate<'a>> {
        let first = self
            .selection
            .fit
            .first()
            .or(self.selection.refused.first());
        self.asked.map(|asked| asked.candidate).or(first.copied())
    }

    /// Number of drives.
    pub(crate) fn count(&self) -> usize {
        self.selection.fit.len() + self.selection.refused.len()
    }

    /// The blocks for reading.
    fn read(&self, answer: &mut Answer, shown: &Candidate<'a>) {
        let (list, selection) = (self.list, self.selection);
        let judged = &selection.judged(shown);
        let fits = !selection.fit.is_empty();
        self.first(answer, judged);
        match self.asked {
            Some(asked) => asked.blocks(answer, selection),
            None => self.others(answer, if list.full { usize::MAX } else { MOST_VIOLATED }),
        }
        if let Some(motion) = self.motion {
            motion.blocks(answer);
        }
        if list.full {
            answer.heading(full::supply(&self.file.site));
            answer.heading("Bill of materials");
            bill(answer, judged);
            self.duty(answer, judged);
            answer.heading("Rules");
            rules(answer, judged);
        }
        let is_whole = list.full && self.asked.is_none() && fits;
        if is_whole {
            self.certainties(answer);
        }
        if is_whole || list.is_ranked && fits {
            self.ranking(answer, judged, false);
        }
        if is_whole {
            self.gaps(answer, judged);
            self.smaller(answer);
        }
        if let Some(explanation) = self.explanation {
            explanation.blocks(answer, self.duty.duration);
        }
        if list.refused || list.all {
            answer.heading("Refused");
            self.refused(answer);
        }
        if self.count() > 1 {
            self.further(answer);
        }
        if !(list.full || list.is_ranked || list.refused || list.explained) {
            answer.narrow(NARROW);
        }
    }

    /// The best drive of a machine with all that belongs to it, for a page.
    pub(crate) fn first(&self, answer: &mut Answer, judged: &Assessment) {
        brief::drive(answer, self.file, judged);
        brief::limits(answer, judged);
        for warning in self.warnings {
            answer.warning(warning);
        }
    }
}

/// A table of texts; all columns but the last `wrapped` ones are not wrapped.
pub(crate) fn table<const N: usize>(
    header: [(&str, ColumnKind); N],
    rows: impl Iterator<Item = [String; N]>,
    wrapped: usize,
) -> Reading {
    Reading {
        columns: header.map(|(name, _)| name.to_owned()).to_vec(),
        kinds: header.map(|(_, kind)| kind).to_vec(),
        rows: rows.map(|row| row.map(Cell::Text).to_vec()).collect(),
        whole: N - wrapped,
        last: 75,
    }
}
