//! `cargo xtask loaded`: the loaded parts of two programs.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use object::{Object, ObjectSegment};

/// Compares what two programs load into a device, byte by byte; tables for a debugger may differ, since they name folders.
#[derive(Args)]
pub(crate) struct Options {
    one: PathBuf,
    other: PathBuf,
}

/// Address and bytes of each segment.
type Segments = Vec<(u64, Vec<u8>)>;

pub(crate) fn run(options: &Options) -> Result<()> {
    let [one, other] = [&options.one, &options.other].map(|path| segments(path));
    let (one, other) = (one?, other?);
    if one != other {
        bail!(
            "{} and {} load different bytes",
            options.one.display(),
            options.other.display()
        );
    }
    let bytes: usize = one.iter().map(|(_, bytes)| bytes.len()).sum();
    ensure!(bytes > 0, "{} loads nothing", options.one.display());
    println!("{}: {bytes} bytes, the same", options.one.display());
    Ok(())
}

fn segments(path: &Path) -> Result<Segments> {
    let bytes = std::fs::read(path).with_context(|| path.display().to_string())?;
    let file = object::File::parse(&*bytes).with_context(|| path.display().to_string())?;
    let segments = file
        .segments()
        .map(|segment| Ok((segment.address(), segment.data()?.to_vec())));
    segments.collect()
}
