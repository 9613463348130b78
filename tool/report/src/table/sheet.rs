//! A result of mixed cells, numbers and words, as a table, CSV or JSON.

use comfy_table::{ColumnConstraint, ContentArrangement};
use serde_json::{Map, Value, json};

use super::rows::csv_line;
use crate::table::output::{Format, text_table};
use jred_machine::number::rounding::significant;
use jred_sizing::study::cell::Cell;

/// Largest width of a table: wider cells are broken into lines.
pub const WIDEST: u16 = 120;

/// Named columns of cells under a title.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// Name and version of its form in JSON.
    pub schema: &'static str,
    /// Title, for tables and JSON.
    pub title: String,
    /// Names of the columns, with their units.
    pub columns: Vec<String>,
    /// The rows.
    pub rows: Vec<Vec<Cell>>,
    /// Columns and rows of a table for reading; `None`: the same ones.
    pub reading: Option<Reading>,
    /// Notes and warnings: below a table, and in JSON.
    pub notes: Vec<String>,
}

/// A table for reading.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// Its columns.
    pub columns: Vec<String>,
    /// Its rows.
    pub rows: Vec<Vec<Cell>>,
    /// How many of the first columns are not broken into lines.
    pub whole: usize,
}

/// Digits of a number in a table.
const DIGITS: i32 = 3;

impl Reading {
    /// As a table no wider than [`WIDEST`].
    pub fn table(columns: &[String], rows: &[Vec<Cell>], whole: usize) -> String {
        let mut table = text_table(columns);
        for row in rows {
            table.add_row(row.iter().map(|cell| match cell {
                Cell::Empty => String::new(),
                Cell::Number(x) => significant(*x, DIGITS),
                Cell::Text(text) => text.clone(),
            }));
        }
        table
            .set_content_arrangement(ContentArrangement::Dynamic)
            .set_width(WIDEST);
        for column in table.column_iter_mut().take(whole) {
            column.set_constraint(ColumnConstraint::ContentWidth);
        }
        let lines: Vec<String> = table
            .lines()
            .map(|line| line.trim_end().to_owned() + "\n")
            .collect();
        lines.concat()
    }
}

impl Sheet {
    /// The sheet in one of the formats.
    pub fn write(&self, format: Format) -> String {
        match format {
            Format::Table => {
                let table = match &self.reading {
                    Some(reading) => Reading::table(&reading.columns, &reading.rows, reading.whole),
                    None => Reading::table(&self.columns, &self.rows, 1),
                };
                let notes: Vec<String> =
                    self.notes.iter().map(|note| format!("{note}\n")).collect();
                let notes = notes.concat();
                format!("{}\n{table}{notes}", self.title)
            }
            Format::Csv => {
                let header = self.columns.iter().map(|name| Cell::from(name.as_str()));
                let rows = self.rows.iter().map(|row| csv_line(row.iter().cloned()));
                csv_line(header) + &rows.collect::<String>()
            }
            Format::Json => {
                let rows: Vec<Value> = self.rows.iter().map(|row| self.object(row)).collect();
                let value = json!({
                    "schema": self.schema,
                    "title": self.title,
                    "notes": self.notes,
                    "rows": rows,
                });
                format!("{value:#}\n")
            }
        }
    }

    fn object(&self, row: &[Cell]) -> Value {
        let pairs = self.columns.iter().zip(row);
        let object: Map<String, Value> = pairs
            .map(|(name, cell)| (name.clone(), cell.json()))
            .collect();
        Value::Object(object)
    }
}
