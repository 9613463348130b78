//! The quantities of a machine file by path, and the file with some of them changed.
//!
//! A path consists of the keys from the top of the file, joined by points: `mechanism.slider.mass`, `motion.segment.1.duration`. An element of a list
//! is named by its number, from 1 as in messages, or by its `name`: `load.guide friction.opposing_force`. Leading keys may be omitted while the rest
//! identifies one quantity: `slider.mass`.
//!
//! A changed file is the text with other numbers in the same places, so that a message shows the line that the user knows.

use jred_file::plain;
use jred_file::problem;
use jred_file::text::problem::Result;
use jred_file::text::tree;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use jred_file::units::closest;
use jred_file::units::literal;
use jred_file::units::literal::Literal;

/// Tables and keys whose texts are never quantities of the machine.
const NOT_VARIED: [&str; 4] = ["title", "name", "tolerance", "document"];

/// Notation of a quantity in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Notation {
    /// A text in quotes.
    Text,
    /// A whole number.
    Whole,
    /// A number with a decimal point.
    Plain,
}

/// One quantity of the file.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// Its full path.
    pub path: String,
    /// Number and unit.
    pub(crate) literal: Literal,
    /// The words that match each step of the path.
    steps: Vec<Vec<String>>,
    span: Range<usize>,
    written: Notation,
}

impl Quantity {
    /// The number as written, in [`unit`](Self::unit).
    pub const fn number(&self) -> f64 {
        self.literal.number
    }

    /// The unit as written; empty for a plain number.
    pub fn unit(&self) -> &str {
        &self.literal.unit
    }

    /// Number and unit.
    pub fn shown(&self) -> String {
        self.literal.shown()
    }

    /// Its place in the text.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// Whether it is a count, such as a number of teeth, or a number written like one.
    pub fn is_whole(&self) -> bool {
        self.written == Notation::Whole
    }

    /// `number` in `unit`, as written in place of the quantity.
    fn text(&self, number: f64, unit: &str) -> String {
        let float = format!("{number:?}");
        let short = float.strip_suffix(".0").unwrap_or(&float);
        match self.written {
            Notation::Text => format!("\"{}\"", format!("{short} {unit}").trim_end()),
            _ if !unit.is_empty() => format!("\"{short} {unit}\""),
            // Whole numbers stay whole, so that counts may be varied.
            Notation::Whole if number.fract() == 0.0 && number.abs() < 1e15 => {
                format!("{number:.0}")
            }
            _ => float,
        }
    }
}

/// A new value for a quantity of [`Document::quantities`].
#[derive(Clone, Debug)]
pub struct Edit<'a> {
    /// Index of the quantity.
    pub quantity: usize,
    /// The new number.
    pub number: f64,
    /// The unit of the number.
    pub unit: &'a str,
}

/// A machine file as text, with the positions of its quantities.
#[derive(Clone, Debug)]
pub struct Document {
    text: String,
    quantities: Vec<Quantity>,
}

impl Document {
    /// Finds the quantities of a machine file that was read without error.
    ///
    /// # Errors
    /// The text is not TOML.
    pub fn parse(text: String) -> Result<Self> {
        let mut finder = Finder::default();
        finder.table(tree::parse(&text)?.get_ref());
        let mut quantities = finder.found;
        quantities.sort_by_key(|quantity| quantity.span.start);
        Ok(Self { text, quantities })
    }

    /// The original text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Every quantity, in the order of the text.
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// The text with some quantities changed; of two edits of one quantity the last applies.
    pub fn with(&self, edits: &[Edit]) -> String {
        let mut ordered: Vec<&Edit> = edits.iter().collect();
        ordered.sort_by_key(|edit| edit.quantity);
        let mut text = String::with_capacity(self.text.len() + 16 * edits.len());
        let mut end = 0;
        for (k, edit) in ordered.iter().enumerate() {
            if ordered
                .get(k + 1)
                .is_some_and(|next| next.quantity == edit.quantity)
            {
                continue;
            }
            let Some(quantity) = self.quantities.get(edit.quantity) else {
                continue;
            };
            text += self.text.get(end..quantity.span.start).unwrap_or_default();
            text += &quantity.text(edit.number, edit.unit);
            end = quantity.span.end;
        }
        text + self.text.get(end..).unwrap_or_default()
    }

    /// The index of the quantity with this path.
    ///
    /// # Errors
    /// The path matches no quantity, or several.
    pub fn find(&self, path: &str) -> Result<usize> {
        let wanted = steps(path);
        let answers: Vec<usize> = (0..self.quantities.len())
            .filter(|k| self.quantities.get(*k).is_some_and(|q| q.answers(&wanted)))
            .collect();
        let in_full = |k: &&usize| {
            let quantity = self.quantities.get(**k);
            quantity.is_some_and(|q| q.steps.len() == wanted.len())
        };
        if let [one] = answers.as_slice() {
            return Ok(*one);
        }
        if let Some(one) = answers.iter().find(in_full) {
            return Ok(*one);
        }
        let paths = |indices: &[usize]| -> Vec<String> {
            let found = indices.iter().filter_map(|k| self.quantities.get(*k));
            found.map(|q| format!("\"{}\"", q.path)).collect()
        };
        if !answers.is_empty() {
            return Err(problem!(
                help = format!("write more of its path: {}", paths(&answers).join(" or ")),
                "{} names {} quantities of the machine file",
                plain::quoted(path),
                answers.len()
            ));
        }
        Err(problem!(
            help = self.nearest(path),
            "the machine file has no quantity {}",
            plain::quoted(path)
        ))
    }

    fn nearest(&self, path: &str) -> String {
        let endings = self.quantities.iter().flat_map(|q| {
            let whole = q.path.as_str();
            std::iter::once(whole).chain(
                whole
                    .match_indices('.')
                    .filter_map(move |(at, _)| whole.get(at + 1..)),
            )
        });
        let endings: Vec<&str> = endings.collect();
        let from_one = steps(path).iter().any(|step| step == "0");
        if let Some(near) = closest(path, &endings).filter(|_| !from_one) {
            return format!("did you mean \"{near}\"?");
        }
        if from_one {
            return "elements of a list are counted from 1: the first is number 1".to_owned();
        }
        let last = steps(path).pop().unwrap_or_default();
        let same: Vec<String> = (self.quantities.iter())
            .filter(|q| q.steps.last().is_some_and(|step| step.contains(&last)))
            .map(|q| format!("\"{}\"", q.path))
            .collect();
        if same.is_empty() {
            "write a quantity with a default value into the file first; a word is changed in the text; `jred sensitivity` lists the quantities"
                .to_owned()
        } else {
            format!("there is {}", same.join(", "))
        }
    }
}

/// The steps of a path. Points inside double quotes do not separate.
pub fn steps(path: &str) -> Vec<String> {
    let (mut steps, mut quoted) = (vec![String::new()], false);
    for c in path.chars() {
        match c {
            '"' => quoted = !quoted,
            '.' if !quoted => steps.push(String::new()),
            _ => steps.last_mut().into_iter().for_each(|step| step.push(c)),
        }
    }
    steps.iter().map(|step| step.trim().to_owned()).collect()
}

impl Quantity {
    /// Whether the last steps of its path match these.
    fn answers(&self, wanted: &[String]) -> bool {
        let spare = self.steps.len().checked_sub(wanted.len());
        spare.is_some_and(|spare| {
            let own = self.steps.iter().skip(spare);
            own.zip(wanted).all(|(words, word)| words.contains(word))
        })
    }
}

/// Walks through the file.
#[derive(Default)]
struct Finder {
    found: Vec<Quantity>,
    steps: Vec<Vec<String>>,
}

impl Finder {
    fn table(&mut self, table: &DeTable) {
        for (key, value) in table {
            let key = key.get_ref().as_ref();
            if !NOT_VARIED.contains(&key) {
                self.steps.push(vec![key.to_owned()]);
                self.value(value);
                self.steps.pop();
            }
        }
    }

    /// Element `k`, from 0, of a list whose elements have these names.
    fn element(&mut self, k: usize, names: &[Option<String>], walk: impl FnOnce(&mut Self)) {
        let name = names.get(k).and_then(Option::as_ref);
        let single = |name: &&String| names.iter().flatten().filter(|n| n == name).count() == 1;
        let words = name
            .filter(single)
            .cloned()
            .into_iter()
            .chain([(k + 1).to_string()]);
        self.steps.push(words.collect());
        walk(self);
        self.steps.pop();
    }

    fn value(&mut self, value: &Spanned<DeValue>) {
        let plain = || tree::plain_number(value.get_ref()).map(Literal::plain);
        let (literal, written) = match value.get_ref() {
            DeValue::String(text) => (literal::read(text).ok(), Notation::Text),
            DeValue::Integer(_) => (plain(), Notation::Whole),
            DeValue::Float(_) => (plain(), Notation::Plain),
            DeValue::Table(table) => return self.table(table),
            DeValue::Array(list) => {
                let name = |value: &Spanned<DeValue>| {
                    let name = value.get_ref().as_table()?.get("name")?;
                    name.get_ref().as_str().map(ToOwned::to_owned)
                };
                let names: Vec<Option<String>> = list.iter().map(name).collect();
                for (k, value) in list.iter().enumerate() {
                    self.element(k, &names, |finder| finder.value(value));
                }
                return;
            }
            DeValue::Boolean(_) | DeValue::Datetime(_) => return,
        };
        if let Some(literal) = literal {
            let first = |words: &Vec<String>| match words.first() {
                Some(word) if word.contains('.') => format!("\"{word}\""),
                word => word.cloned().unwrap_or_default(),
            };
            self.found.push(Quantity {
                path: self.steps.iter().map(first).collect::<Vec<_>>().join("."),
                literal,
                steps: self.steps.clone(),
                span: value.span(),
                written,
            });
        }
    }
}
