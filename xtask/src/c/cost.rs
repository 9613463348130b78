//! Cost of a tick through the C interface, compared with the same tick in Rust.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};

use super::gcc::{self, LIBRARY, Language, cross};
use crate::cores::{CORES, Core};
use crate::data::Data;
use crate::kernels::{COUNTED, KERNELS, Kernel, Origin, Quantity};
use crate::number::Number;
use crate::perf::measure;
use crate::program;
use crate::report::Measurement;
use crate::run::{done, workspace};
use crate::trace::Emulator;

/// Additional instructions allowed for a call from C.
const MORE: u32 = 6;
/// Part of them for the caller's check for a model: a load, a comparison, a branch.
const LOOK: u32 = 3;
/// Cases with fewer free registers than in a program with one model, where more instructions are allowed.
const EXCEPTIONS: [(&str, u32); 2] = [("jred_q31_spline16_torque", 20), ("jred_q31_torque", 12)];
/// Additional instructions allowed for a path from a count on a core that multiplies only to 32 bits. For the product of four halves LLVM needs 23
/// instructions, gcc 12 needs 60: half of the sixteen registers cannot take part, and it moves as much as it computes.
const MORE_BY_HALVES: u32 = 46;

/// Measures ticks on emulated cores, all or those named; an error if a call from C costs too much or gives other bits.
pub(crate) fn measure_all(cores: &[String], as_markdown: bool) -> Result<()> {
    let emulator = Emulator::installed()?;
    let kernels: Vec<&Kernel> = KERNELS
        .iter()
        .filter(|k| k.origin == Origin::Jred)
        .chain(COUNTED)
        .collect();
    let chosen = |core: &&Core| cores.is_empty() || cores.iter().any(|name| name == core.name);
    let mut all = Vec::new();
    for core in CORES.iter().filter(chosen) {
        // With software floating point a trace takes longer than all others together, and shows nothing more.
        let here = |kernel: &&&Kernel| core.float || kernel.number != Number::PhaseF32;
        let kernels: Vec<&Kernel> = kernels.iter().filter(here).copied().collect();
        let rust = program::compile(core, None)?;
        let folder = program::files(core);
        let of_rust = measure(emulator, core, &rust, &folder, &kernels, |k| {
            k.name.to_owned()
        })?;
        let c = compile(core)?;
        let beside = gcc::folder(core).join("tick");
        let of_c = measure(emulator, core, &c, &beside, &kernels, symbol)?;
        for (kernel, pair) in kernels.iter().zip(of_rust.into_iter().zip(of_c)) {
            same_bits(core, kernel, &folder, &beside)?;
            all.push(pair);
        }
    }
    ensure!(
        !all.is_empty(),
        "no such core; there are {}",
        CORES.map(|core| core.name).join(", ")
    );
    print!(
        "{}",
        if as_markdown {
            markdown(&kernels, &all)
        } else {
            text(&all)
        }
    );
    let above = |(rust, c): &&Pair| more(rust, c) > allowed(rust);
    match all.iter().filter(above).count() {
        0 => Ok(()),
        count => bail!("{count} calls from C take more than they may"),
    }
}

/// Additional instructions of a call from C, including the caller's check for a model: the function with a count is such a caller.
fn more(rust: &Measurement, c: &Measurement) -> i64 {
    let look = if rust.kernel.counts { 0 } else { LOOK };
    i64::from(c.worst.instructions + look) - i64::from(rust.worst.instructions)
}

fn allowed(rust: &Measurement) -> i64 {
    let counts = rust.kernel.name.ends_with("_counts");
    if counts && rust.core.target == "thumbv6m-none-eabi" {
        return MORE_BY_HALVES.into();
    }
    let mut exceptions = EXCEPTIONS.iter();
    let found = exceptions.find(|(name, _)| *name == rust.kernel.name);
    i64::from(found.map_or(MORE, |(_, most)| *most))
}

/// In Rust, and in C.
type Pair = (Measurement, Measurement);

/// The library's function for a kernel, or the program's function that calls it with a count.
fn symbol(kernel: &Kernel) -> String {
    if kernel.counts {
        return kernel.name.replacen("jred", "c", 1);
    }
    let number = match kernel.number {
        Number::PhaseQ31 => "q31",
        Number::PhaseQ15 => "q15",
        Number::PhaseF32 | Number::Radians => "f32",
    };
    let quantity = match kernel.quantity {
        Quantity::Torque => "torque",
        Quantity::Acceleration => "acceleration",
    };
    match kernel.data {
        Data::Jred { layout, set, .. } => {
            let layout = format!("{layout:?}")
                .to_lowercase()
                .replace("rows16", "rows")
                .replace("slidercrank", "slider_crank");
            format!("jred_{layout}_{number}_s{set}_{quantity}")
        }
        _ => String::new(),
    }
}

/// The library for `core`, and `ffi/tests/tick.c` linked with it.
fn compile(core: &Core) -> Result<PathBuf> {
    let folder = gcc::folder(core);
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    let flags = format!("target.{}.rustflags = {:?}", core.target, core.rustc);
    let mut cargo = workspace("rustc");
    cargo
        .args(["--quiet", "--package", "jred-ffi", "--profile", "firmware"])
        .args(["--target", core.target, "--config", &flags])
        .args(["--", "--cfg=few_sets"]);
    done(&mut cargo)?;
    let library = folder.join(LIBRARY);
    let made = core.firmware().join(LIBRARY);
    std::fs::copy(&made, &library).with_context(|| made.display().to_string())?;
    let program = folder.join("tick.elf");
    let mut gcc = cross(core, Language::C);
    gcc.args([
        "-std=gnu11",
        "-O2",
        "ffi/tests/tick.c",
        "ffi/examples/startup.c",
    ])
    .arg(library)
    .arg("-o");
    done(gcc.arg(&program))?;
    Ok(program)
}

/// Checks that both programs gave the same results.
fn same_bits(core: &Core, kernel: &Kernel, rust: &Path, c: &Path) -> Result<()> {
    let results = |folder: &Path| {
        let path = folder.join(format!("{}.out", kernel.name));
        std::fs::read(&path).with_context(|| path.display().to_string())
    };
    ensure!(
        same_results(&results(rust)?, &results(c)?),
        "{} on {}: not the same bits in C",
        kernel.name,
        core.name
    );
    Ok(())
}

/// Whether two files have the same results, and some; the last word of a file is the clock's.
fn same_results(rust: &[u8], c: &[u8]) -> bool {
    let results = |bytes| <[u8]>::split_last_chunk::<4>(bytes).map(|(results, _)| results);
    results(rust).is_some_and(|rust| !rust.is_empty() && results(c) == Some(rust))
}

fn text(all: &[Pair]) -> String {
    let mut text = format!(
        "{:10}  {:32} {:>6} {:>6} {:>5}\n",
        "core", "kernel", "Rust", "C", "more"
    );
    for (rust, c) in all {
        let (of_rust, of_c) = (rust.worst.instructions, c.worst.instructions);
        let more = more(rust, c);
        let _ = writeln!(
            text,
            "{:10}  {:32} {of_rust:6} {of_c:6} {more:5}",
            rust.core.name, rust.kernel.name
        );
    }
    text
}

/// A line for each kernel, a column for each core: Rust, and C's additional instructions.
fn markdown(kernels: &[&Kernel], all: &[Pair]) -> String {
    let cores: Vec<_> = CORES
        .iter()
        .filter(|core| all.iter().any(|(m, _)| m.core.name == core.name))
        .collect();
    let mut text = String::from("| tick |");
    for core in &cores {
        let _ = write!(text, " {} |", core.title);
    }
    let _ = write!(text, "\n|---|{}\n", "---:|".repeat(cores.len()));
    for kernel in kernels {
        let quantity = if kernel.quantity == Quantity::Torque {
            "torque"
        } else {
            "acceleration"
        };
        let _ = write!(text, "| {}, {quantity} |", kernel.title);
        for core in &cores {
            let found = all
                .iter()
                .find(|(m, _)| m.core.name == core.name && m.kernel.name == kernel.name);
            text += &found.map_or(String::from(" |"), |(rust, c)| {
                format!(" {} + {} |", rust.worst.instructions, more(rust, c))
            });
        }
        text += "\n";
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calls::Call;

    fn measured(core: &'static Core, kernel: &'static Kernel, instructions: u32) -> Measurement {
        Measurement {
            kernel,
            core,
            worst: Call {
                instructions,
                cycles: 0,
                stack: 0,
            },
            bound: None,
            mean: 0.0,
            code: 0,
            table: 0,
            error: 0.0,
        }
    }

    fn kernel(name: &str) -> &'static Kernel {
        let mut all = KERNELS.iter().chain(COUNTED);
        all.find(|kernel| kernel.name == name).unwrap()
    }

    #[test]
    fn a_call_from_c_may_take_some_instructions_more() {
        let [m0, m4] = [&CORES[0], &CORES[2]];
        // Core, kernel, instructions in Rust, the most in C: with the caller's check 6, 12 and 20 more.
        for (core, name, in_rust, most) in [
            (m4, "jred_q15_torque", 40, 43),
            (m4, "jred_q31_torque", 42, 51),
            (m0, "jred_q31_spline16_torque", 352, 369),
            (m4, "jred_q15_counts", 46, 52),
            (m0, "jred_q15_counts", 82, 128),
        ] {
            let rust = measured(core, kernel(name), in_rust);
            let above = |c| more(&rust, &measured(core, kernel(name), c)) > allowed(&rust);
            assert!(!above(most) && above(most + 1), "{name} on {}", core.name);
            assert!(!above(in_rust - 10), "{name} on {}", core.name);
        }
    }

    #[test]
    fn functions_are_named_by_layout_number_and_curves() {
        let set = crate::image::FULL;
        for (name, function) in [
            ("jred_f32_slider_crank_torque", "slider_crank_f32"),
            ("jred_q15_torque", "rows_q15"),
            ("jred_q31_spline16_torque", "spline16_q31"),
        ] {
            assert_eq!(
                symbol(kernel(name)),
                format!("jred_{function}_s{set}_torque")
            );
        }
        assert_eq!(symbol(kernel("jred_q15_counts")), "c_q15_counts");
    }

    #[test]
    fn only_the_clock_may_differ() {
        let results = b"resultsTIME".as_slice();
        assert!(same_results(results, b"resultstime"));
        assert!(!same_results(results, b"resultzTIME"));
        assert!(!same_results(results, b"resultTIME"));
        assert!(!same_results(b"TIME", b"time") && !same_results(b"", b""));
    }
}
