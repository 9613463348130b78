//! A result that is a table: named columns of cells, with notes.

use serde_json::{Map, Value, json};

use super::Answer;
use crate::table::reading::Reading;
use jred_sizing::cell::Cell;

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
    /// Number of leading notes that are above the table.
    pub lead: usize,
}

impl Sheet {
    /// The sheet as an answer: the table for reading with the notes, all columns as CSV and JSON.
    pub fn answer(self) -> Answer<'static> {
        let rows: Vec<Value> = self.rows.iter().map(|row| self.object(row)).collect();
        let data = json!({ "notes": self.notes, "rows": rows });
        let all = Reading {
            columns: self.columns,
            rows: self.rows,
            whole: 1,
            ..Reading::default()
        };
        let mut answer = Answer::of_map(self.schema, self.title, data);
        answer.csv(all.csv());
        let (lead, notes) = self.notes.split_at(self.lead);
        for note in lead {
            answer.sentence(note);
        }
        answer.table(self.reading.unwrap_or(all));
        for note in notes {
            answer.sentence(note);
        }
        answer
    }

    fn object(&self, row: &[Cell]) -> Value {
        let pairs = self.columns.iter().zip(row);
        let object: Map<String, Value> = pairs
            .map(|(name, cell)| (name.clone(), cell.json()))
            .collect();
        Value::Object(object)
    }
}
