//! What work costs on the host: instructions, which are judged, and times, which are printed for people.
//!
//! A benchmark starts itself once more under `valgrind --tool=callgrind`, which counts the instructions of each call of
//! [`region`]; that run says what it counted, and the run that people see prints its times beside these counts. The processor
//! that Valgrind imitates is the same wherever there is AVX2, so counts are too, but for what compilers and C libraries differ
//! in. On other processors, and without Valgrind, nothing is judged: a line that begins with `SKIP` says so.
#![allow(dead_code, reason = "every benchmark uses its own part")]

use std::collections::HashMap;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;
use std::{env, fs, io};

use crate::ceilings::{Verdict, judge};

/// Each time is the best of so many runs.
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

/// Argument of the run that counts, and the folder that Valgrind writes into.
const COUNT: &str = "--count-into";
/// Valgrind's file in it; a number follows for each call of [`region`].
const FILE: &str = "callgrind.out";

/// What Valgrind counts: it sets its count to zero where this is entered and writes it where this is left.
#[inline(never)]
fn region(work: &mut dyn FnMut()) {
    work();
    // Without this the call above would be a jump, and nobody would see this function left.
    black_box(());
}

/// Where instructions are known from.
enum Counts {
    /// This run counts, into this folder.
    Here(PathBuf),
    /// Another run has counted.
    Known(HashMap<String, u64>),
    /// Nothing could be counted.
    None,
}

/// A run of a benchmark: measures, prints, and remembers what was out of bounds.
pub(crate) struct Bench {
    counts: Counts,
    judges: bool,
    failures: u32,
}

impl Bench {
    /// Runs a benchmark, and its counting twin before it.
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

    /// Whether this is the run that counts instructions: it needs no times, and nobody reads what it prints.
    pub(crate) const fn counts(&self) -> bool {
        matches!(self.counts, Counts::Here(_))
    }

    /// Instructions of one run of the work, as far as they can be counted. Names are those of `ceilings.txt` or any other.
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

    /// From here on figures are printed and not judged: they are of other data than the ceilings.
    pub(crate) const fn judge_nothing(&mut self) {
        self.judges = false;
    }

    /// Prints a line whose figure has a ceiling in `ceilings.txt`.
    pub(crate) fn judge(&mut self, name: &str, figure: u64, line: &str) {
        self.judged(name, Some(figure), line);
    }

    /// Prints a line with the instructions of a unit of work, of which one run has `units`, and judges them; beside them the
    /// `line` that is made of the time of a unit (s).
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

    /// The same for work whose instructions are counted already, or cannot be, and whose `time` is measured otherwise.
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

    /// Judges a ratio that must lie in `[low, high]`; without it, there is nothing to judge.
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

    /// Shows that a figure which is too large, and one far too small, would fail: of `name`, whose `units` of work one run has,
    /// the work done twice and a third of it must be out of bounds.
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

/// How lines of the counting run begin that give a count.
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
    // What an earlier run has left.
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
