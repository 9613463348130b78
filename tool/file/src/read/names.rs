//! Unique names of the entries in a list.

use std::ops::Range;

use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

/// The names given so far, and their places.
pub(super) struct Names {
    /// The kind of entry, in the plural.
    what: &'static str,
    given: Vec<(String, Range<usize>)>,
}

impl Names {
    /// No names yet. `what`: the kind of entry, in the plural.
    pub(super) const fn of(what: &'static str) -> Self {
        Self {
            what,
            given: Vec::new(),
        }
    }

    /// Adds the `name` of a table, if the file gives it. It must differ from those before.
    pub(super) fn add(&mut self, section: &Section) -> Result<()> {
        match section.peek("name") {
            Some(item) => self.add_text(item.text("name")?, item.span()),
            None => Ok(()),
        }
    }

    /// Adds the `name` of a table, if the file gives it; earlier entries may have the same.
    pub(super) fn take(&mut self, section: &Section) {
        if let Some(item) = section.peek("name")
            && let Ok(name) = item.text("name")
        {
            self.given.push((name.to_owned(), item.span()));
        }
    }

    /// Adds a name with its place.
    pub(super) fn add_text(&mut self, name: &str, place: Range<usize>) -> Result<()> {
        if let Some((_, first)) = self.given.iter().find(|(given, _)| given == name) {
            return Err(
                Problem::new(format!("two {} have the name \"{name}\"", self.what))
                    .at(first.clone(), "the first")
                    .at(place, "the second")
                    .help("give each a name of its own"),
            );
        }
        self.given.push((name.to_owned(), place));
        Ok(())
    }
}
