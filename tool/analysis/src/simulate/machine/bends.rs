//! Bends of the equations of motion: where the power through a stage with losses or through the motor's gearbox reverses, where the motor's
//! torque-speed curve has a corner, and where a point under friction turns back.

use jred::error::Error;
use jred::machine::{Action, Jointed as _, Mechanism as _};
use jred::mechanism::TrainOutput;

use super::{Instant, Plant};
use crate::simulate::clock::Moment;
use crate::simulate::coupled::CoupledMachines;
use crate::simulate::drive_state::DriveState;
use crate::simulate::point::ReducedLinks;
use jred_file::model::motor::Motor;

/// The direction of the evaluated velocity component, as a unit vector that no guide has.
const ALONG: [f64; 2] = [0.540_302_305_868_139_8, 0.841_470_984_807_896_5];

/// The parts of machines and their motor that have bends.
pub(super) struct Bends {
    /// Speeds of the motor.
    speeds: Vec<f64>,
    /// Stages with losses.
    losses: bool,
    /// The motor's gearbox.
    gearbox: bool,
    /// Loads against the motion, and friction in joints.
    opposing: bool,
}

impl Bends {
    pub(super) fn of(machines: &CoupledMachines, motor: &impl Motor) -> Self {
        let [_, driving, back, ..] = motor.coefficients().0;
        let opposes =
            |action| matches!(action, Action::OpposingForce(_) | Action::OpposingMoment(_));
        Self {
            speeds: motor.bends(),
            losses: (machines.all()).any(|machine| machine.file.drive_train.is_lossy()),
            gearbox: driving.total_cmp(&back).is_ne(),
            opposing: machines.all().any(|machine| {
                let mut loads = machine.file.machine.loads().iter();
                loads.any(|load| opposes(load.action()))
                    || !machine.file.machine.frictions().is_empty()
            }),
        }
    }
}

impl<'a, M: Motor> Plant<'a, M> {
    /// Values that pass zero where the equations of motion bend, each relative to its terms; the same list at every state.
    pub(crate) fn bends_under(
        &self,
        moment: &Moment,
        link: DriveState,
        torque: f64,
    ) -> Result<Vec<f64>, Error> {
        let speed = link.omega * self.ratio();
        let speeds = self.bends.speeds.iter();
        let mut values: Vec<f64> = speeds
            .map(|bend| (speed - bend) / (speed.abs() + bend.abs()))
            .collect();
        if self.bends.losses || self.bends.gearbox {
            let points = self.points(moment, link)?;
            let now = self.solved(&points, moment.direction, link, torque)?;
            values.extend(self.flows(&points, moment.direction, link, &now)?);
        }
        if self.bends.opposing {
            self.turning_back(moment, link, &mut values)?;
        }
        Ok(values)
    }

    /// The same for the torque required by a motion.
    pub(in crate::simulate) fn bends_required(
        &self,
        moment: &Moment,
        [phi, omega, alpha]: [f64; 3],
    ) -> Result<Vec<f64>, Error> {
        let link = DriveState { phi, omega };
        let mut values = Vec::new();
        if self.bends.losses || self.bends.gearbox {
            let torque = self.required(moment, [phi, omega, alpha])?;
            let points = self.points(moment, link)?;
            let now = Instant {
                alpha,
                ..self.solved(&points, moment.direction, link, torque)?
            };
            values.extend(self.flows(&points, moment.direction, link, &now)?);
        }
        if self.bends.opposing {
            self.turning_back(moment, link, &mut values)?;
        }
        Ok(values)
    }

    /// Output of each stage with losses, and of the motor's gearbox.
    fn flows(
        &self,
        points: &ReducedLinks<'a>,
        direction: f64,
        DriveState { phi, omega }: DriveState,
        now: &Instant,
    ) -> Result<Vec<f64>, Error> {
        let [_, at_link] = self.acting(now.motor_torque);
        let mut flows = Vec::new();
        let mut all = f64::MIN_POSITIVE + (now.motor_torque * self.ratio()).abs();
        for (k, point) in points.all().enumerate() {
            let machine = point.machine;
            let ratio = machine.ratio();
            let [_, omega, alpha] = machine.state([phi, omega, now.alpha]);
            let train = &machine.file.drive_train;
            let inertia = point.reduction.inertia;
            let given = if k == 0 { at_link } else { 0.0 };
            let [friction, _] = point.friction.torque(alpha)?;
            let resisting = point.resisting(direction * ratio, omega) + friction - given;
            let own = train.inertia_at_input() * train.ratio() * train.ratio();
            let size = ((inertia + own) * alpha).abs() + resisting.abs();
            let size = f64::MIN_POSITIVE + size + (now.motor_torque * self.ratio() / ratio).abs();
            all += size * ratio.abs();
            let delivered = train.lossy_flows(&TrainOutput {
                torque: inertia * alpha + resisting,
                torque_per_alpha: 0.0,
                omega,
                alpha,
                direction: direction * ratio,
            });
            flows.extend(delivered.into_iter().map(|torque| torque / size));
        }
        if self.bends.gearbox {
            let ratio = self.machines.first.drive_train.ratio();
            flows.push(now.input_torque * ratio / all);
        }
        Ok(flows)
    }

    /// The velocities, divided by the drive link's, of the points and links under motion-opposing loads, and in the joints with friction.
    fn turning_back(
        &self,
        moment: &Moment,
        DriveState { phi, omega }: DriveState,
        values: &mut Vec<f64>,
    ) -> Result<(), Error> {
        for machine in self.machines.all() {
            let [phi, omega, _] = machine.state([self.inside(phi), omega, 0.0]);
            let loads = machine
                .file
                .machine_among(&moment.now(&machine, omega))
                .loads();
            let mechanism = machine.file.machine.mechanism();
            let frames = mechanism.frames(phi)?;
            let joints = mechanism.joints(phi, &frames)?;
            let frictions = machine.file.machine.frictions().iter();
            let rubbing = frictions.filter_map(|friction| joints.get(friction.joint()));
            values.extend(rubbing.map(|joint| joint.coordinate(&frames).d1));
            for load in loads {
                let Some(frame) = frames.get(load.link()) else {
                    continue;
                };
                match load.action() {
                    Action::OpposingForce(_) => {
                        let [x, y] = frame.point(load.point());
                        values.push(ALONG[0] * x.d1 + ALONG[1] * y.d1);
                    }
                    Action::OpposingMoment(_) => values.push(frame.psi.d1),
                    _ => {}
                }
            }
        }
        Ok(())
    }
}
