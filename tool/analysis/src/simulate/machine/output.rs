//! Output of a machine under its motor: the columns of a row, and the state of the motor.

use jred::error::Error;
use jred::machine::motion::State;

use super::{Plant, StoredEnergy, beside_name};
use crate::simulate::clock::Moment;
use crate::simulate::drive_state::DriveState;
use crate::simulate::observe::MotorState;
use crate::simulate::run::OutputRow;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::motor::Motor;
use jred_file::number::columns::{Column, ColumnQuantity};

impl<M: Motor> Plant<'_, M> {
    /// The motor at a state, with a torque at its shaft; `asked` is the controller's request.
    fn working(
        &self,
        moment: &Moment,
        link: DriveState,
        torque: f64,
        asked: f64,
    ) -> Result<MotorState, Error> {
        let held = moment.direction == 0.0;
        let now = if held {
            None
        } else {
            Some(self.under(moment, link, torque)?)
        };
        Ok(MotorState {
            phi: link.phi,
            speed: link.omega * self.ratio(),
            torque,
            asked,
            // If friction holds the machine at rest, it may take any share.
            input_torque: now.map_or(torque * self.motor.ratio(), |now| now.input_torque),
            error: None,
        })
    }

    /// The same at a time: after the motor is switched off the torque is the brake's, and the motor has none.
    pub(in crate::simulate) fn working_at(
        &self,
        moment: &Moment,
        link: DriveState,
        torque: f64,
        asked: f64,
    ) -> Result<MotorState, Error> {
        let working = self.working(moment, link, torque, asked)?;
        let is_off = (self.simulation.halt).is_some_and(|halt| moment.t >= halt.time);
        Ok(MotorState {
            torque: if is_off { 0.0 } else { working.torque },
            asked: if is_off { 0.0 } else { working.asked },
            ..working
        })
    }

    /// The columns of a row.
    pub(crate) fn columns(&self) -> Vec<Column> {
        let [speed, acceleration] = self.axis.coordinate.rates();
        let (motor, unit) = if self.simulation.drives_a_slide(self.machines.first) {
            ("motor force", "N")
        } else {
            ("motor torque", "N m")
        };
        let coordinate = self.coordinate();
        let (inertia, inertia_unit) = (coordinate.inertia(), coordinate.inertia_unit());
        let own = [
            self.axis.column(),
            speed,
            acceleration,
            Column::new(ColumnQuantity::MotorEffort, motor, unit),
            Column::new(ColumnQuantity::ReducedInertia, inertia, inertia_unit),
        ];
        let beside = self.machines.beside().iter().enumerate();
        let positions = beside.map(|(k, machine)| {
            let column = machine.file.axis().column();
            Column::other(format!("{} {}", beside_name(k), column.name), column.unit)
        });
        own.into_iter().chain(positions).collect()
    }

    /// Coordinate of the drive link.
    fn coordinate(&self) -> Coordinate {
        self.machines.first.machine.mechanism().coordinate()
    }

    /// The row of a state with its motor torque.
    pub(in crate::simulate) fn written(
        &self,
        moment: &Moment,
        [phi, omega, alpha]: [f64; 3],
        torque: f64,
    ) -> Result<OutputRow, Error> {
        let StoredEnergy {
            inertia,
            beyond,
            potential,
        } = self.stored(moment, DriveState { phi, omega })?;
        let shown = self.axis.state(&State { phi, omega, alpha });
        let own = [
            self.axis.shown(phi),
            shown.omega,
            shown.alpha,
            torque,
            inertia,
        ];
        let beside = self.machines.beside().iter();
        let positions = beside.map(|machine| {
            let [phi, ..] = machine.state([phi, omega, alpha]);
            machine.file.axis().shown(phi)
        });
        Ok(OutputRow {
            figures: own.into_iter().chain(positions).collect(),
            kinetic: 0.5 * inertia * omega * omega,
            beyond,
            potential,
        })
    }
}
