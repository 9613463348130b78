//! The load of the motor in a motion: RMS torque with the pauses, peaks, and the pause that its S1 torque requires.

use std::convert::Infallible;

use jred::error::Error;
use jred::machine::motion::State;
use jred_file::model::machine::MachineFile;
use jred_file::number::numerics;
use jred_file::number::quadrature::GAUSS_2;

use super::field::Reserve;
use crate::path_dynamics::{Actuator, BothDirections};
use crate::trace::{Node, Trace};

/// The load of a motor in a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorLoad {
    /// RMS torque (N·m) over the motion; pauses count with the holding torque.
    pub rms: f64,
    /// Largest torque (N·m) and speed (rad/s), as magnitudes.
    pub peaks: [f64; 2],
    /// Mean of the absolute speed (rad/s).
    pub mean_speed: f64,
    /// Magnitude of the holding torque (N·m) at the end, or at the last rest of the motion.
    pub holding: f64,
    /// S1 torque (N·m) at the mean speed; infinite: no data.
    pub continuous: f64,
    /// Limit of the RMS torque (N·m): that S1 torque less the reserve.
    pub allowed: f64,
    /// Pause (s) to be added so that the RMS torque keeps that limit; `None`: even holding exceeds it.
    pub pause: Option<f64>,
}

/// The load of the motor in a motion, with the reserve of its S1 torque.
///
/// # Errors
/// The mechanism cannot be placed somewhere.
pub(super) fn load(
    file: &MachineFile,
    actuator: &Actuator,
    trace: &Trace,
    reserve: &Reserve,
) -> Result<MotorLoad, Error> {
    let ways = BothDirections::new(file, actuator);
    let forwards = ways.forwards();
    let (mut squares, mut turns) = (0.0, 0.0);
    let mut peaks = [0.0_f64; 2];
    for [a, b] in trace.steps() {
        let (step, heading) = (b.step, b.phi - a.phi);
        for [share, weight] in GAUSS_2 {
            let motor = ways.torque(&b.after(a, share), heading)?;
            squares += weight * step * motor * motor;
        }
        turns += heading.abs();
        for (node, alpha) in [(a, a.alpha[1]), (b, b.alpha[0])] {
            let Node { phi, omega, .. } = *node;
            let motor = ways.torque(&State { phi, omega, alpha }, heading)?;
            peaks[0] = peaks[0].max(motor.abs());
            peaks[1] = peaks[1].max(forwards.motor_speed(node.omega.abs()));
        }
    }
    let duration = trace.duration();
    // In a motion that does not end at rest, the last rest before.
    let mut backwards = trace.nodes().iter().rev();
    let rest = backwards.find(|node| node.omega == 0.0);
    let end = rest.or(trace.nodes().last()).map_or(0.0, |node| node.phi);
    let holding = forwards.holding(&forwards.place_at_rest(end)?).abs();
    let mean_speed = forwards.motor_speed(turns) / duration;
    // At constant largest speed, rounding must not step beyond the curve.
    let s1 =
        |mean: f64| (actuator.envelope).continuous_torque(mean.min(actuator.envelope.max_speed()));
    let leaves = reserve.leaves(reserve.rms);
    let continuous = s1(mean_speed);
    // A pause also lowers the mean speed, and the S1 torque rises with it.
    let suffices = |pause: f64| {
        let time = duration + pause;
        let allowed = leaves * s1(mean_speed * duration / time);
        squares + holding * holding * pause <= allowed * allowed * time
    };
    let pause = least_pause(suffices, duration);
    Ok(MotorLoad {
        rms: (squares / duration).sqrt(),
        peaks,
        mean_speed,
        holding,
        continuous,
        allowed: leaves * continuous,
        pause,
    })
}

/// The longest pause to try, in durations of the motion.
const LONGEST: f64 = 1e6;

/// The shortest sufficient pause; `None` if even the longest one is too short.
fn least_pause(suffices: impl Fn(f64) -> bool, duration: f64) -> Option<f64> {
    if suffices(0.0) {
        return Some(0.0);
    }
    let mut long = duration;
    while !suffices(long) {
        long *= 2.0;
        if long > LONGEST * duration {
            return None;
        }
    }
    let short = |pause: f64| Ok::<_, Infallible>(!suffices(pause));
    let Ok(pause) = numerics::edge(short, 0.0, long);
    Some(pause)
}
