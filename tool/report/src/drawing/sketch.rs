//! Content of a drawing, in metres: parts of links in their own frames, parts of the ground, paths, poses.

use jred_file::math;
use std::f64::consts::FRAC_PI_2;

use jred::error::Error;
use jred::machine::{
    Body, Frames, Joint, Jointed as _, Joints, Machine, Marker, Mechanism as _, PoseError,
};

use jred_file::model::coordinate::whole_range;
use jred_file::model::mechanism::{AnyMechanism, NamedPoint};

/// Number of poses for paths, ranges of guides and the size of the drawing.
const POSES: usize = 240;

/// One part of a body, in the body's frame.
#[derive(Clone, Debug)]
pub(super) enum BodyPart {
    /// A link between two points.
    Bar([[f64; 2]; 2]),
    /// A link through three or more points: their convex hull.
    Plate(Vec<[f64; 2]>),
    /// A closed outline, such as a cam's.
    Outline(Vec<[f64; 2]>),
    /// A wheel of a radius (m) about a point, with a spoke.
    Wheel([f64; 2], f64),
    /// A block that slides in a direction (rad).
    Block([f64; 2], f64),
    /// A guide or a slot from one point to the other.
    Slot([[f64; 2]; 2]),
    /// A pin.
    Pin([f64; 2]),
}

impl BodyPart {
    pub(super) const fn is_pin(&self) -> bool {
        matches!(self, Self::Pin(_))
    }

    /// The pins, blocks and slots of the ground, turned about the origin.
    fn turned(self, by: f64) -> Self {
        match self {
            Self::Pin(at) => Self::Pin(turned(at, by)),
            Self::Slot(ends) => Self::Slot(ends.map(|at| turned(at, by))),
            Self::Block(at, angle) => Self::Block(turned(at, by), angle + by),
            other => other,
        }
    }

    /// Whether copies at other positions are useful; wheels and outlines look the same in every position.
    pub(super) const fn leaves_ghosts(&self) -> bool {
        matches!(self, Self::Bar(_) | Self::Plate(_) | Self::Block(..))
    }
}

/// A point turned about the origin by an angle (rad).
fn turned([x, y]: [f64; 2], by: f64) -> [f64; 2] {
    let (sin, cos) = math::sin_cos(by);
    [cos * x - sin * y, sin * x + cos * y]
}

/// Pose of every link: x, y (m) and angle (rad).
#[derive(Clone, Debug)]
pub(super) struct Pose {
    pub(super) links: Vec<[f64; 3]>,
}

impl Pose {
    /// A point of a link in global coordinates.
    pub(super) fn point(&self, link: usize, [u, v]: [f64; 2]) -> [f64; 2] {
        let [x, y, psi] = self.links.get(link).copied().unwrap_or_default();
        let (sin, cos) = math::sin_cos(psi);
        [x + cos * u - sin * v, y + sin * u + cos * v]
    }
}

/// Everything to draw.
#[derive(Clone, Debug)]
pub(super) struct Sketch {
    pub(super) links: Vec<Vec<BodyPart>>,
    pub(super) ground: Vec<BodyPart>,
    pub(super) points: Vec<NamedPoint>,
    /// The path of each named point.
    pub(super) paths: Vec<Vec<[f64; 2]>>,
    pub(super) poses: Vec<Pose>,
    /// Whether coaxial shafts were drawn apart.
    pub(super) schematic: bool,
    /// Offset of each link in the drawing from its position in the mechanism (m).
    apart: Vec<[f64; 2]>,
    /// Angle (rad) by which the mechanism is turned so that its weight points down the page.
    pub(super) turn: f64,
}

impl Sketch {
    pub(super) fn new(machine: &Machine<AnyMechanism>) -> Result<Self, Error> {
        let mechanism = machine.mechanism();
        let [x, y] = machine.gravity();
        let links = mechanism.links().len();
        let mut sketch = Self {
            links: vec![Vec::new(); links],
            ground: Vec::new(),
            points: mechanism.points().to_vec(),
            paths: Vec::new(),
            poses: Vec::new(),
            schematic: false,
            apart: vec![[0.0; 2]; links],
            // Without gravity it lies flat.
            turn: match [x, y] {
                [0.0, 0.0] => 0.0,
                _ => -FRAC_PI_2 - math::atan2(y, x),
            },
        };
        let places: Vec<f64> = whole_range(mechanism.domain(), POSES).collect();
        let frames = places
            .iter()
            .map(|&phi| mechanism.frames(phi))
            .collect::<Result<Vec<Frames>, PoseError>>()?;
        let joints = places
            .iter()
            .zip(&frames)
            .map(|(&phi, frames)| mechanism.joints(phi, frames))
            .collect::<Result<Vec<_>, PoseError>>()?;
        let first = &joints[0];
        if is_at_one_point(first, &frames[0], mechanism) {
            sketch.turn = 0.0;
            sketch.row_of_wheels(first);
        } else {
            let real = |body: Body| body.link().is_none_or(|link| link < mechanism.own_links());
            for k in (0..first.len()).filter(|&k| markers(&first[k]).iter().all(|m| real(m.body))) {
                let over_range: Vec<(&Joint, &Frames)> =
                    joints.iter().map(|j| &j[k]).zip(&frames).collect();
                sketch.joint(&first[k], &over_range);
            }
            let size = extent(&joints, &frames, &sketch.points);
            sketch.bodies(mechanism, size);
        }
        sketch.poses = frames.iter().map(|frames| sketch.placed(frames)).collect();
        for point in std::mem::take(&mut sketch.points) {
            let path = sketch.poses.iter().map(|p| p.point(point.link, point.at));
            let path: Vec<[f64; 2]> = path.collect();
            // Two links may name the pin between them; one name is enough.
            if !sketch.paths.iter().any(|drawn| coincide(drawn, &path)) {
                sketch.paths.push(path);
                sketch.points.push(point);
            }
        }
        Ok(sketch)
    }

    /// The pose at a position of the drive link.
    pub(super) fn pose(&self, mechanism: &AnyMechanism, phi: f64) -> Result<Pose, Error> {
        Ok(self.placed(&mechanism.frames(phi)?))
    }

    fn placed(&self, frames: &Frames) -> Pose {
        let links = frames.iter().zip(&self.apart);
        let links = links.map(|(f, [x, y])| {
            let [x, y] = turned([f.x.value + x, f.y.value + y], self.turn);
            [x, y, f.psi.value + self.turn]
        });
        Pose {
            links: links.collect(),
        }
    }

    fn add(&mut self, body: Body, part: BodyPart) {
        match body {
            Body::Ground => self.ground.push(part.turned(self.turn)),
            Body::Link(k) => {
                if let Some(parts) = self.links.get_mut(k) {
                    parts.push(part);
                }
            }
        }
    }

    /// Pins, blocks and slots of one joint.
    fn joint(&mut self, joint: &Joint, over_range: &[(&Joint, &Frames)]) {
        let way = |(joint, frames): &(&Joint, &Frames)| joint.coordinate(frames).value;
        match joint {
            Joint::Revolute([a, b]) => {
                // One circle is enough: that of the fixed body with its bearing, otherwise that of the later link.
                if a.body == Body::Ground || b.body == Body::Ground {
                    let (fixed, moving) = if a.body == Body::Ground {
                        (a, b)
                    } else {
                        (b, a)
                    };
                    self.add(Body::Ground, BodyPart::Pin(fixed.at));
                    self.add(moving.body, BodyPart::Pin(moving.at));
                } else {
                    self.add(a.body, BodyPart::Pin(a.at));
                    self.add(b.body, BodyPart::Pin(b.at));
                }
            }
            Joint::Prismatic([guide, block]) => {
                self.slot(guide, over_range.iter().map(way));
                self.add(block.body, BodyPart::Block(block.at, block.angle()));
            }
            Joint::PinInSlot([pin, slot]) => {
                self.slot(slot, over_range.iter().map(way));
                self.add(pin.body, BodyPart::Pin(pin.at));
            }
            Joint::Fixed(_) | Joint::Transmission(_) => {}
        }
    }

    /// A slot that covers the travel of its pin or block.
    fn slot(&mut self, marker: &Marker, ways: impl Iterator<Item = f64>) {
        let (low, high) = ways.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), way| {
            (low.min(way), high.max(way))
        });
        let (sin, cos) = math::sin_cos(marker.angle());
        let end = |way: f64| [marker.at[0] + way * cos, marker.at[1] + way * sin];
        self.add(marker.body, BodyPart::Slot([end(low), end(high)]));
    }

    /// Bars and plates through the points of each link; `size` (m) is that of the mechanism.
    fn bodies(&mut self, mechanism: &AnyMechanism, size: f64) {
        // Virtual links with a varying inertia have no shape.
        let own = mechanism.own_links();
        for (k, parts) in self.links.iter_mut().enumerate().take(own) {
            let outlines: Vec<BodyPart> = mechanism
                .outlines(k)
                .map(|outline| BodyPart::Outline(outline.to_vec()))
                .collect();
            if !outlines.is_empty() {
                parts.splice(0..0, outlines);
                continue;
            }
            let mut nodes: Vec<[f64; 2]> = Vec::new();
            let mut slides = false;
            for part in parts.iter() {
                match part {
                    BodyPart::Pin(at) => nodes.push(*at),
                    BodyPart::Block(at, _) => {
                        slides = true;
                        nodes.push(*at);
                    }
                    BodyPart::Slot(ends) => {
                        slides = true;
                        nodes.extend(ends);
                    }
                    _ => {}
                }
            }
            let named = mechanism.points().iter().filter(|point| point.link == k);
            nodes.extend(named.map(|point| point.at));
            let hull = hull(nodes, 1e-6 * size);
            let body = match hull.as_slice() {
                [] => None,
                [only] => (!slides).then_some(BodyPart::Wheel(*only, 0.1 * size)),
                [a, b] => Some(BodyPart::Bar([*a, *b])),
                _ => Some(BodyPart::Plate(hull)),
            };
            if let Some(body) = body {
                parts.insert(0, body);
            }
        }
    }

    /// Shafts side by side, for a train that has ratios and no geometry. The radii of a stage's wheels follow from its ratio; the row is one metre
    /// long per stage.
    fn row_of_wheels(&mut self, joints: &[Joint]) {
        self.schematic = true;
        let mut place = 0.0;
        let mut radii: Vec<Vec<f64>> = vec![Vec::new(); self.links.len()];
        for joint in joints {
            let Joint::Transmission([driver, driven]) = joint else {
                continue;
            };
            let (Some(a), Some(b)) = (driver.body.link(), driven.body.link()) else {
                continue;
            };
            let ratio = driven.moment / -driver.moment;
            if !ratio.is_finite() {
                continue;
            }
            let share = (ratio.abs() / (1.0 + ratio.abs())).clamp(0.04, 0.96);
            // Counter-rotating wheels mesh; others are apart, as in a belt drive.
            place += if ratio < 0.0 { 1.0 } else { 1.35 };
            self.apart[b] = [place, 0.0];
            radii[a].push(1.0 - share);
            radii[b].push(share);
        }
        for (k, radii) in radii.into_iter().enumerate() {
            let radii = if radii.is_empty() { vec![0.5] } else { radii };
            self.links[k] = radii
                .into_iter()
                .map(|r| BodyPart::Wheel([0.0; 2], r))
                .collect();
            self.links[k].push(BodyPart::Pin([0.0; 2]));
            self.ground.push(BodyPart::Pin(self.apart[k]));
        }
    }
}

/// Whether all joints of a mechanism are revolute at one point, and it has no outlines.
fn is_at_one_point(joints: &[Joint], frames: &Frames, mechanism: &AnyMechanism) -> bool {
    let outlined = (0..frames.len()).any(|k| mechanism.outlines(k).next().is_some());
    let slides = joints
        .iter()
        .any(|joint| matches!(joint, Joint::Prismatic(_)));
    let markers = joints.iter().flat_map(markers);
    let mut places = markers.map(|m| m.position(frames).map(|c| c.value));
    let first = places.next().unwrap_or_default();
    !outlined
        && !slides
        && mechanism.points().is_empty()
        && places.all(|[x, y]| math::hypot(x - first[0], y - first[1]) <= 0.0)
}

fn markers(joint: &Joint) -> Vec<Marker> {
    match joint {
        Joint::Revolute(m) | Joint::Prismatic(m) | Joint::Fixed(m) | Joint::PinInSlot(m) => {
            m.to_vec()
        }
        Joint::Transmission(_) => Vec::new(),
    }
}

/// Diagonal of all joints and named points over the range (m).
fn extent(joints: &[Joints], frames: &[Frames], points: &[NamedPoint]) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (joints, frames) in joints.iter().zip(frames) {
        let named = points.iter().map(|point| Marker::on(point.link, point.at));
        for marker in joints.iter().flat_map(markers).chain(named) {
            let at = marker.position(frames).map(|c| c.value);
            for k in 0..2 {
                low[k] = low[k].min(at[k]);
                high[k] = high[k].max(at[k]);
            }
        }
    }
    math::hypot(high[0] - low[0], high[1] - low[1])
}

/// The convex hull, counter-clockwise, without points nearer than `near` (m) to a line between others (Andrew's monotone
/// chain).
fn hull(mut points: Vec<[f64; 2]>, near: f64) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup_by(|a, b| math::hypot(a[0] - b[0], a[1] - b[1]) <= near);
    if points.len() < 3 {
        return points;
    }
    let off = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        let (x, y) = (c[0] - a[0], c[1] - a[1]);
        let length = math::hypot(x, y).max(near);
        (x * (b[1] - a[1]) - y * (b[0] - a[0])) / length
    };
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            // Keep left turns only: drop a point on the right of the line.
            while let [.., a, b] = chain[..] {
                if off(a, b, point) < -near {
                    break;
                }
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut points.iter().copied());
    hull.extend(chain(&mut points.iter().rev().copied()));
    hull
}

/// Whether two points coincide at all positions, to a micrometre.
fn coincide(a: &[[f64; 2]], b: &[[f64; 2]]) -> bool {
    let together = |(a, b): (&[f64; 2], &[f64; 2])| math::hypot(a[0] - b[0], a[1] - b[1]) < 1e-6;
    a.iter().zip(b).all(together)
}
