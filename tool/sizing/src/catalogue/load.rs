//! Loads catalogue files into one catalogue: content of each file, duplicate keys, broken rows, allowed combinations.

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

use jred_file::plain;
use jred_file::text::problem::Problem;

use super::column::{Column, Kind};
use super::duplicates::Duplicates;
use super::entry::Entry;
use super::fault::{CatalogueError, Faults, Remarks, Text};
use super::files::{FileFormat, unreadable};
use super::lists::Listing;
use super::motor::WITH_BRAKE;
use super::pairing::Partners;
use super::row::{CatalogueRow, RowResult};
use super::table::CatalogueTable;
use super::{Catalogue, Pairing, mgdb, plausible, toml_table};
use jred_file::number::words::counted;

/// Most rows of all tables: this many motors with their limits take 150 MB.
const MOST_ROWS: usize = 100_000;

/// Largest possible number of rows of a table. Rows of lists take few bytes and are not counted.
fn rows(format: FileFormat, text: &str) -> usize {
    match format {
        FileFormat::Csv(Kind::Compatibility) | FileFormat::Database(Kind::Compatibility) => 0,
        FileFormat::Csv(_) | FileFormat::Database(_) => text.lines().skip(1).count(),
        FileFormat::Toml => text.matches("[[").count(),
    }
}

/// The files of one catalogue; they share a compatibility list.
#[derive(Debug, Default)]
pub(super) struct FileGroup {
    pub(super) listings: Vec<(usize, Listing)>,
    pub(super) motors: Vec<u32>,
}

/// A catalogue under construction.
#[derive(Debug, Default)]
pub(super) struct Loader {
    pub(super) catalogue: Catalogue,
    pub(super) texts: Vec<Text>,
    /// Number of their rows.
    rows: usize,
    pub(super) faults: Faults,
    remarks: Remarks,
    twins: Duplicates,
    /// Kind and key of each entry, with its file.
    keys: HashMap<(Kind, String), usize>,
    /// The files read so far, with canonical path and name.
    read: HashMap<PathBuf, PathBuf>,
    /// Whether broken rows are skipped.
    skip: bool,
    /// A missing column of the current file.
    lacking: Option<Problem>,
    /// Keys of broken rows, which lists may still contain.
    pub(super) broken: HashSet<String>,
    /// Gear motors: index of the motor, key of its gearbox, and the position of this entry.
    pub(super) gear_motors: Vec<(u32, String, usize, Range<usize>)>,
}

impl Loader {
    /// The catalogue of these groups of files.
    pub(super) fn load(
        groups: Vec<Vec<(FileFormat, Text)>>,
        remarks: Remarks,
        skip: bool,
    ) -> Result<Catalogue, CatalogueError> {
        let mut loader = Self {
            remarks,
            skip,
            ..Self::default()
        };
        let mut read_groups = Vec::new();
        for files in groups {
            read_groups.push(loader.group(files)?);
        }
        loader.finish(read_groups)
    }

    /// Reads the files of one catalogue.
    fn group(&mut self, files: Vec<(FileFormat, Text)>) -> Result<FileGroup, CatalogueError> {
        let first = self.catalogue.motors.len();
        let mut group = FileGroup::default();
        for (format, text) in files {
            // A file given in addition to its folder, or a folder within a folder.
            let path = PathBuf::from(&text.name);
            if let Some(before) = self.read.insert(text.place.clone(), path.clone()) {
                return Err(twice(&path, &before));
            }
            self.rows += rows(format, &text.text);
            if self.rows > MOST_ROWS {
                let reason = format!("the catalogue has more than {MOST_ROWS} rows with it");
                return Err(unreadable(
                    &path,
                    reason,
                    "take a smaller table, or only a part of it",
                ));
            }
            self.texts.push(text.clone());
            let index = self.texts.len() - 1;
            let count = match format {
                FileFormat::Csv(kind) => self.csv(kind, index, &text, &mut group)?,
                FileFormat::Toml => {
                    toml_table::each(&text.text, |row| self.row(index, &text, &mut group, row))
                        .map_err(|fault| wrong(&text, fault))?
                }
                FileFormat::Database(kind) => self.database(kind, index, &text, &mut group)?,
            };
            // A table with a header may have no rows yet.
            let has_header = matches!(format, FileFormat::Csv(_)) && has_lines(&text.text);
            if count == 0 && !has_header {
                let (what, cure) = match format {
                    FileFormat::Csv(kind) | FileFormat::Database(kind) => (
                        kind.plural(),
                        "add a row, or delete the file; docs/catalogue.md shows the columns",
                    ),
                    FileFormat::Toml => (
                        "tables",
                        "add at least one table such as [[motor]]; docs/catalogue.md shows its keys",
                    ),
                };
                return Err(CatalogueError::Empty(text.name, what, cure));
            }
        }
        group.motors = (first as u32..self.catalogue.motors.len() as u32).collect();
        Ok(group)
    }

    fn csv(
        &mut self,
        kind: Kind,
        index: usize,
        text: &Text,
        group: &mut FileGroup,
    ) -> Result<usize, CatalogueError> {
        let table = CatalogueTable::read(&text.text, kind).map_err(|fault| wrong(text, fault))?;
        let Some(table) = table else {
            return Ok(0);
        };
        let count = table.each(|row| self.row(index, text, group, row));
        match self.lacking.take() {
            Some(fault) => Err(wrong(text, fault)),
            None => Ok(count),
        }
    }

    fn database(
        &mut self,
        kind: Kind,
        index: usize,
        text: &Text,
        group: &mut FileGroup,
    ) -> Result<usize, CatalogueError> {
        if kind == Kind::Compatibility {
            mgdb::listings(text, |listing| match listing {
                Ok(listing) => group.listings.push((index, listing)),
                Err(fault) => self.faults.add(text, fault),
            });
            return Ok(group.listings.len());
        }
        let rows = mgdb::entries(text, kind, &mut self.remarks);
        let rows = rows.map_err(|fault| wrong(text, fault))?;
        let count = rows.len();
        for row in rows {
            let fault = match row {
                Err(fault) => Some(fault),
                Ok((entry, line, at)) => {
                    let [key, ..] = entry.names().unwrap_or_default();
                    let clash = self.claim(kind, key, index, at);
                    if clash.is_none() {
                        self.put(entry, index, group, &|| format!("{}:{line}", text.name));
                    }
                    clash
                }
            };
            if let Some(fault) = fault {
                self.faults.add(text, fault);
            }
        }
        Ok(count)
    }

    fn row(
        &mut self,
        index: usize,
        text: &Text,
        group: &mut FileGroup,
        row: Result<(CatalogueRow, usize), Problem>,
    ) {
        let faults = match row {
            Err(fault) => vec![fault],
            Ok((mut row, line)) => {
                let Err(faults) = self.entry(index, text, group, &mut row, line) else {
                    return;
                };
                self.broken.insert(row.name().to_owned());
                self.lacking = self.lacking.take().or_else(|| row.lacking());
                faults
            }
        };
        if !faults.is_empty() {
            self.faults.add_row(text, faults);
        }
    }

    /// The key of a row must be unique, even if the row is broken; skipped rows do not claim a key.
    fn key(&mut self, index: usize, row: &CatalogueRow, broken: bool) -> Option<Problem> {
        let key = row
            .words(Column::Key)
            .filter(|_| row.kind != Kind::Compatibility)?;
        if broken && self.skip {
            return None;
        }
        self.claim(row.kind, key, index, row.place(Column::Key))
    }

    fn entry(
        &mut self,
        index: usize,
        text: &Text,
        group: &mut FileGroup,
        row: &mut CatalogueRow,
        line: usize,
    ) -> RowResult<()> {
        let read = Entry::read(row);
        let clash = self.key(index, row, read.is_err());
        let entry = match (read, clash) {
            (Ok(entry), None) => entry,
            (Ok(_), Some(clash)) => return Err(vec![clash]),
            (Err(mut faults), clash) => {
                faults.extend(clash);
                return Err(faults);
            }
        };
        if entry.has_price() {
            self.price(row, text);
        }
        if let Entry::Motor(motor, _) = &entry
            && let Some(key) = motor.key_with_brake()
            && let Some(clash) = self.claim(row.kind, &key, index, row.place(Column::Key))
        {
            return Err(vec![clash]);
        }
        if let Entry::Motor(motor, Some(gearbox)) = &entry {
            let first = self.catalogue.motors.len() as u32;
            let at = row.place(Column::BuiltInGearbox);
            let variants = 1 + u32::from(motor.key_with_brake().is_some());
            for motor in first..first + variants {
                self.gear_motors
                    .push((motor, gearbox.clone(), index, at.clone()));
            }
        }
        self.put(entry, index, group, &|| format!("{}:{line}", text.name));
        Ok(())
    }

    /// Adds an entry, with warnings about its figures.
    fn put(
        &mut self,
        entry: Entry,
        index: usize,
        group: &mut FileGroup,
        place: &dyn Fn() -> String,
    ) {
        match &entry {
            Entry::Motor(motor, _) => plausible::motor(&mut self.remarks, place, motor),
            Entry::Gearbox(gearbox) => plausible::gearbox(&mut self.remarks, place, gearbox),
            _ => {}
        }
        self.twins.check(&mut self.remarks, place, &entry);
        match entry {
            Entry::Motor(motor, _) => self.catalogue.motors.extend(motor.variants()),
            Entry::Gearbox(gearbox) => self.catalogue.gearboxes.push(*gearbox),
            Entry::Amplifier(amplifier) => self.catalogue.amplifiers.push(amplifier),
            Entry::Resistor(resistor) => self.catalogue.resistors.push(resistor),
            Entry::Listing(listing) => group.listings.push((index, listing)),
        }
    }

    /// Records the currency of a price with the first file that uses it.
    fn price(&mut self, row: &CatalogueRow, text: &Text) {
        let currency = row.currency();
        let known = self.catalogue.currencies.iter();
        if !known
            .clone()
            .any(|(word, _)| word.eq_ignore_ascii_case(currency))
        {
            let found = (currency.to_owned(), text.name.clone());
            self.catalogue.currencies.push(found);
        }
    }

    /// Claims a key for an entry; returns the fault if another one has it.
    fn claim(&mut self, kind: Kind, key: &str, index: usize, at: Range<usize>) -> Option<Problem> {
        let before = self.keys.insert((kind, key.to_owned()), index)?;
        let key = plain::cut(key);
        let name = |index: usize| self.texts.get(index).map_or("", |text| text.name.as_str());
        let message = if before == index {
            format!("duplicate key \"{key}\"")
        } else {
            format!(
                "duplicate key \"{key}\": in {} and in {}",
                name(before),
                name(index)
            )
        };
        let fault = Problem::new(message).at(at, "again here");
        Some(fault.help("give every row a unique key"))
    }

    /// Whether the brake of a motor that has one as an option, but neither its torque nor a row of its own, holds a machine is not known.
    fn forget_unknown_brakes(&mut self) {
        for motor in &mut self.catalogue.motors {
            let with = || (Kind::Motors, format!("{}{WITH_BRAKE}", motor.key));
            motor.brake_is_optional = motor.brake_is_optional && self.keys.contains_key(&with());
        }
    }

    fn finish(mut self, groups: Vec<FileGroup>) -> Result<Catalogue, CatalogueError> {
        let mut pairing = Pairing {
            motors: vec![Partners::default(); self.catalogue.motors.len()],
            lists_amplifiers: false,
            listed: vec![false; self.catalogue.amplifiers.len()],
            built_in: vec![false; self.catalogue.gearboxes.len()],
        };
        self.forget_unknown_brakes();
        self.pair_gear_motors(&mut pairing);
        for group in groups {
            self.pair(&group, &mut pairing);
        }
        let broken = self.faults.rows();
        if !self.skip {
            self.faults.into_result()?;
        } else if broken > 0 {
            self.remarks.add("skipped rows", || {
                let rows = counted(broken, "broken row", "broken rows");
                format!("{rows} of the catalogue skipped")
            });
        }
        let mut catalogue = self.catalogue;
        catalogue.left_out = broken;
        catalogue.pairing = pairing;
        if broken == 0 {
            catalogue.remark_amplifiers(&mut self.remarks);
        }
        catalogue.warnings = self.remarks.into_lines();
        catalogue.mark_amplifiers();
        if catalogue.motors.is_empty() {
            let names: Vec<&str> = self.texts.iter().map(|t| t.name.as_str()).collect();
            let names = names.join(", ");
            return Err(match broken {
                0 => CatalogueError::Empty(
                    names,
                    "motors",
                    "add motors: rows of a file whose name ends in motors.csv, or tables [[motor]] in a .toml file; docs/catalogue.md shows their figures",
                ),
                n => CatalogueError::Skipped(names, counted(n, "row is", "rows are")),
            });
        }
        Ok(catalogue)
    }
}

pub(super) fn twice(path: &Path, before: &Path) -> CatalogueError {
    CatalogueError::Twice {
        path: plain::path(path),
        before: plain::path(before),
    }
}

/// Whether a table has a line that is not empty and not a comment.
fn has_lines(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim);
    lines.any(|line| !line.is_empty() && !line.starts_with('#'))
}

fn wrong(text: &Text, fault: Problem) -> CatalogueError {
    CatalogueError::Wrong(text.shows(fault))
}
