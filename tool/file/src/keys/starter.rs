//! New machine files: every key of a type with its meaning as a comment, the required ones with values to begin with.

use std::sync::LazyLock;

use toml::{Table, Value};

use super::{MACHINE, mechanism::MECHANISM};
use crate::text::key::words::plain;
use crate::text::key::{Key, KeyTable, Need, ValueForm};

/// Values to begin with, by type.
static VALUES: LazyLock<Table> =
    LazyLock::new(|| include_str!("starters.toml").parse().unwrap_or_default());

/// Column at which comments begin.
const COMMENT: usize = 36;

/// The types of `[mechanism]`, each with a line about it.
pub fn types() -> impl Iterator<Item = (&'static str, &'static str)> {
    MECHANISM.variants.iter().map(|variant| {
        let about = VALUES
            .get(variant.name)
            .and_then(|values| values.get("about"));
        (
            variant.name,
            about.and_then(Value::as_str).unwrap_or_default(),
        )
    })
}

/// A machine file of this type that can be sized. A key that may be left out is a comment. Tables that a first machine does not need are named with
/// a line each, or written as comments if `all` is set. `None`: there is no such type.
pub fn machine_file(kind: &str, all: bool) -> Option<String> {
    let (kind, about) = types().find(|(name, _)| *name == kind)?;
    let of = |name: &str| {
        VALUES
            .get(name)
            .and_then(Value::as_table)
            .cloned()
            .unwrap_or_default()
    };
    let mut values = of("all");
    values.extend(of(kind));
    let mechanism = values.get_mut("mechanism").and_then(Value::as_table_mut)?;
    mechanism.insert("type".to_owned(), kind.into());
    let is_of_point = values
        .get("motion")
        .and_then(|motion| motion.get("of"))
        .is_some();
    let mut writer = Writer {
        all,
        is_of_point,
        text: String::new(),
    };
    writer.table(&MACHINE, "", Some(&values), true);
    Some(format!(
        "#:schema docs/schemas/machine-file.json\n# {kind}: {about}.\n#\n# Replace the values by those of your machine. A key behind a # may be left out; \
         (…) is its default.\n{}",
        writer.text
    ))
}

struct Writer {
    all: bool,
    /// Whether the motion is that of a point, in lengths.
    is_of_point: bool,
    text: String,
}

impl Writer {
    /// The keys of a table; without `values` all of them are comments. `tells`: with comments and optional keys.
    fn table(&mut self, table: &'static KeyTable, path: &str, values: Option<&Table>, tells: bool) {
        let is_further = |key: &Key| !self.all && table.name == MACHINE.name && is_named(key);
        let keys = keys_of(table, values).into_iter().map(|(table, key)| {
            let given = values.and_then(|values| values.get(key.name));
            let is_active = given.is_some() || values.is_some() && key.need == Need::Required;
            (table, key, given, is_active)
        });
        let keys: Vec<_> = keys
            .filter(|(_, _, _, is_active)| *is_active || tells)
            .collect();
        let (further, keys): (Vec<_>, Vec<_>) = keys
            .into_iter()
            .partition(|(_, key, _, is_active)| !is_active && is_further(key));
        // In TOML the plain keys of a table come before its tables.
        let (tables, plain): (Vec<_>, Vec<_>) = keys
            .into_iter()
            .partition(|(_, key, ..)| inner(key).is_some());
        for (table, key, given, is_active) in plain {
            // `near` is a position of the drive link.
            let slides = self.is_of_point && path.starts_with("motion") && key.name != "near";
            let value = given.map_or_else(|| sample(key, slides), Value::to_string);
            let says = if tells {
                key.says(table)
            } else {
                String::new()
            };
            self.line(is_active, &format!("{} = {value}", key.name), &says);
        }
        for (_, key, given, is_active) in tables {
            let path = format!(
                "{path}{}{}",
                if path.is_empty() { "" } else { "." },
                key.name
            );
            let empty = Table::new();
            let items: Vec<Option<&Table>> = match given {
                Some(Value::Array(items)) => items.iter().map(Value::as_table).collect(),
                Some(value) => vec![value.as_table()],
                None => vec![is_active.then_some(&empty)],
            };
            for (k, item) in items.into_iter().enumerate() {
                let tells = tells && k == 0;
                self.text.push('\n');
                self.line(
                    is_active,
                    &header(key, &path),
                    if tells { key.help } else { "" },
                );
                if let Some(table) = inner(key) {
                    self.table(table, &path, item, tells);
                }
            }
        }
        if !further.is_empty() {
            self.text +=
                "\n# Further tables (docs/machine-file.md; `jred new --all` writes their keys):\n";
        }
        for (_, key, ..) in further {
            self.line(false, &header(key, key.name), key.help);
        }
    }

    fn line(&mut self, is_active: bool, line: &str, comment: &str) {
        let mut line = format!("{}{line}", if is_active { "" } else { "# " });
        if !comment.is_empty() {
            let comment = plain(comment).replace('`', "");
            line = format!("{line:<COMMENT$} # {comment}");
        }
        self.text += &line;
        self.text.push('\n');
    }
}

/// Whether a value is a table with a header of its own, or one of names that the user chooses.
fn is_named(key: &Key) -> bool {
    inner(key).is_some() || matches!(key.form, ValueForm::Named(_))
}

pub(super) fn header(key: &Key, path: &str) -> String {
    match key.form {
        ValueForm::Tables(..) => format!("[[{path}]]"),
        _ => format!("[{path}]"),
    }
}

/// The keys that a table has with its values, each with the table that describes it.
pub(super) fn keys_of(
    table: &'static KeyTable,
    values: Option<&Table>,
) -> Vec<(&'static KeyTable, &'static Key)> {
    let word_of = |by: &str| {
        values
            .and_then(|values| values.get(by))
            .and_then(Value::as_str)
    };
    let chosen = word_of(table.by);
    let is_own = table.key(table.by).is_some();
    // Keys of another form of the table, such as that of a load from a file, are comments.
    let variant = table.variants.iter().copied().find(|variant| match chosen {
        Some(word) => !is_own || word == variant.name,
        None => !is_own && values.is_none(),
    });
    let by = variant.map_or(table.by, |variant| variant.by);
    let default = |by: &str| match table.key(by)?.need {
        Need::Default(word) => Some(word),
        _ => None,
    };
    let word = word_of(by).or_else(|| default(by));
    let own = table.keys().map(|key| (table, key));
    let of_variant = variant
        .into_iter()
        .flat_map(|variant| variant.keys().map(move |key| (variant, key)));
    let mut keys: Vec<_> = own.chain(of_variant).collect();
    keys.retain(|(_, key)| key.only.is_empty() || word.is_none_or(|word| key.is_used_with(word)));
    keys
}

/// The table that a key has under a header of its own.
pub(super) fn inner(key: &Key) -> Option<&'static KeyTable> {
    match key.form {
        ValueForm::Table(table) | ValueForm::Tables(table, ..) => Some(table),
        _ => None,
    }
}

/// The default of a key, or an example.
pub(super) fn sample(key: &Key, slides: bool) -> String {
    match (key.need, key.form) {
        (Need::Default("0"), ValueForm::Quantity(kinds, _)) => {
            format!("\"0 {}\"", kinds[usize::from(slides)].unit)
        }
        (Need::Default("0"), ValueForm::Pair(kinds)) => {
            let unit = kinds[usize::from(slides)].unit;
            format!("[\"0 {unit}\", \"0 {unit}\"]")
        }
        (Need::Default(word), ValueForm::Quantity(..) | ValueForm::Words(_) | ValueForm::Text) => {
            format!("\"{word}\"")
        }
        (Need::Default(value), ValueForm::Flag | ValueForm::Number(_) | ValueForm::Count(_)) => {
            value.to_owned()
        }
        (_, form) => example(form, key.example, slides),
    }
}

/// The example of messages without the words after it, or a value of the form.
fn example(form: ValueForm, given: &str, slides: bool) -> String {
    let proposed = form.example(given, slides);
    let ends = proposed
        .char_indices()
        .map(|(at, c)| at + c.len_utf8())
        .rev();
    let values = ends.filter_map(|end| proposed.get(..end));
    let mut values = values.filter(|value| format!("x = {value}").parse::<Table>().is_ok());
    if let Some(value) = values.next() {
        return value.trim().to_owned();
    }
    let list = |forms: &[ValueForm]| {
        let items: Vec<_> = forms
            .iter()
            .map(|form| example(*form, "", slides))
            .collect();
        format!("[{}]", items.join(", "))
    };
    match form {
        ValueForm::Number([least, most]) => 1f64.clamp(least, most).to_string(),
        ValueForm::Count([least, _]) => least.to_string(),
        ValueForm::File => "\"table.csv\"".to_owned(),
        ValueForm::List(form, [least, _]) => list(&vec![*form; least.max(1)]),
        ValueForm::Tuple(forms) => list(forms),
        ValueForm::Any([first, ..]) => example(*first, "", slides),
        ValueForm::Named(form) => format!("{{ name = {} }}", example(*form, "", slides)),
        ValueForm::Table(_) | ValueForm::Tables(..) => "{}".to_owned(),
        _ => "\"…\"".to_owned(),
    }
}
