//! Programs that are run, and the folders they work in.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail, ensure};

use crate::cores::Core;

/// The workspace.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .unwrap_or(Path::new("."))
}

/// Build folder.
pub(crate) fn target_dir() -> PathBuf {
    let set =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| PathBuf::from("target"), PathBuf::from);
    root().join(set)
}

/// A program that works in the workspace.
pub(crate) fn program(name: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(name);
    command.current_dir(root());
    command
}

/// The cargo that runs this, or the installed one.
pub(crate) fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// A subcommand of cargo for the workspace, in the build folder.
pub(crate) fn workspace(subcommand: &str) -> Command {
    let mut command = cargo();
    command
        .current_dir(root())
        .args([subcommand, "--target-dir"])
        .arg(target_dir());
    command
}

/// A program on `core` in QEMU; output and exit code are those of the program.
pub(crate) fn qemu(core: &Core, path: &Path) -> Command {
    let mut command = program("scripts/qemu");
    command.args([core.machine, core.cpu]).arg(path);
    command
}

/// Runs a command that prints; an error if it fails.
pub(crate) fn done(command: &mut Command) -> Result<()> {
    let status = command
        .stdin(Stdio::null())
        .status()
        .with_context(|| format!("{command:?} does not run"))?;
    ensure!(status.success(), "{command:?}: {status}");
    Ok(())
}

/// The standard output of a command; if it fails, an error with that output.
pub(crate) fn output(command: &mut Command) -> Result<Vec<u8>> {
    let output = command
        .stdin(Stdio::null())
        .stderr(Stdio::inherit())
        .output()
        .with_context(|| format!("{command:?} does not run"))?;
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stdout);
        bail!("{text}{command:?}: {}", output.status);
    }
    Ok(output.stdout)
}

/// [`output`] as text.
pub(crate) fn text(command: &mut Command) -> Result<String> {
    let output = output(command)?;
    String::from_utf8(output).with_context(|| format!("{command:?} does not write text"))
}

/// Whether a program is installed, which must know `--version`.
pub(crate) fn installed(name: &str) -> bool {
    let output = Command::new(name).arg("--version").output();
    output.is_ok_and(|output| output.status.success())
}

/// Whether the compiler has the standard library of a target.
pub(crate) fn has_std(target: &str) -> Result<bool> {
    let sysroot = text(program("rustc").args(["--print", "sysroot"]))?;
    let libraries = Path::new(sysroot.trim()).join("lib/rustlib").join(target);
    let Ok(files) = std::fs::read_dir(libraries.join("lib")) else {
        return Ok(false);
    };
    Ok(files
        .flatten()
        .any(|file| file.file_name().to_string_lossy().starts_with("libstd-")))
}

/// Something could not be tested here. `scripts/test` shows such a line, and fails in CI.
pub(crate) fn skip(what: &str) {
    println!("SKIP {what}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_that_fails_is_an_error_with_its_output() {
        let rustc = |option: &str| text(program("rustc").arg(option));
        assert!(rustc("--version").unwrap().starts_with("rustc "));
        let error = rustc("--no-such-option").unwrap_err().to_string();
        assert!(error.contains("--no-such-option\": exit"), "{error}");
        assert!(done(&mut program("no-such-program")).is_err());
    }

    #[test]
    fn what_is_missing_is_found_to_be() {
        assert!(installed("rustc") && !installed("no-such-program"));
        assert!(!has_std("no-such-target").unwrap());
    }
}
