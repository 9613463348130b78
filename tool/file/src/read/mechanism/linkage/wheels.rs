//! Requirements of gears, racks and belts on their bearings, checked on the assembled linkage.

use crate::math;
use jred::machine::{Body, Frame, Marker, Mechanism};
use jred::mechanism::linkage::Pair;

use crate::number::rounding::figure;
use crate::text::problem::{Problem, Result};

use super::bodies::Bodies;
use super::joints::JointEntry;
use super::survey;

/// Share by which radii may miss the centre distance: rounding in the file.
const ROUNDING: f64 = 1e-4;

/// Largest relative speed that counts as standstill.
const STILL: f64 = 1e-6;

/// Distance of a pinion's centre to the left of a rack's pitch line (m).
pub(super) fn offset(pinion: &Marker, rack: &Marker, frames: &[Frame]) -> f64 {
    let [cos, sin] = rack.axis(frames).map(|c| c.value);
    let (c, r) = (pinion.position(frames), rack.position(frames));
    cos * (c[1].value - r[1].value) - sin * (c[0].value - r[0].value)
}

/// Checks every rolling joint at positions over the drive's range.
pub(super) fn check(
    mechanism: &impl Mechanism,
    bodies: &Bodies,
    joints: &[JointEntry],
) -> Result<()> {
    let rolling: Vec<&JointEntry> = joints.iter().filter(|j| j.radii.is_some()).collect();
    if rolling.is_empty() {
        return Ok(());
    }
    for frames in survey(mechanism) {
        for joint in &rolling {
            match &joint.pair {
                Pair::Gears {
                    centres,
                    carrier,
                    radii,
                    ..
                } => gears(joint, bodies, centres, *carrier, *radii, &frames)?,
                Pair::Rack {
                    pinion,
                    rack,
                    radius,
                    ..
                } => {
                    let found = offset(pinion, rack, &frames).abs();
                    if (found - radius.abs()).abs() > ROUNDING * radius.abs() {
                        return Err(misfit(
                            joint,
                            &format!(
                                "the pinion has a radius of {} mm, but its centre is {} mm from the rack's pitch line",
                                figure(radius.abs() * 1e3),
                                figure(found * 1e3)
                            ),
                        )
                        .help("give the pitch radius, or move the point of the rack onto its pitch line"));
                    }
                }
                Pair::Belt { centres, .. } => belt(joint, bodies, centres, &frames)?,
                Pair::Joint(_) | Pair::Cam { .. } => {}
            }
        }
    }
    Ok(())
}

fn misfit(joint: &JointEntry, message: &str) -> Problem {
    let place = joint.radii.clone().unwrap_or(joint.place.clone());
    Problem::new(format!("joint \"{}\": {message}", joint.name)).at(place, "does not fit")
}

fn gears(
    joint: &JointEntry,
    bodies: &Bodies,
    [a, b]: &[Marker; 2],
    carrier: Body,
    [r_a, r_b]: [f64; 2],
    frames: &[Frame],
) -> Result<()> {
    let (from, to) = (a.position(frames), b.position(frames));
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let distance = math::hypot(x.value, y.value);
    let needed = (r_a + r_b).abs();
    if (distance - needed).abs() > ROUNDING * needed {
        let ratio = (r_b / r_a).abs();
        let internal = r_a * r_b < 0.0;
        let first = distance
            / if internal {
                (ratio - 1.0).abs()
            } else {
                ratio + 1.0
            };
        return Err(misfit(
            joint,
            &format!(
                "the gears' radii {} mm and {} mm require a centre distance of {} mm, but it is {} mm",
                figure(r_a.abs() * 1e3),
                figure(r_b.abs() * 1e3),
                figure(needed * 1e3),
                figure(distance * 1e3)
            ),
        )
        .help(format!(
            "the {} of the pitch radii must equal the centre distance: with this ratio, {} mm and {} mm",
            if internal { "difference" } else { "sum" },
            figure(first * 1e3),
            figure(first * ratio * 1e3)
        )));
    }
    // The line of centres must turn with the carrier.
    let turn = (x.value * y.d1 - y.value * x.d1) / (distance * distance);
    let carried = carrier.frame(frames).psi.d1;
    if (turn - carried).abs() > STILL * (1.0 + turn.abs().max(carried.abs())) {
        return Err(misfit(
            joint,
            &format!("{} does not carry both gears", bodies.name(carrier)),
        )
        .help("the centres of both gears must be fixed on one body: name it, such as carrier = \"arm\""));
    }
    Ok(())
}

fn belt(
    joint: &JointEntry,
    bodies: &Bodies,
    centres: &[Marker; 2],
    frames: &[Frame],
) -> Result<()> {
    for centre in centres {
        let [x, y] = centre.position(frames);
        if math::hypot(x.d1, y.d1) > STILL {
            let name = bodies.name(centre.body);
            return Err(
                misfit(joint, &format!("the centre of the pulley {name} moves")).help(
                    "a belt needs pulleys that turn about fixed points; use gears between moving centres",
                ),
            );
        }
    }
    Ok(())
}
