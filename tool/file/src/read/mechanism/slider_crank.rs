//! `type = "slider-crank"`.

use jred::mechanism::{Branch, BuildError, RotationError, SliderCrank, SliderCrankDimensions};

use crate::model::mechanism::AnyMechanism;

use super::{ROD, core, link, parts, stopped, stroke};
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let branch = section.pick("branch", [Branch::Right, Branch::Left])?;
    let offset = section.si("offset")?;
    let stroke = stroke(section)?;
    let crank = section.table("crank")?;
    let rod = section.table("rod")?;
    let slider = section.table("slider")?;
    let (length, rod_length) = (crank.si("length")?, rod.value("length")?);
    let links = [link(&crank)?, link(&rod)?, parts::slide(&slider)?];
    let dimensions = SliderCrankDimensions {
        crank: length,
        rod: rod_length.si,
        offset,
    };
    let built = match &stroke {
        Some((_, stroke)) => SliderCrank::over_stroke(dimensions, branch, *stroke, links),
        None => SliderCrank::new(dimensions, branch, links),
    };
    let mechanism = built.map_err(|error| {
        if let Some((item, _)) = &stroke {
            return stopped(section, item, ROD, error);
        }
        let BuildError::Rotation(RotationError::TooShort { phi, shortest, reach, .. }) = error else {
            return core(section, error);
        };
        let what = format!(
            "is too short for a full turn of the crank: it does not reach the guide at φ = {:.2}°",
            phi.to_degrees()
        );
        // The rod just reaches the guide: a change point.
        let through = if rod_length.si >= shortest * (1.0 - 1e-9) {
            "; if something guides it through this change point, describe it as type = \"linkage\" with keep_branch = true"
        } else {
            ""
        };
        let swings = reach.map_or_else(String::new, |[from, to]| {
            let margin = (0.1 * (to - from)).min(1_f64.to_radians());
            format!(
                ", or let the crank swing over a stroke inside its dead points: stroke = [\"{:.2} deg\", \"{:.2} deg\"]",
                (from + margin).to_degrees(),
                (to - margin).to_degrees()
            )
        });
        rod_length.problem(&what, "too short").help(format!(
            "make the rod longer than crank + |offset| = {}, reduce the crank or the offset{swings}{through}",
            rod_length.show(shortest)
        ))
    })?;
    let links = ["crank", "rod", "slider"];
    let joints = ["crank pivot", "crank pin", "slider pin", "guide"];
    Ok(
        AnyMechanism::new(section.chosen(), mechanism, links, joints)
            .with_point("A", SliderCrank::CRANK, [length, 0.0])
            .with_point("B", SliderCrank::SLIDER, [0.0, 0.0]),
    )
}
