//! What a plan for firmware is, in a line.

use jred::axis::plan::Errors;
use jred_machine::number::rounding::short;
use jred_machine::number::words::counted;
use jred_motion::plan::Plan;
use jred_motion::trace::Trace;

/// Rows, bytes, and what it is off by.
pub fn text(plan: &Plan, trace: &Trace) -> String {
    let coordinate = trace.coordinate;
    let Errors {
        position,
        speed,
        acceleration,
    } = plan.errors;
    let [_, acceleration_unit] = coordinate.rates();
    format!(
        "{}, {} bytes, {} s; beside the motion off by at most {} {}, {} {} and {} {}",
        counted(plan.rows, "row", "rows"),
        4 * plan.words.len(),
        short(trace.duration()),
        short(coordinate.shown(position.into())),
        coordinate.unit(),
        short(speed.into()),
        coordinate.speed_unit(),
        short(acceleration.into()),
        acceleration_unit.unit
    )
}
