//! What a simulation gives.

use super::SimulationError;
use super::clock::Moment;
use super::geared::Geared;
use crate::model::schedule::Now;
use crate::number::columns::Columns;

/// A motion, as far as it came.
#[derive(Debug)]
pub struct Simulated {
    /// A row for each output step.
    pub columns: Columns,
    /// Where the drive link came to rest to stay after the motor was switched off.
    pub rest: Option<Rest>,
    /// Where it first stood still before, and moved on because nothing held it.
    pub turned_back: Option<Rest>,
    /// Where it was when the motor was switched off (rad, or m).
    pub halted_at: Option<f64>,
    /// Where friction holds the drive link to the end, if no controller acts and the motor was not switched off: when and where it came to
    /// rest, since the start.
    pub held: Option<Rest>,
    /// What the motor gave until it was switched off, or to the end; not behind a variator.
    pub effort: Option<Effort>,
    /// Where the speed of [`Simulation::to_speed`](crate::model::simulation::Simulation::to_speed) was reached.
    pub reached: Option<Rest>,
    /// What was done in the whole turns that a machine makes whose drive link turns.
    pub turned: Option<Turned>,
    /// The impacts on end stops.
    pub impacts: Option<Impacts>,
    /// Where the motor has not driven the machine on.
    pub missing: Option<Stuck>,
    /// Where a controlled motor is at the limit of its torque.
    pub torque_limit: Option<TorqueLimit>,
    /// The largest error of a controlled machine.
    pub following: Option<Following>,
    /// φ, ω, α of the drive link in each row.
    pub states: Vec<[f64; 3]>,
    /// When that is, and which way it moves.
    pub moments: Vec<Moment>,
    /// Why the motion ends before its time.
    pub ended: Option<SimulationError>,
}

/// What a motor gives on its way: the largest magnitudes at the integrator's steps and three instants between each two of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Its largest torque (N·m), and when (s).
    pub torque: [f64; 2],
    /// Its RMS torque over the time.
    pub rms: f64,
    /// Its largest power as a motor (W), and when.
    pub power: [f64; 2],
    /// Its largest speed (rad/s), and when.
    pub speed: [f64; 2],
}

/// A time and a way, since the motor was switched off or since the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// Time since then (s).
    pub time: f64,
    /// Way since then (rad, or m).
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
    /// Whether the machine came to rest at a stop because a rebound would have been back within [`BRIEFEST_FLIGHT`], as the series of
    /// ever smaller ones has no end.
    pub settled: bool,
}

/// A rebound from an end stop that is back within this time (s) is none.
pub const BRIEFEST_FLIGHT: f64 = 1e-6;

/// Works in whole turns of the drive link, from the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned {
    /// How many turns; negative: φ falls.
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

/// Torque of a motor at rest, and what the machine needs to go on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Missing {
    /// Position (rad, or m).
    pub phi: f64,
    /// Torque that the motor gives there (N·m).
    pub given: f64,
    /// Torque that it would need (N·m).
    pub needed: f64,
}

/// Where a machine has stopped under its motor, or did not start, for the first time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stuck {
    /// Time (s).
    pub time: f64,
    /// What is missing there.
    pub missing: Missing,
}

/// A motor at the limit of its torque under a controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueLimit {
    /// Time of the first (s).
    pub time: f64,
    /// Its position (rad, or m).
    pub position: f64,
    /// How many times the limit is reached.
    pub count: u32,
    /// How long in all (s).
    pub duration: f64,
}

/// The largest following error, at the integrator's steps and three instants between each two of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Following {
    /// Its time (s).
    pub time: f64,
    /// Its position (rad, or m).
    pub position: f64,
    /// Reference less position (rad, or m).
    pub error: f64,
}

impl Simulated {
    /// For each row, the instant of a machine, and φ, ω and α of its drive link.
    pub fn states_of(&self, machine: &Geared) -> Vec<(Now, [f64; 3])> {
        let rows = self.moments.iter().zip(&self.states);
        rows.map(|(moment, state)| {
            let state = machine.state(*state);
            (moment.now(machine, state[1]), state)
        })
        .collect()
    }

    /// φ, ω, α in each row of a motion that came to its end.
    ///
    /// # Errors
    /// Why it did not.
    pub fn whole_states(self) -> Result<Vec<[f64; 3]>, SimulationError> {
        match self.ended {
            None => Ok(self.states),
            Some(error) => Err(error),
        }
    }

    /// The columns of a motion that came to its end.
    ///
    /// # Errors
    /// Why it did not.
    pub fn whole(self) -> Result<Columns, SimulationError> {
        match self.ended {
            None => Ok(self.columns),
            Some(error) => Err(error),
        }
    }
}
