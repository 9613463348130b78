//! A table of the machine file. It records which keys were read, so that the others can be reported.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::fmt::Write as _;
use std::ops::Range;

use toml::Spanned;
use toml::de::DeTable;

use super::item::{Item, Value};
use super::problem::{Problem, Result};
use crate::plain;
use crate::units::kind::Kind;
use crate::units::{self, closest, meant};

/// Documents that list all keys.
const KEYS: &str = "docs/machine-file.md or docs/catalogue.md";

/// Most unknown keys that a message about a missing one names.
const MOST_UNKNOWN: usize = 3;

/// A table with its name for messages.
#[derive(Debug)]
pub struct Section<'a> {
    /// "[mechanism.crank]"; empty for the top of the file.
    title: String,
    /// The table's header.
    header: Range<usize>,
    table: &'a DeTable<'a>,
    known: RefCell<Vec<&'static str>>,
    /// Whether the list of known keys is complete, so that any other key is a mistake.
    complete: Cell<bool>,
}

impl<'a> Section<'a> {
    /// The `table` with the place of its header.
    pub fn new(title: String, header: Range<usize>, table: &'a DeTable<'a>) -> Self {
        Self {
            title,
            header,
            table,
            known: RefCell::default(),
            complete: Cell::new(false),
        }
    }

    /// "[mechanism.crank]"
    pub(crate) fn title(&self) -> &str {
        &self.title
    }

    /// The place of the header.
    pub fn header(&self) -> Range<usize> {
        self.header.clone()
    }

    /// A problem with the table as a whole.
    pub(crate) fn problem(&self, message: impl Into<String>, label: &str) -> Problem {
        Problem::new(message).at(self.header.clone(), label)
    }

    /// An error of the core about the table as a whole.
    pub(crate) fn error(&self, error: impl Into<jred::error::Error>, label: &str) -> Problem {
        Problem::of(error).at(self.header.clone(), label)
    }

    /// The same; the message begins with the table's title.
    pub(crate) fn titled(&self, error: impl Into<jred::error::Error>, label: &str) -> Problem {
        let error = error.into();
        let problem = self.problem(format!("{}: {error}", self.title), label);
        problem.help(error.cure().to_string())
    }

    /// "`length` in [mechanism.crank]"
    fn name(&self, key: &str) -> String {
        if self.title.is_empty() {
            format!("`{}`", plain::cut(key))
        } else {
            format!("`{}` in {}", plain::cut(key), self.title)
        }
    }

    /// Registers `keys` as valid, so that they are not reported as typos of one another.
    pub(crate) fn expects(&self, keys: &[&'static str]) {
        for key in keys {
            self.get(key);
        }
    }

    /// Registers `keys` as all further keys of the table: a message about a missing key then names the unknown keys too.
    pub(crate) fn expects_only(&self, keys: &[&'static str]) {
        self.expects(keys);
        self.complete.set(true);
    }

    /// The keys that were not read, in the order of the text.
    fn unread(&self) -> Vec<&Spanned<Cow<'a, str>>> {
        let known = self.known.borrow();
        let keys = self.table.iter().map(|(key, _)| key);
        let mut unread: Vec<_> = keys
            .filter(|key| !known.contains(&key.get_ref().as_ref()))
            .collect();
        unread.sort_by_key(|key| key.span().start);
        unread
    }

    /// The value of `key`, if the table has it; marks the key as read.
    pub fn get(&self, key: &'static str) -> Option<Item<'a>> {
        let mut known = self.known.borrow_mut();
        if !known.contains(&key) {
            known.push(key);
        }
        self.peek(key)
    }

    /// The value of `key` for messages; does not mark the key as read.
    pub fn peek(&self, key: &'static str) -> Option<Item<'a>> {
        let (found, value) = self.table.get_key_value(key)?;
        Some(Item::new(self.name(key), key, found.span(), value))
    }

    /// The value of `key`; `example` is the line to add if it is missing.
    pub(crate) fn require(&self, key: &'static str, example: &str) -> Result<Item<'a>> {
        self.get(key).ok_or_else(|| self.missing(key, example))
    }

    /// The problem of a missing key; names an unread key that looks like a misspelling of it.
    pub(crate) fn missing(&self, key: &'static str, example: &str) -> Problem {
        let unread = self.unread();
        for other in &unread {
            if closest(other.get_ref(), &[key]).is_some() {
                return Problem::new(format!("unknown key {}", self.name(other.get_ref())))
                    .at(other.span(), format!("did you mean \"{key}\"?"))
                    .help(format!("write {example}"));
            }
        }
        let mut problem = self.problem(
            format!("{} is missing", self.name(key)),
            &format!("`{key}` belongs here"),
        );
        let mut help = format!("add {example}");
        if self.complete.get() && !unread.is_empty() {
            let mut words = Vec::new();
            for other in unread.iter().take(MOST_UNKNOWN) {
                problem = problem.at(other.span(), "unknown key");
                words.push(format!("`{}`", plain::cut(other.get_ref())));
            }
            let known = self.known.borrow();
            let others = units::known(key, &known, KEYS);
            let _ = write!(
                help,
                "; unknown here: {}; known here: {others}",
                words.join(", ")
            );
        }
        problem.help(help)
    }

    /// A required quantity.
    pub(crate) fn quantity(&self, key: &'static str, kind: &'static Kind) -> Result<Value> {
        self.require(key, &format!("{key} = \"{}\"", kind.example))?
            .quantity(kind)
    }

    /// An optional quantity.
    pub(crate) fn optional(&self, key: &'static str, kind: &'static Kind) -> Result<Option<Value>> {
        self.get(key).map(|item| item.quantity(kind)).transpose()
    }

    /// Two optional quantities; zero if not given.
    pub(crate) fn point(&self, key: &'static str, kind: &'static Kind) -> Result<[f64; 2]> {
        let Some(item) = self.get(key) else {
            return Ok([0.0, 0.0]);
        };
        Ok(item.pair([kind, kind])?.map(|value| value.si))
    }

    /// All entries in the order of the text, for a table whose keys are names that the user chooses.
    pub fn entries(&self) -> Vec<(&'a str, Item<'a>)> {
        let mut entries: Vec<_> = self.table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        let entry = |(key, value): (&'a Spanned<_>, _)| {
            let name: &'a str = Cow::as_ref(key.get_ref());
            (name, Item::new(self.name(name), "point", key.span(), value))
        };
        entries.into_iter().map(entry).collect()
    }

    /// A required table.
    pub(crate) fn section(&self, key: &'static str) -> Result<Self> {
        let title = self.child(key);
        self.require(key, &title)?.section(title)
    }

    fn child(&self, key: &str) -> String {
        let parent = self.title.trim_start_matches('[').trim_end_matches(']');
        if parent.is_empty() {
            format!("[{key}]")
        } else {
            format!("[{parent}.{key}]")
        }
    }

    /// Reports the first key that was not read.
    pub(crate) fn finish(&self) -> Result<()> {
        self.finish_with(|_| None)
    }

    /// Reports the first key that was not read, with an explanation for keys that belong elsewhere.
    ///
    /// # Errors
    /// A key that was not read; the message names a similar valid key, if there is one.
    pub fn finish_with(&self, explain: impl Fn(&str) -> Option<&'static str>) -> Result<()> {
        let unread = self.unread();
        let Some(key) = unread.first() else {
            return Ok(());
        };
        let known = self.known.borrow();
        let word = key.get_ref().as_ref();
        let label = match meant(word, &known) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => "not a key of this table".to_owned(),
        };
        let others = units::known(word, &known, KEYS);
        let help = explain(word).map_or_else(
            || format!("known here: {others}"),
            |reason| format!("{reason}; known here: {others}"),
        );
        Err(Problem::new(format!("unknown key {}", self.name(word)))
            .at(key.span(), label)
            .help(help))
    }
}
