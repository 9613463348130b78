//! A catalogue in TOML: the same columns as keys, each value with its unit.

use std::ops::Range;

use jred_file::text::item::Item;
use jred_file::text::problem::Problem;
use jred_file::text::section::Section;
use jred_file::text::tree;
use jred_file::units::kind::SHARE;
use jred_file::units::quantity::split_number;

use super::cell::{TableCell, number_and_unit};
use super::column::{Column, Kind, Unit};
use super::row::{CatalogueRow, Cells, Syntax};
use super::table::unknown;

/// One table of an array such as `[[motor]]`.
struct TomlRow {
    at: Range<usize>,
    cells: Vec<TomlCell>,
    currency: String,
}

struct TomlCell {
    column: Column,
    text: String,
    unit: Option<Unit>,
    at: Range<usize>,
}

impl Cells for TomlRow {
    fn cell(&self, column: Column) -> Option<TableCell<'_>> {
        let found = self.cells.iter().find(|cell| cell.column == column)?;
        (!found.text.is_empty()).then_some(TableCell {
            text: &found.text,
            unit: found.unit.as_ref(),
            separator: ',',
        })
    }

    fn place(&self, column: Column) -> Range<usize> {
        let found = self.cells.iter().find(|cell| cell.column == column);
        found.map_or(self.at.clone(), |cell| cell.at.clone())
    }

    /// A missing key can always be added to its table.
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

    fn form(&self) -> Syntax {
        Syntax::Toml
    }
}

/// Calls `take` with every row of every table, or with the fault that makes it unreadable.
pub(super) fn each(
    text: &str,
    mut take: impl FnMut(Result<(CatalogueRow<'_>, usize), Problem>),
) -> Result<usize, Problem> {
    let tree = tree::parse(text)?;
    let root = Section::new(String::new(), 0..0, tree.get_ref());
    if let Some(mechanism) = root.peek("mechanism") {
        return Err(Problem::new("this is a machine file, not a catalogue")
            .at(mechanism.key_span(), "a machine has a [mechanism]")
            .help("use --catalogue for a folder of motors and gearboxes only: `jred size MACHINE --catalogue FOLDER`"));
    }
    let mut rows = Vec::new();
    for kind in Kind::ALL {
        if let Some(item) = root.get(kind.singular()) {
            let tables = item.sections(&format!("[[{}]]", kind.singular()))?;
            rows.extend(tables.into_iter().map(|table| (kind, table)));
        }
    }
    root.finish_with(|_| Some("a catalogue has tables in double brackets, such as [[motor]]"))?;
    // In the file's order, which the map of names does not keep.
    rows.sort_by_key(|(_, table)| table.header().start);
    let mut lines = Lines::new(text);
    for (kind, table) in &rows {
        let (cells, faults) = read_row(*kind, table);
        let row = CatalogueRow::new(*kind, &cells);
        for fault in faults {
            row.add(fault);
        }
        take(Ok((row, lines.of(table.header().start))));
    }
    Ok(rows.len())
}

/// The cells of a row, and the faults of its keys and units.
fn read_row(kind: Kind, table: &Section) -> (TomlRow, Vec<Problem>) {
    let mut row = TomlRow {
        at: table.header(),
        cells: Vec::new(),
        currency: String::new(),
    };
    let mut faults = Vec::new();
    for (name, item) in table.entries() {
        let column = Column::of(kind).find(|column| column.name() == name);
        let cell = column.ok_or_else(|| unknown(name, kind, Syntax::Toml, item.key_span()));
        match cell.and_then(|column| read_cell(column, &item, &mut row.currency)) {
            Ok(cell) => row.cells.push(cell),
            Err(fault) => faults.push(fault),
        }
    }
    (row, faults)
}

fn read_cell(column: Column, item: &Item, currency: &mut String) -> Result<TomlCell, Problem> {
    let words = item.words()?;
    let mut cell = TomlCell {
        column,
        text: words.trim().to_owned(),
        unit: None,
        at: item.span(),
    };
    let holds = column.holds();
    if column == Column::Price {
        if let Ok((number, word)) = split_number(&words, &SHARE) {
            word.clone_into(currency);
            cell.text = number;
        }
    } else if !holds.kinds().is_empty() && !words.starts_with(char::is_alphabetic) {
        // Words may occur among quantities, such as back_driving = "friction".
        let (number, unit) = number_and_unit(&words, holds).map_err(|fault| item.fault(fault))?;
        (cell.text, cell.unit) = (number, Some(unit));
    }
    Ok(cell)
}

/// Line numbers of increasing offsets, in one pass.
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
