//! A machine under a motor without a controller.

use jred::error::Error;

use super::SimulationError;
use super::clock::{Corners, Moment};
use super::coupled::CoupledMachines;
use super::drive_state::DriveState;
use super::machine::{Instant, Plant};
use super::observe::MotorState;
use super::result::TorqueDeficit;
use super::run::{self, OutputRow, SIGN_SPEED};
use jred_file::model::motor::Motor;
use jred_file::model::simulation::Simulation;
use jred_file::number::columns::Column;

/// Number of state values without payloads and carriages: φ, ω, work of the motor, work of the process loads, losses.
pub(super) const PLAIN: usize = 5;

/// The same with them: energy brought by payloads, and work of the second axes, after φ and ω.
pub(super) const WITH_GUESTS: usize = PLAIN + 2;

impl<M: Motor> Plant<'_, M> {
    /// Torque at the motor's shaft without a controller.
    fn torque(&self, moment: &Moment, omega: f64) -> f64 {
        self.halted(moment, || self.motor(omega)[0])
    }

    /// Derivatives and forces at a state and an instant.
    fn now(&self, moment: &Moment, link: DriveState) -> Result<Instant, Error> {
        self.under(moment, link, self.torque(moment, link.omega))
    }
}

/// φ and ω, the first values of a state.
pub(super) fn link_of<const N: usize>(y: &[f64; N]) -> DriveState {
    DriveState {
        phi: y[0],
        omega: y[1],
    }
}

/// Index of the two values of payloads and carriages in a state of `N` values that begins with `own` values.
pub(super) fn guests_of<const N: usize>(own: usize) -> Option<usize> {
    (N == own + 5).then_some(own)
}

/// Derivative of a state that begins with `own` values while the drive link moves; the motor's own value is left at zero.
pub(super) fn slope_in_motion<const N: usize>(now: &Instant, omega: f64, own: usize) -> [f64; N] {
    let mut slope = [0.0; N];
    (slope[0], slope[1]) = (omega, now.alpha);
    if let Some(at) = guests_of::<N>(own) {
        slope[at + 1] = now.carriage_power;
    }
    slope[N - 3] = now.motor_power;
    slope[N - 2] = now.process_power;
    slope[N - 1] = now.loss;
    slope
}

impl<M: Motor> Plant<'_, M> {
    /// The same while friction holds it.
    pub(super) fn slope_at_rest<const N: usize>(
        &self,
        moment: &Moment,
        phi: f64,
        own: usize,
    ) -> Result<[f64; N], Error> {
        let mut slope = [0.0; N];
        if let Some(at) = guests_of::<N>(own) {
            slope[at + 1] = self.held_power(moment, phi)?;
        }
        Ok(slope)
    }
}

impl<M: Motor, const N: usize> run::Plant<N> for Plant<'_, M> {
    fn start(&self) -> Result<[f64; N], Error> {
        let Simulation {
            start_angle,
            start_speed,
            ..
        } = *self.simulation;
        let mut y = [0.0; N];
        (y[0], y[1]) = (start_angle, start_speed);
        Ok(y)
    }

    fn slope(&self, moment: &Moment, y: &[f64; N]) -> Result<[f64; N], Error> {
        if moment.direction == 0.0 {
            return self.slope_at_rest(moment, y[0], 2);
        }
        let now = self.now(moment, link_of(y))?;
        Ok(slope_in_motion(&now, y[1], 2))
    }

    fn link(&self, _: f64, y: &[f64; N]) -> Result<DriveState, Error> {
        Ok(link_of(y))
    }

    fn with_link(&self, _: f64, y: &[f64; N], link: DriveState) -> Result<[f64; N], Error> {
        let mut y = *y;
        (y[0], y[1]) = (link.phi, link.omega);
        Ok(y)
    }

    fn guests(&self) -> Option<usize> {
        guests_of::<N>(2)
    }

    fn alpha(&self, moment: &Moment, y: &[f64; N]) -> Result<f64, Error> {
        Ok(self.now(moment, link_of(y))?.alpha)
    }

    fn starts(&self, moment: &Moment, y: &[f64; N]) -> Result<bool, Error> {
        Plant::starts(self, moment, |moment| {
            Ok(self.now(moment, link_of(y))?.alpha)
        })
    }

    fn check(&self, _: &Moment, _: &[f64; N]) -> Result<(), SimulationError> {
        Ok(())
    }

    fn bends(&self, moment: &Moment, y: &[f64; N]) -> Result<Vec<f64>, Error> {
        if moment.direction == 0.0 {
            return Ok(Vec::new());
        }
        self.bends_under(moment, link_of(y), self.torque(moment, y[1]))
    }

    fn corners(&self) -> Corners {
        self.changes()
    }

    fn machines(&self) -> CoupledMachines<'_> {
        self.machines.clone()
    }

    fn heads(&self) -> Vec<Column> {
        self.columns()
    }

    fn working(&self, moment: &Moment, y: &[f64; N]) -> Result<Option<MotorState>, Error> {
        let torque = self.torque(moment, y[1]);
        let working = self.working_at(moment, link_of(y), torque, torque)?;
        Ok(Some(working))
    }

    fn missing(&self, t: f64, y: &[f64; N]) -> Result<Option<TorqueDeficit>, Error> {
        let [given, _] = self.motor(0.0);
        let push = (given * self.ratio()).signum();
        let is_off = (self.simulation.halt).is_some_and(|halt| t >= halt.time);
        if given == 0.0 || is_off {
            return Ok(None);
        }
        // Both with the loads at rest and with the loads in motion.
        let sign = given.signum();
        let moments = [Moment::starting(t, push), Moment::new(t, push)];
        let mut needed = f64::NEG_INFINITY;
        for moment in moments {
            let link = DriveState {
                phi: y[0],
                omega: push * SIGN_SPEED,
            };
            needed = needed.max(sign * self.keeping(&moment, link)?);
        }
        Ok((needed > given * sign).then_some(TorqueDeficit {
            phi: y[0],
            given,
            needed: sign * needed,
        }))
    }

    fn row(&self, moment: &Moment, y: &[f64; N]) -> Result<OutputRow, Error> {
        let link = link_of(y);
        let alpha = if moment.direction == 0.0 {
            0.0
        } else {
            self.now(moment, link)?.alpha
        };
        let torque = self.torque(moment, link.omega);
        self.written(moment, [link.phi, link.omega, alpha], torque)
    }
}
