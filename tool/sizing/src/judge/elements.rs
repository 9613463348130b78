//! Belts, screws and pinions of the machine, and their pull at the gearbox's output shaft.

use super::{Context, Grounds, Record};
use jred_analysis::duty::mechanics::ElementLoad;
use jred_file::model::drive_element::ElementKind;
use jred_file::model::rule::Rule;
use jred_file::model::rules::Finding;

/// The rules of the elements themselves, which no drive changes.
pub(crate) const OF_ELEMENTS: [Rule; 7] = [
    Rule::BeltTension,
    Rule::BeltForce,
    Rule::BeltPretension,
    Rule::ScrewForce,
    Rule::ScrewBuckling,
    Rule::ScrewSpeed,
    Rule::PinionForce,
];

/// Measures the rules of all elements, which do not depend on the drive, and of the gearbox's output shaft, which depend on the gearbox.
pub(super) fn measure(context: &Context, findings: &mut impl Record) {
    for rule in OF_ELEMENTS {
        if let Some((_, finding)) = worst(context, rule) {
            findings.set(rule, finding);
        }
    }
    let Some((gearbox, load)) = context.drive.gearbox.zip(on_shaft(context)) else {
        return;
    };
    let Some([radial, axial]) = load.element.pull(load.force) else {
        findings.set(Rule::GearboxRadial, Finding::UNKNOWN);
        return;
    };
    for (rule, load, most) in [
        (Rule::GearboxRadial, radial, gearbox.max_radial_load),
        (Rule::GearboxAxial, axial, gearbox.max_axial_load),
    ] {
        if load > 0.0 {
            findings.set(rule, Finding::against(load, most));
        }
    }
}

/// The finding of a rule for an element, if its limit is given.
fn finding(load: &ElementLoad, rule: Rule) -> Option<Finding> {
    let limits = load.element.limits.iter().filter(|(of, _)| *of == rule);
    let limit = limits.map(|(_, limit)| *limit).reduce(f64::min)?;
    let force = load.force;
    let value = match (rule, load.element.kind) {
        (Rule::BeltTension, ElementKind::Belt(form, pretension)) => {
            // A strand does not push: if the other one is slack, this one has all of the force.
            (pretension? + form.shares()[0] * force).max(force)
        }
        (Rule::BeltPretension, ElementKind::Belt(form, _)) => form.shares()[1] * force,
        (Rule::ScrewSpeed, _) => load.speed,
        _ => force,
    };
    Some(Finding::new(value, limit))
}

/// The element that uses most of the limit of a rule; of equal ones the first from the motor.
fn worst<'c>(context: &'c Context, rule: Rule) -> Option<(&'c ElementLoad, Finding)> {
    let all = context.cycle.mechanics().elements.iter().rev();
    let found = all.filter_map(|load| Some((load, finding(load, rule)?)));
    let used = |found: &(_, Finding)| found.1.value / found.1.rating;
    found.max_by(|a, b| used(a).total_cmp(&used(b)))
}

/// The element on the output shaft of the gearbox: of the first stage of the drive train, or without stages of the mechanism.
fn on_shaft<'c>(context: &'c Context) -> Option<&'c ElementLoad> {
    let first = context.cycle.mechanics().elements.first()?;
    first.element.on_input.then_some(first)
}

/// Grounds of a rule of an element.
pub(super) fn grounds(context: &Context, rule: Rule) -> Grounds {
    worst(context, rule).map_or(Grounds::None, |(load, _)| Grounds::Element {
        name: load.element.name.clone(),
        force: load.force,
    })
}

/// Grounds of the loads at the output shaft.
pub(super) fn of_shaft(context: &Context) -> Grounds {
    match on_shaft(context) {
        Some(load) if load.element.pull(load.force).is_none() => {
            Grounds::Missing("pretension of the belt on the output shaft, in the machine file")
        }
        Some(load) => Grounds::OnShaft(load.element.name.clone()),
        None => Grounds::None,
    }
}
