//! One or several machines that a motor drives through fixed ratios.

mod bends;
mod output;

use jred::error::Error;
use jred::mechanism::{TrainInput, TrainOutput};

use super::clock::{Corners, Moment};
use super::coupled::{CoupledMachines, GearedMachine};
use super::drive_state::DriveState;
use super::point::{ReducedLink, ReducedLinks};
use bends::Bends;
use jred_file::model::axis::Axis;
use jred_file::model::motor::{Motor, loads_of};
use jred_file::model::simulation::{Shaft, Simulation};
use jred_file::number::numerics::{newton, sign};

/// The machine with its drive and motor torque.
pub(crate) struct Plant<'a, M> {
    pub(super) machines: CoupledMachines<'a>,
    pub(super) simulation: &'a Simulation,
    pub(crate) motor: M,
    axis: Axis,
    /// Ends of the drive link's travel.
    ends: Option<[f64; 2]>,
    bends: Bends,
}

/// Derivatives and forces at one state.
pub(crate) struct Instant {
    pub(crate) alpha: f64,
    pub(crate) motor_torque: f64,
    /// Torque at the input of the drive train, behind the motor's gearbox.
    pub(crate) input_torque: f64,
    pub(crate) motor_power: f64,
    pub(crate) process_power: f64,
    /// Power of the second axes that move carriages.
    pub(super) carriage_power: f64,
    pub(crate) loss: f64,
}

/// The energy of the machines, their drive trains and the motor.
pub(super) struct StoredEnergy {
    /// Inertia of all machines at the first drive link.
    pub(super) inertia: f64,
    /// Kinetic energy beyond ½·J·ω²: that of carriages along their guides (J).
    pub(super) beyond: f64,
    /// Potential energy (J).
    pub(super) potential: f64,
}

/// Motor effort for a torque at the drive link during a motion.
struct InputEffort {
    torque: f64,
    /// Its derivative by α.
    per_alpha: f64,
    /// Torque at the input of the drive train.
    input_torque: f64,
    loss: f64,
}

/// Name of a machine besides the first in columns; the first of them has the index 0.
pub fn beside_name(index: usize) -> String {
    format!("machine {}", index + 2)
}

impl<'a, M: Motor> Plant<'a, M> {
    pub(crate) fn new(machines: CoupledMachines<'a>, simulation: &'a Simulation, motor: M) -> Self {
        Self {
            axis: machines.first.axis(),
            ends: simulation.ends(machines.first),
            bends: Bends::of(&machines, &motor),
            machines,
            simulation,
            motor,
        }
    }

    /// Speed of the shaft at which the motor torque acts, per speed of the drive link.
    pub(crate) fn ratio(&self) -> f64 {
        match self.simulation.at {
            Shaft::Motor => self.machines.first.drive_train.ratio() * self.motor.ratio(),
            Shaft::DriveLink => 1.0,
        }
    }

    /// Motor torque, and the speed of the shaft at which it acts.
    pub(crate) fn motor(&self, omega: f64) -> [f64; 2] {
        let speed = omega * self.ratio();
        [self.motor.torque(speed), speed]
    }

    /// The effort of the motor in front of the drive trains, at these speeds and accelerations of the first drive link, if each machine has this
    /// torque and inertia at its own drive link.
    fn through(
        &self,
        direction: f64,
        [omega, alpha]: [f64; 2],
        loads: impl IntoIterator<Item = (GearedMachine<'a>, [f64; 2])>,
    ) -> InputEffort {
        let mut input = TrainInput::default();
        for (machine, [torque, inertia]) in loads {
            let [_, omega, alpha] = machine.state([0.0, omega, alpha]);
            let own = machine.file.drive_train.input(&TrainOutput {
                torque,
                torque_per_alpha: inertia,
                omega,
                alpha,
                direction: direction * machine.ratio(),
            });
            input.torque += own.torque;
            input.torque_per_alpha += own.torque_per_alpha * machine.ratio();
            input.loss += own.loss;
        }
        let ratio = self.machines.first.drive_train.ratio();
        let form = self.motor.coefficients();
        let [own, driving, back, viscous, coulomb] = form.0;
        // At rest the direction is that of the next motion.
        let [alpha, torque_driving, torque_back, _, sign] =
            loads_of(alpha * ratio, input.torque, direction * ratio);
        let speed = omega * ratio;
        let share = if torque_back == 0.0 { driving } else { back };
        let friction = viscous * speed + coulomb * sign;
        let lost = (share * self.motor.ratio() - 1.0) * input.torque;
        InputEffort {
            torque: form.torque(&[alpha, torque_driving, torque_back, speed, sign]),
            per_alpha: own * ratio + share * input.torque_per_alpha,
            input_torque: input.torque,
            loss: input.loss + (lost + friction * self.motor.ratio()) * speed,
        }
    }

    /// The motor torque that keeps the speed.
    pub(crate) fn keeping(&self, moment: &Moment, link: DriveState) -> Result<f64, Error> {
        match self.simulation.at {
            Shaft::DriveLink => self.resisting(moment, link),
            Shaft::Motor => self.required(moment, [link.phi, link.omega, 0.0]),
        }
    }

    /// The torque at the motor shaft required by a motion.
    pub(super) fn required(
        &self,
        moment: &Moment,
        [phi, omega, alpha]: [f64; 3],
    ) -> Result<f64, Error> {
        let direction = moment.direction;
        let points = self.points(moment, DriveState { phi, omega })?;
        let loads = points.loads(direction, [phi, omega, alpha])?;
        Ok(self.through(direction, [omega, alpha], loads).torque)
    }

    /// Output torque of each stage of the first machine's drive train in a motion (N·m).
    pub(crate) fn delivered(
        &self,
        moment: &Moment,
        [phi, omega, alpha]: [f64; 3],
    ) -> Result<Vec<f64>, Error> {
        let first = GearedMachine::first(self.machines.first);
        let phi = self.inside(phi);
        let point = ReducedLink::new(first, moment, DriveState { phi, omega })?;
        let [torque, _] = point.load(moment.direction, omega, alpha)?;
        Ok(first.file.drive_train.delivered(&TrainOutput {
            torque,
            torque_per_alpha: 0.0,
            omega,
            alpha,
            direction: moment.direction,
        }))
    }

    /// The torque at the motor shaft that accelerates machines with these inertias at their drive links, the drive trains and the motor, without
    /// loads and losses.
    pub(super) fn accelerating(&self, alpha: f64, inertias: &[f64]) -> f64 {
        let each = self.machines.all().zip(inertias);
        let machines: f64 = each
            .map(|(machine, inertia)| inertia * machine.ratio() * machine.ratio())
            .sum();
        let ratio = self.machines.first.drive_train.ratio();
        let at_input = machines / (ratio * ratio) + self.inertia_at_input();
        at_input * alpha * ratio / self.motor.ratio()
    }

    /// Inertia of the drive trains and of the motor in front of them, at their input.
    fn inertia_at_input(&self) -> f64 {
        let [own, ..] = self.motor.coefficients().0;
        let machines = self.machines.all();
        let trains = machines.map(|machine| machine.file.drive_train.inertia_at_input());
        own * self.motor.ratio() + trains.sum::<f64>()
    }

    /// Torque of the motor and of the brake at an instant: the motor's torque is `driving` until it is switched off.
    pub(super) fn halted(&self, moment: &Moment, driving: impl Fn() -> f64) -> f64 {
        let t = moment.t;
        match self.simulation.halt {
            Some(halt) if t >= halt.time + halt.brake_delay => {
                -halt.brake_torque * moment.direction * self.ratio().signum()
            }
            Some(halt) if t >= halt.time => 0.0,
            _ => driving(),
        }
    }

    /// A position, limited to the end stops or the ends of the stroke, beyond which a step of the integrator may reach.
    fn inside(&self, phi: f64) -> f64 {
        match self.ends {
            Some([from, to]) => phi.clamp(from, to),
            None => phi,
        }
    }

    /// The reduced links at a position and speed.
    fn points(&self, moment: &Moment, link: DriveState) -> Result<ReducedLinks<'a>, Error> {
        let first = GearedMachine::first(self.machines.first);
        let phi = self.inside(link.phi);
        let link = DriveState { phi, ..link };
        ReducedLinks::new(first, self.machines.beside(), moment, link)
    }

    /// The torque at the first drive link that keeps the speed, without the losses of drive trains.
    pub(crate) fn resisting(&self, moment: &Moment, link: DriveState) -> Result<f64, Error> {
        let points = self.points(moment, link)?;
        let state = [link.phi, link.omega, 0.0];
        let loads = points.loads(moment.direction, state)?.into_iter();
        Ok(loads
            .map(|(machine, [torque, _])| machine.ratio() * torque)
            .sum())
    }

    /// Inertia of the machines at `phi`, of their drive trains and of the motor, all at the first drive link; and the potential energy. Without
    /// schedules.
    pub(crate) fn inertia(&self, phi: f64) -> Result<[f64; 2], Error> {
        let stored = self.stored(&Moment::default(), DriveState { phi, omega: 0.0 })?;
        Ok([stored.inertia, stored.potential])
    }

    /// Inertia and energies at a position and speed.
    pub(super) fn stored(&self, moment: &Moment, link: DriveState) -> Result<StoredEnergy, Error> {
        // The motor and the drive trains rotate with the drive link.
        let ratio = self.machines.first.drive_train.ratio();
        let [mut inertia, mut potential, mut beyond] = [0.0; 3];
        for point in self.points(moment, link)?.all() {
            inertia += point.reduction.inertia * point.machine.ratio() * point.machine.ratio();
            potential += point.reduction.potential_energy;
            beyond += point.kinetic_beyond();
        }
        Ok(StoredEnergy {
            inertia: inertia + self.inertia_at_input() * ratio * ratio,
            beyond,
            potential,
        })
    }

    /// The acceleration that solves the equation of motion with the losses of the drive train, under the motor at this speed.
    ///
    /// The required motor torque is piecewise linear and monotone in α (each stage's efficiency changes sides with its power), so Newton's method
    /// ends after a few steps.
    pub(crate) fn instant(&self, moment: &Moment, link: DriveState) -> Result<Instant, Error> {
        let [torque, _] = self.motor(link.omega);
        self.under(moment, link, torque)
    }

    /// The same under a torque of the motor.
    pub(super) fn under(
        &self,
        moment: &Moment,
        link: DriveState,
        torque: f64,
    ) -> Result<Instant, Error> {
        let points = self.points(moment, link)?;
        self.solved(&points, moment.direction, link, torque)
    }

    /// The motor's torque, split into the part at its own shaft and the part at the first drive link. In the second case everything in front of the
    /// drive link is only dragged along.
    fn acting(&self, torque: f64) -> [f64; 2] {
        match self.simulation.at {
            Shaft::Motor => [torque, 0.0],
            Shaft::DriveLink => [0.0, torque],
        }
    }

    fn solved(
        &self,
        points: &ReducedLinks<'a>,
        direction: f64,
        DriveState { phi, omega }: DriveState,
        torque: f64,
    ) -> Result<Instant, Error> {
        let speed = omega * self.ratio();
        let [at_motor, at_link] = self.acting(torque);
        let mut input_torque = 0.0;
        let mut loss = 0.0;
        let alpha = newton(|alpha| {
            let mut loads = points.loads(direction, [phi, omega, alpha])?;
            // The motor acts only at the first drive link.
            if let Some((_, [first, _])) = loads.first_mut() {
                *first -= at_link;
            }
            let through = self.through(direction, [omega, alpha], loads);
            loss = through.loss;
            input_torque = through.input_torque;
            Ok::<_, Error>([through.torque - at_motor, through.per_alpha])
        })?;
        let [mut process_power, mut carriage_power] = [0.0; 2];
        for point in points.all() {
            let machine = point.machine;
            let [_, omega, alpha] = machine.state([phi, omega, alpha]);
            let direction = sign(direction * machine.ratio());
            let reduction = &point.reduction;
            let [viscous, coulomb] = point.working;
            let working = (viscous * omega + coulomb * direction) * omega;
            process_power += reduction.process * omega - working;
            carriage_power += point.carriage_power(alpha);
            let coulomb = reduction.coulomb * direction + point.friction.torque(alpha)?[0];
            loss += (reduction.viscous * omega + coulomb) * omega - working;
        }
        Ok(Instant {
            alpha,
            motor_torque: torque,
            input_torque,
            motor_power: torque * speed,
            process_power,
            carriage_power,
            loss,
        })
    }

    /// Power of the second axes while friction holds the machine (W).
    pub(super) fn held_power(&self, moment: &Moment, phi: f64) -> Result<f64, Error> {
        let points = self.points(moment, DriveState { phi, omega: 0.0 })?;
        Ok(points.all().map(|point| point.carriage_power(0.0)).sum())
    }

    /// Whether the motor would drive the machine from rest in this direction, judged by the acceleration `alpha` at an instant and a speed, both with
    /// the loads at rest and with the loads in motion.
    pub(super) fn starts(
        &self,
        moment: &Moment,
        alpha: impl Fn(&Moment) -> Result<f64, Error>,
    ) -> Result<bool, Error> {
        let drives = |moment: &Moment| Ok::<_, Error>(alpha(moment)? * moment.direction > 0.0);
        let mut machines = self.machines.all();
        let at_rest = machines.any(|machine| machine.file.schedule.has_values_at_rest());
        if at_rest && !drives(&Moment::starting(moment.t, moment.direction))? {
            return Ok(false);
        }
        drives(moment)
    }

    /// Times at which the machine changes: by `[motion]`, when the motor is switched off, and when the brake closes.
    pub(super) fn changes(&self) -> Corners {
        let mut corners = Corners::at(self.halts());
        for machine in self.machines.all() {
            corners = corners.of_schedule(machine.file);
        }
        corners
    }

    /// Times at which the motor is switched off, and the brake closes.
    fn halts(&self) -> Vec<f64> {
        let halt = self.simulation.halt;
        let times = halt.map(|halt| [halt.time, halt.time + halt.brake_delay]);
        times.into_iter().flatten().collect()
    }
}
