//! A linkage as it is drawn: points, bodies through them, guides; see `Linkage` in `page/src/protocol.ts`. Lengths in mm, angles in degrees.

use jred_file::math;
use serde::{Deserialize, Serialize};

#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(default)]
pub(crate) struct Linkage {
    pub(crate) title: String,
    pub(crate) points: Vec<Point>,
    pub(crate) bodies: Vec<Body>,
    pub(crate) guides: Vec<Guide>,
    pub(crate) drive: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) speed: Option<f64>,
    pub(crate) loads: Vec<Load>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) gravity: Option<[f64; 2]>,
}

#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(default)]
pub(crate) struct Point {
    pub(crate) name: String,
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) ground: bool,
}

#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(default)]
pub(crate) struct Body {
    pub(crate) name: String,
    pub(crate) points: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) mass: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) inertia: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) com: Option<[f64; 2]>,
}

#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(default)]
pub(crate) struct Guide {
    pub(crate) point: String,
    pub(crate) angle: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) on: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) body: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) mass: Option<f64>,
}

#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(default)]
pub(crate) struct Load {
    pub(crate) name: String,
    pub(crate) on: String,
    pub(crate) at: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) force: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) opposing: Option<f64>,
}

/// The frame of a body in the drawing: origin (mm) and angle (rad) of its u axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) origin: [f64; 2],
    pub(crate) angle: f64,
}

impl Frame {
    /// A place of the drawing in this frame.
    pub(crate) fn inside(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = math::sin_cos(self.angle);
        let [dx, dy] = [x - self.origin[0], y - self.origin[1]];
        [cos * dx + sin * dy, cos * dy - sin * dx]
    }

    /// A place of this frame in the drawing.
    pub(crate) fn outside(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = math::sin_cos(self.angle);
        [
            self.origin[0] + cos * u - sin * v,
            self.origin[1] + sin * u + cos * v,
        ]
    }
}

impl Linkage {
    pub(crate) fn point(&self, name: &str) -> Option<&Point> {
        self.points.iter().find(|point| point.name == name)
    }

    fn place(&self, name: &str) -> Option<[f64; 2]> {
        self.point(name).map(|point| [point.x, point.y])
    }

    /// The frame of a body: from its first point towards the second.
    pub(crate) fn frame(&self, body: &Body) -> Option<Frame> {
        let mut places = body.points.iter().filter_map(|name| self.place(name));
        let origin = places.next()?;
        let [x, y] = places.next()?;
        Some(Frame {
            origin,
            angle: math::atan2(y - origin[1], x - origin[0]),
        })
    }

    /// The points of a body in its frame.
    pub(crate) fn local<'a>(&'a self, body: &'a Body) -> Vec<(&'a str, [f64; 2])> {
        let Some(frame) = self.frame(body) else {
            return Vec::new();
        };
        let points = body.points.iter();
        points
            .filter_map(|name| Some((name.as_str(), frame.inside(self.place(name)?))))
            .collect()
    }
}
