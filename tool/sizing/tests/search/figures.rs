//! The figures that drives are compared by: which are missing, and shares of what is allowed.

use super::{case, catalogue, priced};
use crate::support::{near, press_text};
use jred_machine::model::rule::Rule;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::select::pareto::Front;
use jred_sizing::select::rank::Objective;
use jred_sizing::select::size::Selection;

/// Where no suitable drive has a figure there is nothing to compare, and the sentence names the figures that are missing and no other.
#[test]
fn an_empty_front_says_what_is_missing() {
    let case = case(&press_text(), 200);
    let select = |from: &Catalogue, objectives: &[Objective]| {
        let prepared = from.prepare(&case.file.site);
        let (cycle, site, rules) = (&case.cycle, &case.file.site, &case.file.rules);
        let selection = Selection::new(from, &prepared, cycle, site, rules);
        let front = Front::new(&selection, objectives);
        (front.fit, front.obstacle().map(|report| report.to_string()))
    };
    let bare = Catalogue {
        amplifiers: Vec::new(),
        ..catalogue()
    };
    let objectives = [Objective::Power, Objective::Price];
    let (fit, words) = select(&bare, &objectives);
    let words = words.unwrap();
    assert!(
        words.starts_with(&format!("{fit} drives are suitable")),
        "{words}"
    );
    assert!(words.contains("none has data for the price"), "{words}");
    assert!(!words.contains(Objective::Power.name()), "{words}");
    assert_eq!(select(&priced(), &objectives).1, None);
    assert_eq!(select(&Catalogue::default(), &objectives), (0, None));
}

/// High above the sea less of a rise is allowed, 10 % less at 2000 m: the same drive in the same duty uses more of it, by as much.
#[test]
fn a_rise_is_compared_with_what_is_allowed() {
    let mut case = case(&press_text(), 200);
    let catalogue = catalogue();
    let share = |case: &super::Case| {
        let motors = catalogue.prepare(&case.file.site);
        let (cycle, site, rules) = (&case.cycle, &case.file.site, &case.file.rules);
        let selection = Selection::new(&catalogue, &motors, cycle, site, rules);
        let wanted = |drive: &jred_sizing::catalogue::Drive| {
            drive.motor.rated_torque.is_some() && drive.gearbox.is_some()
        };
        let candidate = selection.find(wanted).unwrap();
        let finding = selection.context(&candidate).findings(rules);
        let finding = finding.get(Rule::WindingTemperature).unwrap();
        let value = Objective::Temperature
            .value(&selection, &candidate)
            .unwrap();
        near("share", value, finding.value / finding.rating, 1e-12);
        (candidate.drive.name(), value)
    };
    case.file.site.surroundings.altitude = 0.0;
    let (below, low) = share(&case);
    case.file.site.surroundings.altitude = 2000.0;
    let (above, high) = share(&case);
    if below == above {
        near("at 2000 m", high, low / 0.9, 1e-9);
    }
}
