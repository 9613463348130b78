//! What can be wrong with a catalogue, and how it is shown: all broken rows in one pass, the first few with their places.

use std::ops::Range;
use std::sync::Arc;

use miette::{Diagnostic, NamedSource, SourceSpan};
use thiserror::Error;

/// How many broken rows are shown with their places; the rest are counted.
pub const SHOWN: usize = 10;

/// A catalogue that cannot be used.
#[derive(Debug, Error, Diagnostic)]
pub enum CatalogueError {
    /// A file or folder cannot be read.
    #[error("cannot read the catalogue {path}: {reason}")]
    #[diagnostic(help("{cure}"))]
    Unreadable {
        /// Path of the file.
        path: String,
        /// What is wrong with it.
        reason: String,
        /// What to do.
        cure: String,
    },
    /// One place is wrong.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Wrong(Box<Misplaced>),
    /// Several places are wrong.
    #[error("{0}")]
    #[diagnostic(transparent)]
    Several(Box<Several>),
    /// No row at all.
    #[error("the catalogue {0} is empty: it holds no {1}")]
    #[diagnostic(help(
        "add at least one row below the header; docs/catalogue.md shows the columns"
    ))]
    Empty(String, &'static str),
}

/// Several broken rows.
#[derive(Debug, Error, Diagnostic)]
#[error("{count} rows of the catalogue cannot be used{}", if *.count > .shown.len() { format!("; the first {} are shown", .shown.len()) } else { String::new() })]
#[diagnostic(help("correct them, or use the other rows with --skip-broken-rows"))]
pub struct Several {
    /// How many there are.
    pub count: usize,
    /// The first of them.
    #[related]
    pub shown: Vec<Misplaced>,
}

/// What is wrong at a place of a catalogue file.
#[derive(Debug, Error, Diagnostic)]
#[error("{message}")]
pub struct Misplaced {
    message: String,
    #[source_code]
    file: NamedSource<Arc<String>>,
    #[label("{label}")]
    place: SourceSpan,
    label: String,
    #[help]
    help: String,
}

/// A catalogue file: its name for messages and its text.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) name: String,
    pub(super) text: Arc<String>,
}

impl Text {
    pub(super) fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            text: Arc::new(text.into()),
        }
    }

    /// The fault at its place in this text.
    pub(super) fn misplaced(&self, fault: Fault) -> Misplaced {
        Misplaced {
            message: fault.message,
            file: NamedSource::new(&self.name, Arc::clone(&self.text)),
            place: (fault.at.start, fault.at.len()).into(),
            label: fault.label.to_owned(),
            help: fault.help,
        }
    }
}

/// What is wrong, where in its text, and what to do about it.
#[derive(Clone, Debug)]
pub(super) struct Fault {
    pub(super) message: String,
    pub(super) at: Range<usize>,
    pub(super) label: &'static str,
    pub(super) help: String,
    /// Whether it is the same for every row of the file, as that of a column that is missing.
    pub(super) whole_file: bool,
}

impl Fault {
    pub(super) fn new(
        message: impl Into<String>,
        at: Range<usize>,
        label: &'static str,
        help: impl Into<String>,
    ) -> Self {
        Self {
            message: message.into(),
            at,
            label,
            help: help.into(),
            whole_file: false,
        }
    }

    /// The same for every row.
    pub(super) const fn of_whole_file(mut self) -> Self {
        self.whole_file = true;
        self
    }
}

/// The faults of rows: the first of them in full, the rest counted.
#[derive(Debug, Default)]
pub(super) struct Faults {
    count: usize,
    shown: Vec<Misplaced>,
}

impl Faults {
    pub(super) fn add(&mut self, text: &Text, fault: Fault) {
        self.count += 1;
        if self.shown.len() < SHOWN {
            self.shown.push(text.misplaced(fault));
        }
    }

    pub(super) const fn count(&self) -> usize {
        self.count
    }

    /// Fine if there are none.
    pub(super) fn into_result(mut self) -> Result<(), CatalogueError> {
        match self.shown.pop() {
            None => Ok(()),
            Some(only) if self.count == 1 => Err(CatalogueError::Wrong(Box::new(only))),
            Some(last) => {
                self.shown.push(last);
                Err(CatalogueError::Several(Box::new(Several {
                    count: self.count,
                    shown: self.shown,
                })))
            }
        }
    }
}

/// Remarks about rows that are used all the same, gathered by kind: the first few with their places, the rest counted.
#[derive(Debug, Default)]
pub(super) struct Remarks {
    kinds: Vec<(&'static str, Vec<String>, usize)>,
}

/// How many remarks of a kind are written out.
const REMARKS_SHOWN: usize = 3;

impl Remarks {
    /// `kind` says what is remarkable, in the plural: "motors whose …".
    pub(super) fn add(&mut self, kind: &'static str, remark: impl FnOnce() -> String) {
        let index = self.kinds.iter().position(|known| known.0 == kind);
        let index = index.unwrap_or_else(|| {
            self.kinds.push((kind, Vec::new(), 0));
            self.kinds.len() - 1
        });
        if let Some((_, shown, more)) = self.kinds.get_mut(index) {
            if shown.len() < REMARKS_SHOWN {
                shown.push(remark());
            } else {
                *more += 1;
            }
        }
    }

    pub(super) fn into_lines(self) -> Vec<String> {
        let mut lines = Vec::new();
        for (kind, shown, more) in self.kinds {
            lines.extend(shown);
            if more > 0 {
                lines.push(format!("and {more} more {kind}"));
            }
        }
        lines
    }
}
