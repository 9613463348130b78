//! Which files make a catalogue, and what each of them holds.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::cell::nearest;
use super::column::{Column, Kind};
use super::fault::{CatalogueError, Remarks, Text};
use super::mgdb;

/// The catalogue that comes with the tool, each row with its source.
const BUILT_IN: [(Kind, &str); 3] = [
    (Kind::Motors, include_str!("../../catalogue/motors.csv")),
    (
        Kind::Gearboxes,
        include_str!("../../catalogue/gearboxes.csv"),
    ),
    (
        Kind::Resistors,
        include_str!("../../catalogue/resistors.csv"),
    ),
];

/// The format of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Format {
    Csv(Kind),
    Toml,
    Database(Kind),
}

/// The built-in tables of some kinds.
pub(super) fn built_in(of: impl Fn(Kind) -> bool) -> Vec<(Format, Text)> {
    let tables = BUILT_IN.into_iter().filter(|(kind, _)| of(*kind));
    let text = |kind: Kind, text| Text::new(format!("built-in {}.csv", kind.plural()), text);
    tables
        .map(|(kind, table)| (Format::Csv(kind), text(kind, table)))
        .collect()
}

fn unreadable(path: &Path, reason: impl Into<String>, cure: &str) -> CatalogueError {
    CatalogueError::Unreadable {
        path: path.display().to_string(),
        reason: reason.into(),
        cure: cure.to_owned(),
    }
}

/// What the system says, in words of the task, and what to do about it.
fn cannot_read(path: &Path, error: &std::io::Error) -> CatalogueError {
    const CURE: &str = "check the path given with --catalogue, --motors or --gearboxes";
    match error.kind() {
        ErrorKind::NotFound => {
            let near = beside(path).map_or_else(String::new, |near| {
                format!("; did you mean {}?", near.display())
            });
            let cure = format!("{CURE}{near}");
            unreadable(path, "there is no such file or folder", &cure)
        }
        ErrorKind::PermissionDenied => unreadable(
            path,
            "it may not be read",
            "let this user read it, or name another one",
        ),
        ErrorKind::IsADirectory => unreadable(
            path,
            "it is a folder",
            "name folders with --catalogue, one CSV file with --motors or --gearboxes",
        ),
        _ => unreadable(path, error.to_string(), CURE),
    }
}

/// The file or folder at the same place whose name is most alike, if any is.
fn beside(path: &Path) -> Option<PathBuf> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let entries = std::fs::read_dir(folder.unwrap_or_else(|| Path::new("."))).ok()?;
    let names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let near = nearest(path.file_name()?.to_str()?, &names)?;
    Some(path.with_file_name(near))
}

pub(super) fn read(path: &Path) -> Result<Text, CatalogueError> {
    let bytes = std::fs::read(path).map_err(|error| cannot_read(path, &error))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let before = error.as_bytes().iter().take(valid);
        let line = before.filter(|b| **b == b'\n').count() + 1;
        unreadable(
            path,
            format!("it is not a text in UTF-8: line {line} has a byte that is not allowed there"),
            "save the sheet as CSV in UTF-8, and name that file with --catalogue, --motors or --gearboxes",
        )
    })?;
    Ok(Text::new(path.display().to_string(), text))
}

const fn database(kind: Kind) -> bool {
    matches!(kind, Kind::Motors | Kind::Gearboxes | Kind::Compatibility)
}

/// jred's own format, or that of the database.
pub(super) fn format_of(kind: Kind, text: &Text) -> Format {
    let own_list = || {
        let titles = text.text.trim_start_matches('\u{feff}').lines();
        let mut titles = titles.filter(|l| !(l.starts_with('#') || l.trim().is_empty()));
        let first = titles.next().unwrap_or_default();
        first
            .split([',', ';', '\t'])
            .any(|title| title.trim() == Column::ListedMotor.name())
    };
    let foreign = match kind {
        Kind::Compatibility => !own_list(),
        _ => database(kind) && mgdb::is_header(&text.text),
    };
    if foreign {
        Format::Database(kind)
    } else {
        Format::Csv(kind)
    }
}

/// What a file holds, by its name.
fn kind_of(path: &Path) -> Option<Kind> {
    let stem = path.file_stem()?.to_str()?.to_lowercase();
    let csv = path.extension()?.eq_ignore_ascii_case("csv");
    let named = |kind: &Kind| stem.ends_with(kind.plural());
    Kind::ALL.into_iter().find(named).filter(|_| csv)
}

fn is_toml(path: &Path) -> bool {
    path.extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

const NAMES: &str = "tables are files whose names end in motors.csv, gearboxes.csv, amplifiers.csv, resistors.csv or \
     compatibility.csv, or in .toml";

pub(super) fn file(path: &Path) -> Result<Vec<(Format, Text)>, CatalogueError> {
    let text = read(path)?;
    if is_toml(path) {
        return Ok(vec![(Format::Toml, text)]);
    }
    let kind = kind_of(path);
    let kind =
        kind.ok_or_else(|| unreadable(path, "its name does not say what it holds", NAMES))?;
    Ok(vec![(format_of(kind, &text), text)])
}

/// How many folders deep tables are looked for.
const DEPTH: usize = 4;

pub(super) fn folder(
    path: &Path,
    remarks: &mut Remarks,
) -> Result<Vec<(Format, Text)>, CatalogueError> {
    let mut found = Vec::new();
    search(path, DEPTH, &mut found, remarks)?;
    if found.is_empty() {
        return Err(unreadable(path, "there is no table in this folder", NAMES));
    }
    let mut files = Vec::new();
    for path in found {
        files.extend(file(&path)?);
    }
    Ok(files)
}

fn search(
    folder: &Path,
    depth: usize,
    found: &mut Vec<PathBuf>,
    remarks: &mut Remarks,
) -> Result<(), CatalogueError> {
    let failed = |error: std::io::Error| cannot_read(folder, &error);
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        paths.push(entry.map_err(failed)?.path());
    }
    paths.sort();
    for path in paths {
        if path.is_dir() {
            if depth > 0 {
                search(&path, depth - 1, found, remarks)?;
            }
        } else if is_toml(&path) || kind_of(&path).is_some() {
            found.push(path);
        } else if path
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("csv"))
        {
            remarks.add("CSV files that are not read", || {
                format!("{} is not read: {NAMES}", path.display())
            });
        }
    }
    Ok(())
}
