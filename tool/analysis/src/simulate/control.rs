//! A cascade of controllers, under which the motor follows the motion of the file.

use jred::error::Error;
use jred::machine::Reducible as _;
use jred::machine::motion::State as Reference;

use super::clock::{Clock, Corners, Moment};
use super::commander::{Command, Commander};
use super::coupled::CoupledMachines;
use super::machine::Plant;
use jred_file::model::axis::Axis;
use jred_file::model::coordinate::whole_range;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_file::model::motor::Motor;
use jred_file::model::simulation::{Control, FeedForward};
use jred_file::number::columns::{Column, ColumnQuantity};
use jred_file::number::numerics::sign;

/// Positions over which the inertia is averaged.
const POSITIONS: usize = 720;

/// The controller and its reference.
pub(super) struct Cascade<'a> {
    control: Control,
    motion: &'a Motion,
    axis: Axis,
    /// Advance of the position per cycle of the reference.
    advance: f64,
    /// Of each machine, at its drive link.
    mean_inertia: Vec<f64>,
}

impl<'a> Cascade<'a> {
    pub(super) fn new(
        machines: &CoupledMachines,
        control: Control,
        motion: &'a Motion,
    ) -> Result<Self, Error> {
        let mean_inertia = match control.feed_forward {
            FeedForward::MeanInertia => machines.all().map(|machine| mean(machine.file)).collect(),
            FeedForward::None | FeedForward::Model => Ok(Vec::new()),
        };
        Ok(Self {
            control,
            motion,
            axis: machines.first.axis(),
            advance: motion.at(motion.duration()).phi - motion.at(0.0).phi,
            mean_inertia: mean_inertia?,
        })
    }

    /// The motion of the file at the time `t`: repeated if it is cyclic, else at rest after its end.
    fn reference(&self, file: &MachineFile, t: f64) -> Reference<f64> {
        let duration = self.motion.duration();
        let (cycles, time) = Clock::of(file).split(t);
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
    fn feed_forward<M: Motor>(
        &self,
        plant: &Plant<M>,
        t: f64,
        reference: &Reference<f64>,
    ) -> Result<f64, Error> {
        let Reference {
            phi, omega, alpha, ..
        } = *reference;
        match self.control.feed_forward {
            FeedForward::None => Ok(0.0),
            FeedForward::MeanInertia => Ok(plant.accelerating(alpha, &self.mean_inertia)),
            FeedForward::Model => {
                let moment = Moment::new(t, sign(omega));
                plant.required(&moment, [phi, omega, alpha])
            }
        }
    }
}

impl<M: Motor> Commander<M> for Cascade<'_> {
    fn command(
        &self,
        plant: &Plant<M>,
        t: f64,
        [phi, omega, integral]: [f64; 3],
    ) -> Result<Command, Error> {
        let reference = self.reference(plant.machines.first, t);
        let ratio = plant.ratio();
        let gain = self.control.position_gain;
        let wanted = reference.omega + gain * (reference.phi - phi);
        let push = self.control.speed_gain * (wanted - omega) * ratio;
        let asked = self.feed_forward(plant, t, &reference)? + push + integral;
        let [least, most] = plant.motor.limits(omega * ratio);
        let torque = asked.max(least).min(most);
        Ok(Command {
            torque,
            asked,
            rate: (push + torque - asked) / self.control.integral_time,
        })
    }

    fn column(&self) -> Column {
        let position = self.axis.column();
        let error = format!("{} error", position.name);
        Column::new(ColumnQuantity::FollowingError, error, position.unit)
    }

    fn figure(&self, plant: &Plant<M>, t: f64, [phi, ..]: [f64; 3], _: bool) -> f64 {
        let reference = self.reference(plant.machines.first, t);
        self.axis.shown(reference.phi) - self.axis.shown(phi)
    }

    fn error(&self, plant: &Plant<M>, t: f64, phi: f64) -> Option<f64> {
        Some(self.reference(plant.machines.first, t).phi - phi)
    }

    fn bends(&self, plant: &Plant<M>, t: f64, state: [f64; 3]) -> Result<Vec<f64>, Error> {
        let [_, omega, _] = state;
        let Command { asked, .. } = Commander::<M>::command(self, plant, t, state)?;
        let [least, most] = plant.motor.limits(omega * plant.ratio());
        let size = f64::MIN_POSITIVE + asked.abs() + least.abs() + most.abs();
        let mut bends = vec![(asked - least) / size, (most - asked) / size];
        if self.control.feed_forward == FeedForward::Model {
            let reference = self.reference(plant.machines.first, t);
            let moment = Moment::new(t, sign(reference.omega));
            let state = [reference.phi, reference.omega, reference.alpha];
            bends.extend(plant.bends_required(&moment, state)?);
        }
        Ok(bends)
    }

    fn corners(&self, plant: &Plant<M>, others: Corners) -> Corners {
        let clock = Clock::of(plant.machines.first);
        let ends = self.motion.stretches().into_iter().map(|(_, end)| end);
        others.by(clock, ends)
    }

    fn settles(&self) -> bool {
        false
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
