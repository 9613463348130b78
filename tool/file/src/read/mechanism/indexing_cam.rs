//! `type = "indexing-cam"`: a cam shaft with a table on followers, globoid or parallel.

use std::f64::consts::TAU;

use jred::mechanism::{IndexingCam, IndexingCamDimensions};

use super::{core, parts, rotary_table};
use crate::model::mechanism::AnyMechanism;
use crate::number::rounding::{figure, short};
use crate::read::law;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let (stops, indexes) = (section.whole("stops")?, section.whole("indexes")?);
    let angle = section.value("index_angle")?;
    let period = TAU / f64::from(indexes);
    if angle.si > period * (1.0 + 1e-12) {
        let what = format!(
            "is {}, more than the {} deg of the cam shaft from one index to the next",
            angle.shown(),
            figure(period.to_degrees())
        );
        return Err(angle
            .problem(&what, "too large")
            .help("the rest of the turn is dwell: 90 deg to 270 deg are usual"));
    }
    let reverses = section.is("reverses")?;
    let law = law::read(section)?;
    let cam = parts::wheel(&section.table("cam")?)?;
    let table = rotary_table::read_table(section)?;
    let dimensions = IndexingCamDimensions {
        stops,
        index: angle.si.min(period),
        indexes,
        reverses,
        law,
    };
    let mechanism =
        IndexingCam::new(dimensions, [cam, table]).map_err(|error| core(section, error))?;
    let (step, index) = (mechanism.step().abs(), mechanism.index());
    let found = law.characteristic();
    let shown = |angle: f64| figure(angle.to_degrees());
    let joints = ["cam bearing", "table bearing", "cam and followers"];
    Ok(
        AnyMechanism::new(section.chosen(), mechanism, ["cam", "table"], joints)
            .with_fact(
                "index",
                format!(
                    "{} deg of the table in {} deg of the cam shaft, then {} deg of dwell",
                    shown(step),
                    shown(index),
                    shown(period - index)
                ),
            )
            .with_fact(
                "largest transfer functions of the table",
                format!(
                    "{} (speed over that of the cam shaft), {} (acceleration over its square)",
                    short(found.velocity * step / index),
                    short(found.acceleration * step / (index * index))
                ),
            ),
    )
}
