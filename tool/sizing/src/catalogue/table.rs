//! A CSV table with units in its header, read row by row.

use std::ops::Range;

use jred_machine::units::did_you_mean;

use super::cell::{Cell, find_unit, unit_cure};
use super::column::{Column, Kind, Unit};
use super::fault::{Fault, Text};
use super::row::{Cells, Row};

/// A CSV file, its header understood.
pub(super) struct Table<'t> {
    text: &'t str,
    kind: Kind,
    columns: [Option<(usize, &'static Unit)>; Column::COUNT],
    /// Separator of the cells.
    separator: char,
    currency: String,
    header: csv::StringRecord,
    reader: csv::Reader<&'t [u8]>,
}

impl<'t> Table<'t> {
    /// Reads the header; `None` if there is none.
    pub(super) fn read(text: &'t Text, kind: Kind) -> Result<Option<Self>, Fault> {
        let text = text.text.as_str();
        let separator = separator(text);
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .comment(Some(b'#'))
            .delimiter(separator as u8)
            .from_reader(text.as_bytes());
        let header = reader
            .headers()
            .map_err(|e| csv_fault(text, &e, separator))?
            .clone();
        let mut table = Self {
            text,
            kind,
            separator,
            currency: String::new(),
            columns: [None; Column::COUNT],
            header,
            reader,
        };
        let header = table.header.clone();
        if header.iter().all(str::is_empty) {
            return Ok(None);
        }
        for (index, title) in header.iter().enumerate() {
            table.column(index, title)?;
        }
        Ok(Some(table))
    }

    fn column(&mut self, index: usize, title: &str) -> Result<(), Fault> {
        let (name, unit) = match title.split_once('[') {
            Some((name, unit)) => (name.trim(), unit.trim_end_matches(']').trim()),
            None => (title.trim(), ""),
        };
        let at = self.place_of(index, title);
        let Some(column) = Column::of(self.kind).find(|c| c.name() == name) else {
            return Err(unknown(name, self.kind, at));
        };
        let unit = if column == Column::Price {
            unit.clone_into(&mut self.currency);
            column.units().first()
        } else {
            find_unit(unit, column.units())
        }
        .ok_or_else(|| {
            Fault::new(
                format!("column \"{name}\" has the unit [{unit}]"),
                at.clone(),
                "not a unit of this quantity",
                match column.unit_list() {
                    none if none.is_empty() => format!("write \"{name}\" without a unit"),
                    list => format!(
                        "write the unit in the header as one of {list}; {}",
                        unit_cure(unit, column.units())
                    ),
                },
            )
        })?;
        if self.columns[column as usize]
            .replace((index, unit))
            .is_some()
        {
            return Err(Fault::new(
                format!("duplicate column \"{name}\""),
                at,
                "twice in this header",
                "keep one of the two",
            ));
        }
        Ok(())
    }

    /// Place of a title in the header.
    fn place_of(&self, index: usize, title: &str) -> Range<usize> {
        let from = cell_start(self.text, 0, index, self.separator);
        find(self.text, from, title)
    }

    /// Calls `take` with every row and the number of its line, or with what makes it unreadable.
    pub(super) fn each(mut self, mut take: impl FnMut(Result<(Row<'_>, usize), Fault>)) -> usize {
        let mut record = csv::StringRecord::new();
        let mut count = 0;
        loop {
            match self.reader.read_record(&mut record) {
                Ok(false) => return count,
                Err(error) => {
                    count += 1;
                    take(Err(csv_fault(self.text, &error, self.separator)));
                    // Only a row of the wrong length leaves the reader where it can go on.
                    if !matches!(error.kind(), csv::ErrorKind::UnequalLengths { .. }) {
                        return count;
                    }
                }
                Ok(true) => {
                    count += 1;
                    let position = record.position();
                    let line = position.map_or(0, csv::Position::line) as usize;
                    let cells = CsvRow {
                        table: &self,
                        record: &record,
                    };
                    if record == self.header {
                        let start = cells.place_at(0);
                        take(Err(Fault::new(
                            "duplicate header",
                            start,
                            "again here",
                            "remove this line: a table has one header",
                        )));
                    } else {
                        take(Ok((Row::new(self.kind, &cells), line)));
                    }
                }
            }
        }
    }
}

/// The fault of a name that is no column of this table.
pub(super) fn unknown(name: &str, kind: Kind, at: Range<usize>) -> Fault {
    let names: Vec<&str> = Column::of(kind).map(Column::name).collect();
    let near = did_you_mean(name, &names);
    let elsewhere = Column::ALL.iter().find(|column| column.name() == name);
    let elsewhere = elsewhere.and_then(|column| column.kinds().first());
    let elsewhere = elsewhere.map_or(String::new(), |kind| {
        format!("It is a column of {}. ", kind.plural())
    });
    Fault::new(
        format!("unknown column \"{name}\""),
        at,
        "not a column of this table",
        format!(
            "{elsewhere}{near}Columns of {}: {}",
            kind.plural(),
            names.join(", ")
        ),
    )
}

/// Message for an error of the CSV reader.
pub(super) fn csv_fault(text: &str, error: &csv::Error, separator: char) -> Fault {
    let from = error.position().map_or(0, |p| p.byte() as usize);
    let at = cell_start(text, from, 0, separator);
    let name = match separator {
        ';' => "semicolon",
        '\t' => "tab",
        _ => "comma",
    };
    let message = match error.kind() {
        csv::ErrorKind::UnequalLengths {
            expected_len, len, ..
        } => {
            format!("this row has {len} cells, but the header has {expected_len}")
        }
        _ => format!("invalid CSV: {error}"),
    };
    Fault::new(
        message,
        at..at,
        "in this row",
        format!(
            "every row must have as many cells as the header; quote cells that contain a {name}"
        ),
    )
}

struct CsvRow<'r> {
    table: &'r Table<'r>,
    record: &'r csv::StringRecord,
}

impl CsvRow<'_> {
    fn place_at(&self, index: usize) -> Range<usize> {
        let row = self.record.position().map_or(0, |p| p.byte() as usize);
        let from = cell_start(self.table.text, row, index, self.table.separator);
        find(self.table.text, from, self.record.get(index).unwrap_or(""))
    }
}

impl Cells for CsvRow<'_> {
    fn cell(&self, column: Column) -> Option<Cell<'_>> {
        let (index, unit) = self.table.columns[column as usize]?;
        let text = self.record.get(index)?;
        (!text.is_empty()).then_some(Cell {
            text,
            unit: Some(unit),
        })
    }

    fn place(&self, column: Column) -> Range<usize> {
        self.place_at(self.table.columns[column as usize].map_or(0, |c| c.0))
    }

    fn has(&self, column: Column) -> bool {
        self.table.columns[column as usize].is_some()
    }

    fn given(&self, column: Column) -> bool {
        self.has(column)
    }

    fn header(&self) -> Range<usize> {
        let at = cell_start(self.table.text, 0, 0, self.table.separator);
        at..at
    }

    fn currency(&self) -> &str {
        &self.table.currency
    }
}

/// Separator of the cells: tab or semicolon if the header contains one, otherwise comma.
pub(super) fn separator(text: &str) -> char {
    let start = cell_start(text, 0, 0, ',');
    let header = text
        .get(start..)
        .unwrap_or_default()
        .lines()
        .next()
        .unwrap_or_default();
    ['\t', ';']
        .into_iter()
        .find(|c| header.contains(*c))
        .unwrap_or(',')
}

/// The first occurrence of `cell` from byte `from` on.
fn find(text: &str, from: usize, cell: &str) -> Range<usize> {
    let from = from.min(text.len());
    let rest = text.get(from..).unwrap_or("");
    let line_end = rest.find('\n').unwrap_or(rest.len());
    let found = rest.get(..line_end).and_then(|line| line.find(cell));
    match found {
        Some(at) => from + at..from + at + cell.len(),
        None => from..from,
    }
}

/// Where cell number `index` of the row begins that follows byte `from`: past comments and blank lines, and past as
/// many separators outside quotes.
pub(super) fn cell_start(text: &str, from: usize, index: usize, separator: char) -> usize {
    let mut start = from.min(text.len());
    if start == 0 && text.starts_with('\u{feff}') {
        start = '\u{feff}'.len_utf8();
    }
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
            *c == separator && !quoted
        });
    match index.checked_sub(1).map(|n| commas.nth(n)) {
        Some(Some((comma, _))) => start + comma + 1,
        _ => start,
    }
}
