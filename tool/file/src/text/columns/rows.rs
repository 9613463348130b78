//! The rows of a file: its cells as numbers in SI units.

use std::ops::Range;

use super::cell::{NumberReader, unquoted};
use super::header::ColumnMatch;
use super::layout::Title;
use super::{CsvFault, Format};
use crate::number::rounding::figure;
use crate::plain;
use crate::text::csv::CsvTable;
use crate::text::problem::Problem;

/// The values of each column of the format, and the places of the rows.
type Rows = (Vec<Option<Vec<f64>>>, Vec<Range<usize>>);

/// Reads the current row, if there is one, and all rows after it.
pub(super) fn read(
    mut table: CsvTable,
    has_row: bool,
    columns: &[Option<ColumnMatch>],
    titles: &[Title],
    format: &Format,
) -> Result<Rows, CsvFault> {
    let mut values: Vec<Option<Vec<f64>>> = vec![None; format.known.len()];
    for (index, ..) in columns.iter().flatten() {
        values[*index] = Some(Vec::new());
    }
    let mut places = Vec::new();
    let mut numbers = NumberReader::default();
    let mut row = has_row.then_some(());
    while row.is_some() {
        // A spreadsheet leaves rows of separators below its table.
        if table.row().iter().all(|field| unquoted(field).is_empty()) {
            row = table.advance().transpose()?;
            continue;
        }
        let number = places.len() + 1;
        let cells = table.row().iter().zip(columns).zip(titles).enumerate();
        for (at, ((field, column), title)) in cells {
            let field = unquoted(field);
            let Some((index, _, scale)) = column else {
                if title.whole.is_empty() && !field.is_empty() {
                    return Err(Problem::new(format!("column {} has no title", at + 1))
                        .at(table.place(at), "a value in it")
                        .help("write a title above the column, or remove it")
                        .into());
                }
                continue;
            };
            let fault = |what: &str| {
                let [field, name] = [field, title.whole.as_str()].map(plain::cut);
                let message = if field.is_empty() {
                    format!("row {number}: the column \"{name}\" is empty")
                } else {
                    format!("row {number}: \"{field}\" in the column \"{name}\" is {what}")
                };
                Problem::new(message).at(table.place(at), "this cell")
            };
            let value = numbers.number(field, number, &table);
            let value = value.map_err(|(what, help)| fault(&what).help(help))? * scale;
            let kind = format.known[*index].kind;
            if value.abs() > kind.largest {
                return Err(fault(&format!("too large for {}", kind.name))
                    .help(format!(
                        "at most {} {} is accepted: check the number and the unit in the header",
                        figure(kind.largest / scale),
                        title.whole
                    ))
                    .into());
            }
            values[*index].get_or_insert_default().push(value);
        }
        places.push(table.row_place());
        row = table.advance().transpose()?;
    }
    Ok((values, places))
}
