//! `type = "belt-axis"`, `"conveyor"` and `"feed-roll"`: a wheel that moves a load at its circumference.
//!
//! To the core all three are a rack and pinion. Parts that run with the belt without being lifted (the belt, a closed loop, and the other wheels) are
//! inertia of the driven wheel: `m·r²` and `J·(d/d_k)²`.

use std::f64::consts::PI;

use jred::machine::Link;
use jred::machine::MassProperties;
use jred::mechanism::RackAndPinion;

use super::{core, parts};
use crate::model::mechanism::AnyMechanism;
use crate::number::rounding::figure;
use crate::text::problem::Result;
use crate::text::section::Section;

/// Names of the parts of an axis.
struct AxisNames {
    wheel: &'static str,
    slide: &'static str,
    joints: [&'static str; 3],
    /// Share of the belt that slides on its bed; `None` without a belt.
    belt: Option<f64>,
    /// Whether the axis has a stroke; a conveyor and a feed roll run without end.
    ends: bool,
}

pub(super) fn read_belt_axis(section: &Section) -> Result<AnyMechanism> {
    read(
        section,
        &AxisNames {
            wheel: "pulley",
            slide: "carriage",
            joints: ["pulley bearing", "carriage guide", "belt"],
            belt: Some(0.0),
            ends: true,
        },
    )
}

/// A belt whose carrying half slides on the bed with the goods.
pub(super) fn read_conveyor(section: &Section) -> Result<AnyMechanism> {
    read(
        section,
        &AxisNames {
            wheel: "drum",
            slide: "goods",
            joints: ["drum bearing", "slide bed", "belt"],
            belt: Some(0.5),
            ends: false,
        },
    )
}

pub(super) fn read_feed_roll(section: &Section) -> Result<AnyMechanism> {
    read(
        section,
        &AxisNames {
            wheel: "roll",
            slide: "strip",
            joints: ["roll bearing", "strip guide", "nip"],
            belt: None,
            ends: false,
        },
    )
}

fn read(section: &Section, words: &AxisNames) -> Result<AnyMechanism> {
    let wheel = section.table(words.wheel)?;
    let diameter = diameter(&wheel)?;
    let radius = 0.5 * diameter;
    let (mass, mut inertia) = (wheel.si("mass")?, wheel.si("inertia")?);
    wheel.finish()?;
    for idler in section.tables("idler")? {
        inertia += idler_inertia(&idler, diameter)?;
    }
    let (mut on_the_bed, mut belt) = (0.0, 0.0);
    if let Some(share) = words.belt {
        belt = section.si("belt_mass")?;
        inertia += belt * radius * radius;
        on_the_bed = share * belt;
    }
    let slide = section.table(words.slide)?;
    let (link, friction) = parts::guided(&slide)?;
    let pressed = link.mass() + on_the_bed;
    let properties = MassProperties {
        mass,
        inertia,
        com: [0.0, 0.0],
    };
    let pinion = Link::new(properties).map_err(|error| core(section, error))?;
    let mechanism =
        RackAndPinion::new(radius, [pinion, link]).map_err(|error| core(section, error))?;
    let names = [words.wheel, words.slide];
    let mechanism = AnyMechanism::new(section.chosen(), mechanism, names, words.joints)
        .with_point("B", RackAndPinion::RACK, [0.0, 0.0])
        .with_friction(RackAndPinion::RACK, friction * pressed);
    let mechanism = match belt {
        belt if belt > 0.0 => mechanism.with_fact(
            "mass of the belt",
            format!("{} kg, as inertia of the {}", figure(belt), words.wheel),
        ),
        _ => mechanism,
    };
    if !words.ends {
        return Ok(mechanism);
    }
    parts::linear_stroke(section, mechanism, RackAndPinion::RACK, 0)
}

/// The effective diameter (m): as given, or pitch · teeth / π.
fn diameter(wheel: &Section) -> Result<f64> {
    match wheel.one_of(&["diameter", "pitch", "teeth"]) {
        Some(("diameter", item)) => Ok(item.value()?.si),
        Some(_) => {
            let pitch = wheel.value("pitch")?.si;
            Ok(pitch * f64::from(wheel.whole("teeth")?) / PI)
        }
        None => Err(wheel.missing(
            "diameter",
            "diameter = \"60 mm\", the pitch diameter, or pitch = \"5 mm\" and teeth = 40",
        )),
    }
}

/// The moment of inertia of other wheels (kg·m²), referred to the driven wheel of this `diameter`; by default they have the same diameter.
fn idler_inertia(idler: &Section, diameter: f64) -> Result<f64> {
    let own = idler.maybe("diameter")?.unwrap_or(diameter);
    let (count, inertia) = (idler.whole("count")?, idler.si("inertia")?);
    idler.finish()?;
    let ratio = diameter / own;
    Ok(f64::from(count) * inertia * ratio * ratio)
}
