//! `cargo xtask template`: cost of the whole firmware of `examples/template`.

use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use clap::Args;
use object::{Object, ObjectSection, ObjectSegment, SectionKind};

use crate::bounds::Bounds;
use crate::ceilings::judge;
use crate::elf::Program;

/// Judges the flash and the RAM that a program of the template takes; of one for a real board with a Cortex-M4 also instructions and
/// stack that no tick exceeds, by its code.
#[derive(Args)]
pub(crate) struct Options {
    /// As `.cargo/config.toml` of the template names it.
    board: String,
    /// As `benches/ceilings.txt` names it.
    core: String,
    program: PathBuf,
    /// The program's output, with the cycles of its longest tick and its used stack.
    #[arg(long)]
    output: Option<PathBuf>,
}

/// Bytes in flash: code, constants, and the initial values of variables.
fn flash(file: &object::File<'_>) -> Result<u64> {
    let sizes = file
        .segments()
        .map(|segment| Ok(segment.data()?.len() as u64));
    sizes.sum()
}

/// Bytes of variables.
fn ram(file: &object::File<'_>) -> u64 {
    let sections = file.sections().filter(|section| {
        matches!(
            section.kind(),
            SectionKind::Data | SectionKind::UninitializedData
        )
    });
    sections.map(|section| section.size()).sum()
}

/// The number between two texts of an output.
fn between(output: &str, before: &str, after: &str) -> Result<u64> {
    let found = output.lines().find_map(|line| {
        let (number, _) = line.strip_prefix(before)?.split_once(after)?;
        number.parse().ok()
    });
    found.with_context(|| format!("no line \"{before}…{after}\" in the output"))
}

pub(crate) fn run(options: &Options) -> Result<()> {
    let path = &options.program;
    let bytes = std::fs::read(path).with_context(|| path.display().to_string())?;
    let file = object::File::parse(&*bytes)?;
    let mut figures = vec![("flash", flash(&file)?), ("ram", ram(&file))];
    // In QEMU a tick waits in a loop, and on an M0 the compiler merges ends of paths so that they cannot be followed.
    if options.output.is_none() && options.core != "cortex-m0" {
        let program = Program::read(path)?;
        let tick = Bounds::new(&program)?.containing("4Tick3run")?;
        figures.push(("tick", tick.instructions.into()));
        figures.push(("tick-stack", tick.stack.into()));
    }
    if let Some(output) = &options.output {
        let output = std::fs::read_to_string(output)?;
        let cycles = between(&output, "time: ", " of ")?;
        figures.push(("cycles", cycles));
        figures.push(("stack", between(&output, "stack: ", " bytes")?));
    }
    let mut held = true;
    for (what, figure) in figures {
        let name = format!("template-{}-{what}", options.board);
        let verdict = judge(&options.core, &name, figure);
        println!("{} {name}: {figure}, {verdict}", options.core);
        held &= verdict.holds();
    }
    ensure!(held, "a figure is not within its ceiling");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::between;

    #[test]
    fn figures_are_read_from_the_output() {
        let output = "9 ticks\ntime: 51 ticks\ntime: 320 of 2500 cycles\nstack: 104 bytes\n";
        assert_eq!(between(output, "time: ", " of ").unwrap(), 320);
        assert_eq!(between(output, "stack: ", " bytes").unwrap(), 104);
        assert!(between(output, "heap: ", " bytes").is_err());
    }
}
