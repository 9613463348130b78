//! The joints of a linkage, each as a pair of the core.

use std::ops::Range;

use jred::machine::{Body, Frame, Joint};
use jred::mechanism::linkage::Pair;

use crate::keys::linkage::JOINTS;
use crate::read::names::Names;
use crate::text::item::Item;
use crate::text::problem::Result;
use crate::text::section::Section;

use super::bodies::{Bodies, JointEnd};
use super::cam::{self, Cam};

/// One joint as the file gives it.
pub(super) struct JointEntry {
    pub(super) name: String,
    pub(super) kind: &'static str,
    pub(super) pair: Pair,
    pub(super) place: Range<usize>,
    /// Place in the file of the radii of a rolling joint.
    pub(super) radii: Option<Range<usize>>,
    pub(super) cam: Option<Cam>,
}

impl JointEntry {
    /// The joint with its teeth in mesh in the drawn position; a rack lies on the side of its pinion where it is drawn.
    pub(super) fn meshing_at(&mut self, frames: &[Frame]) {
        if let Pair::Rack {
            pinion,
            rack,
            radius,
            ..
        } = &mut self.pair
        {
            let offset = super::wheels::offset(pinion, rack, frames);
            *radius = radius.abs().copysign(offset);
        }
        self.pair = self.pair.meshing_at(frames);
    }
}

pub(super) fn read(section: &Section, bodies: &Bodies) -> Result<Vec<JointEntry>> {
    let sections = section.tables("joint")?;
    let mut joints: Vec<JointEntry> = Vec::with_capacity(sections.len());
    let mut names = Names::of("joints");
    for section in &sections {
        let cams = joints.iter().filter(|joint| joint.cam.is_some()).count();
        let joint = joint(section, bodies, cams)?;
        names.add_text(&joint.name, joint.place.clone())?;
        joints.push(joint);
    }
    Ok(joints)
}

/// Reads a joint. `cams`: number of cams among the joints before it.
fn joint(section: &Section, bodies: &Bodies, cams: usize) -> Result<JointEntry> {
    let kind = JOINTS[section.word("type")?];
    section.choose(kind);
    let between = section.need("between")?;
    let two = between.both("end", "[\"ground.O\", \"crank\"]");
    let [first, second] = &two.map_err(|problem| {
        if between.is_list() {
            problem.help("a pin that connects three bodies is two joints at the same point")
        } else {
            problem
        }
    })?;
    let ends = [bodies.end(first)?, bodies.end(second)?];
    if ends[0].body == ends[1].body {
        return Err(between
            .problem(
                &format!("joins {} to itself", bodies.name(ends[0].body)),
                "the same body twice",
            )
            .help("a joint connects two different bodies, or a body and the ground"));
    }
    let name = match section.text("name")? {
        Some(name) => name.to_owned(),
        None => format!("{} to {}", first.text("")?, second.text("")?),
    };
    let (pair, radii, cam) = if kind == "cam" {
        let (pair, cam) = cam::read(section, bodies, ends, cams)?;
        (pair, None, Some(cam))
    } else {
        let (pair, radii) = pair(kind, section, bodies, ends)?;
        (pair, radii, None)
    };
    section.finish()?;
    Ok(JointEntry {
        name,
        kind,
        pair,
        place: section.header(),
        radii,
        cam,
    })
}

/// The pair, and the place of its radii in the file.
fn pair(
    kind: &str,
    section: &Section,
    bodies: &Bodies,
    ends: [JointEnd; 2],
) -> Result<(Pair, Option<Range<usize>>)> {
    let [a, b] = ends.map(|end| end.marker());
    let joint = |joint| Ok((Pair::Joint(joint), None));
    match kind {
        "revolute" => joint(Joint::Revolute([a, b])),
        "prismatic" => {
            let direction = direction(section, ": the guide's direction on the first body")?;
            let [a, b] = [
                a.with_angle(direction),
                b.with_angle(section.si("second_direction")?),
            ];
            joint(Joint::Prismatic([a, b]))
        }
        "fixed" => joint(Joint::Fixed([
            a.with_angle(section.maybe("direction")?.unwrap_or(0.0)),
            b.with_angle(section.si("second_direction")?),
        ])),
        "pin-in-slot" => {
            let direction = direction(section, ": the slot's direction on the second body")?;
            joint(Joint::PinInSlot([a, b.with_angle(direction)]))
        }
        "rack" => {
            let radius = section.value("radius")?;
            let place = radius.span();
            let of_line = ": the direction of the rack's pitch line on the second body";
            let direction = direction(section, of_line)?;
            let rack = Pair::Rack {
                pinion: a,
                rack: b.with_angle(direction),
                radius: radius.si,
                phase: 0.0,
            };
            Ok((rack, Some(place)))
        }
        _ => {
            let item = section.need("radii")?;
            let place = item.span();
            let [r_a, r_b] = item.values()?;
            let radii = [r_a.positive()?, r_b.positive()?];
            let pair = if kind == "belt" {
                let crossed = section.is("crossed")?;
                Pair::Belt {
                    centres: [a, b],
                    radii: [radii[0], if crossed { -radii[1] } else { radii[1] }],
                    phase: 0.0,
                }
            } else {
                Pair::Gears {
                    centres: [a, b],
                    carrier: carrier(section, bodies, ends)?,
                    radii: meshing(section, &item, radii)?,
                    phase: 0.0,
                }
            };
            Ok((pair, Some(place)))
        }
    }
}

/// The direction (rad) that a joint must have; `what` it is.
fn direction(section: &Section, what: &str) -> Result<f64> {
    let example = format!("direction = \"0 deg\"{what}");
    let item = section.get("direction");
    Ok(item
        .ok_or_else(|| section.missing("direction", &example))?
        .value()?
        .si)
}

/// The body that carries both gears.
fn carrier(section: &Section, bodies: &Bodies, ends: [JointEnd; 2]) -> Result<Body> {
    let Some(item) = section.get("carrier") else {
        if ends.iter().any(|end| end.body == Body::Ground) {
            return Err(section.missing(
                "carrier",
                "carrier = \"arm\": one of these gears is the ground, so a rotating body carries the other one",
            ));
        }
        return Ok(Body::Ground);
    };
    let carrier = bodies.find(&item, item.words_of_text()?)?;
    if ends.iter().any(|end| end.body == carrier) {
        return Err(item
            .problem(
                &format!(
                    "refers to {}, which is one of the gears",
                    bodies.name(carrier)
                ),
                "a gear",
            )
            .help("the carrier is the body that holds the bearings of both gears"));
    }
    Ok(carrier)
}

/// The radii with the core's sign for a ring gear.
fn meshing(section: &Section, item: &Item, radii: [f64; 2]) -> Result<[f64; 2]> {
    let internal = section.word("mesh")? == 1;
    if !internal {
        return Ok(radii);
    }
    let [a, b] = radii;
    if (a - b).abs() <= 1e-9 * a.max(b) {
        return Err(item
            .problem(
                "are equal, but in an internal mesh one gear is a ring and larger than the other",
                "equal radii",
            )
            .help("give the ring gear its larger pitch radius"));
    }
    Ok(if a > b { [-a, b] } else { [a, -b] })
}
