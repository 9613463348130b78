//! `type = "hoist"`.

use jred::mechanism::{Hoist, Rope, RopeLoad};

use super::{core, link, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let drum = link(&section.table("drum")?)?;
    let load = hanging(&section.table("load")?)?;
    let Some(counterweight) = section.maybe_table("counterweight")? else {
        let joints = ["drum bearing", "guide of the load", "rope of the load"];
        let names = ["drum", "load"];
        let mechanism = AnyMechanism::new(section.chosen(), Hoist::new(drum, load), names, joints)
            .with_point("L", Hoist::LOAD, [0.0, 0.0])
            .with_rope(2);
        return parts::linear_stroke(section, mechanism, Hoist::LOAD, 1);
    };
    let counterweight = hanging(&counterweight)?;
    let mechanism = Hoist::with_counterweight(drum, load, counterweight);
    let joints = [
        "drum bearing",
        "guide of the load",
        "guide of the counterweight",
        "rope of the load",
        "rope of the counterweight",
    ];
    let names = ["drum", "load", "counterweight"];
    let mechanism = AnyMechanism::new(section.chosen(), mechanism, names, joints)
        .with_point("L", Hoist::LOAD, [0.0, 0.0])
        .with_point("G", Hoist::COUNTERWEIGHT, [0.0, 0.0])
        .with_rope(3)
        .with_rope(4);
    parts::linear_stroke(section, mechanism, Hoist::LOAD, 1)
}

/// A rope and the mass suspended from it.
fn hanging(section: &Section) -> Result<RopeLoad> {
    let (radius, falls) = (section.si("radius")?, section.whole("falls")?);
    let link = parts::slide(section)?;
    let rope = Rope::new(radius, falls).map_err(|error| core(section, error))?;
    Ok(RopeLoad { rope, link })
}
