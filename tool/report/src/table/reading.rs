//! A table of mixed cells, numbers and words, for reading.

use std::borrow::Cow;

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, Width};

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

/// Longest word that is kept whole.
const WORD: u16 = 16;

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
    /// A table with these columns and rows, whose first `whole` columns are not wrapped.
    pub(crate) fn new(
        columns: impl IntoIterator<Item = impl Into<String>>,
        rows: impl IntoIterator<Item = Vec<Cell>>,
        whole: usize,
    ) -> Self {
        Self {
            columns: columns.into_iter().map(Into::into).collect(),
            rows: rows.into_iter().collect(),
            whole,
            ..Self::default()
        }
    }

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

    /// Least width on paper in characters: numbers and words are not broken, bars and texts of several words are not too narrow.
    pub(crate) fn least_width(&self) -> usize {
        const BAR: usize = 7;
        const TEXT: usize = 18;
        const GAP: usize = 2;
        let length = |text: &str| text.chars().count();
        let longest = |text: &str| text.split_whitespace().map(length).max().unwrap_or(0);
        let numbers = self.are_numbers();
        let bar = |k| usize::from(self.kind(k) == Some(ColumnKind::Share)) * BAR;
        let heads = self.columns.iter().enumerate();
        let mut widths: Vec<usize> = heads.map(|(k, head)| longest(head).max(bar(k))).collect();
        for row in self.cells() {
            for ((cell, width), is_number) in row.iter().zip(&mut widths).zip(&numbers) {
                let most = if *is_number { usize::MAX } else { TEXT };
                *width = longest(cell).max(length(cell).min(most)).max(*width);
            }
        }
        widths.iter().map(|width| width + GAP).sum()
    }

    /// Header and rows, every digit.
    pub(crate) fn csv(&self) -> String {
        let header = self.columns.iter().map(|name| Cell::from(name.as_str()));
        let rows = self.rows.iter().map(|row| csv_line(row.iter().cloned()));
        csv_line(header) + &rows.collect::<String>()
    }

    /// Characters of the longest word in a column.
    fn longest_word(&self, column: usize) -> u16 {
        let header = self.columns.get(column).cloned();
        let cells = self.cells().filter_map(|row| row.into_iter().nth(column));
        let cells = header.into_iter().chain(cells);
        let longest = cells.filter_map(|cell| {
            let words = cell.split_whitespace().map(|word| word.chars().count());
            words.max()
        });
        longest
            .max()
            .map_or(0, |n| u16::try_from(n).unwrap_or(u16::MAX))
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
        let widest = width.unwrap_or(WIDEST.max(least));
        table
            .set_content_arrangement(ContentArrangement::Dynamic)
            .set_width(widest);
        // Where there is room, words are not broken.
        let words: Vec<u16> = (0..self.columns.len())
            .map(|column| self.longest_word(column).min(WORD))
            .collect();
        let full = table.column_max_content_widths();
        let fits = |kept: &usize| {
            let widths = full.iter().take(*kept).chain(words.iter().skip(*kept));
            widths.map(|width| u32::from(*width) + 3).sum::<u32>() <= u32::from(widest)
        };
        let unbroken = [kept, kept.min(1), 0].into_iter().find(fits);
        let kept = match unbroken {
            Some(kept) => kept,
            None if whole * 3 > widest * 2 => 0,
            None => kept,
        };
        for (k, (column, word)) in table.column_iter_mut().zip(words).enumerate() {
            if k < kept {
                column.set_constraint(ColumnConstraint::ContentWidth);
            } else if unbroken.is_some() {
                column.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(word + 2)));
            }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A table like that of `jred size --motion best`.
    fn drives() -> Reading {
        let columns = [
            "drive, each with its own motion",
            "rated power [W]",
            "RMS torque, file's motion [N m]",
            "saving [%]",
            "rules",
        ];
        let row = [
            "sgm7g-03a-brake + peii050-007 on sgd7s-3r8a",
            "308",
            "0.361",
            "50.8",
            "satisfied",
        ];
        Reading {
            columns: columns.map(str::to_owned).to_vec(),
            rows: vec![row.map(Cell::from).to_vec(); 2],
            whole: 1,
            ..Reading::default()
        }
    }

    /// On any screen the lines fit, and where the words of a row fit side by side none is broken.
    #[test]
    fn short_words_are_not_broken() {
        for width in [40, 50, 60, 70, 80, 100, 120] {
            let text = drives().text(Screen { width: Some(width) });
            let widest = text.lines().map(|line| line.chars().count()).max();
            assert!(
                widest.is_some_and(|widest| widest <= width),
                "{width}\n{text}"
            );
            if width >= 70 {
                for word in [
                    "satisfied",
                    "saving",
                    "rated",
                    "sgm7g-03a-brake",
                    "peii050-007",
                ] {
                    assert!(text.contains(word), "{word} at {width}\n{text}");
                }
            }
        }
        assert!(drives().text(Screen { width: None }).contains("satisfied"));
    }
}
