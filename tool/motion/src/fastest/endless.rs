//! The fastest motion that repeats endlessly: its speed at the end equals its speed at the start.
//!
//! A larger start speed never gives a smaller end speed. Iterating from the largest possible speed therefore descends, turn by turn, to the largest
//! speed that repeats itself. No repeating motion is faster anywhere than the motion with this speed.

use jred_file::model::machine::MachineFile;

use super::field::Field;
use super::path_search::PathSearch;
use super::{Fastest, NoMotion, Task, dynamics};
use crate::path_dynamics::Actuator;
use crate::trace::Trace;

/// Most turns until the speed repeats: first successive turns, then bisection between speeds that are too fast and speeds that are not.
const TURNS: u32 = 200;
const FALLS: u32 = 12;

/// Relative difference of the speeds at the two ends at which the search stops.
const SPEED_TOLERANCE: f64 = 1e-10;

/// Shares of the speed by which finer cells may slow the turn.
const FINER: [f64; 4] = [1e-10, 1e-9, 1e-8, 1e-7];

/// The fastest motion of a task whose end is its start, checked between its nodes where `within` is finite.
///
/// # Errors
/// No motion exists: nothing limits its speed, or it comes to rest; see [`NoMotion`].
pub(super) fn solve(
    file: &MachineFile,
    actuator: &Actuator,
    task: &Task,
    within: f64,
) -> Result<Fastest, NoMotion> {
    let dynamics = dynamics(file, actuator, task)?;
    let limits = task.limits;
    let field = Field {
        dynamics: &dynamics,
        limits,
    };
    let (top, _) = field.top();
    if !top.is_finite() {
        return Err(NoMotion::NoSpeedLimit);
    }
    let course = PathSearch::new(&field, task)?;
    let at = |speed: f64, within: f64| course.fastest([speed; 2], within);
    // Bracket: at `high` the speed is too fast to repeat; at `low` it repeats, or the machine stops.
    let (mut high, mut low) = (top, 0.0);
    let mut stopped = None;
    for turn in 0..TURNS {
        if high - low <= SPEED_TOLERANCE * high {
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
                // The next turn is the same except for rounding.
                if speed - high <= SPEED_TOLERANCE * speed && turn < FALLS {
                    (low, stopped) = (high * (1.0 - SPEED_TOLERANCE), None);
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
    // With finer cells the repeating speed may be slightly lower.
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
