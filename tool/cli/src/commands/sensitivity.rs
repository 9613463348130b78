//! `jred sensitivity`.

use indicatif::ProgressBar;
use miette::Result;

use crate::busy;
use crate::commands::vary::study;
use crate::commands::{Completion, print_answer, warn_of_motion};
use crate::options::search::Sensitivity as Options;
use jred_report::list::sensitivity::sheet;
use jred_sizing::study::chosen::ChosenDrive;
use jred_sizing::study::sensitivity::{Reach, Sensitivity};

/// Runs `jred sensitivity`.
///
/// # Errors
/// Bad input.
pub fn sensitivity(options: &Options) -> Result<Completion> {
    let filter = options.search.filter();
    let sampling = options.supply.course.with(&options.accuracy);
    let study = study(&options.file, &options.supply, &filter, sampling)?;
    warn_of_motion(&study.nominal);
    options.search.check(&study.catalogue, &[])?;
    let one = ChosenDrive::choose(
        &study,
        options.drive.as_deref(),
        &filter,
        options.search.rank,
    )?;
    let reach = Reach {
        change: options.change / 100.0,
        most: options.most.max(options.change) / 100.0,
    };
    busy::rows(0, 0);
    let bar = ProgressBar::new(study.document.quantities().len() as u64);
    let sensitivity = Sensitivity::new(&study, &one, reach, || bar.inc(1))?;
    bar.finish_and_clear();
    let sheet = sheet(&study, &one, &sensitivity, reach);
    print_answer(&sheet.answer(), options.format)?;
    Ok(Completion::of(!sensitivity.is_broken()))
}
