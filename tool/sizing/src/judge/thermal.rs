//! Temperature of winding and housing.

use super::{Context, Grounds, Record};
use crate::thermal::classify::Features;
use crate::thermal::loss_curve::PeakRise;
use crate::thermal::{Heating, Load, Model, allowed_rise};
use jred_file::model::operation::Operation;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;
use jred_file::units::Sentence;

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

/// Grounds of the temperatures.
pub(super) fn grounds(context: &Context) -> Grounds {
    let Context {
        cycle,
        site,
        ratio,
        coefficients,
        ..
    } = context;
    match heating(context) {
        Err(missing) => Grounds::NoHeat(missing),
        Ok(heating) => Grounds::Heat {
            heating,
            surroundings: site.surroundings,
            duty: site.duty,
            found: Features::of(cycle, coefficients, *ratio).duty_type(),
        },
    }
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
