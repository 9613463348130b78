//! A result of mixed cells, numbers and words.

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement};
use serde_json::{Map, Value, json};

use super::rows::csv_line;
use crate::answer::Answer;
use crate::answer::screen::Screen;
use crate::table::output::text_table;
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
    /// The number of notes, from the first one, that are above the table.
    pub lead: usize,
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
        let (columns, rows) = (columns.to_vec(), rows.to_vec());
        let table = Self {
            columns,
            rows,
            whole,
        };
        table.text(Screen::default())
    }

    /// The rows as a person reads them.
    pub(crate) fn cells(&self) -> impl Iterator<Item = Vec<String>> {
        self.rows.iter().map(|row| {
            let cells = row.iter().map(|cell| match cell {
                Cell::Empty => String::new(),
                Cell::Number(x) => significant(*x, DIGITS),
                Cell::Text(text) => text.clone(),
            });
            cells.collect()
        })
    }

    /// Whether the cells of each column are numbers.
    pub(crate) fn are_numbers(&self) -> Vec<bool> {
        let is_number = |cell: &Cell| match cell {
            Cell::Empty | Cell::Number(_) => true,
            Cell::Text(text) => text.is_empty() || text == "–" || text.parse::<f64>().is_ok(),
        };
        let column = |k: usize| {
            let cells = || self.rows.iter().filter_map(|row| row.get(k));
            cells().all(is_number) && cells().any(|cell| !matches!(cell, Cell::Empty))
        };
        (0..self.columns.len()).map(column).collect()
    }

    /// Header and rows, every digit.
    pub(crate) fn csv(&self) -> String {
        let header = self.columns.iter().map(|name| Cell::from(name.as_str()));
        let rows = self.rows.iter().map(|row| csv_line(row.iter().cloned()));
        csv_line(header) + &rows.collect::<String>()
    }

    /// As a table for a screen, no wider than [`WIDEST`] elsewhere.
    pub(crate) fn text(&self, screen: Screen) -> String {
        let mut table = text_table(&self.columns);
        table.add_rows(self.cells());
        let width = screen.width.and_then(|width| u16::try_from(width).ok());
        table
            .set_content_arrangement(ContentArrangement::Dynamic)
            .set_width(width.unwrap_or(WIDEST));
        for column in table.column_iter_mut().take(self.whole) {
            column.set_constraint(ColumnConstraint::ContentWidth);
        }
        for (column, right) in table.column_iter_mut().zip(self.are_numbers()) {
            if right {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        let lines: Vec<String> = table
            .lines()
            .map(|line| line.trim_end().to_owned() + "\n")
            .collect();
        lines.concat()
    }
}

impl Sheet {
    /// As an answer: the table for reading with the notes, all columns as CSV and JSON.
    pub fn answer(self) -> Answer<'static> {
        let rows: Vec<Value> = self.rows.iter().map(|row| self.object(row)).collect();
        let data = json!({ "notes": self.notes, "rows": rows });
        let all = Reading {
            columns: self.columns,
            rows: self.rows,
            whole: 1,
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
