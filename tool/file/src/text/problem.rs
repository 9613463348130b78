//! One fault of a text: message, places and cure.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use miette::{Diagnostic, LabeledSpan, NamedSource};
use thiserror::Error;

use crate::plain;

/// Result of reading a part of a text.
pub type Result<T, E = Problem> = std::result::Result<T, E>;

/// A fault at places in a text; the text is attached last.
#[derive(Debug, Error, Diagnostic)]
#[error(transparent)]
#[diagnostic(transparent)]
pub struct Problem(Box<Parts>);

#[derive(Debug, Error, Diagnostic)]
#[error("{message}")]
struct Parts {
    message: String,
    #[label(collection)]
    places: Vec<LabeledSpan>,
    #[help]
    help: Option<String>,
    #[source_code]
    file: Option<NamedSource<Arc<String>>>,
}

impl Problem {
    /// A problem described by one sentence.
    pub fn new(message: impl Into<String>) -> Self {
        Self(Box::new(Parts {
            message: message.into(),
            places: Vec::new(),
            help: None,
            file: None,
        }))
    }

    /// The problem of an error of the core, with its cure.
    pub fn of(error: impl Into<jred::error::Error>) -> Self {
        let error = error.into();
        Self::new(error.to_string()).help(error.cure().to_string())
    }

    /// Marks a place in the text.
    #[must_use]
    pub fn at(mut self, span: Range<usize>, label: impl Into<String>) -> Self {
        self.0.places.push(LabeledSpan::at(span, label));
        self
    }

    /// Adds the cure; an empty one is left out.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into()).filter(|help| !help.is_empty());
        self
    }

    /// Attaches the text of the places, called `name`, unless a text is attached already.
    #[must_use]
    pub fn in_file(mut self, name: &str, text: &Arc<String>) -> Self {
        if self.0.file.is_none() {
            self.0.point(name, text);
            let text = match plain::masked(text) {
                Cow::Borrowed(_) if text.lines().all(|line| line.len() <= MAX_LINE) => {
                    Arc::clone(text)
                }
                masked => Arc::new(self.0.narrow(&masked)),
            };
            self.0.file = Some(NamedSource::new(name, text));
        }
        self
    }

    /// The same with the text of its places.
    #[must_use]
    pub fn in_text(self, name: &str, text: &str) -> Self {
        self.in_file(name, &Arc::new(text.to_owned()))
    }

    /// How to mend it.
    pub fn cure(&self) -> Option<&str> {
        self.0.help.as_deref()
    }
}

/// A [`Problem`] of a formatted message: `problem!(help = "the cure", "{name} is wrong")`.
#[macro_export]
macro_rules! problem {
    (help = $help:expr, $($message:tt)*) => {
        $crate::text::problem::Problem::new(format!($($message)*)).help($help)
    };
    ($($message:tt)*) => {
        $crate::text::problem::Problem::new(format!($($message)*))
    };
}

/// Longest line that is shown; a place in a longer line is given by file and line number.
const MAX_LINE: usize = 400;

/// The last character boundary at or before `at`.
fn boundary(text: &str, at: usize) -> usize {
    let mut upto = (0..=at).rev();
    upto.find(|&at| text.is_char_boundary(at)).unwrap_or(0)
}

impl Parts {
    /// Moves the labels to visible places in `text`.
    fn point(&mut self, name: &str, text: &str) {
        // The end of the text has no line of its own: its label moves to the last character.
        let last = text
            .trim_end()
            .char_indices()
            .last()
            .map_or(0, |(at, _)| at);
        for label in std::mem::take(&mut self.places) {
            let start = boundary(text, label.offset().min(last));
            let end = boundary(text, (label.offset() + label.len()).min(text.len()));
            let before = text.get(..start).unwrap_or_default();
            let line_start = before.rfind('\n').map_or(0, |at| at + 1);
            let line = text.get(line_start..).and_then(|rest| rest.lines().next());
            match line.map_or(0, str::len) {
                0 if text.is_empty() => {}
                length if length > MAX_LINE => {
                    let number = before.matches('\n').count() + 1;
                    self.message = format!("{name}:{number}: {}", self.message);
                }
                _ => self.places.push(LabeledSpan::new(
                    label.label().map(ToOwned::to_owned),
                    start,
                    end.saturating_sub(start),
                )),
            }
        }
    }
}

impl Parts {
    /// The text with long lines cut, which may be near those of the labels; the labels move with their lines.
    fn narrow(&mut self, text: &str) -> String {
        let (mut narrow, mut read) = (String::with_capacity(text.len()), 0);
        for line in text.split_inclusive('\n') {
            for label in &mut self.places {
                if (read..read + line.len()).contains(&label.offset()) {
                    let start = narrow.len() + label.offset() - read;
                    let name = label.label().map(ToOwned::to_owned);
                    *label = LabeledSpan::new(name, start, label.len());
                }
            }
            read += line.len();
            // The text only becomes shorter, so a moved label is not moved again.
            if line.len() > MAX_LINE + "…\n".len() {
                narrow += line.get(..boundary(line, MAX_LINE)).unwrap_or_default();
                narrow += "…\n";
            } else {
                narrow += line;
            }
        }
        narrow
    }
}

/// `"a", "b", "c"`
pub fn quoted<S: AsRef<str>>(words: &[S]) -> String {
    let quoted: Vec<String> = words
        .iter()
        .map(|w| format!("\"{}\"", w.as_ref()))
        .collect();
    quoted.join(", ")
}
