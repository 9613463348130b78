//! A request of the page, and the machine that it is about.

use std::cell::RefCell;
use std::collections::BTreeMap;

use jred_analysis::checked;
use jred_analysis::warnings::of_motion;
use jred_file::model::machine::MachineFile;
use jred_file::text::problem::Result;
use serde_json::Value;

/// A request: an object with `do`, the machine file and options.
pub(crate) struct Request {
    fields: Value,
    warnings: RefCell<Vec<String>>,
}

impl Request {
    pub(crate) const fn new(fields: Value) -> Self {
        Self {
            fields,
            warnings: RefCell::new(Vec::new()),
        }
    }

    pub(crate) fn field(&self, key: &str) -> &Value {
        &self.fields[key]
    }

    pub(crate) fn text(&self, key: &str) -> Option<&str> {
        self.fields[key].as_str()
    }

    pub(crate) fn count(&self, key: &str, default: usize) -> usize {
        self.fields[key].as_u64().map_or(default, |n| n as usize)
    }

    /// Name of the machine file in messages.
    pub(crate) fn name(&self) -> String {
        self.text("name").unwrap_or("machine.toml").to_owned()
    }

    /// Text of the machine file.
    pub(crate) fn source(&self) -> &str {
        self.text("text").unwrap_or_default()
    }

    /// The files that the machine file names.
    pub(crate) fn files(&self) -> BTreeMap<String, String> {
        let files = self.fields["files"].as_object().into_iter().flatten();
        let files = files.filter_map(|(name, text)| Some((name.clone(), text.as_str()?.into())));
        files.collect()
    }

    /// The machine of a command that looks at one turn.
    pub(crate) fn machine(&self) -> Result<MachineFile> {
        checked::parse_one_turn(&self.name(), self.source(), self.files())
    }

    /// The same, with the warnings of its motion.
    pub(crate) fn machine_warned(&self) -> Result<MachineFile> {
        let file = self.machine()?;
        of_motion(&file).for_each(|warning| self.warn(warning));
        Ok(file)
    }

    pub(crate) fn warn(&self, warning: impl Into<String>) {
        self.warnings.borrow_mut().push(warning.into());
    }

    pub(crate) fn warnings(&self) -> Vec<String> {
        self.warnings.borrow().clone()
    }
}
