//! `type = "disc-cam"`.

mod facts;
mod follower;
mod program;
mod refusal;
mod table;

use crate::math;
use std::f64::consts::TAU;

use jred::mechanism::{DiscCam, Follower, Roller, RollerDimensions};

use super::{core, link, parts};
use crate::model::mechanism::{AnyMechanism, Contact, NamedElement};
use crate::text::file::Files;
use crate::text::problem::Result;
use crate::text::section::Section;

pub(super) use follower::follower;
pub(super) use program::read as program;
pub(super) use refusal::problem;

/// Points of the profile for drawings.
const OUTLINE: u32 = 720;

pub(super) fn read(section: &Section, files: &dyn Files) -> Result<AnyMechanism> {
    let base_radius = section.value("base_radius")?;
    let by_force = section.word("closure")? == 0;
    let cam = link(&section.table("cam")?)?;
    let part = section.table("follower")?;
    let follower = follower(&part, || roller(section))?;
    let mass = match follower.pivot() {
        Some(_) => link(&part)?,
        None => parts::slide(&part)?,
    };
    let oscillating = follower.pivot().is_some();
    section.set_slides(!oscillating);
    let (program, about) = match section.get("lift") {
        Some(item) => {
            section.expects(&["segment"]);
            let (program, about) = table::read(section, &item, oscillating, files)?;
            (program, Some(about))
        }
        None => (program(section)?, None),
    };
    let spring = section.maybe_table("spring")?;
    let mechanism = DiscCam::new(program, base_radius.si, follower, [cam, mass])
        .map_err(|error| problem(section, &part, &base_radius, error))?;
    let spring = spring
        .map(|spring| closing_spring(&spring, &mechanism))
        .transpose()?;
    let contact = by_force.then(|| Contact {
        joint: DiscCam::CONTACT,
        named: false,
        pieces: mechanism.program().pieces().collect(),
    });
    let facts = facts::of(&mechanism);
    let mut described = described(mechanism).with_elements(spring);
    if let Some(about) = about {
        described = described.with_fact("lift from the table", about);
    }
    let mechanism = facts
        .into_iter()
        .fold(described, |any, [label, text]| any.with_fact(label, text));
    Ok(match contact {
        Some(contact) => mechanism.with_contact(contact),
        None => mechanism,
    })
}

/// Names, points and outlines.
fn described(mechanism: DiscCam) -> AnyMechanism {
    let follower = *mechanism.follower();
    let around = |count: u32| (0..count).map(move |k| TAU * f64::from(k) / f64::from(count));
    let profile = around(OUTLINE).map(|phi| mechanism.profile(phi)).collect();
    let guide = if follower.pivot().is_some() {
        "follower pivot"
    } else {
        "guide"
    };
    let links = ["cam", "follower", "roller"];
    let joints = ["cam pivot", guide, "contact", "roller pin", "rolling"];
    let (link_count, joint_count) = match follower.roller() {
        Some(_) => (3, 5),
        None => (2, 3),
    };
    let mut any = AnyMechanism::new(
        super::DISC_CAM.name,
        mechanism,
        links.into_iter().take(link_count),
        joints.into_iter().take(joint_count),
    )
    .with_outline(DiscCam::CAM, profile)
    .with_ground_point("O", [0.0, 0.0]);
    if let Some((pivot, _)) = follower.pivot() {
        any = any.with_ground_point("A", pivot);
    }
    match follower {
        Follower::TranslatingFace { .. } => any.with_point("B", DiscCam::FOLLOWER, [0.0, 0.0]),
        Follower::OscillatingFace { .. } => any,
        Follower::TranslatingRoller { roller, .. } | Follower::OscillatingRoller { roller, .. } => {
            let at = match follower {
                Follower::OscillatingRoller { arm, .. } => [arm, 0.0],
                _ => [0.0, 0.0],
            };
            let rim = around(72).map(|angle| {
                let (sin, cos) = math::sin_cos(angle);
                [roller.radius() * cos, roller.radius() * sin]
            });
            any.with_outline(DiscCam::ROLLER, rim.collect())
                .with_point("B", DiscCam::FOLLOWER, at)
        }
    }
}

fn roller(section: &Section) -> Result<Roller> {
    let section = section.table("roller")?;
    let dimensions = RollerDimensions {
        radius: section.si("radius")?,
        mass: section.si("mass")?,
        inertia: section.si("inertia")?,
    };
    section.finish()?;
    Roller::new(dimensions).map_err(|error| core(&section, error))
}

fn closing_spring(section: &Section, mechanism: &DiscCam) -> Result<NamedElement> {
    let (stiffness, preload) = (section.si("stiffness")?, section.si("preload")?);
    section.finish()?;
    Ok(NamedElement {
        name: "closing spring".to_owned(),
        element: mechanism
            .closing_spring(stiffness, preload)
            .map_err(|error| core(section, error))?,
    })
}
