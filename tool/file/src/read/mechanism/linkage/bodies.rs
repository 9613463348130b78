//! The bodies of a linkage: mass, approximate drawing, and the points that joints connect.
use std::ops::Range;

use jred::machine::Link;
use jred::machine::{Body, Marker, MassProperties};

use crate::plain;
use crate::read::mechanism::core;
use crate::read::names::Names;
use crate::text::item::Item;
use crate::text::problem::{Result, quoted};
use crate::text::section::Section;
use crate::units::{closest, did_you_mean};

/// Name of the fixed frame in joints.
pub(super) const GROUND: &str = "ground";

/// One body as the file gives it.
pub(super) struct BodyEntry {
    pub(super) name: String,
    pub(super) link: Link,
    pub(super) points: Vec<BodyPoint>,
    /// Angle in the drawing (rad).
    pub(super) angle: Option<f64>,
    /// Origin in the drawing (m).
    pub(super) position: Option<[f64; 2]>,
    /// Whether the file gives a moment of inertia.
    pub(super) has_inertia: bool,
    pub(super) place: Range<usize>,
}

/// A point with its name, in its body's frame (m).
pub(super) struct BodyPoint {
    pub(super) name: String,
    pub(super) at: [f64; 2],
}

/// The points of the ground, and all moving bodies.
pub(super) struct Bodies {
    pub(super) ground: Vec<BodyPoint>,
    pub(super) moving: Vec<BodyEntry>,
}

/// A point of a body, referenced by name.
#[derive(Clone, Copy, Debug)]
pub(super) struct JointEnd {
    pub(super) body: Body,
    pub(super) at: [f64; 2],
}

impl JointEnd {
    pub(super) const fn marker(&self) -> Marker {
        match self.body {
            Body::Ground => Marker::ground(self.at),
            Body::Link(link) => Marker::on(link, self.at),
        }
    }
}

impl Bodies {
    pub(super) fn read(section: &Section) -> Result<Self> {
        let ground = named_points(section, GROUND)?;
        let sections = section.tables("body")?;
        let mut bodies = Self {
            ground,
            moving: Vec::with_capacity(sections.len()),
        };
        let mut names = Names::of("bodies");
        for section in &sections {
            let body = drawn(section)?;
            names.add(section)?;
            bodies.moving.push(body);
        }
        Ok(bodies)
    }

    /// Names of the moving bodies.
    pub(super) fn names(&self) -> Vec<String> {
        self.moving.iter().map(|body| body.name.clone()).collect()
    }

    /// The name of a body, the ground included, in quotes.
    pub(super) fn name(&self, body: Body) -> String {
        let moving = body.link().and_then(|link| self.moving.get(link));
        format!("\"{}\"", moving.map_or(GROUND, |body| &body.name))
    }

    /// The body called `name`.
    pub(super) fn find(&self, item: &Item, name: &str) -> Result<Body> {
        if name == GROUND {
            return Ok(Body::Ground);
        }
        if let Some(link) = self.moving.iter().position(|body| body.name == name) {
            return Ok(Body::Link(link));
        }
        let mut names = vec![GROUND.to_owned()];
        names.extend(self.names());
        let near = did_you_mean(name, &names);
        Err(item
            .problem(
                &format!(
                    "refers to \"{}\", but there is no such body",
                    plain::cut(name)
                ),
                "unknown body",
            )
            .help(format!("{near}bodies: {}", quoted(&names))))
    }

    /// The point that `item` names: "body.point", or "body" for the origin of its frame.
    pub(super) fn end(&self, item: &Item) -> Result<JointEnd> {
        let text = item.text("crank.A")?;
        let (name, point) = match text.split_once('.') {
            Some((name, point)) => (name.trim(), Some(point.trim())),
            None => (text, None),
        };
        let body = self.find(item, name)?;
        let Some(point) = point else {
            return Ok(JointEnd {
                body,
                at: [0.0, 0.0],
            });
        };
        let points = match body {
            Body::Ground => &self.ground,
            Body::Link(link) => self.moving.get(link).map_or(&self.ground, |b| &b.points),
        };
        if let Some(found) = points.iter().find(|p| p.name == point) {
            return Ok(JointEnd { body, at: found.at });
        }
        let names: Vec<&str> = points.iter().map(|p| p.name.as_str()).collect();
        let [name, point] = [name, point].map(plain::cut);
        let near = closest(&point, &names).map_or_else(String::new, |near| {
            format!("did you mean \"{name}.{near}\"? ")
        });
        let known = match (body, names.as_slice()) {
            (Body::Ground, []) => format!(
                "the ground has no points yet: add ground = {{ {point} = [\"0 mm\", \"0 mm\"] }} to [mechanism]"
            ),
            (_, []) => format!(
                "\"{name}\" has no points yet: add points = {{ {point} = [\"80 mm\", \"0 mm\"] }} to it"
            ),
            _ => format!("points of \"{name}\": {}", names.join(", ")),
        };
        Err(item
            .problem(
                &format!("refers to the point \"{point}\", which \"{name}\" does not have"),
                "unknown point",
            )
            .help(format!(
                "{near}{known}; \"{name}\" alone is the origin of its frame"
            )))
    }
}

fn drawn(section: &Section) -> Result<BodyEntry> {
    let item = section.need("name")?;
    let name = item.words_of_text()?.to_owned();
    if name == GROUND || name.contains('.') {
        let what = if name == GROUND {
            "is \"ground\", the name of the fixed frame".to_owned()
        } else {
            format!("is \"{}\", which contains a point", plain::cut(&name))
        };
        return Err(item
            .problem(&what, "another name")
            .help("joints write \"body.point\"; choose a name without \".\", and not \"ground\""));
    }
    let inertia = section.maybe("inertia")?;
    let properties = MassProperties {
        mass: section.si("mass")?,
        inertia: inertia.unwrap_or(0.0),
        com: section.two("com")?,
    };
    let angle = section.maybe("angle")?;
    let position = section.get("position").map(|item| item.two()).transpose()?;
    let points = named_points(section, "points")?;
    section.finish()?;
    let link = Link::new(properties).map_err(|error| core(section, error))?;
    Ok(BodyEntry {
        name,
        link,
        points,
        angle,
        position,
        has_inertia: inertia.is_some(),
        place: section.header(),
    })
}

/// The points of a table whose keys are their names.
fn named_points(section: &Section, key: &'static str) -> Result<Vec<BodyPoint>> {
    let Some(table) = section.maybe_table(key)? else {
        return Ok(Vec::new());
    };
    let point = |(name, item): (&str, Item)| {
        if name.contains('.') || name.trim().is_empty() {
            return Err(item
                .problem("has a name that joints cannot use", "this point")
                .help("joints write \"body.point\": choose a name without \".\", such as A"));
        }
        Ok(BodyPoint {
            name: name.trim().to_owned(),
            at: item.two()?,
        })
    };
    table.entries().into_iter().map(point).collect()
}
