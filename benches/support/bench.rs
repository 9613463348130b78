//! Cost of work on the host: instructions, which are limited, and times, which are only printed.
//!
//! A benchmark starts itself again under `valgrind --tool=callgrind`, which counts the instructions of each call of [`region`]. That run prints its
//! counts, and the visible run prints its times next to them. Valgrind emulates the same processor wherever there is AVX2, so that counts only differ
//! by compilers and C libraries. On other processors, and without Valgrind, nothing is checked; a line that begins with `SKIP` reports it.
#![allow(dead_code, reason = "every benchmark uses its own part")]

use std::collections::HashMap;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;
use std::{env, fs, io};

use crate::ceilings::{Verdict, judge};

/// Runs per time; the best counts.
pub(crate) const RUNS: u32 = 7;

/// The shortest time of several runs (s).
pub(crate) fn best<T>(mut run: impl FnMut() -> T) -> f64 {
    (0..RUNS)
        .map(|_| once(&mut run))
        .fold(f64::INFINITY, f64::min)
}

/// The time of one run (s), without dropping the result.
pub(crate) fn once<T>(run: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    let result = black_box(run());
    let time = start.elapsed().as_secs_f64();
    drop(result);
    time
}

/// Argument of the counting run, before the folder for Valgrind's output.
const COUNT: &str = "--count-into";
/// Valgrind's file in it; a number for each call of [`region`] is appended.
const FILE: &str = "callgrind.out";

/// The counted function: Valgrind resets its count on entry and writes it on exit.
#[inline(never)]
fn region(work: &mut dyn FnMut()) {
    work();
    // Without this the call above would be a jump, and the exit of this function would be missed.
    black_box(());
}

/// Source of the instruction counts.
enum Counts {
    /// This run counts, into this folder.
    Here(PathBuf),
    /// Another run has counted.
    Known(HashMap<String, u64>),
    /// Nothing could be counted.
    None,
}

/// A run of a benchmark: measures, prints, and counts figures out of bounds.
pub(crate) struct Bench {
    counts: Counts,
    judges: bool,
    failures: u32,
}

impl Bench {
    /// Runs a benchmark, after its counting twin.
    pub(crate) fn main<E: std::fmt::Display>(
        run: impl FnOnce(&mut Self) -> Result<(), E>,
    ) -> ExitCode {
        let mut arguments = env::args_os().skip_while(|argument| argument != COUNT);
        let folder = arguments.nth(1).map(PathBuf::from);
        let counts = match folder {
            Some(folder) => Counts::Here(folder),
            None => match cannot_count() {
                None => Counts::Known(HashMap::new()),
                Some(why) => {
                    println!("SKIP instructions are not counted, so none are judged: {why}");
                    Counts::None
                }
            },
        };
        let mut bench = Self {
            counts,
            judges: true,
            failures: 0,
        };
        if let Counts::Known(known) = &mut bench.counts {
            match counted() {
                Ok(counts) => *known = counts,
                Err(error) => bench.fail(&format!("under Valgrind: {error}")),
            }
        }
        if let Err(error) = run(&mut bench) {
            bench.fail(&error.to_string());
        }
        if bench.failures == 0 {
            return ExitCode::SUCCESS;
        }
        println!("{} out of bounds", bench.failures);
        ExitCode::FAILURE
    }

    /// Whether this is the counting run: it needs no times, and its output is not shown.
    pub(crate) const fn counts(&self) -> bool {
        matches!(self.counts, Counts::Here(_))
    }

    /// Instructions of one run of the work, if they can be counted. Names may be in `ceilings.txt`.
    pub(crate) fn count(&mut self, name: &str, mut work: impl FnMut()) -> Option<u64> {
        match &self.counts {
            Counts::Known(known) => known.get(name).copied(),
            Counts::None => None,
            Counts::Here(folder) => match count(folder, &mut work) {
                Ok(count) => {
                    println!("{COUNTED}{name} {count}");
                    Some(count)
                }
                Err(error) => {
                    self.fail(&format!("{name}: {error}"));
                    None
                }
            },
        }
    }

    /// From here on figures are printed without a check: their data differ from the ceilings' data.
    pub(crate) const fn judge_nothing(&mut self) {
        self.judges = false;
    }

    /// Prints a line whose figure has a ceiling in `ceilings.txt`.
    pub(crate) fn judge(&mut self, name: &str, figure: u64, line: &str) {
        self.judged(name, Some(figure), line);
    }

    /// Prints a line with the instructions per unit of work, with `units` per run, and checks them; next to them the `line` for the time per unit
    /// (s).
    pub(crate) fn cost(
        &mut self,
        name: &str,
        units: u32,
        mut work: impl FnMut(),
        line: impl FnOnce(f64) -> String,
    ) {
        let count = self.count(name, &mut work);
        self.cost_of(name, units, count, || best(work) / f64::from(units), line);
    }

    /// The same for work with known or unavailable instruction counts, and a separately measured `time`.
    pub(crate) fn cost_of(
        &mut self,
        name: &str,
        units: u32,
        count: Option<u64>,
        time: impl FnOnce() -> f64,
        line: impl FnOnce(f64) -> String,
    ) {
        if !self.counts() {
            let each = count.map(|count| count / u64::from(units));
            self.judged(name, each, &line(time()));
        }
    }

    fn judged(&mut self, name: &str, figure: Option<u64>, line: &str) {
        if self.counts() {
            return;
        }
        let Some(figure) = figure else {
            println!("{name:30} {line}  not counted");
            return;
        };
        if !self.judges {
            println!("{name:30} {line} {figure:10}");
            return;
        }
        let verdict = judge("host", name, figure);
        println!("{name:30} {line} {figure:10}  {verdict}");
        self.failures += u32::from(!verdict.holds());
    }

    /// Checks a ratio, which must lie in `[low, high]`; without a ratio there is no check.
    pub(crate) fn band(&mut self, what: &str, [low, high]: [f64; 2], found: Option<f64>) {
        if self.counts() {
            return;
        }
        let Some(found) = found else {
            println!("{what}: not counted");
            return;
        };
        let holds = !self.judges || found >= low && found <= high;
        let word = if holds { "allowed" } else { "FAILED: allowed" };
        println!("{what}: {found:.3}, {word} {low} to {high}");
        self.failures += u32::from(!holds);
    }

    /// Checks that a figure too large, and one far too small, would fail: for `name`, with `units` of work per run, twice the work and a third of it
    /// must be out of bounds.
    pub(crate) fn control(&mut self, name: &str, units: u32, mut work: impl FnMut(u32)) {
        let mut count = |times: u32, bench: &mut Self| {
            let label = format!("control-{name}-{times}");
            let count = bench.count(&label, || work(units * times / 3))?;
            Some(judge("host", name, count / u64::from(units)))
        };
        let (twice, third) = (count(6, self), count(1, self));
        if self.counts() {
            return;
        }
        let (Some(twice), Some(third)) = (twice, third) else {
            return;
        };
        println!("control: twice the work of {name}: {twice}; a third of it: {third}");
        if self.judges && !matches!((twice, third), (Verdict::Above(_), Verdict::Slack(_))) {
            self.fail(&format!("{name} would hold whatever it cost"));
        }
    }

    /// Prints why this run fails.
    pub(crate) fn fail(&mut self, why: &str) {
        println!("FAILED: {why}");
        self.failures += 1;
    }
}

/// Prefix of a line of the counting run with a count.
const COUNTED: &str = "counted: ";

/// Instructions of the work, under Valgrind.
fn count(folder: &Path, work: &mut dyn FnMut()) -> io::Result<u64> {
    region(work);
    let text = (1..)
        .map(|number| folder.join(format!("{FILE}.{number}")))
        .map_while(|path| path.exists().then_some(path))
        .last()
        .map(fs::read_to_string)
        .transpose()?
        .unwrap_or_default();
    let totals = text.lines().find_map(|line| line.strip_prefix("summary: "));
    totals
        .and_then(|count| count.trim().parse().ok())
        .ok_or_else(|| io::Error::other("Valgrind has not counted this"))
}

/// Why instructions cannot be counted here.
fn cannot_count() -> Option<&'static str> {
    #[cfg(target_arch = "x86_64")]
    let known = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    let known = false;
    if !known {
        return Some("their ceilings are for an x86-64 with AVX2");
    }
    let version = Command::new("valgrind").arg("--version").output();
    version.is_err().then_some("Valgrind is not installed")
}

/// Starts this program again under Valgrind, for its counts.
fn counted() -> io::Result<HashMap<String, u64>> {
    let program = env::current_exe()?;
    let name = program.file_stem().unwrap_or_default();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("counts")
        .join(name);
    // Files of an earlier run.
    drop(fs::remove_dir_all(&folder));
    fs::create_dir_all(&folder)?;
    let region = concat!(module_path!(), "::region");
    let output = Command::new("valgrind")
        .args(["-q", "--tool=callgrind"])
        .arg(format!(
            "--callgrind-out-file={}",
            folder.join(FILE).display()
        ))
        .arg(format!("--zero-before={region}"))
        .arg(format!("--dump-after={region}"))
        .arg(&program)
        .arg(COUNT)
        .arg(&folder)
        .output()?;
    let said = String::from_utf8_lossy(&output.stdout);
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        return Err(io::Error::other(format!(
            "{}\n{said}{errors}",
            output.status
        )));
    }
    let lines = said.lines().filter_map(|line| line.strip_prefix(COUNTED));
    let counts = lines.filter_map(|line| {
        let (name, count) = line.split_once(' ')?;
        Some((name.to_owned(), count.parse().ok()?))
    });
    Ok(counts.collect())
}
