//! `cargo xtask c`: the library for C and C++.

mod cost;
mod gcc;
mod panics;
mod programs;

use anyhow::Result;
use clap::Args;

use crate::arduino;
use crate::cores::CORES;
use crate::run::{done, installed, program, skip};

/// Checks the library for C: its examples in C and in C++ print what those in Rust print, on the host and on emulated Cortex-M cores; a
/// tick through its interface gives the bits of one in Rust for at most 6 instructions more; no function can panic. The Arduino library's sketch
/// compiles, links and runs.
///
/// With an option only ticks are measured. The libraries for cores, with few sets of curves, stay in target/c/CORE. Needs
/// arm-none-eabi-gcc and its newlib.
#[derive(Args)]
pub(crate) struct Options {
    /// Only these cores, by their names in benches/ceilings.txt.
    #[arg(long, value_name = "CORE")]
    core: Vec<String>,
    /// Print the table of docs/c.md.
    #[arg(long)]
    markdown: bool,
}

/// Runs the command; an error if a call from C costs too much or gives other bits, or another check fails.
pub(crate) fn run(options: &Options) -> Result<()> {
    if options.markdown || !options.core.is_empty() {
        return cost::measure_all(&options.core, options.markdown);
    }
    programs::on_host()?;
    if !installed("arm-none-eabi-g++") || !installed("qemu-system-arm") {
        skip("arm-none-eabi-g++ or qemu-system-arm is not installed (scripts/test setup)");
        return Ok(());
    }
    // The libraries that this leaves have few sets of curves: all of them take most of a minute for each core.
    cost::measure_all(&[], false)?;
    for core in &CORES {
        programs::on(core)?;
        let folder = gcc::folder(core);
        panics::none(&folder.join(gcc::LIBRARY), core.name)?;
        done(program("arm-none-eabi-size").arg(folder.join("press")))?;
    }
    arduino::check()?;
    panics::everywhere()
}
