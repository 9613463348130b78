//! A machine with a variator between its motor and its drive train: the angle of the drive link is integrated from its own speed, not derived from
//! the motor's.

use jred::error::Error;
use jred::friction::{Contact, CreepContact, OperatingPoint, Ratios, Stage};
use jred::mechanism::TrainOutput;
use jred::number::RangeError;

use super::SimulationError;
use super::clock::{Corners, Moment};
use super::coupled::CoupledMachines;
use super::drive_state::DriveState;
use super::run::{self, OutputRow};
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::motor::{Motor as _, OwnMotor};
use jred_file::model::simulation::{Shaft, Simulation};
use jred_file::model::variator::{RATIOS, Slip, Variator};
use jred_file::number::columns::{Column, ColumnQuantity};
use jred_file::number::numerics::newton;

/// φ₁, ω₁ of the input shaft; φ of the drive link; ω₂ of the output shaft (creep only); work of the motor, work of the
/// process loads, losses.
type VariatorState = [f64; 7];

/// Share of the power through the contact by which losses may be negative: rounding.
const ROUNDING: f64 = 1e-9;

/// The machine with its variator and motor torque.
pub(super) struct Plant<'a> {
    file: &'a MachineFile,
    simulation: &'a Simulation,
    motor: OwnMotor<'a>,
    variator: &'a Variator,
    stage: Stage<'a>,
}

/// Derivatives and forces at one state.
#[derive(Clone, Copy, Default)]
struct Instant {
    /// ω̇ of the input shaft, the output shaft and the drive link.
    alpha: [f64; 3],
    /// ω of the output shaft and the drive link.
    omega: [f64; 2],
    ratio: f64,
    slip: f64,
    /// Torque of the contact on the output shaft.
    contact: f64,
    contact_loss: f64,
    motor_torque: f64,
    motor_power: f64,
    process_power: f64,
    loss: f64,
    /// Inertia of the mechanism at its drive link, and the torque there that maintains its speed.
    inertia: f64,
    resisting: f64,
    potential: f64,
}

/// Load of the mechanism and its drive train on the output shaft: torque without acceleration of the drive link, and the increase per unit of
/// acceleration.
struct OutputLoad<'a> {
    plant: &'a Plant<'a>,
    inertia: f64,
    resisting: f64,
    omega: f64,
    direction: f64,
}

impl OutputLoad<'_> {
    /// Torque at the output shaft, its derivative by the drive link's acceleration, and the drive train's loss.
    fn torque(&self, alpha: f64) -> [f64; 3] {
        let train = &self.plant.file.drive_train;
        let asked = self.inertia * alpha + self.resisting;
        let input = train.input(&TrainOutput {
            torque: asked,
            torque_per_alpha: self.inertia,
            omega: self.omega,
            alpha,
            direction: self.direction,
        });
        let own = self.plant.variator.inertia[1];
        [
            input.torque + own * train.ratio() * alpha,
            input.torque_per_alpha + own * train.ratio(),
            input.loss,
        ]
    }
}

impl<'a> Plant<'a> {
    pub(super) fn new(
        file: &'a MachineFile,
        variator: &'a Variator,
        simulation: &'a Simulation,
        motor: OwnMotor<'a>,
    ) -> Result<Self, Error> {
        Ok(Self {
            file,
            simulation,
            motor,
            variator,
            stage: variator.stage()?,
        })
    }

    /// Speed of the output shaft per speed of the input shaft.
    fn speed_ratio(&self, t: f64, y: &VariatorState) -> Result<f64, Error> {
        Ok(self.ratios(t, y)?.speed.value)
    }

    /// The ratios of a formula are checked here, because they were not evaluated at all times and angles before.
    fn ratios(&self, t: f64, y: &VariatorState) -> Result<Ratios, Error> {
        let ratios = self.stage.at(OperatingPoint::at_time(t).with_angle(y[0]))?;
        let value = ratios.geometric.value;
        let [min, max] = RATIOS;
        if (min..=max).contains(&value) {
            return Ok(ratios);
        }
        Err(RangeError::OutOfRange {
            what: "ratio of the variator",
            value,
            min,
            max,
        }
        .into())
    }

    fn creeps(&self) -> bool {
        matches!(self.variator.slip, Slip::Creep(_))
    }

    fn instant(&self, direction: f64, t: f64, y: &VariatorState) -> Result<Instant, Error> {
        let n = self.file.drive_train.ratio();
        let ratios = self.ratios(t, y)?;
        let (i, j) = (ratios.geometric.value, ratios.speed.value);
        let [by_time, by_angle, _] = ratios.speed.slope;
        let rate = by_time + by_angle * y[1];
        let second = if self.creeps() { y[3] } else { j * y[1] };
        let omega = second / n;
        let point = self.file.machine.bare_reduction(y[2])?;
        let speed = match self.simulation.at {
            Shaft::Motor => y[1],
            Shaft::DriveLink => omega,
        };
        let torque = self.motor.torque(speed);
        let (at_motor, at_link) = match self.simulation.at {
            Shaft::Motor => (torque, 0.0),
            Shaft::DriveLink => (0.0, torque),
        };
        let friction = point.viscous * omega + point.coulomb * direction;
        let [viscous, coulomb] = self.file.working(&self.file.machine, y[2])?;
        let working = (viscous * omega + coulomb * direction) * omega;
        let behind = OutputLoad {
            plant: self,
            inertia: point.inertia,
            resisting: 0.5 * point.inertia_slope * omega * omega - point.load_torque() + friction
                - at_link,
            omega,
            direction,
        };
        let input = self.variator.inertia[0] + self.simulation.rotor_inertia;
        let mut now = Instant {
            omega: [second, omega],
            ratio: i,
            motor_torque: torque,
            motor_power: torque * speed,
            process_power: point.process * omega - working,
            inertia: point.inertia,
            resisting: behind.resisting,
            potential: point.potential_energy,
            ..Instant::default()
        };
        if let Slip::Creep(contact) = &self.variator.slip {
            let traction = contact.traction(i * y[1], second);
            let alpha = newton(|alpha| {
                let [torque, slope, _] = behind.torque(alpha);
                Ok::<_, Error>([torque - traction.torque, slope])
            })?;
            now.alpha = [(at_motor - i * traction.torque) / input, alpha * n, alpha];
            now.slip = traction.slip;
            now.contact = traction.torque;
            now.contact_loss = traction.loss;
        } else {
            let force = match self.variator.contact() {
                Contact::Ideal => j,
                Contact::Slipping => i,
            };
            let link = |first: f64| (j * first + rate * y[1]) / n;
            let first = newton(|first| {
                let [torque, slope, _] = behind.torque(link(first));
                Ok::<_, Error>([
                    input * first + force * torque - at_motor,
                    input + force * slope * j / n,
                ])
            })?;
            let alpha = link(first);
            let [torque, ..] = behind.torque(alpha);
            now.alpha = [first, alpha * n, alpha];
            now.slip = ratios.slip.value;
            now.contact = torque;
            now.contact_loss = torque * (force - j) * y[1];
        }
        let [.., train] = behind.torque(now.alpha[2]);
        now.loss = now.contact_loss + train + friction * omega - working;
        Ok(now)
    }
}

impl run::Plant<7> for Plant<'_> {
    fn start(&self) -> Result<VariatorState, Error> {
        let second = self.simulation.start_speed * self.file.drive_train.ratio();
        let first = second / self.speed_ratio(0.0, &[0.0; 7])?;
        let own = if self.creeps() { second } else { 0.0 };
        Ok([0.0, first, self.simulation.start_angle, own, 0.0, 0.0, 0.0])
    }

    fn slope(&self, moment: &Moment, y: &VariatorState) -> Result<VariatorState, Error> {
        let now = self.instant(moment.direction, moment.t, y)?;
        let held = moment.direction == 0.0;
        let free = if held && !self.creeps() { 0.0 } else { 1.0 };
        let moving = if held { 0.0 } else { 1.0 };
        let second = if self.creeps() { now.alpha[1] } else { 0.0 };
        Ok([
            y[1] * free,
            now.alpha[0] * free,
            now.omega[1] * moving,
            second * moving,
            now.motor_power,
            now.process_power,
            now.loss,
        ])
    }

    fn link(&self, t: f64, y: &VariatorState) -> Result<DriveState, Error> {
        let second = if self.creeps() {
            y[3]
        } else {
            self.speed_ratio(t, y)? * y[1]
        };
        Ok(DriveState {
            phi: y[2],
            omega: second / self.file.drive_train.ratio(),
        })
    }

    fn with_link(
        &self,
        t: f64,
        y: &VariatorState,
        DriveState { phi, omega }: DriveState,
    ) -> Result<VariatorState, Error> {
        let mut y = *y;
        let second = omega * self.file.drive_train.ratio();
        y[2] = phi;
        if self.creeps() {
            y[3] = second;
        } else {
            y[1] = second / self.speed_ratio(t, &y)?;
        }
        Ok(y)
    }

    fn alpha(&self, moment: &Moment, y: &VariatorState) -> Result<f64, Error> {
        Ok(self.instant(moment.direction, moment.t, y)?.alpha[2])
    }

    fn check(&self, moment: &Moment, y: &VariatorState) -> Result<(), SimulationError> {
        let now = self.instant(moment.direction, moment.t, y)?;
        if now.contact_loss < -ROUNDING * (now.contact * now.omega[0]).abs() {
            let power = -now.contact_loss;
            return Err(SimulationError::PowerFlowsBack { t: moment.t, power });
        }
        Ok(())
    }

    fn bends(&self, moment: &Moment, y: &VariatorState) -> Result<Vec<f64>, Error> {
        let now = self.instant(moment.direction, moment.t, y)?;
        let speed = match self.simulation.at {
            Shaft::Motor => y[1],
            Shaft::DriveLink => now.omega[1],
        };
        let own = self.motor.bends().into_iter();
        let mut bends: Vec<f64> = own
            .map(|bend| (speed - bend) / (speed.abs() + bend.abs()))
            .collect();
        if let Slip::Creep(contact) = &self.variator.slip {
            let fastest = (now.ratio * y[1]).abs().max(now.omega[0].abs());
            bends.extend([now.slip, fastest - CreepContact::SLOW]);
            bends.extend(contact.bends().into_iter().map(|slip| now.slip - slip));
        }
        if moment.direction != 0.0 && self.file.drive_train.is_lossy() {
            let accelerating = now.inertia * now.alpha[2];
            let delivered = self.file.drive_train.lossy_flows(&TrainOutput {
                torque: accelerating + now.resisting,
                torque_per_alpha: 0.0,
                omega: now.omega[1],
                alpha: now.alpha[2],
                direction: moment.direction,
            });
            let size = accelerating.abs() + now.resisting.abs() + now.motor_torque.abs();
            let size = f64::MIN_POSITIVE + size;
            bends.extend(delivered.into_iter().map(|torque| torque / size));
        }
        Ok(bends)
    }

    fn corners(&self) -> Corners {
        Corners::at(self.variator.ratio.breaks())
    }

    fn machines(&self) -> CoupledMachines<'_> {
        CoupledMachines::alone(self.file)
    }

    fn heads(&self) -> Vec<Column> {
        let [speed, acceleration] = Coordinate::Angle.rates();
        vec![
            Coordinate::Angle.column(),
            speed,
            acceleration,
            Column::other("input phi", "deg"),
            Column::other("input omega", "rad/s"),
            Column::other("ratio", ""),
            Column::other("slip", "%"),
            Column::other("contact torque", "N m"),
            Column::new(ColumnQuantity::MotorEffort, "motor torque", "N m"),
            Column::new(ColumnQuantity::ReducedInertia, "J_red", "kg m^2"),
        ]
    }

    fn row(&self, moment: &Moment, y: &VariatorState) -> Result<OutputRow, Error> {
        let n = self.file.drive_train.ratio();
        let train = self.file.drive_train.inertia_at_input() + self.variator.inertia[1];
        let input = self.variator.inertia[0] + self.simulation.rotor_inertia;
        let now = self.instant(moment.direction, moment.t, y)?;
        let held = moment.direction == 0.0;
        let [second, omega] = if held { [0.0; 2] } else { now.omega };
        let behind = now.inertia + train * n * n;
        let speed = self.speed_ratio(moment.t, y)?;
        Ok(OutputRow {
            figures: vec![
                y[2].to_degrees(),
                omega,
                if held { 0.0 } else { now.alpha[2] },
                y[0].to_degrees(),
                y[1],
                now.ratio,
                now.slip * 100.0,
                now.contact,
                now.motor_torque,
                behind + input * n * n / (speed * speed),
            ],
            kinetic: 0.5 * (input * y[1] * y[1] + train * second * second)
                + 0.5 * now.inertia * omega * omega,
            beyond: 0.0,
            potential: now.potential,
        })
    }
}
