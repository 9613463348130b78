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
use crate::text::item::Value;
use crate::text::problem::Result;
use crate::text::section::Section;
use crate::units::kind::{INERTIA, LENGTH, MASS};

/// Most wheels of one size.
const MOST_WHEELS: u32 = 1000;

/// Names of the parts of an axis.
struct Words {
    kind: &'static str,
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
        &Words {
            kind: super::BELT_AXIS,
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
        &Words {
            kind: super::CONVEYOR,
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
        &Words {
            kind: super::FEED_ROLL,
            wheel: "roll",
            slide: "strip",
            joints: ["roll bearing", "strip guide", "nip"],
            belt: None,
            ends: false,
        },
    )
}

fn read(section: &Section, words: &Words) -> Result<AnyMechanism> {
    let wheel = section.section(words.wheel)?;
    let diameter = diameter(&wheel)?;
    let radius = 0.5 * diameter;
    let (mass, mut inertia) = (
        parts::mass(&wheel)?,
        wheel.quantity("inertia", &INERTIA)?.not_negative()?,
    );
    wheel.finish()?;
    if let Some(item) = section.get("idler") {
        for idler in item.sections("[[mechanism.idler]]")? {
            inertia += idler_inertia(&idler, diameter)?;
        }
    }
    let (mut on_the_bed, mut belt) = (0.0, 0.0);
    if let Some(share) = words.belt {
        let given = section.optional("belt_mass", &MASS)?;
        belt = given.map_or(Ok(0.0), Value::not_negative)?;
        inertia += belt * radius * radius;
        on_the_bed = share * belt;
    }
    let slide = section.section(words.slide)?;
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
    let mechanism = AnyMechanism::new(words.kind, mechanism, names, words.joints)
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
    let (pitch, teeth) = (wheel.get("pitch"), wheel.get("teeth"));
    let Some(item) = wheel.get("diameter") else {
        if pitch.is_none() && teeth.is_none() {
            return Err(wheel.missing(
                "diameter",
                "diameter = \"60 mm\", the pitch diameter, or pitch = \"5 mm\" and teeth = 40",
            ));
        }
        let pitch = wheel.quantity("pitch", &LENGTH)?.positive()?;
        let teeth = wheel.require("teeth", "teeth = 40")?.count(100_000, "40")?;
        return Ok(pitch * f64::from(teeth) / PI);
    };
    if let Some(other) = pitch.or(teeth) {
        return Err(other
            .problem("is not used: the diameter is given", "remove this")
            .help("give the diameter, or pitch and teeth"));
    }
    item.quantity(&LENGTH)?.positive()
}

/// The moment of inertia of other wheels (kg·m²), referred to the driven wheel of this `diameter`; by default they have the same diameter.
fn idler_inertia(idler: &Section, diameter: f64) -> Result<f64> {
    idler.expects(&["diameter", "count", "inertia"]);
    let own = match idler.optional("diameter", &LENGTH)? {
        Some(value) => value.positive()?,
        None => diameter,
    };
    let count = idler
        .get("count")
        .map_or(Ok(1), |item| item.count(MOST_WHEELS, "2"))?;
    let inertia = idler.quantity("inertia", &INERTIA)?.not_negative()?;
    idler.finish()?;
    let ratio = diameter / own;
    Ok(f64::from(count) * inertia * ratio * ratio)
}
