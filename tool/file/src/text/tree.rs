//! A text as a tree of TOML tables, and the message about faulty syntax.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::problem::{Problem, Result};
use crate::plain;

/// Parses a text.
///
/// # Errors
/// It is not TOML, or a key or a value contains a hidden character.
pub fn parse(text: &str) -> Result<Spanned<DeTable<'_>>> {
    let tree = DeTable::parse(text).map_err(|error| syntax(&error, text))?;
    seen(tree.get_ref())?;
    Ok(tree)
}

/// A number without quotes and unit.
pub fn plain_number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
            .ok()
            .map(|n| n as f64),
        _ => None,
    }
}

/// Checks that a table contains no hidden characters.
fn seen(table: &DeTable) -> Result<()> {
    for (key, value) in table {
        if let Some(c) = plain::hidden(key.get_ref()) {
            let key = plain::cut(key.get_ref());
            return Err(hidden(&format!("the key `{key}`"), c, value.span()));
        }
        seen_value(key.get_ref(), value)?;
    }
    Ok(())
}

fn seen_value(key: &str, value: &Spanned<DeValue>) -> Result<()> {
    match value.get_ref() {
        DeValue::String(text) => match plain::hidden(text) {
            Some(c) => Err(hidden(&format!("the text of `{key}`"), c, value.span())),
            None => Ok(()),
        },
        DeValue::Array(items) => items.iter().try_for_each(|item| seen_value(key, item)),
        DeValue::Table(table) => seen(table),
        _ => Ok(()),
    }
}

fn hidden(what: &str, c: char, at: Range<usize>) -> Problem {
    Problem::new(format!("{what} contains {}", plain::described(c)))
        .at(at, "here")
        .help(plain::CURE)
}

/// Text that is not TOML.
fn syntax(error: &toml::de::Error, text: &str) -> Problem {
    let span = error.span().unwrap_or(0..0);
    let start = text
        .get(..span.start)
        .map_or(0, |before| before.rfind('\n').map_or(0, |at| at + 1));
    let line = text
        .get(start..)
        .and_then(|rest| rest.lines().next())
        .unwrap_or_default();
    let (key, value) = line.split_once('=').unwrap_or((line, ""));
    let in_value = span.start > start + key.len();
    let bare = in_value && !value.contains(['"', '[', '{', '\'']);
    let value = value.split('#').next().unwrap_or_default().trim();
    let after = text.get(span.end..).unwrap_or_default().trim_start();
    let at_key = after.starts_with(['=', '.', ']']);
    let hidden = text.get(span.clone()).and_then(plain::hidden);
    // Hidden white space (a line end) is not the fault.
    let hidden = hidden.filter(|c| !c.is_whitespace());
    let help = if let Some(c) = hidden {
        format!("{} stands here; {}", plain::described(c), plain::CURE)
    } else if at_key
        && text
            .get(span.clone())
            .is_some_and(|key| is_twice(key, text))
    {
        "remove or rename one of the two".to_owned()
    } else if bare && !value.is_empty() {
        let key = key.trim();
        format!(
            "write texts and quantities in quotes: {} = \"{}\"",
            plain::cut(key),
            plain::cut(value)
        )
    } else {
        "a line is key = \"value\", a [table] or a [[table of a list]]; write texts in quotes"
            .to_owned()
    };
    Problem::new(format!(
        "the file is not valid TOML: {}",
        plain::escaped(error.message())
    ))
    .at(span, "here")
    .help(help)
}

/// Whether the readable part of an invalid TOML text has this key: then the fault is that the key is repeated.
fn is_twice(key: &str, text: &str) -> bool {
    fn has(value: &DeValue, key: &str) -> bool {
        match value {
            DeValue::Table(table) => {
                let mut entries = table.iter();
                entries.any(|(name, value)| name.get_ref() == key || has(value.get_ref(), key))
            }
            DeValue::Array(array) => array.iter().any(|value| has(value.get_ref(), key)),
            _ => false,
        }
    }
    let (table, _) = DeTable::parse_recoverable(text);
    has(&DeValue::Table(table.into_inner()), key)
}
