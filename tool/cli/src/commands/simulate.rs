//! `jred simulate`: the motion under a motor.

use miette::{Report, Result, miette};

use crate::commands::core_error::core_report;
use crate::commands::{Done, drive_named, envelope, print_parts};
use crate::options;
use crate::output;
use jred_machine::analysis::reduce::add_columns;
use jred_machine::analysis::simulate::{self, Simulated};
use jred_machine::model::machine::MachineFile;
use jred_machine::model::simulation::Simulation;
use jred_machine::model::variator;
use jred_machine::plain;
use jred_machine::read;
use jred_motion::driven::{Loads, Unfit, driven};
use jred_report::list;
use jred_report::page;

/// Runs the command.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub(super) fn run(options: &options::Simulate) -> Result<Done> {
    let file = read::read(&options.file)?;
    output::check([("--plot", &options.plot)])?;
    let simulation = file.simulation.as_ref().ok_or_else(|| {
        miette!(
            help = "add a [simulation] with start_angle, duration, output_step and torque; docs/machine-file.md shows how",
            "{} has no [simulation]",
            plain::path(&options.file)
        )
    })?;
    let (mut found, drive) = match &options.drive {
        None => (simulate::simulate(&file, simulation)?, None),
        Some(name) => {
            let (found, drive) = with_drive(options, name, &file, simulation)?;
            (found, Some(drive))
        }
    };
    let asked = [options.points, options.reactions];
    if asked.contains(&true) {
        found.columns =
            add_columns(&file, &found.columns, &found.states, asked).map_err(core_report)?;
    }
    if let Some(path) = &options.plot {
        let columns = found.columns_of_drive(file.machine.mechanism().coordinate());
        let page = page::simulation_page(&file, simulation, &columns);
        output::write(path, page.as_bytes())?;
    }
    let shown = list::simulation::Shown {
        file: &file,
        simulation,
        found: &found,
        drive: drive.as_ref().map(|(name, loads)| (name.as_str(), loads)),
    };
    let done = print_parts(shown.write(options.format))?;
    // The rows up to there are written before the reason is.
    found.ended.map_or(Ok(done), |error| Err(error.into()))
}

/// The motion under a drive of the catalogue, the name of that and what it bears.
fn with_drive(
    options: &options::Simulate,
    name: &str,
    file: &MachineFile,
    simulation: &Simulation,
) -> Result<(Simulated, (String, Loads))> {
    variator::refuse(file, "simulate --drive")?;
    let chosen = drive_named(options.catalogue.open()?, name, file)?;
    let drive = chosen.drive();
    envelope(&drive, file);
    let found = driven(file, simulation, drive).map_err(|unfit| refusal(&unfit, &drive.name()))?;
    let found = found?;
    Ok((found.simulated, (drive.name(), found.loads)))
}

/// Why a drive cannot be simulated.
fn refusal(unfit: &Unfit, name: &str) -> Report {
    match unfit {
        Unfit::NoPeak => miette!(
            help = "fill in peak_torque or peak_curve in the catalogue; docs/catalogue.md describes them",
            "the drive {name} cannot be simulated: its peak torque is not known"
        ),
        Unfit::SelfLocking { gearbox } => miette!(
            help = "take a gearbox through which the machine can drive the motor",
            "the drive {name} cannot be simulated: the gearbox {gearbox} locks itself, and the equation of motion has no single solution when it does"
        ),
    }
}
