//! `jred require`.

use std::path::Path;

use miette::{Result, miette};

use crate::commands::core_error::duty_report;
use crate::commands::{Completion, documents, read_warned};
use crate::options::require::Require;
use crate::output;
use crate::terminal;
use jred_analysis::duty::Duty;
use jred_file::model::variator;
use jred_file::read;
use jred_file::units::RPM;
use jred_report::list::require::RequirementView;
use jred_report::page;
use jred_sizing::catalogue::MotorKind;
use jred_sizing::cycle::Cycle;
use jred_sizing::select::fit::input_kind;
use jred_sizing::select::ratio::Gear;
use jred_sizing::select::requirement::{Inquiry, Requirement, USUAL_SPEED};

/// Runs `jred require`.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub(super) fn run(options: &Require) -> Result<Completion> {
    let mut file = read_warned(&options.file)?;
    if let Some(set) = &options.rules {
        file.rules = read::rules_based_on(&file.rules, read::rule_set(set, Path::new(""))?)?;
    }
    variator::refuse(&file, "require")?;
    output::check(options.documents.files())?;
    let motion = file.required_motion()?;
    let duty =
        Duty::new(&file, motion, options.course.with(&options.accuracy)).map_err(duty_report)?;
    let inquiry = Inquiry {
        file: &file,
        cycle: &Cycle::new(&duty),
        gear: Gear {
            inertia: options.gearbox_inertia.unwrap_or(0.0),
            efficiency: options.efficiency,
        },
        allowance: options.allowance,
    };
    if inquiry.derating() <= 0.0 {
        return Err(miette!(
            help = "correct [surroundings]",
            "no motor has any S1 torque left in the surroundings of this machine"
        ));
    }
    let ratios = ratios(options, &inquiry)?;
    let requirements: Vec<Requirement> = ratios
        .into_iter()
        .map(|ratio| inquiry.requirement(ratio))
        .collect();
    let shown = RequirementView {
        inquiry: &inquiry,
        requirements: &requirements,
    };
    let page = || Ok(page::require_page(&shown));
    documents::finish(&options.documents, shown.answer(), page, options.format)?;
    Ok(Completion::of(
        requirements.iter().any(|found| found.possible),
    ))
}

/// The ratios that are asked for.
fn ratios(options: &Require, inquiry: &Inquiry) -> Result<Vec<Option<f64>>> {
    if let Some(list) = &options.ratios {
        if let Some(text) = &list.doubtful {
            terminal::warn(&format!(
                "--ratios {text} names two ratios; write {} if it is one",
                text.replace(',', ".")
            ));
        }
        let gears = list.ratios.iter().any(Option::is_some);
        if gears && input_kind(inquiry.file) == MotorKind::Linear {
            return Err(miette!(
                help = "leave out --ratios, or add a [[drive_train]] with a rotating input",
                "the drive link slides: a linear motor has no gear ratio"
            ));
        }
        return Ok(list.ratios.clone());
    }
    let most = options.max_speed.unwrap_or(USUAL_SPEED);
    let ratios = inquiry.usual_ratios(most, options.within);
    if ratios.is_empty() {
        let [from, to] = options.within.unwrap_or([1.0, 100.0]);
        return Err(miette!(
            help = "raise --max-speed, widen --within, or name the ratios with --ratios",
            "no usual ratio from {from} to {to} keeps the motor below {:.0} rpm: the input turns at up to {:.1} rpm",
            most / RPM,
            inquiry.cycle.peak_speed() / RPM
        ));
    }
    Ok(ratios)
}
