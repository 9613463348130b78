//! Natural frequency and backlash.

use jred_file::number::rounding::short;
use jred_file::units::Vocabulary;
use jred_sizing::judge::Grounds;
use jred_sizing::judge::check::Check;

pub(super) fn of_frequency(check: &Check) -> (String, String) {
    let Grounds::Stiffness {
        free,
        geared,
        shafts,
    } = check.grounds
    else {
        return Default::default();
    };
    let (rating, place) = if let Some(free) = free {
        let shafts = if geared && !shafts {
            "; stiffness of the shafts not given; using rigid shafts"
        } else {
            ""
        };
        let free = short(free);
        let Vocabulary { inertia, rotor, .. } = check.words;
        let place = format!(
            "the motor holding its position at the largest {inertia} of the cycle ({free} Hz with a free {rotor}){shafts}"
        );
        ("drive frequency", place)
    } else if geared {
        ("torsional stiffness of the gearbox", String::new())
    } else {
        let missing = "stiffness of the shafts, [stiffness] of the machine file";
        (missing, String::new())
    };
    (rating.to_owned(), place)
}

pub(super) fn of_backlash(check: &Check) -> (String, String) {
    let Grounds::Backlash { tool, train, .. } = &check.grounds else {
        return Default::default();
    };
    let known = check.finding.is_known();
    let rating = if known {
        format!("backlash allowed at {tool}")
    } else {
        "backlash of the gearbox".to_owned()
    };
    let train = if known && !train {
        "; backlash of the drive train not given; using none"
    } else {
        ""
    };
    let place = format!("at the largest transfer function of {tool} in the motion{train}");
    (rating, place)
}
