//! A machine whose motor drives it through a fixed ratio.

use jred::mechanism::TrainOutput;
use jred::{Error, Reduction};

use super::SimulationError;
use super::run::{self, Row};
use crate::model::coordinate::Coordinate;
use crate::model::machine::MachineFile;
use crate::model::simulation::{Shaft, Simulation};
use crate::number::columns::{Column, Quantity};
use crate::number::numerics::newton;

/// φ, ω, work of the motor, work of the process loads, losses.
pub(in crate::analysis) type State = [f64; 5];

/// The machine with its drive and motor torque.
pub(in crate::analysis) struct Plant<'a> {
    file: &'a MachineFile,
    simulation: &'a Simulation,
    coordinate: Coordinate,
    /// Where the drive link's way ends.
    ends: Option<[f64; 2]>,
}

/// Derivatives and forces at one state.
pub(in crate::analysis) struct Instant {
    pub(in crate::analysis) alpha: f64,
    pub(in crate::analysis) motor_torque: f64,
    pub(in crate::analysis) motor_power: f64,
    pub(in crate::analysis) process_power: f64,
    pub(in crate::analysis) loss: f64,
}

impl<'a> Plant<'a> {
    pub(in crate::analysis) fn new(file: &'a MachineFile, simulation: &'a Simulation) -> Self {
        Self {
            file,
            simulation,
            coordinate: file.machine.mechanism().coordinate(),
            ends: simulation.ends(file),
        }
    }

    /// Speed of the shaft at which the motor torque acts, per speed of the drive link.
    pub(in crate::analysis) fn ratio(&self) -> f64 {
        match self.simulation.at {
            Shaft::Motor => self.file.drive_train.ratio(),
            Shaft::DriveLink => 1.0,
        }
    }

    /// Motor torque, and the speed of the shaft at which it acts.
    pub(in crate::analysis) fn motor(&self, omega: f64) -> [f64; 2] {
        let speed = omega * self.ratio();
        [self.simulation.torque.torque(speed), speed]
    }

    /// Speeds of that shaft at which the motor's characteristic changes.
    pub(in crate::analysis) fn marks(&self) -> Vec<f64> {
        self.simulation.torque.marks()
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
        let train = &self.file.drive_train;
        let output = TrainOutput {
            torque,
            omega,
            alpha,
            direction,
            ..TrainOutput::default()
        };
        train.input(&output).torque + self.simulation.rotor_inertia * train.ratio() * alpha
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

    /// Inertia of the machine at `phi`, of the drive train and of the rotor, all at the drive link; and the potential energy.
    pub(in crate::analysis) fn inertia(&self, phi: f64) -> Result<[f64; 2], Error> {
        let point = self.point(phi)?;
        // The rotor and the drive train turn with the drive link.
        let train = &self.file.drive_train;
        let ratio = train.ratio();
        let drive = (train.inertia_at_input() + self.simulation.rotor_inertia) * ratio * ratio;
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
        let train = &self.file.drive_train;
        let ratio = train.ratio();
        let rotor = self.simulation.rotor_inertia;
        // With the torque at the drive link, what sits in front of it only drags along.
        let (at_motor, at_link) = match self.simulation.at {
            Shaft::Motor => (torque, 0.0),
            Shaft::DriveLink => (0.0, torque),
        };
        let mut loss = 0.0;
        let alpha = newton(|alpha| {
            let asked = point.inertia * alpha + resisting - at_link;
            let input = train.input(&TrainOutput {
                torque: asked,
                torque_per_alpha: point.inertia,
                omega,
                alpha,
                direction,
            });
            loss = input.loss;
            [
                input.torque + rotor * ratio * alpha - at_motor,
                input.torque_per_alpha + rotor * ratio,
            ]
        });
        Ok(Instant {
            alpha,
            motor_torque: torque,
            motor_power: torque * speed,
            process_power: point.process * omega,
            loss: loss + (point.viscous * omega + point.coulomb * direction) * omega,
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
        let coordinate = self.coordinate;
        let [speed, acceleration] = coordinate.rates();
        let (motor, unit) = if self.simulation.drives_a_slide(self.file) {
            ("motor force", "N")
        } else {
            ("motor torque", "N m")
        };
        let (inertia, inertia_unit) = (coordinate.inertia(), coordinate.inertia_unit());
        [
            coordinate.column(),
            speed,
            acceleration,
            Column::new(Quantity::MotorEffort, motor, unit),
            Column::new(Quantity::ReducedInertia, inertia, inertia_unit),
        ]
    }

    /// The row of a state with its motor torque.
    pub(super) fn written(&self, [phi, omega, alpha]: [f64; 3], torque: f64) -> Result<Row, Error> {
        let [inertia, potential] = self.inertia(phi)?;
        Ok(Row {
            figures: vec![self.coordinate.shown(phi), omega, alpha, torque, inertia],
            kinetic: 0.5 * inertia * omega * omega,
            potential,
        })
    }
}

impl run::Plant<5> for Plant<'_> {
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
