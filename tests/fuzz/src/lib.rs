//! Hostile inputs for everything that jred reads: nothing may panic, print NaN or infinity, or take minutes.
//!
//! 1. [`mutate`]: texts and images, changed byte by byte; [`machine`]: machine files, changed value by value.
//! 2. [`harness`]: one function for each kind of input; it panics on a fault.
//! 3. [`command`]: machine files through every command of `jred`, each with a limit of time and memory.
//! 4. [`heavy`]: the largest inputs that each command accepts, below a memory limit.
//!
//! The same functions run in three ways: a fixed number of inputs each by `cargo test`, for any time by the program `jred-fuzz`, and guided by
//! coverage (libFuzzer) by `scripts/fuzz`. Inputs with former faults are kept in `corpus/`, and are tried first.
#![forbid(unsafe_code)]

pub mod command;
pub mod harness;
pub mod heavy;
pub mod machine;
pub mod mutate;
mod plan;

use std::path::{Path, PathBuf};

/// A path within the workspace.
pub fn at(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

/// The contents of every file of these folders with this extension, ordered by name.
///
/// # Panics
/// A folder cannot be read.
pub fn files(folders: &[&str], ending: &str) -> Vec<Vec<u8>> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for folder in folders {
        let entries =
            std::fs::read_dir(at(folder)).unwrap_or_else(|error| panic!("{folder}: {error}"));
        paths.extend(entries.map(|entry| entry.unwrap().path()));
    }
    paths.retain(|path| path.is_file() && path.to_string_lossy().ends_with(ending));
    paths.sort();
    paths
        .iter()
        .map(|path| std::fs::read(path).unwrap())
        .collect()
}

/// The CSV files named in the examples' machine files.
const NAMED: [&str; 5] = [
    "drive-log.csv",
    "force-over-stroke.csv",
    "four-bar-log.csv",
    "load-table.csv",
    "reduced-curves.csv",
];

/// The first word for NaN or infinity.
fn no_number(text: &str) -> Option<&str> {
    let mut words = text.split(|c: char| !c.is_alphanumeric());
    words.find(|word| ["inf", "NaN", "Infinity"].contains(word))
}
