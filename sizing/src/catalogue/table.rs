//! A CSV table with units in its header, read row by row with errors that name line and column.

use std::collections::{BTreeMap, BTreeSet};

use miette::NamedSource;

use super::{CatalogueError, Misplaced};

/// Columns that the tool knows: name, and the units accepted with their factor to SI.
const COLUMNS: &[(&str, &[(&str, f64)])] = &[
    ("key", TEXT),
    ("maker", TEXT),
    ("model", TEXT),
    ("source", TEXT),
    ("figures_from", TEXT),
    ("rated_torque", TORQUE),
    ("rated_speed", SPEED),
    ("standstill_torque", TORQUE),
    ("peak_torque", TORQUE),
    ("max_speed", SPEED),
    ("rotor_inertia", INERTIA),
    ("peak_corner_speed", SPEED),
    ("peak_torque_at_max_speed", TORQUE),
    ("bus_voltage", &[("V", 1.0)]),
    ("mass", &[("kg", 1.0), ("g", 1e-3)]),
    ("ratio", &[("", 1.0)]),
    ("rated_output_torque", TORQUE),
    ("peak_output_torque", TORQUE),
    ("emergency_output_torque", TORQUE),
    ("rated_input_speed", SPEED),
    ("max_input_speed", SPEED),
    ("input_inertia", INERTIA),
    ("efficiency", &[("%", 0.01), ("", 1.0)]),
    ("backlash", &[("arcmin", std::f64::consts::PI / 10_800.0)]),
];
const TEXT: &[(&str, f64)] = &[("", 1.0)];
const TORQUE: &[(&str, f64)] = &[("N m", 1.0), ("Nm", 1.0), ("mN m", 1e-3)];
const SPEED: &[(&str, f64)] = &[("rpm", std::f64::consts::PI / 30.0), ("rad/s", 1.0)];
const INERTIA: &[(&str, f64)] = &[("kg cm^2", 1e-4), ("kg m^2", 1.0), ("g cm^2", 1e-7)];

/// A catalogue file, its header understood.
pub(super) struct Table {
    name: String,
    text: String,
    columns: BTreeMap<&'static str, (usize, f64)>,
    records: Vec<csv::StringRecord>,
}

impl Table {
    pub(super) fn read(name: &str, text: &str) -> Result<Self, CatalogueError> {
        let mut table = Self {
            name: name.to_owned(),
            text: text.to_owned(),
            columns: BTreeMap::new(),
            records: Vec::new(),
        };
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .comment(Some(b'#'))
            .from_reader(text.as_bytes());
        let header = reader
            .headers()
            .map_err(|error| table.csv_error(&error))?
            .clone();
        for (index, title) in header.iter().enumerate() {
            let (name, unit) = match title.split_once('[') {
                Some((name, unit)) => (name.trim(), unit.trim_end_matches(']').trim()),
                None => (title.trim(), ""),
            };
            let Some((known, units)) = COLUMNS.iter().find(|c| c.0 == name) else {
                let names: Vec<&str> = COLUMNS.iter().map(|c| c.0).collect();
                let nearest = nearest(name, &names);
                return Err(table.wrong(
                    0,
                    title,
                    format!("unknown column \"{name}\""),
                    "not a column of a catalogue",
                    format!("did you mean \"{nearest}\"? Columns: {}", names.join(", ")),
                ));
            };
            let Some((_, factor)) = units.iter().find(|u| u.0 == unit) else {
                let accepted: Vec<String> = units.iter().map(|u| format!("[{}]", u.0)).collect();
                return Err(table.wrong(
                    0,
                    title,
                    format!("column \"{name}\" has the unit [{unit}]"),
                    "not a unit of this quantity",
                    format!(
                        "write the unit into the header as one of {}",
                        accepted.join(", ")
                    ),
                ));
            };
            if table.columns.insert(known, (index, *factor)).is_some() {
                return Err(table.wrong(
                    0,
                    title,
                    format!("the column \"{name}\" is there twice"),
                    "twice in this header",
                    "keep one of the two".to_owned(),
                ));
            }
        }
        for record in reader.records() {
            let record = record.map_err(|error| table.csv_error(&error))?;
            table.records.push(record);
        }
        Ok(table)
    }

    /// All rows through `build`.
    pub(super) fn rows<T>(
        &self,
        what: &'static str,
        build: impl Fn(&mut Row) -> Result<T, CatalogueError>,
    ) -> Result<Vec<T>, CatalogueError> {
        if self.records.is_empty() {
            return Err(CatalogueError::Empty(self.name.clone(), what));
        }
        let mut keys = BTreeSet::new();
        let mut rows = Vec::with_capacity(self.records.len());
        for record in &self.records {
            let mut row = Row {
                table: self,
                record,
            };
            let key = row.key()?;
            rows.push(build(&mut row)?);
            if !keys.insert(key.clone()) {
                return Err(row.wrong(
                    "key",
                    format!("the key \"{key}\" is there twice"),
                    "again here",
                    "give every row a key of its own".to_owned(),
                ));
            }
        }
        Ok(rows)
    }

    fn csv_error(&self, error: &csv::Error) -> CatalogueError {
        let at = error.position().map_or(0, |p| p.byte() as usize);
        self.wrong(
            at,
            "",
            format!("not readable as CSV: {error}"),
            "in this row",
            "every row needs as many cells as the header; quote cells that hold a comma".to_owned(),
        )
    }

    /// An error at the first occurrence of `cell` from byte `from` on.
    fn wrong(
        &self,
        from: usize,
        cell: &str,
        message: String,
        label: &str,
        help: String,
    ) -> CatalogueError {
        let from = from.min(self.text.len());
        let found = self.text.get(from..).and_then(|rest| rest.find(cell));
        let start = from + found.unwrap_or(0);
        CatalogueError::Wrong(Box::new(Misplaced {
            message,
            file: NamedSource::new(&self.name, self.text.clone()),
            place: (start, cell.len()).into(),
            label: label.to_owned(),
            help,
        }))
    }
}

fn nearest<'a>(word: &str, names: &[&'a str]) -> &'a str {
    names
        .iter()
        .max_by(|a, b| strsim::jaro_winkler(word, a).total_cmp(&strsim::jaro_winkler(word, b)))
        .copied()
        .unwrap_or("")
}

/// One row.
pub(super) struct Row<'t> {
    table: &'t Table,
    record: &'t csv::StringRecord,
}

impl Row<'_> {
    pub(super) fn key(&mut self) -> Result<String, CatalogueError> {
        self.text("key")
    }

    /// A cell that must hold text.
    pub(super) fn text(&mut self, column: &'static str) -> Result<String, CatalogueError> {
        match self.cell(column)? {
            "" => Err(self.empty(column)),
            text => Ok(text.to_owned()),
        }
    }

    /// Whether the figures were read in the maker's own document; so if there is no such column or the cell is empty.
    pub(super) fn is_from_maker(&mut self) -> Result<bool, CatalogueError> {
        const COLUMN: &str = "figures_from";
        if !self.table.columns.contains_key(COLUMN) {
            return Ok(true);
        }
        match self.cell(COLUMN)? {
            "" | "maker" => Ok(true),
            "other" => Ok(false),
            word => Err(self.wrong(
                COLUMN,
                format!("{COLUMN} of \"{}\" is \"{word}\"", self.name()),
                "not known",
                "write \"maker\" for figures from the maker's own document, else \"other\""
                    .to_owned(),
            )),
        }
    }

    /// A figure that must be there and be greater than zero, in SI units.
    pub(super) fn positive(&mut self, column: &'static str) -> Result<f64, CatalogueError> {
        match self.optional(column)? {
            Some(value) => Ok(value),
            None => Err(self.empty(column)),
        }
    }

    /// A figure that may be left out (an empty cell, or no such column), in SI units.
    pub(super) fn optional(&mut self, column: &'static str) -> Result<Option<f64>, CatalogueError> {
        let Some(&(index, factor)) = self.table.columns.get(column) else {
            return Ok(None);
        };
        let cell = self.record.get(index).unwrap_or("");
        if cell.is_empty() {
            return Ok(None);
        }
        match cell.parse::<f64>() {
            Ok(value) if value.is_finite() && value > 0.0 => Ok(Some(value * factor)),
            _ => Err(self.wrong(
                column,
                format!("{column} of \"{}\" is \"{cell}\"", self.name()),
                "not a number greater than zero",
                "write a plain number; its unit stands in the header; leave the cell empty if the data sheet does \
                 not say"
                    .to_owned(),
            )),
        }
    }

    /// A figure that must not be below another one.
    pub(super) fn at_least(
        &self,
        column: &'static str,
        value: f64,
        other: &'static str,
        least: f64,
    ) -> Result<(), CatalogueError> {
        if value >= least {
            return Ok(());
        }
        Err(self.wrong(
            column,
            format!("{column} of \"{}\" is below its {other}", self.name()),
            "too small",
            format!(
                "check {column} and {other} against the data sheet, and the units in the header"
            ),
        ))
    }

    /// A figure with an upper limit.
    pub(super) fn at_most(
        &self,
        column: &'static str,
        value: f64,
        most: f64,
    ) -> Result<(), CatalogueError> {
        if value <= most {
            return Ok(());
        }
        Err(self.wrong(
            column,
            format!("{column} of \"{}\" is above {most}", self.name()),
            "too large",
            "check the figure and the unit in the header".to_owned(),
        ))
    }

    fn name(&self) -> &str {
        let key = self.table.columns.get("key");
        key.and_then(|c| self.record.get(c.0)).unwrap_or("?")
    }

    fn cell(&self, column: &'static str) -> Result<&str, CatalogueError> {
        let Some(&(index, _)) = self.table.columns.get(column) else {
            return Err(self.table.wrong(
                0,
                "",
                format!("the column \"{column}\" is missing"),
                "in this header",
                format!("add the column \"{column}\"; docs/catalogue.md shows all columns"),
            ));
        };
        Ok(self.record.get(index).unwrap_or(""))
    }

    fn empty(&self, column: &'static str) -> CatalogueError {
        if self.table.columns.contains_key(column) {
            self.wrong(
                column,
                format!("{column} of \"{}\" is empty", self.name()),
                "needed in every row",
                format!("fill in {column}, or leave the row out"),
            )
        } else {
            self.table.wrong(
                0,
                "",
                format!("the column \"{column}\" is missing"),
                "in this header",
                format!(
                    "add the column \"{column}\" with its unit; docs/catalogue.md shows all columns"
                ),
            )
        }
    }

    fn wrong(&self, column: &str, message: String, label: &str, help: String) -> CatalogueError {
        let index = self.table.columns.get(column).map_or(0, |c| c.0);
        let row = self.record.position().map_or(0, |p| p.byte() as usize);
        let from = cell_start(&self.table.text, row, index);
        let cell = self.record.get(index).unwrap_or("");
        self.table.wrong(from, cell, message, label, help)
    }
}

/// Where cell number `index` of the row begins that follows byte `from`: past comments and blank lines, and past as
/// many commas outside quotes.
fn cell_start(text: &str, from: usize, index: usize) -> usize {
    let mut start = from.min(text.len());
    for line in text.get(start..).unwrap_or("").split_inclusive('\n') {
        if !(line.starts_with('#') || line.trim().is_empty()) {
            break;
        }
        start += line.len();
    }
    let mut quoted = false;
    let mut commas = text
        .get(start..)
        .unwrap_or("")
        .char_indices()
        .filter(|(_, c)| {
            quoted ^= *c == '"';
            *c == ',' && !quoted
        });
    match index.checked_sub(1).map(|n| commas.nth(n)) {
        Some(Some((comma, _))) => start + comma + 1,
        _ => start,
    }
}
