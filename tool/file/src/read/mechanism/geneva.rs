//! `type = "geneva"`.

use jred::mechanism::Geneva;

use super::{core, link, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let slots = section.whole("slots")?;
    let centres = section.si("centre_distance")?;
    let crank = link(&section.table("crank")?)?;
    let wheel = parts::wheel(&section.table("wheel")?)?;
    let mechanism =
        Geneva::new(slots, centres, [crank, wheel]).map_err(|error| core(section, error))?;
    let radius = mechanism.crank();
    let joints = ["crank bearing", "wheel bearing", "pin or locking arc"];
    Ok(
        AnyMechanism::new(section.chosen(), mechanism, ["crank", "wheel"], joints)
            .with_point("A", Geneva::CRANK, [radius, 0.0])
            .with_point("C", Geneva::WHEEL, [0.0, 0.0]),
    )
}
