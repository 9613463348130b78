//! A machine whose motor follows the motion of the file under a cascade of controllers.

use jred::machine::motion::State as Reference;
use jred::{Error, Reducible as _};

use super::SimulationError;
use super::clock::{Clock, Corners, Moment};
use super::free::{PLAIN, WITH_GUESTS, guests_of};
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

/// Values of a state without payloads and carriages: φ, ω, integral of the speed controller (N·m), and what follows ω without a controller.
pub(super) const CONTROLLED: usize = PLAIN + 1;

/// With them.
pub(super) const CONTROLLED_WITH_GUESTS: usize = WITH_GUESTS + 1;

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
        let (cycles, time) = Clock::of(self.plant.machines.first).split(t);
        let state = self.motion.at(time.min(duration));
        if time >= duration && !self.motion.cyclic {
            return Reference {
                omega: 0.0,
                alpha: 0.0,
                ..state
            };
        }
        Reference {
            phi: state.phi + cycles * self.advance,
            ..state
        }
    }

    /// T_ff.
    fn feed_forward(&self, t: f64, reference: &Reference<f64>) -> Result<f64, Error> {
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
            FeedForward::Model => {
                let moment = Moment::new(t, direction);
                self.plant.required(&moment, [phi, omega, alpha])
            }
        }
    }

    fn command(&self, t: f64, [phi, omega, integral]: [f64; 3]) -> Result<Command, Error> {
        let reference = self.reference(t);
        let ratio = self.plant.ratio();
        let gain = self.control.position_gain;
        let wanted = reference.omega + gain * (reference.phi - phi);
        let push = self.control.speed_gain * (wanted - omega) * ratio;
        let asked = self.feed_forward(t, &reference)? + push + integral;
        let [least, most] = self.plant.motor.limits(omega * ratio);
        let torque = asked.max(least).min(most);
        Ok(Command {
            torque,
            asked,
            integral_rate: (push + torque - asked) / self.control.integral_time,
        })
    }

    /// Torque at the motor shaft, of the motor or, once it is switched off, of the brake; what is asked for; z′.
    fn torque(&self, moment: &Moment, y: [f64; 3]) -> Result<[f64; 3], Error> {
        let command = self.command(moment.t, y)?;
        if !self.is_off(moment.t) {
            return Ok([command.torque, command.asked, command.integral_rate]);
        }
        let brake = self.plant.halted(moment, || 0.0);
        Ok([brake, brake, 0.0])
    }

    /// Whether the motor has been switched off.
    fn is_off(&self, t: f64) -> bool {
        self.simulation.halt.is_some_and(|halt| t >= halt.time)
    }

    fn now(&self, moment: &Moment, y: [f64; 3]) -> Result<(Instant, f64), Error> {
        let [torque, _, rate] = self.torque(moment, y)?;
        Ok((self.plant.under(moment, [y[0], y[1]], torque)?, rate))
    }
}

/// φ, ω and the integral.
fn controlled<const N: usize>(y: &[f64; N]) -> [f64; 3] {
    [y[0], y[1], y[2]]
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

impl<M: Motor, const N: usize> run::Plant<N> for Controlled<'_, M> {
    fn start(&self) -> Result<[f64; N], Error> {
        run::Plant::<N>::start(&self.plant)
    }

    fn slope(&self, moment: &Moment, y: &[f64; N]) -> Result<[f64; N], Error> {
        let mut slope = [0.0; N];
        let guests = guests_of::<N>(3);
        if moment.direction == 0.0 {
            // The integral rises until the motor breaks away.
            [.., slope[2]] = self.torque(moment, controlled(y))?;
            if let Some(at) = guests {
                slope[at + 1] = self.plant.held_power(moment, y[0])?;
            }
            return Ok(slope);
        }
        let (now, rate) = self.now(moment, controlled(y))?;
        (slope[0], slope[1], slope[2]) = (y[1], now.alpha, rate);
        if let Some(at) = guests {
            slope[at + 1] = now.carriage_power;
        }
        slope[N - 3] = now.motor_power;
        slope[N - 2] = now.process_power;
        slope[N - 1] = now.loss;
        Ok(slope)
    }

    fn link(&self, _: f64, y: &[f64; N]) -> Result<[f64; 2], Error> {
        Ok([y[0], y[1]])
    }

    fn with_link(&self, t: f64, y: &[f64; N], link: [f64; 2]) -> Result<[f64; N], Error> {
        run::Plant::<N>::with_link(&self.plant, t, y, link)
    }

    fn guests(&self) -> Option<usize> {
        guests_of::<N>(3)
    }

    fn alpha(&self, moment: &Moment, y: &[f64; N]) -> Result<f64, Error> {
        Ok(self.now(moment, controlled(y))?.0.alpha)
    }

    fn starts(&self, moment: &Moment, y: &[f64; N]) -> Result<bool, Error> {
        self.plant.starts(moment, |moment| self.alpha(moment, y))
    }

    fn check(&self, _: &Moment, _: &[f64; N]) -> Result<(), SimulationError> {
        Ok(())
    }

    fn corners(&self) -> Corners {
        let clock = Clock::of(self.plant.machines.first);
        let ends = self.motion.stretches().into_iter().map(|(_, end)| end);
        self.plant.changes().by(clock, ends)
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

    fn working(&self, moment: &Moment, y: &[f64; N]) -> Result<Option<Working>, Error> {
        let [torque, asked, _] = self.torque(moment, controlled(y))?;
        let working = (self.plant).working_at(moment, [y[0], y[1]], [torque, asked])?;
        let on = !self.is_off(moment.t);
        Ok(Some(Working {
            error: on.then(|| self.reference(moment.t).phi - y[0]),
            ..working
        }))
    }

    fn row(&self, moment: &Moment, y: &[f64; N]) -> Result<Row, Error> {
        let alpha = if moment.direction == 0.0 {
            0.0
        } else {
            self.alpha(moment, y)?
        };
        let [torque, ..] = self.torque(moment, controlled(y))?;
        let mut row = self.plant.written(moment, [y[0], y[1], alpha], torque)?;
        let reference = self.axis.shown(self.reference(moment.t).phi);
        row.figures.push(reference - self.axis.shown(y[0]));
        Ok(row)
    }
}
