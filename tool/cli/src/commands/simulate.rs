//! `jred simulate`: the motion under a motor.

use std::path::PathBuf;

use miette::{Report, Result, miette};

use crate::commands::core_error::core_report;
use crate::commands::{
    Completion, documents, drive_asked, envelope, print_answer, rate, warn_of_motion,
};
use crate::options::simulate::Simulate;
use crate::output::{self, Files};
use jred_analysis::checked;
use jred_analysis::reduce::{Sets, add_columns};
use jred_analysis::simulate::{
    CoupledMachines, SimulationResult, beside_name, simulate_together, stops,
};
use jred_file::argument::Argument;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::simulation::Simulation;
use jred_file::model::variator;
use jred_file::number::words::counted;
use jred_file::plain;
use jred_file::text::key::SPEED;
use jred_motion::drive_simulation::{DriveSimulation, UnfitDrive, driven};
use jred_report::list;
use jred_report::page;
use jred_sizing::study::chosen::ChosenDrive;

/// Runs the command.
///
/// # Errors
/// Bad input, or a file that cannot be written.
pub(super) fn run(options: &Simulate) -> Result<Completion> {
    let Some((path, others)) = options.files.split_first() else {
        return Err(miette!("no machine file is given"));
    };
    let file = checked::read_over_turns(path)?;
    let others = read_all(others)?;
    let chosen = drive_asked(options.drive.as_deref(), &options.catalogue, &file)?;
    output::check(options.documents.files())?;
    let own = file.simulation.as_ref().ok_or_else(|| {
        let torque = if options.drive.is_some() {
            " and output_step (--drive gives the torque)"
        } else {
            ", output_step and torque"
        };
        let start = if file.axis().coordinate == Coordinate::Angle {
            "start_angle"
        } else {
            "start_position"
        };
        miette!(
            help = format!(
                "add a [simulation] with {start}, duration{torque}; docs/machine-file.md shows how"
            ),
            "{} has no [simulation]",
            plain::path(path)
        )
    })?;
    let to_speed = rate(
        "to-speed",
        options.to_speed.as_deref(),
        Argument::any(SPEED),
        &file.axis(),
    )?;
    let simulation = &Simulation {
        to_speed: to_speed.map(f64::abs),
        ..own.clone()
    };
    warn_of_motion(&file);
    let starts = starts(&others, &options.phase)?;
    let machines = CoupledMachines::alone(&file)
        .with(others.iter().zip(starts), simulation)
        .map_err(|why| list::simulation::problem(&why))?;
    let drive = chosen.as_ref().map(ChosenDrive::drive);
    if let Some(drive) = &drive {
        variator::refuse(&file, "simulate --drive")?;
        envelope(drive, &file);
    }
    let run = |simulation: &Simulation| match drive {
        None => Ok((simulate_together(&machines, simulation)?, None)),
        Some(drive) => {
            let DriveSimulation { simulated, loads } = driven(&machines, simulation, drive)?;
            Ok((simulated, Some((drive.name(), loads))))
        }
    };
    let refused = |unfit| refusal(&unfit, drive.map(|drive| drive.name()).as_deref());
    let (mut found, driven) = run(simulation).map_err(refused)?;
    let stops = options
        .stops
        .map(|count| stops(&file, simulation, count, |shifted| Ok(run(shifted)?.0)))
        .transpose()
        .map_err(refused)?;
    let asked = Sets {
        torques: options.torques,
        points: options.points,
        reactions: options.reactions,
        ..Sets::default()
    };
    widen(&mut found, &machines, asked)?;
    let shown = list::simulation::SimulationView {
        machines: &machines,
        simulation,
        found: &found,
        stops: stops.as_deref(),
        drive: driven.as_ref().map(|(name, loads)| (name.as_str(), loads)),
    };
    let page = || Ok(page::simulation_page(&shown));
    let workbook = || Ok(shown.answer());
    let (_, printed) = documents::write(&options.documents, Files::default(), page, workbook)?;
    let done = print_answer(&shown.answer(), options.format)?;
    printed?;
    // The rows up to that point are written before the reason.
    match &found.ended {
        None => Ok(done),
        Some(why) => Err(list::simulation::problem(why).into()),
    }
}

/// Reads the further machines.
pub(super) fn read_all(paths: &[PathBuf]) -> Result<Vec<MachineFile>> {
    let files = paths.iter();
    files
        .map(|path| Ok(checked::read_over_turns(path)?))
        .collect()
}

/// Starting positions of the further machines' drive links.
pub(super) fn starts(others: &[MachineFile], phases: &[f64]) -> Result<Vec<f64>> {
    if !phases.is_empty() && phases.len() != others.len() {
        return Err(miette!(
            help = "give --phase once for each machine file after the first, in their order, \"0 deg\" if it has none",
            "{} and {} were given",
            counted(phases.len(), "--phase", "--phase"),
            counted(others.len(), "further machine", "further machines")
        ));
    }
    let start = |file: &MachineFile| match (&file.simulation, &file.motion) {
        (Some(simulation), _) => simulation.start_angle,
        (None, Some(motion)) => motion.at(0.0).phi,
        (None, None) => 0.0,
    };
    let phases = phases.iter().copied().chain(std::iter::repeat(0.0));
    Ok(others
        .iter()
        .zip(phases)
        .map(|(file, phase)| start(file) + phase)
        .collect())
}

/// Adds the requested columns of each machine.
fn widen(found: &mut SimulationResult, machines: &CoupledMachines, asked: Sets) -> Result<()> {
    for (k, machine) in machines.all().enumerate() {
        let prefix = k
            .checked_sub(1)
            .map_or_else(String::new, |k| beside_name(k) + " ");
        let states = found.states_of(&machine);
        let wider = add_columns(machine.file, &found.columns, &states, asked, &prefix);
        found.columns = wider.map_err(core_report)?;
    }
    Ok(())
}

/// Why a machine, or a drive of this name, cannot be simulated.
fn refusal(unfit: &UnfitDrive, drive: Option<&str>) -> Report {
    let name = drive.unwrap_or_default();
    match unfit {
        UnfitDrive::NoPeak => miette!(
            help = "fill in peak_torque or peak_curve in the catalogue; docs/catalogue.md describes them",
            "the drive {name} cannot be simulated: its peak torque is not known"
        ),
        UnfitDrive::SelfLocking { gearbox } => miette!(
            help = "take a gearbox through which the machine can drive the motor",
            "the drive {name} cannot be simulated: the gearbox {gearbox} locks itself, and the equation of motion has no single solution when it does"
        ),
        UnfitDrive::Start(why) => list::simulation::problem(why).into(),
    }
}
