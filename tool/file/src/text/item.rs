//! One value of the machine file with its place, converted to the type of its key.

use std::borrow::Cow;
use std::ops::Range;

use toml::Spanned;
use toml::de::DeValue;

use super::key::{Kinds, ValueForm, ValueRange};
use super::problem::{Problem, Result, quoted};
use super::tree;
use super::value::Value;
use crate::number::rounding::figure;
use crate::plain;
use crate::units::kind::{Kind, SHARE};
use crate::units::quantity;
use crate::units::{Fault, did_you_mean};

mod list;

/// A value with its name for messages.
#[derive(Clone, Debug)]
pub struct Item<'a> {
    /// "`length` in [mechanism.crank]"
    name: String,
    key: &'static str,
    /// The key in the text; for the elements of a list, the value.
    key_span: Range<usize>,
    value: &'a Spanned<DeValue<'a>>,
    /// Its form, and the value that messages propose, if its key is described.
    form: Option<ValueForm>,
    example: &'static str,
    /// Whether the coordinate of its quantities is a length.
    slides: bool,
}

/// The kind of a value whose description is not that of a quantity, which is a fault of this program: a test reads every key.
const NO_KIND: Kind = Kind {
    name: "a value that is described",
    ..SHARE
};

impl<'a> Item<'a> {
    pub(crate) fn new(
        name: String,
        key: &'static str,
        key_span: Range<usize>,
        value: &'a Spanned<DeValue<'a>>,
    ) -> Self {
        Self {
            name,
            key,
            key_span,
            value,
            form: None,
            example: "",
            slides: false,
        }
    }

    /// The same with a description.
    pub(crate) fn described(
        self,
        form: Option<ValueForm>,
        example: &'static str,
        slides: bool,
    ) -> Self {
        Self {
            form,
            example,
            slides,
            ..self
        }
    }

    /// The place of the value.
    pub fn span(&self) -> Range<usize> {
        self.value.span()
    }

    /// The place of the key.
    pub fn key_span(&self) -> Range<usize> {
        self.key_span.clone()
    }

    /// A problem with this value: "`length` in [mechanism.crank] " followed by `what`.
    pub fn problem(&self, what: &str, label: &str) -> Problem {
        Problem::new(format!("{} {what}", self.name)).at(self.span(), label)
    }

    /// The problem for a fault of this value.
    pub fn fault(&self, fault: Fault) -> Problem {
        self.problem(&fault.message, &fault.label).help(fault.help)
    }

    fn wrong_type(&self, expected: &str, example: &str) -> Problem {
        let found = match self.value.get_ref() {
            DeValue::String(_) => "a text in quotes",
            DeValue::Integer(_) | DeValue::Float(_) => "a plain number",
            DeValue::Boolean(_) => "true or false",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        self.problem(&format!("must be {expected}, but is {found}"), "here")
            .help(format!("write {example}"))
    }

    /// A quantity of the `kind`.
    pub(crate) fn quantity(&self, kind: &'static Kind) -> Result<Value> {
        let read = match self.value.get_ref() {
            DeValue::String(text) => quantity::read(text, kind),
            DeValue::Integer(_) | DeValue::Float(_) => {
                let number = tree::plain_number(self.value.get_ref());
                if !number.is_some_and(f64::is_finite) {
                    Err(quantity::not_finite(kind))
                } else if kind.unit == "%" {
                    quantity::share(number.unwrap_or(f64::NAN).to_string())
                } else {
                    Err(quantity::no_unit(&figure(number.unwrap_or(f64::NAN)), kind))
                }
            }
            _ => {
                let example = format!("{} = \"{}\"", self.key, kind.example);
                return Err(
                    self.wrong_type(&format!("{} as a text in quotes", kind.name), &example)
                );
            }
        };
        let quantity = read.map_err(|fault| self.fault(fault))?;
        Ok(Value {
            si: quantity.si,
            quantity,
            kind,
            name: self.name.clone(),
            span: self.span(),
        })
    }

    /// The value that messages propose.
    fn example(&self) -> String {
        let form = self.form;
        form.map_or_else(String::new, |form| form.example(self.example, self.slides))
    }

    /// The line that messages propose.
    pub(crate) fn line(&self) -> String {
        format!("{} = {}", self.key, self.example())
    }

    /// The kinds of its quantities.
    fn kinds(&self) -> (Kinds, ValueRange) {
        let kinds = |form| match form {
            ValueForm::Quantity(kinds, limit) => Some((kinds, limit)),
            ValueForm::Pair(kinds) => Some((kinds, ValueRange::Any)),
            _ => None,
        };
        let found = self.form.and_then(|form| form.first(kinds));
        found.unwrap_or(([&NO_KIND; 2], ValueRange::Any))
    }

    /// The quantity that its description asks for, within its limits.
    pub(crate) fn value(&self) -> Result<Value> {
        let (kinds, limit) = self.kinds();
        let value = self.quantity(kinds[usize::from(self.slides)])?;
        value.check(limit)?;
        Ok(value)
    }

    /// The two quantities that its description asks for, with their places.
    pub(crate) fn values(&self) -> Result<[Value; 2]> {
        let (kinds, _) = self.kinds();
        self.pair([kinds[usize::from(self.slides)]; 2])
    }

    /// The same in SI.
    pub(crate) fn two(&self) -> Result<[f64; 2]> {
        Ok(self.values()?.map(|value| value.si))
    }

    /// The plain number that its description asks for.
    pub(crate) fn figure(&self) -> Result<f64> {
        let limits = |form| match form {
            ValueForm::Number(limits) => Some(limits),
            _ => None,
        };
        let limits = self.form.and_then(|form| form.first(limits));
        self.number(limits.unwrap_or([f64::MIN, f64::MAX]), &self.example())
    }

    /// The whole number that its description asks for.
    pub(crate) fn whole(&self) -> Result<u32> {
        let Some(ValueForm::Count(limits)) = self.form else {
            return self.count(u32::MAX, "1");
        };
        self.count_within(limits, &self.example())
    }

    /// The index of the word that its description knows.
    pub(crate) fn word(&self) -> Result<usize> {
        let Some(ValueForm::Words(words)) = self.form else {
            return Ok(0);
        };
        self.choice(words)
    }

    /// The text that its description asks for.
    pub(crate) fn words_of_text(&self) -> Result<&'a str> {
        self.text(self.example().trim_matches('"'))
    }

    /// A plain number from `min` to `max`.
    pub(crate) fn number(&self, [min, max]: [f64; 2], example: &str) -> Result<f64> {
        let example = format!("{} = {example}", self.key);
        let is_number = matches!(
            self.value.get_ref(),
            DeValue::Float(_) | DeValue::Integer(_)
        );
        if !is_number {
            return Err(self.wrong_type("a plain number without quotes and unit", &example));
        }
        match tree::plain_number(self.value.get_ref()) {
            Some(number) if (min..=max).contains(&number) => Ok(number),
            Some(number) if number.is_finite() => Err(self
                .problem(
                    &format!(
                        "is {number}, but must be between {} and {}",
                        figure(min),
                        figure(max)
                    ),
                    "here",
                )
                .help(format!("write for instance {example}"))),
            _ => Err(self
                .problem("is not a finite number", "here")
                .help(format!("write {example}"))),
        }
    }

    /// A whole number from 1 to `max`.
    pub(crate) fn count(&self, max: u32, example: &str) -> Result<u32> {
        self.count_within([1, max], example)
    }

    fn count_within(&self, [min, max]: [u32; 2], example: &str) -> Result<u32> {
        let example = format!("{} = {example}", self.key);
        let DeValue::Integer(integer) = self.value.get_ref() else {
            return Err(self.wrong_type("a whole number without quotes", &example));
        };
        match u32::from_str_radix(integer.as_str(), integer.radix()) {
            Ok(count) if (min..=max).contains(&count) => Ok(count),
            _ => Err(self
                .problem(
                    &format!(
                        "is {}, but must be between {min} and {max}",
                        plain::cut(integer.as_str())
                    ),
                    "here",
                )
                .help(format!("write for instance {example}"))),
        }
    }

    /// A text that is not empty.
    pub(crate) fn text(&self, example: &str) -> Result<&'a str> {
        let example = format!("{} = \"{example}\"", self.key);
        let DeValue::String(text) = self.value.get_ref() else {
            return Err(self.wrong_type("a text in quotes", &example));
        };
        if text.trim().is_empty() {
            return Err(self
                .problem("is empty", "here")
                .help(format!("write for instance {example}")));
        }
        Ok(text.trim())
    }

    /// The plain value as text: a text, a number, "yes" or "no", or the texts of a list separated by semicolons.
    ///
    /// # Errors
    /// The value is anything else.
    pub fn words(&self) -> Result<Cow<'a, str>> {
        let words = match self.value.get_ref() {
            DeValue::String(text) => Cow::Borrowed(text.trim()),
            DeValue::Integer(number) => Cow::Owned(number.to_string()),
            DeValue::Float(number) => Cow::Owned(number.to_string()),
            DeValue::Boolean(true) => Cow::Borrowed("yes"),
            DeValue::Boolean(false) => Cow::Borrowed("no"),
            DeValue::Array(items) => {
                let texts = items.iter().map(|item| item.get_ref().as_str());
                let texts: Option<Vec<&str>> = texts.collect();
                let texts = texts.ok_or_else(|| {
                    self.problem("contains something that is not a text", "here")
                        .help("write a list of quoted texts: [\"…\", \"…\"]")
                })?;
                Cow::Owned(texts.join("; "))
            }
            _ => return Err(self.wrong_type("a text or a number", "a quoted text or a number")),
        };
        Ok(words)
    }

    /// Whether the value is this text.
    pub(crate) fn is_word(&self, word: &str) -> bool {
        matches!(self.value.get_ref(), DeValue::String(text) if text.trim() == word)
    }

    /// `true` or `false`.
    pub(crate) fn flag(&self) -> Result<bool> {
        let example = format!("{0} = true or {0} = false, without quotes", self.key);
        self.value
            .get_ref()
            .as_bool()
            .ok_or_else(|| self.wrong_type("true or false", &example))
    }

    /// One of the `words`, as its index.
    pub(crate) fn choice<S: AsRef<str>>(&self, words: &[S]) -> Result<usize> {
        let text = self.text(words.first().map_or("", AsRef::as_ref))?;
        if let Some(index) = words.iter().position(|w| w.as_ref() == text) {
            return Ok(index);
        }
        let near = did_you_mean(text, words);
        Err(self
            .problem(
                &format!(
                    "is \"{}\", which is not a valid choice here",
                    plain::cut(text)
                ),
                "unknown",
            )
            .help(format!("{near}possible: {}", quoted(words))))
    }

    /// Whether the value is a text.
    pub(crate) fn is_text(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::String(_))
    }

    /// Whether the value is a list.
    pub(crate) fn is_list(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::Array(_))
    }

    /// Whether the value is a table.
    pub(crate) fn is_table(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::Table(_))
    }
}
