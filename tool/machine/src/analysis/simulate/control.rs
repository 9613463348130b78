//! A machine whose motor follows the motion of the file under a cascade of controllers.

use jred::machine::motion::State as Reference;
use jred::{Error, Reducible as _};

use super::SimulationError;
use super::geared::Together;
use super::machine::{Instant, Plant};
use super::observe::Working;
use super::run::{self, Row};
use crate::model::axis::Axis;
use crate::model::coordinate::whole_range;
use crate::model::machine::MachineFile;
use crate::model::motion::Motion;
use crate::model::motor::Motor;
use crate::model::simulation::{Control, FeedForward, Simulation};
use crate::number::columns::Column;

/// φ, ω, integral of the speed controller (N·m), work of the motor, work of the process loads, losses.
type State = [f64; 6];

/// Positions from which the mean inertia is taken.
const POSITIONS: usize = 720;

/// The machine, its motor, the controller and its reference.
pub(super) struct Controlled<'a, M> {
    plant: Plant<'a, M>,
    simulation: &'a Simulation,
    control: Control,
    motion: &'a Motion,
    axis: Axis,
    /// By how much the position advances in a cycle of the reference.
    advance: f64,
    /// Of each machine, at its drive link.
    mean_inertia: Vec<f64>,
}

/// What the controller does at a state.
struct Command {
    /// Torque of the motor.
    torque: f64,
    /// What it would be without limits.
    asked: f64,
    /// z′.
    integral_rate: f64,
}

impl<'a, M: Motor> Controlled<'a, M> {
    pub(super) fn new(
        machines: Together<'a>,
        simulation: &'a Simulation,
        control: Control,
        motion: &'a Motion,
        motor: M,
    ) -> Result<Self, Error> {
        let mean_inertia = match control.feed_forward {
            FeedForward::MeanInertia => machines.all().map(|machine| mean(machine.file)).collect(),
            FeedForward::None | FeedForward::Model => Ok(Vec::new()),
        };
        let mean_inertia: Vec<f64> = mean_inertia?;
        let axis = machines.first.axis();
        let plant = Plant::new(machines, simulation, motor);
        Ok(Self {
            plant,
            simulation,
            control,
            motion,
            axis,
            advance: motion.at(motion.duration()).phi - motion.at(0.0).phi,
            mean_inertia,
        })
    }

    /// The motion of the file at the time `t`: repeated if it is cyclic, else at rest behind its end.
    fn reference(&self, t: f64) -> Reference<f64> {
        let duration = self.motion.duration();
        if self.motion.cyclic {
            let cycles = (t / duration).floor();
            let state = self.motion.at(t - cycles * duration);
            return Reference {
                phi: state.phi + cycles * self.advance,
                ..state
            };
        }
        let state = self.motion.at(t.min(duration));
        if t < duration {
            return state;
        }
        Reference {
            omega: 0.0,
            alpha: 0.0,
            ..state
        }
    }

    /// T_ff.
    fn feed_forward(&self, reference: &Reference<f64>) -> Result<f64, Error> {
        let Reference {
            phi, omega, alpha, ..
        } = *reference;
        let direction = if omega == 0.0 { 0.0 } else { omega.signum() };
        match self.control.feed_forward {
            FeedForward::None => Ok(0.0),
            FeedForward::MeanInertia => {
                let inertias = &self.mean_inertia;
                Ok(self.plant.accelerating(direction, [omega, alpha], inertias))
            }
            FeedForward::Model => self.plant.required(direction, [phi, omega, alpha]),
        }
    }

    fn command(&self, t: f64, y: &State) -> Result<Command, Error> {
        let [phi, omega, integral, ..] = *y;
        let reference = self.reference(t);
        let ratio = self.plant.ratio();
        let gain = self.control.position_gain;
        let wanted = reference.omega + gain * (reference.phi - phi);
        let push = self.control.speed_gain * (wanted - omega) * ratio;
        let asked = self.feed_forward(&reference)? + push + integral;
        let [least, most] = self.plant.motor.limits(omega * ratio);
        let torque = asked.max(least).min(most);
        Ok(Command {
            torque,
            asked,
            integral_rate: (push + torque - asked) / self.control.integral_time,
        })
    }

    /// Torque at the motor shaft, of the motor or, once it is switched off, of the brake; what is asked for; z′.
    fn torque(&self, direction: f64, t: f64, y: &State) -> Result<[f64; 3], Error> {
        let command = self.command(t, y)?;
        let on = self.simulation.halt.is_none_or(|halt| t < halt.time);
        if on {
            return Ok([command.torque, command.asked, command.integral_rate]);
        }
        let brake = self.plant.halted(t, direction, || 0.0);
        Ok([brake, brake, 0.0])
    }

    fn now(&self, direction: f64, t: f64, y: &State) -> Result<(Instant, f64), Error> {
        let [torque, _, rate] = self.torque(direction, t, y)?;
        Ok((self.plant.under(direction, [y[0], y[1]], torque)?, rate))
    }
}

/// The mean of a machine's inertia over its range.
fn mean(file: &MachineFile) -> Result<f64, Error> {
    let places: Vec<f64> = whole_range(file.machine.domain(), POSITIONS).collect();
    let mut sum = 0.0;
    for phi in &places {
        sum += file.machine.bare_reduction(*phi)?.inertia;
    }
    Ok(sum / places.len() as f64)
}

impl<M: Motor> run::Plant<6> for Controlled<'_, M> {
    fn start(&self) -> Result<State, Error> {
        let Simulation {
            start_angle,
            start_speed,
            ..
        } = *self.simulation;
        Ok([start_angle, start_speed, 0.0, 0.0, 0.0, 0.0])
    }

    fn slope(&self, direction: f64, t: f64, y: &State) -> Result<State, Error> {
        if direction == 0.0 {
            // The integral rises until the motor breaks away.
            let [_, _, rate] = self.torque(direction, t, y)?;
            return Ok([0.0, 0.0, rate, 0.0, 0.0, 0.0]);
        }
        let (now, rate) = self.now(direction, t, y)?;
        let works = [now.motor_power, now.process_power, now.loss];
        Ok([y[1], now.alpha, rate, works[0], works[1], works[2]])
    }

    fn link(&self, _: f64, y: &State) -> Result<[f64; 2], Error> {
        Ok([y[0], y[1]])
    }

    fn with_link(&self, _: f64, y: &State, [phi, omega]: [f64; 2]) -> Result<State, Error> {
        Ok([phi, omega, y[2], y[3], y[4], y[5]])
    }

    fn alpha(&self, direction: f64, t: f64, y: &State) -> Result<f64, Error> {
        Ok(self.now(direction, t, y)?.0.alpha)
    }

    fn check(&self, _: f64, _: f64, _: &State) -> Result<(), SimulationError> {
        Ok(())
    }

    fn corners(&self) -> Vec<f64> {
        let duration = self.motion.duration();
        let end = self.simulation.duration;
        let cycles = if self.motion.cyclic {
            end / duration
        } else {
            0.0
        };
        let starts = (0..=cycles as u32).map(|k| f64::from(k) * duration);
        let stretches = self.motion.stretches();
        let ends = starts.flat_map(|start| stretches.iter().map(move |(_, end)| start + end));
        ends.chain(self.plant.halts()).collect()
    }

    fn machines(&self) -> Together<'_> {
        self.plant.machines.clone()
    }

    fn heads(&self) -> Vec<Column> {
        let own = self.plant.columns().into_iter();
        let position = self.axis.column();
        let error = format!("{} error", position.name);
        own.chain([Column::other(error, position.unit)]).collect()
    }

    fn working(&self, direction: f64, t: f64, y: &State) -> Result<Option<Working>, Error> {
        let [torque, asked, _] = self.torque(direction, t, y)?;
        let link = [y[0], y[1]];
        let working = (self.plant).working_at(t, direction, link, [torque, asked])?;
        let on = self.simulation.halt.is_none_or(|halt| t < halt.time);
        Ok(Some(Working {
            error: on.then(|| self.reference(t).phi - y[0]),
            ..working
        }))
    }

    fn row(&self, direction: f64, t: f64, y: &State) -> Result<Row, Error> {
        let alpha = if direction == 0.0 {
            0.0
        } else {
            self.alpha(direction, t, y)?
        };
        let [torque, ..] = self.torque(direction, t, y)?;
        let mut row = self.plant.written([y[0], y[1], alpha], torque)?;
        let reference = self.axis.shown(self.reference(t).phi);
        row.figures.push(reference - self.axis.shown(y[0]));
        Ok(row)
    }
}
