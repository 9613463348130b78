//! `jred simulate`: the free motion φ(t), ω(t) under a motor torque, (7.12) and (7.13).
//!
//! Beside the motion it integrates the work of the motor, of the signed process loads, and the losses, so that the energy
//! balance closes only if motion and reduction agree.

mod control;
mod error;
pub(super) mod machine;
mod observe;
pub(super) mod run;
mod simulated;
mod variator;
pub(super) mod watch;

pub use error::SimulationError;
pub use observe::{Nobody, Observer, Working};
pub use simulated::{Following, Impacts, Missing, Rest, Simulated, Stuck, TorqueLimit};

use crate::model::machine::MachineFile;
use crate::model::motor::Motor;
use crate::model::simulation::Simulation;

/// Runs the simulation of the file under its own motor: t, φ, ω, α, J, energies, and the balance
/// (E + U) − (E + U)₀ − W_motor − W_process + losses, which is zero up to the tolerance. Rows before an error are kept.
///
/// # Errors
/// No motor; those of the machine at the start.
pub fn simulate(file: &MachineFile, simulation: &Simulation) -> Result<Simulated, SimulationError> {
    let motor = simulation.own_motor().ok_or(SimulationError::NoMotor)?;
    if let Some(variator) = &file.variator {
        check(file)?;
        let plant = variator::Plant::new(file, variator, simulation, motor)?;
        return run::run(&plant, file, simulation, &mut Nobody);
    }
    simulate_under(file, simulation, &motor, &mut Nobody)
}

/// The same under another motor, which acts in front of the drive train; `observer` looks at it. Without a variator.
///
/// # Errors
/// Those of the machine at the start.
pub fn simulate_under(
    file: &MachineFile,
    simulation: &Simulation,
    motor: &impl Motor,
    observer: &mut dyn Observer,
) -> Result<Simulated, SimulationError> {
    check(file)?;
    match simulation.control.zip(file.motion.as_ref()) {
        Some((control, motion)) => run::run(
            &control::Controlled::new(file, simulation, control, motion, motor)?,
            file,
            simulation,
            observer,
        ),
        None => run::run(
            &machine::Plant::new(file, simulation, motor),
            file,
            simulation,
            observer,
        ),
    }
}

/// Refuses a machine that goes by the motion of its file.
fn check(file: &MachineFile) -> Result<(), SimulationError> {
    match file.scheduled().next() {
        Some(what) => Err(SimulationError::Scheduled { what }),
        None => Ok(()),
    }
}
