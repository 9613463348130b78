//! A user's firmware, `benches/user`: upper bounds of the instructions of each function.

use std::path::PathBuf;

use anyhow::{Context, Result};

use crate::bounds::Bounds;
use crate::ceilings::judge;
use crate::cores::{CORES, Core};
use crate::elf::Program;
use crate::run::{cargo, done, root, target_dir};

/// Compilation of the program: core, profile, further options of rustc.
struct Build {
    core: &'static str,
    profile: &'static str,
    rustc: &'static [&'static str],
}

const BUILDS: [Build; 6] = [
    Build {
        core: "cortex-m0",
        profile: "release",
        rustc: &[],
    },
    Build {
        core: "cortex-m3",
        profile: "release",
        rustc: &[],
    },
    Build {
        core: "cortex-m4",
        profile: "release",
        rustc: &[],
    },
    Build {
        core: "cortex-m7",
        profile: "release",
        rustc: &["-Ctarget-cpu=cortex-m7"],
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

/// The models of the program, and their titles in a table; in fixed point with 1/J.
const MODELS: [(&str, &str); 9] = [
    ("cubic_f32", "f32, cubic"),
    ("spline_f32", "f32, spline"),
    ("quadratic_f32", "f32, quadratic"),
    ("crank_f32", "f32, slider-crank"),
    ("cubic_q31", "q31, cubic"),
    ("quadratic_q31", "q31, quadratic"),
    ("spline_q31", "q31, spline"),
    ("spline16_q31", "q31, 16-bit spline"),
    ("rows_q15", "q15, 16-bit rows"),
];

/// The calls on each of them.
const CALLS: [(&str, &str); 5] = [
    ("torque", "torque"),
    ("acceleration", "acceleration"),
    ("range", "range of accelerations"),
    ("counts", "10,000 counts → torque"),
    ("binary", "4096 counts → torque"),
];

/// The other functions of the program, and their titles in a table.
const FUNCTIONS: [(&str, &str); 20] = [
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
    ("ramp_torque", "f32, cubic: torque with `FrictionRamp`"),
    ("transmission_motor", "`Transmission::motor`, f32"),
    ("limits_limited", "`TorqueLimits::limited`, f32"),
    ("f32_feasible", "`Limits::feasible`, f32, cubic"),
    ("f32_govern", "`Governor::govern`, f32, cubic"),
    ("f32_stop", "`LookAhead::stop`, f32"),
    ("q31_feasible", "`Limits::feasible`, q31, quadratic, 1/J"),
    ("q31_govern", "`Governor::govern`, q31, quadratic, 1/J"),
    ("q31_stop", "`LookAhead::stop`, q31"),
];

/// They search for a place among points or nodes. With opt-level "s" the compiler keeps the loop, whose length the bounds do not know.
const SEARCHES: [&str; 6] = [
    "f32_feasible",
    "f32_govern",
    "f32_stop",
    "q31_feasible",
    "q31_govern",
    "q31_stop",
];

/// Every function with its title.
fn functions() -> Vec<(String, String)> {
    let calls = MODELS.iter().flat_map(|(model, title)| {
        CALLS.map(|(call, what)| (format!("{model}_{call}"), format!("{title}: {what}")))
    });
    let others = FUNCTIONS
        .iter()
        .map(|(name, title)| ((*name).to_owned(), (*title).to_owned()));
    calls.chain(others).collect()
}

impl Build {
    fn core(&self) -> Result<&'static Core> {
        CORES
            .iter()
            .find(|core| core.name == self.core)
            .context("no such core")
    }

    /// Name in `benches/ceilings.txt`.
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
        let mut cargo = cargo();
        cargo
            .current_dir(root().join("benches/user"))
            .args(["build", "--quiet", "--profile", self.profile])
            .args(["--target", core.target, "--config"])
            .arg(format!("target.{}.rustflags = {flags:?}", core.target))
            .arg("--target-dir")
            .arg(&folder);
        done(&mut cargo)
            .with_context(|| format!("benches/user does not compile for {}", core.name))?;
        Ok(folder.join(core.target).join(self.profile).join("user"))
    }
}

/// The bounds of all functions that have one in this build.
fn bounds(build: &Build) -> Result<Vec<Option<u32>>> {
    let program = Program::read(&build.compile()?)?;
    let mut bounds = Bounds::new(&program)?;
    let mut of = |name: &str| -> Result<Option<u32>> {
        let searches = build.profile == "small" && SEARCHES.contains(&name);
        (!searches)
            .then(|| Ok(bounds.of(name)?.instructions))
            .transpose()
    };
    functions().iter().map(|(name, _)| of(name)).collect()
}

/// Compiles the program, prints the table, and checks every figure; returns the number of those out of bounds.
pub(crate) fn run(markdown: bool) -> Result<u32> {
    let mut columns = Vec::new();
    for build in &BUILDS {
        columns.push(bounds(build)?);
    }
    let separator = if markdown { " | " } else { "  " };
    if markdown {
        println!(
            "| instructions at most | M0+ | M3 | M4F | M7 | M4F, `opt-level = \"s\"` | M4F, `-Ctarget-cpu=cortex-m4` |\n|---|---:|---:|---:|---:|---:|---:|"
        );
    }
    let mut failures = 0;
    for (k, (name, title)) in functions().iter().enumerate() {
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
