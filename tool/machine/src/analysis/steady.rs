//! `jred steady`: the motion that repeats turn by turn under a motor's characteristic, and the flywheel that smooths it.
//!
//! With one degree of freedom and J > 0 the kinetic energy at the end of a turn is a function of that at its start, one number of
//! one number, and the steady cycle is where the two are equal. No transient is waited for.

mod cycle;
mod error;
mod figures;
mod flywheel;
mod start;
mod turn;

pub use cycle::{Cycle, Missing};
pub use error::SteadyError;
pub use figures::Figures;
pub use flywheel::{Classical, Flywheel, Place, Wheel};
pub use start::Start;

use jred::{Domain, Reducible as _};

use crate::analysis::simulate::Together;
use crate::model::by_motion::ByMotion;
use crate::model::machine::MachineFile;
use crate::model::motor::OwnMotor;
use crate::model::simulation::Simulation;
use crate::number::rounding::{rounded, short};
use crate::units::RPM;
use turn::Turning;

/// Share by which the turns of a machine may miss a whole number: rounding.
const WHOLE: f64 = 1e-12;

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// Coefficient of speed fluctuation that a flywheel is to reach.
    pub delta: Option<f64>,
    /// Positions in the list.
    pub positions: usize,
}

/// The steady motion of a machine.
#[derive(Debug)]
pub struct Steady {
    /// Without a further flywheel; with one asked for, possibly the reason why there is none.
    pub cycle: Result<Cycle, SteadyError>,
    /// The flywheel, if one was asked for.
    pub flywheel: Option<Flywheel>,
    /// Whether the motor has a winding whose current takes time to settle, which is not counted here.
    pub settled: bool,
}

impl Steady {
    /// The cycle that the machine has in the end: with the flywheel, if there is one.
    pub fn last(&self) -> Option<&Cycle> {
        let with = self.flywheel.as_ref().map(|flywheel| &flywheel.cycle);
        with.or(self.cycle.as_ref().ok())
    }
}

/// The steady cycle of the machine under the motor of the simulation, which gives the angle where a turn begins, too.
///
/// Accuracy: the energy at the end of the turn is that at its start to 1e-12 of itself (1e-10 with a load from a table, whose third
/// derivative jumps at each row), and the energy balance closes to 1e-10 of the energy turned over (tests `steady`).
///
/// # Errors
/// There is none: the machine stops, or runs away; no full turn, no motor torque; the machine cannot be placed.
pub fn steady(
    file: &MachineFile,
    simulation: &Simulation,
    request: &Request,
) -> Result<Steady, SteadyError> {
    steady_together(&Together::alone(file), simulation, request)
}

/// The same of machines on one shaft, of which the others make whole turns while the first makes one. The energy at the end of the turn is that
/// at its start to 2e-12 of two presses (test `two_presses_in_step_are_one`).
///
/// # Errors
/// Those of [`steady`]; a machine that is not where it was after a turn of the first.
pub fn steady_together(
    machines: &Together,
    simulation: &Simulation,
    request: &Request,
) -> Result<Steady, SteadyError> {
    let file = machines.first;
    if let Domain::Stroke { from, to } = file.machine.domain() {
        let coordinate = file.machine.mechanism().coordinate();
        return Err(SteadyError::Stroke {
            range: format!("{} to {}", coordinate.place(from), coordinate.place(to)),
        });
    }
    for machine in machines.all() {
        if let Some(ByMotion { what, cure }) = machine.file.scheduled().next() {
            return Err(SteadyError::Scheduled { what, cure });
        }
        let turns = machine.ratio().abs();
        if (turns - turns.round()).abs() > WHOLE * turns || turns < 0.5 {
            return Err(SteadyError::NotWhole {
                title: machine.file.title.clone(),
                turns: short(turns),
            });
        }
    }
    let motor = simulation.own_motor().ok_or(SteadyError::NoMotor)?;
    let direction = direction(machines, simulation, motor)?;
    let turning = Turning::new(machines, simulation, motor, direction)?;
    let cycle = Cycle::of(&turning, request.positions);
    let Some(delta) = request.delta else {
        return Ok(Steady {
            cycle: Ok(cycle?),
            flywheel: None,
            settled: simulation.winding.is_some(),
        });
    };
    match cycle {
        Err(why) if !why.is_standstill() => Err(why),
        cycle => {
            let own = cycle.as_ref().ok();
            let flywheel = Flywheel::of(&turning, simulation, own, delta, request.positions)?;
            Ok(Steady {
                cycle,
                flywheel: Some(flywheel),
                settled: simulation.winding.is_some(),
            })
        }
    }
}

/// The way the motor drives the drive link: +1 or −1.
fn direction(
    machines: &Together,
    simulation: &Simulation,
    own: OwnMotor,
) -> Result<f64, SteadyError> {
    let ratio = Turning::new(machines, simulation, own, 1.0)?.plant.ratio();
    let motor = own.characteristic;
    let at_rest = motor.torque(0.0) * ratio;
    let asked = simulation.start_speed;
    if at_rest == 0.0 {
        // A motor that is started by hand.
        let drives = |speed: &f64| motor.torque(*speed) * speed > 0.0;
        return if asked != 0.0 && motor.marks().iter().any(drives) {
            Ok(asked.signum())
        } else {
            Err(SteadyError::NoTorque)
        };
    }
    if asked * at_rest < 0.0 {
        return Err(SteadyError::WrongSign {
            torque: torque(motor.torque(0.0)),
            speed: speed(asked),
        });
    }
    Ok(at_rest.signum())
}

fn speed(omega: f64) -> String {
    format!("{} rpm", rounded(omega / RPM))
}

fn torque(torque: f64) -> String {
    format!("{} N m", short(torque))
}
