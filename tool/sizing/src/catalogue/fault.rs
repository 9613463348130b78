//! Faults of a catalogue and their messages: all broken rows are found in one pass, and the first few are shown with their positions.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Arc;

use jred_file::text::problem::Problem;
use miette::Diagnostic;
use thiserror::Error;

/// Number of broken rows shown with their positions; the others are counted.
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
        /// Message.
        reason: String,
        /// Cure.
        cure: String,
    },
    /// One place is wrong.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Wrong(Problem),
    /// Several places are wrong.
    #[error("{0}")]
    #[diagnostic(transparent)]
    Several(Box<BrokenRows>),
    /// The same file given twice.
    #[error("the catalogue {path} is given twice{}", if path == before { String::new() } else { format!(", the first time as {before}") })]
    #[diagnostic(help("name every folder and every file once"))]
    Twice {
        /// Path of the file or folder.
        path: String,
        /// Its path the first time.
        before: String,
    },
    /// Prices that cannot be compared.
    #[error("prices in {first} cannot be compared with prices in {second}")]
    #[diagnostic(help(
        "give all prices in one currency, named in the header as price [EUR], in TOML as price = \"300 EUR\"; the catalogue can be used as it is \
         without --rank price, --max-price and the objective price"
    ))]
    Currencies {
        /// A currency and the file that has it.
        first: String,
        /// Another currency and the file that has it.
        second: String,
    },
    /// The catalogue has no rows.
    #[error("the catalogue {0} is empty: it contains no {1}")]
    #[diagnostic(help("{2}"))]
    Empty(String, &'static str, &'static str),
    /// The catalogue has only broken motors, which were skipped.
    #[error("the catalogue {0} has no motor left: {1} broken and skipped")]
    #[diagnostic(help(
        "leave out --skip-broken-rows to see what is wrong with each, and correct at least one motor"
    ))]
    Skipped(String, String),
}

/// Several broken rows.
#[derive(Debug, Error, Diagnostic)]
#[error("{}", self.words())]
#[diagnostic(help("correct them, or skip them with --skip-broken-rows"))]
pub struct BrokenRows {
    /// Number of broken rows.
    pub rows: usize,
    /// Number of their faults.
    pub faults: usize,
    /// The first of the faults.
    #[related]
    pub shown: Vec<Problem>,
}

impl BrokenRows {
    fn words(&self) -> String {
        let mut words = match self.rows {
            1 => "1 row of the catalogue cannot be used".to_owned(),
            rows => format!("{rows} rows of the catalogue cannot be used"),
        };
        if self.faults > self.rows {
            let _ = write!(words, ", for {} faults", self.faults);
        }
        if self.faults > self.shown.len() {
            let _ = write!(words, "; the first {} are shown", self.shown.len());
        }
        words
    }
}

/// A catalogue file: its name for messages and its text.
#[derive(Clone, Debug)]
#[expect(clippy::struct_field_names, reason = "a file has a name and a text")]
pub(super) struct Text {
    pub(super) name: String,
    pub(super) text: Arc<String>,
    /// Identifies the file, whatever its name.
    pub(super) place: PathBuf,
}

impl Text {
    pub(super) fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        let name = name.into();
        Self {
            place: PathBuf::from(&name),
            name,
            text: Arc::new(text.into()),
        }
    }

    /// With its canonical path.
    #[cfg(feature = "fs")]
    pub(super) fn at(self, place: PathBuf) -> Self {
        Self { place, ..self }
    }

    /// The fault at its position in this text.
    pub(super) fn shows(&self, problem: Problem) -> Problem {
        problem.in_file(&self.name, &self.text)
    }
}

/// Faults of rows: the first ones in full, the rest counted.
#[derive(Debug, Default)]
pub(super) struct Faults {
    rows: usize,
    count: usize,
    shown: Vec<Problem>,
}

impl Faults {
    /// A row with one fault.
    pub(super) fn add(&mut self, text: &Text, fault: Problem) {
        self.add_row(text, [fault]);
    }

    /// A row with all its faults.
    pub(super) fn add_row(&mut self, text: &Text, faults: impl IntoIterator<Item = Problem>) {
        self.rows += 1;
        for fault in faults {
            self.count += 1;
            if self.shown.len() < SHOWN {
                self.shown.push(text.shows(fault));
            }
        }
    }

    /// Number of broken rows.
    pub(super) const fn rows(&self) -> usize {
        self.rows
    }

    /// `Ok` if there are no faults.
    pub(super) fn into_result(mut self) -> Result<(), CatalogueError> {
        match self.shown.pop() {
            None => Ok(()),
            Some(only) if self.count == 1 => Err(CatalogueError::Wrong(only)),
            Some(last) => {
                self.shown.push(last);
                Err(CatalogueError::Several(Box::new(BrokenRows {
                    rows: self.rows,
                    faults: self.count,
                    shown: self.shown,
                })))
            }
        }
    }
}

/// Warnings about rows that are used, collected by kind: the first few with their positions, the others counted.
#[derive(Debug, Default)]
pub(super) struct Remarks {
    kinds: Vec<(&'static str, Vec<String>, usize)>,
}

/// Number of warnings shown per kind.
const REMARKS_SHOWN: usize = 3;

impl Remarks {
    /// Adds a warning; `kind` is its subject in the plural: "motors whose …".
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
