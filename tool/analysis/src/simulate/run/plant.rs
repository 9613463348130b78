//! Interface of a machine under its motor for a simulation.

use jred::error::Error;

use super::OutputRow;
use crate::simulate::SimulationError;
use crate::simulate::clock::{Corners, Moment};
use crate::simulate::coupled::CoupledMachines;
use crate::simulate::drive_state::DriveState;
use crate::simulate::observe::MotorState;
use crate::simulate::result::TorqueDeficit;
use jred_file::number::columns::Column;

/// A machine in free motion as a system of differential equations of its state y. The last three values of y are the work of the motor (and then of
/// the brake), the work of the process loads, and the losses (J).
///
/// The direction of a [`Moment`] is that of the drive link, which friction opposes.
pub(crate) trait Plant<const N: usize> {
    /// The state at the start.
    fn start(&self) -> Result<[f64; N], Error>;

    /// y′ at an instant.
    fn slope(&self, moment: &Moment, y: &[f64; N]) -> Result<[f64; N], Error>;

    /// φ and ω of the drive link.
    fn link(&self, t: f64, y: &[f64; N]) -> Result<DriveState, Error>;

    /// The state with another φ and ω of the drive link.
    fn with_link(&self, t: f64, y: &[f64; N], link: DriveState) -> Result<[f64; N], Error>;

    /// Index in y of two values for payloads and carriages: the energy that payloads have brought, and the work of the axes that move carriages (J).
    fn guests(&self) -> Option<usize> {
        None
    }

    /// α of the drive link in motion.
    fn alpha(&self, moment: &Moment, y: &[f64; N]) -> Result<f64, Error>;

    /// Whether the drive link starts in this direction from rest, evaluated at the smallest speed that way.
    fn starts(&self, moment: &Moment, y: &[f64; N]) -> Result<bool, Error> {
        Ok(self.alpha(moment, y)? * moment.direction > 0.0)
    }

    /// Refuses a state for which the equations are not valid.
    fn check(&self, moment: &Moment, y: &[f64; N]) -> Result<(), SimulationError>;

    /// Times at which y′ has a corner or a jump (s): no step crosses one.
    fn corners(&self) -> Corners;

    /// Values that pass zero where y′ bends: no step crosses such a place. The number of values is the same at every state of one direction, and each
    /// is relative to its terms.
    fn bends(&self, moment: &Moment, y: &[f64; N]) -> Result<Vec<f64>, Error>;

    /// The simulated machines.
    fn machines(&self) -> CoupledMachines<'_>;

    /// The state of the motor, if there is one to observe.
    fn working(&self, _moment: &Moment, _y: &[f64; N]) -> Result<Option<MotorState>, Error> {
        Ok(None)
    }

    /// The torque missing for the motor to drive the machine from rest at a time, if it has no controller.
    fn missing(&self, _t: f64, _y: &[f64; N]) -> Result<Option<TorqueDeficit>, Error> {
        Ok(None)
    }

    /// The columns of the figures of an [`OutputRow`].
    fn heads(&self) -> Vec<Column>;

    /// The output for a state.
    fn row(&self, moment: &Moment, y: &[f64; N]) -> Result<OutputRow, Error>;
}
