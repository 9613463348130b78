//! `jred ratio`.

use miette::{Result, miette};

use crate::commands::core_error::duty_report;
use crate::commands::vary::catalogue;
use crate::commands::{Completion, print_answer, read_warned};
use crate::options::search::Ratio;
use jred_analysis::duty::Duty;
use jred_file::read;
use jred_report::list::ratio::sheet;
use jred_sizing::catalogue::MotorKind;
use jred_sizing::cycle::Cycle;
use jred_sizing::select::filter::Filter;
use jred_sizing::select::ratio::Gear;
use jred_sizing::study::common::sizeable;
use jred_sizing::study::ratio::Ratios;

/// Runs `jred ratio`.
///
/// # Errors
/// Bad input.
pub fn ratio(options: &Ratio) -> Result<Completion> {
    let mut file = read_warned(&options.file)?;
    if let Some(set) = options.supply.rule_set()? {
        file.rules = read::rules_based_on(&file.rules, set)?;
    }
    sizeable(&file)?;
    let motion = file.required_motion()?;
    let named = Filter {
        motors: options.motor.clone(),
        ..Filter::default()
    };
    let mut catalogue = catalogue(&options.supply, &named)?;
    if jred_sizing::select::fit::input_kind(&file) == MotorKind::Linear {
        return Err(miette!(
            help =
                "use `jred size` for linear motors, or add a [[drive_train]] with a rotating input",
            "the drive link slides: there is no ratio to choose for a linear motor"
        ));
    }
    jred_sizing::select::fit::fit_input(&mut catalogue, &file)?;
    let duty = Duty::new(&file, motion, options.supply.course.with(&options.accuracy))
        .map_err(duty_report)?;
    let gear = Gear {
        inertia: options.gearbox_inertia.unwrap_or(0.0),
        efficiency: options.efficiency,
    };
    let study = Ratios {
        file: &file,
        duty: &duty,
        cycle: &Cycle::new(&duty),
        catalogue: &catalogue,
        motors: &catalogue.prepare(&file.site),
        gear,
    };
    let rows = study.rows();
    let any = rows.iter().any(|row| row.found.is_ok());
    let top = options.top.map(|top| top as usize);
    print_answer(&sheet(&study, rows, top).answer(), options.format)?;
    Ok(Completion::of(any))
}
