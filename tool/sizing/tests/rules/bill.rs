//! The bill of materials: which parts are on it, and which rule decided each.

use jred_file::model::rule::Rule;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::cycle::Cycle;
use jred_sizing::judge::bill::Part;
use jred_sizing::select::size::Selection;

use crate::support::press_file;

/// Every rule belongs to a part, and every part has rules.
#[test]
fn every_part_has_rules() {
    for part in [
        Part::Motor,
        Part::Brake,
        Part::Gearbox,
        Part::Amplifier,
        Part::Resistor,
    ] {
        assert!(
            Rule::ALL.iter().any(|rule| Part::of(*rule) == part),
            "{part:?}"
        );
    }
}

/// The deciding rule of a part uses the most of its limit among the rules of the part that can violate, as found by a plain search.
#[test]
fn the_deciding_rule_uses_most() {
    let mut file = jred_analysis::checked::read(&press_file()).unwrap();
    file.site.mains_voltage = Some(200.0);
    file.site.bus_voltage = Some(283.0);
    let motion = file.required_motion().unwrap();
    let duty = jred_analysis::duty::Duty::new(&file, motion, 500).unwrap();
    let cycle = Cycle::new(&duty);
    let catalogue = Catalogue::built_in().unwrap();
    let motors = catalogue.prepare(&file.site);
    let selection = Selection::parallel(&catalogue, &motors, &cycle, &file.site, &file.rules);
    let judged = selection.judged(selection.fit.first().unwrap());
    let bill = judged.bill();
    assert_eq!(bill[0].part, Part::Motor);
    assert_eq!(bill[0].key, judged.drive.motor.key);
    let has = |part| bill.iter().any(|item| item.part == part);
    assert_eq!(has(Part::Gearbox), judged.drive.gearbox.is_some());
    assert_eq!(has(Part::Brake), judged.drive.motor.brake.is_some());
    let mut decided = 0;
    for item in &bill {
        let Some(check) = item.decided else { continue };
        decided += 1;
        assert_eq!(Part::of(check.id), item.part);
        for other in &judged.checks {
            let counts = other.shares.fail.is_some() && !other.used().is_empty();
            if counts && Part::of(other.id) == item.part {
                assert!(other.used <= check.used, "{:?} {:?}", other.id, check.id);
            }
        }
    }
    assert!(decided >= 3);
}
