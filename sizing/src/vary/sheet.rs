//! A result of mixed cells, numbers and words, as a table, CSV or JSON.

use serde_json::{Map, Value, json};

use super::rows::{Cell, csv_line};
use crate::output::{Format, short, text_table};

/// Named columns of cells under a title.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// Name and version of its form in JSON.
    pub schema: &'static str,
    /// What it is, for tables and JSON.
    pub title: String,
    /// Names of the columns, with their units.
    pub columns: Vec<String>,
    /// The rows.
    pub rows: Vec<Vec<Cell>>,
    /// What is to be minded: below a table, and in JSON.
    pub notes: Vec<String>,
}

impl Sheet {
    /// The sheet in one of the formats.
    pub fn write(&self, format: Format) -> String {
        match format {
            Format::Table => {
                let mut table = text_table(&self.columns);
                for row in &self.rows {
                    table.add_row(row.iter().map(|cell| match cell {
                        Cell::Empty => String::new(),
                        Cell::Number(x) => short(*x),
                        Cell::Text(text) => text.clone(),
                    }));
                }
                let notes: Vec<String> =
                    self.notes.iter().map(|note| format!("{note}\n")).collect();
                let notes = notes.concat();
                format!("{}\n{table}\n{notes}", self.title)
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
