//! `examples/expected`: the output that programs must have, on every processor.

use std::path::PathBuf;

use anyhow::{Context, Result, ensure};

use crate::run::{program, root, target_dir};

fn path(name: &str) -> PathBuf {
    root()
        .join("examples/expected")
        .join(name)
        .with_extension("txt")
}

/// The expected output of an example.
pub(crate) fn read(name: &str) -> Result<String> {
    let path = path(name);
    std::fs::read_to_string(&path).with_context(|| path.display().to_string())
}

/// Writes it anew.
pub(crate) fn bless(name: &str, output: &str) -> Result<()> {
    let path = path(name);
    std::fs::write(&path, output).with_context(|| path.display().to_string())
}

/// Checks the output of an example.
pub(crate) fn compare(name: &str, output: &str, on: &str) -> Result<()> {
    ensure!(
        same(&read(name)?, output)?,
        "{name} on {on}: not the expected output (scripts/test --bless if it should be)"
    );
    println!("{name} on {on}: as expected");
    Ok(())
}

/// Whether two texts are the same; prints their differences.
pub(crate) fn same(expected: &str, found: &str) -> Result<bool> {
    if expected != found {
        let folder = target_dir().join("differs");
        std::fs::create_dir_all(&folder)?;
        std::fs::write(folder.join("expected"), expected)?;
        std::fs::write(folder.join("found"), found)?;
        let mut diff = program("diff");
        diff.current_dir(folder).args(["-u", "expected", "found"]);
        diff.status().context("diff does not run")?;
    }
    Ok(expected == found)
}
