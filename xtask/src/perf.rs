//! `cargo xtask perf`: builds, traces, checks and reports.

use std::cmp::Ordering;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use clap::Args;

use crate::bounds::Bounds;
use crate::calls::{Call, Splitter};
use crate::ceilings::judge;
use crate::cores::{CORES, Core};
use crate::elf::Program;
use crate::kernels::{KERNELS, Kernel, Origin};
use crate::machine::Example;
use crate::number::Number;
use crate::peers;
use crate::program::{self, Work};
use crate::report::{Measurement, Report};
use crate::trace::Emulator;
use crate::user;

/// Largest error of the library's kernels, relative to the largest result.
const ERROR: f64 = 5e-4;
/// The same for the others: with a larger error a kernel does not compute the same thing.
const OTHERS: f64 = 1e-2;

/// Measures one control tick on emulated Cortex-M cores: instructions, estimated cycles, bytes, error.
///
/// The library's own kernels must keep within benches/ceilings.txt.
#[derive(Args)]
pub(crate) struct Options {
    /// Only these cores, by their names in benches/ceilings.txt.
    #[arg(long, value_name = "CORE")]
    core: Vec<String>,
    /// Only kernels whose names contain this.
    #[arg(long, value_name = "TEXT")]
    kernel: Option<String>,
    /// Compare with CMSIS-DSP and with C as well, and on cores without a floating-point unit: needs arm-none-eabi-gcc, curl,
    /// tar, and a network at first.
    #[arg(long)]
    peers: bool,
    /// Print the tables of docs/performance.md.
    #[arg(long)]
    markdown: bool,
    /// Only the functions of a user's firmware, benches/user.
    #[arg(long)]
    user: bool,
}

/// Runs the command; an error if a figure is out of bounds.
pub(crate) fn run(options: &Options) -> Result<()> {
    let whole = options.core.is_empty() && options.kernel.is_none();
    if options.user || whole {
        let failures = user::run(options.markdown)?;
        ensure!(
            failures == 0,
            "{failures} figures of a user's firmware out of bounds"
        );
    }
    if options.user {
        return Ok(());
    }
    let emulator = Emulator::installed()?;
    let cores: Vec<&Core> = CORES
        .iter()
        .filter(|core| options.core.is_empty() || options.core.iter().any(|name| name == core.name))
        .collect();
    ensure!(
        !cores.is_empty(),
        "no such core; there are {}",
        CORES.map(|core| core.name).join(", ")
    );
    let sources = match options.peers.then(peers::fetch).transpose() {
        Ok(sources) => sources,
        Err(error) => {
            eprintln!("without the peers: {error:#}");
            None
        }
    };
    let with_peers = sources.is_some();
    let chosen = |kernel: &&Kernel| {
        (with_peers || kernel.origin != Origin::Peer)
            && options
                .kernel
                .as_ref()
                .is_none_or(|text| kernel.name.contains(text))
    };
    let kernels: Vec<&Kernel> = KERNELS.iter().filter(chosen).collect();
    ensure!(!kernels.is_empty(), "no kernel has that in its name");
    let mut report = Report::default();
    for core in cores {
        // A comparison in software floating point takes longer than all others together.
        let here = |kernel: &&&Kernel| options.peers || core.float || kernel.origin == Origin::Jred;
        let kernels: Vec<&Kernel> = kernels.iter().filter(here).copied().collect();
        let objects = sources
            .as_ref()
            .map(|sources| peers::compile(core, sources))
            .transpose()?;
        let program = program::compile(core, objects.as_deref())?;
        let folder = program::files(core);
        let name = |kernel: &Kernel| kernel.name.to_owned();
        let found = measure(emulator, core, &program, &folder, &kernels, name)?;
        report.measurements.extend(found);
    }
    if options.markdown {
        println!("{}{}.", report.markdown(), tools(with_peers)?.join(", "));
    } else {
        print!("{}", report.text());
    }
    check(&report)
}

/// Versions of the compilers and of the emulator.
fn tools(with_peers: bool) -> Result<Vec<String>> {
    let gcc = with_peers.then_some("arm-none-eabi-gcc");
    let tools = ["rustc", "qemu-system-arm"].into_iter().chain(gcc);
    let version = |tool: &str| -> Result<String> {
        let output = Command::new(tool).arg("--version").output();
        let output = output.with_context(|| tool.to_owned())?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(text.lines().next().unwrap_or_default().to_owned())
    };
    tools.map(version).collect()
}

/// Runs the program twice, once for the trace and once for the clock, and combines both. The program reads and writes its files in `folder`; `symbol`
/// gives the name of a kernel in it.
pub(crate) fn measure(
    emulator: Emulator,
    core: &'static Core,
    path: &Path,
    folder: &Path,
    kernels: &[&'static Kernel],
    symbol: impl Fn(&Kernel) -> String,
) -> Result<Vec<Measurement>> {
    let example = Example::new();
    // No file of an earlier run may be mistaken for a result.
    let _ = std::fs::remove_dir_all(folder);
    std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    let work = kernels
        .iter()
        .map(|kernel| Work::new(kernel, &example))
        .collect::<Result<Vec<_>>>()?;
    for (kernel, work) in kernels.iter().zip(&work) {
        work.write(kernel, folder)?;
    }
    let program = Program::read(path)?;
    let names: Vec<_> = kernels.iter().map(|kernel| symbol(kernel)).collect();
    let mut splitter = Splitter::new(&program, core.timing, &names)?;
    emulator.trace(core, path, folder, program.range(), |address| {
        splitter.step(address)
    })?;
    let calls = splitter.finish()?;
    Emulator::count(core, path, folder)?;

    let mut bounds = Bounds::new(&program)?;
    let mut found = Vec::new();
    for ((kernel, work), calls) in kernels.iter().zip(&work).zip(&calls) {
        let made = calls.each.len();
        ensure!(
            made == work.calls(),
            "{}: {made} calls of {} in the trace",
            kernel.name,
            work.calls()
        );
        let (error, ticks) = work.read(kernel, folder)?;
        let most = if kernel.origin == Origin::Jred {
            ERROR
        } else {
            OTHERS
        };
        // A result that is NaN fails.
        ensure!(
            !matches!(error.partial_cmp(&most), None | Some(Ordering::Greater)),
            "{} on {}: error {error:.1e} of the largest result, above {most:.0e}",
            kernel.name,
            core.name
        );
        agree(core, calls.between_clocks, ticks)
            .with_context(|| format!("{} on {}", kernel.name, core.name))?;
        let most = |of: fn(&Call) -> u32| calls.each.iter().map(of).max().unwrap_or(0);
        let sum: u64 = calls
            .each
            .iter()
            .map(|call| u64::from(call.instructions))
            .sum();
        let worst = Call {
            instructions: most(|call| call.instructions),
            cycles: most(|call| call.cycles),
            stack: most(|call| call.stack),
        };
        let bound = (kernel.origin == Origin::Jred)
            .then(|| bounds.of(&symbol(kernel)))
            .transpose()?;
        ensure!(
            bound.is_none_or(|b| worst.instructions <= b.instructions && worst.stack <= b.stack),
            "{} on {}: a call took {worst:?}, which is above its bound, {bound:?}",
            kernel.name,
            core.name
        );
        found.push(Measurement {
            kernel,
            core,
            worst,
            bound,
            mean: sum as f64 / made as f64,
            code: calls.bytes(&program),
            table: work.table_bytes(),
            error,
        });
    }
    Ok(found)
}

/// Checks that the trace has the number of instructions that the clock counted, to one tick of the clock.
fn agree(core: &Core, traced: u64, ticks: u32) -> Result<()> {
    let per_tick = 1e9 / core.clock;
    let counted = f64::from(ticks) * per_tick;
    let traced = traced as f64;
    ensure!(
        (counted - traced).abs() <= per_tick,
        "{traced} instructions in the trace, but SysTick counted {counted}: the trace is not exact"
    );
    Ok(())
}

/// Compares the library's kernels with their ceilings.
fn check(report: &Report) -> Result<()> {
    let mut failures = 0;
    for m in report
        .measurements
        .iter()
        .filter(|m| m.kernel.origin == Origin::Jred)
    {
        let name = m.kernel.name;
        // With software floating point, calls differ, and the bound is far above them all.
        let software = !m.core.float && m.kernel.number == Number::PhaseF32;
        let most = m.bound.map_or(0, |bound| bound.instructions);
        let mut figures = vec![if software {
            (format!("{name}-most"), "instructions at most", most)
        } else {
            (name.to_owned(), "instructions at most", most)
        }];
        if software {
            figures.push((name.to_owned(), "instructions", m.worst.instructions));
        }
        // Code differs little between cores: one ceiling is enough.
        if m.core.name == "cortex-m4" {
            figures.push((format!("{name}-bytes"), "bytes of code", m.code));
        }
        for (name, unit, figure) in figures {
            let verdict = judge(m.core.name, &name, u64::from(figure));
            if !verdict.holds() {
                eprintln!("{} {name}: {figure} {unit}, {verdict}", m.core.name);
                failures += 1;
            }
        }
    }
    for core in &CORES {
        let of_core = report
            .measurements
            .iter()
            .filter(|m| m.core.name == core.name);
        let Some(stack) = of_core
            .filter_map(|m| m.bound)
            .map(|bound| bound.stack)
            .max()
        else {
            continue;
        };
        let verdict = judge(core.name, "jred-stack", u64::from(stack));
        if !verdict.holds() {
            eprintln!("{} jred-stack: {stack} bytes, {verdict}", core.name);
            failures += 1;
        }
    }
    if failures > 0 {
        bail!("{failures} figures out of bounds");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trace_and_clock_agree_to_a_tick() {
        let core = &CORES[2];
        // 250 ticks of 40 instructions; the clock is read within a tick.
        for (traced, agrees) in [(9959, false), (9960, true), (10040, true), (10041, false)] {
            assert_eq!(agree(core, traced, 250).is_ok(), agrees, "{traced}");
        }
    }
}
