//! `jred tolerance`.

use jred_file::plain;
use miette::{Result, miette};

use crate::commands::vary::{stopped, study};
use crate::commands::{Completion, print_answer, warn_of_motion};
use crate::options::search::Tolerance as Options;
use crate::output;
use crate::rows::run::run;
use jred_file::model::tolerance::Tolerance;
use jred_report::list::tolerance::sheet;
use jred_report::table::output::Format;
use jred_report::table::rows::RowFormat;
use jred_sizing::study::chosen::ChosenDrive;
use jred_sizing::study::tolerance::summary::Summary;
use jred_sizing::study::tolerance::{Samples, Scatter};

/// Runs `jred tolerance`.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub fn tolerance(options: &Options) -> Result<Completion> {
    let filter = options.search.filter();
    let sampling = options.supply.course.sampling();
    let study = study(&options.file, &options.supply, &filter, sampling)?;
    warn_of_motion(&study.nominal);
    output::check([("--out", &options.rows.out)])?;
    options.search.check(&study.catalogue, &[])?;
    let given = options.tolerance.iter().map(|text| given(text));
    let scatters = Scatter::all(&study, &given.collect::<Result<Vec<_>>>()?)?;
    let one = ChosenDrive::choose(
        &study,
        options.drive.as_deref(),
        &filter,
        options.search.rank,
    )?;
    let machine = study.machine(&[])?;
    let samples = Samples::new(
        &study,
        &one,
        &machine,
        scatters,
        options.samples,
        options.seed,
    );
    let mut plan = options.rows.plan();
    // Without a file only the summary is printed.
    let format = match plan.form {
        RowFormat::Table => Format::Table,
        RowFormat::Csv => Format::Csv,
        RowFormat::Json => Format::Json,
    };
    if plan.out.is_none() {
        plan.form = RowFormat::Table;
    }
    let mut summary = Summary::new(samples.scatters.len(), samples.rules.len());
    let ended = run(&samples, &plan, &mut |_, cells| summary.add(cells))?;
    let mut sheet = sheet(&samples, &summary, &machine.file.rules);
    if plan.shard.is_some() {
        sheet.notes.push(
            "this is one share of the rows: the shares above are those of its machines".to_owned(),
        );
    }
    let format = if plan.out.is_some() {
        Format::Table
    } else {
        format
    };
    print_answer(&sheet.answer(), format)?;
    if !ended.is_complete() {
        return Ok(stopped(ended, &plan));
    }
    Ok(Completion::of(summary.hold == summary.machines))
}

/// A tolerance of the command line.
fn given(text: &str) -> Result<Tolerance> {
    let parsed = match text.split_once('=') {
        Some((path, amount)) => Tolerance::parse(path.trim(), amount),
        None => Err("it has no \"=\"".to_owned()),
    };
    parsed.map_err(|why| {
        miette!(
            help = "write PATH=5%, PATH=0.1mm or PATH=normal:2%",
            "--tolerance {} cannot be used: {why}",
            plain::quoted(text)
        )
    })
}
