//! The DC bus: power drawn and fed back by one drive or several, bus voltage and brake resistor.
//!
//! The power that a drive draws from the bus is the shaft power of the motor torque (which covers all friction behind it), the copper loss and the
//! losses of the amplifier:
//!
//! ```text
//! P = T·ω + R·I² + p₀ + p₁·I        R at 20 °C; of a three-phase winding 3/2 of that between two terminals
//! ```
//!
//! The losses are the smallest possible, so that the most energy comes back. The copper is cold, and its loss is omitted if the winding's resistance
//! is not given. While the motor brakes, I is the current of the torque alone, because the rise of the bus voltage and the remaining field weakening
//! are unknown. While it drives, I includes the field-weakening current. A stop in which the drive brakes the machine feeds back the work of the motor's
//! torque, without losses.

pub mod analysis;
pub mod axes;
pub mod conflict;
pub mod cure;
pub mod curve;
pub mod need;
pub mod period;
mod phases;
pub mod store;
pub mod supply;
pub mod verdict;

pub use need::Need;
pub use phases::Watch;

use crate::catalogue::{Amplifier, Motor};
use crate::cycle::Cycle;
use crate::cycle::form::Coefficients;
use crate::motor::envelope::MotorLimits;
use crate::motor::winding::REFERENCE_TEMPERATURE;
use jred_analysis::duty::mechanics::MotorBrake;

use curve::{PowerCurve, StopPower};

/// Power that a drive draws from the DC bus over the cycle.
pub fn power(
    cycle: &Cycle,
    coefficients: &Coefficients,
    ratio: f64,
    motor: &Motor,
    prepared: &MotorLimits,
    amplifier: Option<&Amplifier>,
) -> PowerCurve {
    let resistance = motor.winding.loss_resistance(REFERENCE_TEMPERATURE);
    let [constant, per_ampere] = amplifier.map_or([0.0; 2], |a| a.losses);
    let points = cycle.samples().iter().map(|sample| {
        let torque = coefficients.torque(&sample.loads());
        let speed = sample.speed() * ratio;
        let mut power = torque * speed + constant;
        let current = if torque * speed < 0.0 {
            prepared.torques.map(|curve| curve.current(torque))
        } else {
            prepared.current(torque, speed)
        };
        if let Some(current) = current {
            power += per_ampere * current + resistance.unwrap_or(0.0) * current * current;
        }
        [sample.t, power]
    });
    let samples: Vec<[f64; 2]> = points.collect();
    // The voltage has extremes where the power changes sign.
    let mut points = Vec::with_capacity(samples.len());
    for (k, sample) in samples.iter().enumerate() {
        let [next, b] = *sample;
        if let Some([t, a]) = k.checked_sub(1).map(|before| samples[before])
            && a * b < 0.0
            && next > t
        {
            points.push([t + (next - t) * (a / (a - b)), 0.0]);
        }
        points.push(*sample);
    }
    PowerCurve::new(points, cycle.duration())
}

/// Power that a drive feeds back in the worst stop with this `share` of the motor's peak torque; `None`: it does not stop so.
pub fn stop(
    cycle: &Cycle,
    coefficients: &Coefficients,
    ratio: f64,
    limits: &MotorLimits,
    share: Option<f64>,
) -> StopPower {
    let Some(share) = share else {
        return StopPower::default();
    };
    let brake = MotorBrake {
        torque: share * limits.stop,
        time: 0.0,
        inertia: coefficients.0[0] / ratio,
        ratio,
    };
    let worst = cycle.mechanics().run_on.worst(&brake);
    StopPower {
        peak: brake.torque * ratio * worst.speed,
        energy: worst.work,
    }
}
