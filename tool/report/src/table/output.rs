//! Columns of numbers as an aligned table, CSV or JSON.

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, TableStyle};
use serde_json::{Map, Value, json};

use jred_machine::number::columns::Columns;
use jred_machine::number::csv;
use jred_machine::number::rounding::rounded;

jred_machine::words! {
    /// How a result is written.
    pub enum Format default Table {
        /// An aligned table for reading, rounded to six digits.
        Table = "table",
        /// Comma-separated, every digit: reading it back gives the same numbers.
        Csv = "csv",
        /// JSON, every digit.
        Json = "json",
    }
}

/// The columns in one of the formats, under a title for tables and JSON.
pub fn write(columns: &Columns, format: Format, title: &str) -> String {
    match format {
        Format::Table => format!("{title}\n{}\n", table(columns)),
        Format::Csv => csv(columns),
        Format::Json => {
            let mut map = Map::new();
            map.insert("title".into(), title.into());
            map.extend(json(columns));
            format!("{:#}\n", Value::Object(map))
        }
    }
}

/// `columns` and `rows` for JSON.
pub fn json(columns: &Columns) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("columns".into(), json!(columns.names()));
    let tidy = |row: &Vec<Option<f64>>| -> Vec<Option<f64>> {
        row.iter().map(|x| x.map(|x| x + 0.0)).collect() // no −0
    };
    let rows: Vec<_> = columns.rows().iter().map(tidy).collect();
    map.insert("rows".into(), json!(rows));
    map
}

fn table(columns: &Columns) -> String {
    let mut table = text_table(
        &columns
            .names()
            .iter()
            .map(|n| narrow(n))
            .collect::<Vec<_>>(),
    );
    // Rounding errors compared with the largest number of the column are shown as zero.
    let mut largest = vec![0.0f64; columns.names().len()];
    for row in columns.rows() {
        for (most, value) in largest.iter_mut().zip(row) {
            *most = most.max(value.map_or(0.0, f64::abs));
        }
    }
    for row in columns.rows() {
        let cells = row.iter().zip(&largest).map(|(value, most)| match value {
            Some(x) if x.abs() < 1e-12 * most => "0".to_owned(),
            Some(x) => rounded(*x),
            None => String::new(),
        });
        table.add_row(cells);
    }
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

fn csv(columns: &Columns) -> String {
    let rows = columns
        .rows()
        .iter()
        .map(|row| row.iter().copied().map(csv::known));
    csv::row(columns.names()) + &csv::rows(rows)
}

/// A column's name over several lines: one word a line, the unit whole.
fn narrow(name: &str) -> String {
    let (words, unit) = name.split_at(name.find('[').unwrap_or(name.len()));
    let lines = words.split_whitespace().chain(std::iter::once(unit));
    lines
        .filter(|l| !l.is_empty())
        .collect::<Vec<_>>()
        .join("\n")
}

/// Only a line under the header.
const STYLE: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

/// An empty table with this header, in the tool's style.
pub fn text_table(header: &[impl ToString]) -> comfy_table::Table {
    let mut table = comfy_table::Table::new();
    table
        .load_style(STYLE)
        .set_content_arrangement(ContentArrangement::Disabled)
        .set_header(header.iter().map(ToString::to_string));
    table
}
