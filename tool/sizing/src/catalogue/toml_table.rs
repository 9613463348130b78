//! A catalogue in TOML: the same columns as keys, each value with its unit.

use std::borrow::Cow;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::cell::{self, Cell, unit_cure};
use super::column::{Column, Kind, Unit};
use super::fault::{Fault, Text};
use super::row::{Cells, Row};
use super::table::unknown;

/// One table of an array such as `[[motor]]`.
struct TomlRow {
    at: Range<usize>,
    cells: Vec<TomlCell>,
    currency: String,
    /// Faults of keys and units.
    faults: Vec<Fault>,
}

struct TomlCell {
    column: Column,
    text: String,
    unit: Option<&'static Unit>,
    at: Range<usize>,
}

impl Cells for TomlRow {
    fn cell(&self, column: Column) -> Option<Cell<'_>> {
        let found = self.cells.iter().find(|cell| cell.column == column)?;
        (!found.text.is_empty()).then_some(Cell {
            text: &found.text,
            unit: found.unit,
        })
    }

    fn place(&self, column: Column) -> Range<usize> {
        let found = self.cells.iter().find(|cell| cell.column == column);
        found.map_or(self.at.clone(), |cell| cell.at.clone())
    }

    /// A key that is not there can always be added to its table.
    fn has(&self, _column: Column) -> bool {
        true
    }

    fn given(&self, column: Column) -> bool {
        self.cells.iter().any(|cell| cell.column == column)
    }

    fn header(&self) -> Range<usize> {
        self.at.clone()
    }

    fn currency(&self) -> &str {
        &self.currency
    }
}

/// Calls `take` with every row of every table, or with what makes it unreadable.
pub(super) fn each(
    text: &Text,
    mut take: impl FnMut(Result<(Row<'_>, usize), Fault>),
) -> Result<usize, Fault> {
    let tree = DeTable::parse(&text.text).map_err(|error| {
        Fault::new(
            format!("invalid TOML: {}", error.message()),
            error.span().unwrap_or(0..0),
            "here",
            "tables are [[motor]], [[gearbox]], [[amplifier]], [[resistor]], [[compatibility]]; values with a unit are \
             written in quotes: rated_torque = \"3.2 N m\"",
        )
    })?;
    if let Some((name, _)) = tree
        .get_ref()
        .iter()
        .find(|(name, _)| name.get_ref() == "mechanism")
    {
        return Err(Fault::new(
            "this is a machine file, not a catalogue",
            name.span(),
            "a machine has a [mechanism]",
            "use --catalogue for a folder of motors and gearboxes only: `jred size MACHINE --catalogue FOLDER`",
        ));
    }
    let mut tables: Vec<(Kind, &Spanned<DeValue>)> = Vec::new();
    for (name, value) in tree.get_ref() {
        let kind = Kind::ALL
            .into_iter()
            .find(|k| k.singular() == name.get_ref());
        let kind = kind.ok_or_else(|| {
            let names: Vec<String> = Kind::ALL
                .iter()
                .map(|k| format!("[[{}]]", k.singular()))
                .collect();
            Fault::new(
                format!("unknown table \"{}\"", name.get_ref()),
                name.span(),
                "not a table of a catalogue",
                format!("tables are {}", names.join(", ")),
            )
        })?;
        let DeValue::Array(rows) = value.get_ref() else {
            return Err(Fault::new(
                format!("\"{}\" is a single table", kind.singular()),
                name.span(),
                "one pair of brackets",
                format!("write [[{}]] with two pairs of brackets", kind.singular()),
            ));
        };
        tables.extend(rows.iter().map(|row| (kind, row)));
    }
    // In the file's order, which the map of names does not keep.
    tables.sort_by_key(|(_, row)| row.span().start);
    let mut lines = Lines::new(&text.text);
    let count = tables.len();
    for (kind, row) in tables {
        let line = lines.of(row.span().start);
        match read_row(kind, row) {
            Ok(cells) => {
                let row = Row::new(kind, &cells);
                for fault in &cells.faults {
                    row.add(fault.clone());
                }
                take(Ok((row, line)));
            }
            Err(fault) => take(Err(fault)),
        }
    }
    Ok(count)
}

fn read_row(kind: Kind, row: &Spanned<DeValue>) -> Result<TomlRow, Fault> {
    let DeValue::Table(table) = row.get_ref() else {
        return Err(Fault::new(
            format!(
                "\"{}\" contains something that is not a table",
                kind.singular()
            ),
            row.span(),
            "here",
            format!("write [[{}]] and its keys below", kind.singular()),
        ));
    };
    let mut cells = Vec::with_capacity(table.len());
    let (mut currency, mut faults) = (String::new(), Vec::new());
    for (name, value) in table {
        let column = Column::of(kind).find(|c| c.name() == name.get_ref());
        let column = column.ok_or_else(|| unknown(name.get_ref(), kind, name.span()));
        match column.and_then(|column| read_cell(column, value)) {
            Ok(mut cell) => {
                if cell.column == Column::Price {
                    let (number, word) = cell::split(&cell.text);
                    word.clone_into(&mut currency);
                    let length = number.len();
                    cell.text.truncate(length);
                }
                cells.push(cell);
            }
            Err(fault) => faults.push(fault),
        }
    }
    Ok(TomlRow {
        at: row.span(),
        cells,
        currency,
        faults,
    })
}

fn read_cell(column: Column, value: &Spanned<DeValue>) -> Result<TomlCell, Fault> {
    let at = value.span();
    let text: Cow<str> = match value.get_ref() {
        DeValue::String(text) => Cow::Borrowed(text.as_ref()),
        DeValue::Integer(number) => Cow::Owned(number.to_string()),
        DeValue::Float(number) => Cow::Owned(number.to_string()),
        DeValue::Boolean(true) => Cow::Borrowed("yes"),
        DeValue::Boolean(false) => Cow::Borrowed("no"),
        DeValue::Array(items) => {
            let words = items.iter().map(|item| item.get_ref().as_str());
            let words: Option<Vec<&str>> = words.collect();
            let words = words.ok_or_else(|| {
                Fault::new(
                    format!("{} contains something that is not a text", column.name()),
                    at.clone(),
                    "here",
                    "write a list of quoted texts: [\"…\", \"…\"]",
                )
            })?;
            Cow::Owned(words.join("; "))
        }
        _ => {
            return Err(Fault::new(
                format!("{} is neither a text nor a number", column.name()),
                at,
                "here",
                "write a quoted text or a number",
            ));
        }
    };
    let units = column.units();
    let carries_unit = units.iter().any(|unit| !unit.text.is_empty());
    if !carries_unit {
        return Ok(TomlCell {
            column,
            text: text.trim().to_owned(),
            unit: units.first(),
            at,
        });
    }
    // Words among quantities, such as back_driving = "friction".
    if text.trim().starts_with(|c: char| c.is_alphabetic()) {
        return Ok(TomlCell {
            column,
            text: text.trim().to_owned(),
            unit: None,
            at,
        });
    }
    let (number, word) = cell::split(text.trim());
    let unit = cell::find_unit(word, units).ok_or_else(|| {
        let what = if word.is_empty() {
            format!("{} has no unit: {number}", column.name())
        } else {
            format!("{} has the unit \"{word}\"", column.name())
        };
        Fault::new(
            what,
            at.clone(),
            "not a unit of this quantity",
            format!(
                "write the value with its unit in quotes; {}",
                unit_cure(word, units)
            ),
        )
    })?;
    Ok(TomlCell {
        column,
        text: number.to_owned(),
        unit: Some(unit),
        at,
    })
}

/// Numbers of lines for rising places, each part of the text looked at once.
struct Lines<'t> {
    bytes: &'t [u8],
    at: usize,
    line: usize,
}

impl<'t> Lines<'t> {
    const fn new(text: &'t str) -> Self {
        Self {
            bytes: text.as_bytes(),
            at: 0,
            line: 1,
        }
    }

    fn of(&mut self, at: usize) -> usize {
        let passed = self.bytes.get(self.at..at).unwrap_or_default();
        self.line += passed.split(|b| *b == b'\n').count() - 1;
        self.at = at;
        self.line
    }
}
