//! `cargo xtask bits`: the same bits on every processor.

use anyhow::{Context, Result, ensure};
use clap::Args;

use crate::cores::{CORES, for_targets};
use crate::expected;
use crate::run::{done, has_std, installed, program, qemu, skip, target_dir, text, workspace};

/// Checks that a million random ticks of every format and number type give the same bits on the host, as WebAssembly, on AArch64 and on
/// Cortex-M cores; the first ten thousand of them where single precision is software.
///
/// It also shows that multiplications fused with additions would be found.
#[derive(Args)]
pub(crate) struct Options {
    /// Write the expected digests anew, from the host.
    #[arg(long)]
    bless: bool,
}

const PROGRAM: &str = "jred-bits-example";
const EXPECTED: &str = "bits";
/// A program for Node.js.
const WASI: &str = "wasm32-wasip1";
/// A program that needs no C compiler to be linked.
const AARCH64: &str = "aarch64-unknown-linux-musl";
const MILLION: u32 = 1_000_000;
/// Ticks on a core without a floating-point unit.
const FEW: u32 = 10_000;

pub(crate) fn run(options: &Options) -> Result<()> {
    host(options.bless)?;
    wasm()?;
    aarch64()?;
    cortex_m()
}

fn host(bless: bool) -> Result<()> {
    let profile = ["--quiet", "--workspace", "--profile", "bench"];
    done(workspace("build").args(profile).args(["--bin", PROGRAM]))?;
    let path = target_dir().join("release").join(PROGRAM);
    let output = text(&mut program(&path))?;
    if bless {
        expected::bless(EXPECTED, &output)?;
    }
    compare(std::env::consts::ARCH, &output, MILLION)
}

fn wasm() -> Result<()> {
    if !installed("node") || !has_std(WASI)? {
        skip(&format!(
            "no node (https://nodejs.org), or no rustup target {WASI}: ticks were not compared as WebAssembly"
        ));
        return Ok(());
    }
    let package = ["--quiet", "--release", "--package", PROGRAM];
    done(workspace("build").args(package).args(["--target", WASI]))?;
    let path = target_dir().join(WASI).join("release").join(PROGRAM);
    let mut node = program("node");
    node.args(["--no-warnings", "examples/bits/run.mjs"])
        .arg(path.with_extension("wasm"));
    compare("WebAssembly", &text(&mut node)?, MILLION)
}

fn aarch64() -> Result<()> {
    const QEMU: &str = "qemu-aarch64";
    if !installed(QEMU) || !has_std(AARCH64)? {
        skip(&format!(
            "no {QEMU} (apt-get install qemu-user), or no rustup target {AARCH64}: ticks were not compared on AArch64"
        ));
        return Ok(());
    }
    let path = target_dir().join(AARCH64).join("release").join(PROGRAM);
    // Libraries stay as they are; ticks are compiled into the program.
    let output = |options: &[&str]| {
        let mut cargo = workspace("rustc");
        cargo
            .env("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_MUSL_LINKER", "rust-lld")
            .args(["--quiet", "--release", "--package", PROGRAM])
            .args(["--target", AARCH64, "--"])
            .args(options);
        done(&mut cargo)?;
        text(program(QEMU).arg(&path))
    };
    let fused = output(&["-Cllvm-args=-fp-contract=fast"])?;
    let [changed, all] = changed(&expected::read(EXPECTED)?, &fused);
    ensure!(
        all > 0 && changed == all,
        "AArch64: fused multiplications change {changed} of {all} digests of f32 tables only, so this step shows nothing"
    );
    println!("AArch64: fused multiplications change all {all} digests of f32 tables");
    compare("AArch64", &output(&[])?, MILLION)
}

fn cortex_m() -> Result<()> {
    let mut cargo = workspace("build");
    cargo.args(["--quiet", "--package", PROGRAM, "--profile", "firmware"]);
    done(cargo.args(for_targets()))?;
    for core in &CORES {
        let path = core.firmware().join(PROGRAM);
        // Enough, whatever else the machine does.
        let output = text(qemu(core, &path).env("QEMU_TIMEOUT", "1800"))?;
        compare(core.name, &output, if core.float { MILLION } else { FEW })?;
    }
    Ok(())
}

/// Compares an output with the expected digests up to a number of ticks of each model.
fn compare(on: &str, output: &str, ticks: u32) -> Result<()> {
    let all = expected::read(EXPECTED)?;
    let expected = until(&all, ticks)
        .with_context(|| format!("no digests after {ticks} ticks are expected"))?;
    ensure!(
        expected::same(expected, output)?,
        "{on}: not the same bits (scripts/test --bless bits if they should be others)"
    );
    println!("{on}: the same bits after {ticks} ticks of each model");
    Ok(())
}

/// The digests up to a number of ticks of each model.
fn until(digests: &str, ticks: u32) -> Option<&str> {
    let last = format!("\n{ticks} ticks of each\n");
    let at = digests.find(&last)?;
    Some(&digests[..at + last.len()])
}

/// How many digests of f32 tables differ, and how many there are. A plan is integers but for its last three operations, which need not be
/// fused.
fn changed(expected: &str, found: &str) -> [usize; 2] {
    let of_a_table = |line: &str| line.starts_with("f32 ") && !line.starts_with("f32 p");
    let mut found = found.lines();
    let pairs = expected.lines().map(|line| (line, found.next()));
    let tables: Vec<_> = pairs.filter(|(line, _)| of_a_table(line)).collect();
    let differ = |(line, found): &&(&str, Option<&str>)| *found != Some(*line);
    [tables.iter().filter(differ).count(), tables.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    const DIGESTS: &str = "model  digest\nf32 cubic  a4\nf32 plan  1b\nq31 cubic  77\n10 ticks of each\n\
        f32 cubic  c0\nf32 plan  2e\nq31 cubic  05\n100 ticks of each\n";

    #[test]
    fn a_run_of_few_ticks_is_compared_with_the_first_digests() {
        assert_eq!(until(DIGESTS, 100), Some(DIGESTS));
        let few = until(DIGESTS, 10).unwrap();
        assert!(few.ends_with("77\n10 ticks of each\n"), "{few}");
        assert_eq!(until(DIGESTS, 1), None);
        assert_eq!(until(DIGESTS, 0), None);
    }

    #[test]
    fn only_changed_digests_of_f32_tables_count() {
        assert_eq!(changed(DIGESTS, DIGESTS), [0, 2]);
        let others = DIGESTS
            .replace("plan  1b", "plan  1c")
            .replace("q31 cubic  77", "q31 cubic  78");
        assert_eq!(changed(DIGESTS, &others), [0, 2]);
        assert_eq!(changed(DIGESTS, &DIGESTS.replace("a4", "a5")), [1, 2]);
        let both = DIGESTS.replace("a4", "a5").replace("c0", "c1");
        assert_eq!(changed(DIGESTS, &both), [2, 2]);
        assert_eq!(changed("q31 cubic  77\n", ""), [0, 0]);
    }
}
