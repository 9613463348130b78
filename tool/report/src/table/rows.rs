//! Rows of a study: how they are written, line by line, and read back.

use serde_json::{Map, Value};

use crate::table::output::text_table;
use jred_machine::number::csv;
use jred_machine::number::rounding::rounded;
use jred_sizing::study::cell::Cell;

jred_machine::words! {
    /// How rows are written.
    pub enum RowFormat default Table {
        /// An aligned table for reading, when all rows are there.
        Table = "table",
        /// Comma-separated, every digit.
        Csv = "csv",
        /// JSON lines: an object a row, every digit.
        Json = "json",
    }
}

impl RowFormat {
    /// Prefix of the header object in a file.
    pub const fn mark(self) -> &'static str {
        match self {
            Self::Csv => "# ",
            _ => "",
        }
    }

    /// The line that names the columns, in forms that have one.
    pub fn names(self, columns: &[String]) -> String {
        match self {
            Self::Csv => {
                let row = columns.iter().map(|name| Cell::from(name.as_str()));
                csv_line(std::iter::once(Cell::from("row")).chain(row))
            }
            _ => String::new(),
        }
    }

    /// Row number `index` as a line.
    pub fn line(self, columns: &[String], index: u64, cells: &[Cell]) -> String {
        match self {
            Self::Json => {
                let mut map = Map::new();
                map.insert("row".to_owned(), index.into());
                for (name, cell) in columns.iter().zip(cells) {
                    map.insert(name.clone(), cell.json());
                }
                Value::Object(map).to_string() + "\n"
            }
            _ => csv_line(
                std::iter::once(Cell::Text(index.to_string())).chain(cells.iter().cloned()),
            ),
        }
    }

    /// The number of a line's row; `None`: the line is no row.
    pub fn index(self, line: &str) -> Option<u64> {
        match self {
            Self::Json => line
                .strip_prefix("{\"row\":")?
                .split_once([',', '}'])?
                .0
                .parse()
                .ok(),
            _ => line.split_once(',')?.0.parse().ok(),
        }
    }

    /// The cells of a line; `None` if the line is not a row with this number of columns.
    pub fn cells(self, line: &str, columns: &[String]) -> Option<Vec<Cell>> {
        if self == Self::Json {
            let map: Map<String, Value> = serde_json::from_str(line).ok()?;
            let cell = |name: &String| Cell::of_json(map.get(name)?);
            return columns.iter().map(cell).collect();
        }
        let mut reader = ::csv::ReaderBuilder::new()
            .has_headers(false)
            .from_reader(line.as_bytes());
        let record = reader.records().next()?.ok()?;
        let cells = record.iter().skip(1).map(|text| match text.parse::<f64>() {
            _ if text.is_empty() => Cell::Empty,
            Ok(number) => Cell::Number(number),
            Err(_) => Cell::Text(text.to_owned()),
        });
        let cells: Vec<Cell> = cells.collect();
        (cells.len() == columns.len()).then_some(cells)
    }
}

/// Cells as a line of CSV.
pub fn csv_line(cells: impl Iterator<Item = Cell>) -> String {
    csv::row(cells.map(|cell| match cell {
        Cell::Empty => String::new(),
        Cell::Number(x) => csv::number(x),
        // A row stays on its line.
        Cell::Text(text) => text.replace(['\n', '\r'], " "),
    }))
}

/// Rows as a table for reading.
pub fn table(columns: &[String], rows: &[(u64, Vec<Cell>)]) -> String {
    let names = columns.iter().cloned();
    let header: Vec<String> = std::iter::once("row".to_owned()).chain(names).collect();
    let mut table = text_table(&header);
    for (index, cells) in rows {
        let texts = cells.iter().map(|cell| match cell {
            Cell::Empty => String::new(),
            Cell::Number(x) if x.is_infinite() => csv::number(*x),
            Cell::Number(x) => rounded(*x),
            Cell::Text(text) => text.clone(),
        });
        table.add_row(std::iter::once(index.to_string()).chain(texts));
    }
    table.to_string() + "\n"
}
