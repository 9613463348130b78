//! `jred drive`.

use miette::{Result, miette};

use crate::commands::core_error::duty_report;
use crate::commands::{Completion, documents, read_warned};
use crate::options::drive::Drive;
use crate::output;
use jred_analysis::duty::Duty;
use jred_file::model::variator;
use jred_report::list::drive::{self, DriveView};
use jred_report::list::listing;
use jred_report::page;
use jred_sizing::catalogue::MotorKind;
use jred_sizing::cycle::Cycle;
use jred_sizing::select::fit::{fit_input, input_kind};
use jred_sizing::select::size::Selection;
use jred_sizing::settings::{Choices, Settings};

/// Runs `jred drive`.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub(super) fn run(options: &Drive) -> Result<Completion> {
    let makers = drive::makers(options.maker.as_deref())?;
    let file = read_warned(&options.file)?;
    variator::refuse(&file, "drive")?;
    if input_kind(&file) == MotorKind::Linear {
        return Err(miette!(
            help = "add a [[drive_train]] with a rotating input, such as a screw or a belt",
            "the drive link slides: parameters are listed for rotary motors only"
        ));
    }
    output::check(options.documents.files())?;
    let motion = file.required_motion()?;
    let mut catalogue = options.catalogue.open()?;
    fit_input(&mut catalogue, &file)?;
    let duty = Duty::new(&file, motion, options.sampling.sampling()).map_err(duty_report)?;
    let cycle = Cycle::new(&duty);
    let motors = catalogue.prepare(&file.site);
    let selection = Selection::parallel(&catalogue, &motors, &cycle, &file.site, &file.rules);
    let candidate = listing::explained(&selection, options.drive.as_deref())?.ok_or_else(|| {
        miette!(
            help = "give a catalogue with at least one motor",
            "no drive can be built for this machine"
        )
    })?;
    let holds = selection.judged(&candidate).holds();
    let choices = Choices {
        counts_per_turn: options.counts_per_turn.map(f64::from),
        bandwidth: options.bandwidth,
    };
    let context = selection.context(&candidate);
    let settings = Settings::new(&context, &duty, &file, choices);
    let shown = DriveView {
        title: &file.title,
        drive: &candidate.drive.name(),
        holds,
        settings: &settings,
        amplifier: candidate
            .drive
            .amplifier
            .map(|a| [a.key.as_str(), a.maker.as_str()]),
        makers: &makers,
    };
    let page = || Ok(page::drive_page(&file, &shown));
    documents::finish(&options.documents, shown.answer(), page, options.format)?;
    Ok(Completion::of(holds))
}
