//! `jred steady`: the periodic motion, over one or several turns, under a motor's characteristic, and the flywheel that smooths it.
//!
//! With one degree of freedom and J > 0 the kinetic energy at the end of a cycle is a scalar function of that at its start, and the steady cycle is
//! where the two are equal. No transient needs to decay. Either side may drive: a motor, or a process against a braking motor.

mod aim;
mod cycle;
mod error;
mod figures;
mod flywheel;
mod start;
mod turn;

pub use aim::{Level, MeanSpeed, Scaling};
pub use cycle::{Cycle, TorqueDeficit};
pub use error::SteadyError;
pub use figures::{Energies, MotorPower, MotorTorque, SteadyFigures};
pub use flywheel::{Classical, Flywheel, ShaftFlywheel, Wheel};
pub use start::Start;

use crate::simulate::CoupledMachines;
use crate::simulate::run::SIGN_SPEED;
use aim::CycleSearch;
use jred::Domain;
use jred::machine::Reducible as _;
use jred_file::model::machine::{MachineFile, least_common_multiple};
use jred_file::model::motor::OwnMotor;
use jred_file::model::simulation::Simulation;
use turn::TurningMachine;

/// Tolerance within which the turns of a machine are a whole number: rounding.
const TURNS_TOLERANCE: f64 = 1e-12;

/// A request.
#[derive(Clone, Debug)]
pub struct SteadyRequest {
    /// Coefficient of speed fluctuation to reach with a flywheel.
    pub delta: Option<f64>,
    /// A mean speed, and the quantity that is scaled for it.
    pub mean_speed: Option<MeanSpeed>,
    /// Turns of the drive link per cycle; `None`: as many as the loads need.
    pub turns: Option<u32>,
    /// Positions per turn in the list.
    pub positions: usize,
}

impl Default for SteadyRequest {
    fn default() -> Self {
        Self {
            delta: None,
            mean_speed: None,
            turns: None,
            positions: 36,
        }
    }
}

/// The steady motion of a machine.
#[derive(Debug)]
pub struct Steady {
    /// The cycle without a further flywheel.
    pub cycle: Option<Cycle>,
    /// Why the machine has no steady cycle without a further flywheel.
    pub no_cycle: Option<SteadyError>,
    /// Whether the inductance of the motor's winding is neglected: the torque is that of the settled current at each speed.
    pub inductance_left_out: bool,
    /// The flywheel for the requested δ.
    pub flywheel: Option<Flywheel>,
}

impl Steady {
    /// The final cycle of the machine: with the flywheel, if there is one.
    pub fn last(&self) -> Option<&Cycle> {
        let with = self.flywheel.as_ref().map(|flywheel| &flywheel.cycle);
        with.or(self.cycle.as_ref())
    }
}

/// The steady cycle of the machine under the motor of the simulation, which also gives the angle at which a turn begins.
///
/// Accuracy: the energy at the end of the turn equals that at its start within a relative 1e-12 (1e-10 with a load from a table, whose third
/// derivative jumps at each row), and the energy balance closes to 1e-10 of the exchanged energy (tests `steady`).
///
/// # Errors
/// No steady cycle: the machine stops, or runs away; no full turn, no motor torque; the machine cannot be placed.
pub fn steady(
    file: &MachineFile,
    simulation: &Simulation,
    request: &SteadyRequest,
) -> Result<Steady, SteadyError> {
    steady_together(&CoupledMachines::alone(file), simulation, request)
}

/// The same for machines on one shaft, of which the others make whole turns per turn of the first. For two presses the energy at the end of the turn
/// equals that at its start to 2e-12 (test `two_presses_in_step_are_one`).
///
/// # Errors
/// As [`steady`]; a machine that is not in the same position after a turn of the first.
pub fn steady_together(
    machines: &CoupledMachines,
    simulation: &Simulation,
    request: &SteadyRequest,
) -> Result<Steady, SteadyError> {
    let file = machines.first;
    if let Domain::Stroke { from, to } = file.machine.domain() {
        let coordinate = file.machine.mechanism().coordinate();
        return Err(SteadyError::Stroke(coordinate, [from, to]));
    }
    let turns = turns(machines, request)?;
    for machine in machines.all() {
        if let Some(part) = machine.file.scheduled().next() {
            return Err(SteadyError::Scheduled(part));
        }
        let own = machine.ratio().abs() * f64::from(turns);
        if (own - own.round()).abs() > TURNS_TOLERANCE * own || own < 0.5 {
            return Err(SteadyError::NotWhole {
                title: machine.file.title.clone(),
                turns: own,
                of_first: turns,
            });
        }
    }
    let motor = simulation.own_motor().ok_or(SteadyError::NoMotor)?;
    let mean_speed = request.mean_speed.as_ref();
    let search = CycleSearch {
        simulation,
        motor,
        direction: match mean_speed {
            Some(aim) => aim.speed.signum(),
            None => direction(machines, simulation, motor, turns)?,
        },
        turns,
        mean_speed,
    };
    let positions = request.positions;
    let inductance_left_out = simulation.winding.is_some();
    let Some(delta) = request.delta else {
        let cycle = search.with(machines, None, |turning, ended| {
            Cycle::of(turning, ended, positions)
        })?;
        return Ok(Steady {
            cycle: Some(cycle),
            no_cycle: None,
            inductance_left_out,
            flywheel: None,
        });
    };
    let found = search.with(machines, None, |turning, ended| {
        let guess = ended.guess;
        let cycle = Cycle::of(turning, ended, positions);
        if let Err(why) = &cycle
            && !why.is_standstill()
        {
            return cycle.map(|_| None);
        }
        let own = cycle.as_ref().ok();
        let flywheel = Flywheel::of(turning, &search, own, guess, delta, positions)?;
        Ok(Some((cycle, flywheel)))
    });
    let (cycle, flywheel) = match found {
        Ok(Some(found)) => found,
        // Without a flywheel not even the end of a cycle can be found.
        Err(why) if why.is_standstill() => {
            let turning =
                TurningMachine::new(machines, simulation, motor, search.direction, turns)?;
            let flywheel = Flywheel::of(&turning, &search, None, None, delta, positions)?;
            (Err(why), flywheel)
        }
        Ok(None) => return Err(SteadyError::Integrator),
        Err(why) => return Err(why),
    };
    let (cycle, no_cycle) = match cycle {
        Ok(cycle) => (Some(cycle), None),
        Err(why) => (None, Some(why)),
    };
    Ok(Steady {
        cycle,
        no_cycle,
        inductance_left_out,
        flywheel: Some(flywheel),
    })
}

/// Turns of the first drive link in a cycle.
fn turns(machines: &CoupledMachines, request: &SteadyRequest) -> Result<u32, SteadyError> {
    let own = machines.all().map(|machine| machine.file.turns());
    let own = own.fold(1, least_common_multiple);
    match request.turns {
        Some(asked) if asked % own != 0 => Err(SteadyError::Turns { own, asked }),
        Some(asked) => Ok(asked),
        None => Ok(own),
    }
}

/// The direction in which the machine turns: +1 or −1. It is that of the motor at rest. Otherwise, or if `start_speed` has the other sign, it is that
/// of `start_speed`, if a motor at speed or the process drives there.
fn direction(
    machines: &CoupledMachines,
    simulation: &Simulation,
    own: OwnMotor,
    turns: u32,
) -> Result<f64, SteadyError> {
    let turning = |direction| TurningMachine::new(machines, simulation, own, direction, turns);
    let process_drives = |direction| -> Result<bool, SteadyError> {
        let turning = turning(direction)?;
        Ok(turning.keeping(SIGN_SPEED)?
            < -1e-9 * turning.effort(SIGN_SPEED) / turning.plant.ratio().abs())
    };
    let motor = own.characteristic;
    let at_rest = motor.torque(0.0) * turning(1.0)?.plant.ratio();
    let asked = simulation.start_speed;
    if at_rest == 0.0 {
        // A motor that must be started by hand.
        let drives = |speed: &f64| motor.torque(*speed) * speed > 0.0;
        if asked != 0.0 && motor.marks().iter().any(drives) {
            return Ok(asked.signum());
        }
        let ways = if asked == 0.0 {
            [1.0, -1.0]
        } else {
            [asked.signum(); 2]
        };
        for way in ways {
            if process_drives(way)? {
                return Ok(way);
            }
        }
        return Err(SteadyError::NoTorque);
    }
    if asked * at_rest < 0.0 {
        if process_drives(asked.signum())? {
            return Ok(asked.signum());
        }
        return Err(SteadyError::WrongSign {
            torque: motor.torque(0.0),
            speed: asked,
        });
    }
    Ok(at_rest.signum())
}
