//! A problem with its places as the page counts them: lines and columns from 1, offsets in UTF-16 units.

use jred_file::text::problem::Problem;
use miette::{Diagnostic as _, LabeledSpan, SourceSpan};
use serde_json::{Value, json};

/// The problem; `name` and `text` are those of the machine file.
pub(crate) fn of(problem: &Problem, name: &str, text: &str) -> Value {
    let labels: Vec<LabeledSpan> = problem.labels().into_iter().flatten().collect();
    let mut file = None;
    let mut place = |label: &LabeledSpan| {
        let span = SourceSpan::from((label.offset(), label.len()));
        let contents = problem.source_code()?.read_span(&span, 0, 0).ok()?;
        let other = contents.name().filter(|other| *other != name);
        file = other.map(str::to_owned);
        let ends = [label.offset(), label.offset() + label.len()];
        let [from, to] = match other {
            None => ends.map(|at| utf16(text, at)),
            Some(_) => [0, 0],
        };
        Some(json!({
            "from": from,
            "to": to,
            "line": contents.line() + 1,
            "column": contents.column() + 1,
            "label": label.label().unwrap_or_default(),
        }))
    };
    let places: Vec<Value> = labels.iter().filter_map(&mut place).collect();
    json!({
        "message": problem.to_string(),
        "help": problem.cure().unwrap_or_default(),
        "places": places,
        "file": file,
    })
}

/// An offset in bytes as one in UTF-16 units.
pub(crate) fn utf16(text: &str, at: usize) -> usize {
    text.get(..at).unwrap_or(text).encode_utf16().count()
}

/// An offset in UTF-16 units as one in bytes.
pub(crate) fn bytes(text: &str, at: usize) -> usize {
    let mut units = 0;
    let place = text.char_indices().find(|(_, c)| {
        let here = units >= at;
        units += c.len_utf16();
        here
    });
    place.map_or(text.len(), |(at, _)| at)
}
