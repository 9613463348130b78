//! `jred export`: the table holds the machine's torque to the error that it states, in every type, layout and form.
// Copied figures, counts and zeros are exact.
#![allow(clippy::float_cmp)]

#[path = "export/bytes.rs"]
mod bytes;
#[path = "export/document.rs"]
mod document;
#[path = "export/forms.rs"]
mod forms;
#[path = "export/images.rs"]
mod images;
#[path = "export/refusals.rs"]
mod refusals;
mod support;

use std::path::{Path, PathBuf};

use support::{Folder, Run, jred, press_file};

/// Every type with its layouts, and the curves of the press in Rust's words for it.
const KINDS: [(&str, &str); 8] = [
    ("f32", "spline"),
    ("f32", "cubic"),
    ("f32", "quadratic"),
    ("i32", "spline"),
    ("i32", "spline16"),
    ("i32", "cubic"),
    ("i32", "quadratic"),
    ("i16", "rows"),
];

/// Runs the export of a machine file.
fn export_of(file: &Path, more: &[&str], out: Option<&Path>) -> Run {
    let mut arguments: Vec<&dyn AsRef<std::ffi::OsStr>> = vec![&"export", &file];
    for word in more {
        arguments.push(word);
    }
    if let Some(out) = &out {
        arguments.push(&"--out");
        arguments.push(out);
    }
    jred(arguments)
}

/// Exports the press as an image.
fn export(folder: &Folder, more: &[&str]) -> (Run, PathBuf) {
    let out = folder.path("table.jred");
    (export_of(&press_file(), more, Some(&out)), out)
}

/// The words of an image that must have been made.
fn image(folder: &Folder, more: &[&str]) -> Vec<u32> {
    let (run, path) = export(folder, more);
    run.ends(0);
    words_of(&path)
}

fn words_of(path: &Path) -> Vec<u32> {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(bytes.len() % 4, 0);
    let word = |chunk: &[u8]| u32::from_le_bytes(chunk.try_into().unwrap());
    bytes.chunks_exact(4).map(word).collect()
}

/// The number after a mark, as far as it reads as one.
fn number_after(text: &str, mark: &str) -> f64 {
    let (_, rest) = text
        .split_once(mark)
        .unwrap_or_else(|| panic!("no {mark:?} in {text}"));
    let end = rest
        .find(|c: char| !"0123456789.e-".contains(c))
        .unwrap_or(rest.len());
    rest[..end].trim_end_matches('.').parse().unwrap()
}
