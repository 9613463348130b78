//! The answer of a command: built once, rendered as text, CSV, JSON and HTML.
//!
//! An [`Answer`] has two sides. Its data is the library's result, serialised as it is: JSON, with a schema from the same types. Its
//! blocks are what a person reads: facts, tables, warnings. The terminal and the pages render the same blocks.

pub mod schema;
pub mod sheet;
mod text;
#[cfg(feature = "workbook")]
mod workbook;

use std::borrow::Cow;
use std::fmt::{Debug, Formatter, Result as FmtResult};
use std::rc::Rc;

use serde_json::{Map, Value};

use crate::table::json::array_parts;
use crate::table::output::{self, Format};
use crate::table::reading::Reading;
use crate::table::screen::Screen;
use crate::units;
use jred_file::number::columns::Columns;
use schema::Data;

/// A part of an answer for reading.
#[derive(Clone, Debug)]
pub(crate) enum Block {
    /// A heading of the facts and tables behind it.
    Heading(String),
    /// A name and its text.
    Fact(String, String),
    /// A table.
    Table(Reading),
    /// A sentence of its own.
    Sentence(String),
    /// A warning.
    Warning(String),
    /// Lines to copy, as they are.
    Code(String),
}

impl Block {
    /// The block in the units of results. Lines to copy stay as they are.
    pub(crate) fn shown(&self) -> Self {
        let text = |words: &str| units::text(words).into_owned();
        match self {
            Self::Heading(words) => Self::Heading(text(words)),
            Self::Fact(name, words) => Self::Fact(text(name), text(words)),
            Self::Table(table) => Self::Table(table.shown().into_owned()),
            Self::Sentence(words) => Self::Sentence(text(words)),
            Self::Warning(words) => Self::Warning(text(words)),
            Self::Code(_) => self.clone(),
        }
    }
}

/// The answer of a command.
#[derive(Clone, Debug)]
pub struct Answer<'a> {
    title: String,
    pub(crate) blocks: Vec<Block>,
    data: Map<String, Value>,
    course: Option<Cow<'a, Columns>>,
    csv: Option<Made<'a, String>>,
    arrays: Vec<(&'static str, Made<'a, Value>)>,
    /// Columns of a line in a pipe or a file; `None`: lines are not wrapped there.
    narrow: Option<usize>,
}

/// Parts that are made while they are written.
#[derive(Clone)]
struct Made<'a, T>(Rc<dyn Fn() -> Parts<'a, T> + 'a>);

/// Parts, one by one.
pub type Parts<'a, T> = Box<dyn Iterator<Item = T> + 'a>;

impl<T> Debug for Made<'_, T> {
    fn fmt(&self, f: &mut Formatter) -> FmtResult {
        f.write_str("Made")
    }
}

impl<'a> Answer<'a> {
    /// An answer for reading only.
    pub(crate) fn words(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            blocks: Vec::new(),
            data: Map::new(),
            course: None,
            csv: None,
            arrays: Vec::new(),
            narrow: None,
        }
    }

    /// An answer with its data and no blocks.
    pub(crate) fn new<D: Data>(title: impl Into<String>, data: &D) -> Self {
        // Serialisation fails only for a map whose keys are not text.
        let data = serde_json::to_value(data).unwrap_or_default();
        Self::of_map(D::FORM, title.into(), data)
    }

    /// An answer whose data is an object made from columns.
    pub(crate) fn of_map(form: &str, title: String, data: Value) -> Self {
        Self {
            data: schema::headed(form, &title, data),
            ..Self::words(title)
        }
    }

    /// Replaces the title for reading, for example by one with the request.
    pub(crate) fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Adds the rows over time or position: all of the CSV, the end of text and JSON.
    pub(crate) fn course(&mut self, course: Cow<'a, Columns>) {
        self.course = Some(course);
    }

    /// Sets the CSV if it is neither the course nor the first table.
    pub(crate) fn csv(&mut self, csv: String) {
        self.csv_parts(move || once(csv.clone()));
    }

    /// Sets the CSV, made part by part.
    pub(crate) fn csv_parts(&mut self, parts: impl Fn() -> Parts<'a, String> + 'a) {
        self.csv = Some(Made(Rc::new(parts)));
    }

    /// Sets the items of an array of the data, made one by one, where the data have null.
    pub(crate) fn array(&mut self, key: &'static str, items: impl Fn() -> Parts<'a, Value> + 'a) {
        self.arrays.push((key, Made(Rc::new(items))));
    }

    /// Wraps lines to this width in a pipe or a file, too.
    pub(crate) fn narrow(&mut self, width: usize) {
        self.narrow = Some(width);
    }

    pub(crate) fn heading(&mut self, heading: impl Into<String>) {
        self.blocks.push(Block::Heading(heading.into()));
    }

    pub(crate) fn fact(&mut self, name: impl Into<String>, text: impl Into<String>) {
        self.blocks.push(Block::Fact(name.into(), text.into()));
    }

    pub(crate) fn table(&mut self, table: Reading) {
        self.blocks.push(Block::Table(table));
    }

    /// Adds a sentence.
    pub fn sentence(&mut self, sentence: impl Into<String>) {
        self.blocks.push(Block::Sentence(sentence.into()));
    }

    pub(crate) fn warning(&mut self, warning: impl Into<String>) {
        self.blocks.push(Block::Warning(warning.into()));
    }

    pub(crate) fn code(&mut self, code: impl Into<String>) {
        self.blocks.push(Block::Code(code.into()));
    }

    /// The blocks in the units of results.
    pub(crate) fn shown(&self) -> Vec<Block> {
        self.blocks.iter().map(Block::shown).collect()
    }

    /// The data as an object, whose arrays are made one item at a time.
    fn json(&self) -> impl Iterator<Item = String> {
        let entry = |(k, (key, value)): (usize, (&String, &Value))| {
            let items = self.arrays.iter().find(|(own, _)| own == key);
            let value = match items {
                Some((_, items)) => Box::new(array_parts(items.0())),
                None => once(format!("{value:#}").replace('\n', "\n  ")),
            };
            let before = if k == 0 { "{\n  " } else { ",\n  " };
            once(format!("{before}{}: ", Value::from(key.as_str()))).chain(value)
        };
        let entries = self.data.iter().enumerate().flat_map(entry);
        entries.chain(once("\n}\n".to_owned()))
    }

    /// Renders the answer in one of the formats, part by part.
    pub fn write(&self, format: Format, screen: Screen) -> Parts<'_, String> {
        let width = screen.width.or(self.narrow);
        let screen = Screen { width };
        match (&self.course, format) {
            (Some(course), Format::Json) => {
                Box::new(output::json_parts(course, self.data.clone(), Map::new()))
            }
            (None, Format::Json) => Box::new(self.json()),
            (Some(course), Format::Table) => {
                let gap = if self.blocks.is_empty() { "" } else { "\n" };
                let text = self.text(screen);
                output::parts(course, format, &format!("{}{gap}", text.trim_end()))
            }
            (None, Format::Table) => once(self.text(screen)),
            (course, Format::Csv) => match (&self.csv, course) {
                (Some(csv), _) if units::is_si() => csv.0(),
                (Some(csv), _) => once(units::table(csv.0().collect())),
                (None, Some(course)) => output::parts(course, format, ""),
                (None, None) => once(self.tables_as_csv()),
            },
        }
    }

    /// The first table with all digits.
    fn tables_as_csv(&self) -> String {
        let mut tables = self.blocks.iter().filter_map(|block| match block {
            Block::Table(table) => Some(units::table(table.csv())),
            _ => None,
        });
        tables.next().unwrap_or_default()
    }
}

fn once<'p>(text: String) -> Parts<'p, String> {
    Box::new(std::iter::once(text))
}
