//! What a simulation gives.

use super::SimulationError;
use super::clock::Moment;
use super::geared::Geared;
use crate::model::coordinate::Coordinate;
use crate::model::schedule::Now;
use crate::number::columns::Columns;

/// A motion, as far as it came.
#[derive(Debug)]
pub struct Simulated {
    /// A row for each output step.
    pub columns: Columns,
    /// Where the drive link came to rest first after the motor was switched off.
    pub rest: Option<Rest>,
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

/// Where and when the drive link came to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// Time since the motor was switched off (s).
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

    /// The columns with position, speed and acceleration of the drive link, whatever people speak of: for figures over its angle.
    pub fn columns_of_drive(&self, drive: Coordinate) -> Columns {
        let [speed, acceleration] = drive.rates();
        let own = [drive.column(), speed, acceleration];
        let heads = self.columns.heads();
        let is_own = |k: usize| k.checked_sub(1).filter(|k| *k < own.len());
        let heads = (heads.iter().enumerate()).map(|(k, head)| match is_own(k) {
            Some(k) => own[k].clone(),
            None => head.clone(),
        });
        let mut columns = Columns::new(heads);
        for (row, [phi, omega, alpha]) in self.columns.rows().iter().zip(&self.states) {
            let state = [drive.shown(*phi), *omega, *alpha];
            let cells = row.iter().enumerate();
            columns.push(cells.map(|(k, cell)| is_own(k).map_or(*cell, |k| Some(state[k]))));
        }
        columns
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
