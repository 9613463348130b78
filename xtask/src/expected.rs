//! `examples/expected`: the output that programs must have, on every processor.

use std::path::PathBuf;

use anyhow::{Context, Result, bail};

use crate::run::{done, program, root, target_dir};

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
    same(&read(name)?, output).with_context(|| {
        format!("{name} on {on}: not the expected output (scripts/test --bless if it should be)")
    })?;
    println!("{name} on {on}: as expected");
    Ok(())
}

/// Prints the differences of two texts; an error if there are some.
pub(crate) fn same(expected: &str, found: &str) -> Result<()> {
    if expected == found {
        return Ok(());
    }
    let folder = target_dir().join("differs");
    std::fs::create_dir_all(&folder)?;
    for (name, text) in [("expected", expected), ("found", found)] {
        std::fs::write(folder.join(name), text)?;
    }
    done(
        program("diff")
            .current_dir(folder)
            .args(["-u", "expected", "found"]),
    )?;
    bail!("diff finds no difference, but there is one")
}
