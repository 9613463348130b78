//! The shaft on which a log was recorded.

use super::fit::DELAY;
use super::smooth::smooth;
use super::{Identified, Obstacle, Options, Samples, identify};
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

impl Shaft {
    /// The other of the two.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Motor => Self::Link,
            Self::Link => Self::Motor,
        }
    }
}

/// Half window of the filter of the acceleration (s).
const WINDOW: f64 = 0.025;

/// Identifications with a better delay each, and the change (s) of the delay that ends them.
const TRIES: usize = 3;
const SETTLED: f64 = 2e-4;

/// Rounds of the search for the output torque: one for each stage whose direction of power is not that of the guess.
const ROUNDS: usize = 20;

/// Refers samples of the motor to the drive link: without the losses of the drive train, with the torques that its shafts and a rotor (kg·m², at the
/// motor) need. Where power comes from the motor,
///
/// ```text
/// T = i·η·(T_log − J_rotor·i·α) + i²·J_rotor·α
/// ```
///
/// of one stage; shaft by shaft by [`DriveTrain::input`]. The filtered α acts on the losses alone. The torque is `delay` (s) late, and so are ω and α
/// that belong to it.
pub fn referred(samples: &mut Samples, file: &MachineFile, rotor: f64, delay: f64) {
    let train = &file.drive_train;
    let ratio = train.ratio();
    let inertia = drive_inertia(file, rotor);
    for position in &mut samples.position {
        *position /= ratio;
    }
    let half = ((WINDOW / samples.step) as usize).max(4);
    let motion = smooth(&samples.position, samples.step, half);
    let last = samples.position.len().saturating_sub(1);
    for (k, torque) in samples.torque.iter_mut().enumerate() {
        let place = (k as f64 - delay / samples.step).clamp(0.0, last as f64);
        let before = place as usize;
        let share = place - before as f64;
        let late = |of: &[f64]| of[before] + share * (of[(before + 1).min(last)] - of[before]);
        let (omega, alpha) = (late(&motion.speed), late(&motion.acceleration));
        let at = TrainOutput {
            omega,
            alpha,
            direction: omega,
            ..TrainOutput::default()
        };
        *torque = output(train, &at, *torque - rotor * ratio * alpha) + inertia * alpha;
    }
}

/// Identifies the machine behind a motor from samples at the motor: drive train and rotor (kg·m²) are taken out as late as the torque is.
///
/// # Errors
/// Why the log does not determine the machine.
pub fn of_motor(
    samples: &Samples,
    file: &MachineFile,
    rotor: f64,
    options: &Options,
) -> Result<Identified, Obstacle> {
    let at = |delay: f64| {
        let mut own = samples.clone();
        referred(&mut own, file, rotor, delay);
        identify(&own, options)
    };
    let mut delay = options.delay.unwrap_or(DELAY);
    let mut found = at(delay)?;
    for _ in 1..TRIES {
        if (found.delay.value - delay).abs() < SETTLED {
            break;
        }
        delay = found.delay.value;
        found = at(delay)?;
    }
    without_drive(&mut found, file, rotor);
    Ok(found)
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
