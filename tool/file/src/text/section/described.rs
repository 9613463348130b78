//! The values of a table, read as the descriptions of its keys say.

use super::Section;
use crate::text::item::Item;
use crate::text::key::{Key, Need, ValueForm};
use crate::text::problem::{Problem, Result};
use crate::text::value::Value;

impl<'a> Section<'a> {
    /// A required value.
    pub(crate) fn need(&self, name: &'static str) -> Result<Item<'a>> {
        self.get(name).ok_or_else(|| self.lacks(name))
    }

    /// The problem that a key is missing.
    pub(crate) fn lacks(&self, name: &'static str) -> Problem {
        let Some(key) = self.description(name) else {
            return self.missing(name, name);
        };
        let example = match key.form {
            ValueForm::Table(_) => format!("{}{}", self.child(name), key.example),
            ValueForm::Tables(..) => format!("{}{}", self.children(name), key.example),
            form => format!("{name} = {}", form.example(key.example, self.slides.get())),
        };
        self.missing(name, &example)
    }

    /// A required quantity within its limits.
    pub(crate) fn value(&self, name: &'static str) -> Result<Value> {
        self.need(name)?.value()
    }

    /// A quantity within its limits, if it is given.
    pub(crate) fn given(&self, name: &'static str) -> Result<Option<Value>> {
        self.get(name).map(|item| item.value()).transpose()
    }

    /// The quantity in SI, if it is given.
    pub(crate) fn maybe(&self, name: &'static str) -> Result<Option<f64>> {
        Ok(self.given(name)?.map(|value| value.si))
    }

    /// The quantity in SI; if not given, its default.
    pub(crate) fn si(&self, name: &'static str) -> Result<f64> {
        match self.description(name).map(|key| (key.form, key.need)) {
            Some((ValueForm::Quantity(kinds, _), Need::Default(default))) => {
                let kind = kinds[usize::from(self.slides.get())];
                Ok(self.maybe(name)?.unwrap_or_else(|| kind.value_of(default)))
            }
            _ => Ok(self.value(name)?.si),
        }
    }

    /// Two quantities in SI; if not given, zero, unless they are required.
    pub(crate) fn two(&self, name: &'static str) -> Result<[f64; 2]> {
        match self.description(name).map(|key| key.need) {
            Some(Need::Required) => self.need(name)?.two(),
            _ => Ok(self.get(name).map_or(Ok([0.0; 2]), |item| item.two())?),
        }
    }

    /// A plain number; if not given, its default.
    pub(crate) fn figure(&self, name: &'static str) -> Result<f64> {
        match (self.get(name), self.default(name)) {
            (None, Some(default)) => Ok(default.parse().unwrap_or(0.0)),
            _ => self.need(name)?.figure(),
        }
    }

    /// A whole number; if not given, its default.
    pub(crate) fn whole(&self, name: &'static str) -> Result<u32> {
        match (self.get(name), self.default(name)) {
            (None, Some(default)) => Ok(default.parse().unwrap_or(0)),
            _ => self.need(name)?.whole(),
        }
    }

    /// Whether a key is `true`; if not given, `false`.
    pub(crate) fn is(&self, name: &'static str) -> Result<bool> {
        self.get(name).map_or(Ok(false), |item| item.flag())
    }

    /// The index of the word that a key has; if not given, of its default.
    pub(crate) fn word(&self, name: &'static str) -> Result<usize> {
        match (self.get(name), self.description(name)) {
            (
                None,
                Some(Key {
                    form: ValueForm::Words(words),
                    need: Need::Default(default),
                    ..
                }),
            ) => Ok(words.iter().position(|word| word == default).unwrap_or(0)),
            _ => self.need(name)?.word(),
        }
    }

    /// The meaning of a key's word; `values` are in the order of the words.
    pub(crate) fn pick<T: Copy, const N: usize>(
        &self,
        name: &'static str,
        values: [T; N],
    ) -> Result<T> {
        let word = self.word(name)?;
        debug_assert!(word < N, "{name}: a word without a value");
        Ok(values[word.min(N - 1)])
    }

    /// A text, if it is given.
    pub(crate) fn text(&self, name: &'static str) -> Result<Option<&'a str>> {
        self.get(name).map(|item| item.words_of_text()).transpose()
    }

    /// A required table.
    pub(crate) fn table(&self, name: &'static str) -> Result<Self> {
        self.need(name)?.section(self.child(name))
    }

    /// A table, if it is given.
    pub(crate) fn maybe_table(&self, name: &'static str) -> Result<Option<Self>> {
        let item = self.get(name);
        item.map(|item| item.section(self.child(name))).transpose()
    }

    /// The tables of a list, in their number; none if the list may be missing.
    pub(crate) fn tables(&self, name: &'static str) -> Result<Vec<Self>> {
        let Some(Key {
            form: ValueForm::Tables(_, [least, most], cure),
            need,
            ..
        }) = self.description(name)
        else {
            return Ok(Vec::new());
        };
        let item = match self.get(name) {
            None if *need != Need::Required => return Ok(Vec::new()),
            None => return Err(self.lacks(name)),
            Some(item) => item,
        };
        let title = self.children(name);
        let tables = item.sections(&title)?;
        if tables.len() < *least {
            return Err(item
                .problem("is empty", "here")
                .help(format!("write at least one {title}")));
        }
        if let Some(surplus) = tables.get(*most) {
            return Err(surplus
                .problem(format!("more than {most} {title}"), "one too many")
                .help(*cure));
        }
        Ok(tables)
    }

    /// The one of some keys that is given, if any is; all are known here.
    pub(crate) fn one_of(&self, names: &[&'static str]) -> Option<(&'static str, Item<'a>)> {
        self.expects(names);
        names.iter().find_map(|name| Some((*name, self.get(name)?)))
    }

    fn default(&self, name: &str) -> Option<&'static str> {
        match self.description(name)?.need {
            Need::Default(default) => Some(default),
            _ => None,
        }
    }

    /// The title without brackets and number: "mechanism.joint".
    fn path(&self) -> &str {
        let inner = self.title.trim_start_matches('[');
        inner.split(']').next().unwrap_or_default()
    }

    /// The title of a table in this one.
    fn child(&self, name: &str) -> String {
        match self.title.strip_suffix(']') {
            _ if self.title.is_empty() => format!("[{name}]"),
            Some(_) => format!("[{}.{name}]", self.path()),
            None => format!("`{name}` of {}", self.title),
        }
    }

    /// The title of a list of tables in this one.
    fn children(&self, name: &str) -> String {
        if self.title.is_empty() {
            return format!("[[{name}]]");
        }
        format!("[[{}.{name}]]", self.path())
    }
}
