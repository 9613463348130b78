//! Rows of a study: writing them line by line, and reading them back.

use serde_json::{Map, Value};

use crate::table::output::text_table;
use crate::units;
use jred_file::number::csv;
use jred_file::number::rounding::rounded;
use jred_sizing::cell::Cell;

jred_file::words! {
    /// Format of rows.
    pub enum RowFormat default Table {
        /// An aligned table for reading, printed when all rows are complete.
        Table = "table",
        /// Comma-separated, every digit.
        Csv = "csv",
        /// JSON lines: one object per row, every digit.
        Json = "json",
    }
}

impl RowFormat {
    /// The line before the rows: the column names in CSV, the study in JSON.
    pub fn front(self, study: &str, columns: &[String]) -> String {
        if self == Self::Json {
            return format!("{study}\n");
        }
        let names = columns.iter().map(String::as_str);
        let names = std::iter::once("row").chain(names).chain([STUDY]);
        csv_line(names.map(Cell::from))
    }

    /// Row number `index` as a line. In CSV the first row of a file also contains the `study`: so every line has the same number of cells, and every
    /// line is a row.
    pub fn line(
        self,
        columns: &[String],
        index: u64,
        cells: &[Cell],
        study: Option<&str>,
    ) -> String {
        if self == Self::Json {
            let mut map = Map::new();
            map.insert("row".to_owned(), index.into());
            for (name, cell) in columns.iter().zip(cells) {
                map.insert(name.clone(), cell.json());
            }
            return Value::Object(map).to_string() + "\n";
        }
        let cells = cells.iter().cloned();
        let study = study.map_or(Cell::Empty, Cell::from);
        let cells = std::iter::once(Cell::Text(index.to_string())).chain(cells);
        csv_line(cells.chain([study]))
    }

    /// The study in a row of CSV; `None`: the row has no study.
    pub fn study_of(line: &str) -> Option<String> {
        texts(line)?.pop().filter(|study| study.starts_with('{'))
    }

    /// The number and the cells of a line; `None`: not a row of these columns.
    pub fn row(self, line: &str, columns: &[String]) -> Option<(u64, Vec<Cell>)> {
        if self == Self::Json {
            let map: Map<String, Value> = serde_json::from_str(line).ok()?;
            let index = map.get("row")?.as_u64()?;
            let cell = |name: &String| Cell::of_json(map.get(name)?);
            let cells = columns.iter().map(cell).collect::<Option<_>>()?;
            return Some((index, cells));
        }
        let texts = texts(line)?;
        let (_, texts) = texts.split_last()?;
        let (index, texts) = texts.split_first()?;
        let index = index.parse().ok()?;
        let cells = texts.iter().map(|text| match text.parse::<f64>() {
            _ if text.is_empty() => Cell::Empty,
            Ok(number) => Cell::Number(number),
            Err(_) => Cell::Text(text.clone()),
        });
        let cells: Vec<Cell> = cells.collect();
        (cells.len() == columns.len()).then_some((index, cells))
    }
}

/// The cells of a line of CSV.
fn texts(row: &str) -> Option<Vec<String>> {
    let mut reader = ::csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(row.as_bytes());
    let record = reader.records().next()?.ok()?;
    Some(record.iter().map(str::to_owned).collect())
}

/// The column of the study.
const STUDY: &str = "study";

/// Cells as a line of CSV.
pub fn csv_line(cells: impl Iterator<Item = Cell>) -> String {
    csv::row(cells.map(|cell| match cell {
        Cell::Empty => String::new(),
        Cell::Number(x) => csv::number(x),
        // A row must stay on one line.
        Cell::Text(text) => text.replace(['\n', '\r'], " "),
    }))
}

/// Rows as a table for reading.
pub fn table(columns: &[String], rows: &[(u64, Vec<Cell>)]) -> String {
    let titles: Vec<_> = columns.iter().map(|name| units::title(name)).collect();
    let names = titles.iter().map(|(name, _)| name.to_string());
    let header: Vec<String> = std::iter::once("row".to_owned()).chain(names).collect();
    let mut table = text_table(&header);
    for (index, cells) in rows {
        let texts = cells.iter().enumerate().map(|(k, cell)| {
            let own = titles.get(k).and_then(|(_, own)| *own);
            match cell {
                Cell::Empty => String::new(),
                Cell::Number(x) if x.is_infinite() => csv::number(*x),
                Cell::Number(x) => rounded(own.map_or(*x, |own| own.of(*x))),
                Cell::Text(text) => units::cell(text, own),
            }
        });
        table.add_row(std::iter::once(index.to_string()).chain(texts));
    }
    table.to_string() + "\n"
}
