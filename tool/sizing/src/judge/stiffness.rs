//! Whether the machine is rigid enough to be sized as a rigid body (VDI 2149), and its backlash.
//!
//! The gearbox and the shafts are springs in series between two masses, the rotor and the machine. A motor that holds its position is a fixed end,
//! and the machine oscillates with f_1 = √(c/J)/2π. With a free rotor the frequency is higher, √(c/J + c/(i²·J_1))/2π. The first, lower one is
//! checked, at the largest J of the cycle, where it is lowest.

use std::f64::consts::TAU;

use super::{Context, Record, Words};
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::model::site::ToolPlace;
use jred_file::number::rounding::short;
use jred_file::units::DEGREE;
use jred_file::units::Vocabulary;

/// Measures both; they depend only on gearbox, machine and cycle, not on the motor.
pub(super) fn measure(context: &Context, findings: &mut impl Record) {
    let frequency = stiffness(context).map_or(Finding::UNKNOWN, |stiffness| {
        let fixed = frequency(stiffness, 1.0 / context.cycle.inertia().max);
        Finding::new(fixed, context.cycle.mechanics().drive_frequency)
    });
    findings.set(Rule::NaturalFrequency, frequency);
    if let Some(tool) = &context.site.tool {
        findings.set(
            Rule::Backlash,
            Finding::against(play(context).unwrap_or(f64::NAN), Some(tool.play)),
        );
    }
}

/// Stiffness between rotor and machine at the gearbox output (N·m/rad): gearbox and shafts in series. Shafts not given in the machine file are rigid.
/// `None` without data, or if the gearbox has no data.
fn stiffness(context: &Context) -> Option<f64> {
    let shafts = context.site.shaft_stiffness;
    match context.drive.gearbox {
        None => shafts,
        Some(gearbox) => {
            let own = gearbox.stiffness?;
            Some(shafts.map_or(own, |shafts| own * shafts / (own + shafts)))
        }
    }
}

/// Lowest natural frequencies (Hz) over the cycle: with the motor holding its position, and with its rotor free.
fn frequencies(context: &Context) -> Option<[f64; 2]> {
    let stiffness = stiffness(context)?;
    let inertia = context.cycle.inertia().max;
    let rotor = context.coefficients.0[0] * context.ratio;
    Some([
        frequency(stiffness, 1.0 / inertia),
        frequency(stiffness, 1.0 / inertia + 1.0 / rotor),
    ])
}

/// f = √(c/J)/2π (Hz), from a stiffness (N·m/rad) and the inverse of an inertia (kg·m²).
fn frequency(stiffness: f64, per_inertia: f64) -> f64 {
    (stiffness * per_inertia).sqrt() / TAU
}

/// Backlash at the tool (m or rad): of the gearbox through the drive train, and of the drive train, by the largest transfer function of the motion;
/// `None` if the gearbox has no data.
fn play(context: &Context) -> Option<f64> {
    let mechanics = context.cycle.mechanics();
    let gearbox = match context.drive.gearbox {
        None => 0.0,
        Some(gearbox) => gearbox.backlash?,
    };
    let train = context.site.train_play.unwrap_or(0.0);
    Some(mechanics.tool_slope? * (gearbox / mechanics.train_ratio + train))
}

pub(super) fn words(context: &Context, rule: Rule, finding: Finding) -> Words {
    if rule == Rule::Backlash {
        return backlash(context, finding);
    }
    let (rating, place) = if let Some([_, free]) = frequencies(context) {
        let shafts = match (context.drive.gearbox, context.site.shaft_stiffness) {
            (Some(_), None) => "; stiffness of the shafts not given; using rigid shafts",
            _ => "",
        };
        let free = short(free);
        let Vocabulary { inertia, rotor, .. } = context.vocabulary();
        let place = format!(
            "the motor holding its position at the largest {inertia} of the cycle ({free} Hz with a free {rotor}){shafts}"
        );
        ("drive frequency", place)
    } else if context.drive.gearbox.is_some() {
        ("torsional stiffness of the gearbox", String::new())
    } else {
        let missing = "stiffness of the shafts, [stiffness] of the machine file";
        (missing, String::new())
    };
    Words {
        unit: "Hz",
        scale: 1.0,
        rating: rating.to_owned(),
        place,
    }
}

fn backlash(context: &Context, finding: Finding) -> Words {
    let tool = context.site.tool.as_ref();
    let (unit, scale) = match tool.map(|tool| tool.place) {
        Some(ToolPlace::Turning) => ("deg", DEGREE),
        _ => ("mm", 1e-3),
    };
    let name = tool.map_or("", |tool| tool.name.as_str());
    let rating = if finding.is_known() {
        format!("backlash allowed at {name}")
    } else {
        "backlash of the gearbox".to_owned()
    };
    let train = match context.site.train_play {
        None if finding.is_known() => "; backlash of the drive train not given; using none",
        _ => "",
    };
    Words {
        unit,
        scale,
        rating,
        place: format!("at the largest transfer function of {name} in the motion{train}"),
    }
}
