//! A table of mixed cells, numbers and words, for reading.

use std::borrow::Cow;

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement};

use super::rows::csv_line;
use super::screen::Screen;
use crate::table::output::text_table;
use crate::units;
use jred_file::model::rules::RuleVerdict;
use jred_file::number::rounding::significant;
use jred_sizing::cell::Cell;

/// Largest width of a table; wider cells are wrapped.
const WIDEST: u16 = 120;

/// Least width of the only wrapped column on a screen.
const LEAST: u16 = 24;

/// Digits of a number in a table.
const DIGITS: i32 = 3;

/// The kind of a column's cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ColumnKind {
    /// Words.
    Words,
    /// Numbers, with or without a unit.
    Quantity,
    /// Per cent of a whole or of a limit: a page draws a bar.
    Share,
    /// Words of a [`RuleVerdict`], which a page colours, and the bars of the row.
    Verdict,
}

/// A table for reading.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// Its columns.
    pub columns: Vec<String>,
    /// Their kinds; if empty, a column has numbers if every cell is a number.
    pub(crate) kinds: Vec<ColumnKind>,
    /// Its rows.
    pub rows: Vec<Vec<Cell>>,
    /// Number of leading columns that are not wrapped.
    pub whole: usize,
    /// Least width of the only wrapped column in a pipe or a file.
    pub(crate) last: u16,
}

impl Reading {
    /// The table in the units of results. A row without units in the header may have one in its first cell.
    pub(crate) fn shown(&self) -> Cow<'_, Self> {
        if units::is_si() {
            return Cow::Borrowed(self);
        }
        let titles: Vec<_> = self.columns.iter().map(|name| units::title(name)).collect();
        let rows = self.rows.iter().map(|row| {
            let label = match row.first() {
                Some(Cell::Text(words)) => units::title(words),
                _ => ("".into(), None),
            };
            let cells = row.iter().enumerate().map(|(k, cell)| {
                let own = titles.get(k).and_then(|(_, own)| *own).or(label.1);
                match (cell, own) {
                    (Cell::Number(x), Some(own)) => Cell::Number(own.of(*x)),
                    (Cell::Text(_), _) if k == 0 && label.1.is_some() => {
                        Cell::Text(label.0.to_string())
                    }
                    (Cell::Text(words), own) => Cell::Text(units::cell(words, own)),
                    _ => cell.clone(),
                }
            });
            cells.collect()
        });
        Cow::Owned(Self {
            rows: rows.collect(),
            columns: titles.iter().map(|(name, _)| name.to_string()).collect(),
            ..self.clone()
        })
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

    fn kind(&self, column: usize) -> Option<ColumnKind> {
        self.kinds.get(column).copied()
    }

    /// The class and the length (%) of the bar of a cell: by the verdict of its row, else by its sign.
    pub(crate) fn bar(&self, row: &[String], column: usize) -> Option<(&'static str, f64)> {
        if self.kind(column) != Some(ColumnKind::Share) {
            return None;
        }
        let number = row[column].strip_suffix(" %")?.trim_start_matches("> ");
        let percent: f64 = number.parse().ok()?;
        let verdict = (0..row.len()).find(|k| self.kind(*k) == Some(ColumnKind::Verdict));
        let class = match verdict.map(|k| self.colour(row, k)) {
            Some(class) => class,
            None if percent < 0.0 => "less",
            None => "more",
        };
        Some((class, percent.abs().min(100.0).round()))
    }

    /// The class of a cell with a verdict.
    pub(crate) fn colour(&self, row: &[String], column: usize) -> &'static str {
        if self.kind(column) != Some(ColumnKind::Verdict) {
            return "";
        }
        match &row[column] {
            cell if cell == RuleVerdict::Pass.word() => "ok",
            cell if cell == RuleVerdict::Warn.word() => "warn",
            cell if cell == RuleVerdict::Fail.word() => "bad",
            _ => "",
        }
    }

    /// Whether each column has numbers.
    pub(crate) fn are_numbers(&self) -> Vec<bool> {
        if !self.kinds.is_empty() {
            let is_number =
                |kind: &ColumnKind| matches!(kind, ColumnKind::Quantity | ColumnKind::Share);
            return self.kinds.iter().map(is_number).collect();
        }
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
        // Content, two blanks and a gap.
        let whole = table.column_max_content_widths();
        let whole: u16 = whole.iter().take(self.whole).map(|width| width + 3).sum();
        let least = match self.columns.len() - self.whole {
            0 => whole,
            1 if width.is_none() => whole + self.last,
            1 => whole + LEAST,
            _ => 0,
        };
        // On a narrow screen the only wrapped column would have no room.
        let is_narrow = width.is_some_and(|width| width < least);
        let kept = if is_narrow { 1 } else { self.whole };
        table
            .set_content_arrangement(ContentArrangement::Dynamic)
            .set_width(width.unwrap_or(WIDEST.max(least)));
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
