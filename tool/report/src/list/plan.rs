//! What a plan for firmware is, in a line.

use jred::axis::plan::Errors;
use jred_file::number::rounding::{bound, short};
use jred_file::number::words::counted;
use jred_motion::plan::{Excess, Plan, Quantity};
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
    let ramp = match plan.ramp {
        None => String::new(),
        Some(ramp) if ramp.is_finite() => format!(
            "; a ramp of the rate from 0 to 100 % in {} s or more keeps the torque of the drive",
            bound(ramp)
        ),
        Some(_) => "; no change of the rate keeps the torque of the drive, of which the motion uses all (--reserve leaves some)".to_owned(),
    };
    format!(
        "{}, {} bytes, {} s; beside the motion off by at most {} {}, {} {} and {} {}{ramp}",
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

/// Where it is off by more than was asked, if it is.
pub fn warning(plan: &Plan, trace: &Trace) -> Option<String> {
    let Excess {
        quantity,
        error,
        allowed,
        t,
    } = plan.excess?;
    let coordinate = trace.coordinate;
    let [_, acceleration_unit] = coordinate.rates();
    let shown = |value: f64| match quantity {
        Quantity::Position => coordinate.shown(value),
        Quantity::Speed | Quantity::Acceleration => value,
    };
    let (name, unit) = match quantity {
        Quantity::Position => ("position", coordinate.unit()),
        Quantity::Speed => ("speed", coordinate.speed_unit()),
        Quantity::Acceleration => ("acceleration", &*acceleration_unit.unit),
    };
    Some(format!(
        "the plan's {name} is off by {} {unit} at {} s, but --plan-error allows {} {unit}: position, speed and acceleration of the motion contradict each other there, \
         a part of it is left out that is too short for a row, or it is finer than a plan's integers; give a larger --plan-error",
        short(shown(error)),
        short(t),
        short(shown(allowed)),
    ))
}
