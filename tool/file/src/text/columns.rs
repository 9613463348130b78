//! CSV files of other programs: columns of numbers with units in the header. A comma can be the decimal point if it does not separate cells. Every
//! fault is shown in the CSV file.

mod header;
mod layout;

use std::ops::Range;
use std::result::Result;
use std::sync::Arc;

use ::csv::StringRecord;

use super::csv::{CsvTable, name_and_unit, number_of};
use super::file::Files;
use super::item::Item;
use super::problem::{self, Problem};
use crate::number::rounding::figure;
use crate::plain;
use crate::units::kind::Kind;
use header::check_first_lines;
use layout::Title;

pub(crate) use layout::Layout;

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

    /// The place of row `row`, counted from 0.
    pub(crate) fn place(&self, row: usize) -> Range<usize> {
        self.places.get(row).cloned().unwrap_or_default()
    }

    /// Adds the column `index` computed from column `from`: its values (SI). It is shown with the header of `from`, in a unit of the size `scale`.
    pub(crate) fn derive(&mut self, index: usize, (from, scale): (usize, f64), values: Vec<f64>) {
        let header = self
            .headers
            .get(from)
            .map_or_else(String::new, |(header, _)| header.clone());
        if let (Some(own), Some(place)) = (self.headers.get_mut(index), self.values.get_mut(index))
        {
            *own = (header, scale);
            *place = Some(values);
        }
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
    let mut table = match &layout.titles {
        Some((titles, _)) => CsvTable::titled(text, titles),
        None => CsvTable::read(text)?,
    };
    let titles = table
        .header()
        .iter()
        .map(|title| Title::of(unquoted(title)));
    let titles: Vec<Title> = titles
        .map(|title| title.underscored(format.known))
        .collect();
    if layout.titles.is_none() && !titles.is_empty() {
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
    let mut values: Vec<Option<Vec<f64>>> = vec![None; format.known.len()];
    let mut headers = vec![(String::new(), 1.0); format.known.len()];
    for (column, title) in columns.iter().zip(&titles) {
        if let Some((index, unit, scale)) = column {
            values[*index] = Some(Vec::new());
            let unit = unit.as_ref().filter(|unit| *unit != "1");
            let unit = unit.map_or_else(String::new, |unit| format!(" [{unit}]"));
            headers[*index] = (format!("{}{unit}", title.name), *scale);
        }
    }
    let mut places = Vec::new();
    while first.is_some() {
        let (number, place) = (places.len() + 1, table.row_place());
        for ((field, column), title) in table.row().iter().zip(&columns).zip(&titles) {
            let Some((index, _, scale)) = column else {
                continue;
            };
            let (index, scale) = (*index, *scale);
            let field = unquoted(field);
            let fault = |what: &str| {
                let [field, name] = [field, title.whole.as_str()].map(plain::cut);
                let message = if field.is_empty() {
                    format!("row {number}: the column \"{name}\" is empty")
                } else {
                    format!("row {number}: \"{field}\" in the column \"{name}\" is {what}")
                };
                Problem::new(message).at(place.clone(), "this row")
            };
            let value = number_of(field, table.separator()).ok_or_else(|| {
                fault("not a finite number")
                    .help("write plain numbers with a decimal point and no units, such as 12.5; leave no cell empty")
            })? * scale;
            let kind = format.known[index].kind;
            if value.abs() > kind.largest {
                return Err(fault(&format!("too large for {}", kind.name))
                    .help(format!(
                        "at most {} {} is accepted: check the number and the unit in the header",
                        figure(kind.largest / scale),
                        title.whole
                    ))
                    .into());
            }
            values[index].get_or_insert_default().push(value);
        }
        places.push(place);
        first = table.advance().transpose()?;
    }
    if places.len() < format.min_rows {
        let end = whole.trim_end().len();
        return Err(Problem::new(format!(
            "the file has {} {}, but needs at least {}",
            places.len(),
            if places.len() == 1 { "row" } else { "rows" },
            format.min_rows
        ))
        .at(end..end, "ends here")
        .help("add a row for each point")
        .into());
    }
    Ok(Columns {
        values,
        headers,
        places,
    })
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

/// A field without its quotes, which a blank before them made part of it.
fn unquoted(field: &str) -> &str {
    let inner = field
        .strip_prefix('"')
        .and_then(|field| field.strip_suffix('"'));
    inner.map_or(field, str::trim)
}
