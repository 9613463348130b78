//! `type = "disc-cam"`.

mod program;

use std::f64::consts::TAU;

use jred::cam::CamError;
use jred::mechanism::{DiscCam, Follower, Roller, Swing};
use jred::{Error, Link};

use super::{core, link, parts};
use crate::input::item::Value;
use crate::input::kind::{FORCE, INERTIA, LENGTH, MASS, STIFFNESS, TORQUE, TORSION_STIFFNESS};
use crate::input::problem::{Problem, Result};
use crate::input::section::Section;
use crate::machine::{AnyMechanism, Contact, NamedElement};

/// The kinds of follower.
const FOLLOWERS: [&str; 4] = [
    "translating-roller",
    "translating-flat-face",
    "oscillating-roller",
    "oscillating-flat-face",
];

/// Points of the profile for drawings.
const OUTLINE: u32 = 720;

pub(super) fn read(section: &Section) -> Result<AnyMechanism> {
    let base_radius = section.quantity("base_radius", &LENGTH)?;
    base_radius.check_positive()?;
    let closure = section.get("closure");
    let by_force = match &closure {
        Some(item) => item.choice(&["force", "form"])? == 0,
        None => true,
    };
    let cam = link(&section.section("cam")?)?;
    let part = section.section("follower")?;
    let kind = part
        .require("type", "type = \"translating-roller\"")?
        .choice(&FOLLOWERS)?;
    let has_roller = kind % 2 == 0;
    let roller = has_roller.then(|| roller(section)).transpose()?;
    let (follower, mass) = read_follower(&part, kind >= 2, roller)?;
    let program = program::read(section, follower.pivot().is_some())?;
    let spring = section
        .get("spring")
        .map(|item| item.section("[mechanism.spring]".into()))
        .transpose()?;

    let mechanism = DiscCam::new(program, base_radius.si, follower, [cam, mass])
        .map_err(|error| problem(section, &part, &base_radius, &error))?;
    let spring = spring
        .map(|spring| closing_spring(&spring, &mechanism))
        .transpose()?;
    let contact = by_force.then(|| Contact {
        joint: DiscCam::CONTACT,
        pieces: mechanism.program().pieces().collect(),
    });
    Ok(described(mechanism)
        .with_elements(spring)
        .with_contact(contact))
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
        super::DISC_CAM,
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
                let (sin, cos) = angle.sin_cos();
                [roller.radius() * cos, roller.radius() * sin]
            });
            any.with_outline(DiscCam::ROLLER, rim.collect())
                .with_point("B", DiscCam::FOLLOWER, at)
        }
    }
}

fn roller(section: &Section) -> Result<Roller> {
    let section = section.section("roller")?;
    let radius = section.quantity("radius", &LENGTH)?.positive()?;
    let mass = section.quantity("mass", &MASS)?.not_negative()?;
    let inertia = section.quantity("inertia", &INERTIA)?.not_negative()?;
    section.finish_with(|key| {
        (key == "com").then_some("a roller is balanced: its centre of mass lies on its axis")
    })?;
    Roller::new(radius, mass, inertia).map_err(|error| core(&section, &error))
}

/// The follower's geometry and its mass properties without the roller.
fn read_follower(
    section: &Section,
    oscillating: bool,
    roller: Option<Roller>,
) -> Result<(Follower, Link)> {
    if !oscillating {
        let offset = section.optional("offset", &LENGTH)?.map_or(0.0, |v| v.si);
        let follower = match roller {
            Some(roller) => Follower::TranslatingRoller { offset, roller },
            None => Follower::TranslatingFace { offset },
        };
        return Ok((follower, parts::slide(section)?));
    }
    let pivot = section
        .require("pivot", "pivot = [\"90 mm\", \"0 mm\"]")?
        .pair([&LENGTH, &LENGTH])?
        .map(|value| value.si);
    let swing = section
        .require("swing", "swing = \"counter-clockwise\"")?
        .choice(&["counter-clockwise", "clockwise"])?;
    let swing = [Swing::CounterClockwise, Swing::Clockwise][swing];
    let follower = match roller {
        Some(roller) => Follower::OscillatingRoller {
            pivot,
            arm: section.quantity("arm", &LENGTH)?.positive()?,
            swing,
            roller,
        },
        None => Follower::OscillatingFace {
            pivot,
            offset: section.optional("offset", &LENGTH)?.map_or(0.0, |v| v.si),
            swing,
        },
    };
    Ok((follower, link(section)?))
}

fn closing_spring(section: &Section, mechanism: &DiscCam) -> Result<NamedElement> {
    let (stiffness, preload) = if mechanism.follower().pivot().is_some() {
        (&TORSION_STIFFNESS, &TORQUE)
    } else {
        (&STIFFNESS, &FORCE)
    };
    let stiffness = section.quantity("stiffness", stiffness)?.positive()?;
    let preload = section.quantity("preload", preload)?.not_negative()?;
    section.finish()?;
    Ok(NamedElement {
        name: "closing spring".to_owned(),
        element: mechanism
            .closing_spring(stiffness, preload)
            .map_err(|error| core(section, &error))?,
    })
}

/// What is wrong with the cam, at the key that cures it.
fn problem(section: &Section, follower: &Section, base_radius: &Value, error: &Error) -> Problem {
    let Error::Cam(cam) = error else {
        return core(section, error);
    };
    let deg = |phi: f64| format!("{:.2}°", phi.to_degrees());
    match *cam {
        CamError::Undercut {
            phi,
            radius,
            limit,
            base_radius: cure,
        } => {
            let found = base_radius.problem(
                &format!(
                    "is too small: the cam is undercut at φ = {}, where the radius of curvature is {}, \
                     but must be larger than {}",
                    deg(phi),
                    base_radius.show(radius),
                    base_radius.show(limit)
                ),
                "undercut",
            );
            match cure {
                Some(least) => found.help(format!(
                    "make the base radius larger than {}, or the rise smaller, or its angle longer",
                    base_radius.show(least)
                )),
                None => found
                    .help("no base radius cures it: make the rise smaller, or its angle longer"),
            }
        }
        CamError::Offset {
            offset,
            base_radius: least,
        } => base_radius
            .problem(
                &format!(
                    "is too small for the guide's offset of {}",
                    base_radius.show(offset)
                ),
                "too small",
            )
            .help(format!(
                "make it larger than {}, or the offset smaller",
                base_radius.show(least)
            )),
        CamError::Arm {
            pivot_distance,
            reach,
        } => follower
            .problem(
                format!(
                    "the arm in {} cannot hold the roller on the base circle",
                    follower.title()
                ),
                "this follower",
            )
            .help(format!(
                "with the pivot {} from the cam's, base radius + roller radius must lie between {} and {}",
                base_radius.show(pivot_distance),
                base_radius.show(reach[0]),
                base_radius.show(reach[1])
            )),
        CamError::Face {
            pivot_distance,
            least,
        } => follower
            .problem(
                format!(
                    "the face in {} cannot lie on the base circle",
                    follower.title()
                ),
                "this follower",
            )
            .help(format!(
                "its pivot is {} from the cam's, but must be farther than base radius + offset = {}",
                base_radius.show(pivot_distance),
                base_radius.show(least)
            )),
        _ => section.problem(error.to_string(), "in this cam"),
    }
}
