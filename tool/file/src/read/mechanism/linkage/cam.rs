//! `type = "cam"`: a disc cam and its follower as a joint of a linkage.

use crate::math;
use std::f64::consts::TAU;
use std::ops::Range;

use jred::machine::{Body, Mechanism};
use jred::mechanism::cam::Piece;
use jred::mechanism::linkage::{Pair, PlacedCam};
use jred::mechanism::{CamProfile, Follower, Roller, RollerDimensions};

use crate::model::mechanism::{AnyMechanism, Contact};
use crate::number::rounding::figure;
use crate::read::mechanism::{core, disc_cam};
use crate::text::problem::{Problem, Result};
use crate::text::section::Section;

use super::bodies::{Bodies, JointEnd};
use super::joints::JointEntry;
use super::survey;

/// The most cams of a linkage.
pub(super) const MOST: usize = 8;

/// Share of the base radius by which the bearings may miss the positions that the joint requires: rounding in the file.
const ROUNDING: f64 = 1e-4;

/// Largest angular velocity, relative to the drive's, that counts as standstill.
const STANDSTILL: f64 = 1e-6;

/// Points of the profile for drawings.
const OUTLINE: u32 = 720;

/// Data of a cam in addition to its pair.
pub(super) struct Cam {
    pub(super) placed: PlacedCam,
    /// A groove or a second cam constrains the follower on both sides.
    by_form: bool,
    /// Places in the file of the axis and the follower.
    axis: Range<usize>,
    follower: Range<usize>,
}

/// The pair, with index `place` among the linkage's cams, and the cam.
pub(super) fn read(
    section: &Section,
    bodies: &Bodies,
    [cam, follower]: [JointEnd; 2],
    place: usize,
) -> Result<(Pair, Cam)> {
    if place >= MOST {
        return Err(section
            .problem(format!("the linkage has more than {MOST} cams"), "one too many")
            .help("combine cams that act on the same follower one after the other into one cam with one program"));
    }
    let axis = section.need("axis")?;
    let end = bodies.end(&axis)?;
    if [cam.body, follower.body].contains(&end.body) {
        return Err(axis
            .problem(
                &format!("is on {}, which this joint moves", bodies.name(end.body)),
                "not the body of the bearings",
            )
            .help("name the point on the body that carries the bearings of both, usually the ground: axis = \"ground.O\""));
    }
    let base = end.marker().with_angle(section.si("axis_direction")?);
    let by_form = section.word("closure")? == 1;
    let base_radius = section.value("base_radius")?;
    let part = section.table("follower")?;
    let shape = disc_cam::follower(&part, || roller(section))?;
    part.finish()?;
    section.set_slides(shape.pivot().is_none());
    let program = disc_cam::program(section)?;
    let profile = CamProfile::new(program, base_radius.si, shape)
        .map_err(|error| disc_cam::problem(section, &part, &base_radius, error))?;
    let pair = Pair::Cam {
        cam: cam
            .marker()
            .with_angle(section.maybe("direction")?.unwrap_or(0.0)),
        follower: follower
            .marker()
            .with_angle(section.si("second_direction")?),
        place,
    };
    let cam = Cam {
        placed: PlacedCam::new(profile, base),
        by_form,
        axis: axis.span(),
        follower: part.header(),
    };
    Ok((pair, cam))
}

/// The roller; a linkage needs its radius only.
fn roller(section: &Section) -> Result<Roller> {
    let section = section.table("roller")?;
    let radius = section.si("radius")?;
    section.finish()?;
    Roller::new(RollerDimensions {
        radius,
        mass: 0.0,
        inertia: 0.0,
    })
    .map_err(|error| core(&section, error))
}

/// Checks over the drive's range that the bearings are where the joints require them.
pub(super) fn check(
    mechanism: &impl Mechanism,
    bodies: &Bodies,
    joints: &[JointEntry],
) -> Result<()> {
    for (joint, cam) in cams(joints) {
        for frames in survey(mechanism) {
            stands(joint, cam, bodies, &frames)?;
        }
    }
    Ok(())
}

fn stands(
    joint: &JointEntry,
    cam: &Cam,
    bodies: &Bodies,
    frames: &[jred::machine::Frame],
) -> Result<()> {
    let (base, profile) = (cam.placed.base(), cam.placed.profile());
    let [on_cam, on_follower] = joint.pair.markers();
    let [x, y] = base.position(frames).map(|c| c.value);
    let [cos, sin] = base.axis(frames).map(|c| c.value);
    // In the frame of the base.
    let seen = |marker: &jred::machine::Marker| {
        let [to_x, to_y] = marker.position(frames).map(|c| c.value);
        let (to_x, to_y) = (to_x - x, to_y - y);
        [cos * to_x + sin * to_y, cos * to_y - sin * to_x]
    };
    let mm = |length: f64| figure(length * 1e3);
    let misfit = |message: &str, place: &Range<usize>| {
        Problem::new(format!("joint \"{}\": {message}", joint.name))
            .at(place.clone(), "does not fit")
    };
    let allowed = ROUNDING * profile.base_radius();
    let [u, v] = seen(&on_cam);
    if math::hypot(u, v) > allowed {
        return Err(misfit(
            &format!(
                "the point of the cam {} is {} mm from the axis",
                bodies.name(on_cam.body),
                mm(math::hypot(u, v))
            ),
            &cam.axis,
        )
        .help("`between` names the point of the cam in its bearing, `axis` the point of the other body in the same bearing"));
    }
    let [u, v] = seen(&on_follower);
    let name = bodies.name(on_follower.body);
    if let Some(([p, q], _)) = profile.follower().pivot() {
        if math::hypot(u - p, v - q) > allowed {
            return Err(misfit(
                &format!(
                    "the follower {name} turns about [{} mm, {} mm], seen from the cam's axis, not about its `pivot`, \
                     [{} mm, {} mm]",
                    mm(u), mm(v), mm(p), mm(q)
                ),
                &cam.follower,
            )
                .help("`between` names the point of the follower in its bearing; give its place from the cam's axis as `pivot`"));
        }
    } else {
        let offset = match *profile.follower() {
            Follower::TranslatingRoller { offset, .. } | Follower::TranslatingFace { offset } => {
                offset
            }
            _ => u,
        };
        if (u - offset).abs() > allowed {
            return Err(misfit(
                &format!(
                    "the follower {name} slides {} mm from the cam's axis, but its `offset` is {} mm",
                    mm(u),
                    mm(offset)
                ),
                &cam.follower,
            )
                .help("the follower slides along +y of the arrangement, which `axis_direction` turns, at x = offset"));
        }
        let turn = on_follower.direction(frames).d1 - base.direction(frames).d1;
        if turn.abs() > STANDSTILL {
            return Err(misfit(
                &format!("the follower {name} turns, but its type is for a translating follower"),
                &cam.follower,
            )
            .help("guide it with a prismatic joint, or give it an oscillating type"));
        }
    }
    Ok(())
}

/// Adds the profiles as outlines of their bodies, and the contacts that must not open.
pub(super) fn described(mut mechanism: AnyMechanism, joints: &[JointEntry]) -> AnyMechanism {
    // Within a piece, a curve that is not smooth has its limit at one of the samples, which are some tenths of a degree apart.
    const PIECES: u32 = 12;
    let domain = mechanism.domain();
    let share = |k: u32| domain.position(f64::from(k) / f64::from(PIECES));
    for (index, held) in joints.iter().enumerate() {
        let Some(cam) = &held.cam else { continue };
        let [on_cam, _] = held.pair.markers();
        if let Body::Link(link) = on_cam.body {
            let (sin, cos) = math::sin_cos(on_cam.angle());
            let point = |k: u32| {
                let theta = TAU * f64::from(k) / f64::from(OUTLINE);
                let [u, v] = cam.placed.profile().equidistant(theta, 0.0);
                [
                    on_cam.at[0] + cos * u - sin * v,
                    on_cam.at[1] + sin * u + cos * v,
                ]
            };
            mechanism = mechanism.with_outline(link, (0..OUTLINE).map(point).collect());
        }
        if !cam.by_form {
            mechanism = mechanism.with_contact(Contact {
                joint: index,
                named: true,
                pieces: (0..PIECES)
                    .map(|k| Piece {
                        from: share(k),
                        to: share(k + 1),
                    })
                    .collect(),
            });
        }
    }
    mechanism
}

/// The joints of type "cam".
fn cams(joints: &[JointEntry]) -> impl Iterator<Item = (&JointEntry, &Cam)> {
    joints
        .iter()
        .filter_map(|joint| joint.cam.as_ref().map(|cam| (joint, cam)))
}

/// The cams in the order of their indices.
pub(super) fn placed(joints: &[JointEntry]) -> Vec<PlacedCam> {
    cams(joints).map(|(_, cam)| cam.placed.clone()).collect()
}
