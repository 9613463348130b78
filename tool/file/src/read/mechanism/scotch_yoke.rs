//! `type = "scotch-yoke"`.

use jred::mechanism::{BuildError, ScotchYoke, ScotchYokeDimensions};
use jred::number::RangeError;

use super::{core, link, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let slot_angle = section.given("slot_angle")?;
    let (crank, yoke) = (section.table("crank")?, section.table("yoke")?);
    let length = crank.si("length")?;
    let links = [link(&crank)?, parts::slide(&yoke)?];
    let dimensions = ScotchYokeDimensions {
        crank: length,
        slot_angle: section.si("slot_angle")?,
    };
    let mechanism = ScotchYoke::new(dimensions, links).map_err(|error| {
        let (BuildError::Range(RangeError::OutOfRange { min, max, .. }), Some(given)) =
            (error, &slot_angle)
        else {
            return core(section, error);
        };
        let what = format!("is {}, so the slot would lock the crank", given.shown());
        let range = format!("{} to {}", given.show(min), given.show(max));
        given.problem(&what, "too flat").help(format!(
            "write an angle of {range} to the direction of motion; a straight yoke has 90 deg"
        ))
    })?;
    let joints = ["crank pivot", "pin in the slot", "guide"];
    Ok(
        AnyMechanism::new(section.chosen(), mechanism, ["crank", "yoke"], joints)
            .with_point("A", ScotchYoke::CRANK, [length, 0.0])
            .with_point("B", ScotchYoke::YOKE, [0.0, 0.0]),
    )
}
