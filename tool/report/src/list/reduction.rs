//! The machine reduced to its drive link: rows over the position or the time.

use std::borrow::Cow;

use schemars::JsonSchema;
use serde::Serialize;

use crate::answer::Answer;
use crate::answer::schema::Data;
use crate::list::inspection::change_points;
use jred_analysis::reduce::{Largest, Sets};
use jred_file::model::machine::MachineFile;
use jred_file::number::columns::Columns;

/// The rows, and remarks about them.
#[derive(Debug)]
pub struct ReductionView<'a> {
    /// The machine.
    pub file: &'a MachineFile,
    /// The sets of columns.
    pub sets: Sets,
    /// The rows.
    pub columns: &'a Columns,
    /// The largest forces.
    pub largest: &'a [Largest],
    /// Whether the motion passes every position exactly once.
    pub passed: bool,
    /// Whether the rows are at positions of the command line.
    pub is_at_positions: bool,
    /// Loads, payloads and carriages that follow the motion; rows without the motion do not contain them.
    pub not_contained: &'a [String],
}

/// The JSON of `jred reduce`.
#[derive(Serialize, JsonSchema)]
pub(crate) struct ReductionData<'a> {
    /// Remarks about the rows.
    notes: &'a [String],
    /// The largest forces, with `--reactions`.
    largest: &'a [Largest],
}

impl Data for ReductionData<'_> {
    const FORM: &'static str = "jred-reduce/1";
    const HAS_COURSE: bool = true;
}

impl<'a> ReductionView<'a> {
    /// The largest forces, remarks, and the rows.
    pub fn answer(&self) -> Answer<'a> {
        let notes = self.notes();
        let title = if self.sets.curves {
            format!(
                "{}: reduced to the drive link, flywheel and drive train included",
                self.file.title
            )
        } else {
            self.file.title.clone()
        };
        let data = ReductionData {
            notes: &notes,
            largest: self.largest,
        };
        let mut answer = Answer::new(title, &data);
        for largest in self.largest {
            answer.fact("largest", largest.sentence());
        }
        for note in notes {
            answer.sentence(note);
        }
        answer.course(Cow::Borrowed(self.columns));
        answer
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.sets.reactions {
            notes.push("force of a joint: acts from the first on the second body listed by `jred check`; flywheel and drive train turn with the drive link".to_owned());
            let mechanism = self.file.machine.mechanism();
            let points = mechanism.change_points();
            notes.extend(change_points(points, mechanism.coordinate()));
        }
        if !self.passed {
            let cure = if self.is_at_positions {
                "give speeds with the positions"
            } else {
                "use --over time"
            };
            notes.push(format!(
                "the motion does not pass every position exactly once: {cure}"
            ));
        }
        if !self.not_contained.is_empty() {
            notes.push(not_contained(self.not_contained));
        }
        notes
    }
}

/// Sentence about the parts that rows without the motion do not contain.
pub fn not_contained(parts: &[String]) -> String {
    format!(
        "not contained without the motion: {}; use --over time",
        parts.join("; ")
    )
}
