//! `jred gentlest`: the gentlest motion.

use miette::{Result, miette};

use crate::commands::core_error::{core_report, duty_report};
use crate::commands::{
    Completion, documents, drive_asked, print_answer, read_warned, warn_of_supply,
};
use crate::commands::{plan, series};
use crate::options::gentlest::{EndAcceleration, Gentlest, RAMP};
use crate::output::{self, Files};
use jred_file::model::drive_train;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::variator;
use jred_motion::contact::broken;
use jred_motion::fastest::ruled::Judge;
use jred_motion::gentlest::cycle::{self, Request};
use jred_motion::gentlest::without_drive;
use jred_motion::path_dynamics::Actuator;
use jred_report::list;
use jred_report::page;
use jred_sizing::motor::envelope::Envelope;
use jred_sizing::study::chosen::ChosenDrive;

/// Runs the command.
///
/// # Errors
/// Bad input, or no motion of moves and pauses.
pub fn gentlest(options: &Gentlest) -> Result<Completion> {
    let file = read_warned(&options.file)?;
    variator::refuse(&file, "gentlest")?;
    drive_train::refuse(&file, "gentlest")?;
    file.refuse_timed("gentlest")?;
    file.refuse_joint_friction("gentlest")?;
    let motion = file.required_motion()?;
    let chosen = drive_asked(options.drive.as_deref(), &options.catalogue, &file)?;
    let motions = [
        ("--profile", &options.series.profile),
        ("--cam", &options.series.cam),
        ("--plan", &options.plan.plan),
    ];
    output::check(motions.into_iter().chain(options.documents.files()))?;
    let drive = chosen.as_ref().map(ChosenDrive::drive);
    if let Some(drive) = &drive {
        warn_of_supply(drive, &file);
    }
    let actuator = drive.map_or_else(without_drive, |drive| {
        let envelope = Envelope::at(drive.motor, drive.amplifier, &file.site);
        Actuator::new(&drive, envelope)
    });
    let request = Request {
        actuator,
        copper: drive.as_ref().and_then(cycle::copper),
        goal: options.objective,
        ramp: ramp(options)?,
        sampling: options.sampling.sampling(),
    };
    let gentlest = cycle::gentlest_cycle(&file, motion, &request)
        .map_err(|obstacle| list::gentlest::problem(&obstacle, &file, options.drive.as_deref()))?;
    let trace = gentlest.trace.of_axis(&file.axis());
    let mut files = Files::default();
    let mut written = series::write(&options.series, &file, &trace, &mut files)?;
    let gearbox = drive.and_then(|drive| drive.gearbox?.peak_torque);
    written.extend(plan::write(
        &options.plan,
        &plan::PlannedMotion {
            file: &file,
            trace: &gentlest.trace,
            actuator: &request.actuator,
            gearbox,
        },
        &mut files,
    )?);
    let checks = match &chosen {
        None => Vec::new(),
        Some(chosen) => Judge::new(&file, chosen.drive(), request.sampling)
            .with_resistors(chosen.resistors())
            .checks(&gentlest.trace)
            .map_err(duty_report)?,
    };
    let broken = broken(&file, &gentlest.trace).map_err(core_report)?;
    let shown = list::gentlest::GentlestView {
        file: &file,
        drive: drive.map(|drive| drive.name()),
        request: &request,
        gentlest: &gentlest,
        broken: broken.as_ref(),
        checks: &checks,
    };
    let mut answer = list::gentlest::answer(&shown);
    let page = || page::gentlest_page(&shown, motion).map_err(core_report);
    let workbook = || Ok(answer.clone());
    let (documents, printed) = documents::write(&options.documents, files, page, workbook)?;
    written.extend(documents);
    for line in written {
        answer.sentence(line);
    }
    print_answer(&answer, options.format)?;
    printed?;
    let mut violated = checks
        .iter()
        .filter(|check| check.verdict == RuleVerdict::Fail && check.id.follows_motion());
    let exceeds = violated.next().is_some() || broken.is_some();
    Ok(if exceeds {
        Completion::Violated
    } else {
        Completion::Holds
    })
}

/// The share of a move's time in which the acceleration rises.
fn ramp(options: &Gentlest) -> Result<f64> {
    match (options.ends, options.ramp) {
        (EndAcceleration::Zero, given) => Ok(given.unwrap_or(RAMP)),
        (EndAcceleration::Free, None) => Ok(0.0),
        (EndAcceleration::Free, Some(_)) => Err(miette!(
            help = "give --ends zero as well, or leave --ramp out",
            "--ramp is the time in which the acceleration rises from zero; with --ends free it begins with a jump"
        )),
    }
}
