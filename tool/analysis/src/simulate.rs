//! `jred simulate`: the free motion φ(t), ω(t) under a motor torque, (7.12).
//!
//! Besides the motion it integrates the work of the motor, of the signed process loads, and the losses. The energy balance closes only if motion and
//! reduction agree.

mod clock;
mod commander;
mod control;
mod coupled;
mod drive_state;
mod emergency;
mod error;
mod free;
pub(super) mod machine;
mod observe;
mod point;
mod result;
pub(super) mod run;
mod variator;
pub(super) mod watch;
mod winding;

pub use clock::Moment;
use commander::{COMMANDED, COMMANDED_WITH_GUESTS, CommandedPlant, Commander};
pub use coupled::{CoupledMachines, GearedMachine};
pub use emergency::{Stop, stops};
pub use error::{IntegratorStop, NotBeside, SimulationError};
pub use machine::beside_name;
pub use observe::{MotorPoint, MotorState, NoObserver, Observer};
pub use result::{
    BRIEFEST_FLIGHT, Effort, FollowingError, Impacts, Rest, SimulationResult, Stall, TorqueDeficit,
    TorqueLimit, TurnWorks,
};

use jred_file::model::machine::MachineFile;
use jred_file::model::motor::Motor;
use jred_file::model::simulation::Simulation;

/// Simulates the file under its own motor: t, φ, ω, α, J, energies, and the balance (E + U) − (E + U)₀ − W_motor − W_process + losses, which is zero
/// up to the tolerance. Rows before an error are kept.
///
/// # Errors
/// No motor; errors of the machine at the start.
pub fn simulate(
    file: &MachineFile,
    simulation: &Simulation,
) -> Result<SimulationResult, SimulationError> {
    simulate_together(&CoupledMachines::alone(file), simulation)
}

/// The same with further machines on the motor's shaft.
///
/// # Errors
/// As [`simulate`].
pub fn simulate_together(
    machines: &CoupledMachines,
    simulation: &Simulation,
) -> Result<SimulationResult, SimulationError> {
    let motor = simulation.own_motor().ok_or(SimulationError::NoMotor)?;
    let file = machines.first;
    if let Some(variator) = &file.variator {
        refuse_scheduled(file)?;
        file.machine.check_curves()?;
        let plant = variator::Plant::new(file, variator, simulation, motor)?;
        return run::run(&plant, simulation, &mut NoObserver);
    }
    simulate_under(machines, simulation, &motor, &mut NoObserver)
}

/// The same under another motor, which acts in front of the drive trains; `observer` follows it. Without a variator.
///
/// # Errors
/// Errors of the machines at the start.
pub fn simulate_under(
    machines: &CoupledMachines,
    simulation: &Simulation,
    motor: &impl Motor,
    observer: &mut dyn Observer,
) -> Result<SimulationResult, SimulationError> {
    use free::{PLAIN, WITH_GUESTS};
    let has_guests = machines.guests().any();
    let plant = machine::Plant::new(machines.clone(), simulation, motor);
    if let Some((control, motion)) = simulation.control.zip(machines.first.motion.as_ref()) {
        let commander = control::Cascade::new(machines, control, motion)?;
        return commanded(plant, commander, observer);
    }
    if let Some(winding) = simulation.winding {
        return commanded(plant, winding, observer);
    }
    if has_guests {
        run::run::<WITH_GUESTS>(&plant, simulation, observer)
    } else {
        run::run::<PLAIN>(&plant, simulation, observer)
    }
}

/// The same for a motor with its own state.
fn commanded<M: Motor, C: Commander<M>>(
    plant: machine::Plant<M>,
    commander: C,
    observer: &mut dyn Observer,
) -> Result<SimulationResult, SimulationError> {
    let simulation = plant.simulation;
    let has_guests = plant.machines.guests().any();
    let plant = CommandedPlant { plant, commander };
    if has_guests {
        run::run::<COMMANDED_WITH_GUESTS>(&plant, simulation, observer)
    } else {
        run::run::<COMMANDED>(&plant, simulation, observer)
    }
}

/// Refuses a machine with parts scheduled by the motion of its file, where that motion is not simulated.
fn refuse_scheduled(file: &MachineFile) -> Result<(), SimulationError> {
    let mut scheduled = file.scheduled();
    scheduled
        .next()
        .map_or(Ok(()), |part| Err(SimulationError::Scheduled(part)))
}
