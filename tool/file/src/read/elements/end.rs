//! An end of a spring or damper: a point of a body, or the body.

use jred::machine::{Body, Marker};

use crate::model::mechanism::AnyMechanism;
use crate::plain;
use crate::text::item::Item;
use crate::text::problem::{Problem, Result, quoted};
use crate::units::did_you_mean;

/// Name of the fixed frame in joints and elements.
const GROUND: &str = "ground";

/// One end, with its text in the file.
pub(super) struct End {
    pub(super) marker: Marker,
    pub(super) text: String,
    /// Whether it is a point, not only a body.
    pub(super) point: bool,
}

/// Parses a text that names a body or a point, or a table with a body and coordinates.
pub(super) fn end(item: &Item, mechanism: &AnyMechanism) -> Result<End> {
    if !item.is_table() {
        let text = item.text("slider")?;
        return named(text, mechanism).ok_or_else(|| unknown(item, text, mechanism));
    }
    let section = item.section("this end".to_owned())?;
    let on = section.need("on")?;
    let name = on.words_of_text()?;
    let body = body(name, mechanism).ok_or_else(|| unknown(&on, name, mechanism))?;
    let at = section.get("at").map(|at| at.two()).transpose()?;
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
