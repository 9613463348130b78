//! Temperature of winding and housing.

use super::{Context, Record, Words};
use crate::thermal::classify::Features;
use crate::thermal::loss_curve::PeakRise;
use crate::thermal::{Heating, Load, Model, allowed_rise};
use jred_file::model::operation::Operation;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::units::{Sentence, Vocabulary};

pub(super) fn follow(context: &Context, findings: &mut impl Record) {
    let Ok(heating) = heating(context) else {
        findings.set(Rule::WindingTemperature, Finding::UNKNOWN);
        return;
    };
    let [winding, housing] = match heating.hottest {
        PeakRise::Rise(rise) => rise,
        PeakRise::Runaway => [f64::INFINITY; 2],
    };
    let surroundings = &context.site.surroundings;
    let allowed = allowed_rise(context.drive.motor, surroundings, heating.relative);
    findings.set(Rule::WindingTemperature, Finding::against(winding, allowed));
    if let Some(limit) = surroundings.housing {
        let finding = if heating.housing {
            Finding::new(housing, limit - surroundings.ambient)
        } else {
            Finding::UNKNOWN
        };
        findings.set(Rule::HousingTemperature, finding);
    }
}

/// Temperatures, as far as the motor data allow.
fn heating(context: &Context) -> Result<Heating, Sentence> {
    let (site, prepared) = (context.site, context.motor);
    let load = load(context);
    let surroundings = &site.surroundings;
    let model = Model::of(load.motor, prepared, surroundings, load.cycle.duration())?;
    let operation = &site.duty.operation;
    let held = match operation {
        Operation::Intermittent { holding: true, .. } => super::motor::holding(context),
        _ => 0.0,
    };
    model.heating(&load, operation, model.at_rest(prepared, held))
}

const fn load<'a>(context: &'a Context) -> Load<'a> {
    Load {
        cycle: context.cycle,
        coefficients: &context.coefficients,
        ratio: context.ratio,
        motor: context.drive.motor,
        prepared: context.motor,
    }
}

pub(super) fn words(context: &Context, rule: Rule, finding: Finding) -> Words {
    let found = heating(context);
    let relative = found.as_ref().is_ok_and(|found| found.relative);
    let surroundings = &context.site.surroundings;
    let Vocabulary { torque, .. } = context.vocabulary();
    let unknown = match &found {
        Err(missing) => Some(missing(context.vocabulary())),
        Ok(found) if rule == Rule::HousingTemperature && !found.housing => {
            Some("thermal resistances of winding and housing".to_owned())
        }
        Ok(_) if finding.rating.is_nan() => Some("maximum temperature of the winding".to_owned()),
        Ok(_) => None,
    };
    let rating = match (unknown, rule) {
        (Some(missing), _) => missing,
        (None, Rule::HousingTemperature) => format!(
            "rise from {} °C to the maximum temperature of the housing",
            surroundings.ambient
        ),
        (None, _) if relative => format!("rise at the S1 {torque}"),
        (None, _) => {
            let thin = if surroundings.altitude_factor() < 1.0 {
                format!(
                    ", less 1 % per 100 m above 1000 m at {} m",
                    surroundings.altitude
                )
            } else {
                String::new()
            };
            format!(
                "rise from {} °C to the maximum temperature of the winding{thin}",
                surroundings.ambient
            )
        }
    };
    Words {
        unit: if relative { "%" } else { "K" },
        scale: if relative { 0.01 } else { 1.0 },
        rating,
        place: found.map_or_else(|_| String::new(), |found| place(context, found)),
    }
}

/// How the temperature was determined, and the duty type.
fn place(context: &Context, found: Heating) -> String {
    let Context {
        cycle,
        site,
        ratio,
        coefficients,
        ..
    } = context;
    let mut parts = found.notes(context.vocabulary().torque);
    parts.push(match site.duty.operation {
        Operation::Continuous => {
            let found = Features::of(cycle, coefficients, *ratio).duty_type();
            match site.duty.kind {
                Some(stated) if stated != found.number => {
                    format!("{found} (given: S{stated})")
                }
                _ => found.to_string(),
            }
        }
        Operation::Short { operating } => {
            format!("duty type S2, after {operating} s from cold")
        }
        Operation::Intermittent {
            operating, rest, ..
        } => format!(
            "duty type S{}, {operating} s of operation and {rest} s of rest",
            site.duty.kind.unwrap_or(3)
        ),
    });
    parts.join(", ")
}

/// Time (s) and rises of winding and housing (K) over a cycle that repeats without pause; `None` if data of the motor are missing, or if the machine
/// pauses.
pub(super) fn course(context: &Context) -> Option<Vec<(f64, [f64; 2])>> {
    let load = load(context);
    let surroundings = &context.site.surroundings;
    let model = Model::of(
        load.motor,
        load.prepared,
        surroundings,
        load.cycle.duration(),
    )
    .ok()?;
    let (Model::Bodies { network, .. }, Operation::Continuous) =
        (model, context.site.duty.operation)
    else {
        return None;
    };
    model.course(&load).periodic(&network)
}
