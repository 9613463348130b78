//! The cores, and the compilation and emulation of programs for them.

use std::path::PathBuf;

use crate::run::target_dir;
use crate::timing::Timing;

/// A Cortex-M core.
pub(crate) struct Core {
    /// Name in `benches/ceilings.txt`.
    pub(crate) name: &'static str,
    /// Name in the heads of tables.
    pub(crate) title: &'static str,
    /// The target of rustc.
    pub(crate) target: &'static str,
    /// Options of rustc in addition to those of `.cargo/config.toml`.
    pub(crate) rustc: &'static [&'static str],
    /// Options of gcc.
    pub(crate) gcc: &'static [&'static str],
    /// QEMU's machine.
    pub(crate) machine: &'static str,
    /// QEMU's core.
    pub(crate) cpu: &'static str,
    /// Frequency of the machine's SysTick (Hz).
    pub(crate) clock: f64,
    /// Whether it has a floating-point unit.
    pub(crate) float: bool,
    /// Published instruction timings, if any.
    pub(crate) timing: Option<Timing>,
}

/// Every core, from the smallest to the largest.
pub(crate) const CORES: [Core; 5] = [
    // QEMU has no M0+. The M0 has the same instructions; the timings are those of the M0+.
    Core {
        name: "cortex-m0",
        title: "M0+",
        target: "thumbv6m-none-eabi",
        rustc: &[],
        gcc: &["-mcpu=cortex-m0plus", "-mfloat-abi=soft"],
        machine: "microbit",
        cpu: "cortex-m0",
        clock: 16e6,
        float: false,
        timing: Some(Timing::M0Plus),
    },
    Core {
        name: "cortex-m3",
        title: "M3",
        target: "thumbv7m-none-eabi",
        rustc: &[],
        gcc: &["-mcpu=cortex-m3", "-mfloat-abi=soft"],
        machine: "mps2-an385",
        cpu: "cortex-m3",
        clock: 25e6,
        float: false,
        timing: Some(Timing::M3),
    },
    Core {
        name: "cortex-m4",
        title: "M4F",
        target: "thumbv7em-none-eabihf",
        rustc: &[],
        gcc: &["-mcpu=cortex-m4", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"],
        machine: "mps2-an386",
        cpu: "cortex-m4",
        clock: 25e6,
        float: true,
        timing: Some(Timing::M4),
    },
    // Arm publishes no timings of the M7 and the M33.
    Core {
        name: "cortex-m7",
        title: "M7",
        target: "thumbv7em-none-eabihf",
        rustc: &["-Ctarget-cpu=cortex-m7"],
        gcc: &["-mcpu=cortex-m7", "-mfloat-abi=hard", "-mfpu=fpv5-d16"],
        machine: "mps2-an500",
        cpu: "cortex-m7",
        clock: 25e6,
        float: true,
        timing: None,
    },
    Core {
        name: "cortex-m33",
        title: "M33",
        target: "thumbv8m.main-none-eabihf",
        rustc: &["-Ctarget-cpu=cortex-m33"],
        gcc: &["-mcpu=cortex-m33", "-mfloat-abi=hard", "-mfpu=fpv5-sp-d16"],
        machine: "lm3s6965evb",
        cpu: "cortex-m33",
        clock: 12.5e6,
        float: true,
        timing: None,
    },
];

impl Core {
    /// Folder of what the profile `firmware` makes for its target.
    pub(crate) fn firmware(&self) -> PathBuf {
        firmware(self.target)
    }
}

/// Folder of what the profile `firmware` makes for a target.
pub(crate) fn firmware(target: &str) -> PathBuf {
    target_dir().join(target).join("firmware")
}

/// The targets of all cores.
pub(crate) fn targets() -> Vec<&'static str> {
    let mut targets: Vec<_> = CORES.iter().map(|core| core.target).collect();
    targets.dedup();
    targets
}

/// Cargo's options for the targets of all cores.
pub(crate) fn for_targets() -> impl Iterator<Item = &'static str> {
    targets()
        .into_iter()
        .flat_map(|target| ["--target", target])
}
