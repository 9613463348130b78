//! The limits of belts, screws and pinions, in the drive train and in the mechanism.

use crate::math;
use jred::machine::Mechanism as _;

use crate::keys::drive::SCREW_SHAFT;
use crate::model::drive_element::{BeltForm, DriveElement, ElementKind, ScrewEnds, ScrewShaft};
use crate::model::mechanism::AnyMechanism;
use crate::model::rule::Rule;
use crate::text::key::Key;
use crate::text::problem::Result;
use crate::text::section::Section;

/// The element of stage `number`, counted from 0, if its table gives a limit, or it is the first one and pulls at its shaft.
pub(super) fn of_stage(
    section: &Section,
    kind: &str,
    number: usize,
) -> Result<Option<DriveElement>> {
    let Some(mut element) = limited(section, kind)? else {
        return Ok(None);
    };
    if element.limits.is_empty() && number > 0 {
        return Ok(None);
    }
    if let ElementKind::Belt(..) = element.kind {
        element.arm = section.table("driven")?.si("radius")?;
        element.carried = section.si("belt_mass")?;
    }
    element.name = format!("{} drive train (stage {})", element.name, number + 1);
    element.stage = Some(number);
    element.on_input = number == 0;
    Ok(Some(element))
}

/// The element of a mechanism, if its table gives a limit or it pulls at its shaft. A drive train before it is still unknown.
pub(super) fn of_mechanism(
    section: &Section,
    mechanism: &AnyMechanism,
) -> Result<Option<DriveElement>> {
    let kind = mechanism.kind();
    let Some(mut element) = limited(section, kind)? else {
        return Ok(None);
    };
    let wheel = match kind {
        "belt" => Some("driver"),
        "belt-axis" => Some("pulley"),
        "conveyor" => Some("drum"),
        _ => None,
    };
    if let (Some(wheel), Some(shaft)) = (wheel, mechanism.links().first()) {
        element.carried = (shaft.inertia() - section.table(wheel)?.si("inertia")?).max(0.0);
    }
    let frames = mechanism.frames(0.0);
    let frames = frames.map_err(|error| section.titled(error, "in this mechanism"))?;
    element.arm = match kind {
        "belt" => section.table("driver")?.si("radius")?,
        // The load slides along x by r·φ.
        _ => frames.get(1).map_or(1.0, |frame| frame.x.d1),
    };
    element.name += " mechanism";
    Ok(Some(element))
}

fn any(section: &Section, keys: &[Key]) -> bool {
    // All are known here.
    let given = keys.iter().map(|key| section.get(key.name).is_some());
    given.fold(false, |any, given| any | given)
}

/// An element with its kind and its limits; a screw only with a limit.
fn limited(section: &Section, kind: &str) -> Result<Option<DriveElement>> {
    let (word, kind, limits) = match kind {
        "belt" | "belt-axis" | "conveyor" => {
            let form = match kind {
                "belt" => BeltForm::Pulleys,
                "belt-axis" => BeltForm::Carriage,
                _ => BeltForm::Carrying,
            };
            let max_tension = section.maybe("max_tension")?;
            let pretension = match max_tension {
                // The tight strand has the pretension and a share of the effective force.
                Some(_) => Some(section.value("pretension")?.si),
                None => section.maybe("pretension")?,
            };
            let limits = vec![
                (Rule::BeltTension, max_tension),
                (Rule::BeltForce, section.maybe("max_effective_force")?),
                (Rule::BeltPretension, pretension),
            ];
            ("belt", ElementKind::Belt(form, pretension), limits)
        }
        "ball-screw" => {
            let mut limits = vec![(Rule::ScrewForce, section.maybe("max_force")?)];
            if any(section, SCREW_SHAFT) {
                let shaft = ScrewShaft {
                    root_diameter: section.value("root_diameter")?.si,
                    free_length: section.value("free_length")?.si,
                    ends: section.pick("ends", ScrewEnds::ALL)?,
                };
                limits.push((Rule::ScrewBuckling, Some(shaft.buckling_force())));
                limits.push((Rule::ScrewForce, Some(shaft.yield_force())));
                limits.push((Rule::ScrewSpeed, Some(shaft.critical_speed())));
            }
            ("screw", ElementKind::Screw, limits)
        }
        "rack" | "rack-and-pinion" => {
            let (alpha, beta) = (section.si("pressure_angle")?, section.si("helix_angle")?);
            let push = [
                math::hypot(math::tan(alpha) / math::cos(beta), 1.0),
                math::tan(beta),
            ];
            let limits = vec![(Rule::PinionForce, section.maybe("max_force")?)];
            ("pinion", ElementKind::Pinion(push), limits)
        }
        _ => return Ok(None),
    };
    let given = limits
        .into_iter()
        .filter_map(|(rule, limit)| Some((rule, limit?)));
    let limits: Vec<(Rule, f64)> = given.collect();
    let is_silent = limits.is_empty() && kind == ElementKind::Screw;
    Ok((!is_silent).then(|| DriveElement {
        name: format!("{word} of the"),
        stage: None,
        on_input: true,
        arm: 1.0,
        carried: 0.0,
        kind,
        limits,
    }))
}
