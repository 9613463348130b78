//! A table of the machine file, read by the descriptions of its keys. It records which keys were read, so that the others can be reported.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::fmt::Write as _;
use std::ops::Range;

use toml::Spanned;
use toml::de::DeTable;

use super::item::Item;
use super::key::{Key, KeyTable, OPEN, ValueForm};
use super::problem::{Problem, Result};
use crate::plain;
use crate::units::{self, closest, meant};

mod described;

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
    /// The descriptions of its keys, and of those by the word that was chosen.
    keys: &'static KeyTable,
    variant: Cell<Option<&'static KeyTable>>,
    word: Cell<Option<&'static str>>,
    /// The form of its entries, if the user chooses their names.
    entry: Option<ValueForm>,
    /// Whether the coordinate of its quantities is a length.
    slides: Cell<bool>,
    known: RefCell<Vec<&'static str>>,
}

impl<'a> Section<'a> {
    /// The `table` with the place of its header; any key may be asked for.
    pub fn new(title: String, header: Range<usize>, table: &'a DeTable<'a>) -> Self {
        Self::described(title, header, table, (&OPEN, false))
    }

    /// The `table` with the descriptions of its keys. `slides`: whether the coordinate of its quantities is a length.
    pub(crate) fn described(
        title: String,
        header: Range<usize>,
        table: &'a DeTable<'a>,
        (keys, slides): (&'static KeyTable, bool),
    ) -> Self {
        Self {
            title,
            header,
            table,
            keys,
            variant: Cell::new(None),
            word: Cell::new(None),
            entry: None,
            slides: Cell::new(slides),
            known: RefCell::default(),
        }
    }

    /// The same; the user chooses the names of its entries, which hold this.
    pub(crate) fn of_entries(self, entry: ValueForm) -> Self {
        let entry = Some(entry);
        Self { entry, ..self }
    }

    /// Sets whether the coordinate of the quantities that are read from now on is a length.
    pub(crate) fn set_slides(&self, slides: bool) {
        self.slides.set(slides);
    }

    /// Whether the coordinate of its quantities is a length.
    pub(crate) fn slides(&self) -> bool {
        self.slides.get()
    }

    /// Chooses the keys that are used with a word.
    pub(crate) fn choose(&self, word: &'static str) {
        self.word.set(Some(word));
    }

    /// Adds the keys of a variant.
    pub(crate) fn vary(&self, variant: &'static KeyTable) -> Result<()> {
        self.variant.set(Some(variant));
        self.not_both(variant)
    }

    /// Refuses keys that exclude one another.
    pub(crate) fn not_both(&self, table: &KeyTable) -> Result<()> {
        for (keys, cure) in table.either {
            let mut given = keys
                .iter()
                .filter_map(|key| Some((key, self.table.get_key_value(*key)?.0.span())));
            if let (Some((first, one)), Some((second, other))) = (given.next(), given.next()) {
                return Err(Problem::new(format!(
                    "{} has both `{first}` and `{second}`",
                    self.title
                ))
                .at(one, "one")
                .at(other, "the other")
                .help(*cure));
            }
        }
        Ok(())
    }

    /// The name of the variant.
    pub(crate) fn chosen(&self) -> &'static str {
        self.variant.get().map_or("", |variant| variant.name)
    }

    /// The descriptions of all keys, in their order.
    fn keys(&self) -> impl Iterator<Item = &'static Key> {
        let further = self.variant.get().into_iter().flat_map(KeyTable::keys);
        self.keys.keys().chain(further)
    }

    /// The description of a key.
    fn description(&self, name: &str) -> Option<&'static Key> {
        self.keys().find(|key| key.name == name)
    }

    /// Whether a key is described.
    pub(crate) fn describes(&self, name: &str) -> bool {
        self.description(name).is_some()
    }

    /// Whether a key is described, and used with the word that was chosen.
    fn is_used(&self, name: &str) -> bool {
        let word = self.word.get();
        self.description(name)
            .is_some_and(|key| word.is_none_or(|word| key.is_used_with(word)))
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
        let item = Item::new(self.name(key), key, found.span(), value);
        let (form, example) = self
            .description(key)
            .map_or((None, ""), |key| (Some(key.form), key.example));
        Some(item.described(form, example, self.slides.get()))
    }

    /// The value of `key`; `example` is the line to add if it is missing.
    pub(crate) fn require(&self, key: &'static str, example: &str) -> Result<Item<'a>> {
        self.get(key).ok_or_else(|| self.missing(key, example))
    }

    /// The problem of a missing key; names an unread key that looks like a misspelling of it.
    pub(crate) fn missing(&self, key: &'static str, example: &str) -> Problem {
        let mut unread = self.unread();
        unread.retain(|other| !self.is_used(other.get_ref()));
        for other in &unread {
            if closest(other.get_ref(), &[key]).is_some() {
                return Problem::new(format!("unknown key {}", self.name(other.get_ref())))
                    .at(other.span(), format!("did you mean \"{key}\"?"))
                    .help(format!("write {example}"));
            }
            if let Some(reason) = self.elsewhere(other.get_ref()) {
                return Problem::new(format!("unknown key {}", self.name(other.get_ref())))
                    .at(other.span(), "not a key of this table")
                    .help(format!("{reason}; add {example}"));
            }
        }
        let mut problem = self.problem(
            format!("{} is missing", self.name(key)),
            &format!("`{key}` belongs here"),
        );
        let mut help = format!("add {example}");
        unread.retain(|other| self.description(other.get_ref()).is_none());
        // Without the word that decides, no key is known to be wrong.
        if !self.keys.is_open() && key != self.keys.by && !unread.is_empty() {
            let mut words = Vec::new();
            for other in unread.into_iter().take(MOST_UNKNOWN) {
                problem = problem.at(other.span(), "unknown key");
                words.push(format!("`{}`", plain::cut(other.get_ref())));
            }
            let used = self.keys().filter(|key| self.is_used(key.name));
            let used: Vec<&str> = used.map(|key| key.name).collect();
            let others = units::known(key, &used, KEYS);
            let _ = write!(
                help,
                "; unknown here: {}; known here: {others}",
                words.join(", ")
            );
        }
        problem.help(help)
    }

    /// All entries in the order of the text, for a table whose keys are names that the user chooses.
    pub fn entries(&self) -> Vec<(&'a str, Item<'a>)> {
        let mut entries: Vec<_> = self.table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        let entry = |(key, value): (&'a Spanned<_>, _)| {
            let name: &'a str = Cow::as_ref(key.get_ref());
            let item = Item::new(self.name(name), "point", key.span(), value);
            (name, item.described(self.entry, "", self.slides.get()))
        };
        entries.into_iter().map(entry).collect()
    }

    /// Reports the first key that was not read; its description, or that of its table, says where it belongs.
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
            return self.all_described();
        };
        let word = key.get_ref().as_ref();
        let mut known = self.known.borrow().clone();
        if !self.keys.is_open() {
            let place = |name: &&str| self.keys().position(|key| key.name == *name);
            known.sort_by_key(place);
        }
        let label = match meant(word, &known) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None if self.description(word).is_some() => "not used here".to_owned(),
            None => "not a key of this table".to_owned(),
        };
        let others = units::known(word, &known, KEYS);
        let reason = explain(word).map(Cow::Borrowed);
        let help = reason.or_else(|| self.belongs(word)).map_or_else(
            || format!("known here: {others}"),
            |reason| format!("{reason}; known here: {others}"),
        );
        Err(Problem::new(format!("unknown key {}", self.name(word)))
            .at(key.span(), label)
            .help(help))
    }

    /// Refuses to go on if a reader asked for a key without a description.
    fn all_described(&self) -> Result<()> {
        let known = self.known.borrow();
        let stranger = known.iter().find(|name| self.description(name).is_none());
        match stranger.filter(|_| !self.keys.is_open()) {
            None => Ok(()),
            Some(name) => Err(self.problem(
                format!(
                    "{} is read, but not described: a fault of this program",
                    self.name(name)
                ),
                "in this table",
            )),
        }
    }

    /// Where a key that users look for here belongs.
    fn elsewhere(&self, name: &str) -> Option<&'static str> {
        let tables = self.variant.get().into_iter().chain([self.keys]);
        let mut elsewhere = tables.flat_map(|table| table.elsewhere);
        Some(elsewhere.find(|(key, _)| *key == name)?.1)
    }

    /// Where a key that is not used here belongs, in words.
    fn belongs(&self, name: &str) -> Option<Cow<'static, str>> {
        if let Some(words) = self.elsewhere(name) {
            return Some(Cow::Borrowed(words));
        }
        let key = self.description(name).filter(|_| !self.is_used(name))?;
        let words: Vec<String> = key.only.iter().map(|word| format!("\"{word}\"")).collect();
        let words = words.join(", ");
        Some(Cow::Owned(format!(
            "`{name}` is for {} = {words}",
            self.keys.by
        )))
    }
}
