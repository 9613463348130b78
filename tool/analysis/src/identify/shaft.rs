//! The shaft on which a log was recorded.

use super::smooth::smooth;
use super::{Identified, Samples};
use jred::mechanism::TrainOutput;
use jred_file::model::drive_train::DriveTrain;
use jred_file::model::machine::MachineFile;

jred_file::words! {
    /// The shaft whose position and torque a log has.
    pub enum Shaft default Motor {
        /// The motor: the drive train of the machine file, and the rotor, are taken out.
        Motor = "motor",
        /// The drive link.
        Link = "link",
    }
}

/// Half window of the filter of the acceleration (s).
const WINDOW: f64 = 0.025;

/// Rounds of the search for the output torque: one for each stage whose direction of power is not that of the guess.
const ROUNDS: usize = 20;

/// Refers samples of the motor to the drive link: without the losses of the drive train, with the torques that its shafts and a rotor (kg·m², at the
/// motor) need. Where power comes from the motor,
///
/// ```text
/// T = i·η·(T_log − J_rotor·i·α) + i²·J_rotor·α
/// ```
///
/// of one stage; shaft by shaft by [`DriveTrain::input`]. The filtered α acts on the losses alone.
pub fn referred(samples: &mut Samples, file: &MachineFile, rotor: f64) {
    let train = &file.drive_train;
    let ratio = train.ratio();
    let inertia = drive_inertia(file, rotor);
    for position in &mut samples.position {
        *position /= ratio;
    }
    let half = ((WINDOW / samples.step) as usize).max(4);
    let motion = smooth(&samples.position, samples.step, half);
    let moving = motion.speed.iter().zip(&motion.acceleration);
    for (torque, (&omega, &alpha)) in samples.torque.iter_mut().zip(moving) {
        let at = TrainOutput {
            omega,
            alpha,
            direction: omega,
            ..TrainOutput::default()
        };
        *torque = output(train, &at, *torque - rotor * ratio * alpha) + inertia * alpha;
    }
}

/// The output torque of a drive train whose input has this torque, by Newton's method: the losses make the input a convex function of straight lines.
fn output(train: &DriveTrain, motion: &TrainOutput, wanted: f64) -> f64 {
    let mut at = *motion;
    for _ in 0..ROUNDS {
        let input = train.input(&at);
        let steeper = TrainOutput {
            torque_per_alpha: 1.0,
            ..at
        };
        let slope = train.input(&steeper).torque_per_alpha - input.torque_per_alpha;
        let step = (wanted - input.torque) / slope;
        at.torque += step;
        if step.abs() <= 1e-12 * at.torque.abs() {
            break;
        }
    }
    at.torque
}

/// Inertia of drive train and rotor at the drive link (kg·m²).
fn drive_inertia(file: &MachineFile, rotor: f64) -> f64 {
    file.train_inertia() + rotor * file.drive_train.ratio().powi(2)
}

/// The machine alone: without the drive train of the file and a rotor (kg·m², at the motor).
pub fn without_drive(found: &mut Identified, file: &MachineFile, rotor: f64) {
    let inertia = drive_inertia(file, rotor);
    if let Some(mean) = found.inertia.first_mut() {
        mean.value -= inertia;
    }
    for point in &mut found.curves {
        point.inertia.value -= inertia;
    }
    found.judge_inertia();
}
