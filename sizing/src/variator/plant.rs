//! A machine with a variator at one instant: what its shafts do under the torques of the moment.

use std::cell::RefCell;

use jred::Error;
use jred::friction::{Contact, Place, Stage};
use ode_solvers::SVector;

use super::{Slip, Variator};
use crate::machine::{MachineFile, Shaft, Simulation};
use crate::simulate::Watch;
use crate::simulate::interpolate;

/// φ₁, ω₁ of the input shaft; φ of the drive link; ω₂ of the output shaft (creep only); work of the motor, work of the
/// process loads, losses; the time.
///
/// The time is a state because the integrator's twelfth stage asks for the forces at the wrong time (`ode_solvers` 0.6.2,
/// node c₁₂ of its table, its pull request 42): with the time among the states no stage needs to be told.
pub(super) type State = SVector<f64, 8>;

/// Index of the time.
pub(super) const TIME: usize = 7;

/// The machine with its variator, motor torque and direction.
pub(super) struct Plant<'a> {
    pub(super) file: &'a MachineFile,
    pub(super) simulation: &'a Simulation,
    pub(super) variator: &'a Variator,
    pub(super) stage: Stage<'a>,
    /// Direction of the drive link that friction opposes: +1, −1, or 0 where friction holds it.
    pub(super) direction: f64,
    /// The integrator cannot pass on errors: the first one waits here.
    pub(super) fault: &'a RefCell<Option<Error>>,
    /// The joints that can let go.
    pub(super) watch: &'a Watch<'a>,
}

/// What happens at one state.
#[derive(Clone, Copy, Default)]
pub(super) struct Instant {
    /// ω̇ of the input shaft, the output shaft and the drive link.
    pub(super) alpha: [f64; 3],
    /// ω of the output shaft and the drive link.
    pub(super) omega: [f64; 2],
    pub(super) ratio: f64,
    pub(super) slip: f64,
    /// Torque of the contact on the output shaft.
    pub(super) contact: f64,
    pub(super) contact_loss: f64,
    pub(super) motor_torque: f64,
    pub(super) motor_power: f64,
    pub(super) process_power: f64,
    pub(super) loss: f64,
    /// Inertia of the mechanism at its drive link.
    pub(super) inertia: f64,
    pub(super) potential: f64,
}

/// What the mechanism and its drive train ask for at the output shaft: torque at no acceleration of the drive link, and
/// by how much each unit of it adds.
struct Behind<'a> {
    plant: &'a Plant<'a>,
    inertia: f64,
    resisting: f64,
    omega: f64,
}

impl Behind<'_> {
    /// Torque at the output shaft, its derivative by the drive link's acceleration, and the drive train's loss.
    fn torque(&self, alpha: f64) -> [f64; 3] {
        let train = &self.plant.file.drive_train;
        let asked = self.inertia * alpha + self.resisting;
        let input = train.input(asked, self.inertia, self.omega, alpha);
        let own = self.plant.variator.inertia[1];
        [
            input.torque + own * train.ratio() * alpha,
            input.torque_per_alpha + own * train.ratio(),
            input.loss,
        ]
    }
}

/// The zero of a rising, piecewise linear function, from its value and slope: the efficiencies of the drive train change
/// sides with its power.
fn newton(f: impl Fn(f64) -> [f64; 2]) -> f64 {
    let mut x = 0.0f64;
    for _ in 0..50 {
        let [value, slope] = f(x);
        let step = value / slope;
        x -= step;
        if step.abs() <= 1e-15 * x.abs() {
            break;
        }
    }
    x
}

impl Plant<'_> {
    pub(super) fn creeps(&self) -> bool {
        matches!(self.variator.slip, Slip::Creep(_))
    }

    pub(super) fn instant(&self, t: f64, y: &State) -> Result<Instant, Error> {
        let n = self.file.drive_train.ratio();
        let ratios = self.stage.at(Place::new(t, y[0], 0.0))?;
        let (i, j) = (ratios.geometric.value, ratios.speed.value);
        // The ratio depends on time alone.
        let rate = ratios.speed.slope[0];
        let second = if self.creeps() { y[3] } else { j * y[1] };
        let omega = second / n;
        let point = self.file.machine.bare_reduction(y[2])?;
        let speed = match self.simulation.at {
            Shaft::Motor => y[1],
            Shaft::DriveLink => omega,
        };
        let torque = interpolate(&self.simulation.torque, speed);
        let (at_motor, at_link) = match self.simulation.at {
            Shaft::Motor => (torque, 0.0),
            Shaft::DriveLink => (0.0, torque),
        };
        let friction = point.viscous * omega + point.coulomb * self.direction;
        let behind = Behind {
            plant: self,
            inertia: point.inertia[0],
            resisting: 0.5 * point.inertia[1] * omega * omega - point.load_torque() + friction
                - at_link,
            omega,
        };
        let input = self.variator.inertia[0] + self.simulation.rotor_inertia;
        let mut now = Instant {
            omega: [second, omega],
            ratio: i,
            motor_torque: torque,
            motor_power: torque * speed,
            process_power: point.process * omega,
            inertia: point.inertia[0],
            potential: point.potential_energy[0],
            ..Instant::default()
        };
        if let Slip::Creep(contact) = self.variator.slip {
            let traction = contact.traction(i * y[1], second);
            let alpha = newton(|alpha| {
                let [torque, slope, _] = behind.torque(alpha);
                [torque - traction.torque, slope]
            });
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
                [
                    input * first + force * torque - at_motor,
                    input + force * slope * j / n,
                ]
            });
            let alpha = link(first);
            let [torque, ..] = behind.torque(alpha);
            now.alpha = [first, alpha * n, alpha];
            now.slip = ratios.slip.value;
            now.contact = torque;
            now.contact_loss = torque * (force - j) * y[1];
        }
        let [.., train] = behind.torque(now.alpha[2]);
        now.loss = now.contact_loss + train + friction * omega;
        Ok(now)
    }

    /// The way the drive link starts to move from rest: +1, −1, or 0 if friction holds it.
    pub(super) fn start_direction(&self, t: f64, y: &State) -> Result<f64, Error> {
        for direction in [1.0, -1.0] {
            let plant = Plant { direction, ..*self };
            // A hair of speed puts each stage's losses on the side of the motion to come.
            let hair = direction * 1e-12 * self.file.drive_train.ratio();
            let mut moved = *y;
            if self.creeps() {
                moved[3] = hair;
            } else {
                moved[1] = hair / self.stage.at(Place::new(t, y[0], 0.0))?.speed.value;
            }
            if plant.instant(t, &moved)?.alpha[2] * direction > 0.0 {
                return Ok(direction);
            }
        }
        Ok(0.0)
    }

    pub(super) fn heading(&self, t: f64, y: &State) -> Result<f64, Error> {
        let omega = self.instant(t, y)?.omega[1];
        if omega == 0.0 {
            self.start_direction(t, y)
        } else {
            Ok(omega.signum())
        }
    }

    /// Whether the drive link has turned round, or friction does not hold it any more.
    pub(super) fn over(&self, t: f64, y: &State) -> Result<bool, Error> {
        if self.direction == 0.0 {
            return Ok(self.start_direction(t, y)? != 0.0);
        }
        Ok(self.instant(t, y)?.omega[1] * self.direction < 0.0)
    }
}
