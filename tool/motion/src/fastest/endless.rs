//! The fastest motion that goes on for ever: the same speed at its end as at its start.
//!
//! From a larger speed at the start the fastest motion reaches a larger speed at the end, or the same. So from the largest speed of all
//! the speed with which the limits let it come round falls, turn by turn, to the largest one that comes round to itself; no motion that
//! repeats itself is anywhere faster than the one with that speed.

use jred_machine::model::machine::MachineFile;

use super::course::Course;
use super::field::Field;
use super::{Fastest, NoMotion, Task, way};
use crate::trace::Trace;
use crate::way::Actuator;

/// Most turns until the speed repeats itself: first those that the machine makes one after another, then halvings between speeds that are too fast and
/// not.
const TURNS: u32 = 200;
const FALLS: u32 = 12;

/// Share of the speed that is left between two turns at the end.
const SAME: f64 = 1e-10;

/// Shares of the speed by which finer cells may make the turn slower.
const FINER: [f64; 4] = [1e-10, 1e-9, 1e-8, 1e-7];

/// The fastest motion of a task whose end is its start, looked at between its nodes where `within` is finite.
///
/// # Errors
/// There is none: nothing limits its speed, or it comes to rest; see [`NoMotion`].
pub(super) fn solve(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
    within: f64,
) -> Result<Fastest, NoMotion> {
    let way = way(file, actuator, task)?;
    let limits = task.limits;
    let field = Field { way: &way, limits };
    let (top, _) = field.top();
    if !top.is_finite() {
        return Err(NoMotion::NoSpeedLimit);
    }
    let course = Course::new(&field, task)?;
    let at = |speed: f64, within: f64| course.fastest([speed; 2], within);
    // A speed at which it cannot come round, above the one sought, and one at which it does, or cannot go on.
    let (mut high, mut low) = (top, 0.0);
    let mut stopped = None;
    for turn in 0..TURNS {
        if high - low <= SAME * high {
            break;
        }
        let speed = if turn < FALLS {
            high
        } else {
            high.midpoint(low)
        };
        match at(speed, f64::INFINITY) {
            Err(NoMotion::StartTooFast { most, .. } | NoMotion::EndTooFast { most, .. }) => {
                high = most.min(speed);
                // The next turn is the same but for rounding.
                if speed - high <= SAME * speed && turn < FALLS {
                    (low, stopped) = (high * (1.0 - SAME), None);
                }
            }
            Err(why) if turn == 0 => return Err(why),
            Err(why) => (low, stopped) = (speed, Some(why)),
            Ok(_) => (low, stopped) = (speed, None),
        }
    }
    if let Some(why) = stopped {
        return Err(why);
    }
    // With finer cells it may come round a little more slowly.
    let mut speed = low;
    let mut found = at(speed, within);
    for share in FINER {
        let Err(NoMotion::StartTooFast { .. } | NoMotion::EndTooFast { .. }) = found else {
            break;
        };
        speed = low * (1.0 - share);
        found = at(speed, within);
    }
    let found = found.map_err(|why| match why {
        NoMotion::NotAccurate {
            excess,
            phi,
            change,
            axis,
            ..
        } => NoMotion::NotAccurate {
            excess,
            phi,
            change,
            endless: true,
            axis,
        },
        other => other,
    })?;
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
