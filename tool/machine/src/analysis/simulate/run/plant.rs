//! What a simulation needs to know of a machine under its motor.

use jred::Error;

use super::Row;
use crate::analysis::simulate::SimulationError;
use crate::analysis::simulate::clock::{Corners, Moment};
use crate::analysis::simulate::geared::Together;
use crate::analysis::simulate::observe::Working;
use crate::analysis::simulate::simulated::Missing;
use crate::number::columns::Column;

/// A machine in free motion as a system of differential equations of its state y. The last three values of y are the work
/// of the motor, and of the brake after it, the work of the process loads, and the losses (J).
///
/// The direction of a [`Moment`] is the one of the drive link, which friction opposes.
pub(in crate::analysis) trait Plant<const N: usize> {
    /// The state at the start.
    fn start(&self) -> Result<[f64; N], Error>;

    /// y′ at an instant.
    fn slope(&self, moment: &Moment, y: &[f64; N]) -> Result<[f64; N], Error>;

    /// φ and ω of the drive link.
    fn link(&self, t: f64, y: &[f64; N]) -> Result<[f64; 2], Error>;

    /// The state with another φ and ω of the drive link.
    fn with_link(&self, t: f64, y: &[f64; N], link: [f64; 2]) -> Result<[f64; N], Error>;

    /// Where in y two values are those of guests: the energy that payloads have brought, and the work of the axes that move carriages (J).
    fn guests(&self) -> Option<usize> {
        None
    }

    /// α of the drive link in motion.
    fn alpha(&self, moment: &Moment, y: &[f64; N]) -> Result<f64, Error>;

    /// Whether the drive link, at rest but for a hair of speed in this direction, starts to move that way.
    fn starts(&self, moment: &Moment, y: &[f64; N]) -> Result<bool, Error> {
        Ok(self.alpha(moment, y)? * moment.direction > 0.0)
    }

    /// Refuses a state that the equations do not describe.
    fn check(&self, moment: &Moment, y: &[f64; N]) -> Result<(), SimulationError>;

    /// Times at which y′ has a corner or a jump (s): no step passes over one.
    fn corners(&self) -> Corners;

    /// What passes zero where y′ bends: no step passes over such a place. As many values at every state of one direction, each as a share of what
    /// it is made of.
    fn bends(&self, moment: &Moment, y: &[f64; N]) -> Result<Vec<f64>, Error>;

    /// The machines that move.
    fn machines(&self) -> Together<'_>;

    /// What the motor does, if there is one to look at.
    fn working(&self, _moment: &Moment, _y: &[f64; N]) -> Result<Option<Working>, Error> {
        Ok(None)
    }

    /// What is missing for the motor to drive the machine on from rest at a time, where it has no controller.
    fn missing(&self, _t: f64, _y: &[f64; N]) -> Result<Option<Missing>, Error> {
        Ok(None)
    }

    /// The columns of the figures of a [`Row`].
    fn heads(&self) -> Vec<Column>;

    /// What is written about a state.
    fn row(&self, moment: &Moment, y: &[f64; N]) -> Result<Row, Error>;
}
