//! A machine, or several, that a motor drives through fixed ratios.

use jred::machine::motion::State as Moving;
use jred::mechanism::{TrainInput, TrainOutput};
use jred::{Error, Reduction};

use super::geared::{Geared, Together};
use super::observe::Working;
use super::run::Row;
use crate::model::axis::Axis;
use crate::model::coordinate::Coordinate;
use crate::model::motor::{Motor, loads_of};
use crate::model::simulation::{Shaft, Simulation};
use crate::number::columns::{Column, Quantity};
use crate::number::numerics::newton;

/// φ, ω, work of the motor, work of the process loads, losses.
pub(in crate::analysis) type State = [f64; 5];

/// The machine with its drive and motor torque.
pub(in crate::analysis) struct Plant<'a, M> {
    pub(super) machines: Together<'a>,
    pub(super) simulation: &'a Simulation,
    pub(in crate::analysis) motor: M,
    axis: Axis,
    /// Where the drive link's way ends.
    ends: Option<[f64; 2]>,
}

/// Derivatives and forces at one state.
pub(in crate::analysis) struct Instant {
    pub(in crate::analysis) alpha: f64,
    pub(in crate::analysis) motor_torque: f64,
    /// Torque at the input of the drive train, behind the motor's gearbox.
    pub(in crate::analysis) input_torque: f64,
    pub(in crate::analysis) motor_power: f64,
    pub(in crate::analysis) process_power: f64,
    pub(in crate::analysis) loss: f64,
}

/// What a motor gives so that the drive link delivers a torque in its motion.
struct Through {
    torque: f64,
    /// Its derivative by α.
    per_alpha: f64,
    /// Torque at the input of the drive train.
    input_torque: f64,
    loss: f64,
}

/// What a machine beside the first is called in columns; the first of them has the index 0.
pub fn beside_name(index: usize) -> String {
    format!("machine {}", index + 2)
}

/// The reduced links of all machines.
struct Points<'a> {
    first: (Geared<'a>, Reduction),
    beside: Vec<(Geared<'a>, Reduction)>,
}

impl<'a> Points<'a> {
    fn all(&self) -> impl Iterator<Item = (Geared<'a>, &Reduction)> {
        let all = std::iter::once(&self.first).chain(&self.beside);
        all.map(|(machine, point)| (*machine, point))
    }
}

/// The sign of a direction; none at rest.
fn sign(direction: f64) -> f64 {
    if direction == 0.0 {
        0.0
    } else {
        direction.signum()
    }
}

/// The torque at a drive link that keeps its speed; only the sign of the direction counts.
fn resisting(point: &Reduction, direction: f64, omega: f64) -> f64 {
    let load = point.load_torque() - point.viscous * omega - point.coulomb * sign(direction);
    0.5 * point.inertia_slope * omega * omega - load
}

impl<'a, M: Motor> Plant<'a, M> {
    pub(in crate::analysis) fn new(
        machines: Together<'a>,
        simulation: &'a Simulation,
        motor: M,
    ) -> Self {
        Self {
            axis: machines.first.axis(),
            ends: simulation.ends(machines.first),
            machines,
            simulation,
            motor,
        }
    }

    /// Speed of the shaft at which the motor torque acts, per speed of the drive link.
    pub(in crate::analysis) fn ratio(&self) -> f64 {
        match self.simulation.at {
            Shaft::Motor => self.machines.first.drive_train.ratio() * self.motor.ratio(),
            Shaft::DriveLink => 1.0,
        }
    }

    /// Motor torque, and the speed of the shaft at which it acts.
    pub(in crate::analysis) fn motor(&self, omega: f64) -> [f64; 2] {
        let speed = omega * self.ratio();
        [self.motor.torque(speed), speed]
    }

    /// The motor in front of the drive trains: what it gives under these speeds and accelerations of the first drive link, if each machine has
    /// such a torque and inertia at its own.
    fn through(
        &self,
        direction: f64,
        [omega, alpha]: [f64; 2],
        loads: impl IntoIterator<Item = (Geared<'a>, [f64; 2])>,
    ) -> Through {
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
        // At rest the direction is that of the motion to come.
        let [alpha, torque_driving, torque_back, _, sign] =
            loads_of(alpha * ratio, input.torque, direction * ratio);
        let speed = omega * ratio;
        let share = if torque_back == 0.0 { driving } else { back };
        let friction = viscous * speed + coulomb * sign;
        let lost = (share * self.motor.ratio() - 1.0) * input.torque;
        Through {
            torque: form.torque(&[alpha, torque_driving, torque_back, speed, sign]),
            per_alpha: own * ratio + share * input.torque_per_alpha,
            input_torque: input.torque,
            loss: input.loss + (lost + friction * self.motor.ratio()) * speed,
        }
    }

    /// The motor torque that keeps the speed `omega` at the position `phi`.
    pub(in crate::analysis) fn keeping(
        &self,
        direction: f64,
        [phi, omega]: [f64; 2],
    ) -> Result<f64, Error> {
        match self.simulation.at {
            Shaft::DriveLink => self.resisting(direction, [phi, omega]),
            Shaft::Motor => self.required(direction, [phi, omega, 0.0]),
        }
    }

    /// The torque at the motor shaft that a motion asks for.
    pub(super) fn required(
        &self,
        direction: f64,
        [phi, omega, alpha]: [f64; 3],
    ) -> Result<f64, Error> {
        let points = self.points(phi)?;
        let loads = points.all().map(|(machine, point)| {
            let [_, omega, alpha] = machine.state([phi, omega, alpha]);
            let resisting = resisting(point, direction * machine.ratio(), omega);
            (machine, [point.inertia * alpha + resisting, point.inertia])
        });
        Ok(self.through(direction, [omega, alpha], loads).torque)
    }

    /// The torque at the motor shaft that accelerates machines of these inertias, each at its drive link, without loads.
    pub(super) fn accelerating(
        &self,
        direction: f64,
        [omega, alpha]: [f64; 2],
        inertias: &[f64],
    ) -> f64 {
        let loads = self.machines.all().zip(inertias).map(|(machine, inertia)| {
            let [.., alpha] = machine.state([0.0, omega, alpha]);
            (machine, [inertia * alpha, *inertia])
        });
        self.through(direction, [omega, alpha], loads).torque
    }

    /// Torque of the motor and of the brake at the time `t`: the motor's is `driving` until it is switched off.
    pub(super) fn halted(&self, t: f64, direction: f64, driving: impl Fn() -> f64) -> f64 {
        match self.simulation.halt {
            Some(halt) if t >= halt.time + halt.brake_delay => {
                -halt.brake_torque * direction * self.ratio().signum()
            }
            Some(halt) if t >= halt.time => 0.0,
            _ => driving(),
        }
    }

    /// A position; behind an end stop or the end of the stroke, where a step of the integrator may reach, that end.
    fn inside(&self, phi: f64) -> f64 {
        match self.ends {
            Some([from, to]) => phi.clamp(from, to),
            None => phi,
        }
    }

    /// The reduced links at a position.
    fn points(&self, phi: f64) -> Result<Points<'a>, Error> {
        let phi = self.inside(phi);
        let first = Geared::first(self.machines.first);
        let beside = self.machines.beside().iter();
        let beside = beside.map(|machine| Ok((*machine, machine.point(phi)?)));
        Ok(Points {
            first: (first, first.point(phi)?),
            beside: beside.collect::<Result<_, Error>>()?,
        })
    }

    /// The torque at the first drive link that keeps the speed `omega` at the position `phi`, without the losses of drive trains.
    pub(in crate::analysis) fn resisting(
        &self,
        direction: f64,
        [phi, omega]: [f64; 2],
    ) -> Result<f64, Error> {
        let points = self.points(phi)?;
        let each = points.all().map(|(machine, point)| {
            let ratio = machine.ratio();
            ratio * resisting(point, direction * ratio, omega * ratio)
        });
        Ok(each.sum())
    }

    /// Inertia of the machines at `phi`, of their drive trains and of the motor, all at the first drive link; and the potential energy.
    pub(in crate::analysis) fn inertia(&self, phi: f64) -> Result<[f64; 2], Error> {
        // The motor and the drive trains turn with the drive link.
        let ratio = self.machines.first.drive_train.ratio();
        let [own, ..] = self.motor.coefficients().0;
        let mut at_input = own * self.motor.ratio();
        let [mut inertia, mut potential] = [0.0; 2];
        for (machine, point) in self.points(phi)?.all() {
            at_input += machine.file.drive_train.inertia_at_input();
            inertia += point.inertia * machine.ratio() * machine.ratio();
            potential += point.potential_energy;
        }
        Ok([inertia + at_input * ratio * ratio, potential])
    }

    /// The acceleration that solves the equation of motion through the losses of the drive train.
    ///
    /// The torque that the motor must give is piecewise linear and monotone in α (each stage's efficiency changes
    /// sides with its power), so Newton's method ends after a few steps.
    pub(in crate::analysis) fn instant(
        &self,
        direction: f64,
        [phi, omega, ..]: &State,
    ) -> Result<Instant, Error> {
        let [torque, _] = self.motor(*omega);
        self.under(direction, [*phi, *omega], torque)
    }

    /// The same under a torque of the motor.
    pub(super) fn under(
        &self,
        direction: f64,
        [phi, omega]: [f64; 2],
        torque: f64,
    ) -> Result<Instant, Error> {
        let points = self.points(phi)?;
        let speed = omega * self.ratio();
        // With the torque at the drive link, what sits in front of it only drags along.
        let (at_motor, at_link) = match self.simulation.at {
            Shaft::Motor => (torque, 0.0),
            Shaft::DriveLink => (0.0, torque),
        };
        // The motor acts at the first drive link alone.
        let at = |k: usize| if k == 0 { at_link } else { 0.0 };
        let mut input_torque = 0.0;
        let mut loss = 0.0;
        let alpha = newton(|alpha| {
            let loads = points.all().enumerate().map(|(k, (machine, point))| {
                let [_, omega, alpha] = machine.state([phi, omega, alpha]);
                let resisting = resisting(point, direction * machine.ratio(), omega);
                let torque = point.inertia * alpha + resisting - at(k);
                (machine, [torque, point.inertia])
            });
            let through = self.through(direction, [omega, alpha], loads);
            loss = through.loss;
            input_torque = through.input_torque;
            [through.torque - at_motor, through.per_alpha]
        });
        let mut process_power = 0.0;
        for (machine, point) in points.all() {
            let omega = omega * machine.ratio();
            let direction = sign(direction * machine.ratio());
            process_power += point.process * omega;
            loss += (point.viscous * omega + point.coulomb * direction) * omega;
        }
        Ok(Instant {
            alpha,
            motor_torque: torque,
            input_torque,
            motor_power: torque * speed,
            process_power,
            loss,
        })
    }

    /// What the motor does at a state under a torque at its shaft; `asked` is what a controller asks for.
    fn working(
        &self,
        direction: f64,
        [phi, omega]: [f64; 2],
        [torque, asked]: [f64; 2],
    ) -> Result<Working, Error> {
        let held = direction == 0.0;
        let now = if held {
            None
        } else {
            Some(self.under(direction, [phi, omega], torque)?)
        };
        Ok(Working {
            phi,
            speed: omega * self.ratio(),
            torque,
            asked,
            // Held at rest, friction takes any share of it.
            input_torque: now.map_or(torque * self.motor.ratio(), |now| now.input_torque),
            error: None,
        })
    }

    /// The same at a time: behind the switching off the torque is the brake's, and the motor has none.
    pub(super) fn working_at(
        &self,
        t: f64,
        direction: f64,
        link: [f64; 2],
        torques: [f64; 2],
    ) -> Result<Working, Error> {
        let working = self.working(direction, link, torques)?;
        let is_off = self.simulation.halt.is_some_and(|halt| t >= halt.time);
        Ok(Working {
            torque: if is_off { 0.0 } else { working.torque },
            asked: if is_off { 0.0 } else { working.asked },
            ..working
        })
    }

    /// When the motor is switched off, and when the brake closes.
    pub(super) fn halts(&self) -> Vec<f64> {
        let halt = self.simulation.halt;
        let times = halt.map(|halt| [halt.time, halt.time + halt.brake_delay]);
        times.into_iter().flatten().collect()
    }

    /// The columns of a row.
    pub(super) fn columns(&self) -> Vec<Column> {
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
            Column::new(Quantity::MotorEffort, motor, unit),
            Column::new(Quantity::ReducedInertia, inertia, inertia_unit),
        ];
        let beside = self.machines.beside().iter().enumerate();
        let positions = beside.map(|(k, machine)| {
            let column = machine.file.axis().column();
            Column::other(format!("{} {}", beside_name(k), column.name), column.unit)
        });
        own.into_iter().chain(positions).collect()
    }

    /// That of the drive link.
    fn coordinate(&self) -> Coordinate {
        self.machines.first.machine.mechanism().coordinate()
    }

    /// The row of a state with its motor torque.
    pub(super) fn written(&self, [phi, omega, alpha]: [f64; 3], torque: f64) -> Result<Row, Error> {
        let [inertia, potential] = self.inertia(phi)?;
        let shown = self.axis.state(&Moving { phi, omega, alpha });
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
        Ok(Row {
            figures: own.into_iter().chain(positions).collect(),
            kinetic: 0.5 * inertia * omega * omega,
            potential,
        })
    }
}
