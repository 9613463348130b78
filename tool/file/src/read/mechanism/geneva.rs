//! `type = "geneva"`.

use jred::mechanism::Geneva;

use super::{core, link, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::LENGTH;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let item = section.require("slots", "slots = 4")?;
    let slots = item.count(Geneva::MAX_SLOTS, "4")?;
    if slots < Geneva::MIN_SLOTS {
        return Err(item
            .problem(&format!("is {slots}, but must be at least 3"), "too few")
            .help("with fewer slots the pin would have to cross the axis of the wheel"));
    }
    let centres = section.quantity("centre_distance", &LENGTH)?.positive()?;
    if let Some(radius) = section.section("crank")?.peek("length") {
        return Err(radius
            .problem("is not used: it follows from the number of slots", "remove this")
            .help("the pin enters the slots without shock only at r = centre_distance·sin(180°/slots)"));
    }
    let crank = link(&section.section("crank")?)?;
    let wheel = parts::wheel(&section.section("wheel")?)?;
    let mechanism =
        Geneva::new(slots, centres, [crank, wheel]).map_err(|error| core(section, error))?;
    let radius = mechanism.crank();
    let joints = ["crank bearing", "wheel bearing", "pin or locking arc"];
    Ok(
        AnyMechanism::new(super::GENEVA, mechanism, ["crank", "wheel"], joints)
            .with_point("A", Geneva::CRANK, [radius, 0.0])
            .with_point("C", Geneva::WHEEL, [0.0, 0.0]),
    )
}
