//! Catalogues on a disk: folders and files.

use std::collections::HashMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use jred_file::plain;
use jred_file::text::disk;
use jred_file::text::file::LARGE;
use jred_file::units::closest;

use super::Catalogue;
use super::column::Kind;
use super::fault::{CatalogueError, Remarks, Text};
use super::files::{
    FileFormat, NAMES, built_in, format_of, formatted, is_toml, kind_of, unreadable,
};
use super::load::{Loader, twice};

/// The largest file of a catalogue (bytes): some hundred thousand rows.
const MAX_SIZE: u64 = 64 << 20;

/// The largest folder (bytes), with all its tables.
const MAX_FOLDER: u64 = 64 << 20;

/// Sources of a catalogue.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    /// Folders or files, each a catalogue of its own.
    pub catalogues: Vec<PathBuf>,
    /// A file of motors.
    pub motors: Option<PathBuf>,
    /// A file of gearboxes.
    pub gearboxes: Option<PathBuf>,
    /// Whether broken rows are skipped instead of refusing the catalogue.
    pub skip_broken_rows: bool,
}

impl Sources {
    /// Reads everything.
    pub(super) fn load(&self) -> Result<Catalogue, CatalogueError> {
        self.given_once()?;
        let mut remarks = Remarks::default();
        let mut groups = Vec::new();
        let single = |path: &PathBuf, kind| {
            let text = read(path)?;
            Ok(vec![(format_of(kind, &text), text)])
        };
        // A file of motors is combined with the built-in gearboxes, and vice versa.
        let halves = [
            (&self.motors, Kind::Motors),
            (&self.gearboxes, Kind::Gearboxes),
        ];
        for (path, kind) in halves {
            match path {
                Some(path) => groups.push(single(path, kind)?),
                None if self.catalogues.is_empty() => groups.push(built_in(|k| k == kind)),
                None => {}
            }
        }
        if self.catalogues.is_empty() {
            // The built-in amplifiers run built-in motors only.
            let listed = self.motors.is_none();
            groups.push(built_in(|kind| match kind {
                Kind::Motors | Kind::Gearboxes => false,
                Kind::Compatibility | Kind::Amplifiers => listed,
                Kind::Resistors => true,
            }));
        }
        for path in &self.catalogues {
            groups.push(if path.as_os_str() == "built-in" {
                built_in(|_| true)
            } else if path.is_dir() {
                folder(path, &mut remarks)?
            } else {
                file(path)?
            });
        }
        Loader::load(groups, remarks, self.skip_broken_rows)
    }

    /// Refuses a folder or file given twice, since all its keys would be duplicates.
    fn given_once(&self) -> Result<(), CatalogueError> {
        let files = self.motors.iter().chain(&self.gearboxes);
        let mut seen: HashMap<PathBuf, &PathBuf> = HashMap::new();
        for path in self.catalogues.iter().chain(files) {
            if let Some(before) = seen.insert(real(path), path) {
                return Err(twice(path, before));
            }
        }
        Ok(())
    }
}

/// Message and cure for an error of the file system.
fn cannot_read(path: &Path, error: &std::io::Error) -> CatalogueError {
    const CURE: &str = "check the path given with --catalogue, --motors or --gearboxes";
    match error.kind() {
        ErrorKind::NotFound => {
            let near = beside(path).map_or_else(String::new, |near| {
                format!("; did you mean {}?", plain::path(near))
            });
            let cure = format!("{CURE}{near}");
            unreadable(path, "no such file or folder", &cure)
        }
        ErrorKind::PermissionDenied => unreadable(
            path,
            "it may not be read",
            "allow this user to read it, or name another one",
        ),
        ErrorKind::IsADirectory => unreadable(
            path,
            "it is a folder",
            "pass folders with --catalogue, a single CSV file with --motors or --gearboxes",
        ),
        ErrorKind::FileTooLarge => unreadable(path, error.to_string(), LARGE),
        ErrorKind::TimedOut => unreadable(path, error.to_string(), disk::SLOW),
        _ => unreadable(path, error.to_string(), CURE),
    }
}

/// The file or folder in the same place with the most similar name, if any.
fn beside(path: &Path) -> Option<PathBuf> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let entries = std::fs::read_dir(folder.unwrap_or_else(|| Path::new("."))).ok()?;
    let names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    let near = closest(path.file_name()?.to_str()?, &names)?;
    Some(path.with_file_name(near))
}

fn read(path: &Path) -> Result<Text, CatalogueError> {
    let bytes = disk::bytes(path, MAX_SIZE).map_err(|error| cannot_read(path, &error))?;
    let text = disk::utf8(bytes).map_err(|fault| {
        let cure = "save the sheet as CSV in UTF-8 and pass that file with --catalogue, --motors or --gearboxes";
        unreadable(path, fault.message, cure)
    })?;
    Ok(Text::new(plain::path(path), text).at(real(path)))
}

fn file(path: &Path) -> Result<Vec<(FileFormat, Text)>, CatalogueError> {
    Ok(vec![formatted(read(path)?)?])
}

/// Depth of folders in which tables are searched.
const DEPTH: usize = 4;

fn folder(path: &Path, remarks: &mut Remarks) -> Result<Vec<(FileFormat, Text)>, CatalogueError> {
    let mut found = Vec::new();
    search(path, DEPTH, &mut found, remarks)?;
    if found.is_empty() {
        return Err(unreadable(path, "this folder contains no table", NAMES));
    }
    let size = |path: &PathBuf| path.metadata().map_or(0, |data| data.len());
    if found.iter().map(size).sum::<u64>() > MAX_FOLDER {
        let reason = "its tables have more than 64 MiB together";
        return Err(unreadable(path, reason, "name a folder of fewer tables"));
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
            remarks.add("ignored CSV files", || {
                format!("{} was ignored: {NAMES}", plain::path(&path))
            });
        }
    }
    Ok(())
}

/// Canonical form of a path.
fn real(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}
