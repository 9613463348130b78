//! `jred simulate`: the free motion φ(t), ω(t) under a motor torque, (7.12) and (7.13).
//!
//! Beside the motion it integrates the work of the motor, of the signed process loads, and the losses, so that the energy
//! balance closes only if motion and reduction agree.

mod control;
mod error;
pub(super) mod machine;
pub(super) mod run;
mod simulated;
mod variator;
pub(super) mod watch;

pub use error::SimulationError;
pub use simulated::{Impacts, Rest, Simulated};

use crate::model::machine::MachineFile;
use crate::model::simulation::Simulation;

/// Runs the simulation of the file: t, φ, ω, α, J, energies, and the balance
/// (E + U) − (E + U)₀ − W_motor − W_process + losses, which is zero up to the tolerance. Rows before an error are kept.
///
/// # Errors
/// Those of the machine at the start.
pub fn simulate(file: &MachineFile, simulation: &Simulation) -> Result<Simulated, SimulationError> {
    if let Some(what) = file.scheduled().next() {
        return Err(SimulationError::Scheduled { what });
    }
    let controlled = simulation.control.zip(file.motion.as_ref());
    match (&file.variator, controlled) {
        (Some(variator), _) => run::run(
            &variator::Plant::new(file, variator, simulation)?,
            file,
            simulation,
        ),
        (None, Some((control, motion))) => run::run(
            &control::Controlled::new(file, simulation, control, motion)?,
            file,
            simulation,
        ),
        (None, None) => run::run(&machine::Plant::new(file, simulation), file, simulation),
    }
}
