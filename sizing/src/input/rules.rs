//! `[rules]`: limits that replace the default ones.

use crate::rules::Rules;

use super::kind::SHARE;
use super::problem::{Problem, Result};
use super::section::Section;

/// The largest share that makes sense as a limit.
const MAX_SHARE: f64 = 2.0;

/// The defaults with what the file overrides.
pub(super) fn read(root: &Section) -> Result<Rules> {
    let mut rules = Rules::default();
    let Some(item) = root.get("rules") else {
        return Ok(rules);
    };
    let section = item.section("[rules]".into())?;
    let shares = [
        ("rms_torque", &mut rules.rms_torque),
        ("peak_torque", &mut rules.peak_torque),
        ("speed", &mut rules.speed),
        ("gravity_hold", &mut rules.gravity_hold),
        ("gearbox_peak", &mut rules.gearbox_peak),
        ("gearbox_rated", &mut rules.gearbox_rated),
        ("gearbox_speed", &mut rules.gearbox_speed),
    ];
    for (key, limit) in shares {
        if let Some(value) = section.optional(key, &SHARE)? {
            *limit = value.up_to(MAX_SHARE)?;
        }
    }
    let ratios = [
        ("inertia_ratio", &mut rules.inertia_ratio),
        ("inertia_ratio_warning", &mut rules.inertia_ratio_warning),
    ];
    let mut places = Vec::new();
    for (key, limit) in ratios {
        if let Some(item) = section.get(key) {
            *limit = item.number([0.01, 1000.0], "10")?;
            places.push(item.span());
        }
    }
    section.finish()?;
    if rules.inertia_ratio_warning > rules.inertia_ratio {
        let problem = Problem::new(format!(
            "`inertia_ratio_warning` in [rules] is {}, above `inertia_ratio`, which is {}",
            rules.inertia_ratio_warning, rules.inertia_ratio
        ));
        let problem = places
            .into_iter()
            .fold(problem, |p, place| p.at(place, "here"));
        return Err(problem.help("the warning must come before the limit: give both, such as inertia_ratio = 10 and inertia_ratio_warning = 5"));
    }
    Ok(rules)
}
