//! Why a machine has no steady cycle.

use jred::error::Error;
use jred_file::model::by_motion::ByMotion;
use jred_file::model::coordinate::Coordinate;

use super::aim::Level;
use super::cycle::TorqueDeficit;
use crate::simulate::SimulationError;

/// Why a machine has no steady cycle, or no flywheel for a fluctuation. Speeds are in rad/s, torques in N·m.
#[derive(Debug)]
pub enum SteadyError {
    /// The machine cannot be placed.
    Machine(Error),
    /// The drive link has a stroke, from one position to another.
    Stroke(Coordinate, [f64; 2]),
    /// A part is scheduled by the motion of the file, which a steady cycle does not follow.
    Scheduled(ByMotion),
    /// Machines on one shaft that do not repeat together.
    NotWhole {
        /// The machine.
        title: String,
        /// Its turns.
        turns: f64,
        /// Turns of the first machine in a cycle.
        of_first: u32,
    },
    /// No motor is given.
    NoMotor,
    /// The motor has no torque.
    NoTorque,
    /// The motor drives in the other direction.
    WrongSign {
        /// Torque of the motor at rest.
        torque: f64,
        /// The speed of the file.
        speed: f64,
    },
    /// No scaling of a motor or a load gives the mean speed.
    NoLevel {
        /// The scaled quantity.
        by: Level,
        /// The speed.
        speed: f64,
    },
    /// No load has the name.
    NoLoad {
        /// The name.
        name: String,
        /// The existing names.
        names: Vec<String>,
    },
    /// A cycle of this number of turns does not repeat.
    Turns {
        /// Turns after which the loads repeat.
        own: u32,
        /// Turns of the cycle.
        asked: u32,
    },
    /// The machine gains energy in each turn at every speed.
    Surplus {
        /// The highest evaluated speed.
        speed: f64,
        /// Energy gained in a turn there (J).
        surplus: f64,
    },
    /// Motor, loads and losses do no work in a turn at this speed, so that the speed is indeterminate.
    Indifferent(f64),
    /// The machine stops here.
    Stuck(TorqueDeficit),
    /// The speed falls without end, below this.
    Dying(f64),
    /// No flywheel gives the requested fluctuation.
    NoFlywheel {
        /// The requested fluctuation.
        delta: f64,
        /// The largest inertia tried (kg·m²).
        inertia: f64,
        /// The fluctuation with it; `None`: the machine stops.
        reached: Option<f64>,
        /// Mean motor torque of a slow turn.
        torque: f64,
    },
    /// The integrator stopped.
    Integrator,
    /// A contact separates in the steady cycle.
    Parted(SimulationError),
}

impl<E: Into<Error>> From<E> for SteadyError {
    fn from(error: E) -> Self {
        Self::Machine(error.into())
    }
}

impl SteadyError {
    /// Whether more inertia may help.
    pub(super) const fn is_standstill(&self) -> bool {
        matches!(self, Self::Stuck(_) | Self::Dying(_))
    }
}
