//! The holding brake: its holding torque, and the stop of the machine when the supply fails.

use std::fmt::Write as _;

use super::motor::{braked, falls, locks};
use super::{Context, Record, Words};
use crate::catalogue::Brake;
use jred_analysis::duty::mechanics::{BrakeStop, MotorBrake};
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::number::rounding::short;
use jred_file::units::Vocabulary;

pub(super) fn measure(context: &Context, findings: &mut impl Record) {
    let brake = context.drive.motor.brake;
    let falls = falls(context);
    if brake.is_some() || falls {
        let torque = brake.map(|brake| brake.torque);
        findings.set(Rule::BrakeTorque, Finding::against(braked(context), torque));
    }
    let Some(brake) = brake else { return };
    let stated = brake.closing_time.is_some() || brake.work.is_some();
    if (falls || stated) && !locks(context) {
        let work = stop(context, &brake).map_or(f64::NAN, |stop| stop.work);
        findings.set(Rule::BrakeWork, Finding::against(work, brake.work));
    }
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

pub(super) fn words(context: &Context, rule: Rule, finding: Finding) -> Words {
    let words = context.vocabulary();
    match rule {
        Rule::BrakeTorque => of_torque(context, finding, words),
        _ => of_work(context, finding, words),
    }
}

fn of_torque(context: &Context, finding: Finding, words: &Vocabulary) -> Words {
    let torque = &words.torque;
    let rating = if finding.rating.is_nan() {
        "holding brake of the motor, without which the machine moves when it is switched off"
            .to_owned()
    } else {
        format!("brake {torque}")
    };
    let place = if locks(context) {
        "the gearbox is self-locking and holds by itself".to_owned()
    } else {
        format!("{torque} at standstill without the help of friction")
    };
    Words {
        unit: torque.unit,
        scale: torque.scale,
        rating,
        place,
    }
}

fn of_work(context: &Context, finding: Finding, words: &Vocabulary) -> Words {
    let brake = context.drive.motor.brake.unwrap_or_default();
    let rating = match (finding.value.is_nan(), finding.rating.is_nan()) {
        (false, false) => "work of the brake in one emergency stop",
        (true, false) => "closing time of the brake, brake_closing_time in the catalogue",
        (false, true) => {
            "work that the brake bears in one emergency stop, brake_work in the catalogue"
        }
        (true, true) => {
            "closing time of the brake and its work in one emergency stop, brake_closing_time and brake_work in the catalogue"
        }
    };
    let mut place = String::new();
    if let Some(stop) = stop(context, &brake) {
        place = run_on(context, &stop);
        if brake.dynamic_torque.is_none() {
            let torque = words.torque;
            let _ = write!(
                place,
                "; brake_dynamic_{torque} not given, using the static {torque}"
            );
        }
        if let Some(stops) = brake.stops_per_hour {
            let _ = write!(place, "; at most {} such stops per hour", short(stops));
        }
    }
    Words {
        unit: "J",
        scale: 1.0,
        rating: rating.to_owned(),
        place,
    }
}

/// Distance that the machine continues to run when the supply fails.
fn run_on(context: &Context, stop: &BrakeStop) -> String {
    let mechanics = context.cycle.mechanics();
    let (slides, slope, of) = match (mechanics.tool_slope, &context.site.tool) {
        (Some(slope), Some(tool)) => (
            !matches!(tool.place, jred_file::model::site::ToolPlace::Turning),
            slope,
            tool.name.as_str(),
        ),
        _ => (mechanics.slides, 1.0, "the drive link"),
    };
    let (unit, scale) = if slides {
        ("mm", 1e-3)
    } else {
        ("deg", jred_file::units::DEGREE)
    };
    let shown = |way: f64| {
        let way = way * slope / mechanics.train_ratio / scale;
        if way.is_finite() {
            format!("{} {unit}", short(way))
        } else {
            "without end".to_owned()
        }
    };
    format!(
        "if the supply fails, {of} runs on by at most {} until the brake closes and {} until it stops",
        shown(stop.falling),
        shown(stop.way)
    )
}
