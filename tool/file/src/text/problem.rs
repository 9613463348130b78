//! One fault of a text: message, places and cure.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use miette::{
    Diagnostic, LabeledSpan, MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents,
};
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
    file: Option<Excerpt>,
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
            self.0.point(text);
            let text = match plain::masked(text) {
                Cow::Borrowed(_) => Arc::clone(text),
                Cow::Owned(masked) => Arc::new(masked),
            };
            let name = name.to_owned();
            self.0.file = Some(Excerpt { name, text });
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

/// Longest line that is shown as a whole (bytes).
const MAX_LINE: usize = 120;

/// Shown of a longer line on both sides of the place (bytes).
const AROUND: usize = 30;

/// A text of which messages show the lines around a place, or a part of a long line.
#[derive(Debug)]
struct Excerpt {
    name: String,
    text: Arc<String>,
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let text = self.text.as_str();
        let all = text.read_span(span, before, after)?;
        let from = text.get(..span.offset()).unwrap_or_default();
        let line = from.rfind('\n').map_or(0, |at| at + 1);
        let rest = text.get(line..).unwrap_or_default();
        let end = line + rest.find('\n').unwrap_or(rest.len());
        let last = span.offset() + span.len();
        let shown = std::str::from_utf8(all.data()).unwrap_or_default();
        let is_short = shown.lines().all(|line| line.len() <= MAX_LINE);
        let name = self.name.clone();
        // Without lines around it, the place itself is asked for.
        if is_short || last > end || before + after == 0 {
            let (at, column) = (*all.span(), all.column());
            let (data, first, count) = (all.data(), all.line(), all.line_count());
            let contents = MietteSpanContents::new_named(name, data, at, first, column, count);
            return Ok(Box::new(contents));
        }
        let around = if end - line > MAX_LINE {
            AROUND
        } else {
            MAX_LINE
        };
        let start = boundary(text, span.offset().saturating_sub(around)).max(line);
        let end = boundary(text, last + around).min(end);
        let data = text.get(start..end).unwrap_or_default().as_bytes();
        let number = from.matches('\n').count();
        let at = SourceSpan::from(start..end);
        let contents = MietteSpanContents::new_named(name, data, at, number, start - line, 1);
        Ok(Box::new(contents))
    }
}

/// The last character boundary at or before `at`.
fn boundary(text: &str, at: usize) -> usize {
    let mut upto = (0..=at.min(text.len())).rev();
    upto.find(|&at| text.is_char_boundary(at)).unwrap_or(0)
}

impl Parts {
    /// Moves the labels to visible places in `text`.
    fn point(&mut self, text: &str) {
        // The end of the text has no line of its own: its label moves to the last character.
        let last = text
            .trim_end()
            .char_indices()
            .last()
            .map_or(0, |(at, _)| at);
        for label in std::mem::take(&mut self.places) {
            let start = boundary(text, label.offset().min(last));
            // Of a very long value the beginning is marked.
            let end = label.offset() + label.len().min(MAX_LINE);
            let end = boundary(text, end.min(text.len()));
            if !text.is_empty() {
                self.places.push(LabeledSpan::new(
                    label.label().map(ToOwned::to_owned),
                    start,
                    end.saturating_sub(start),
                ));
            }
        }
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
