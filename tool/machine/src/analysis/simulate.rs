//! `jred simulate`: the free motion φ(t), ω(t) under a motor torque, (7.12) and (7.13).
//!
//! Beside the motion it integrates the work of the motor, of the signed process loads, and the losses, so that the energy
//! balance closes only if motion and reduction agree.

mod error;
pub(super) mod machine;
pub(super) mod run;
mod variator;
pub(super) mod watch;

pub use error::SimulationError;

use crate::model::machine::{MachineFile, Simulation};
use crate::number::columns::Columns;

/// Runs the simulation of the file: t, φ, ω, α, J, energies, and the balance
/// (E + U) − (E + U)₀ − W_motor − W_process + losses, which is zero up to the tolerance.
///
/// # Errors
/// Those of the machine and the integrator.
pub fn simulate(file: &MachineFile, simulation: &Simulation) -> Result<Columns, SimulationError> {
    match &file.variator {
        Some(variator) => run::run(
            &variator::Plant::new(file, variator, simulation)?,
            file,
            simulation,
        ),
        None => run::run(&machine::Plant::new(file, simulation), file, simulation),
    }
}
