//! The shaft on which a log was recorded.

use super::{Identified, Samples};
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

/// Samples on either side from which the direction of the motion follows.
const NEAR: usize = 5;

/// Refers samples of the motor to the drive link. The losses of the drive train take part of a driving torque, and are added to a braking one.
pub fn referred(samples: &mut Samples, file: &MachineFile) {
    let (ratio, efficiency) = (file.drive_train.ratio(), file.drive_train.efficiency());
    let last = samples.position.len().saturating_sub(1);
    let moved = |k: usize| {
        samples.position[(k + NEAR).min(last)] - samples.position[k.saturating_sub(NEAR)]
    };
    let torque = samples.torque.iter().enumerate().map(|(k, torque)| {
        let driving = torque * moved(k) >= 0.0;
        torque
            * ratio
            * if driving {
                efficiency
            } else {
                1.0 / efficiency
            }
    });
    samples.torque = torque.collect();
    for position in &mut samples.position {
        *position /= ratio;
    }
}

/// The machine alone: without the drive train of the file and a rotor (kg·m², at the motor).
pub fn without_drive(found: &mut Identified, file: &MachineFile, rotor: f64) {
    let inertia = file.train_inertia() + rotor * file.drive_train.ratio().powi(2);
    if let Some(mean) = found.inertia.first_mut() {
        mean.value -= inertia;
    }
    for point in &mut found.curves {
        point.inertia.value -= inertia;
    }
    found.judge_inertia();
}
