//! Times, the catalogue that is chosen from, and memory.

use std::hint::black_box;
use std::path::PathBuf;
use std::process::{Command, ExitCode};
use std::time::Instant;

use jred_sizing::catalogue::Drive;
use jred_sizing::catalogue::{Catalogue, Sources};
use jred_sizing::cycle::Cycle;
use jred_sizing::form::Coefficients;
use jred_sizing::rules::RuleSet;
use jred_sizing::site::Site;
use jred_sizing::size::Selection;

use crate::{machine, synthetic};

/// Argument of the run that measures memory.
pub(crate) const MEMORY: &str = "--memory-of-a-million";

/// Each time is the best of so many runs.
const RUNS: u32 = 7;

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

/// What was found out of bounds.
#[derive(Default)]
pub(crate) struct Report {
    /// Whether figures are held against their ceilings, which are those of the synthetic catalogue.
    pub(crate) judges: bool,
    failures: u32,
}

impl Report {
    /// Prints a ratio and holds it against its ceiling in `benches/ceilings.txt`: not above it, nor below a quarter of it.
    pub(crate) fn ratio(&mut self, name: &str, found: f64, what: &str) {
        let ceiling = ceiling(name);
        // Times of memory as of arithmetic, on machines that other work keeps busy: they scatter by more than a factor of two.
        self.judge(name, found, what, [0.25 * ceiling, ceiling]);
    }

    /// The same for the growth of a time, which should be none: from 1 to its ceiling.
    pub(crate) fn growth(&mut self, name: &str, found: f64, what: &str) {
        self.judge(name, found, what, [1.0, ceiling(name)]);
    }

    fn judge(&mut self, name: &str, found: f64, what: &str, [low, high]: [f64; 2]) {
        let verdict = if !self.judges {
            "not judged"
        } else if found >= low && found <= high {
            "allowed"
        } else {
            self.failures += 1;
            "FAILED, allowed"
        };
        println!("{name}: {found:.2} {what}; {verdict} {low} to {high}");
    }

    pub(crate) fn code(&self) -> ExitCode {
        if self.failures == 0 {
            ExitCode::SUCCESS
        } else {
            println!("{} figures out of bounds", self.failures);
            ExitCode::FAILURE
        }
    }
}

/// The ceiling of a figure; NaN, which nothing keeps, where there is none.
fn ceiling(name: &str) -> f64 {
    let lines = include_str!("../../../benches/ceilings.txt").lines();
    let mut rows = lines.map(|line| line.split_whitespace().collect::<Vec<_>>());
    let found = rows.find_map(|words| match words[..] {
        ["host", this, ceiling] if this == name => ceiling.parse::<f64>().ok(),
        _ => None,
    });
    found.unwrap_or(f64::NAN)
}

/// The database of the variable `JRED_MGDB`, or a synthetic one of its size; and what it is.
pub(crate) fn catalogue() -> (Catalogue, String) {
    let Some(folder) = std::env::var_os("JRED_MGDB").map(PathBuf::from) else {
        return (
            synthetic::catalogue(),
            "synthetic catalogue (JRED_MGDB not set)".to_owned(),
        );
    };
    let sources = Sources {
        catalogues: vec![folder.clone()],
        ..Sources::default()
    };
    let load = || match Catalogue::open(&sources) {
        Ok(catalogue) => catalogue,
        Err(why) => panic!("JRED_MGDB: {why}"),
    };
    let time = best(load);
    println!("loading                    {:9.3} ms", 1e3 * time);
    (
        load(),
        format!("Motor-Gearbox Database in {}", folder.display()),
    )
}

/// So many drives, spread over the whole catalogue; where there are fewer, the catalogue begins anew.
pub(crate) fn drives(catalogue: &Catalogue, wanted: usize) -> Vec<(usize, Drive<'_>)> {
    let all: Vec<(usize, Drive)> = catalogue.drives().collect();
    let step = (all.len() / wanted).max(1);
    all.iter()
        .copied()
        .step_by(step)
        .cycle()
        .take(wanted)
        .collect()
}

/// Motor torque that is the torque at the gearbox output.
pub(crate) const fn unit_coefficients() -> Coefficients {
    Coefficients([0.0, 1.0, 1.0, 0.0, 0.0])
}

/// Runs this program once more to find out how much memory a million instants take.
pub(crate) fn measure_memory() {
    let run = std::env::current_exe().and_then(|own| Command::new(own).arg(MEMORY).output());
    match run {
        Ok(output) => print!("{}", String::from_utf8_lossy(&output.stdout)),
        Err(error) => println!("memory not measured: {error}"),
    }
}

/// Judges all drives against a million instants and prints the most memory that this took.
pub(crate) fn memory() -> ExitCode {
    let (catalogue, site, rules) = (synthetic::catalogue(), Site::default(), RuleSet::default());
    let motors = catalogue.prepare(&site);
    let before = resident();
    let duty = machine::duty(&machine::machine(), 1_000_000);
    let instants = duty.instants.len();
    let with_duty = resident();
    let cycle = Cycle::new(&duty);
    let with_cycle = resident();
    drop(duty);
    let selection = Selection::new(&catalogue, &motors, &cycle, &site, &rules);
    let drives = selection.fit.len() + selection.refused.len();
    println!(
        "\nmost memory (resident, MB): {before:.0} with the catalogue, {with_duty:.0} with {instants} instants, {with_cycle:.0} \
         with the cycle, {:.0} with {drives} drives judged",
        resident()
    );
    ExitCode::SUCCESS
}

/// Most memory that this program had resident so far (MB); NaN where the system does not say.
fn resident() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| {
        line.trim()
            .trim_end_matches("kB")
            .trim()
            .parse::<f64>()
            .ok()
    });
    kilobytes.unwrap_or(f64::NAN) / 1e3
}
