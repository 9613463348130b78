//! A plan for firmware in one line.

use jred::axis::plan::Errors;
use jred_file::number::rounding::{bound, short};
use jred_file::number::words::counted;
use jred_motion::plan::{Excess, MotionQuantity, Plan};
use jred_motion::trace::Trace;

/// Rows, bytes, and largest errors.
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
            "; a ramp of the rate from 0 to 100 % in {} s or more stays within the drive's torque",
            bound(ramp)
        ),
        Some(_) => "; the rate cannot be changed, because the motion uses the drive's full torque (--reserve leaves some)".to_owned(),
    };
    format!(
        "{}, {} bytes, {} s; errors against the motion at most {} {}, {} {} and {} {}{ramp}",
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

/// A warning if the error exceeds the allowed one.
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
        MotionQuantity::Position => coordinate.shown(value),
        MotionQuantity::Speed | MotionQuantity::Acceleration => value,
    };
    let (name, unit) = match quantity {
        MotionQuantity::Position => ("position", coordinate.unit()),
        MotionQuantity::Speed => ("speed", coordinate.speed_unit()),
        MotionQuantity::Acceleration => ("acceleration", &*acceleration_unit.unit),
    };
    Some(format!(
        "the error of the plan's {name} is {} {unit} at {} s, but --plan-error allows {} {unit}: position, speed and acceleration of the motion are inconsistent there, \
         a part too short for a row is left out, or the allowed error is finer than a plan's integers; give a larger --plan-error",
        short(shown(error)),
        short(t),
        short(shown(allowed)),
    ))
}
