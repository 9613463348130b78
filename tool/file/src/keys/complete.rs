//! Keys and values for a place of a machine file that is being written.

use std::ops::Range;

use toml::{Table, Value};

use super::place::Place;
use super::starter::{header, inner, sample};
use crate::text::key::ValueForm;
use crate::text::key::words::{plain, words_of};

/// A key or a value for the place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// The key, word or value.
    pub label: String,
    /// Its meaning.
    pub detail: String,
    /// The text to insert.
    pub insert: String,
}

/// The place in a text that is being written.
#[derive(Debug, Default)]
struct Cursor {
    /// Keys of the tables and lists around it, from the top of the file.
    path: Vec<String>,
    /// Brackets that are open: the depth of the path before each, its end, the number of elements before the place.
    open: Vec<(usize, char, usize)>,
    /// The key before an equals sign.
    key: Option<String>,
    /// Whether the line is a header.
    header: bool,
}

/// The candidates at a place, and the part of the text that they replace.
pub fn candidates(text: &str, at: usize) -> (Range<usize>, Vec<Candidate>) {
    let before = text.get(..at).unwrap_or(text);
    let part = |c: char| c.is_alphanumeric() || "_-\"".contains(c);
    let from = before.trim_end_matches(part).len();
    let rest = text.get(at..).unwrap_or_default();
    let to = at + rest.len() - rest.trim_start_matches(part).len();
    let line = before.rfind('\n').map_or(0, |end| end + 1);
    let cursor = Cursor::at(&before[..from]);
    // The line that is being written may be wrong; the others say which keys a table has.
    let end = rest.find('\n').map_or(text.len(), |end| at + end);
    let others = [&text[..line], &text[end..]].concat();
    // In a list over several lines what is before it, closed.
    let ends = Cursor::at(&text[..line]).open;
    let ends: String = ends.iter().rev().map(|(_, end, _)| *end).collect();
    let closed = [&text[..line], &ends].concat();
    let file = [text, &others, &closed]
        .into_iter()
        .find_map(|text| text.parse::<Table>().ok());
    let file = Value::Table(file.unwrap_or_default());
    let found = cursor.candidates(&file).unwrap_or_default();
    let begun = text[from..to].trim_matches('"');
    let fits = |candidate: &Candidate| candidate.label.contains(begun);
    (from..to, found.into_iter().filter(fits).collect())
}

impl Cursor {
    /// Follows headers, keys and brackets up to the end of a text.
    fn at(text: &str) -> Self {
        let mut cursor = Self::default();
        for line in text.split_inclusive('\n') {
            if cursor.open.is_empty() && line.trim_start().starts_with('[') {
                let name = line.trim().trim_matches(['[', ']']);
                cursor.header = !line.ends_with('\n');
                cursor.path = name.split('.').map(|step| step.trim().to_owned()).collect();
                if cursor.header {
                    cursor.path.pop();
                } else if line.trim_start().starts_with("[[") {
                    cursor.path.push("1".to_owned());
                }
                cursor.key = None;
                continue;
            }
            cursor.line(line);
        }
        cursor
    }

    fn line(&mut self, line: &str) {
        let (mut word, mut quoted) = (String::new(), false);
        for c in line.chars() {
            match c {
                '"' => quoted = !quoted,
                _ if quoted => {}
                '#' => break,
                '=' => self.key = Some(std::mem::take(&mut word)),
                '{' | '[' => {
                    // Without a key it is an element of a list.
                    let before = self.open.last().map_or(0, |(_, _, count)| *count);
                    let step = self.key.take().unwrap_or_else(|| (before + 1).to_string());
                    let end = if c == '{' { '}' } else { ']' };
                    self.open.push((self.path.len(), end, 0));
                    self.path.push(step);
                }
                '}' | ']' => {
                    let (depth, ..) = self.open.pop().unwrap_or_default();
                    self.path.truncate(depth);
                    self.key = None;
                }
                ',' => {
                    (self.key, word) = (None, String::new());
                    self.open
                        .last_mut()
                        .into_iter()
                        .for_each(|open| open.2 += 1);
                }
                c if !c.is_whitespace() => word.push(c),
                _ => {}
            }
        }
        if self.open.is_empty() && line.ends_with('\n') {
            self.key = None;
        }
    }

    fn candidates(&self, file: &Value) -> Option<Vec<Candidate>> {
        let place = Place::at(file, &self.path)?;
        let Some(key) = &self.key else {
            return Some(self.keys(&place));
        };
        let (table, key) = place.keys().into_iter().find(|(_, own)| own.name == key)?;
        let candidate = |label: &str, insert: String| Candidate {
            label: label.to_owned(),
            detail: plain(key.help),
            insert,
        };
        Some(match key.form {
            ValueForm::Words(_) => words_of(table, key)
                .into_iter()
                .map(|word| candidate(word, format!("\"{word}\"")))
                .collect(),
            ValueForm::Flag => ["true", "false"]
                .map(|word| candidate(word, word.to_owned()))
                .into(),
            _ => {
                let value = sample(key, false);
                vec![candidate(value.trim_matches('"'), value.clone())]
            }
        })
    }

    /// The keys that a table may still have; in a header those of tables.
    fn keys(&self, place: &Place) -> Vec<Candidate> {
        let given = place.value.and_then(Value::as_table);
        let is_given = |name: &str| given.is_some_and(|table| table.contains_key(name));
        let keys = place.keys().into_iter();
        let keys = keys.filter(|(_, key)| {
            self.header && inner(key).is_some() || !self.header && !is_given(key.name)
        });
        let of = |(table, key): (_, &crate::text::key::Key)| {
            let name = key.name;
            let is_top = place.key.is_none();
            let insert = match inner(key) {
                Some(_) if self.header => name.to_owned(),
                Some(_) if is_top => header(key, name),
                _ => format!("{name} = {}", sample(key, false)),
            };
            Candidate {
                label: name.to_owned(),
                detail: plain(&key.says(table)),
                insert,
            }
        };
        keys.map(of).collect()
    }
}
