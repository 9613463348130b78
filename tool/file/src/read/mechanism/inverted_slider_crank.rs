//! `type = "inverted-slider-crank"`: crank and slotted lever, Whitworth's motion.

use jred::mechanism::{
    BuildError, DimensionError, InvertedSliderCrank, InvertedSliderCrankDimensions,
};

use super::{core, link, stopped, stroke};
use crate::model::mechanism::AnyMechanism;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let crank = section.table("crank")?;
    let block = section.table("block")?;
    let lever = section.table("lever")?;
    let (length, item) = (crank.value("length")?, lever.need("pivot")?);
    let (pivot, offset) = (item.two()?, lever.si("offset")?);
    let links = [link(&crank)?, link(&block)?, link(&lever)?];
    let dimensions = InvertedSliderCrankDimensions {
        crank: length.si,
        pivot,
        offset,
    };
    let stroke = stroke(section)?;
    let built = match &stroke {
        Some((_, stroke)) => InvertedSliderCrank::over_stroke(dimensions, *stroke, links),
        None => InvertedSliderCrank::new(dimensions, links),
    };
    let mechanism =
        built.map_err(|error| {
            if let Some((item, _)) = &stroke {
                let words = [
                    "the slot does not reach the crank pin",
                    "the crank pin is as near to the lever's pivot as the slot",
                ];
                return stopped(section, item, words, error);
            }
            let BuildError::Dimensions(DimensionError::ChangePoint {
                centres,
                rocking,
                turning,
            }) = error
            else {
                return core(section, error);
            };
            let what = format!(
                "is {} from the crank's pivot, where the slot cannot follow the crank pin through a full turn",
                length.show(centres)
            );
            let rocks = format!(
                "move it farther away than crank + |offset| = {} for a lever that rocks",
                length.show(rocking)
            );
            let turns = if turning > 0.0 {
                format!(
                    ", or closer than crank − |offset| = {} for a lever that turns",
                    length.show(turning)
                )
            } else {
                String::new()
            };
            item.problem(&what, "neither rocks nor turns")
                .at(length.span(), "crank")
                .help(format!(
                    "{rocks}{turns}; or let the crank swing over a stroke that stays away from there: stroke = [\"30 deg\", \"120 deg\"]"
                ))
        })?;
    let names = ["crank", "block", "lever"];
    let joints = ["crank pivot", "crank pin", "slot", "lever pivot"];
    Ok(
        AnyMechanism::new(section.chosen(), mechanism, names, joints)
            .with_point("A", InvertedSliderCrank::CRANK, [length.si, 0.0])
            .with_point("C", InvertedSliderCrank::LEVER, [0.0, 0.0]),
    )
}
