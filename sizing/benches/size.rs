//! A whole catalogue against a cycle: time on one core and on all, beside plain loops over the samples and beside NumPy.
//!
//! ```text
//! cargo bench -p jred-sizing --bench size
//! JRED_MGDB=FOLDER cargo bench -p jred-sizing --bench size     # the public Motor-Gearbox Database instead
//! ```
//!
//! Every drive is judged by both ways first: verdicts and figures must agree. Times depend on the machine, so they are judged
//! against the plain loops of the same run, by `benches/ceilings.txt`. docs/performance.md has the results.

#[path = "../tests/support/brute.rs"]
mod brute;
#[path = "size/compare.rs"]
mod compare;
#[path = "size/figures.rs"]
mod figures;
#[path = "size/machine.rs"]
mod machine;
#[path = "size/numpy.rs"]
mod numpy;
#[path = "size/synthetic.rs"]
mod synthetic;

use std::hint::black_box;
use std::process::ExitCode;

use figures::{Report, best, once};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::catalogue::Drive;
use jred_sizing::cycle::Cycle;
use jred_sizing::envelope::Prepared;
use jred_sizing::rules::RuleSet;
use jred_sizing::site::Site;
use jred_sizing::size::Selection;

/// Instants of the cycle that the figures of the catalogue are for.
const INSTANTS: usize = 1000;

/// Argument for a run under a profiler, with the number of instants: the catalogue is judged and nothing else.
const PROFILE: &str = "--profile";

/// What a selection borrows.
pub(crate) struct Ready {
    catalogue: Catalogue,
    motors: Vec<Prepared>,
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

    fn among<'c>(&'c self, drives: &[(usize, Drive<'c>)]) -> Selection<'c> {
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

#[expect(
    clippy::too_many_lines,
    reason = "one report, written from top to bottom"
)]
fn main() -> ExitCode {
    if std::env::args().any(|argument| argument == figures::MEMORY) {
        return figures::memory();
    }
    let mut report = Report::default();
    report.judges = std::env::var_os("JRED_MGDB").is_none();
    let file = machine::machine();
    let (catalogue, name) = figures::catalogue();
    let site = Site::default();
    let count = catalogue.drives().count();
    let preparation = best(|| catalogue.prepare(&site));
    let mut ready = Ready {
        motors: catalogue.prepare(&site),
        cycle: Cycle::new(&machine::duty(&file, INSTANTS)),
        site,
        rules: file.rules.clone(),
        catalogue,
    };
    println!(
        "{name}: {} motors, {} gearboxes, {count} drives",
        ready.catalogue.motors.len(),
        ready.catalogue.gearboxes.len()
    );
    println!("envelopes of all motors    {:9.3} ms", 1e3 * preparation);

    let mut arguments = std::env::args().skip_while(|argument| argument != PROFILE);
    if arguments.next().is_some() {
        let instants = arguments.next().and_then(|n| n.parse().ok());
        ready.cycle = Cycle::new(&machine::duty(&file, instants.unwrap_or(INSTANTS)));
        let time = best(|| ready.one_core());
        println!("one core                   {:9.3} ms", 1e3 * time);
        return ExitCode::SUCCESS;
    }
    compare::every_drive(&ready);
    let selection = ready.one_core();
    println!(
        "{} fit, {} are refused",
        selection.fit.len(),
        selection.refused.len(),
    );
    compare::selection(&ready, selection);

    println!(
        "\n{count} drives against {} instants",
        ready.cycle.samples().len()
    );
    let one = best(|| ready.one_core());
    let two = best(|| ready.all_cores());
    let full = best(|| {
        let mut selection = ready.one_core();
        selection.complete();
        selection
    });
    let plain = once(|| compare::plain(&ready));
    let each = |time: f64| {
        format!(
            "{:9.3} ms {:9.1} ns a drive",
            1e3 * time,
            1e9 * time / count as f64
        )
    };
    println!("one core                   {}", each(one));
    println!(
        "all cores ({})              {}",
        rayon::current_num_threads(),
        each(two)
    );
    println!("with every drive's figures {}", each(full));
    println!("plain loops, one core      {}", each(plain));
    numpy::compare(&ready);
    report.ratio(
        "size-catalogue",
        1e3 * one / plain,
        "thousandths of the plain loops",
    );

    println!("\ninstants      pass over them     all drives, one core");
    let mut flat = [f64::INFINITY, 0.0f64];
    for instants in [1_000, 10_000, 100_000, 1_000_000] {
        let duty = machine::duty(&file, instants);
        let pass = best(|| Cycle::new(&duty));
        ready.cycle = Cycle::new(&duty);
        let time = best(|| ready.one_core());
        flat = [flat[0].min(time), flat[1].max(time)];
        println!(
            "{:8} {:15.3} ms {:21.3} ms",
            duty.instants.len(),
            1e3 * pass,
            1e3 * time
        );
        if instants == 1_000_000 {
            // A pass is linear in the instants: in times of reading them once.
            let sweep = best(|| brute::rms_torque(&ready.cycle, &figures::unit_coefficients()));
            report.ratio(
                "size-pass",
                pass / sweep,
                "times one plain loop for the RMS",
            );
        }
    }
    report.growth(
        "size-flat",
        flat[1] / flat[0],
        "largest over smallest time of these",
    );

    println!("\ndrives       one core");
    ready.cycle = Cycle::new(&machine::duty(&file, INSTANTS));
    let mut per_drive = [f64::INFINITY, 0.0f64];
    for wanted in [10_000, 20_000, 50_000, 100_000] {
        let drives = figures::drives(&ready.catalogue, wanted);
        let time = best(|| black_box(ready.among(&drives)));
        let each = time / wanted as f64;
        per_drive = [per_drive[0].min(each), per_drive[1].max(each)];
        println!(
            "{wanted:6} {:12.3} ms {:9.1} ns a drive",
            1e3 * time,
            1e9 * each
        );
    }
    report.growth(
        "size-linear",
        per_drive[1] / per_drive[0],
        "largest over smallest time of a drive",
    );
    figures::measure_memory();
    report.code()
}
