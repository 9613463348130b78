//! `type = "belt-axis"`, `"conveyor"` and `"feed-roll"`: a wheel that pulls something along at its circumference.
//!
//! All three are a rack and pinion to the core. What runs with the belt without being lifted, as the belt itself, which hangs
//! in a closed loop, and the other wheels, is inertia of the driven wheel: `m·r²` and `J·(d/d_k)²`.

use std::f64::consts::PI;

use jred::Link;
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

/// What the parts of an axis are called.
struct Words {
    kind: &'static str,
    wheel: &'static str,
    slide: &'static str,
    joints: [&'static str; 3],
    /// Whether a belt runs round the wheels, and which share of it slides on its bed.
    belt: Option<f64>,
    /// Whether its way ends: a conveyor and a feed roll go on without end.
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

/// The carrying half of the belt slides on the bed with the goods.
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

/// The effective diameter (m): given, or pitch times teeth over π.
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

/// The moment of inertia of other wheels (kg·m²) at the driven wheel of this `diameter`; of its size unless they say theirs.
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
