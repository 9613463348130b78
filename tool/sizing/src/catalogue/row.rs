//! One row of a catalogue table from any kind of file: its cells by column, as quantities in SI or as words.

use std::cell::RefCell;
use std::ops::Range;

use jred_file::number::rounding::figure;
use jred_file::plain;
use jred_file::text::csv;
use jred_file::text::problem::Problem;
use jred_file::units::quantity::possible_units;

use super::cell::{self, NUMBER_CURE, TableCell};
use super::column::{CellContent, Column, Kind, MotorScope, PLAIN, RATIO, Unit};

/// Source of the cells of a row.
pub(super) trait Cells {
    /// Content of a column; `None`: empty, or no such column.
    fn cell(&self, column: Column) -> Option<TableCell<'_>>;
    /// The position of the cell, or of the row if there is no such cell.
    fn place(&self, column: Column) -> Range<usize>;
    /// Whether the row could have such a cell.
    fn has(&self, column: Column) -> bool;
    /// Whether the file has an entry in this column, even an empty one.
    fn given(&self, column: Column) -> bool;
    /// The position of the header, for missing columns.
    fn header(&self) -> Range<usize>;
    /// The currency of its price, if given.
    fn currency(&self) -> &str;
    /// The form of the file.
    fn form(&self) -> Syntax;
}

/// The two forms of a catalogue; cures have different words for them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Syntax {
    Csv,
    Toml,
}

impl Syntax {
    /// Words for omitting a figure.
    pub(super) const fn leave_out(self) -> &'static str {
        match self {
            Self::Csv => "leave this cell empty",
            Self::Toml => "remove this key",
        }
    }

    /// Words for writing a share.
    pub(super) const fn share(self) -> &'static str {
        match self {
            Self::Csv => "check the value and the unit in the header: 97 needs [%], 0.97 no unit",
            Self::Toml => "check the value and its unit: write \"97 %\" or 0.97",
        }
    }

    /// Word for a column.
    pub(super) const fn column(self) -> &'static str {
        match self {
            Self::Csv => "column",
            Self::Toml => "key",
        }
    }
}

/// All faults of a row.
pub(super) type RowResult<T> = Result<T, Vec<Problem>>;

/// One row. A faulty cell is recorded and read as a substitute value, so that all faults of a row are found at once;
/// [`CatalogueRow::checked`] returns them.
pub(super) struct CatalogueRow<'t> {
    pub(super) kind: Kind,
    cells: &'t dyn Cells,
    /// The kind of motor that its units must be for.
    motors: MotorScope,
    faults: RefCell<Vec<Problem>>,
    /// A column missing in the whole table.
    lacking: RefCell<Option<Problem>>,
}

impl<'t> CatalogueRow<'t> {
    pub(super) fn new(kind: Kind, cells: &'t dyn Cells) -> Self {
        Self {
            kind,
            cells,
            motors: MotorScope::Any,
            faults: RefCell::default(),
            lacking: RefCell::default(),
        }
    }

    /// Records a fault.
    pub(super) fn add(&self, fault: Problem) {
        self.faults.borrow_mut().push(fault);
    }

    /// Records the fault, if any, and returns a substitute value.
    fn keep<T>(&self, read: Result<T, Problem>, stand_in: T) -> T {
        read.unwrap_or_else(|fault| {
            self.add(fault);
            stand_in
        })
    }

    /// The recorded faults as an error, if there are any.
    pub(super) fn checked(&self) -> RowResult<()> {
        let faults = self.faults.take();
        if faults.is_empty() && self.lacking.borrow().is_none() {
            Ok(())
        } else {
            Err(faults)
        }
    }

    /// The fault of a column missing in the whole table.
    pub(super) fn lacking(&self) -> Option<Problem> {
        self.lacking.take()
    }

    /// From now on, units of the other kind of motor are faults.
    pub(super) const fn expect(&mut self, motors: MotorScope) {
        self.motors = motors;
    }

    /// Name of the row in messages.
    pub(super) fn name(&self) -> &'t str {
        let column = match self.kind {
            Kind::Compatibility => Column::ListedMotor,
            _ => Column::Key,
        };
        self.cells.cell(column).map_or("?", |cell| cell.text)
    }

    /// Position of a column in this row.
    pub(super) fn place(&self, column: Column) -> Range<usize> {
        self.cells.place(column)
    }

    /// Whether the file has an entry in this column, even an empty one.
    pub(super) fn given(&self, column: Column) -> bool {
        self.cells.given(column)
    }

    /// A fault in a column of this row; `what` continues the sentence after its name.
    pub(super) fn fault(
        &self,
        column: Column,
        what: &str,
        label: &'static str,
        help: impl Into<String>,
    ) -> Problem {
        let message = format!(
            "{} of \"{}\" {what}",
            column.name(),
            plain::cut(self.name())
        );
        Problem::new(message)
            .at(self.place(column), label)
            .help(help)
    }

    /// Words, if given.
    pub(super) fn words(&self, column: Column) -> Option<&'t str> {
        self.cells.cell(column).map(|cell| cell.text)
    }

    /// The form of the file.
    pub(super) fn form(&self) -> Syntax {
        self.cells.form()
    }

    /// The currency of its price, if given.
    pub(super) fn currency(&self) -> &'t str {
        self.cells.currency()
    }

    /// Required words.
    pub(super) fn text(&self, column: Column) -> String {
        let words = self.words(column);
        if words.is_none() {
            self.missing(column, &[]);
        }
        words.unwrap_or_default().to_owned()
    }

    /// Records the fault of a missing cell; one of `instead` would also be sufficient.
    pub(super) fn missing(&self, column: Column, instead: &[Column]) {
        let name = column.name();
        let others = instead.iter().map(|other| other.name());
        let or: String = others.flat_map(|other| [", or ", other]).collect();
        if self.form() == Syntax::Toml && !self.given(column) {
            let table = self.kind.singular();
            let help = format!("add {name}{or}, or remove the table");
            self.add(self.fault(
                column,
                "is not given",
                "required in every such table",
                format!("{help}; docs/catalogue.md shows all keys of [[{table}]]"),
            ));
            return;
        }
        if self.cells.has(column) {
            let help = format!("fill in {name}{or}, or remove the row");
            self.add(self.fault(column, "is empty", "required in every row", help));
            return;
        }
        let units = match column.holds().kinds() {
            [] => String::new(),
            kinds => format!(" with its unit ({})", possible_units(kinds)),
        };
        let fault = Problem::new(format!("the column \"{name}\" is missing"))
            .at(self.cells.header(), "in this header")
            .help(format!(
                "add the column \"{name}\"{units}{or}; docs/catalogue.md shows all columns"
            ));
        self.lacking.borrow_mut().get_or_insert(fault);
    }

    /// An optional number in SI.
    fn number(
        &self,
        column: Column,
        least: f64,
        label: &'static str,
    ) -> Result<Option<f64>, Problem> {
        let Some(TableCell {
            text,
            unit,
            separator,
        }) = self.cells.cell(column)
        else {
            return Ok(None);
        };
        if let Some(unit) = unit
            && unit.motors != MotorScope::Any
            && self.motors != MotorScope::Any
            && unit.motors != self.motors
        {
            return Err(self.fault(
                column,
                &format!(
                    "is in [{}], a unit for {} motors, but the motor is {}",
                    unit.text,
                    cell::words(unit.motors),
                    cell::words(self.motors)
                ),
                "wrong unit for this motor",
                format!(
                    "set the {} \"kind\" to \"rotary\" or \"linear\", or correct the unit",
                    self.form().column()
                ),
            ));
        }
        let si = |value: f64| unit.map_or(value, |unit| unit.measure.si(value));
        match csv::number_of(text, separator) {
            Some(value) if si(value) > least => {
                self.plausible(column, value, unit, least >= 0.0)?;
                Ok(Some(si(value)))
            }
            _ => {
                let cure = if text.contains(',') && !text.contains('.') {
                    format!("{NUMBER_CURE}: \"{}\"", plain::cut(text).replace(',', "."))
                } else {
                    match self.form() {
                        Syntax::Csv => format!(
                            "{NUMBER_CURE}; its unit is in the header; leave the cell empty if the data sheet gives no value"
                        ),
                        Syntax::Toml => format!(
                            "{NUMBER_CURE}, with its unit behind it in the same quotation marks; remove the key if the data sheet gives no value"
                        ),
                    }
                };
                let what = format!("is \"{}\"", plain::cut(text));
                Err(self.fault(column, &what, label, cure))
            }
        }
    }

    /// Checks that a number is within the range of its kind; if it must be positive, also against the smallest value.
    fn plausible(
        &self,
        column: Column,
        value: f64,
        unit: Option<&Unit>,
        above_zero: bool,
    ) -> Result<(), Problem> {
        let [smallest, largest] = match unit {
            _ if column == Column::Ratio => RATIO,
            Some(unit) => unit.range,
            None => PLAIN,
        };
        let text = unit.map_or("", |unit| unit.text.as_str());
        let si = unit.map_or(value, |unit| unit.measure.si(value));
        let shown = |value: f64| format!("{} {text}", figure(value)).trim_end().to_owned();
        let fault = |what: &str, bound: &str, limit: f64| {
            let limit = shown(unit.map_or(limit, |unit| unit.measure.number(limit)));
            self.fault(
                column,
                &format!(
                    "is {}, too {what} for any {}",
                    shown(value),
                    self.kind.singular()
                ),
                "check number and unit",
                format!("{bound} {limit} is accepted: check the number and its unit"),
            )
        };
        if si > largest {
            Err(fault("large", "at most", largest))
        } else if above_zero && si < smallest {
            Err(fault("small", "at least", smallest))
        } else {
            Ok(())
        }
    }

    /// An optional figure greater than zero, in SI.
    pub(super) fn optional(&self, column: Column) -> Option<f64> {
        self.keep(self.number(column, 0.0, ABOVE_ZERO), None)
    }

    /// A required figure greater than zero, in SI.
    pub(super) fn positive(&self, column: Column) -> f64 {
        self.needed(column, self.number(column, 0.0, ABOVE_ZERO), 1.0)
    }

    /// An optional figure that may be zero, in SI.
    pub(super) fn not_negative(&self, column: Column) -> Option<f64> {
        self.keep(self.number(column, -f64::MIN_POSITIVE, FROM_ZERO), None)
    }

    /// A required figure that may be zero, in SI.
    pub(super) fn zero_or_more(&self, column: Column) -> f64 {
        self.needed(
            column,
            self.number(column, -f64::MIN_POSITIVE, FROM_ZERO),
            0.0,
        )
    }

    fn needed(&self, column: Column, number: Result<Option<f64>, Problem>, stand_in: f64) -> f64 {
        self.keep(number, Some(stand_in)).unwrap_or_else(|| {
            self.missing(column, &[]);
            stand_in
        })
    }

    /// An optional whole number from 1 to 1000.
    pub(super) fn count(&self, column: Column) -> Option<u32> {
        let value = self.optional(column)?;
        if value.fract() == 0.0 && value <= 1000.0 {
            return Some(value as u32);
        }
        self.add(self.fault(
            column,
            &format!("is {value}"),
            "not a whole number from 1 to 1000",
            "write their number",
        ));
        None
    }

    /// Points "x: y; x: y", in SI; empty if the cell is empty.
    pub(super) fn points(&self, column: Column, holds: [CellContent; 2]) -> Vec<[f64; 2]> {
        let Some(text) = self.words(column) else {
            return Vec::new();
        };
        let points = cell::points(text, holds, self.motors)
            .map_err(|wrong| self.fault(column, &wrong.message, "here", wrong.help));
        self.keep(points, Vec::new())
    }

    /// One of several words; `None` if the cell is empty.
    pub(super) fn choice<T: Copy>(&self, column: Column, words: &[(&str, T)]) -> Option<T> {
        let word = self.words(column)?;
        let lower = word.to_lowercase();
        if let Some((_, value)) = words.iter().find(|known| known.0 == lower) {
            return Some(*value);
        }
        let names: Vec<String> = words.iter().map(|w| format!("\"{}\"", w.0)).collect();
        let help = format!("write {}", names.join(" or "));
        let what = format!("is \"{}\"", plain::cut(word));
        self.add(self.fault(column, &what, "not known", help));
        None
    }

    /// Yes or no; `None` if the cell is empty.
    pub(super) fn yes_or_no(&self, column: Column) -> Option<bool> {
        self.choice(
            column,
            &[
                ("yes", true),
                ("no", false),
                ("true", true),
                ("false", false),
            ],
        )
    }

    /// Checks that a figure is not below another one.
    pub(super) fn at_least(
        &self,
        (column, value): (Column, Option<f64>),
        (other, least): (Column, Option<f64>),
    ) {
        if let (Some(value), Some(least)) = (value, least)
            && value < least
        {
            let (name, other) = (column.name(), other.name());
            self.add(self.fault(
                column,
                &format!("is below its {other}"),
                "too small",
                format!(
                    "check {name} and {other} against the data sheet, and {}",
                    match self.form() {
                        Syntax::Csv => "the units in the header",
                        Syntax::Toml => "their units",
                    }
                ),
            ));
        }
    }
}

const ABOVE_ZERO: &str = "not a number greater than zero";
const FROM_ZERO: &str = "not a number of zero or more";
