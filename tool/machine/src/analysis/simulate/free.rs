//! A machine under a motor without a controller.

use jred::Error;

use super::SimulationError;
use super::geared::Together;
use super::machine::{Instant, Plant, State};
use super::observe::Working;
use super::run::{self, HAIR, Row};
use super::simulated::Missing;
use crate::model::motor::Motor;
use crate::model::simulation::Simulation;
use crate::number::columns::Column;

impl<M: Motor> Plant<'_, M> {
    /// The torque at the motor's shaft without a controller.
    fn torque(&self, t: f64, direction: f64, omega: f64) -> f64 {
        self.halted(t, direction, || self.motor(omega)[0])
    }

    /// What happens at a state at the time `t`.
    fn now(&self, direction: f64, t: f64, [phi, omega, ..]: &State) -> Result<Instant, Error> {
        self.under(direction, [*phi, *omega], self.torque(t, direction, *omega))
    }
}

impl<M: Motor> run::Plant<5> for Plant<'_, M> {
    fn start(&self) -> Result<State, Error> {
        let Simulation {
            start_angle,
            start_speed,
            ..
        } = *self.simulation;
        Ok([start_angle, start_speed, 0.0, 0.0, 0.0])
    }

    fn slope(&self, direction: f64, t: f64, y: &State) -> Result<State, Error> {
        if direction == 0.0 {
            return Ok([0.0; 5]);
        }
        let now = self.now(direction, t, y)?;
        Ok([
            y[1],
            now.alpha,
            now.motor_power,
            now.process_power,
            now.loss,
        ])
    }

    fn link(&self, _: f64, y: &State) -> Result<[f64; 2], Error> {
        Ok([y[0], y[1]])
    }

    fn with_link(&self, _: f64, y: &State, [phi, omega]: [f64; 2]) -> Result<State, Error> {
        Ok([phi, omega, y[2], y[3], y[4]])
    }

    fn alpha(&self, direction: f64, t: f64, y: &State) -> Result<f64, Error> {
        Ok(self.now(direction, t, y)?.alpha)
    }

    fn check(&self, _: f64, _: f64, _: &State) -> Result<(), SimulationError> {
        Ok(())
    }

    fn corners(&self) -> Vec<f64> {
        self.halts()
    }

    fn machines(&self) -> Together<'_> {
        self.machines.clone()
    }

    fn heads(&self) -> Vec<Column> {
        self.columns()
    }

    fn working(&self, direction: f64, t: f64, y: &State) -> Result<Option<Working>, Error> {
        let torque = self.torque(t, direction, y[1]);
        let working = self.working_at(t, direction, [y[0], y[1]], [torque; 2])?;
        Ok(Some(working))
    }

    fn missing(&self, y: &State) -> Result<Option<Missing>, Error> {
        let [given, _] = self.motor(0.0);
        let push = (given * self.ratio()).signum();
        if given == 0.0 || self.simulation.halt.is_some() {
            return Ok(None);
        }
        let needed = self.keeping(push, [y[0], push * HAIR])?;
        let sign = given.signum();
        Ok((needed * sign > given * sign).then_some(Missing {
            phi: y[0],
            given,
            needed,
        }))
    }

    fn row(&self, direction: f64, t: f64, y: &State) -> Result<Row, Error> {
        let alpha = if direction == 0.0 {
            0.0
        } else {
            self.alpha(direction, t, y)?
        };
        let [phi, omega, ..] = *y;
        self.written([phi, omega, alpha], self.torque(t, direction, omega))
    }
}
