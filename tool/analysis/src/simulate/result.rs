//! Result of a simulation.

use super::SimulationError;
use super::clock::Moment;
use super::coupled::GearedMachine;
use jred_file::model::schedule::ScheduleInstant;
use jred_file::number::columns::Columns;

/// A motion, up to its end or to an error.
#[derive(Debug)]
pub struct SimulationResult {
    /// A row for each output step.
    pub columns: Columns,
    /// Final rest of the drive link after the motor was switched off.
    pub rest: Option<Rest>,
    /// Earlier standstill after which it moved on, because nothing held it.
    pub turned_back: Option<Rest>,
    /// Its position when the motor was switched off (rad, or m).
    pub halted_at: Option<f64>,
    /// Time and travel from the start to the position where friction holds the drive link to the end, if no controller acts and the motor was not
    /// switched off.
    pub held: Option<Rest>,
    /// Effort of the motor until it was switched off, or to the end; not behind a variator.
    pub effort: Option<Effort>,
    /// Time and travel to the speed of [`Simulation::to_speed`](jred_file::model::simulation::Simulation::to_speed).
    pub reached: Option<Rest>,
    /// Works in whole turns, for a turning drive link.
    pub turned: Option<TurnWorks>,
    /// The impacts on end stops.
    pub impacts: Option<Impacts>,
    /// The first position at which the motor has not driven the machine on.
    pub missing: Option<Stall>,
    /// The controlled motor at its torque limit.
    pub torque_limit: Option<TorqueLimit>,
    /// The largest error of a controlled machine.
    pub following: Option<FollowingError>,
    /// φ, ω, α of the drive link in each row.
    pub states: Vec<[f64; 3]>,
    /// The time of each row, and the direction of motion.
    pub moments: Vec<Moment>,
    /// Why the motion ended early.
    pub ended: Option<SimulationError>,
}

/// Effort of a motor: the largest magnitudes at the integrator's steps and at three instants between steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Its largest torque (N·m), and the time (s).
    pub torque: [f64; 2],
    /// Its RMS torque over time.
    pub rms: f64,
    /// Its largest driving power (W), and the time.
    pub power: [f64; 2],
    /// Its largest speed (rad/s), and the time.
    pub speed: [f64; 2],
}

/// A time and a travel, since the motor was switched off or since the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// Time since then (s).
    pub time: f64,
    /// Travel since then (rad, or m).
    pub way: f64,
}

/// Impacts on end stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impacts {
    /// Time of the first (s).
    pub time: f64,
    /// Its position (rad, or m).
    pub position: f64,
    /// Its speed (rad/s, or m/s).
    pub speed: f64,
    /// Number of impacts.
    pub count: u32,
    /// Whether the machine came to rest at a stop because a rebound would have returned within [`BRIEFEST_FLIGHT`]: the series of ever smaller
    /// rebounds has no end.
    pub settled: bool,
}

/// A rebound that returns to an end stop within this time (s) ends at rest.
pub const BRIEFEST_FLIGHT: f64 = 1e-6;

/// Works in whole turns of the drive link, from the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnWorks {
    /// Number of turns; negative: φ falls.
    pub turns: f64,
    /// Work at the motor's shaft (J).
    pub motor: f64,
    /// Work of the signed process loads on the machine (J).
    pub process: f64,
    /// Losses (J).
    pub losses: f64,
    /// Kinetic energy at their end (J).
    pub kinetic: f64,
}

/// Torque of a motor at rest, and the torque that the machine needs to move on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueDeficit {
    /// Position (rad, or m).
    pub phi: f64,
    /// Available motor torque there (N·m).
    pub given: f64,
    /// Required torque (N·m).
    pub needed: f64,
}

/// First position at which a machine has stopped under its motor, or did not start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stall {
    /// Time (s).
    pub time: f64,
    /// The missing torque.
    pub missing: TorqueDeficit,
}

/// A motor at the limit of its torque under a controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueLimit {
    /// Time of the first (s).
    pub time: f64,
    /// Its position (rad, or m).
    pub position: f64,
    /// How often the limit is reached.
    pub count: u32,
    /// Total time (s).
    pub duration: f64,
}

/// The largest following error, at the integrator's steps and at three instants between steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowingError {
    /// Its time (s).
    pub time: f64,
    /// Its position (rad, or m).
    pub position: f64,
    /// Reference less position (rad, or m).
    pub error: f64,
}

impl SimulationResult {
    /// For each row, the instant of a machine, and φ, ω and α of its drive link.
    pub fn states_of(&self, machine: &GearedMachine) -> Vec<(ScheduleInstant, [f64; 3])> {
        let rows = self.moments.iter().zip(&self.states);
        rows.map(|(moment, state)| {
            let state = machine.state(*state);
            (moment.now(machine, state[1]), state)
        })
        .collect()
    }

    /// φ, ω, α in each row of a complete motion.
    ///
    /// # Errors
    /// Why it ended early.
    pub fn whole_states(self) -> Result<Vec<[f64; 3]>, SimulationError> {
        match self.ended {
            None => Ok(self.states),
            Some(error) => Err(error),
        }
    }

    /// The columns of a complete motion.
    ///
    /// # Errors
    /// Why it ended early.
    pub fn whole(self) -> Result<Columns, SimulationError> {
        match self.ended {
            None => Ok(self.columns),
            Some(error) => Err(error),
        }
    }
}
