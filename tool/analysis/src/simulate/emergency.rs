//! Stops at instants over a whole cycle: the emergency stop at its worst.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::Reducible as _;

use super::{Rest, SimulationError, SimulationResult};
use jred_file::model::machine::MachineFile;
use jred_file::model::simulation::{Halt, Simulation};

/// A stop at one of the instants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Time at which the motor is switched off (s).
    pub time: f64,
    /// Position of the drive link there (rad, or m).
    pub position: f64,
    /// Time and travel from there to rest; `None` if the machine is not at rest at the end of the simulation.
    pub rest: Option<Rest>,
}

/// Stops at equal times over the last cycle before the `stop` of the simulation, which is included. Under a controller with a cyclic motion it is a
/// cycle of the motion, else the turn before. `run` simulates.
///
/// # Errors
/// No stop, or no whole cycle before it; errors of the simulations.
pub fn stops<E: From<SimulationError>>(
    file: &MachineFile,
    simulation: &Simulation,
    count: u32,
    run: impl Fn(&Simulation) -> Result<SimulationResult, E>,
) -> Result<Vec<Stop>, E> {
    let halt = simulation.halt.ok_or(SimulationError::NoStop)?;
    let span = span(file, simulation, halt, &run)?;
    let mut stops = Vec::new();
    for k in (0..count).rev() {
        let time = halt.time - span * f64::from(k) / f64::from(count);
        let shifted = Simulation {
            halt: Some(Halt { time, ..halt }),
            ..simulation.clone()
        };
        let found = run(&shifted)?;
        if let Some(error) = found.ended {
            return Err(error.into());
        }
        stops.push(Stop {
            time,
            position: found.halted_at.unwrap_or_default(),
            rest: found.rest,
        });
    }
    Ok(stops)
}

/// Duration of the last cycle before the stop (s).
fn span<E: From<SimulationError>>(
    file: &MachineFile,
    simulation: &Simulation,
    halt: Halt,
    run: impl Fn(&Simulation) -> Result<SimulationResult, E>,
) -> Result<f64, E> {
    let followed = file.motion.as_ref().filter(|motion| motion.cyclic);
    if let Some(motion) = followed.filter(|_| simulation.control.is_some()) {
        let span = motion.duration();
        return if span <= halt.time {
            Ok(span)
        } else {
            Err(SimulationError::NoCycle.into())
        };
    }
    if let Domain::Stroke { .. } = file.machine.domain() {
        return Err(SimulationError::NoCycle.into());
    }
    // The rows up to the stop, interpolated linearly.
    let free = Simulation {
        halt: None,
        duration: halt.time,
        ..simulation.clone()
    };
    let found = run(&free)?.whole_states()?;
    let Some(([end, ..], before)) = found.split_last() else {
        return Err(SimulationError::NoCycle.into());
    };
    let step = halt.time / before.len().max(1) as f64;
    for (k, pair) in found.windows(2).enumerate().rev() {
        let away = pair.iter().map(|[phi, ..]| (phi - end).abs() - TAU);
        if let [far, near] = away.collect::<Vec<_>>()[..]
            && far >= 0.0
            && near < 0.0
        {
            let t = step * (k as f64 + far / (far - near));
            return Ok(halt.time - t);
        }
    }
    Err(SimulationError::NoCycle.into())
}
