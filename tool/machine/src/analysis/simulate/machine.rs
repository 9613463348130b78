//! A machine whose motor drives it through a fixed ratio.

use jred::Error;
use jred::mechanism::TrainOutput;

use super::run::{self, Row};
use super::SimulationError;
use crate::model::coordinate::Coordinate;
use crate::model::machine::{MachineFile, Shaft, Simulation};
use crate::number::columns::{Column, Quantity};
use crate::number::numerics::newton;

/// φ, ω, work of the motor, work of the process loads, losses.
pub(in crate::analysis) type State = [f64; 5];

/// The machine with its drive and motor torque.
pub(in crate::analysis) struct Plant<'a> {
    file: &'a MachineFile,
    simulation: &'a Simulation,
    coordinate: Coordinate,
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
        let torque = self.resisting(direction, [phi, omega])?;
        Ok(match self.simulation.at {
            Shaft::DriveLink => torque,
            Shaft::Motor => {
                let output = TrainOutput {
                    torque,
                    omega,
                    direction,
                    ..TrainOutput::default()
                };
                self.file.drive_train.input(&output).torque
            }
        })
    }

    /// The torque at the drive link that keeps the speed `omega` at the position `phi`.
    pub(in crate::analysis) fn resisting(
        &self,
        direction: f64,
        [phi, omega]: [f64; 2],
    ) -> Result<f64, Error> {
        let point = self.file.machine.bare_reduction(phi)?;
        let load = point.load_torque() - point.viscous * omega - point.coulomb * direction;
        Ok(0.5 * point.inertia_slope * omega * omega - load)
    }

    /// Inertia of the machine at `phi`, of the drive train and of the rotor, all at the drive link; and the potential energy.
    pub(in crate::analysis) fn inertia(&self, phi: f64) -> Result<[f64; 2], Error> {
        let point = self.file.machine.bare_reduction(phi)?;
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
        let omega = *omega;
        let point = self.file.machine.bare_reduction(*phi)?;
        let load = point.load_torque() - point.viscous * omega - point.coulomb * direction;
        let resisting = 0.5 * point.inertia_slope * omega * omega - load;
        let [torque, speed] = self.motor(omega);
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

    fn slope(&self, direction: f64, _: f64, y: &State) -> Result<State, Error> {
        if direction == 0.0 {
            return Ok([0.0; 5]);
        }
        let now = self.instant(direction, y)?;
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

    fn alpha(&self, direction: f64, _: f64, y: &State) -> Result<f64, Error> {
        Ok(self.instant(direction, y)?.alpha)
    }

    fn check(&self, _: f64, _: f64, _: &State) -> Result<(), SimulationError> {
        Ok(())
    }

    fn corners(&self) -> impl Iterator<Item = f64> {
        std::iter::empty()
    }

    fn heads(&self) -> Vec<Column> {
        let coordinate = self.coordinate;
        let [speed, acceleration] = coordinate.rates();
        let (motor, unit) = if self.simulation.drives_a_slide(self.file) {
            ("motor force", "N")
        } else {
            ("motor torque", "N m")
        };
        let (inertia, inertia_unit) = (coordinate.inertia(), coordinate.inertia_unit());
        vec![
            coordinate.column(),
            speed,
            acceleration,
            Column::new(Quantity::MotorEffort, motor, unit),
            Column::new(Quantity::ReducedInertia, inertia, inertia_unit),
        ]
    }

    fn row(&self, direction: f64, t: f64, y: &State) -> Result<Row, Error> {
        let [phi, omega, ..] = *y;
        let [inertia, potential] = self.inertia(phi)?;
        let alpha = if direction == 0.0 {
            0.0
        } else {
            self.alpha(direction, t, y)?
        };
        let [torque, _] = self.motor(omega);
        Ok(Row {
            figures: vec![self.coordinate.shown(phi), omega, alpha, torque, inertia],
            kinetic: 0.5 * inertia * omega * omega,
            potential,
        })
    }
}
