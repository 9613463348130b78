//! The descriptions of the keys: every one is read, the tables of the documentation and the schema for editors follow from them.
//!
//! `JRED_BLESS=1 cargo test -p jred-file keys` writes the tables and the schema anew.

mod described;
mod pattern;
mod schema;
mod starter;
mod tables;
mod validated;

use std::path::{Path, PathBuf};

use jred_file::keys::{MACHINE, PROJECT, RULE_SET};
use jred_file::text::key::words::{plain, words_of};
use jred_file::text::key::{Key, KeyTable, Need, ValueForm};
use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Whether files are written anew.
fn blesses() -> bool {
    std::env::var_os("JRED_BLESS").is_some()
}

/// The tables that a form holds.
fn tables_of(form: ValueForm) -> Vec<&'static KeyTable> {
    match form {
        ValueForm::Table(table) | ValueForm::Tables(table, ..) => vec![table],
        ValueForm::Named(inner) | ValueForm::List(inner, _) => tables_of(*inner),
        ValueForm::Any(forms) | ValueForm::Tuple(forms) => {
            forms.iter().copied().flat_map(tables_of).collect()
        }
        _ => Vec::new(),
    }
}

/// All tables with a name, each once.
fn named() -> Vec<&'static KeyTable> {
    fn walk(table: &'static KeyTable, found: &mut Vec<&'static KeyTable>) {
        if !table.name.is_empty() {
            if found.iter().any(|known| known.name == table.name) {
                return;
            }
            found.push(table);
        }
        let inner = table.keys().flat_map(|key| tables_of(key.form));
        for table in inner.chain(table.variants.iter().copied()) {
            walk(table, found);
        }
    }
    let mut found = Vec::new();
    walk(&MACHINE, &mut found);
    walk(&RULE_SET, &mut found);
    walk(&PROJECT, &mut found);
    found
}

/// A table of a document.
struct Place {
    /// Its path in descriptions: "slider-crank.crank".
    name: String,
    /// Its path in the document.
    path: String,
    keys: Vec<&'static Key>,
    /// The word that was chosen.
    word: Option<String>,
    /// Keys of which one is given.
    either: Vec<&'static [&'static str]>,
}

/// The tables of a document.
fn places(machine: &Value) -> Vec<Place> {
    let mut found = Vec::new();
    walk(&MACHINE, machine, "", "", &mut found);
    found
}

fn walk(table: &'static KeyTable, value: &Value, name: &str, path: &str, found: &mut Vec<Place>) {
    let word = value.get(table.by).and_then(Value::as_str);
    let variant = table.variants.iter().copied().find(|variant| {
        word == Some(variant.name) || word.is_some() && table.key(table.by).is_none()
    });
    let name = match variant {
        _ if table.name.is_empty() => name,
        Some(variant) => variant.name,
        None => table.name,
    };
    let keys: Vec<_> = table
        .keys()
        .chain(variant.into_iter().flat_map(KeyTable::keys))
        .collect();
    let keys = keys.into_iter().filter(|key| {
        let mut elsewhere = variant.into_iter().flat_map(|variant| variant.elsewhere);
        elsewhere.all(|(name, _)| *name != key.name)
    });
    let keys: Vec<_> = keys.collect();
    let by = variant.map_or(table.by, |variant| variant.by);
    let default = table.key(by).and_then(|key| match key.need {
        Need::Default(word) => Some(word),
        _ => None,
    });
    let word = value.get(by).and_then(Value::as_str).or(default);
    for key in &keys {
        let Some(inner) = value.get(key.name) else {
            continue;
        };
        let name = format!("{name}.{}", key.name);
        inside(
            key.form,
            inner,
            &name,
            &format!("{path}/{}", key.name),
            found,
        );
    }
    found.push(Place {
        name: name.to_owned(),
        path: path.to_owned(),
        keys,
        word: word.map(str::to_owned),
        either: variant
            .into_iter()
            .chain([table])
            .flat_map(|table| table.either)
            .map(|(keys, _)| *keys)
            .collect(),
    });
}

/// The tables in a value.
fn inside(form: ValueForm, value: &Value, name: &str, path: &str, found: &mut Vec<Place>) {
    match (form, value) {
        (ValueForm::Table(table), Value::Object(_)) => walk(table, value, name, path, found),
        (ValueForm::Tables(table, ..), Value::Array(items)) => {
            for (k, item) in items.iter().enumerate() {
                inside(
                    ValueForm::Table(table),
                    item,
                    name,
                    &format!("{path}/{k}"),
                    found,
                );
            }
        }
        (ValueForm::List(form, _), Value::Array(items)) => {
            for (k, item) in items.iter().enumerate() {
                inside(*form, item, name, &format!("{path}/{k}"), found);
            }
        }
        (ValueForm::Named(form), Value::Object(entries)) => {
            for (entry, value) in entries {
                inside(*form, value, name, &format!("{path}/{entry}"), found);
            }
        }
        (ValueForm::Any(forms), _) => {
            for form in forms {
                inside(*form, value, name, path, found);
            }
        }
        _ => {}
    }
}

#[test]
fn links_are_left_out() {
    assert_eq!(plain("a [b](c.md#d) `[u, v]` e"), "a b `[u, v]` e");
}
