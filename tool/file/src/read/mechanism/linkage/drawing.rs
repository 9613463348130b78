//! The approximate drawing: the pose of each body from the file, and from the joints where the file does not give it.
//!
//! Angles that are not given follow from guides and rigid connections. Positions follow from pin to pin, starting at the ground. Newton's method
//! closes the gap at the last pin of each loop.

use crate::math;
use jred::machine::{Body, Joint, Marker};
use jred::mechanism::linkage::{Pair, Pose};

use crate::text::problem::{Problem, Result};

use super::bodies::Bodies;
use super::joints::JointEntry;

/// Known position and angle of a body.
#[derive(Clone, Copy, Default)]
struct BodyPlacement {
    angle: Option<f64>,
    origin: Option<[f64; 2]>,
}

/// One pose for each body. `drawn_at`: the drive's coordinate, if the file gives it.
pub(super) fn poses(
    bodies: &Bodies,
    joints: &[JointEntry],
    drive: usize,
    drawn_at: Option<f64>,
) -> Result<Vec<Pose>> {
    let mut drawing = Drawing {
        known: bodies
            .moving
            .iter()
            .map(|body| BodyPlacement {
                angle: body.angle,
                origin: body.position,
            })
            .collect(),
        drawn_at,
    };
    drawing.angles(joints, drive);
    for (body, known) in bodies.moving.iter().zip(&drawing.known) {
        if known.angle.is_none() {
            return Err(Problem::new(format!(
                "`angle` of body \"{}\" is missing, and no guide determines it",
                body.name
            ))
            .at(body.place.clone(), "`angle` belongs here")
            .help("add its approximate angle in the drawing, such as angle = \"30 deg\"; an error of 10 deg does not matter"));
        }
    }
    drawing.origins(joints, drive);
    let mut poses = Vec::with_capacity(bodies.moving.len());
    for (body, known) in bodies.moving.iter().zip(&drawing.known) {
        let (Some(psi), Some([x, y])) = (known.angle, known.origin) else {
            return Err(Problem::new(format!(
                "the position of body \"{}\" does not follow from its joints",
                body.name
            ))
            .at(body.place.clone(), "`position` belongs here")
            .help("add the approximate position of its frame's origin: position = [\"120 mm\", \"40 mm\"]"));
        };
        poses.push(Pose { x, y, psi });
    }
    Ok(poses)
}

struct Drawing {
    known: Vec<BodyPlacement>,
    drawn_at: Option<f64>,
}

impl Drawing {
    fn of(&self, body: Body) -> BodyPlacement {
        match body {
            Body::Ground => BodyPlacement {
                angle: Some(0.0),
                origin: Some([0.0; 2]),
            },
            Body::Link(link) => self.known.get(link).copied().unwrap_or_default(),
        }
    }

    fn slot(&mut self, body: Body) -> Option<&mut BodyPlacement> {
        self.known.get_mut(body.link()?)
    }

    /// Finds the angles that follow from guides, rigid connections and the drive.
    fn angles(&mut self, joints: &[JointEntry], drive: usize) {
        for _ in 0..self.known.len() {
            for (k, joint) in joints.iter().enumerate() {
                let (markers, turn) = match joint.pair {
                    Pair::Joint(Joint::Prismatic(m) | Joint::Fixed(m)) => (m, 0.0),
                    Pair::Joint(Joint::Revolute(m)) => match self.drawn_at {
                        Some(at) if k == drive => (m, at),
                        _ => continue,
                    },
                    _ => continue,
                };
                let [a, b] = markers;
                match [a, b].map(|m| self.of(m.body).angle.map(|psi| psi + m.angle())) {
                    [Some(along), None] => self.turn(b, along + turn),
                    [None, Some(along)] => self.turn(a, along - turn),
                    _ => {}
                }
            }
        }
    }

    fn turn(&mut self, marker: Marker, direction: f64) {
        if let Some(known) = self.slot(marker.body) {
            known.angle = Some(direction - marker.angle());
        }
    }

    /// Finds the origins, from the ground outwards: over pins first, over guides only where there is no other connection.
    fn origins(&mut self, joints: &[JointEntry], drive: usize) {
        while self.step(joints, drive, false) || self.step(joints, drive, true) {}
    }

    /// Places one more body; false if none can be placed.
    fn step(&mut self, joints: &[JointEntry], drive: usize, over_guides: bool) -> bool {
        for (k, joint) in joints.iter().enumerate() {
            let (markers, way) = match joint.pair {
                Pair::Joint(Joint::Revolute(m) | Joint::Fixed(m)) if !over_guides => (m, None),
                Pair::Joint(Joint::Prismatic(m)) if over_guides => {
                    let at = if k == drive { self.drawn_at } else { None };
                    (m, Some(at.unwrap_or(0.0)))
                }
                Pair::Joint(Joint::PinInSlot(m)) if over_guides => (m, Some(0.0)),
                _ => continue,
            };
            let [a, b] = markers;
            let placed = [a, b].map(|m| self.point(m));
            let (from, to, sign) = match placed {
                [Some(point), None] => (point, b, 1.0),
                [None, Some(point)] => (point, a, -1.0),
                _ => continue,
            };
            let along = self.of(a.body).angle.unwrap_or(0.0) + a.angle();
            let way = sign * way.unwrap_or(0.0);
            let point = [
                from[0] + way * math::cos(along),
                from[1] + way * math::sin(along),
            ];
            let arm = self.turned(to);
            if let Some(known) = self.slot(to.body) {
                known.origin = Some([point[0] - arm[0], point[1] - arm[1]]);
                return true;
            }
        }
        false
    }

    /// The vector from the origin of a marker's body to the marker, in global components.
    fn turned(&self, marker: Marker) -> [f64; 2] {
        let (sin, cos) = math::sin_cos(self.of(marker.body).angle.unwrap_or(0.0));
        let [u, v] = marker.at;
        [cos * u - sin * v, sin * u + cos * v]
    }

    fn point(&self, marker: Marker) -> Option<[f64; 2]> {
        let [x, y] = self.of(marker.body).origin?;
        let [dx, dy] = self.turned(marker);
        Some([x + dx, y + dy])
    }
}
