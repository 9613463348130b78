//! A user's firmware, `benches/user`: the instructions that each of its functions can take at most.

use std::path::PathBuf;
use std::process::Stdio;

use anyhow::{Context, Result, ensure};

use crate::bounds::Bounds;
use crate::ceilings::judge;
use crate::cores::{CORES, Core};
use crate::elf::Program;
use crate::program::{cargo, root, target_dir};

/// How the program is compiled: core, profile, further options of rustc.
struct Build {
    core: &'static str,
    profile: &'static str,
    rustc: &'static [&'static str],
}

const BUILDS: [Build; 4] = [
    Build {
        core: "cortex-m0",
        profile: "release",
        rustc: &[],
    },
    Build {
        core: "cortex-m4",
        profile: "release",
        rustc: &[],
    },
    Build {
        core: "cortex-m4",
        profile: "small",
        rustc: &[],
    },
    Build {
        core: "cortex-m4",
        profile: "release",
        rustc: &["-Ctarget-cpu=cortex-m4"],
    },
];

/// A function of the program, and what a table calls it.
const FUNCTIONS: [(&str, &str); 50] = [
    ("cubic_f32_torque", "f32, cubic: torque"),
    ("cubic_f32_acceleration", "f32, cubic: acceleration"),
    ("cubic_f32_range", "f32, cubic: range of accelerations"),
    ("cubic_f32_counts", "f32, cubic: 10,000 counts → torque"),
    ("cubic_f32_binary", "f32, cubic: 4096 counts → torque"),
    ("spline_f32_torque", "f32, spline: torque"),
    ("spline_f32_acceleration", "f32, spline: acceleration"),
    ("spline_f32_range", "f32, spline: range of accelerations"),
    ("spline_f32_counts", "f32, spline: 10,000 counts → torque"),
    ("spline_f32_binary", "f32, spline: 4096 counts → torque"),
    ("crank_f32_torque", "f32, slider-crank: torque"),
    ("crank_f32_acceleration", "f32, slider-crank: acceleration"),
    (
        "crank_f32_range",
        "f32, slider-crank: range of accelerations",
    ),
    (
        "crank_f32_counts",
        "f32, slider-crank: 10,000 counts → torque",
    ),
    (
        "crank_f32_binary",
        "f32, slider-crank: 4096 counts → torque",
    ),
    ("cubic_q31_torque", "q31, cubic: torque"),
    ("cubic_q31_acceleration", "q31, cubic, 1/J: acceleration"),
    ("cubic_q31_range", "q31, cubic, 1/J: range of accelerations"),
    ("cubic_q31_counts", "q31, cubic: 10,000 counts → torque"),
    ("cubic_q31_binary", "q31, cubic: 4096 counts → torque"),
    ("quadratic_q31_torque", "q31, quadratic: torque"),
    (
        "quadratic_q31_acceleration",
        "q31, quadratic, 1/J: acceleration",
    ),
    (
        "quadratic_q31_range",
        "q31, quadratic, 1/J: range of accelerations",
    ),
    (
        "quadratic_q31_counts",
        "q31, quadratic: 10,000 counts → torque",
    ),
    (
        "quadratic_q31_binary",
        "q31, quadratic: 4096 counts → torque",
    ),
    ("rows_q15_torque", "q15, 16-bit rows: torque"),
    (
        "rows_q15_acceleration",
        "q15, 16-bit rows, 1/J: acceleration",
    ),
    (
        "rows_q15_range",
        "q15, 16-bit rows, 1/J: range of accelerations",
    ),
    (
        "rows_q15_counts",
        "q15, 16-bit rows: 10,000 counts → torque",
    ),
    ("rows_q15_binary", "q15, 16-bit rows: 4096 counts → torque"),
    ("counter_extend", "`Counter::extend`"),
    ("encoder_phase", "`Encoder::phase`"),
    ("encoder_phase_wide", "`Encoder::phase_wide`"),
    ("stroke_phase", "`StrokeEncoder::phase`"),
    ("tracker_update", "`Tracker::update`"),
    ("omega_f32", "`Period::omega`, f32"),
    ("omega_q31", "`Period::omega`, q31"),
    ("si_q31", "q31, quadratic: torque, SI in and out"),
    ("status_torque", "f32, cubic: torque and status"),
    (
        "slot_torque",
        "f32, cubic: torque and status, of an `ImageSlot`",
    ),
    ("period_later", "`Period::later` (lead time), f32"),
    ("ramp_torque", "f32, cubic: torque with `Ramp`"),
    ("transmission_motor", "`Transmission::motor`, f32"),
    ("limits_limited", "`TorqueLimits::limited`, f32"),
    ("f32_feasible", "`Limits::feasible`, f32, cubic"),
    ("f32_govern", "`Governor::govern`, f32, cubic"),
    ("f32_stop", "`LookAhead::stop`, f32"),
    ("q31_feasible", "`Limits::feasible`, q31, quadratic, 1/J"),
    ("q31_govern", "`Governor::govern`, q31, quadratic, 1/J"),
    ("q31_stop", "`LookAhead::stop`, q31"),
];

/// They look for a place among points or nodes. With opt-level "s" the compiler keeps the loop, whose length is known to it but not to the
/// bounds.
const SEARCHES: [&str; 6] = [
    "f32_feasible",
    "f32_govern",
    "f32_stop",
    "q31_feasible",
    "q31_govern",
    "q31_stop",
];

impl Build {
    fn core(&self) -> Result<&'static Core> {
        CORES
            .iter()
            .find(|core| core.name == self.core)
            .context("no such core")
    }

    /// As `benches/ceilings.txt` names it.
    fn name(&self) -> String {
        let options = if self.rustc.is_empty() { "" } else { "-tuned" };
        format!("user-{}{options}", self.profile)
    }

    fn compile(&self) -> Result<PathBuf> {
        let core = self.core()?;
        // In addition to those of `.cargo/config.toml`: its memory.x lies in the workspace.
        let mut flags = vec!["-Clink-arg=-L../.."];
        flags.extend(self.rustc);
        let folder = target_dir().join(self.name());
        let status = cargo()
            .current_dir(root().join("benches/user"))
            .args([
                "build",
                "--quiet",
                "--profile",
                self.profile,
                "--target",
                core.target,
            ])
            .args([
                "--config",
                &format!("target.{}.rustflags = {flags:?}", core.target),
            ])
            .arg("--target-dir")
            .arg(&folder)
            .stderr(Stdio::inherit())
            .status()
            .context("cargo")?;
        ensure!(
            status.success(),
            "benches/user does not compile for {}",
            core.name
        );
        Ok(folder.join(core.target).join(self.profile).join("user"))
    }
}

/// The bounds of every function that has one in this build.
fn bounds(build: &Build) -> Result<Vec<Option<u32>>> {
    let program = Program::read(&build.compile()?)?;
    let mut bounds = Bounds::new(&program)?;
    let mut of = |name| -> Result<Option<u32>> {
        let searches = build.profile == "small" && SEARCHES.contains(&name);
        (!searches)
            .then(|| Ok(bounds.of(name)?.instructions))
            .transpose()
    };
    FUNCTIONS.iter().map(|(name, _)| of(name)).collect()
}

/// Compiles the program, prints the table, and judges every figure; the number of those out of bounds.
pub(crate) fn run(markdown: bool) -> Result<u32> {
    let mut columns = Vec::new();
    for build in &BUILDS {
        columns.push(bounds(build)?);
    }
    let separator = if markdown { " | " } else { "  " };
    if markdown {
        println!(
            "| instructions at most | M0+ | M4F | M4F, `opt-level = \"s\"` | M4F, `-Ctarget-cpu=cortex-m4` |\n|---|---:|---:|---:|---:|"
        );
    }
    let mut failures = 0;
    for (k, (name, title)) in FUNCTIONS.iter().enumerate() {
        let figures: Vec<Option<u32>> = columns.iter().map(|column| column[k]).collect();
        let cells: Vec<String> = figures
            .iter()
            .map(|figure| figure.map_or("    –".to_owned(), |figure| format!("{figure:>5}")))
            .collect();
        let row = cells.join(separator);
        if markdown {
            println!("| {title} | {} |", row.replace("  ", ""));
        } else {
            println!("{title:<55} {row}");
        }
        for (build, figure) in BUILDS.iter().zip(figures) {
            let Some(figure) = figure else { continue };
            let name = format!("{}-{name}", build.name());
            let verdict = judge(build.core, &name, u64::from(figure));
            if !verdict.holds() {
                eprintln!(
                    "{} {name}: {figure} instructions at most, {verdict}",
                    build.core
                );
                failures += 1;
            }
        }
    }
    Ok(failures)
}
