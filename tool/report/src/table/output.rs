//! Columns of numbers as an aligned table, CSV or JSON.

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, TableStyle};
use serde_json::{Map, Value, json};

use super::json::split_at_entry;
use crate::units;
use jred_file::number::columns::{ColumnQuantity, Columns};
use jred_file::number::csv;
use jred_file::number::rounding::rounded;

jred_file::words! {
    /// Format of a result.
    pub enum Format default Table {
        /// An aligned table for reading, rounded to six digits.
        Table = "table",
        /// Comma-separated, every digit: reading it back gives the same numbers.
        Csv = "csv",
        /// JSON, every digit.
        Json = "json",
    }
}

/// The columns in one of the formats, with a title for tables and JSON.
pub fn write(columns: &Columns, format: Format, title: &str) -> String {
    parts(columns, format, title).collect()
}

/// Number of rows of a part.
const PART: usize = 4096;

/// The same in parts of some thousand rows; the text of a million rows is many times larger than the rows.
pub fn parts<'c>(
    columns: &'c Columns,
    format: Format,
    title: &str,
) -> Box<dyn Iterator<Item = String> + 'c> {
    if format != Format::Json && !units::is_si() {
        let shown = units::columns(columns);
        return Box::new(std::iter::once(rendered(&shown, format, title).collect()));
    }
    rendered(columns, format, title)
}

fn rendered<'c>(
    columns: &'c Columns,
    format: Format,
    title: &str,
) -> Box<dyn Iterator<Item = String> + 'c> {
    match format {
        Format::Table => {
            let title = std::iter::once(format!("{title}\n"));
            Box::new(title.chain(table(columns)))
        }
        Format::Csv => {
            let rows = columns.rows().chunks(PART).map(|part| {
                let rows = part.iter().map(|row| row.iter().copied().map(csv::known));
                csv::rows(rows)
            });
            Box::new(std::iter::once(csv::row(columns.names())).chain(rows))
        }
        Format::Json => {
            let mut map = Map::new();
            map.insert("title".into(), title.into());
            Box::new(json_parts(columns, map, Map::new()))
        }
    }
}

/// JSON with `columns` and `rows` between other entries, part by part.
pub fn json_parts(
    columns: &Columns,
    before: Map<String, Value>,
    after: Map<String, Value>,
) -> impl Iterator<Item = String> {
    let mut map = before;
    map.insert("columns".into(), json!(columns.names()));
    map.insert("rows".into(), Value::Null);
    map.extend(after);
    let text = format!("{:#}\n", Value::Object(map));
    let (head, tail) = split_at_entry(&text, "rows");
    let opening = format!("{head}[");
    let closing = if columns.rows().is_empty() {
        "]"
    } else {
        "\n  ]"
    };
    let closing = format!("{closing}{tail}");
    let rows = columns.rows().chunks(PART).enumerate().map(|(k, part)| {
        let part: Vec<_> = part.iter().map(|row| tidy(row)).collect();
        let text = format!("{:#}", json!(part)).replace('\n', "\n  ");
        let rows = text.trim_start_matches('[').trim_end_matches("\n  ]");
        let comma = if k > 0 { "," } else { "" };
        format!("{comma}{rows}")
    });
    std::iter::once(opening)
        .chain(rows)
        .chain(std::iter::once(closing))
}

/// A row without −0.
fn tidy(row: &[Option<f64>]) -> Vec<Option<f64>> {
    row.iter().map(|x| x.map(|x| x + 0.0)).collect()
}

fn table(columns: &Columns) -> impl Iterator<Item = String> {
    let header: Vec<String> = columns.names().iter().map(|name| narrow(name)).collect();
    // Values that are rounding errors relative to the column's largest are shown as zero.
    let mut largest = vec![0.0f64; header.len()];
    for row in columns.rows() {
        for (most, value) in largest.iter_mut().zip(row) {
            *most = most.max(value.map_or(0.0, f64::abs));
        }
    }
    // Columns of nothing but rounding errors, too: relative to all columns of their unit, they would change no sum.
    let heads = columns.heads();
    let floor: Vec<f64> = (heads.iter().zip(&largest))
        .map(|(head, own)| {
            let alike = heads.iter().zip(&largest);
            let alike = alike.filter(|(other, _)| base_unit(&other.unit) == base_unit(&head.unit));
            let all = alike.map(|(_, most)| *most).fold(0.0, f64::max);
            // An integration error is small, and is the requested value.
            if head.quantity == ColumnQuantity::EnergyBalance {
                return 1e-12 * own;
            }
            (1e-12 * own).max(1e-15 * all)
        })
        .collect();
    let cells = move |row: &[Option<f64>]| -> Vec<String> {
        let cells = row.iter().zip(&floor).map(|(value, least)| match value {
            Some(x) if x.abs() < *least => "0".to_owned(),
            Some(x) => rounded(*x),
            None => String::new(),
        });
        cells.collect()
    };
    // Every part is as wide as the widest.
    let mut widths = vec![0; header.len()];
    if columns.rows().len() > PART {
        for row in columns.rows() {
            for (width, cell) in widths.iter_mut().zip(cells(row)) {
                *width = cell.chars().count().max(*width);
            }
        }
        for (width, name) in widths.iter_mut().zip(&header) {
            let lines = name.lines().map(|line| line.chars().count());
            *width = lines.max().unwrap_or(0).max(*width);
        }
    }
    let parts = columns.rows().len().div_ceil(PART).max(1);
    (0..parts).map(move |part| {
        let mut table = if part == 0 {
            text_table(&header)
        } else {
            bare_table()
        };
        for row in columns.rows().iter().skip(part * PART).take(PART) {
            let cells = cells(row).into_iter().zip(&widths);
            table.add_row(cells.map(|(cell, width)| format!("{cell:>width$}")));
        }
        for column in table.column_iter_mut() {
            column.set_cell_alignment(CellAlignment::Right);
        }
        format!("{table}\n")
    })
}

/// The unit of the quantity in a derivative with respect to the position.
fn base_unit(unit: &str) -> &str {
    match unit {
        "kg/m" | "kg/m^2" => "kg",
        _ => unit.split("/rad").next().unwrap_or(unit),
    }
}

/// A column's name on several lines: one word per line, the unit unbroken.
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
    let mut table = bare_table();
    table.set_header(header.iter().map(ToString::to_string));
    table
}

fn bare_table() -> comfy_table::Table {
    let mut table = comfy_table::Table::new();
    table
        .load_style(STYLE)
        .set_content_arrangement(ContentArrangement::Disabled);
    table
}
