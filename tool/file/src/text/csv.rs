//! CSV tables with places: a header, and rows with the same number of cells.
//!
//! Cells are separated by commas, semicolons or tabs. A byte order mark, comments (`#`) and quotes are allowed.

use std::ops::Range;

use csv::{Error, ErrorKind, Position, Reader, ReaderBuilder, StringRecord, Trim};

use super::problem::{Problem, Result};
use crate::plain;
use crate::units::kind::Kind;
use crate::units::{Fault, unit};

/// A table, read row by row.
#[derive(Debug)]
pub struct CsvTable<'t> {
    text: &'t str,
    separator: char,
    reader: Reader<&'t [u8]>,
    header: StringRecord,
    record: StringRecord,
    rows: usize,
    over: bool,
}

impl<'t> CsvTable<'t> {
    /// A table with a header.
    ///
    /// # Errors
    /// The header cannot be read.
    pub fn read(text: &'t str) -> Result<Self> {
        let mut table = Self::new(text, ReaderBuilder::new().comment(Some(b'#')));
        let header = table.reader.headers().cloned();
        table.header = header.map_err(|error| table.broken(&error))?;
        if let Some((index, c)) = hidden(&table.header) {
            let at = table.title_place(index);
            return Err(Problem::new(format!(
                "the title of column {} contains {}",
                index + 1,
                plain::described(c)
            ))
            .at(at, "here")
            .help(plain::CURE));
        }
        Ok(table)
    }

    /// A table without a header line, with these titles.
    pub fn titled(text: &'t str, titles: &[String]) -> Self {
        let mut table = Self::new(
            text,
            ReaderBuilder::new().has_headers(false).comment(Some(b'#')),
        );
        table.header = titles.iter().map(String::as_str).collect();
        table
    }

    /// Rows of any length without a header.
    pub fn without_header(text: &'t str) -> Self {
        Self::new(text, ReaderBuilder::new().has_headers(false).flexible(true))
    }

    fn new(text: &'t str, reader: &mut ReaderBuilder) -> Self {
        let header = header_of(text);
        let separator = ['\t', ';'].into_iter().find(|c| header.contains(*c));
        let separator = separator.unwrap_or(',');
        Self {
            text,
            separator,
            reader: reader
                .trim(Trim::All)
                .delimiter(separator as u8)
                .from_reader(text.as_bytes()),
            header: StringRecord::new(),
            record: StringRecord::new(),
            rows: 0,
            over: false,
        }
    }

    /// The separator of the cells: a tab or a semicolon if the header contains one, otherwise the comma.
    pub const fn separator(&self) -> char {
        self.separator
    }

    /// The titles of the columns.
    pub const fn header(&self) -> &StringRecord {
        &self.header
    }

    /// The cells of the current row.
    pub const fn row(&self) -> &StringRecord {
        &self.record
    }

    /// Advances to the next row; `None` at the end.
    pub fn advance(&mut self) -> Option<Result<()>> {
        if self.over {
            return None;
        }
        self.rows += 1;
        match self.reader.read_record(&mut self.record) {
            Ok(false) => None,
            Ok(true) if self.record == self.header => Some(Err(Problem::new("duplicate header")
                .at(self.place(0), "again here")
                .help("remove this line: a table has one header"))),
            Ok(true) => Some(match hidden(&self.record) {
                None => Ok(()),
                Some((index, c)) => Err(Problem::new(format!(
                    "row {}: the cell in column {} contains {}",
                    self.rows,
                    index + 1,
                    plain::described(c)
                ))
                .at(self.row_place(), "this row")
                .help(plain::CURE)),
            }),
            Err(error) => {
                // The reader can continue only after a row of the wrong length.
                self.over = !matches!(error.kind(), ErrorKind::UnequalLengths { .. });
                Some(Err(self.broken(&error)))
            }
        }
    }

    fn broken(&self, error: &Error) -> Problem {
        let (message, help) = match error.kind() {
            ErrorKind::UnequalLengths {
                expected_len, len, ..
            } => {
                let count =
                    |n: u64, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
                let message = format!(
                    "row {} has {}, but the header has {}",
                    self.rows,
                    count(*len, "value"),
                    count(*expected_len, "column")
                );
                let separator = match self.separator {
                    ';' => "semicolon",
                    '\t' => "tab",
                    _ => "comma",
                };
                let decimals = if self.separator == ',' && len > expected_len {
                    "; where cells are separated by commas decimals have a point: write them so, or save the file with semicolons between \
                     the cells"
                } else {
                    ""
                };
                let help = format!(
                    "every row must have as many cells as the header: separate the values as the header does, quote those that \
                     contain a {separator}{decimals}"
                );
                (message, help)
            }
            _ => (
                format!("invalid CSV: {error}"),
                "write a header, and below it one row for each line".to_owned(),
            ),
        };
        let from = error.position().map_or(0, |p| p.byte() as usize);
        Problem::new(message)
            .at(line_from(self.text, from), "this row")
            .help(help)
    }

    /// Number of lines to the end of the header.
    pub fn header_lines(&self) -> usize {
        let above = self.text.get(..header_place(self.text).start);
        above.unwrap_or_default().matches('\n').count() + 1
    }

    /// Line number of the current row in the text.
    pub fn line(&self) -> usize {
        self.record.position().map_or(0, Position::line) as usize
    }

    /// The place of the current row.
    pub fn row_place(&self) -> Range<usize> {
        line_from(self.text, self.start())
    }

    /// The place of a cell of the current row.
    pub fn place(&self, index: usize) -> Range<usize> {
        self.find(self.start(), index, self.record.get(index))
    }

    /// The place of a title in the header.
    pub fn title_place(&self, index: usize) -> Range<usize> {
        self.find(0, index, self.header.get(index))
    }

    /// Reads the unit of a column, one of the `kinds`, from its title.
    ///
    /// # Errors
    /// Errors of `read`.
    pub fn unit<U>(
        &self,
        index: usize,
        kinds: &[&Kind],
        read: impl FnOnce(&str) -> std::result::Result<U, Fault>,
    ) -> Result<U> {
        let title = self.header.get(index).unwrap_or_default();
        let (name, unit) = name_and_unit(title);
        read(unit.unwrap_or_default()).map_err(|fault| {
            let help = match (unit, kinds) {
                (None, [kind, ..]) => {
                    let name = plain::cut(name);
                    format!("write \"{name} [{}]\"; {}", kind.unit, fault.help)
                }
                _ => fault.help,
            };
            Problem::new(format!(
                "the column \"{}\" {}",
                plain::cut(title),
                fault.message
            ))
            .at(self.title_place(index), fault.label)
            .help(help)
        })
    }

    fn start(&self) -> usize {
        self.record.position().map_or(0, |p| p.byte() as usize)
    }

    /// The place of `cell`, number `index` in the row after byte `from`; separators in quotes do not count.
    fn find(&self, from: usize, index: usize, cell: Option<&str>) -> Range<usize> {
        let row = row_start(self.text, from);
        let rest = self.text.get(row..).unwrap_or_default();
        let mut quoted = false;
        let separators = rest.char_indices().filter(|(_, c)| {
            quoted ^= *c == '"';
            *c == self.separator && !quoted
        });
        let mut starts = std::iter::once(0).chain(separators.map(|(at, _)| at + 1));
        let start = starts.nth(index).unwrap_or(0);
        let from = rest.get(start..).unwrap_or_default();
        let within = |cell: &str| {
            let at_once = from.starts_with(cell).then_some(0);
            at_once.or_else(|| from.lines().next()?.find(cell))
        };
        match cell.and_then(|cell| Some((within(cell)?, cell.len()))) {
            Some((at, length)) => row + start + at..row + start + at + length,
            None => row + start..row + start,
        }
    }
}

/// The first hidden character of a row, with the index of its cell.
fn hidden(row: &StringRecord) -> Option<(usize, char)> {
    row.iter()
        .enumerate()
        .find_map(|(index, cell)| Some((index, plain::hidden(cell)?)))
}

/// Start of the row after byte `from`: after a byte order mark, comments and blank lines.
fn row_start(text: &str, from: usize) -> usize {
    let mut start = from.min(text.len());
    if start == 0 && text.starts_with('\u{feff}') {
        start = '\u{feff}'.len_utf8();
    }
    for line in text.get(start..).unwrap_or_default().split_inclusive('\n') {
        if !(line.starts_with('#') || line.trim().is_empty()) {
            break;
        }
        start += line.len();
    }
    start
}

/// The place of the header: the first line that is not a comment.
pub fn header_place(text: &str) -> Range<usize> {
    line_from(text, 0)
}

/// The header as written.
pub fn header_of(text: &str) -> &str {
    text.get(header_place(text)).unwrap_or_default()
}

/// The place of the row after byte `from`.
fn line_from(text: &str, from: usize) -> Range<usize> {
    let start = row_start(text, from);
    let line = text.get(start..).and_then(|rest| rest.lines().next());
    start..start + line.map_or(0, str::len)
}

/// A number; its decimal sign can be a comma if cells are not separated by commas.
pub fn number_of(field: &str, separator: char) -> Option<f64> {
    let number = if separator != ',' && field.contains(',') && !field.contains('.') {
        field.replacen(',', ".", 1).parse()
    } else {
        field.parse()
    };
    number.ok().filter(|value: &f64| value.is_finite())
}

/// Whether a text is a unit of a column.
pub fn is_unit(text: &str) -> bool {
    unit::read_listed(unit::power_of_ten(&unit::tidy(text)).1).is_ok()
}

/// Name and unit of a title `name [unit]` or `name (unit)`; `None` without a unit.
pub fn name_and_unit(title: &str) -> (&str, Option<&str>) {
    let within = |open, close| {
        title
            .strip_suffix(close)
            .and_then(|t: &str| t.rsplit_once(open))
    };
    // Round brackets without a unit belong to the name.
    let round = within('(', ')').filter(|(_, unit)| is_unit(unit));
    let split = within('[', ']').or(round);
    split.map_or((title, None), |(name, unit)| {
        (name.trim_end(), Some(unit.trim()))
    })
}
