//! A table of mixed cells, numbers and words, for reading.

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement};

use super::rows::csv_line;
use super::screen::Screen;
use crate::table::output::text_table;
use jred_file::number::rounding::significant;
use jred_sizing::study::cell::Cell;

/// Largest width of a table; wider cells are wrapped.
pub const WIDEST: u16 = 120;

/// Digits of a number in a table.
const DIGITS: i32 = 3;

/// A table for reading.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// Its columns.
    pub columns: Vec<String>,
    /// Its rows.
    pub rows: Vec<Vec<Cell>>,
    /// Number of leading columns that are not wrapped.
    pub whole: usize,
}

impl Reading {
    /// A table no wider than [`WIDEST`].
    pub fn table(columns: &[String], rows: &[Vec<Cell>], whole: usize) -> String {
        let (columns, rows) = (columns.to_vec(), rows.to_vec());
        let table = Self {
            columns,
            rows,
            whole,
        };
        table.text(Screen::default())
    }

    /// The rows as text for reading.
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

    /// A table for a screen, no wider than [`WIDEST`] elsewhere.
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
