//! One fault of a machine file: message, place and cure.

use std::ops::Range;

use miette::{LabeledSpan, MietteDiagnostic, NamedSource, Report};

/// Result of reading a part of the file.
pub(crate) type Result<T> = std::result::Result<T, Problem>;

/// A diagnostic that is not yet attached to its text.
pub(crate) struct Problem(Box<Parts>);

struct Parts {
    diagnostic: MietteDiagnostic,
    /// The text shown, if it is not the machine file's.
    source: Option<NamedSource<String>>,
}

impl Problem {
    /// A problem described by one sentence.
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self(Box::new(Parts {
            diagnostic: MietteDiagnostic::new(message),
            source: None,
        }))
    }

    /// Marks a place in the text.
    pub(crate) fn at(mut self, span: Range<usize>, label: impl Into<String>) -> Self {
        let labels = self.0.diagnostic.labels.get_or_insert_default();
        labels.push(LabeledSpan::at(span, label));
        self
    }

    /// Adds the cure.
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.0.diagnostic.help = Some(help.into());
        self
    }

    /// The places are in this text instead of the machine file.
    pub(crate) fn in_file(mut self, name: &str, text: &str) -> Self {
        self.0.source = Some(NamedSource::new(name, text.to_owned()));
        self
    }

    /// A report that shows the places in the machine file `text`.
    pub(crate) fn into_report(self, name: &str, text: &str) -> Report {
        let Parts {
            mut diagnostic,
            source,
        } = *self.0;
        let source = source.unwrap_or_else(|| NamedSource::new(name, text.to_owned()));
        point(&mut diagnostic, source.inner());
        Report::new(diagnostic).with_source_code(source)
    }
}

/// The longest line that is shown; longer ones are named by number.
const MAX_LINE: usize = 400;

/// The last character boundary up to `at`.
fn boundary(text: &str, at: usize) -> usize {
    let mut upto = (0..=at).rev();
    upto.find(|&at| text.is_char_boundary(at)).unwrap_or(0)
}

/// Moves the diagnostic's labels to where they can be seen in `text`.
fn point(diagnostic: &mut MietteDiagnostic, text: &str) {
    let Some(labels) = diagnostic.labels.take() else {
        return;
    };
    // The end of the text has no line of its own: the last character stands for it.
    let last = text
        .trim_end()
        .char_indices()
        .last()
        .map_or(0, |(at, _)| at);
    let mut shown = Vec::new();
    for label in labels {
        let start = boundary(text, label.offset().min(last));
        let end = boundary(text, (label.offset() + label.len()).min(text.len()));
        let before = text.get(..start).unwrap_or_default();
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let line = text.get(line_start..).and_then(|rest| rest.lines().next());
        let number = before.matches('\n').count() + 1;
        match line.map_or(0, str::len) {
            0 if text.is_empty() => {}
            length if length > MAX_LINE => {
                diagnostic.message = format!("line {number}: {}", diagnostic.message);
            }
            _ => shown.push(LabeledSpan::new(
                label.label().map(ToOwned::to_owned),
                start,
                end.saturating_sub(start),
            )),
        }
    }
    diagnostic.labels = Some(shown);
}

/// `"a", "b", "c"`
pub(crate) fn quoted<S: AsRef<str>>(words: &[S]) -> String {
    let quoted: Vec<String> = words
        .iter()
        .map(|w| format!("\"{}\"", w.as_ref()))
        .collect();
    quoted.join(", ")
}
