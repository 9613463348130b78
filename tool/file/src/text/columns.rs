//! CSV files of other programs: columns of numbers with units in the header. A comma can be the decimal point if it does not separate cells. Every
//! fault is shown in the CSV file.

mod cell;
mod derivative;
mod header;
mod layout;
mod rows;
mod structured_text;

use std::ops::Range;
use std::result::Result;
use std::sync::Arc;

use ::csv::StringRecord;

use super::csv::{CsvTable, header_place, name_and_unit};
use super::file::Files;
use super::item::Item;
use super::problem::{self, Problem};
use crate::number::rounding::figure;
use crate::plain;
use crate::units::kind::Kind;
use cell::unquoted;
use header::check_first_lines;
use layout::Title;

pub(crate) use layout::{IN_NEWTON_METRES, Layout, share};

/// The largest CSV file (bytes).
const MAX_SIZE: u64 = 64 << 20;

/// A column that a file can have.
#[derive(Clone, Copy)]
pub(crate) struct ColumnSpec {
    /// Its possible names: the usual one first, the one of the machine file's `columns` last. Case does not matter.
    pub(crate) names: &'static [&'static str],
    /// The kind of quantity.
    pub(crate) kind: &'static Kind,
}

impl ColumnSpec {
    /// Whether it has this name.
    pub(crate) fn is(&self, name: &str) -> bool {
        self.names.iter().any(|own| own.eq_ignore_ascii_case(name))
    }

    /// Its name in the machine file.
    pub(crate) fn key(&self) -> &'static str {
        self.names.last().copied().unwrap_or_default()
    }
}

/// A column with these names and this kind of quantity.
pub(crate) const fn known(names: &'static [&'static str], kind: &'static Kind) -> ColumnSpec {
    ColumnSpec { names, kind }
}

/// A fault, and the file in which it is shown.
pub(crate) enum CsvFault {
    /// In the CSV file.
    InFile(Problem),
    /// In the machine file.
    InMachine(Problem),
}

impl From<Problem> for CsvFault {
    fn from(problem: Problem) -> Self {
        Self::InFile(problem)
    }
}

/// The columns that a kind of file can have.
pub(crate) struct Format<'f> {
    /// The columns.
    pub(crate) known: &'f [ColumnSpec],
    /// Whether a column with this other name is ignored.
    pub(crate) ignored: fn(&str) -> bool,
    /// Whether a column is ignored whose unit none of these columns can have: a log has more than the motion, but a force that is not read is a fault.
    pub(crate) of_log: bool,
    /// A header to suggest.
    pub(crate) example: &'f str,
    /// Smallest number of rows.
    pub(crate) min_rows: usize,
}

/// The text of the file that `item` names.
pub(crate) struct CsvFile {
    pub(crate) text: Arc<String>,
    name: String,
}

impl CsvFile {
    pub(crate) fn open(item: &Item, example: &str, files: &dyn Files) -> problem::Result<Self> {
        let file = item.text(example)?;
        let text = files.text(file, MAX_SIZE).map_err(|fault| {
            item.problem(&format!("cannot be read: {}", fault.message), "this file")
                .help(fault.help)
        })?;
        if text.trim().is_empty() {
            return Err(item.problem("is an empty file", "this file").help(
                "the first line gives column names with units; one row for each point follows",
            ));
        }
        let name = files.shown(file);
        Ok(Self {
            text: Arc::new(text),
            name,
        })
    }

    /// The fault as a problem shown in its file.
    pub(crate) fn shows(&self, fault: impl Into<CsvFault>) -> Problem {
        match fault.into() {
            CsvFault::InFile(problem) => problem.in_file(&self.name, &self.text),
            CsvFault::InMachine(problem) => problem,
        }
    }
}

/// The columns of a file in SI units.
pub(crate) struct Columns {
    /// The values of each column of the format.
    values: Vec<Option<Vec<f64>>>,
    /// For each column its name and unit in the file, and the size of the unit.
    headers: Vec<(String, f64)>,
    /// Places of the rows.
    places: Vec<Range<usize>>,
    /// Titles of the columns that are passed over without being named in the machine file.
    passed_over: Vec<String>,
}

impl Columns {
    /// The values of column `index` of the format, if the file has it.
    pub(crate) fn get(&self, index: usize) -> Option<&[f64]> {
        self.values.get(index)?.as_deref()
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.places.len()
    }

    /// The problem of a column that the header lacks: the header that is expected, and the columns that are passed over.
    pub(crate) fn lacks(&self, message: &str, text: &str, example: &str) -> Problem {
        let titles = self.passed_over.iter().map(|title| plain::cut(title));
        let titles: Vec<String> = titles.collect();
        let passed = match titles.as_slice() {
            [] => String::new(),
            titles => format!("; not read: {}", problem::quoted(titles)),
        };
        let help = format!("the first line gives column names with units: {example}{passed}");
        Problem::new(message)
            .at(header_place(text), "header")
            .help(help)
    }

    /// Checks the number of rows of the file `text`.
    pub(crate) fn check_rows(&self, least: usize, text: &str) -> problem::Result<()> {
        let rows = self.rows();
        if rows >= least {
            return Ok(());
        }
        let end = text.trim_end().len();
        let noun = if rows == 1 { "row" } else { "rows" };
        Err(Problem::new(format!(
            "the file has {rows} {noun}, but needs at least {least}"
        ))
        .at(end..end, "ends here")
        .help("add a row for each point"))
    }

    /// The place of row `row`, counted from 0.
    pub(crate) fn place(&self, row: usize) -> Range<usize> {
        self.places.get(row).cloned().unwrap_or_default()
    }

    /// Adds the column `index`, the column `from` times a factor (SI). It is shown with header and values of `from`.
    pub(crate) fn derive(&mut self, index: usize, from: usize, factor: f64) {
        let values = self.get(from).unwrap_or_default();
        let values = values.iter().map(|value| value * factor).collect();
        let header = self.headers.get(from).cloned().unwrap_or_default();
        if let (Some(own), Some(place)) = (self.headers.get_mut(index), self.values.get_mut(index))
        {
            *own = (header.0, header.1 * factor);
            *place = Some(values);
        }
    }

    /// The unit of a column in the file.
    pub(crate) fn unit(&self, index: usize) -> Option<&str> {
        let (header, _) = self.headers.get(index)?;
        name_and_unit(header).1
    }

    /// A value in the unit of its column.
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

    /// Checks that the values of a column increase from row to row.
    pub(crate) fn check_rising(&self, index: usize, what: &str, help: &str) -> problem::Result<()> {
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

/// Reads the header and the rows of a file with this layout.
pub(crate) fn read(text: &str, format: &Format, layout: &Layout) -> Result<Columns, CsvFault> {
    let whole = text;
    let text = &*layout.without_skipped(text);
    let points = structured_text::points(text)?;
    let text = points.as_deref().unwrap_or(text);
    let mut table = match (&layout.titles, &points) {
        (Some((titles, _)), _) => CsvTable::titled(text, titles),
        (None, Some(_)) => CsvTable::titled(text, &structured_text::TITLES.map(str::to_owned)),
        (None, None) => CsvTable::read(text)?,
    };
    let titles = table
        .header()
        .iter()
        .map(|title| Title::of(unquoted(title)));
    let titles: Vec<Title> = titles
        .map(|title| title.underscored(format.known))
        .collect();
    if layout.titles.is_none() && points.is_none() && !titles.is_empty() {
        check_first_lines(text, &titles, format, layout)?;
    }
    let mut first = table.advance().transpose()?;
    let units = first.and_then(|()| units_below(&titles, table.row()));
    if let (Some(()), Some((titles, item))) = (first, &layout.titles)
        && table.row().len() != titles.len()
    {
        let what = format!(
            "gives {} titles, but the file has {} columns",
            titles.len(),
            table.row().len()
        );
        return Err(CsvFault::InMachine(
            item.problem(&what, "titles")
                .help("give one title for each column of the file"),
        ));
    }
    if units.is_some() {
        first = table.advance().transpose()?;
    }
    let titles = units.unwrap_or(titles);
    let columns = header::columns(&table, &titles, format, layout)?;
    let mut headers = vec![(String::new(), 1.0); format.known.len()];
    for (column, title) in columns.iter().zip(&titles) {
        if let Some((index, unit, scale)) = column {
            let unit = unit.as_ref().filter(|unit| *unit != "1");
            let unit = unit.map_or_else(String::new, |unit| format!(" [{unit}]"));
            headers[*index] = (format!("{}{unit}", title.name), *scale);
        }
    }
    let (values, places) = rows::read(table, first.is_some(), &columns, &titles, format)?;
    let passed = titles.iter().zip(&columns);
    let passed = passed.filter(|(title, column)| column.is_none() && !title.whole.is_empty());
    let columns = Columns {
        values,
        headers,
        places,
        passed_over: match layout.mapped {
            Some(_) => Vec::new(),
            None => passed.map(|(title, _)| title.whole.clone()).collect(),
        },
    };
    columns.check_rows(format.min_rows, whole)?;
    Ok(columns)
}

/// Whether a file has the column `known`: by its name, or by name and unit if `other` can have the same name.
pub(crate) fn has(
    text: &str,
    layout: &Layout,
    known: &ColumnSpec,
    other: &ColumnSpec,
) -> Result<bool, CsvFault> {
    let text = &*layout.without_skipped(text);
    let titles: Vec<Title> = if let Some((titles, _)) = &layout.titles {
        titles.iter().map(|title| Title::of(title)).collect()
    } else {
        let table = CsvTable::read(text)?;
        let titles = table.header().iter();
        titles.map(|title| Title::of(unquoted(title))).collect()
    };
    let mapped = layout.mapped.iter().flatten();
    let named = mapped.map(|mapped| (mapped.name, &mapped.title));
    let all = titles.iter().map(|title| (title.name.as_str(), title));
    let measured = |title: &Title| {
        let titled = titles.iter().find(|own| own.is_meant_by(title));
        let unit = title.unit.as_ref().or_else(|| titled?.unit.as_ref());
        unit.is_some_and(|unit| layout.scale(Some(unit), known.kind).is_ok())
    };
    Ok(named
        .chain(all)
        .any(|(name, title)| known.is(name) && (!other.is(name) || measured(title))))
}

/// The titles with units from the line below them, for example `s;deg` or `[s],[deg]`; `None` if it is not a line of units.
fn units_below(titles: &[Title], row: &StringRecord) -> Option<Vec<Title>> {
    let unit = |field: &str| -> String {
        unquoted(field)
            .trim_matches(['[', ']', '(', ')'])
            .trim()
            .to_owned()
    };
    let units: Vec<String> = row.iter().map(unit).collect();
    let is_unit = |text: &String| text.is_empty() || layout::is_unit(text);
    let bare = titles.iter().all(|title| title.unit.is_none());
    let numbers = units
        .iter()
        .all(|text| text.is_empty() || text.parse::<f64>().is_ok());
    if !bare || numbers || !units.iter().all(is_unit) {
        return None;
    }
    let with_unit = |(title, unit): (&Title, String)| Title {
        unit: (!unit.is_empty()).then_some(unit),
        ..title.clone()
    };
    Some(titles.iter().zip(units).map(with_unit).collect())
}
