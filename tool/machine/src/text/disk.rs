//! Files of a disk: the one place of this package that opens any.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::file::{Files, size, too_large};
use crate::units::Fault;

/// A folder, in which files are looked for by their names.
impl Files for Path {
    fn shown(&self, file: &str) -> String {
        self.join(file).display().to_string()
    }

    fn text(&self, file: &str, limit: u64) -> Result<String, Fault> {
        read(&self.join(file), limit)
    }
}

impl Files for PathBuf {
    fn shown(&self, file: &str) -> String {
        self.as_path().shown(file)
    }

    fn text(&self, file: &str, limit: u64) -> Result<String, Fault> {
        self.as_path().text(file, limit)
    }
}

/// The text of the file at `path`, which may have up to `limit` bytes.
pub(crate) fn read(path: &Path, limit: u64) -> Result<String, Fault> {
    let failed = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => Fault::new(
            "no such file",
            format!(
                "check the name and the folder; looked for {}",
                absolute(path)
            ),
        ),
        ErrorKind::PermissionDenied => Fault::new(
            "permission denied",
            format!("make {} readable", absolute(path)),
        ),
        _ => Fault::new(error.to_string(), format!("check {}", absolute(path))),
    };
    let file = File::open(path).map_err(failed)?;
    let metadata = file.metadata().map_err(failed)?;
    if metadata.is_dir() {
        return Err(Fault::new(
            "it is a folder, not a file",
            "name the file in it",
        ));
    }
    if metadata.len() > limit {
        return Err(too_large(&size(metadata.len()), limit));
    }
    // The size of a device or a pipe is not known beforehand.
    let mut bytes = Vec::new();
    file.take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    if bytes.len() as u64 > limit {
        return Err(too_large(&format!("more than {}", size(limit)), limit));
    }
    utf8(bytes)
}

/// The text of a file.
///
/// # Errors
/// It is not UTF-8, with the line where that shows.
pub fn utf8(bytes: Vec<u8>) -> Result<String, Fault> {
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let before = error.as_bytes().iter().take(valid);
        let line = before.filter(|b| **b == b'\n').count() + 1;
        Fault::new(
            format!("it is not UTF-8 text: line {line} contains an invalid byte"),
            "save it as UTF-8 text; spreadsheets and images are not supported",
        )
    })
}

fn absolute(path: &Path) -> String {
    std::path::absolute(path)
        .as_deref()
        .unwrap_or(path)
        .display()
        .to_string()
}
