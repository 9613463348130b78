//! Belts, screws and pinions, and their pull at the gearbox.

use jred_file::model::rule::Rule;
use jred_file::number::rounding::short;
use jred_sizing::judge::Grounds;
use jred_sizing::judge::check::Check;

pub(super) fn words(check: &Check) -> (String, String) {
    let Grounds::Element { name, force } = &check.grounds else {
        return Default::default();
    };
    let force = short(*force);
    let (rating, place) = match check.id {
        Rule::BeltTension => (
            "allowed force",
            format!(
                "tight strand: pretension and its share of the largest effective force of {force} N"
            ),
        ),
        Rule::BeltForce => ("allowed effective force", String::new()),
        Rule::BeltPretension => (
            "pretension",
            "loss of force in the slack strand; with more it hangs loose".to_owned(),
        ),
        Rule::ScrewForce => ("allowed axial force", String::new()),
        Rule::ScrewBuckling => ("buckling force (Euler)", String::new()),
        Rule::ScrewSpeed => ("critical speed", String::new()),
        _ => ("allowed tangential force", String::new()),
    };
    (format!("{rating} of the {name}"), place)
}

pub(super) fn of_shaft(check: &Check) -> (String, String) {
    let rating = match check.id {
        Rule::GearboxRadial => "radial load that the output shaft bears",
        _ => "axial load that the output shaft bears",
    };
    let place = match &check.grounds {
        Grounds::OnShaft(name) => format!("from the {name}"),
        _ => String::new(),
    };
    (rating.to_owned(), place)
}
