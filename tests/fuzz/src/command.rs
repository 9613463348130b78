//! Machine files through every command of `jred`, as a user runs it.

use std::path::Path;
use std::process::{Command, Output};

use rand::{Rng, RngExt as _};

use crate::{NAMED, no_number};

/// Processor time (s) and memory (KiB) of a command: more than any example needs, `sensitivity` of the excavator with overflow checks included.
const SECONDS: u32 = 60;
const MEMORY: u32 = 1_000_000;

/// Commands with their options, `_` for a space within a word; MACHINE is the machine file, OUT a file to write.
pub const COMMANDS: &[&str] = &[
    "check MACHINE",
    "check MACHINE --format json",
    "reduce MACHINE",
    "reduce MACHINE --format csv --over time",
    "reduce MACHINE --format json --links",
    "reduce MACHINE --points --speed 60_rpm",
    "reduce MACHINE --reactions --over time --format csv",
    "reduce MACHINE --energy --report OUT",
    "size MACHINE",
    "size MACHINE --format csv --all",
    "size MACHINE --format json --explain",
    "size MACHINE --report OUT",
    "size MACHINE --pareto mass,energy",
    "size MACHINE --meter OUT",
    "simulate MACHINE",
    "simulate MACHINE --format json --report OUT",
    "ratio MACHINE",
    "ratio MACHINE --format csv",
    "drive MACHINE --counts-per-turn 1048576 --bandwidth 40_Hz",
    "bus MACHINE",
    "identify four-bar-log.csv --machine MACHINE --counts-per-turn 4096",
    "sensitivity MACHINE",
    "tolerance MACHINE --samples 5",
    "export MACHINE --torque-error 1_N_m --out OUT --max-cells 200",
    "export MACHINE --max-bytes 2000 --type i16 --layout rows --out OUT",
    "export MACHINE --max-bytes 3000 --type i32 --layout cubic --format rust --out OUT",
    "export MACHINE --torque-error 5_N_m --type f32 --layout harmonic --out OUT",
    "export MACHINE --torque-error 5_N_m --type f32 --layout slider-crank --out OUT",
    "export MACHINE --torque-error 5_N_m --pieces auto --format c --out OUT --max-cells 200",
    "export MACHINE --torque-error 5_N_m --format plcopen --out OUT --max-cells 200",
    "export MACHINE --format cia402 --rated-torque 5_N_m --rows 20 --out OUT",
    "export MACHINE --format cia402 --drive sgm7a-25a+tp004mf-4 --rows 20 --out OUT",
];

/// One of the commands.
pub fn any(rng: &mut impl Rng) -> &'static str {
    COMMANDS[rng.random_range(0..COMMANDS.len())]
}

/// Runs a command with this machine.
///
/// # Errors
/// The fault in the command's behaviour.
///
/// # Panics
/// The command cannot be started, or the machine file cannot be written.
pub fn run(command: &str, jred: &Path, machine: &str) -> Result<i32, String> {
    let folder = tempfile::tempdir().unwrap();
    for name in NAMED {
        std::fs::copy(crate::at("machines").join(name), folder.path().join(name)).unwrap();
    }
    std::fs::write(folder.path().join("machine.toml"), machine).unwrap();
    let words = command
        .split(' ')
        .map(|word| word.replace('_', " ").replace("MACHINE", "machine.toml"));
    // The shell sets the limits and becomes the command.
    let limits = format!("ulimit -t {SECONDS} && ulimit -v {MEMORY} && exec \"$@\"");
    let output = Command::new("sh")
        .args(["-c", &limits, "sh"])
        .arg(jred)
        .args(words)
        .current_dir(folder.path())
        .env("NO_COLOR", "1")
        .output()
        .unwrap();
    let written = std::fs::read(folder.path().join("OUT")).ok();
    judge(&output, written.as_deref()).map_err(|what| format!("jred {command}: {what}"))
}

/// Why an output is wrong.
fn judge(output: &Output, written: Option<&[u8]>) -> Result<i32, String> {
    let [out, err] =
        [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    let Some(code @ 0..=2) = output.status.code() else {
        return Err(format!(
            "ended with {}: more than {SECONDS} s or {MEMORY} KiB?\n{err}",
            output.status
        ));
    };
    if err.contains("panicked") || err.contains("overflow") {
        return Err(err);
    }
    if code == 2 && (err.is_empty() || !out.is_empty()) {
        return Err(format!(
            "bad input, but the message is {err:?} and the result {out:?}"
        ));
    }
    let page = written.map(String::from_utf8_lossy).unwrap_or_default();
    // Pages contain scripts, whose words are not numbers.
    let page = page.split("<script").next().unwrap_or_default().to_owned();
    for (name, text) in [("result", &out), ("message", &err), ("file", &page)] {
        if let Some(word) = no_number(text) {
            return Err(format!("{word:?} in the {name}: {text}"));
        }
    }
    Ok(code)
}
