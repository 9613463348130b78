//! `jred steady`: the steady cycle, and the flywheel that smooths it.

use miette::{Result, miette};

use crate::commands::simulate::{read_all, starts};
use crate::commands::{Completion, documents, rate};
use crate::options;
use crate::output;
use jred_analysis::checked;
use jred_analysis::simulate::CoupledMachines;
use jred_analysis::steady::{self, Level, MeanSpeed, SteadyRequest};
use jred_file::argument::Argument;
use jred_file::model::characteristic::Characteristic;
use jred_file::model::machine::MachineFile;
use jred_file::model::simulation::Simulation;
use jred_file::model::variator;
use jred_file::text::key::SPEED;
use jred_report::list;
use jred_report::page;

/// Smallest number of positions per turn in the report.
const DRAWN: usize = 360;

/// Runs the command.
///
/// # Errors
/// Bad input, or no steady cycle.
pub fn steady(options: &options::Steady) -> Result<Completion> {
    let Some((path, others)) = options.files.split_first() else {
        return Err(miette!("no machine file is given"));
    };
    let (file, others) = (checked::read_over_turns(path)?, read_all(others)?);
    output::check(options.documents.files())?;
    variator::refuse(&file, "steady")?;
    let simulation = simulation(options, &file)?;
    let starts = starts(&others, &options.phase)?;
    let machines = CoupledMachines::alone(&file)
        .with(others.iter().zip(starts), &simulation)
        .map_err(|why| list::simulation::problem(&why))?;
    let asked = options.mean_speed.as_deref();
    let speed = rate("mean-speed", asked, Argument::any(SPEED), &file.axis())?;
    let request = SteadyRequest {
        delta: options.delta,
        mean_speed: mean_speed(speed, options)?,
        turns: options.turns,
        positions: options.positions as usize,
    };
    let solve = |request: &SteadyRequest| {
        let found = steady::steady_together(&machines, &simulation, request);
        found.map_err(|why| list::steady::problem(&why))
    };
    let steady = solve(&request)?;
    let answer = list::steady::answer(&machines, &steady);
    let page = || {
        let finer = SteadyRequest {
            positions: request.positions.max(DRAWN),
            ..request.clone()
        };
        Ok(page::steady_page(&machines, &solve(&finer)?))
    };
    documents::finish(&options.documents, answer, page, options.format)
}

/// The requested mean speed.
fn mean_speed(speed: Option<f64>, options: &options::Steady) -> Result<Option<MeanSpeed>> {
    let by = match &options.scale {
        Some(name) => Level::Load(name.clone()),
        None => Level::Motor,
    };
    match speed {
        Some(0.0) => Err(miette!(
            help = "give the speed at which the machine runs; a machine at rest has no cycle",
            "--mean-speed is zero"
        )),
        Some(speed) => Ok(Some(MeanSpeed { speed, by })),
        None => Ok(None),
    }
}

/// The simulation of the file, with the torque of the command line if given.
fn simulation(options: &options::Steady, file: &MachineFile) -> Result<Simulation> {
    let own = file.simulation.as_ref();
    // With a mean speed the motor torque may be unknown; it is computed.
    let unknown = options.mean_speed.is_some() && options.scale.is_none();
    let unknown = unknown && own.is_none_or(|own| own.torque.is_none());
    let Some(torque) = options.torque.or(unknown.then_some(1.0)) else {
        return own.cloned().ok_or_else(|| {
            miette!(
                help = "give --torque \"20 N m\", or add a [simulation] with start_angle, duration, output_step and the motor: torque, \
                        torque_speed, dc_motor or induction_motor; docs/machine-file.md shows how",
                "{} has no [simulation], which gives the motor",
                file.name
            )
        });
    };
    let torque = Characteristic::constant(torque);
    Ok(match &file.simulation {
        Some(own) => Simulation {
            torque: Some(torque),
            ..own.clone()
        },
        None => Simulation::of_motor(torque),
    })
}
