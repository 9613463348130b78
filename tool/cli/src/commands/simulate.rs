//! `jred simulate`: the motion under a motor.

use miette::{Result, miette};

use crate::commands::{Done, print_parts};
use crate::options;
use crate::output;
use jred_machine::analysis::simulate;
use jred_machine::plain;
use jred_machine::read;
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
    let found = simulate::simulate(&file, simulation)?;
    if let Some(path) = &options.plot {
        let page = page::simulation_page(&file, simulation, &found.columns);
        output::write(path, page.as_bytes())?;
    }
    let done = print_parts(list::simulation::write(
        &file,
        simulation,
        &found,
        options.format,
    ))?;
    // The rows up to there are written before the reason is.
    found.ended.map_or(Ok(done), |error| Err(error.into()))
}
