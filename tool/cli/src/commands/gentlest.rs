//! `jred gentlest`: the gentlest motion.

use std::path::Path;

use miette::{Report, Result, miette};

use crate::commands::core_error::{core_report, duty_report};
use crate::commands::{
    Completion, documents, drive_asked, print_answer, read_warned, warn_of_supply,
};
use crate::commands::{plan, series};
use crate::options::gentlest::{EndAcceleration, Gentlest, RAMP};
use crate::output::{self, Files};
use jred_file::model::drive_train;
use jred_file::model::machine::MachineFile;
use jred_file::model::rules::RuleVerdict;
use jred_file::model::variator;
use jred_file::number::rounding::short;
use jred_file::read;
use jred_motion::contact::broken;
use jred_motion::fastest::ruled::Judge;
use jred_motion::gentlest::cycle::{self, Obstacle, Request};
use jred_motion::gentlest::{Fault, without_drive};
use jred_motion::moves::{Move, NoMoves};
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
        .map_err(|obstacle| report(&options.file, options.drive.as_deref(), &file, &obstacle))?;
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
    Ok(Completion::of(!exceeds))
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

/// Why there is no motion.
pub(super) fn report(
    path: &Path,
    motor: Option<&str>,
    file: &MachineFile,
    obstacle: &Obstacle,
) -> Report {
    let name = read::name(path);
    match obstacle {
        Obstacle::Duty(fault) => duty_report(fault.clone()),
        Obstacle::NoMoves(NoMoves::Still) => miette!(
            help = "give a motion with at least one move",
            "nothing moves in the motion of {name}"
        ),
        Obstacle::NoMoves(NoMoves::AllKept) => miette!(
            help = "give a motion with moves in addition to the constant speed",
            "{name} moves at constant speed only, which is kept: there is nothing to optimise"
        ),
        Obstacle::NoMoves(NoMoves::NotAtRest { speed, at_end }) => {
            let axis = file.axis();
            let unit = axis.coordinate.speed_unit();
            miette!(
                help = "a motion that is to be made anew begins and ends at rest; or it is cyclic and turns on with the speed that it \
                        begins with",
                "the motion of {name} {} at {} {unit}",
                if *at_end { "ends" } else { "begins" },
                short(axis.rate(speed.abs()))
            )
        }
        Obstacle::NoCopper => match motor {
            None => miette!(
                help = "name the drive: --drive MOTOR+GEARBOX",
                "the energy contains the copper loss of a motor, and no motor is given"
            ),
            Some(motor) => miette!(
                help = "fill in resistance and torque constant in the catalogue (docs/catalogue.md), or use --objective rms",
                "the copper loss of {motor:?} is not known: the catalogue does not state its resistance or its torque constant"
            ),
        },
        Obstacle::Move(number, step, fault) => of_move(*number, step, fault, file),
    }
}

fn of_move(number: usize, step: &Move, fault: &Fault, file: &MachineFile) -> Report {
    let axis = file.axis();
    let place = format!(
        "move {number} of the motion, from {} to {} in {} s",
        axis.place(step.from),
        axis.place(step.to),
        short(step.duration)
    );
    match fault {
        Fault::Machine(error) => core_report(*error),
        Fault::Figure(what, value) => miette!(
            help =
                "give a move with a distance and a duration that are not extremely small or large",
            "{place}: the {what} {value} cannot be used"
        ),
        Fault::NoInertia => miette!(
            help = "give the links a mass or an inertia",
            "{place}: nothing that moves has inertia"
        ),
        Fault::NotFound => miette!(
            help = "shorten it: in a long time the machine nearly stops somewhere, which the search does not find; write a pause between moves instead. Or try other --ends, or another --objective",
            "{place}: the search for the gentlest motion did not converge"
        ),
    }
}
