//! The entries of a text as the user wrote them, for a document that shows the inputs of a result.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::problem::Result;
use super::tree;

/// An entry: its path from the top of the file, its value, and the comment behind it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The keys joined by points; a table of a list has its number, from 1, as in `motion.segment.2.duration`.
    pub path: String,
    /// The value without quotes.
    pub value: String,
    /// The comment on the same line.
    pub remark: String,
}

/// The entries of a TOML text, in its order.
///
/// # Errors
/// It is not TOML.
pub fn entries(text: &str) -> Result<Vec<Entry>> {
    let root = tree::parse(text)?;
    let mut found = Vec::new();
    walk(text, "", root.get_ref(), &mut found);
    found.sort_by_key(|(at, _)| *at);
    Ok(found.into_iter().map(|(_, entry)| entry).collect())
}

fn walk(text: &str, path: &str, table: &DeTable, found: &mut Vec<(usize, Entry)>) {
    for (key, value) in table {
        let key = key.get_ref();
        let path = match path {
            "" => key.to_string(),
            _ => format!("{path}.{key}"),
        };
        one(text, path, value, found);
    }
}

fn one(text: &str, path: String, value: &Spanned<DeValue>, found: &mut Vec<(usize, Entry)>) {
    let is_inline = |value: &Spanned<DeValue>| text[value.span().start..].starts_with('{');
    match value.get_ref() {
        DeValue::Table(table) if !is_inline(value) => walk(text, &path, table, found),
        DeValue::Array(items) if is_list_of_tables(text, items) => {
            for (k, item) in items.iter().enumerate() {
                one(text, format!("{path}.{}", k + 1), item, found);
            }
        }
        other => {
            let span = value.span();
            let written = match other {
                DeValue::String(text) => text.to_string(),
                _ => squeezed(&text[span.clone()]),
            };
            let rest = text[span.end..].lines().next().unwrap_or_default();
            let remark = rest.trim_start().strip_prefix('#').unwrap_or_default();
            let remark = remark.trim().to_owned();
            let entry = Entry {
                path,
                value: written,
                remark,
            };
            found.push((span.start, entry));
        }
    }
}

/// Whether an array is written as tables of a list, `[[name]]`.
fn is_list_of_tables(text: &str, items: &[Spanned<DeValue>]) -> bool {
    let is_table = |item: &Spanned<DeValue>| {
        matches!(item.get_ref(), DeValue::Table(_)) && !text[item.span().start..].starts_with('{')
    };
    !items.is_empty() && items.iter().all(is_table)
}

/// A value without quotes, comments and breaks of lines.
fn squeezed(text: &str) -> String {
    let lines = text.lines().map(|line| match line.split_once(" #") {
        Some((value, _)) => value,
        None => line,
    });
    let words: Vec<&str> = lines.flat_map(str::split_whitespace).collect();
    words.join(" ").replace('"', "")
}
