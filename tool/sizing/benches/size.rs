//! A whole catalogue against a cycle: instructions, memory, and time on one core and on all, beside plain loops over the samples
//! and beside NumPy.
//!
//! ```text
//! cargo bench -p jred-sizing --bench size
//! JRED_MGDB=FOLDER cargo bench -p jred-sizing --bench size     # the public Motor-Gearbox Database instead
//! ```
//!
//! Every drive is judged by both ways first: verdicts and figures must agree. Instructions, counted by Valgrind, drives judged in
//! full and memory are judged by `benches/ceilings.txt`, those of the synthetic catalogue; times depend on the machine and are
//! printed. docs/performance.md has the results.
#![allow(clippy::disallowed_methods, reason = "a benchmark shows its own paths")]

#[path = "../../../benches/support/bench.rs"]
mod bench;
#[path = "../tests/brute.rs"]
mod brute;
#[path = "../../../benches/support/ceilings.rs"]
mod ceilings;
#[path = "size/compare.rs"]
mod compare;
#[path = "size/drives.rs"]
mod drives;
#[path = "size/machine.rs"]
mod machine;
#[path = "../../../benches/support/memory.rs"]
mod memory;
#[path = "size/numpy.rs"]
mod numpy;
#[path = "size/synthetic.rs"]
mod synthetic;

use std::hint::black_box;
use std::process::ExitCode;

use bench::{Bench, best, once};
use jred_file::model::machine::MachineFile;
use jred_file::model::rules::RuleSet;
use jred_file::model::site::Site;
use jred_sizing::catalogue::{Catalogue, Drive, DriveId};
use jred_sizing::cycle::Cycle;
use jred_sizing::motor::envelope::MotorLimits;
use jred_sizing::select::size::Selection;
use memory::Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Instants of the cycle that the figures of the catalogue are for.
const INSTANTS: usize = 1000;

/// Argument for a run under a profiler, with the number of instants: the catalogue is judged and nothing else.
const PROFILE: &str = "--profile";

/// Data that a selection borrows.
pub(crate) struct Ready {
    catalogue: Catalogue,
    motors: Vec<MotorLimits>,
    cycle: Cycle,
    site: Site,
    rules: RuleSet,
}

impl Ready {
    fn one_core(&self) -> Selection<'_> {
        Selection::new(
            &self.catalogue,
            &self.motors,
            &self.cycle,
            &self.site,
            &self.rules,
        )
    }

    fn among<'c>(&'c self, drives: &[(DriveId, Drive<'c>)]) -> Selection<'c> {
        let drives = drives.iter().copied();
        Selection::among(
            drives,
            &self.catalogue,
            &self.motors,
            &self.cycle,
            &self.site,
            &self.rules,
        )
    }

    fn all_cores(&self) -> Selection<'_> {
        Selection::parallel(
            &self.catalogue,
            &self.motors,
            &self.cycle,
            &self.site,
            &self.rules,
        )
    }
}

/// Numbers of instants that the cost of a drive may not depend on, and of drives that it is proportional to.
const CYCLES: [usize; 4] = [1_000, 10_000, 100_000, 1_000_000];
const DRIVES: [usize; 4] = [10_000, 20_000, 50_000, 100_000];

/// Largest over smallest.
fn spread(figures: &[Option<f64>]) -> Option<f64> {
    let figures: Option<Vec<f64>> = figures.iter().copied().collect();
    let figures = figures?;
    let least = figures.iter().copied().fold(f64::INFINITY, f64::min);
    Some(figures.iter().copied().fold(0.0, f64::max) / least)
}

/// Every drive of the catalogue against a thousand instants, beside other ways.
fn whole_catalogue(bench: &mut Bench, ready: &Ready, count: u32) {
    let instructions = bench.count("size-catalogue", || drop(ready.one_core()));
    bench.control("size-catalogue", count, |drives| {
        let (whole, rest) = (drives / count, (drives % count) as usize);
        for _ in 0..whole {
            drop(ready.one_core());
        }
        let some: Vec<_> = ready.catalogue.drives().take(rest).collect();
        drop(ready.among(&some));
    });
    if bench.counts() {
        return;
    }
    compare::every_drive(ready);
    let selection = ready.one_core();
    println!(
        "{} fit, {} are refused",
        selection.fit.len(),
        selection.refused.len()
    );
    let in_full = selection.fit.known().len() + selection.refused.known().len();
    compare::selection(ready, selection);

    println!(
        "\n{count} drives against {} instants",
        ready.cycle.samples().len()
    );
    let plain = once(|| compare::plain(ready));
    let two = best(|| ready.all_cores());
    let full = best(|| {
        let mut selection = ready.one_core();
        selection.complete();
        selection
    });
    let each = |time: f64| {
        let drive = 1e9 * time / f64::from(count);
        format!("{:9.3} ms {drive:9.1} ns a drive", 1e3 * time)
    };
    println!(
        "all cores ({})              {}",
        rayon::current_num_threads(),
        each(two)
    );
    println!("with every drive's figures {}", each(full));
    println!("plain loops, one core      {}", each(plain));
    numpy::compare(ready);
    let line = |time: f64| format!("{}, instructions a drive", each(time * f64::from(count)));
    let time = || best(|| ready.one_core()) / f64::from(count);
    bench.cost_of("size-catalogue", count, instructions, time, line);
    bench.judge("size-in-full", in_full as u64, "drives judged in full");
    let memory = memory::of(|| ready.one_core());
    bench.judge("size-allocations", memory.allocations, "allocations");
    bench.judge(
        "size-memory",
        memory.most / u64::from(count),
        "bytes a drive, at most at once",
    );
}

/// Cycles of more and more instants: a pass over them, and all drives, which must not cost more.
fn more_instants(bench: &mut Bench, ready: &mut Ready, file: &MachineFile) {
    println!("\ninstants      pass over them     all drives, one core");
    let mut each = Vec::new();
    for wanted in CYCLES {
        let duty = machine::duty(file, wanted);
        let instants = duty.instants.len() as u32;
        let pass = bench.count(&format!("pass-{wanted}"), || drop(Cycle::new(&duty)));
        let most = memory::of(|| Cycle::new(&duty)).most / u64::from(instants);
        ready.cycle = Cycle::new(&duty);
        let count = bench.count(&format!("drives-at-{wanted}"), || drop(ready.one_core()));
        each.push(count.map(|count| count as f64));
        if bench.counts() {
            continue;
        }
        let [build, judge] = [best(|| Cycle::new(&duty)), best(|| ready.one_core())];
        println!(
            "{instants:8} {:15.3} ms {:21.3} ms",
            1e3 * build,
            1e3 * judge
        );
        if wanted == 1_000_000 {
            let time = || build / f64::from(instants);
            let line = |time: f64| format!("{:9.1} ns, instructions an instant", 1e9 * time);
            bench.cost_of("size-pass", instants, pass, time, line);
            bench.judge(
                "size-pass-memory",
                most,
                "bytes an instant, at most at once",
            );
        }
    }
    // A few loops over the instants for all drives together are left; the powers of the mean gear torque are libm's, which has the same bits on every
    // system and takes longer than that of the system.
    let what = "largest over smallest number of instructions of these";
    bench.band(what, [1.0, 3.5], spread(&each));
}

/// More and more drives: each costs the same.
fn more_drives(bench: &mut Bench, ready: &Ready) {
    println!("\ndrives       one core");
    let mut each = Vec::new();
    for wanted in DRIVES {
        let drives = drives::spread_over(&ready.catalogue, wanted);
        let count = bench.count(&format!("drives-{wanted}"), || drop(ready.among(&drives)));
        each.push(count.map(|count| count as f64 / wanted as f64));
        if bench.counts() {
            continue;
        }
        let time = best(|| black_box(ready.among(&drives)));
        let drive = 1e9 * time / wanted as f64;
        println!("{wanted:6} {:12.3} ms {drive:9.1} ns a drive", 1e3 * time);
    }
    let what = "largest over smallest number of instructions of a drive";
    bench.band(what, [1.0, 2.0], spread(&each));
}

/// The catalogue, the machine's cycle of this number of instants, and a description of the catalogue.
fn ready(instants: usize) -> (Ready, MachineFile, String) {
    let file = machine::machine();
    let (catalogue, name) = drives::catalogue();
    let site = Site::default();
    let ready = Ready {
        motors: catalogue.prepare(&site),
        cycle: Cycle::new(&machine::duty(&file, instants)),
        site,
        rules: file.rules.clone(),
        catalogue,
    };
    (ready, file, name)
}

#[expect(clippy::unnecessary_wraps, reason = "as every benchmark does")]
fn run(bench: &mut Bench) -> Result<(), String> {
    let (mut ready, file, name) = ready(INSTANTS);
    let Ready {
        catalogue, site, ..
    } = &ready;
    let count = catalogue.drives().count() as u32;
    println!(
        "{name}: {} motors, {} gearboxes, {count} drives",
        catalogue.motors.len(),
        catalogue.gearboxes.len()
    );
    if !bench.counts() {
        let preparation = best(|| catalogue.prepare(site));
        println!("envelopes of all motors    {:9.3} ms", 1e3 * preparation);
    }
    if !drives::are_synthetic() {
        bench.judge_nothing();
    }
    whole_catalogue(bench, &ready, count);
    more_instants(bench, &mut ready, &file);
    ready.cycle = Cycle::new(&machine::duty(&file, INSTANTS));
    more_drives(bench, &ready);
    Ok(())
}

/// Judges the catalogue and nothing else.
fn profile(instants: Option<usize>) {
    let (ready, ..) = ready(instants.unwrap_or(INSTANTS));
    let time = best(|| ready.one_core());
    println!("one core                   {:9.3} ms", 1e3 * time);
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip_while(|argument| argument != PROFILE);
    if arguments.next().is_some() {
        profile(arguments.next().and_then(|n| n.parse().ok()));
        return ExitCode::SUCCESS;
    }
    Bench::main(run)
}
