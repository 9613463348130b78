//! A linkage from a link of PMKS+: `…?SETTINGS.DECIMALS.COUNTS.UNITS.JOINT.JOINT..LINK.LINK..FORCE..`, each part with commas between its fields,
//! numbers in thousandths to the base 64, negative ones behind a zero.

use jred_file::math;
use jred_file::problem;
use jred_file::text::problem::Result;
use serde_json::json;

use crate::linkage::{Body, Guide, Linkage, Load, Point};
use crate::request::Request;

const DIGITS: &str = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-";

/// Millimetres of its units of length: inch, centimetre, metre.
const UNITS: [f64; 3] = [25.4, 10.0, 1000.0];

/// Said of every import.
const MASSES: &str =
    "PMKS+ gives a link 1 kg and 1 kg m^2 to begin with: check masses and inertias";

/// A joint of the link.
struct Joint {
    id: String,
    at: [f64; 2],
    slides: bool,
    input: bool,
    ground: bool,
    welded: bool,
    /// Direction of a guide on the ground (rad).
    angle: f64,
    /// Of a slot: the link, and two joints on its line.
    slot: Option<[String; 3]>,
}

/// Answers with the linkage, and notes about what differs.
pub(crate) fn import(request: &Request) -> Result<String> {
    let text = request.source().trim();
    let link = text
        .rsplit(['?', '#'])
        .next()
        .unwrap_or_default()
        .replace("%20", " ");
    let wrong = || {
        problem!(
            help = "copy the whole link that PMKS+ shares: it contains joints and links behind a question mark",
            "this is no link of PMKS+"
        )
    };
    let mut parts = link.split('.');
    let settings: [&str; 4] = [(); 4].map(|()| parts.next().unwrap_or_default());
    let mut list = || {
        parts
            .by_ref()
            .take_while(|part| !part.is_empty())
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let (joints, links, forces) = (list(), list(), list());
    if joints.is_empty() || links.is_empty() {
        return Err(wrong());
    }
    let unit = settings[3]
        .get(..1)
        .and_then(integer)
        .and_then(|unit| UNITS.get(unit as usize));
    let unit = *unit.ok_or_else(wrong)?;
    let joints: Option<Vec<Joint>> = joints.iter().map(|part| joint(part, unit)).collect();
    let joints = joints.ok_or_else(wrong)?;
    if let Some(welded) = joints.iter().find(|joint| joint.welded) {
        return Err(problem!(
            help = "make the links that it connects one link in PMKS+",
            "the joint {} is welded, which cannot be drawn here",
            welded.id
        ));
    }
    let speed = settings[2].split(',').next().and_then(integer);
    let mut linkage = Linkage {
        title: "Linkage of PMKS+".to_owned(),
        speed: speed.map(|speed| speed.abs()).filter(|speed| *speed > 0.0),
        gravity: Some([0.0, -9.81]),
        ..Linkage::default()
    };
    for joint in joints.iter().filter(|joint| !joint.slides) {
        let [x, y] = joint.at;
        linkage.points.push(Point {
            name: joint.id.clone(),
            x,
            y,
            ground: joint.ground,
        });
        if joint.input {
            linkage.drive = joint.id.clone();
        }
    }
    for part in &links {
        add_link(&mut linkage, part, &joints, unit).ok_or_else(wrong)?;
    }
    let mut notes = vec![MASSES.to_owned()];
    for part in &forces {
        let turning = add_force(&mut linkage, part, &links, unit).ok_or_else(wrong)?;
        if turning {
            notes
                .push("a force that turns with its link is taken to keep its direction".to_owned());
        }
    }
    Ok(json!({ "linkage": linkage, "notes": notes }).to_string())
}

/// A whole number; a leading zero is a minus sign.
fn integer(text: &str) -> Option<f64> {
    let (sign, digits) = match text.strip_prefix('0') {
        Some("") => return Some(0.0),
        Some(rest) => (-1.0, rest),
        None => (1.0, text),
    };
    let digit = |sum: f64, c: char| Some(sum * 64.0 + DIGITS.find(c)? as f64);
    let size = digits.chars().try_fold(0.0, digit)?;
    (!digits.is_empty()).then_some(sign * size)
}

fn decimal(text: Option<&str>) -> Option<f64> {
    integer(text?).map(|thousandths| thousandths / 1000.0)
}

fn joint(part: &str, unit: f64) -> Option<Joint> {
    let fields: Vec<&str> = part.split(',').collect();
    let flags = integer(fields.first()?.get(..1)?)? as u32;
    // Older links have no names of joints.
    let first = usize::from(fields.len() != 4) + 1;
    let number = |k: usize| decimal(fields.get(first + k).copied());
    let slot = match fields.get(first + 3..) {
        Some([link, a, b]) => Some([link, a, b].map(|text| (*text).to_owned())),
        _ => None,
    };
    Some(Joint {
        id: fields.first()?.get(1..)?.to_owned(),
        at: [number(0)? * unit, number(1)? * unit],
        slides: flags & 1 != 0,
        input: flags & 2 != 0,
        ground: flags & 4 != 0,
        welded: flags & 8 != 0,
        angle: number(2)?,
        slot,
    })
}

/// Identifier of a link, behind a letter for its place and one for its type.
fn id(part: &str) -> Option<&str> {
    part.split(',').next()?.get(2..)
}

fn add_link(linkage: &mut Linkage, part: &str, joints: &[Joint], unit: f64) -> Option<()> {
    // A part of a link of several has the letter N.
    if part.starts_with('N') {
        return Some(());
    }
    let mut fields = part.split(',').skip(2);
    let [mass, inertia, x, y] = [(); 4].map(|()| decimal(fields.next()));
    let own: Vec<&str> = fields
        .skip(1)
        .take_while(|field| !field.is_empty())
        .collect();
    let find = |id: &str| joints.iter().find(|joint| joint.id == id);
    if part.get(1..2)? == "P" {
        let slide = own
            .iter()
            .find_map(|id| find(id).filter(|joint| joint.slides))?;
        let pin = own
            .iter()
            .find_map(|id| find(id).filter(|joint| !joint.slides))?;
        let angle = match &slide.slot {
            None => slide.angle,
            Some([_, a, b]) => {
                let [a, b] = [find(a)?.at, find(b)?.at];
                math::atan2(b[1] - a[1], b[0] - a[0])
            }
        };
        linkage.guides.push(Guide {
            point: pin.id.clone(),
            angle: (angle.to_degrees() * 1e3).round() / 1e3,
            on: slide.slot.as_ref().map(|[link, ..]| link.clone()),
            body: None,
            mass,
        });
        if slide.input {
            linkage.drive = pin.id.clone();
        }
        return Some(());
    }
    let mut body = Body {
        name: id(part)?.to_owned(),
        points: own.into_iter().map(str::to_owned).collect(),
        mass,
        inertia,
        com: None,
    };
    let frame = linkage.frame(&body);
    body.com = frame
        .map(|frame| Some(frame.inside([x? * unit, y? * unit])))
        .unwrap_or_default();
    linkage.bodies.push(body);
    Some(())
}

/// Adds a force, at a point of its own if there is none; returns whether it turns with its link.
fn add_force(linkage: &mut Linkage, part: &str, links: &[String], unit: f64) -> Option<bool> {
    let fields: Vec<&str> = part.split(',').collect();
    let flags = integer(fields.first()?.get(..1)?)? as u32;
    let link = fields.get(1)?;
    links.iter().find(|part| id(part) == Some(link))?;
    let number = |k: usize| decimal(fields.get(k).copied());
    let from = [number(3)? * unit, number(4)? * unit];
    let to = [number(5)? * unit, number(6)? * unit];
    let size = number(7)?;
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = math::hypot(way[0], way[1]);
    let near = |point: &&Point| math::hypot(point.x - from[0], point.y - from[1]) < 1e-3;
    let at = match linkage.points.iter().find(near) {
        Some(point) => point.name.clone(),
        None => {
            let name = fields.first()?.get(1..)?.to_owned();
            linkage.points.push(Point {
                name: name.clone(),
                x: from[0],
                y: from[1],
                ground: false,
            });
            let body = linkage.bodies.iter_mut().find(|body| body.name == *link)?;
            body.points.push(name.clone());
            name
        }
    };
    // A force that faces inwards points from the end of its arrow to the start.
    let sign = if flags & 2 != 0 { size } else { -size };
    linkage.loads.push(Load {
        name: fields
            .get(2)
            .map_or_else(String::new, |name| (*name).to_owned()),
        on: (*link).to_owned(),
        at,
        force: (length > 0.0).then(|| way.map(|x| sign * x / length)),
        opposing: None,
    });
    Some(flags & 1 != 0)
}
