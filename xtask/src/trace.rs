//! Execution in QEMU, every instruction or only the result.
//!
//! With one instruction per translation block, not chained, `-d exec` writes a line for every executed instruction, in order, including those that an
//! IT block skips. In a line the address is the second of four hexadecimal numbers:
//!
//! ```text
//! Trace 0: 0x7f29ac000b40 [00800408/0000040a/00000110/ff000201] Reset
//! ```

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, anyhow, bail, ensure};

use crate::cores::Core;

/// The option for one instruction per translation block, by the emulator's version.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Emulator {
    /// Before 8.1.
    Singlestep,
    /// From 8.1 on.
    OneInstruction,
}

const QEMU: &str = "qemu-system-arm";
/// Limit of instructions after which a program counts as hanging, for example after a fault: twice the need of all kernels.
const MOST: u32 = 40_000_000;

impl Emulator {
    /// The installed emulator.
    pub(crate) fn installed() -> Result<Self> {
        let output = Command::new(QEMU).arg("--version").output();
        let output =
            output.with_context(|| format!("{QEMU} is not installed (scripts/test setup)"))?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        Self::of(&text).with_context(|| format!("no version in `{}`", text.trim()))
    }

    fn of(version: &str) -> Option<Self> {
        let version = version.split("version ").nth(1)?;
        let mut numbers = version
            .split(|c: char| !c.is_ascii_digit())
            .map(str::parse::<u32>);
        let (major, minor) = (numbers.next()?.ok()?, numbers.next()?.ok()?);
        Some(if (major, minor) < (8, 1) {
            Self::Singlestep
        } else {
            Self::OneInstruction
        })
    }

    fn command(core: &Core, program: &Path, folder: &Path) -> Command {
        let mut command = Command::new(QEMU);
        command
            .args(["-machine", core.machine, "-cpu", core.cpu])
            .args(["-display", "none", "-monitor", "none", "-serial", "none"])
            .args(["-semihosting-config", "enable=on,target=native", "-kernel"])
            .arg(program)
            .current_dir(folder)
            .stdin(Stdio::null());
        command
    }

    /// Runs the program in `folder` and calls `each` with the address of every instruction between the two addresses.
    pub(crate) fn trace(
        self,
        core: &Core,
        program: &Path,
        folder: &Path,
        [from, to]: [u32; 2],
        mut each: impl FnMut(u32) -> Result<()>,
    ) -> Result<()> {
        let mut command = Self::command(core, program, folder);
        match self {
            Self::Singlestep => command.arg("-singlestep"),
            Self::OneInstruction => command.args(["-accel", "tcg,one-insn-per-tb=on"]),
        };
        command.args([
            "-d",
            "exec,nochain",
            "-dfilter",
            &format!("{from:#x}..{:#x}", to - 1),
        ]);
        // The log goes to standard error, like error messages of QEMU or of the program.
        let mut child = command.stderr(Stdio::piped()).spawn().context(QEMU)?;
        let mut log = BufReader::with_capacity(1 << 16, child.stderr.take().context("no log")?);
        let (mut line, mut other, mut count) = (Vec::new(), String::new(), 0u32);
        while log.read_until(b'\n', &mut line)? > 0 {
            if let Some(address) = address(&line) {
                count += 1;
                let hangs = || anyhow!("{count} instructions, and no end, on {}", core.name);
                let result = if count < MOST {
                    each(address)
                } else {
                    Err(hangs())
                };
                if result.is_err() {
                    child.kill()?;
                    child.wait()?;
                    return result;
                }
            } else {
                other.push_str(&String::from_utf8_lossy(&line));
            }
            line.clear();
        }
        let status = child.wait()?;
        ensure!(
            status.success(),
            "{QEMU} on {}: {status}\n{other}",
            core.name
        );
        Ok(())
    }

    /// Runs the program in `folder` with one instruction per nanosecond, so that SysTick counts instructions.
    pub(crate) fn count(core: &Core, program: &Path, folder: &Path) -> Result<()> {
        let output = Self::command(core, program, folder)
            .args(["-icount", "shift=0"])
            .output()
            .context(QEMU)?;
        if !output.status.success() {
            let text = [output.stdout, output.stderr]
                .map(|t| String::from_utf8_lossy(&t).into_owned())
                .concat();
            bail!("{QEMU} on {}: {}\n{text}", core.name, output.status);
        }
        Ok(())
    }
}

/// The address in a line of the log.
fn address(line: &[u8]) -> Option<u32> {
    let line = line.strip_prefix(b"Trace ")?;
    let open = line.iter().position(|byte| *byte == b'[')?;
    let mut fields = line[open + 1..].split(|byte| *byte == b'/');
    let digits = fields.nth(1)?;
    digits.iter().try_fold(0u32, |sum, digit| {
        Some(sum << 4 | (*digit as char).to_digit(16)?)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_address_is_read() {
        let line = b"Trace 0: 0x7f29ac000b40 [00800408/0000040a/00000110/ff000201] Reset\n";
        assert_eq!(address(line), Some(0x40a));
        assert_eq!(address(b"Linking TBs 0x7f [0000040a] index 0\n"), None);
    }

    #[test]
    fn the_option_goes_by_the_version() {
        let version = |text: &str| Emulator::of(text);
        assert_eq!(
            version("QEMU emulator version 7.2.22 (Debian 1:7.2)"),
            Some(Emulator::Singlestep)
        );
        assert_eq!(
            version("QEMU emulator version 8.0.4"),
            Some(Emulator::Singlestep)
        );
        assert_eq!(
            version("QEMU emulator version 8.1.0"),
            Some(Emulator::OneInstruction)
        );
        assert_eq!(
            version("QEMU emulator version 10.0.2"),
            Some(Emulator::OneInstruction)
        );
        assert_eq!(version("no emulator"), None);
    }
}
