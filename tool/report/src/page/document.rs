//! The title block and the inputs of a document.

use crate::answer::Answer;
use crate::list::listing::table;
use crate::list::source::{Source, machine_digest};
use crate::table::reading::ColumnKind::Words;
use jred_file::model::machine::MachineFile;
use jred_file::text::entries::{Entry, entries};
use jred_sizing::study::header::digest;

use super::section::Section;

/// The title block: entries of `[document]`, date, versions and digests.
pub(super) fn title(answer: &mut Answer, source: &Source, file: &MachineFile) {
    let parts = source.parts;
    let mut rows: Vec<[String; 2]> = Vec::new();
    let mut add = |name: &str, text: String| rows.push([name.to_owned(), text]);
    for (name, text) in file.document.entries() {
        add(name, text.to_owned());
    }
    if file.document.date.is_empty() {
        add("date", source.date.to_owned());
    }
    add(
        "machine file",
        format!("{}, digest {}", source.name, machine_digest(source, file)),
    );
    add(
        "catalogue",
        format!(
            "{} motors, {} gearboxes, {} amplifiers, {} resistors that can drive this machine, digest {}",
            parts.motors.len(),
            parts.gearboxes.len(),
            parts.amplifiers.len(),
            parts.resistors.len(),
            digest(parts)
        ),
    );
    add(
        "computed with",
        format!("jred {}", env!("CARGO_PKG_VERSION")),
    );
    answer.table(table(
        [("document", Words), ("", Words)],
        rows.into_iter(),
        1,
    ));
}

/// The machine file as the user wrote it.
pub(super) fn inputs(source: &Source) -> Section {
    // The file was read before.
    let entries = entries(source.text).unwrap_or_default();
    let row = |entry: Entry| [entry.path, entry.value, entry.remark];
    let header = [("entry", Words), ("value", Words), ("remark", Words)];
    let mut answer = Answer::words("");
    answer.table(table(header, entries.into_iter().map(row), 2));
    // As written, whatever the units of results.
    Section {
        blocks: answer.blocks,
        ..Section::new("Inputs, as in the machine file", Vec::new())
    }
}
