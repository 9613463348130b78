//! The fastest motion that goes on for ever: the same speed at its end as at its start.
//!
//! From a larger speed at the start the fastest motion reaches a larger speed at the end, or the same. So from the largest speed of all
//! the speed with which the limits let it come round falls, turn by turn, to the largest one that comes round to itself; no motion that
//! repeats itself is anywhere faster than the one with that speed.

use jred_machine::model::machine::MachineFile;

use super::field::Field;
use super::{Fastest, NoMotion, Task, WITHIN, refine, way};
use crate::trace::Trace;
use crate::way::Actuator;

/// Most turns until the speed repeats itself.
const TURNS: u32 = 2000;

/// Share of the speed that is left between two turns at the end.
const SAME: f64 = 1e-10;

/// The fastest motion of a task whose end is its start.
///
/// # Errors
/// There is none: nothing limits its speed, or it comes to rest; see [`NoMotion`].
pub(super) fn solve(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
) -> Result<Fastest, NoMotion> {
    let way = way(file, actuator, task)?;
    let limits = task.limits;
    let (top, _) = Field { way: &way, limits }.top();
    if !top.is_finite() {
        return Err(NoMotion::NoSpeedLimit);
    }
    let at = |speed: f64| Task {
        speeds: [speed; 2],
        endless: false,
        ..*task
    };
    let mut speed = top;
    for _ in 0..TURNS {
        let next = match refine(file, actuator, &at(speed), f64::INFINITY) {
            Err(NoMotion::StartTooFast { most, .. } | NoMotion::EndTooFast { most, .. }) => most,
            Err(why) => return Err(why),
            Ok(_) => break,
        };
        let is_same = speed - next <= SAME * speed;
        // What is left is rounding, from above.
        speed = if is_same { next * (1.0 - SAME) } else { next };
        if is_same {
            break;
        }
    }
    let found = refine(file, actuator, &at(speed), WITHIN)?;
    let mut nodes = found.trace.nodes().to_vec();
    if let [first, .., last] = nodes.as_mut_slice() {
        first.alpha[0] = last.alpha[0];
        last.alpha[1] = first.alpha[1];
    }
    Ok(Fastest {
        trace: Trace::new(found.trace.coordinate, nodes),
        ..found
    })
}
