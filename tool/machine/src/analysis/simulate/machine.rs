//! A machine whose motor drives it through a fixed ratio.

use jred::machine::motion::State as Moving;
use jred::mechanism::TrainOutput;
use jred::{Error, Reduction};

use super::SimulationError;
use super::observe::Working;
use super::run::{self, HAIR, Row};
use super::simulated::Missing;
use crate::model::axis::Axis;
use crate::model::coordinate::Coordinate;
use crate::model::machine::MachineFile;
use crate::model::motor::{Motor, loads_of};
use crate::model::simulation::{Shaft, Simulation};
use crate::number::columns::{Column, Quantity};
use crate::number::numerics::newton;

/// φ, ω, work of the motor, work of the process loads, losses.
pub(in crate::analysis) type State = [f64; 5];

/// The machine with its drive and motor torque.
pub(in crate::analysis) struct Plant<'a, M> {
    file: &'a MachineFile,
    simulation: &'a Simulation,
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

impl<'a, M: Motor> Plant<'a, M> {
    pub(in crate::analysis) fn new(
        file: &'a MachineFile,
        simulation: &'a Simulation,
        motor: M,
    ) -> Self {
        Self {
            file,
            simulation,
            motor,
            axis: file.axis(),
            ends: simulation.ends(file),
        }
    }

    /// Speed of the shaft at which the motor torque acts, per speed of the drive link.
    pub(in crate::analysis) fn ratio(&self) -> f64 {
        match self.simulation.at {
            Shaft::Motor => self.file.drive_train.ratio() * self.motor.ratio(),
            Shaft::DriveLink => 1.0,
        }
    }

    /// Motor torque, and the speed of the shaft at which it acts.
    pub(in crate::analysis) fn motor(&self, omega: f64) -> [f64; 2] {
        let speed = omega * self.ratio();
        [self.motor.torque(speed), speed]
    }

    /// The motor in front of the drive train: what it gives for a motion of the drive link.
    fn through(&self, output: &TrainOutput) -> Through {
        let train = &self.file.drive_train;
        let ratio = train.ratio();
        let input = train.input(output);
        let form = self.motor.coefficients();
        let [own, driving, back, viscous, coulomb] = form.0;
        // At rest the direction is that of the motion to come.
        let loads = loads_of(output.alpha * ratio, input.torque, output.direction * ratio);
        let speed = output.omega * ratio;
        let [alpha, torque_driving, torque_back, _, sign] = loads;
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
        let resisting = self.resisting(direction, [phi, omega])?;
        let inertia = if alpha == 0.0 {
            0.0
        } else {
            self.point(phi)?.inertia
        };
        Ok(self.at_motor(direction, [omega, alpha], inertia * alpha + resisting))
    }

    /// The torque at the motor shaft that gives one at the drive link under a speed and an acceleration.
    pub(super) fn at_motor(&self, direction: f64, [omega, alpha]: [f64; 2], torque: f64) -> f64 {
        let output = TrainOutput {
            torque,
            omega,
            alpha,
            direction,
            ..TrainOutput::default()
        };
        self.through(&output).torque
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

    /// The torque at the motor's shaft without a controller.
    fn torque(&self, t: f64, direction: f64, omega: f64) -> f64 {
        self.halted(t, direction, || self.motor(omega)[0])
    }

    /// The reduced link at a position; behind an end stop or the end of the stroke, where a step of the integrator may reach, that there.
    pub(super) fn point(&self, phi: f64) -> Result<Reduction, Error> {
        let phi = match self.ends {
            Some([from, to]) => phi.clamp(from, to),
            None => phi,
        };
        Ok(self.file.machine.bare_reduction(phi)?)
    }

    /// The torque at the drive link that keeps the speed `omega` at the position `phi`.
    pub(in crate::analysis) fn resisting(
        &self,
        direction: f64,
        [phi, omega]: [f64; 2],
    ) -> Result<f64, Error> {
        let point = self.point(phi)?;
        let load = point.load_torque() - point.viscous * omega - point.coulomb * direction;
        Ok(0.5 * point.inertia_slope * omega * omega - load)
    }

    /// Inertia of the machine at `phi`, of the drive train and of the motor, all at the drive link; and the potential energy.
    pub(in crate::analysis) fn inertia(&self, phi: f64) -> Result<[f64; 2], Error> {
        let point = self.point(phi)?;
        // The motor and the drive train turn with the drive link.
        let train = &self.file.drive_train;
        let ratio = train.ratio();
        let [own, ..] = self.motor.coefficients().0;
        let drive = (train.inertia_at_input() + own * self.motor.ratio()) * ratio * ratio;
        Ok([point.inertia + drive, point.potential_energy])
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
        let point = self.point(phi)?;
        let load = point.load_torque() - point.viscous * omega - point.coulomb * direction;
        let resisting = 0.5 * point.inertia_slope * omega * omega - load;
        let speed = omega * self.ratio();
        // With the torque at the drive link, what sits in front of it only drags along.
        let (at_motor, at_link) = match self.simulation.at {
            Shaft::Motor => (torque, 0.0),
            Shaft::DriveLink => (0.0, torque),
        };
        let mut input_torque = 0.0;
        let mut loss = 0.0;
        let alpha = newton(|alpha| {
            let through = self.through(&TrainOutput {
                torque: point.inertia * alpha + resisting - at_link,
                torque_per_alpha: point.inertia,
                omega,
                alpha,
                direction,
            });
            loss = through.loss;
            input_torque = through.input_torque;
            [through.torque - at_motor, through.per_alpha]
        });
        Ok(Instant {
            alpha,
            motor_torque: torque,
            input_torque,
            motor_power: torque * speed,
            process_power: point.process * omega,
            loss: loss + (point.viscous * omega + point.coulomb * direction) * omega,
        })
    }

    /// What the motor does at a state under its torque; `asked` is what a controller asks for.
    pub(super) fn working(
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

    /// What happens at a state at the time `t`.
    fn now(&self, direction: f64, t: f64, [phi, omega, ..]: &State) -> Result<Instant, Error> {
        self.under(direction, [*phi, *omega], self.torque(t, direction, *omega))
    }

    /// When the motor is switched off, and when the brake closes.
    pub(super) fn halts(&self) -> Vec<f64> {
        let halt = self.simulation.halt;
        let times = halt.map(|halt| [halt.time, halt.time + halt.brake_delay]);
        times.into_iter().flatten().collect()
    }

    /// The columns of a row.
    pub(super) fn columns(&self) -> [Column; 5] {
        let [speed, acceleration] = self.axis.coordinate.rates();
        let (motor, unit) = if self.simulation.drives_a_slide(self.file) {
            ("motor force", "N")
        } else {
            ("motor torque", "N m")
        };
        let coordinate = self.coordinate();
        let (inertia, inertia_unit) = (coordinate.inertia(), coordinate.inertia_unit());
        [
            self.axis.column(),
            speed,
            acceleration,
            Column::new(Quantity::MotorEffort, motor, unit),
            Column::new(Quantity::ReducedInertia, inertia, inertia_unit),
        ]
    }

    /// That of the drive link.
    fn coordinate(&self) -> Coordinate {
        self.file.machine.mechanism().coordinate()
    }

    /// The row of a state with its motor torque.
    pub(super) fn written(&self, [phi, omega, alpha]: [f64; 3], torque: f64) -> Result<Row, Error> {
        let [inertia, potential] = self.inertia(phi)?;
        let shown = self.axis.state(&Moving { phi, omega, alpha });
        Ok(Row {
            figures: vec![
                self.axis.shown(phi),
                shown.omega,
                shown.alpha,
                torque,
                inertia,
            ],
            kinetic: 0.5 * inertia * omega * omega,
            potential,
        })
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

    fn heads(&self) -> Vec<Column> {
        self.columns().to_vec()
    }

    fn working(&self, direction: f64, t: f64, y: &State) -> Result<Option<Working>, Error> {
        let torque = self.torque(t, direction, y[1]);
        let working = self.working(direction, [y[0], y[1]], [torque; 2])?;
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
