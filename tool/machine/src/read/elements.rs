//! `[[spring]]` and `[[damper]]` between two bodies.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::{Body, Element, MAX_ELEMENTS, Marker, Mechanism as _};
use jred::number::Transfer;

use crate::model::coordinate::Coordinate;
use crate::model::mechanism::{AnyMechanism, NamedElement};
use crate::number::numerics;
use crate::plain;

use crate::text::item::Item;
use crate::text::problem::{Problem, Result, quoted};
use crate::text::section::Section;
use crate::units::did_you_mean;
use crate::units::kind::{
    ANGLE, LENGTH, STIFFNESS, TORSION_STIFFNESS, VISCOUS_FORCE, VISCOUS_MOMENT,
};

/// Name of the fixed frame in joints and elements.
const GROUND: &str = "ground";

/// Number of positions at which an element is checked.
const PLACES: u32 = 720;

/// All springs, then all dampers of the file.
pub(super) fn read(
    root: &Section,
    mechanism: &AnyMechanism,
    coordinate: Coordinate,
) -> Result<Vec<NamedElement>> {
    let mut elements = mechanism.own_elements().to_vec();
    for (key, title) in [("spring", "[[spring]]"), ("damper", "[[damper]]")] {
        let Some(item) = root.get(key) else {
            continue;
        };
        for section in item.sections(title)? {
            if elements.len() == MAX_ELEMENTS {
                return Err(section
                    .problem(
                        format!("more than {MAX_ELEMENTS} springs and dampers in total"),
                        "one too many",
                    )
                    .help("combine parallel ones: add their stiffnesses"));
            }
            elements.push(element(&section, key, mechanism, coordinate)?);
        }
    }
    Ok(elements)
}

/// One end, with its text in the file.
struct End {
    marker: Marker,
    text: String,
    /// A point, not only a body.
    point: bool,
}

fn element(
    section: &Section,
    key: &'static str,
    mechanism: &AnyMechanism,
    coordinate: Coordinate,
) -> Result<NamedElement> {
    let name = section
        .get("name")
        .map(|item| item.text("counterbalance"))
        .transpose()?;
    let between = section.require(
        "between",
        "between = [\"slider\", { on = \"ground\", at = [\"0 mm\", \"400 mm\"] }]",
    )?;
    let list = between.list("end", "[\"slider\", \"ground\"]")?;
    let [first, second] = list.as_slice() else {
        let count = list.len();
        return Err(between
            .problem(&format!("has {count} ends, but must have two"), "here")
            .help(format!("a {key} acts between two points or two bodies")));
    };
    let ends = [end(first, mechanism)?, end(second, mechanism)?];
    if ends[0].marker.body == ends[1].marker.body {
        return Err(between
            .problem(
                &format!("names one body twice: the {key} does nothing"),
                "the same body",
            )
            .help(format!(
                "a {key} acts between two different bodies, or a body and the ground"
            )));
    }
    let (law, torsion) = if key == "spring" {
        spring(section)?
    } else {
        damper(section)?
    };
    section.finish()?;
    if torsion && let Some((end, item)) = ends.iter().zip(&list).find(|(end, _)| end.point) {
        return Err(item
            .problem(
                &format!(
                    "is the point {}, but a {key} in torsion acts between bodies",
                    end.text
                ),
                "a point",
            )
            .help("name the two bodies alone, such as between = [\"ground\", \"rocker\"]"));
    }
    let markers = [ends[0].marker, ends[1].marker];
    let element = law.element(markers).map_err(|error| {
        section
            .problem(error.to_string(), &format!("in this {key}"))
            .help(error.cure().to_string())
    })?;
    Survey {
        section,
        between: &between,
        key,
        coordinate,
        torsion,
    }
    .check(&element, mechanism)?;
    let name = name.map_or_else(
        || format!("{key} from {} to {}", ends[0].text, ends[1].text),
        ToOwned::to_owned,
    );
    Ok(NamedElement { name, element })
}

/// Law of an element, before its ends are known.
enum Law {
    Spring(f64, f64),
    TorsionSpring(f64, f64),
    Damper(f64),
    TorsionDamper(f64),
}

impl Law {
    fn element(
        &self,
        between: [Marker; 2],
    ) -> std::result::Result<Element, jred::number::RangeError> {
        match *self {
            Self::Spring(stiffness, free) => Element::spring(between, stiffness, free),
            Self::TorsionSpring(stiffness, free) => {
                Element::torsion_spring(between, stiffness, free)
            }
            Self::Damper(coefficient) => Element::damper(between, coefficient),
            Self::TorsionDamper(coefficient) => Element::torsion_damper(between, coefficient),
        }
    }
}

/// The spring, and whether it is one in torsion.
fn spring(section: &Section) -> Result<(Law, bool)> {
    section.expects(&["stiffness"]);
    match (section.get("free_length"), section.get("free_angle")) {
        (Some(length), None) => {
            let stiffness = section.quantity("stiffness", &STIFFNESS)?.positive()?;
            let length = length.quantity(&LENGTH)?.not_negative()?;
            Ok((Law::Spring(stiffness, length), false))
        }
        (None, Some(angle)) => {
            let stiffness = section.quantity("stiffness", &TORSION_STIFFNESS)?.positive()?;
            Ok((Law::TorsionSpring(stiffness, angle.quantity(&ANGLE)?.si), true))
        }
        (Some(length), Some(angle)) => Err(Problem::new(format!(
            "{} has both `free_length` and `free_angle`",
            section.title()
        ))
        .at(length.key_span(), "of a spring along a line")
        .at(angle.key_span(), "of a spring in torsion")
        .help("keep one of them")),
        (None, None) => Err(section.missing(
            "free_length",
            "free_length = \"250 mm\", the length without force, or free_angle = \"0 deg\" for a spring in torsion",
        )),
    }
}

/// The damper, and whether it is one in torsion.
fn damper(section: &Section) -> Result<(Law, bool)> {
    match (section.get("viscous_force"), section.get("viscous_moment")) {
        (Some(force), None) => {
            let coefficient = force.quantity(&VISCOUS_FORCE)?.positive()?;
            Ok((Law::Damper(coefficient), false))
        }
        (None, Some(moment)) => {
            let coefficient = moment.quantity(&VISCOUS_MOMENT)?.positive()?;
            Ok((Law::TorsionDamper(coefficient), true))
        }
        (Some(force), Some(moment)) => Err(Problem::new(format!(
            "{} has both `viscous_force` and `viscous_moment`",
            section.title()
        ))
        .at(force.key_span(), "along a line")
        .at(moment.key_span(), "in torsion")
        .help("write a separate [[damper]] for each")),
        (None, None) => Err(section.missing(
            "viscous_force",
            "viscous_force = \"300 N s/m\", or viscous_moment = \"0.4 N m s/rad\" for a damper in torsion",
        )),
    }
}

/// A text that names a body or a point, or a table with a body and coordinates.
fn end(item: &Item, mechanism: &AnyMechanism) -> Result<End> {
    if !item.is_table() {
        let text = item.text("slider")?;
        return named(text, mechanism).ok_or_else(|| unknown(item, text, mechanism));
    }
    let section = item.section("this end".to_owned())?;
    let on = section.require("on", "on = \"ground\"")?;
    let name = on.text("ground")?;
    let body = body(name, mechanism).ok_or_else(|| unknown(&on, name, mechanism))?;
    let at = match section.get("at") {
        Some(at) => Some(at.pair([&LENGTH, &LENGTH])?.map(|value| value.si)),
        None => None,
    };
    section.finish()?;
    Ok(End {
        marker: marker(body, at.unwrap_or_default()),
        text: name.to_owned(),
        point: at.is_some(),
    })
}

fn marker(body: Body, at: [f64; 2]) -> Marker {
    match body {
        Body::Ground => Marker::ground(at),
        Body::Link(link) => Marker::on(link, at),
    }
}

fn body(name: &str, mechanism: &AnyMechanism) -> Option<Body> {
    if name == GROUND {
        return Some(Body::Ground);
    }
    let link = mechanism
        .link_names()
        .iter()
        .position(|link| link == name)?;
    Some(Body::Link(link))
}

/// "crank", "crank.A", "A", "ground", "ground.S"
fn named(text: &str, mechanism: &AnyMechanism) -> Option<End> {
    let whole = |marker, point| End {
        marker,
        text: text.to_owned(),
        point,
    };
    if let Some(body) = body(text, mechanism) {
        return Some(whole(marker(body, [0.0, 0.0]), false));
    }
    if let Some(point) = text.strip_prefix("ground.") {
        let mut points = mechanism.ground_points().iter();
        let (_, at) = points.find(|(name, _)| name == point)?;
        return Some(whole(Marker::ground(*at), true));
    }
    let links = mechanism.link_names();
    let point = mechanism.points().iter().find(|point| {
        let link = links.get(point.link).map_or("", String::as_str);
        point.name == text || format!("{link}.{}", point.name) == text
    })?;
    Some(whole(Marker::on(point.link, point.at), true))
}

fn unknown(item: &Item, text: &str, mechanism: &AnyMechanism) -> Problem {
    let links = mechanism.link_names();
    let mut names = vec![GROUND.to_owned()];
    names.extend(links.iter().cloned());
    let ground = mechanism.ground_points().iter();
    names.extend(ground.map(|(name, _)| format!("{GROUND}.{name}")));
    names.extend(mechanism.points().iter().map(|point| {
        let link = links.get(point.link).map_or("", String::as_str);
        if point.name.starts_with(&format!("{link}.")) {
            point.name.clone()
        } else {
            format!("{link}.{}", point.name)
        }
    }));
    let near = did_you_mean(text, &names);
    item.problem(
        &format!(
            "is \"{}\", which is no body and no point",
            plain::cut(text)
        ),
        "unknown",
    )
    .help(format!(
        "{near}possible: {}; for any other point write {{ on = \"{}\", at = [\"30 mm\", \"0 mm\"] }}",
        quoted(&names),
        links.last().map_or(GROUND, String::as_str)
    ))
}

/// Checks over the whole range of the drive link.
struct Survey<'a> {
    section: &'a Section<'a>,
    between: &'a Item<'a>,
    key: &'static str,
    coordinate: Coordinate,
    torsion: bool,
}

impl Survey<'_> {
    fn check(&self, element: &Element, mechanism: &AnyMechanism) -> Result<()> {
        let length = |phi: f64| -> Result<Transfer> {
            let frames = mechanism.frames(phi).map_err(|error| {
                self.section
                    .problem(error.to_string(), "in this mechanism")
                    .help(error.cure().to_string())
            })?;
            Ok(element.length(&frames))
        };
        let domain = mechanism.domain();
        let step = 1.0 / f64::from(PLACES);
        let mut moves = false;
        let (mut longest, mut shortest, mut place) = (0.0_f64, f64::INFINITY, 0.0);
        for k in 0..=PLACES {
            let part = step * f64::from(k);
            let now = length(domain.position(part))?;
            // At a point that is reached exactly the direction, and with it the slope, is not a number.
            moves |= now.d1.is_nan() || now.d1.abs() > 1e-12;
            longest = longest.max(now.value.abs());
            if now.value < shortest {
                (shortest, place) = (now.value, part);
            }
        }
        if !moves {
            return Err(self.nothing());
        }
        if !self.torsion {
            let value = |part: f64| Ok(length(domain.position(part))?.value);
            let [low, high] = [(place - step).max(0.0), (place + step).min(1.0)];
            let phi = domain.position(numerics::least(value, low, high)?);
            if length(phi)?.value <= 1e-9 * longest {
                return Err(self.meets(phi));
            }
        }
        if domain == Domain::Turn {
            self.repeats(length)?;
        }
        Ok(())
    }

    fn nothing(&self) -> Problem {
        let what = if self.torsion { "angle" } else { "length" };
        self.between
            .problem(
                &format!("has ends whose {what} never changes: the {} does nothing", self.key),
                "does nothing",
            )
            .help(if self.torsion {
                "the two bodies never turn relative to each other: choose others, or give a spring along a line"
            } else {
                "the distance of the two points never changes: choose points that move, such as { on = \"crank\", at = [\"30 mm\", \"0 mm\"] }"
            })
    }

    fn meets(&self, phi: f64) -> Problem {
        self.between
            .problem(
                &format!(
                    "has ends that coincide at {}: the direction of the {} is undefined there",
                    self.coordinate.place(phi),
                    self.key
                ),
                "these points coincide",
            )
            .help("move one of the two points aside slightly")
    }

    /// The element must have the same effect after each turn.
    fn repeats(&self, length: impl Fn(f64) -> Result<Transfer>) -> Result<()> {
        for phi in [0.4, 2.9, 5.1] {
            let (now, later) = (length(phi)?, length(phi + TAU)?);
            let (a, b) = match self.key {
                "spring" => (now.value, later.value),
                _ => (now.d1, later.d1),
            };
            if (a - b).abs() > 1e-9 * (1.0 + a.abs()) {
                let what = if self.torsion {
                    format!(
                        "is wound up by {} deg in every turn of the drive link",
                        ((later.value - now.value).to_degrees() * 1e3).round() / 1e3
                    )
                } else {
                    "has another length after a turn of the drive link".to_owned()
                };
                return Err(self
                    .between
                    .problem(&format!("names a {} that {what}", self.key), "does not repeat")
                    .help(
                        "every force must repeat with each turn of the drive link: attach it to bodies that return, or \
                         limit the drive with `stroke` if the mechanism has one",
                    ));
            }
        }
        Ok(())
    }
}
