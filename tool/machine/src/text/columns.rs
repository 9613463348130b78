//! CSV files from other programs: columns of numbers with units in the header.
//!
//! Commas, semicolons or tabs between the values, a byte order mark, comments (`#`), and, where no comma separates, decimal
//! commas. Every mistake is shown in the CSV file.

use super::file::Files;
use super::item::Item;
use super::problem::{Problem, Result};
use crate::number::rounding::figure;
use crate::units::did_you_mean;
use crate::units::kind::Kind;
use crate::units::unit;
use std::ops::Range;

/// The largest CSV file (bytes).
const MAX_SIZE: u64 = 64 << 20;

/// A column that a file may have.
#[derive(Clone, Copy)]
pub(crate) struct Known {
    /// The names that it may have, the usual one first; capitals do not matter.
    pub(crate) names: &'static [&'static str],
    /// What it measures.
    pub(crate) kind: &'static Kind,
}

/// A column of these names that measures this.
pub(crate) const fn known(names: &'static [&'static str], kind: &'static Kind) -> Known {
    Known { names, kind }
}

/// Columns that a kind of file may have.
pub(crate) struct Format<'f> {
    /// Its columns.
    pub(crate) known: &'f [Known],
    /// Whether columns with other names are ignored.
    pub(crate) ignored: fn(&str) -> bool,
    /// A header to suggest.
    pub(crate) example: &'f str,
    /// Fewest rows.
    pub(crate) min_rows: usize,
}

/// The file that `item` names, among `files`.
pub(crate) struct CsvFile {
    pub(crate) text: String,
    name: String,
}

impl CsvFile {
    pub(crate) fn open(item: &Item, example: &str, files: &dyn Files) -> Result<Self> {
        let file = item.text(example)?;
        let text = files.text(file, MAX_SIZE).map_err(|fault| {
            item.problem(&format!("cannot be read: {}", fault.message), "this file")
                .help(fault.help)
        })?;
        let name = files.shown(file);
        let text = text.trim_start_matches('\u{feff}').to_owned();
        Ok(Self { text, name })
    }

    /// The problem, shown in this file.
    pub(crate) fn shows(&self, problem: Problem) -> Problem {
        problem.in_file(&self.name, &self.text)
    }
}

/// The columns of a file in SI units.
pub(crate) struct Columns {
    /// For each column of the format its values.
    values: Vec<Option<Vec<f64>>>,
    /// For each its name in the file with its unit, and the size of that unit.
    headers: Vec<(String, f64)>,
    /// Where the rows are.
    places: Vec<Range<usize>>,
}

impl Columns {
    /// The values of the format's column number `index`, if the file has it.
    pub(crate) fn get(&self, index: usize) -> Option<&[f64]> {
        self.values.get(index)?.as_deref()
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.places.len()
    }

    /// Where row number `row` is, counted from 0.
    pub(crate) fn place(&self, row: usize) -> Range<usize> {
        self.places.get(row).cloned().unwrap_or_default()
    }

    /// A value with the unit of its column.
    pub(crate) fn shown(&self, index: usize, value: f64) -> String {
        let Some((header, scale)) = self.headers.get(index) else {
            return figure(value);
        };
        let unit = split_header(header).map_or("", |(_, unit)| unit);
        format!("{} {unit}", figure(value / scale))
            .trim_end()
            .to_owned()
    }

    /// A problem of one value: "row 3: J = −2 kg m^2 `what`".
    pub(crate) fn problem(&self, index: usize, row: usize, what: &str) -> Problem {
        let value = self.get(index).and_then(|values| values.get(row));
        let header = self.headers.get(index).map_or("", |(header, _)| header);
        let name = split_header(header).map_or(header, |(name, _)| name);
        let shown = self.shown(index, value.copied().unwrap_or(f64::NAN));
        Problem::new(format!("row {}: {name} = {shown} {what}", row + 1))
            .at(self.place(row), "this row")
    }

    /// Checks that the values of a column rise from row to row.
    pub(crate) fn check_rising(&self, index: usize, what: &str, help: &str) -> Result<()> {
        let values = self.get(index).unwrap_or_default();
        let Some(row) = values.windows(2).position(|pair| pair[1] <= pair[0]) else {
            return Ok(());
        };
        let [before, after] = [row, row + 1]
            .map(|row| self.shown(index, values.get(row).copied().unwrap_or_default()));
        Err(Problem::new(format!(
            "the {what} does not increase: row {} has {after} after {before}",
            row + 2
        ))
        .at(self.place(row + 1), "this row")
        .help(help))
    }
}

/// `name [unit]`
fn split_header(header: &str) -> Option<(&str, &str)> {
    let (name, unit) = header.strip_suffix(']')?.rsplit_once('[')?;
    Some((name.trim_end(), unit.trim()))
}

/// The first line that is no comment.
pub(crate) fn header_of(text: &str) -> &str {
    let mut lines = text
        .lines()
        .filter(|line| !line.starts_with('#') && !line.trim().is_empty());
    lines.next().unwrap_or_default()
}

/// Where the header is.
pub(crate) fn header_place(text: &str) -> Range<usize> {
    let header = header_of(text);
    let start = text.find(header).unwrap_or(0);
    start..start + header.len()
}

/// Separator of the values: tab or semicolon, whichever the header contains first, otherwise the comma.
fn delimiter(text: &str) -> u8 {
    let header = header_of(text);
    if header.contains('\t') {
        b'\t'
    } else if header.contains(';') {
        b';'
    } else {
        b','
    }
}

/// Reads header and rows.
pub(crate) fn read(text: &str, format: &Format) -> Result<Columns> {
    let delimiter = delimiter(text);
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .flexible(true)
        .from_reader(text.as_bytes());
    let broken = |error: &csv::Error| {
        let start = error.position().map_or(0, |p| p.byte() as usize);
        Problem::new(format!("invalid CSV: {error}"))
            .at(line_at(text, start), "here")
            .help(format!(
                "give columns of numbers under the header {}",
                format.example
            ))
    };
    let header = reader.headers().map_err(|error| broken(&error))?.clone();
    let columns = header_columns(&header, text, format)?;
    let mut values: Vec<Option<Vec<f64>>> = vec![None; format.known.len()];
    let mut headers = vec![(String::new(), 1.0); format.known.len()];
    for (column, name) in columns.iter().zip(&header) {
        if let Some((index, scale)) = column {
            values[*index] = Some(Vec::new());
            headers[*index] = (name.to_owned(), *scale);
        }
    }
    let mut places = Vec::new();
    for (number, record) in reader.records().enumerate() {
        let record = record.map_err(|error| broken(&error))?;
        let start = record.position().map_or(0, |p| p.byte() as usize);
        let place = line_at(text, start);
        if record.len() != columns.len() {
            return Err(Problem::new(format!(
                "row {} has {} values, but the header has {} columns",
                number + 1,
                record.len(),
                columns.len()
            ))
            .at(place, "this row")
            .help(
                "separate the values as the header does; with commas between them decimals have a point, with semicolons or \
                 tabs they may have a comma",
            ));
        }
        for ((field, column), name) in record.iter().zip(&columns).zip(&header) {
            let Some((index, scale)) = *column else {
                continue;
            };
            let value = number_of(field, delimiter).ok_or_else(|| {
                Problem::new(format!(
                    "row {}: \"{field}\" in the column \"{name}\" is not a finite number",
                    number + 1
                ))
                .at(place.clone(), "this row")
                .help("write plain numbers with a decimal point and no units, such as 12.5; leave no cell empty")
            })? * scale;
            let kind = format.known[index].kind;
            if value.abs() > kind.largest {
                return Err(Problem::new(format!(
                    "row {}: {field} in the column \"{name}\" is too large for {}",
                    number + 1,
                    kind.name
                ))
                .at(place, "this row")
                .help(format!(
                    "at most {} {name} is accepted: check the number and the unit in the header",
                    figure(kind.largest / scale)
                )));
            }
            values[index].get_or_insert_default().push(value);
        }
        places.push(place);
    }
    if places.len() < format.min_rows {
        let end = text.trim_end().len();
        return Err(Problem::new(format!(
            "the file has {} rows, but needs at least {}",
            places.len(),
            format.min_rows
        ))
        .at(end..end, "ends here")
        .help(format!(
            "add the columns {} and one row for each point",
            format.example
        )));
    }
    Ok(Columns {
        values,
        headers,
        places,
    })
}

/// A number, with a decimal comma where no comma separates.
fn number_of(field: &str, delimiter: u8) -> Option<f64> {
    let number = if delimiter != b',' && field.contains(',') && !field.contains('.') {
        field.replacen(',', ".", 1).parse()
    } else {
        field.parse()
    };
    number.ok().filter(|value: &f64| value.is_finite())
}

/// For each column of the file, which of the format's it is and the size of its unit; `None` if it is passed over.
fn header_columns(
    header: &csv::StringRecord,
    text: &str,
    format: &Format,
) -> Result<Vec<Option<(usize, f64)>>> {
    let place = header_place(text);
    let help = format!(
        "the first line gives column names with units: {}",
        format.example
    );
    let fault = |message: String, help: String| {
        Problem::new(message).at(place.clone(), "header").help(help)
    };
    let mut columns: Vec<Option<(usize, f64)>> = Vec::new();
    for whole in header {
        let name = split_header(whole).map_or(whole, |(name, _)| name);
        let is = |known: &Known| known.names.iter().any(|n| n.eq_ignore_ascii_case(name));
        let Some(index) = format.known.iter().position(is) else {
            if (format.ignored)(name) {
                columns.push(None);
                continue;
            }
            let names: Vec<&str> = format.known.iter().flat_map(|k| k.names).copied().collect();
            let near = did_you_mean(name, &names);
            return Err(fault(format!("unknown column \"{whole}\""), near + &help));
        };
        let kind = format.known[index].kind;
        let Some((_, unit)) = split_header(whole) else {
            return Err(fault(
                format!("the column \"{whole}\" has no unit"),
                format!(
                    "write \"{name} [{}]\"; possible units: {}",
                    kind.unit, kind.units
                ),
            ));
        };
        let read = unit::read(&unit::tidy(unit))
            .map_err(|f| fault(format!("the column \"{whole}\" {}", f.message), f.help))?;
        if !kind.is_measured_by(read.dimension) {
            return Err(fault(
                format!(
                    "the column \"{whole}\" is {}, but must be {}",
                    crate::units::kind::describe(read.dimension),
                    kind.name
                ),
                format!("possible units: {}", kind.units),
            ));
        }
        if columns.iter().flatten().any(|(other, _)| *other == index) {
            return Err(fault(
                format!("duplicate column \"{name}\""),
                format!("remove one of the two; {help}"),
            ));
        }
        columns.push(Some((index, read.scale)));
    }
    Ok(columns)
}

/// The line that begins at or after `start`.
fn line_at(text: &str, start: usize) -> Range<usize> {
    let rest = text.get(start..).unwrap_or_default();
    let start = start + rest.len() - rest.trim_start().len();
    let line = text.get(start..).unwrap_or_default();
    let length = line.find(['\n', '\r']).unwrap_or(line.len());
    start..start + length
}
