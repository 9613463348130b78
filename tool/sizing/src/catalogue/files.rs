//! The files of a catalogue, and the content of each.

use std::path::Path;

use jred_file::plain;
use jred_file::text::csv;

use super::column::{Column, Kind};
use super::fault::{CatalogueError, Text};
use super::mgdb;

/// The built-in catalogue, each row with its source.
const BUILT_IN: [(Kind, &str); 5] = [
    (Kind::Motors, include_str!("../../catalogue/motors.csv")),
    (
        Kind::Gearboxes,
        include_str!("../../catalogue/gearboxes.csv"),
    ),
    (
        Kind::Amplifiers,
        include_str!("../../catalogue/amplifiers.csv"),
    ),
    (
        Kind::Resistors,
        include_str!("../../catalogue/resistors.csv"),
    ),
    (
        Kind::Compatibility,
        include_str!("../../catalogue/compatibility.csv"),
    ),
];

/// The format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum FileFormat {
    Csv(Kind),
    Toml,
    Database(Kind),
}

/// The built-in tables of some kinds.
pub(super) fn built_in(of: impl Fn(Kind) -> bool) -> Vec<(FileFormat, Text)> {
    let tables = BUILT_IN.into_iter().filter(|(kind, _)| of(*kind));
    let text = |kind: Kind, text| Text::new(format!("built-in {}.csv", kind.plural()), text);
    tables
        .map(|(kind, table)| (FileFormat::Csv(kind), text(kind, table)))
        .collect()
}

pub(super) fn unreadable(path: &Path, reason: impl Into<String>, cure: &str) -> CatalogueError {
    CatalogueError::Unreadable {
        path: plain::path(path),
        reason: reason.into(),
        cure: cure.to_owned(),
    }
}

const fn database(kind: Kind) -> bool {
    matches!(kind, Kind::Motors | Kind::Gearboxes | Kind::Compatibility)
}

/// jred's own format, or the format of the database.
pub(super) fn format_of(kind: Kind, text: &Text) -> FileFormat {
    let own_list = || {
        csv::header_of(&text.text)
            .split([',', ';', '\t'])
            .any(|title| title.trim() == Column::ListedMotor.name())
    };
    let foreign = match kind {
        Kind::Compatibility => !own_list(),
        _ => database(kind) && mgdb::is_header(&text.text),
    };
    if foreign {
        FileFormat::Database(kind)
    } else {
        FileFormat::Csv(kind)
    }
}

/// Content of a file, from its name.
pub(super) fn kind_of(path: &Path) -> Option<Kind> {
    let stem = path.file_stem()?.to_str()?.to_lowercase();
    let csv = path.extension()?.eq_ignore_ascii_case("csv");
    let named = |kind: &Kind| stem.ends_with(kind.plural());
    Kind::ALL.into_iter().find(named).filter(|_| csv)
}

pub(super) fn is_toml(path: &Path) -> bool {
    path.extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

pub(super) const NAMES: &str = "file names of tables end in motors.csv, gearboxes.csv, amplifiers.csv, resistors.csv \
     or compatibility.csv, or in .toml";

/// Format of a text, from its name.
pub(super) fn formatted(text: Text) -> Result<(FileFormat, Text), CatalogueError> {
    let path = Path::new(&text.name);
    if is_toml(path) {
        return Ok((FileFormat::Toml, text));
    }
    let kind = kind_of(path);
    let kind =
        kind.ok_or_else(|| unreadable(path, "its name does not say what it contains", NAMES))?;
    Ok((format_of(kind, &text), text))
}
