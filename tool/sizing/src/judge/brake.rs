//! The holding brake: its holding torque, and the stop of the machine when the supply fails.

use super::motor::{braked, falls, locks};
use super::{Context, Grounds, Record};
use crate::catalogue::Brake;
use jred_analysis::duty::mechanics::{BrakeStop, MotorBrake};
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::model::site::ToolPlace;

pub(super) fn measure(context: &Context, findings: &mut impl Record) {
    let brake = context.drive.motor.brake;
    let falls = falls(context);
    if brake.is_some() || falls {
        // A motor ordered without its optional brake has none.
        let without = context.drive.motor.brake_is_optional.then_some(0.0);
        let torque = brake.map(|brake| brake.torque).or(without);
        findings.set(Rule::BrakeTorque, Finding::against(braked(context), torque));
    }
    let Some(brake) = brake else { return };
    let stated = brake.closing_time.is_some() || brake.work.is_some();
    if (falls || stated) && !locks(context) {
        let work = stop(context, &brake).map_or(f64::NAN, |stop| stop.work);
        let allowed = allowed_work(&brake, context.site.emergency_stops);
        findings.set(Rule::BrakeWork, Finding::against(work, allowed));
    }
}

/// Largest work of one stop (J): more stops per hour than the brake bears may heat it no more than those.
fn allowed_work(brake: &Brake, stops: Option<f64>) -> Option<f64> {
    let Some(stops) = stops else {
        return brake.work;
    };
    Some(brake.work? * (brake.stops_per_hour? / stops).min(1.0))
}

/// The worst stop by the brake alone; `None` if its closing time is not given.
fn stop(context: &Context, brake: &Brake) -> Option<BrakeStop> {
    let closing = MotorBrake {
        torque: brake.dynamic_torque.unwrap_or(brake.torque),
        time: brake.closing_time?,
        inertia: context.coefficients.0[0] / context.ratio,
        ratio: context.ratio,
    };
    Some(context.cycle.mechanics().run_on.worst(&closing))
}

/// Grounds of the rule of the brake's work.
pub(super) fn stopped(context: &Context) -> Grounds {
    let brake = context.drive.motor.brake.unwrap_or_default();
    let Some(stop) = stop(context, &brake) else {
        return Grounds::None;
    };
    let mechanics = context.cycle.mechanics();
    let (slides, slope, tool) = match (mechanics.tool_slope, &context.site.tool) {
        (Some(slope), Some(tool)) => (
            tool.place != ToolPlace::Turning,
            slope,
            Some(tool.name.clone()),
        ),
        _ => (mechanics.slides, 1.0, None),
    };
    Grounds::BrakeStop {
        ways: [stop.falling, stop.way].map(|way| way * slope / mechanics.train_ratio),
        slides,
        tool,
        dynamic: brake.dynamic_torque.is_some(),
        per_hour: brake.stops_per_hour,
        stops: context.site.emergency_stops,
    }
}
