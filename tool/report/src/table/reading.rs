//! A table of mixed cells, numbers and words, for reading.

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement};

use super::rows::csv_line;
use super::screen::Screen;
use crate::table::output::text_table;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::rounding::significant;
use jred_sizing::study::cell::Cell;

/// Largest width of a table; wider cells are wrapped.
pub const WIDEST: u16 = 120;

/// Least width of wrapped columns behind wide ones that are not wrapped, in a pipe or a file.
const LAST: u16 = 75;

/// Least width of wrapped columns on a screen.
const LEAST: u16 = 24;

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

    /// The class and the length (%) of the bar of a cell in a column of shares or used limits.
    pub(crate) fn bar(&self, column: usize, cell: &str) -> Option<(&'static str, f64)> {
        let name = self.columns.get(column)?;
        if !is_share(name) {
            return None;
        }
        let percent: f64 = cell
            .strip_suffix(" %")?
            .trim_start_matches("> ")
            .parse()
            .ok()?;
        let class = if percent < 0.0 { "less" } else { "more" };
        Some((class, percent.abs().min(100.0).round()))
    }

    /// The class of a verdict in a page, after a blank.
    pub(crate) fn colour(cell: &str) -> &'static str {
        let is = |verdict: RuleVerdict| cell == verdict.word();
        match cell {
            _ if is(RuleVerdict::Pass) => " ok",
            _ if is(RuleVerdict::Warn) => " warn",
            _ if is(RuleVerdict::Fail) => " bad",
            _ => "",
        }
    }

    /// Whether the cells of each column are numbers; beside shares also with a unit.
    pub(crate) fn are_numbers(&self) -> Vec<bool> {
        let in_units = self.columns.iter().any(|name| is_share(name));
        let is_number = |cell: &Cell| match cell {
            Cell::Empty | Cell::Number(_) => true,
            Cell::Text(text) => {
                text.is_empty()
                    || text == "–"
                    || in_units && is_quantity(text)
                    || text.parse::<f64>().is_ok()
            }
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
        // Content, two blanks and a gap.
        let whole = table.column_max_content_widths();
        let whole: u16 = whole.iter().take(self.whole).map(|width| width + 3).sum();
        let rest = if self.whole + 1 == self.columns.len() {
            LAST
        } else {
            0
        };
        table
            .set_content_arrangement(ContentArrangement::Dynamic)
            .set_width(
                width.unwrap_or(if rest > 0 || self.whole == self.columns.len() {
                    WIDEST.max(whole + rest)
                } else {
                    WIDEST
                }),
            );
        // On a narrow screen the last column would have no room.
        let is_narrow = rest > 0 && width.is_some_and(|width| width < whole + LEAST);
        let kept = if is_narrow { 1 } else { self.whole };
        for column in table.column_iter_mut().take(kept) {
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

/// Whether a column has used limits or shares of a whole.
fn is_share(name: &str) -> bool {
    name.ends_with("used") || name.starts_with("share")
}

/// Whether a text is a number with or without a unit: "42 %", "> 1000 %", "3.3 N m", "7200 per hour".
fn is_quantity(text: &str) -> bool {
    let text = text.trim_start_matches("> ").trim_start_matches("< ");
    let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
    let is_number = number.trim_end_matches('…').parse::<f64>().is_ok();
    let parts: Vec<&str> = unit.split(' ').collect();
    is_number && matches!(parts[..], [_] | ["N" | "kg" | "per", _])
}
