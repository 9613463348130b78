//! `cargo xtask gates`: no panic and no double precision where they must not be.

use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use clap::Args;

use crate::cores::{CORES, firmware, for_targets, targets};
use crate::examples::{Example, path};
use crate::run::{done, qemu, workspace};
use crate::symbols::{doubles, symbols};

/// Checks that no panic can be reached from a tick or from loading an image, and that there is double precision only in programs that
/// declare it. Each gate is also shown to fail where it must.
#[derive(Args)]
pub(crate) struct Options {}

/// Examples that link only if no panic can be reached.
const GATES: [&str; 2] = ["no_panic", "no_panic_axis"];
/// Without and with a floating-point unit, which is one for single precision.
const FOR_DOUBLES: [&str; 2] = ["thumbv6m-none-eabi", "thumbv7em-none-eabihf"];
/// The function that such a program calls in its panic handler, and that does not exist.
const MISSING: &str = "undefined symbol: a_panic_is_reachable";

pub(crate) fn run(_: &Options) -> Result<()> {
    for target in targets() {
        for example in GATES {
            let output = faulty(example, target, "gate_panic").output()?;
            let log = String::from_utf8_lossy(&output.stderr);
            refused(output.status.success(), &log)
                .with_context(|| format!("{target}: {example} that can panic"))?;
            println!("{target}: {example} that can panic does not link");
        }
    }
    for target in FOR_DOUBLES {
        for example in GATES {
            done(&mut faulty(example, target, "gate_double"))?;
            let found = symbols(&path(&firmware(target), example))?;
            let found = doubles(&found);
            ensure!(
                !found.is_empty(),
                "{target}: double precision is in {example} but not found, so this gate shows nothing"
            );
            println!(
                "{target}: where there is some in {example}, the search finds {}",
                found.join(" ")
            );
        }
    }

    // These take the place of the programs above.
    let mut cargo = workspace("build");
    cargo.args(OPTIONS).arg("--examples").args(for_targets());
    done(&mut cargo).context("a panic can be reached")?;
    for core in &CORES {
        for example in GATES {
            done(&mut qemu(core, &path(&core.firmware(), example)))?;
            println!(
                "no panic can be reached in {example} on {}, and the program runs",
                core.name
            );
        }
    }
    let examples = Example::all()?;
    let numbered = examples.iter().map(|e| (&*e.name, e.is_double()));
    let gates = GATES.map(|name| (name, false));
    let programs: Vec<_> = gates.into_iter().chain(numbered).collect();
    for target in FOR_DOUBLES {
        for (name, double) in &programs {
            let found = symbols(&path(&firmware(target), name))?;
            let verdict = precision(*double, &doubles(&found))
                .with_context(|| format!("{name} for {target}"))?;
            println!("{name} for {target}: {verdict}");
        }
    }
    Ok(())
}

const OPTIONS: [&str; 6] = [
    "--package",
    "jred",
    "--profile",
    "firmware",
    "--features",
    "micromath",
];

/// Compiles an example with the fault that a gate must find.
fn faulty(example: &str, target: &str, fault: &str) -> Command {
    let mut cargo = workspace("rustc");
    cargo.args(OPTIONS).args([
        "--quiet",
        "--example",
        example,
        "--target",
        target,
        "--",
        "--cfg",
        fault,
    ]);
    cargo
}

/// Checks that a program that can panic was refused by the linker, and for that reason.
fn refused(links: bool, log: &str) -> Result<()> {
    ensure!(!links, "it links, so this gate shows nothing");
    ensure!(log.contains(MISSING), "it fails for another reason:\n{log}");
    Ok(())
}

/// Judges the routines in double precision of a program that says whether it has some.
fn precision(says: bool, found: &[&str]) -> Result<&'static str> {
    match (says, found) {
        (true, []) => bail!("it says that it computes in double precision, but does not"),
        (true, _) => Ok("double precision, as it says"),
        (false, []) => Ok("no double precision"),
        (false, _) => bail!("it uses double precision: {}", found.join(" ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_missing_panic_handler_shows_that_the_gate_works() {
        let log = format!("error: linking failed\n  = note: rust-lld: error: {MISSING}\n");
        assert!(refused(false, &log).is_ok());
        assert!(refused(true, "").is_err());
        assert!(refused(true, &log).is_err());
        let other = refused(false, "error: no such target").unwrap_err();
        assert!(other.to_string().ends_with("no such target"), "{other}");
    }

    #[test]
    fn double_precision_must_be_where_it_is_declared_and_nowhere_else() {
        assert_eq!(precision(false, &[]).unwrap(), "no double precision");
        assert!(precision(true, &["__adddf3"]).is_ok());
        assert!(precision(true, &[]).is_err());
        let error = precision(false, &["__adddf3", "sin"]).unwrap_err();
        assert!(error.to_string().ends_with("__adddf3 sin"), "{error}");
    }
}
