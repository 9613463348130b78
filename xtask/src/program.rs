//! The on-target program: compiled and linked, and its input and output files.

use std::path::{Path, PathBuf};
use std::process::Stdio;

use anyhow::{Context, Result, ensure};

use crate::cores::Core;
use crate::data::{self, Words};
use crate::kernels::{COUNTS, Kernel, Quantity};
use crate::machine::{Example, motions};
use crate::run::{target_dir, workspace};

/// Folder of the files that the program for `core` reads and writes.
pub(crate) fn files(core: &Core) -> PathBuf {
    target_dir().join("tick").join(core.name)
}

/// Compiles the program for `core`, with the objects of `peers`, if any.
pub(crate) fn compile(core: &Core, peers: Option<&Path>) -> Result<PathBuf> {
    let mut flags: Vec<String> = core.rustc.iter().map(|flag| (*flag).to_owned()).collect();
    if let Some(object) = peers {
        flags.extend([
            "--cfg=tick_peers".to_owned(),
            format!("-Clink-arg={}", object.display()),
        ]);
    }
    let mut cargo = workspace("bench");
    cargo
        .args(["--no-run", "--package", "jred", "--features", "micromath"])
        .args(["--bench", "tick", "--profile", "firmware"])
        .args(["--target", core.target, "--quiet"])
        .args(["--message-format", "json-render-diagnostics"]);
    if !flags.is_empty() {
        cargo
            .arg("--config")
            .arg(format!("target.{}.rustflags = {flags:?}", core.target));
    }
    let output = cargo.stderr(Stdio::inherit()).output().context("cargo")?;
    ensure!(
        output.status.success(),
        "the program for {} does not compile",
        core.name
    );
    String::from_utf8_lossy(&output.stdout)
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok())
        .find_map(|message| message.get("executable")?.as_str().map(PathBuf::from))
        .context("cargo named no program")
}

/// A kernel's arguments and the expected results.
pub(crate) struct Work {
    points: Vec<[u32; 3]>,
    expected: Vec<f64>,
    data: Words,
    scale: jred::Scale,
}

impl Work {
    pub(crate) fn new(kernel: &Kernel, example: &Example) -> Result<Self> {
        let scale = data::scale(kernel, example)?;
        let data = data::words(kernel, example, &scale)?;
        let (number, of) = (kernel.number, kernel.quantity);
        let mut points: Vec<[u32; 3]> = Vec::new();
        let mut expected = Vec::new();
        for [turn, omega, alpha] in motions() {
            let phi = turn * std::f64::consts::TAU;
            let curves = example.curves(phi);
            let third = match of {
                Quantity::Torque => alpha,
                Quantity::Acceleration => {
                    curves.inertia * alpha + curves.half_slope * omega * omega
                }
            };
            let mut words = number.encode(&scale, of, [turn, omega, third]);
            let counted = kernel.counts.then(|| {
                let count = (u64::from(words[0]) * u64::from(COUNTS)) >> 32;
                words[0] = ((count << 32) / u64::from(COUNTS)) as u32;
                // Several turns away, in both directions.
                let turns = points.len() as u32 % 7;
                (count as u32)
                    .wrapping_add(COUNTS * turns)
                    .wrapping_sub(3 * COUNTS)
            });
            // The reference is computed from the rounded arguments: the error is the kernel's own.
            let [phi, omega, third] = number.decode(&scale, of, words);
            points.push([counted.unwrap_or(words[0]), words[1], words[2]]);
            expected.push(match of {
                Quantity::Torque => example.torque(phi, omega, third),
                Quantity::Acceleration => example.acceleration(phi, omega, third),
            });
        }
        Ok(Self {
            points,
            expected,
            data,
            scale,
        })
    }

    /// Bytes of the tables.
    pub(crate) fn table_bytes(&self) -> usize {
        self.data.table_bytes
    }

    /// Number of calls.
    pub(crate) fn calls(&self) -> usize {
        self.points.len()
    }

    /// Writes `NAME.in`.
    pub(crate) fn write(&self, kernel: &Kernel, folder: &Path) -> Result<()> {
        let counts = [self.data.words.len() as u32, self.points.len() as u32];
        let words = counts
            .iter()
            .chain(&self.data.words)
            .chain(self.points.as_flattened());
        let bytes: Vec<u8> = words.flat_map(|word| word.to_le_bytes()).collect();
        let path = folder.join(format!("{}.in", kernel.name));
        std::fs::write(&path, bytes).with_context(|| path.display().to_string())
    }

    /// Reads `NAME.out`: the largest error, relative to the largest result, and the reading of the clock.
    pub(crate) fn read(&self, kernel: &Kernel, folder: &Path) -> Result<(f64, u32)> {
        let path = folder.join(format!("{}.out", kernel.name));
        let bytes = std::fs::read(&path).with_context(|| path.display().to_string())?;
        let (words, rest) = bytes.as_chunks();
        let words: Vec<u32> = words.iter().map(|word| u32::from_le_bytes(*word)).collect();
        let complete = rest.is_empty() && words.len() == 3 * self.points.len() + 1;
        ensure!(
            complete,
            "{}: {} bytes are not the results",
            path.display(),
            bytes.len()
        );
        let result = |word| kernel.number.result(&self.scale, kernel.quantity, word);
        let largest = self
            .expected
            .iter()
            .fold(0.0f64, |most, value| most.max(value.abs()));
        let error = words
            .chunks_exact(3)
            .zip(&self.expected)
            .map(|(words, value)| (result(words[0]) - value).abs());
        // A result that is NaN must not pass as a small error.
        let error = error.fold(
            0.0f64,
            |most, e| if e.is_nan() || e > most { e } else { most },
        );
        Ok((error / largest, words[words.len() - 1]))
    }
}
