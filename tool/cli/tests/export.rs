//! `jred export`: the table keeps the machine's torque within the stated error in every type, layout and form.
// Copied figures, counts and zeros are exact.
#![allow(clippy::float_cmp)]

mod by_direction;
mod bytes;
mod choice;
mod closed_form;
mod document;
// Written by the command.
#[rustfmt::skip]
#[allow(clippy::unreadable_literal, clippy::wildcard_imports, unreachable_pub)]
mod feeder_form;
mod forms;
mod harmonics;
mod images;
mod pieces;
mod proof;
// Written by the command.
#[rustfmt::skip]
#[allow(clippy::unreadable_literal, clippy::wildcard_imports, unreachable_pub)]
mod press_pieces;
// Written by the command.
#[rustfmt::skip]
#[allow(clippy::unreadable_literal, clippy::wildcard_imports, unreachable_pub)]
mod press_table;
mod reader;
mod refusals;

use std::path::{Path, PathBuf};

use jred_export::{Export, LayoutChoice, Number, SearchResult, Task};

use crate::support::{Folder, Run, press_file};

/// Every type with its layouts.
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
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_jred"));
    command
        .arg("export")
        .arg(file)
        .args(more)
        .env("NO_COLOR", "1")
        .env("JRED_PROGRESS", "never");
    if let Some(out) = out {
        command.arg("--out").arg(out);
    }
    let output = command.output().unwrap();
    let run = Run {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    };
    assert!(!run.message().contains("panicked"), "{}", run.err);
    run
}

/// Exports the press as an image.
fn export(folder: &Folder, more: &[&str]) -> (Run, PathBuf) {
    let out = folder.path("table.jred");
    (export_of(&press_file(), more, Some(&out)), out)
}

/// The words of an image; the export must succeed.
fn image(folder: &Folder, more: &[&str]) -> Vec<u32> {
    let (run, path) = export(folder, more);
    run.ends(0);
    words_of(&path)
}

/// The images of every type and layout, in the order of [`KINDS`], from one search within `bytes` and this range of speed and acceleration; the
/// command writes the image of its `--type` and `--layout`.
fn images_of(file: &Path, bytes: u32, [omega, alpha]: [f64; 2]) -> Vec<Vec<u32>> {
    let task = Task {
        number: Number::F32,
        layout: LayoutChoice::Auto,
        core: jred_export::Core::default(),
        forward: false,
        reciprocal: false,
        torque_error: None,
        max_bytes: Some(bytes),
        max_cells: 4096,
        omega,
        alpha,
        rotor: 0.0,
        edges: Vec::new(),
        machine: None,
    };
    let export = Export::new(&jred_analysis::checked::read(file).unwrap(), task).unwrap();
    let images: Vec<_> = export
        .answers
        .into_iter()
        .zip(KINDS)
        .map(|((number, layout, answer), kind)| {
            assert_eq!((number.name(), layout.name()), kind);
            match answer {
                SearchResult::Meets(mut candidate) => candidate.tables.remove(0).words,
                other => panic!("{kind:?}: {other:?}"),
            }
        })
        .collect();
    assert_eq!(images.len(), KINDS.len());
    images
}

fn words_of(path: &Path) -> Vec<u32> {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(bytes.len() % 4, 0);
    let word = |chunk: &[u8]| u32::from_le_bytes(chunk.try_into().unwrap());
    bytes.chunks_exact(4).map(word).collect()
}

/// The number after a mark.
fn number_after(text: &str, mark: &str) -> f64 {
    let (_, rest) = text
        .split_once(mark)
        .unwrap_or_else(|| panic!("no {mark:?} in {text}"));
    let end = rest
        .find(|c: char| !"0123456789.e-".contains(c))
        .unwrap_or(rest.len());
    rest[..end].trim_end_matches('.').parse().unwrap()
}
