//! The cost of each active limit: the time without it, or with more of the motor's own.

use jred_file::model::machine::MachineFile;

use super::cycle::FastestMove;
use super::field::{Binding, MoveLimits};
use super::{Task, time};
use crate::path_dynamics::Actuator;

/// Share by which torque and speed of the motor are raised to measure their cost.
pub const MORE: f64 = 0.1;

/// The cost of a limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// The limit.
    pub limit: Binding,
    /// Time (s) without it. For the motor's own limits: with a tenth more torque (driving and braking), or with a torque-speed curve stretched to a
    /// tenth more speed.
    pub time: f64,
}

/// The cost of each limit that a move reaches; where the RMS torque has a `price`, the RMS torque only.
pub(super) fn costs(
    file: &MachineFile,
    actuator: &Actuator,
    made: &FastestMove,
    priced: bool,
) -> Vec<Cost> {
    let mut met: Vec<Binding> = Vec::new();
    for phase in &made.fastest.phases {
        // Driving and braking belong to one motor.
        let limit = match phase.limit {
            Binding::Braking => Binding::Driving,
            other => other,
        };
        if !met.contains(&limit) {
            met.push(limit);
        }
    }
    if priced {
        // The price of the torque applies to the whole cycle: without it the cost of another limit is unknown.
        met.retain(|limit| *limit == Binding::RmsTorque);
    }
    let cost = |limit: Binding| {
        let (actuator, limits) = without(actuator, &made.task.limits, limit);
        let eased = Task {
            limits,
            ..made.task
        };
        // Without a motion the limit has no cost in time.
        let time = time(file, &actuator, &eased).ok()?;
        Some(Cost { limit, time })
    };
    met.into_iter().filter_map(cost).collect()
}

/// Motor and limits without a limit, or with more of the motor's own.
fn without(actuator: &Actuator, limits: &MoveLimits, limit: Binding) -> (Actuator, MoveLimits) {
    let mut actuator = actuator.clone();
    match limit {
        Binding::Driving | Binding::Braking => {
            // A tenth more torque is the same as a machine that needs a tenth less.
            for c in &mut actuator.coefficients.0 {
                *c /= 1.0 + MORE;
            }
        }
        // The envelope only: the gearbox turns no faster.
        Binding::MotorSpeed => actuator.envelope = actuator.envelope.stretched(1.0 + MORE),
        _ => {}
    }
    (actuator, limits.without(limit))
}
