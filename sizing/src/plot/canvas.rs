//! Free drawing in pixels: what plots of curves cannot show.

use super::svg::finish_drawing;
use super::text;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

/// How a line or an area is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ink<'a> {
    /// Colour of the line.
    pub(crate) stroke: &'a str,
    /// Width of the line (px).
    pub(crate) width: f64,
    /// Colour of the area; none: empty.
    pub(crate) fill: Option<&'a str>,
    /// Of the area, 0 to 1.
    pub(crate) opacity: f64,
    /// Dashes; none: solid.
    pub(crate) dashes: Option<&'a str>,
}

impl<'a> Ink<'a> {
    /// A solid line.
    pub(crate) const fn line(stroke: &'a str, width: f64) -> Self {
        Self {
            stroke,
            width,
            fill: None,
            opacity: 1.0,
            dashes: None,
        }
    }

    /// The same with a filled area.
    pub(crate) const fn filled(self, fill: &'a str) -> Self {
        Self {
            fill: Some(fill),
            ..self
        }
    }

    /// The same with an area that is seen through.
    pub(crate) const fn faint(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// The same with dashes.
    pub(crate) const fn dashed(self, dashes: &'a str) -> Self {
        Self {
            dashes: Some(dashes),
            ..self
        }
    }
}

/// Which end of a text stands at its place.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Anchor {
    Start,
    Middle,
}

/// A sheet to draw on, in pixels, y down.
pub(crate) struct Canvas {
    scene: Scene,
}

impl Canvas {
    pub(crate) fn new(width: f64, height: f64) -> Self {
        let mut scene = Scene::new(width, height);
        scene.font_family =
            Some("Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif".to_owned());
        Self { scene }
    }

    /// Opens a group that is placed by `transform`, marked by `mark` (attributes, no user text) and named `title`.
    pub(crate) fn open(&mut self, transform: &str, mark: String, title: &str) {
        self.scene.elements.push(Primitive::GroupStart {
            transform: Some(transform.to_owned()),
            title: (!title.is_empty()).then(|| clean(title)),
            extra_attrs: Some(mark),
        });
    }

    pub(crate) fn close(&mut self) {
        self.scene.elements.push(Primitive::GroupEnd);
    }

    /// Straight lines from point to point.
    pub(crate) fn path(&mut self, points: &[[f64; 2]], closed: bool, ink: &Ink) {
        let mut written: Vec<String> = points
            .iter()
            .map(|[x, y]| format!("{:.2} {:.2}", x + 0.0, y + 0.0))
            .collect();
        written.dedup();
        let end = if closed { "Z" } else { "" };
        self.scene.elements.push(Primitive::Path(Box::new(PathData {
            d: format!("M{}{end}", written.join("L")),
            fill: ink.fill.map(Into::into),
            stroke: ink.stroke.into(),
            stroke_width: ink.width,
            opacity: (ink.opacity < 1.0).then_some(ink.opacity),
            stroke_dasharray: ink.dashes.map(str::to_owned),
        })));
    }

    pub(crate) fn circle(&mut self, [cx, cy]: [f64; 2], r: f64, ink: &Ink) {
        self.scene.elements.push(Primitive::Circle {
            cx,
            cy,
            r,
            fill: ink.fill.unwrap_or("none").into(),
            fill_opacity: (ink.opacity < 1.0).then_some(ink.opacity),
            stroke: Some(ink.stroke.into()),
            stroke_width: Some(ink.width),
        });
    }

    pub(crate) fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, words: &str, colour: &str) {
        self.scene.elements.push(Primitive::Text {
            x,
            y,
            content: text(words),
            size: 13,
            anchor: match anchor {
                Anchor::Start => TextAnchor::Start,
                Anchor::Middle => TextAnchor::Middle,
            },
            rotate: None,
            bold: false,
            color: Some(colour.into()),
        });
    }

    /// Inline SVG that the page can scale.
    pub(crate) fn finish(self) -> String {
        finish_drawing(&self.scene)
    }
}

/// User text without what XML cannot hold; the library escapes it.
fn clean(raw: &str) -> String {
    raw.replace(
        |c: char| c.is_control() || c > '\u{FFFD}' && c < '\u{10000}',
        " ",
    )
}
