//! Mean losses over a cycle, for motors without time constants.
//!
//! The mean is the exact integral over the cycle, like that of the RMS torque, even where the losses bend within a panel. Where the S1 torque does
//! not fall with speed, the relative model's mean is (T_rms/M₀)² to the last digits. Parts:
//!
//! - copper, and its share of the rated loss, from the RMS of torque or current ([`Cycle::rms_torque`], [`rms_current`]);
//! - friction c·|n|‾ + b·n_rms²;
//! - the loss of S1 torque with speed, max(0, 1 − (T_S1(n)/M₀)²), from the distribution of |n| over the cycle.

use super::network::Losses;
use super::{Load, Model};
use crate::cycle::Cycle;
use crate::cycle::form::{Coefficients, LOADS};
use crate::cycle::speeds::SpeedFunction;
use crate::motor::envelope::{Envelope, MotorLimits, TorqueSegment};

impl Model {
    /// The mean losses (W; in the relative model shares of the rated ones). Cost: a few square roots; in the relative model also the logarithm of the
    /// number of instants for each line or hyperbola of the S1 torque. Instants where the voltage line of a winding limits the S1 torque, and those
    /// of [`rms_current`], are evaluated one by one.
    pub fn mean_losses(&self, load: &Load) -> Losses {
        let Load {
            cycle,
            coefficients,
            ratio,
            motor,
            prepared,
        } = *load;
        match *self {
            Self::Bodies { copper, .. } | Self::Steady { copper, .. } => {
                let [coulomb, viscous] = motor.friction;
                let current = rms_current(cycle, coefficients, ratio, prepared).unwrap_or(0.0);
                let speed = cycle.rms_torque(&Coefficients([0.0, 0.0, 0.0, ratio, 0.0]));
                Losses {
                    copper: copper * current * current,
                    other: coulomb * cycle.mean_speed() * ratio + viscous * speed * speed,
                }
            }
            Self::Relative { standstill, s1, .. } => {
                let root = cycle.rms_torque(coefficients) / standstill;
                Losses {
                    copper: root * root,
                    other: lost_to_speed(cycle, ratio, &prepared.envelope, s1),
                }
            }
        }
    }
}

/// RMS current (A). For a current proportional to the torque it is T_rms/k_t; instants at which the iron saturates add the excess. With field
/// weakening every instant is evaluated. `None` without a torque constant.
pub fn rms_current(
    cycle: &Cycle,
    coefficients: &Coefficients,
    ratio: f64,
    prepared: &MotorLimits,
) -> Option<f64> {
    let curve = prepared.torques?;
    let bent = cycle.bent(coefficients, ratio);
    let straight = cycle.rms_torque(coefficients) / curve.torque_constant();
    let whole = straight * straight * cycle.duration();
    if prepared.circuit.as_ref().is_some_and(|c| c.weakens) {
        let squares = bent.over_all(whole, |torque, speed| {
            let current = prepared.current(torque, speed);
            current.unwrap_or(f64::NAN).powi(2)
        });
        return Some((squares / cycle.duration()).sqrt());
    }
    let mut more = 0.0;
    if curve.saturates() {
        let mut beyond = Vec::new();
        cycle.beyond(coefficients, curve.knee(), |k| beyond.push(k));
        more = bent.over(&beyond, whole, |torque, _| {
            let (current, along) = (
                curve.current(torque),
                torque.abs() / curve.torque_constant(),
            );
            (current - along) * (current + along)
        });
    }
    Some((straight * straight + more / cycle.duration()).sqrt())
}

/// Mean of max(0, 1 − (T_S1/M₀)²).
fn lost_to_speed(cycle: &Cycle, ratio: f64, envelope: &Envelope, standstill: f64) -> f64 {
    let on = |speeds: [f64; 2]| {
        let speeds = speeds.map(|speed| speed * ratio);
        let (torques, form) = match envelope.continuous_segment(speeds)? {
            TorqueSegment::Unknown => return Some(SpeedFunction::Zero),
            TorqueSegment::Line(torques) => {
                let shares = torques.map(|torque| torque / standstill);
                (torques, SpeedFunction::LessLine(shares))
            }
            TorqueSegment::Power(power) => (
                speeds.map(|speed| power / speed),
                SpeedFunction::LessInverse(power / (standstill * ratio)),
            ),
        };
        if torques.iter().all(|torque| *torque >= standstill) {
            Some(SpeedFunction::Zero)
        } else if torques.iter().any(|torque| *torque > standstill) {
            None
        } else {
            Some(form)
        }
    };
    let at = |speed: f64| {
        let s1 = envelope.continuous_torque(speed * ratio) / standstill;
        (1.0 - s1 * s1).max(0.0)
    };
    let sum = cycle.speeds().sum(on, at);
    // Panels in which the S1 torque bends.
    let open = cycle.at_speeds(&|speeds| on(speeds).is_none());
    let still = Coefficients([0.0; LOADS]);
    let bent = cycle.bent(&still, 1.0);
    let more = bent.more(&open, cycle.duration(), |_, speed| at(speed.abs()));
    (sum + more) / cycle.duration()
}
