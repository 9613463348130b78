//! `jred vary`.

use std::path::Path;

use miette::{Result, miette};

use crate::commands::{Completion, print, warn_of_motion};
use crate::options::search::{RowOptions, SizingOptions, Vary};
use crate::output;
use crate::rows::run::{Plan, RunEnd, run};
use crate::terminal;
use jred_analysis::duty::Sampling;
use jred_file::number::words::{Word as _, counted};
use jred_file::plain;
use jred_file::text::problem::Problem;
use jred_report::table::rows::{RowFormat, table};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::cell::Cell;
use jred_sizing::select::filter::Filter;
use jred_sizing::study::axis::{Grid, Variation};
use jred_sizing::study::common::Study;
use jred_sizing::study::grid::{GridStudy, GridVerdict};
use jred_sizing::study::task::RowSource as _;

/// Largest number of drives judged at once: their results take 170 MB.
const MOST_DRIVES: usize = 2_000_000;

/// The catalogue of the options, filtered.
///
/// # Errors
/// Unusable files; an empty catalogue.
pub fn catalogue(supply: &SizingOptions, filter: &Filter) -> Result<Catalogue> {
    let mut catalogue = supply.catalogue.open()?;
    filter.thin(&mut catalogue)?;
    let drives = catalogue.count();
    if drives > MOST_DRIVES {
        return Err(miette!(
            help = "take a smaller catalogue, or only a part of it: --motor, --gearbox, --maker",
            "{drives} drives are too many: one command judges at most {MOST_DRIVES}"
        ));
    }
    Ok(catalogue)
}

/// The study of a machine file over the filtered catalogue.
///
/// # Errors
/// Unusable files; a machine that cannot be sized; an empty catalogue.
pub fn study(
    file: &Path,
    supply: &SizingOptions,
    filter: &Filter,
    sampling: impl Into<Sampling>,
) -> Result<Study> {
    let catalogue = catalogue(supply, filter)?;
    Ok(Study::open(file, catalogue, supply.rule_set()?, sampling)?)
}

impl RowOptions {
    /// The plan of these options.
    pub fn plan(&self) -> Plan {
        Plan {
            out: self.out.clone(),
            form: self.format,
            resume: self.resume,
            shard: self.shard.filter(|shard| shard.count > 1),
        }
    }
}

/// Runs `jred vary`.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub fn vary(options: &Vary) -> Result<Completion> {
    let filter = options.search.filter();
    let study = study(
        &options.file,
        &options.supply,
        &filter,
        options.supply.course.with(&options.accuracy),
    )?;
    warn_of_motion(&study.nominal);
    output::check([("--out", &options.rows.out)])?;
    options.search.check(&study.catalogue, &[])?;
    let axes = options
        .vary
        .iter()
        .map(|text| Variation::parse(&study.document, text));
    let grid = Grid::new(axes.collect::<Result<_, Problem>>()?)?;
    let task = GridStudy {
        study: &study,
        grid,
        filter,
        rank: options.search.rank,
    };
    let plan = options.rows.plan();
    let columns = task.header().columns;
    let verdict = task.grid.axes.len();
    let (mut shown, mut counts) = (Vec::new(), Counts::default());
    let ended = run(&task, &plan, &mut |index, cells| {
        counts.add(cells.get(verdict));
        if plan.out.is_none() && plan.form == RowFormat::Table {
            shown.push((index, cells.to_vec()));
        }
    })?;
    if plan.out.is_none() && plan.form == RowFormat::Table {
        let title = format!("{}: {}", study.nominal.title, counts.words());
        print(&format!("{title}\n{}", table(&columns, &shown)))?;
    } else if let Some(path) = &plan.out {
        print(&format!(
            "{}; rows written to {}\n",
            counts.words(),
            plain::path(path)
        ))?;
    }
    let done = stopped(ended, &plan);
    // One share is not the full result, and a scheduler would repeat a job that ends with 1.
    Ok(
        if done == Completion::Holds && counts.fit == 0 && plan.shard.is_none() {
            Completion::Violated
        } else {
            done
        },
    )
}

/// Counts of the results of a study.
#[derive(Default)]
struct Counts {
    fit: u64,
    none: u64,
    refused: u64,
}

impl Counts {
    fn add(&mut self, verdict: Option<&Cell>) {
        match verdict.and_then(Cell::text).and_then(GridVerdict::of_word) {
            Some(GridVerdict::Fits) => self.fit += 1,
            Some(GridVerdict::NoneFits) => self.none += 1,
            Some(GridVerdict::Refused) | None => self.refused += 1,
        }
    }

    fn words(&self) -> String {
        let all = self.fit + self.none + self.refused;
        let refused = match self.refused {
            0 => String::new(),
            n => format!(", {n} cannot be built as described"),
        };
        let have = if self.fit == 1 { "has" } else { "have" };
        let machines = counted(all as usize, "machine", "machines");
        format!("{} of {machines} {have} a drive{refused}", self.fit)
    }
}

/// Exit status of a finished run.
pub fn stopped(ended: RunEnd, plan: &Plan) -> Completion {
    if ended.is_complete() {
        return Completion::Holds;
    }
    let cure = match &plan.out {
        Some(path) => format!(
            "run the same command with --resume to continue {}",
            plain::path(path)
        ),
        None => "use --out FILE to make a run resumable".to_owned(),
    };
    terminal::say(&format!(
        "stopped after {} of {} rows; {cure}",
        ended.rows, ended.of
    ));
    Completion::Stopped
}
