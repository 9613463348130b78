//! `type = "hoist"`.

use jred::mechanism::{Hoist, Rope, RopeLoad};

use super::{core, link, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::LENGTH;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let drum = link(&section.section("drum")?)?;
    let load = hanging(&section.section("load")?)?;
    let Some(item) = section.get("counterweight") else {
        let joints = ["drum bearing", "guide of the load", "rope of the load"];
        let names = ["drum", "load"];
        let mechanism = AnyMechanism::new(super::HOIST, Hoist::new(drum, load), names, joints)
            .with_point("L", Hoist::LOAD, [0.0, 0.0])
            .with_rope(2);
        return parts::linear_stroke(section, mechanism, Hoist::LOAD, 1);
    };
    let counterweight = hanging(&item.section("[mechanism.counterweight]".to_owned())?)?;
    let mechanism = Hoist::with_counterweight(drum, load, counterweight);
    let joints = [
        "drum bearing",
        "guide of the load",
        "guide of the counterweight",
        "rope of the load",
        "rope of the counterweight",
    ];
    let names = ["drum", "load", "counterweight"];
    let mechanism = AnyMechanism::new(super::HOIST, mechanism, names, joints)
        .with_point("L", Hoist::LOAD, [0.0, 0.0])
        .with_point("G", Hoist::COUNTERWEIGHT, [0.0, 0.0])
        .with_rope(3)
        .with_rope(4);
    parts::linear_stroke(section, mechanism, Hoist::LOAD, 1)
}

/// A rope and the mass suspended from it.
fn hanging(section: &Section) -> Result<RopeLoad> {
    let radius = section.quantity("radius", &LENGTH)?.positive()?;
    let falls = section
        .get("falls")
        .map_or(Ok(1), |item| item.count(Rope::MAX_FALLS, "2"))?;
    let link = parts::slide(section)?;
    let rope = Rope::new(radius, falls).map_err(|error| core(section, error))?;
    Ok(RopeLoad { rope, link })
}
