//! What a simulation gives.

use super::SimulationError;
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

impl Simulated {
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
