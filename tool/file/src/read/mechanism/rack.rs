//! `type = "rack-and-pinion"`.

use jred::mechanism::RackAndPinion;

use super::{core, link, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let (pinion, rack) = (section.table("pinion")?, section.table("rack")?);
    let radius = pinion.si("radius")?;
    let (slide, friction) = parts::guided(&rack)?;
    let weight = friction * slide.mass();
    let links = [link(&pinion)?, slide];
    let mechanism = RackAndPinion::new(radius, links).map_err(|error| core(section, error))?;
    let joints = ["pinion bearing", "rack guide", "mesh"];
    let mechanism = AnyMechanism::new(section.chosen(), mechanism, ["pinion", "rack"], joints)
        .with_point("B", RackAndPinion::RACK, [0.0, 0.0])
        .with_friction(RackAndPinion::RACK, weight);
    parts::linear_stroke(section, mechanism, RackAndPinion::RACK, 0)
}
