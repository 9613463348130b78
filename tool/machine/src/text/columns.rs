//! CSV files from other programs: columns of numbers with units in the header; where no comma separates, decimals may have
//! one. Every mistake is shown in the CSV file.

use std::ops::Range;
use std::sync::Arc;

use super::csv::{Table, name_and_unit};
use super::file::Files;
use super::item::Item;
use super::problem::{Problem, Result};
use crate::number::rounding::figure;
use crate::plain;
use crate::units::did_you_mean;
use crate::units::kind::Kind;
use crate::units::quantity;

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
    pub(crate) text: Arc<String>,
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
        Ok(Self {
            text: Arc::new(text),
            name,
        })
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
        let (_, unit) = name_and_unit(header);
        format!("{} {}", figure(value / scale), unit.unwrap_or_default())
            .trim_end()
            .to_owned()
    }

    /// A problem of one value: "row 3: J = −2 kg m^2 `what`".
    pub(crate) fn problem(&self, index: usize, row: usize, what: &str) -> Problem {
        let value = self.get(index).and_then(|values| values.get(row));
        let header = self.headers.get(index).map_or("", |(header, _)| header);
        let (name, _) = name_and_unit(header);
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

/// Reads header and rows.
pub(crate) fn read(text: &str, format: &Format) -> Result<Columns> {
    let mut table = Table::read(text)?;
    let columns = header_columns(&table, format)?;
    let mut values: Vec<Option<Vec<f64>>> = vec![None; format.known.len()];
    let mut headers = vec![(String::new(), 1.0); format.known.len()];
    for (column, name) in columns.iter().zip(table.header()) {
        if let Some((index, scale)) = column {
            values[*index] = Some(Vec::new());
            headers[*index] = (name.to_owned(), *scale);
        }
    }
    let mut places = Vec::new();
    while let Some(row) = table.advance() {
        row?;
        let (number, place) = (places.len() + 1, table.row_place());
        for ((field, column), name) in table.row().iter().zip(&columns).zip(table.header()) {
            let Some((index, scale)) = *column else {
                continue;
            };
            let fault = |what: &str| {
                let [field, name] = [field, name].map(plain::cut);
                let message =
                    format!("row {number}: \"{field}\" in the column \"{name}\" is {what}");
                Problem::new(message).at(place.clone(), "this row")
            };
            let value = number_of(field, table.separator()).ok_or_else(|| {
                fault("not a finite number")
                    .help("write plain numbers with a decimal point and no units, such as 12.5; leave no cell empty")
            })? * scale;
            let kind = format.known[index].kind;
            if value.abs() > kind.largest {
                return Err(fault(&format!("too large for {}", kind.name)).help(format!(
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
fn number_of(field: &str, separator: char) -> Option<f64> {
    let number = if separator != ',' && field.contains(',') && !field.contains('.') {
        field.replacen(',', ".", 1).parse()
    } else {
        field.parse()
    };
    number.ok().filter(|value: &f64| value.is_finite())
}

/// For each column of the file, which of the format's it is and the size of its unit; `None` if it is passed over.
fn header_columns(table: &Table, format: &Format) -> Result<Vec<Option<(usize, f64)>>> {
    let help = format!(
        "the first line gives column names with units: {}",
        format.example
    );
    let mut columns: Vec<Option<(usize, f64)>> = Vec::new();
    for (at, whole) in table.header().iter().enumerate() {
        let fault =
            |message: String| Problem::new(message).at(table.title_place(at), "this column");
        let (name, _) = name_and_unit(whole);
        let is = |known: &Known| known.names.iter().any(|n| n.eq_ignore_ascii_case(name));
        let Some(index) = format.known.iter().position(is) else {
            if (format.ignored)(name) {
                columns.push(None);
                continue;
            }
            let names: Vec<&str> = format.known.iter().flat_map(|k| k.names).copied().collect();
            return Err(fault(format!("unknown column \"{}\"", plain::cut(whole)))
                .help(did_you_mean(name, &names) + &help));
        };
        let kind = format.known[index].kind;
        let (unit, _) = table.unit(at, &[kind], |unit| quantity::unit_of(unit, &[kind]))?;
        if columns.iter().flatten().any(|(other, _)| *other == index) {
            return Err(fault(format!("duplicate column \"{name}\""))
                .help(format!("remove one of the two; {help}")));
        }
        columns.push(Some((index, unit.scale)));
    }
    Ok(columns)
}
