//! `type = "ball-screw"`.

use jred::mechanism::BallScrew;

use super::{core, parts};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let lead = section.value("lead")?;
    if lead.si.abs() < lead.kind.smallest {
        let what = format!("is {}, so the nut would not move", lead.shown());
        return Err(lead.problem(&what, "too small").help(
            "write the travel of the nut per turn, such as \"10 mm\"; negative if it moves along -x",
        ));
    }
    let (screw, nut) = (section.table("screw")?, section.table("nut")?);
    let (slide, friction) = parts::guided(&nut)?;
    let weight = friction * slide.mass();
    let links = [parts::wheel(&screw)?, slide];
    let mechanism = BallScrew::new(lead.si, links).map_err(|error| core(section, error))?;
    let joints = ["screw bearings", "nut guide", "thread"];
    let mechanism = AnyMechanism::new(section.chosen(), mechanism, ["screw", "nut"], joints)
        .with_point("B", BallScrew::NUT, [0.0, 0.0])
        .with_friction(BallScrew::NUT, weight);
    parts::linear_stroke(section, mechanism, BallScrew::NUT, 0)
}
