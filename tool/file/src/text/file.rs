//! Sources of the files that a text names, and the limit on their size.

use std::collections::BTreeMap;
use std::fmt::Debug;

use crate::number::rounding::figure;
use crate::units::Fault;

/// Source of the files that a machine file names: a folder (feature `fs`), or texts in memory, by their names.
pub trait Files: Debug {
    /// The name of a file in messages.
    fn shown(&self, file: &str) -> String;

    /// Its text, of at most `limit` bytes.
    ///
    /// # Errors
    /// The file does not exist or cannot be read.
    fn text(&self, file: &str, limit: u64) -> Result<String, Fault>;
}

impl<F: Files + ?Sized> Files for &F {
    fn shown(&self, file: &str) -> String {
        (**self).shown(file)
    }

    fn text(&self, file: &str, limit: u64) -> Result<String, Fault> {
        (**self).text(file, limit)
    }
}

impl Files for BTreeMap<String, String> {
    fn shown(&self, file: &str) -> String {
        file.to_owned()
    }

    fn text(&self, file: &str, limit: u64) -> Result<String, Fault> {
        let text = self.get(file).ok_or_else(|| {
            Fault::new(
                "no such file",
                format!("give the text of {file} beside that of the machine file"),
            )
        })?;
        let length = text.len() as u64;
        if length > limit {
            return Err(Fault::new(too_large(&size(length), limit), LARGE));
        }
        Ok(text.clone())
    }
}

/// The message about a file of `size` above the `limit`.
pub(crate) fn too_large(size: &str, limit: u64) -> String {
    format!("it has {size}; the maximum is {}", self::size(limit))
}

/// Cure for a file above the limit.
pub const LARGE: &str = "check that it is the file you mean; leave out rows that are not needed";

/// A size in words.
pub(crate) fn size(bytes: u64) -> String {
    if bytes < 1 << 21 && !bytes.is_multiple_of(1 << 20) {
        format!("{bytes} bytes")
    } else {
        format!(
            "{} MiB",
            figure((bytes as f64 / f64::from(1 << 20) * 100.0).round() / 100.0)
        )
    }
}
