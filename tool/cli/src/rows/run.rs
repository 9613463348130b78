//! Runs a study: rows are computed in parallel and written in order, until all are done or the user interrupts.

use std::io::Write;
use std::path::PathBuf;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use indicatif::{ProgressBar, ProgressStyle};
use miette::{IntoDiagnostic as _, Result, WrapErr as _};
use rayon::prelude::*;

use super::store;
use crate::busy;
use crate::output;
use crate::terminal;
use jred_report::table::rows::RowFormat;
use jred_sizing::cell::Cell;
use jred_sizing::study::shard::Shard;
use jred_sizing::study::task::RowSource;

/// Output of a run, and its rows.
#[derive(Clone, Debug)]
pub struct Plan {
    /// File to write; `None`: standard output.
    pub out: Option<PathBuf>,
    /// Format of the rows.
    pub form: RowFormat,
    /// Whether the file is resumed.
    pub resume: bool,
    /// The share of the rows.
    pub shard: Option<Shard>,
}

/// End of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunEnd {
    /// Completed rows of this share.
    pub rows: u64,
    /// All rows of the share.
    pub of: u64,
}

impl RunEnd {
    /// Whether every row is complete.
    pub const fn is_complete(self) -> bool {
        self.rows == self.of
    }
}

/// Set by the first Ctrl-C (or SIGTERM): rows in progress are finished, no others are started.
static STOP: AtomicBool = AtomicBool::new(false);

/// Lets Ctrl-C end a run after the rows in progress; a second one ends it at once.
fn heed_signals() {
    static ONCE: Once = Once::new();
    static COUNT: AtomicU32 = AtomicU32::new(0);
    ONCE.call_once(|| {
        // Without a handler the signal ends the program; the file keeps the rows written so far.
        let _ = ctrlc::set_handler(|| {
            STOP.store(true, Ordering::Relaxed);
            if COUNT.fetch_add(1, Ordering::Relaxed) > 0 {
                std::process::exit(130);
            }
        });
    });
}

/// Rows that each thread computes between two writes.
const BLOCK: u64 = 16;

/// Runs a study. `seen` gets every row of the share in order, including rows of a resumed file.
///
/// # Errors
/// Files that cannot be written, or that belong to another study.
pub fn run(
    task: &impl RowSource,
    plan: &Plan,
    seen: &mut dyn FnMut(u64, &[Cell]),
) -> Result<RunEnd> {
    let program = terminal::stop_of_program();
    if program.is_none() {
        heed_signals();
    }
    let stop = program.as_deref().unwrap_or(&STOP);
    let mut header = task.header();
    header.shard = plan.shard;
    let shard = header.share();
    let of = shard.len(header.rows);
    let form = match plan.form {
        RowFormat::Table if plan.out.is_some() => RowFormat::Csv,
        form => form,
    };
    let study = store::study(&header)?;
    let front = form.front(&study, &header.columns);
    let mut done = 0;
    let mut sink: Option<Box<dyn Write>> = match &plan.out {
        Some(path) if plan.resume && path.is_file() => {
            let (file, rows) = store::resume(path, &header, form, seen)?;
            done = rows;
            Some(Box::new(file))
        }
        Some(path) => Some(Box::new(store::begin(path, &front)?)),
        None if form == RowFormat::Table => None,
        None => {
            let mut out = output::stdout()?;
            let _ = out.write_all(front.as_bytes());
            Some(Box::new(out))
        }
    };
    busy::rows(done, of);
    let bar = match program {
        Some(_) => ProgressBar::hidden(),
        None => bar(of, done),
    };
    let block = BLOCK * rayon::current_num_threads() as u64;
    while done < of && !stop.load(Ordering::Relaxed) {
        let rows: Vec<Option<Vec<Cell>>> = (done..of.min(done + block))
            .into_par_iter()
            .map(|k| {
                let row = (!stop.load(Ordering::Relaxed)).then(|| task.row(shard.row(k)));
                bar.inc(1);
                busy::row();
                row
            })
            .collect();
        let mut text = String::new();
        for cells in rows.into_iter().map_while(|row| row) {
            let index = shard.row(done);
            let study = (done == 0).then_some(study.as_str());
            text += &form.line(&header.columns, index, &cells, study);
            seen(index, &cells);
            done += 1;
        }
        if let Some(sink) = &mut sink {
            match sink.write_all(text.as_bytes()).and_then(|()| sink.flush()) {
                // The reader has closed the pipe (`jred vary … | head`).
                Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => break,
                written => written
                    .into_diagnostic()
                    .wrap_err("cannot write the rows")?,
            }
        }
    }
    bar.finish_and_clear();
    busy::end();
    Ok(RunEnd { rows: done, of })
}

/// A bar on standard error; hidden if that is not a terminal.
fn bar(of: u64, done: u64) -> ProgressBar {
    let style = "{bar:40} {pos}/{len}, {per_sec}, {eta} left";
    let bar = ProgressBar::new(of).with_style(
        ProgressStyle::with_template(style).unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    bar.set_position(done);
    bar.reset_eta();
    bar
}
