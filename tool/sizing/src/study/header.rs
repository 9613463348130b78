//! Identity of a study's rows.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::shard::Shard;

/// Identity of the study that a file of rows belongs to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Kind of study and version of the form, such as "vary/4".
    pub jred: String,
    /// Version of the tool.
    pub version: String,
    /// The machine file as named by the user.
    pub machine: String,
    /// Digest of the machine file and of the files that it refers to.
    pub machine_digest: String,
    /// Digest of the catalogue.
    pub catalogue_digest: String,
    /// Everything else that affects the rows.
    pub options: Vec<String>,
    /// Number of rows of the whole study.
    pub rows: u64,
    /// Names of the columns after `row`.
    pub columns: Vec<String>,
    /// The share in this file; `null`: all rows.
    pub shard: Option<Shard>,
}

/// A digest of a value's `Debug` form, which contains every digit.
pub fn digest(value: &dyn std::fmt::Debug) -> String {
    struct Sink(Sha256);
    impl std::fmt::Write for Sink {
        fn write_str(&mut self, text: &str) -> std::fmt::Result {
            self.0.update(text.as_bytes());
            Ok(())
        }
    }
    let mut sink = Sink(Sha256::new());
    let _ = write!(sink, "{value:?}");
    let bytes = sink.0.finalize();
    bytes.iter().take(16).fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

impl Header {
    /// How another header differs; `None` if only the share differs.
    pub fn difference(&self, other: &Self) -> Option<String> {
        let parts = [
            (
                self.jred != other.jred,
                "the kind of study or the form of its rows",
            ),
            (self.version != other.version, "the version of jred"),
            (self.machine_digest != other.machine_digest, "the machine"),
            (
                self.catalogue_digest != other.catalogue_digest,
                "the catalogue",
            ),
            (self.options != other.options, "the options"),
            (self.rows != other.rows, "the number of rows"),
            (self.columns != other.columns, "the columns"),
            // Part of the header, so that a continued file equals the output of a single run.
            (
                self.machine != other.machine,
                "the name of the machine file",
            ),
        ];
        let different = parts.iter().filter(|(differs, _)| *differs);
        let words: Vec<&str> = different.map(|(_, words)| *words).collect();
        (!words.is_empty()).then(|| words.join(", "))
    }

    /// The share of the file.
    pub fn share(&self) -> Shard {
        self.shard.unwrap_or(Shard::WHOLE)
    }
}
