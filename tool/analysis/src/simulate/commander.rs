//! A machine whose motor has its own state besides φ and ω: the integral of a controller, or the current of a winding.

use jred::error::Error;

use super::SimulationError;
use super::clock::{Corners, Moment};
use super::coupled::CoupledMachines;
use super::drive_state::DriveState;
use super::free::{PLAIN, WITH_GUESTS, guests_of, link_of, slope_in_motion};
use super::machine::{Instant, Plant};
use super::observe::MotorState;
use super::result::TorqueDeficit;
use super::run::{self, OutputRow};
use jred_file::model::motor::Motor;
use jred_file::number::columns::Column;

/// Number of state values without payloads and carriages: φ, ω, the state of the motor, and the works.
pub(super) const COMMANDED: usize = PLAIN + 1;

/// The same with payloads and carriages.
pub(super) const COMMANDED_WITH_GUESTS: usize = WITH_GUESTS + 1;

/// The motor at a state.
pub(super) struct Command {
    /// Its torque.
    pub(super) torque: f64,
    /// Its torque without limits.
    pub(super) asked: f64,
    /// Rate of its own state.
    pub(super) rate: f64,
}

/// Commands the torque of a motor at φ, ω and its own state, which is 0 at the start.
pub(super) trait Commander<M> {
    /// The torque, while the motor is on.
    fn command(&self, plant: &Plant<M>, t: f64, state: [f64; 3]) -> Result<Command, Error>;

    /// The column that it adds.
    fn column(&self) -> Column;

    /// The column's value; `on`: the motor is not switched off.
    fn figure(&self, plant: &Plant<M>, t: f64, state: [f64; 3], on: bool) -> f64;

    /// Reference less position, if there is a reference.
    fn error(&self, _plant: &Plant<M>, _t: f64, _phi: f64) -> Option<f64> {
        None
    }

    /// Values that pass zero where the torque bends, as in [`run::Plant::bends`].
    fn bends(&self, _plant: &Plant<M>, _t: f64, _state: [f64; 3]) -> Result<Vec<f64>, Error> {
        Ok(Vec::new())
    }

    /// Adds the times at which the torque has a corner.
    fn corners(&self, _plant: &Plant<M>, others: Corners) -> Corners {
        others
    }

    /// Whether the torque at rest settles at the motor's characteristic.
    fn settles(&self) -> bool;
}

/// The machine, its motor, and the commander.
pub(super) struct CommandedPlant<'a, M, C> {
    pub(super) plant: Plant<'a, M>,
    pub(super) commander: C,
}

impl<M: Motor, C: Commander<M>> CommandedPlant<'_, M, C> {
    /// The torque at the motor shaft: of the motor or, once it is switched off, of the brake.
    fn torque(&self, moment: &Moment, y: [f64; 3]) -> Result<Command, Error> {
        if self.is_off(moment.t) {
            let brake = self.plant.halted(moment, || 0.0);
            return Ok(Command {
                torque: brake,
                asked: brake,
                rate: 0.0,
            });
        }
        self.commander.command(&self.plant, moment.t, y)
    }

    /// Whether the motor has been switched off.
    fn is_off(&self, t: f64) -> bool {
        (self.plant.simulation.halt).is_some_and(|halt| t >= halt.time)
    }

    fn now<const N: usize>(&self, moment: &Moment, y: &[f64; N]) -> Result<(Instant, f64), Error> {
        let Command { torque, rate, .. } = self.torque(moment, commanded(y))?;
        Ok((self.plant.under(moment, link_of(y), torque)?, rate))
    }
}

/// φ, ω and the state of the motor.
fn commanded<const N: usize>(y: &[f64; N]) -> [f64; 3] {
    [y[0], y[1], y[2]]
}

impl<M: Motor, C: Commander<M>, const N: usize> run::Plant<N> for CommandedPlant<'_, M, C> {
    fn start(&self) -> Result<[f64; N], Error> {
        run::Plant::<N>::start(&self.plant)
    }

    fn slope(&self, moment: &Moment, y: &[f64; N]) -> Result<[f64; N], Error> {
        if moment.direction == 0.0 {
            // The motor's state continues to change until the machine breaks away.
            let Command { rate, .. } = self.torque(moment, commanded(y))?;
            let mut slope = self.plant.slope_at_rest(moment, y[0], 3)?;
            slope[2] = rate;
            return Ok(slope);
        }
        let (now, rate) = self.now(moment, y)?;
        let mut slope = slope_in_motion(&now, y[1], 3);
        slope[2] = rate;
        Ok(slope)
    }

    fn link(&self, _: f64, y: &[f64; N]) -> Result<DriveState, Error> {
        Ok(link_of(y))
    }

    fn with_link(&self, t: f64, y: &[f64; N], link: DriveState) -> Result<[f64; N], Error> {
        run::Plant::<N>::with_link(&self.plant, t, y, link)
    }

    fn guests(&self) -> Option<usize> {
        guests_of::<N>(3)
    }

    fn alpha(&self, moment: &Moment, y: &[f64; N]) -> Result<f64, Error> {
        Ok(self.now(moment, y)?.0.alpha)
    }

    fn starts(&self, moment: &Moment, y: &[f64; N]) -> Result<bool, Error> {
        self.plant.starts(moment, |moment| self.alpha(moment, y))
    }

    fn check(&self, _: &Moment, _: &[f64; N]) -> Result<(), SimulationError> {
        Ok(())
    }

    fn bends(&self, moment: &Moment, y: &[f64; N]) -> Result<Vec<f64>, Error> {
        let mut bends = Vec::new();
        if !self.is_off(moment.t) {
            bends = self.commander.bends(&self.plant, moment.t, commanded(y))?;
        }
        if moment.direction != 0.0 {
            let Command { torque, .. } = self.torque(moment, commanded(y))?;
            bends.extend(self.plant.bends_under(moment, link_of(y), torque)?);
        }
        Ok(bends)
    }

    fn corners(&self) -> Corners {
        self.commander.corners(&self.plant, self.plant.changes())
    }

    fn machines(&self) -> CoupledMachines<'_> {
        self.plant.machines.clone()
    }

    fn heads(&self) -> Vec<Column> {
        let own = self.plant.columns().into_iter();
        own.chain([self.commander.column()]).collect()
    }

    fn working(&self, moment: &Moment, y: &[f64; N]) -> Result<Option<MotorState>, Error> {
        let Command { torque, asked, .. } = self.torque(moment, commanded(y))?;
        let working = (self.plant).working_at(moment, link_of(y), torque, asked)?;
        let on = !self.is_off(moment.t);
        Ok(Some(MotorState {
            error: (self.commander.error(&self.plant, moment.t, y[0])).filter(|_| on),
            ..working
        }))
    }

    fn missing(&self, t: f64, y: &[f64; N]) -> Result<Option<TorqueDeficit>, Error> {
        if self.commander.settles() {
            run::Plant::<N>::missing(&self.plant, t, y)
        } else {
            Ok(None)
        }
    }

    fn row(&self, moment: &Moment, y: &[f64; N]) -> Result<OutputRow, Error> {
        let alpha = if moment.direction == 0.0 {
            0.0
        } else {
            self.alpha(moment, y)?
        };
        let Command { torque, .. } = self.torque(moment, commanded(y))?;
        let mut row = self.plant.written(moment, [y[0], y[1], alpha], torque)?;
        let on = !self.is_off(moment.t);
        let figure = (self.commander).figure(&self.plant, moment.t, commanded(y), on);
        row.figures.push(figure);
        Ok(row)
    }
}
