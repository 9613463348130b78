//! A table for a spreadsheet: numbers are numbers, and their unit is in the head.

use std::collections::BTreeSet;

use super::reading::{ColumnKind, Reading};
use jred_sizing::cell::Cell;

/// Heads and rows, one cell for each head.
#[derive(Debug)]
pub(crate) struct Grid {
    pub(crate) heads: Vec<String>,
    pub(crate) rows: Vec<Vec<Cell>>,
}

impl Grid {
    fn push(&mut self, head: String, cells: impl Iterator<Item = Cell>) {
        self.heads.push(head);
        for (row, cell) in self.rows.iter_mut().zip(cells) {
            row.push(cell);
        }
    }

    /// The values of a CSV; a column has numbers if each of its cells is a number or empty.
    pub(crate) fn of_csv(text: &str) -> Self {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let heads = reader.headers().cloned().unwrap_or_default();
        let rows = reader.records().filter_map(Result::ok);
        let all = Reading {
            columns: heads.iter().map(str::to_owned).collect(),
            rows: rows
                .map(|row| row.iter().map(Cell::from).collect())
                .collect(),
            ..Reading::default()
        };
        all.grid()
    }
}

impl Reading {
    /// The table with a column for the units where a column of quantities has several.
    pub(crate) fn grid(&self) -> Grid {
        let (heads, rows) = (Vec::new(), vec![Vec::new(); self.rows.len()]);
        let mut grid = Grid { heads, rows };
        for (k, name) in self.columns.iter().enumerate() {
            let cells = || {
                self.rows
                    .iter()
                    .map(move |row| row.get(k).unwrap_or(&Cell::Empty))
            };
            let parts: Vec<(Cell, Option<&str>)> = cells().map(quantity).collect();
            let units: BTreeSet<&str> = parts.iter().filter_map(|(_, unit)| *unit).collect();
            let is_number = |(cell, _): &(Cell, Option<&str>)| {
                cell.text().is_none_or(|text| text.ends_with("inf"))
            };
            let has_numbers = match self.kinds.get(k) {
                Some(ColumnKind::Words | ColumnKind::Verdict) => false,
                Some(ColumnKind::Quantity | ColumnKind::Share) => !units.is_empty(),
                None => parts.iter().all(is_number) && units.len() == 1,
            };
            match units.first() {
                Some(unit) if has_numbers => {
                    let in_head = units.len() == 1 && !unit.is_empty();
                    let end = if in_head {
                        format!(" [{unit}]")
                    } else {
                        String::new()
                    };
                    grid.push(
                        name.clone() + &end,
                        parts.iter().map(|(cell, _)| cell.clone()),
                    );
                }
                _ => grid.push(name.clone(), cells().cloned()),
            }
            if has_numbers && units.len() > 1 {
                let units = parts
                    .iter()
                    .map(|(_, unit)| unit.unwrap_or_default().into());
                grid.push(format!("{name}, unit"), units);
            }
        }
        grid
    }
}

/// A number and its unit; a cell without a number as it is. A dash is an empty cell.
fn quantity(cell: &Cell) -> (Cell, Option<&str>) {
    let text = match cell {
        Cell::Text(text) if !text.is_empty() && text != "–" => text,
        Cell::Number(_) => return (cell.clone(), Some("")),
        _ => return (Cell::Empty, None),
    };
    let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
    // Neither "007" nor "3 to 5 N" is a quantity.
    let is_key = number.len() > 1 && number.starts_with('0') && !number.starts_with("0.");
    let is_unit = unit.split(' ').all(|word| word.parse::<f64>().is_err());
    match number.parse::<f64>() {
        Ok(x) if x.is_finite() && is_unit && !is_key => (Cell::Number(x), Some(unit)),
        _ => (cell.clone(), None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(kinds: &[ColumnKind], columns: &[&str], rows: &[&[&str]]) -> Grid {
        let own = |text: &&str| (*text).to_owned();
        let reading = Reading {
            columns: columns.iter().map(own).collect(),
            kinds: kinds.to_vec(),
            rows: rows
                .iter()
                .map(|row| row.iter().map(|text| Cell::from(*text)).collect())
                .collect(),
            ..Reading::default()
        };
        reading.grid()
    }

    #[test]
    fn one_unit_goes_into_the_head_and_several_beside_the_numbers() {
        use ColumnKind::{Quantity, Share, Verdict, Words};
        let grid = table(
            &[Words, Quantity, Share, Verdict],
            &["rule", "figure", "used", "verdict"],
            &[
                &["1 N", "3.827 N m", "49 %", "ok"],
                &["2 N", "3375 rpm", "> 100 %", "FAIL"],
                &["3 N", "–", "", "not checked"],
                &["4 N", "1.248", "-9.5 %", "ok"],
            ],
        );
        assert_eq!(
            grid.heads,
            ["rule", "figure", "figure, unit", "used [%]", "verdict"]
        );
        let cells = |column: usize| grid.rows.iter().map(move |row| row[column].clone());
        let n = Cell::Number;
        let numbers = [n(3.827), n(3375.0), Cell::Empty, n(1.248)];
        assert!(cells(1).eq(numbers));
        assert!(cells(2).eq(["N m", "rpm", "", ""].map(Cell::from)));
        let used = [n(49.0), Cell::from("> 100 %"), Cell::Empty, n(-9.5)];
        assert!(cells(3).eq(used));
        // Words that begin with a number stay words.
        assert!(cells(0).eq(["1 N", "2 N", "3 N", "4 N"].map(Cell::from)));
    }

    /// Without kinds a column has numbers only if every cell is one, in one unit.
    #[test]
    fn a_column_of_a_single_unit_has_numbers() {
        let rows: [&[&str]; 2] = [
            &["2 s", "2 s", "3 to 5 N", "7"],
            &["0.5 s", "90 deg", "4 N", "x"],
        ];
        let grid = table(&[], &["duration", "b", "c", "d"], &rows);
        assert_eq!(grid.heads, ["duration [s]", "b", "c", "d"]);
        assert_eq!(grid.rows[1][0], Cell::Number(0.5));
        assert_eq!(grid.rows[0][1..], ["2 s", "3 to 5 N", "7"].map(Cell::from));
    }

    #[test]
    fn a_csv_keeps_keys_and_infinite_numbers_as_texts() {
        let grid = Grid::of_csv("key,a [N],b\n007,1e300,1\n12,,inf\n");
        assert_eq!(grid.heads, ["key", "a [N]", "b"]);
        let [first, second] = &grid.rows[..] else {
            panic!("{grid:?}");
        };
        assert_eq!(
            first[..],
            [Cell::from("007"), Cell::Number(1e300), Cell::Number(1.0)]
        );
        assert_eq!(
            second[..],
            [Cell::from("12"), Cell::Empty, Cell::from("inf")]
        );
    }
}
