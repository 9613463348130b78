//! The equations of joints, and their Taylor coefficients order by order.

use std::f64::consts::TAU;

use jred::machine::{Body, Frames, Joint, Marker};
use jred::mechanism::linkage::Pair;

use crate::interval::Interval;
use crate::link_frame::LinkFrame;
use crate::series::Series;

/// An equation whose left-hand side is zero.
#[derive(Clone, Debug)]
pub(crate) enum Equation {
    /// A coordinate (0: x, 1: y) of two coincident points.
    Same([LinkPoint; 2], usize),
    /// A point on a line through another point, with a direction.
    OnLine {
        line: LinkPoint,
        along: [Interval; 2],
        point: LinkPoint,
    },
    /// Directions that agree up to a constant, or that turn with the drive.
    Angle {
        bodies: [Option<usize>; 2],
        constant: Interval,
        drive: bool,
    },
    /// Wheels that roll on each other or on a rack: turns times radii, and the displacement along the rack.
    Rolling {
        turns: Vec<(Option<usize>, Interval)>,
        rack: Option<(LinkPoint, [Interval; 2], LinkPoint)>,
        constant: Interval,
    },
    /// A displacement along a line, set by the drive.
    Displacement {
        line: LinkPoint,
        along: [Interval; 2],
        point: LinkPoint,
        constant: Interval,
    },
}

/// A point of a link, or of the ground.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkPoint {
    link: Option<usize>,
    at: [f64; 2],
}

impl LinkPoint {
    const fn of(marker: &Marker) -> Self {
        Self {
            link: marker.body.link(),
            at: marker.at,
        }
    }
}

/// Tolerance for the drive's constant in double precision, with rounding.
const COINCIDENCE: f64 = 1e-11;

/// The equations of a joint; `None` if they do not contain its geometry.
pub(crate) fn of_joint(joint: &Joint, frames: &Frames) -> Option<Vec<Equation>> {
    let same = |a: &Marker, b: &Marker| {
        [0, 1].map(|axis| Equation::Same([LinkPoint::of(a), LinkPoint::of(b)], axis))
    };
    Some(match joint {
        Joint::Revolute([a, b]) => same(a, b).to_vec(),
        Joint::Prismatic([a, b]) => vec![on_line(a, b), agree([a, b], frames)],
        Joint::Fixed([a, b]) => {
            let mut all = same(a, b).to_vec();
            all.push(agree([a, b], frames));
            all
        }
        Joint::PinInSlot([pin, slot]) => vec![on_line(slot, pin)],
        Joint::Transmission(_) => return None,
    })
}

/// The equations of a pair; `None` for a cam.
pub(crate) fn of_pair(pair: &Pair, frames: &Frames) -> Option<Vec<Equation>> {
    let turn = |body: Body, radius: f64| (body.link(), Interval::of(radius));
    Some(match pair {
        Pair::Joint(joint) => return of_joint(joint, frames),
        Pair::Gears {
            centres: [a, b],
            carrier,
            radii: [r_a, r_b],
            phase,
        } => {
            let together = -(Interval::of(*r_a) + Interval::of(*r_b));
            vec![Equation::Rolling {
                turns: vec![
                    turn(a.body, *r_a),
                    turn(b.body, *r_b),
                    (carrier.link(), together),
                ],
                rack: None,
                constant: Interval::of(-phase),
            }]
        }
        Pair::Belt {
            centres: [a, b],
            radii: [r_a, r_b],
            phase,
        } => vec![Equation::Rolling {
            turns: vec![turn(a.body, *r_a), turn(b.body, -r_b)],
            rack: None,
            constant: Interval::of(-phase),
        }],
        Pair::Rack {
            pinion,
            rack,
            radius,
            phase,
        } => vec![Equation::Rolling {
            turns: vec![turn(pinion.body, *radius), turn(rack.body, -radius)],
            rack: Some((LinkPoint::of(rack), along(rack), LinkPoint::of(pinion))),
            constant: Interval::of(-phase),
        }],
        Pair::Cam { .. } => return None,
    })
}

/// The direction of a marker in its body.
fn along(marker: &Marker) -> [Interval; 2] {
    let (sin, cos) = Interval::of(marker.angle()).sin_cos();
    [cos, sin]
}

fn on_line(line: &Marker, point: &Marker) -> Equation {
    Equation::OnLine {
        along: along(line),
        line: LinkPoint::of(line),
        point: LinkPoint::of(point),
    }
}

const fn links([a, b]: [&Marker; 2]) -> [Option<usize>; 2] {
    [a.body.link(), b.body.link()]
}

/// The constant difference of the frames of two markers with equal directions, up to whole turns.
fn agree([a, b]: [&Marker; 2], frames: &Frames) -> Equation {
    let apart = (b.direction(frames) - a.direction(frames)).value;
    let turns = Interval::turn() * (apart / TAU).round();
    Equation::Angle {
        bodies: links([a, b]),
        constant: Interval::of(b.angle()) - Interval::of(a.angle()) - turns,
        drive: false,
    }
}

/// The coordinate of the drive is φ plus a constant, which is known from one position, with rounding.
pub(crate) fn of_drive(joint: &Joint, frames: &Frames, phi: f64) -> Option<Equation> {
    let offset = joint.coordinate(frames).value - phi;
    // Most are zero, and rounding is removed from them.
    let offset = if offset.abs() < COINCIDENCE {
        Interval::ZERO
    } else {
        Interval::around(offset, COINCIDENCE)
    };
    match joint {
        Joint::Revolute([a, b]) => Some(Equation::Angle {
            bodies: links([a, b]),
            constant: Interval::of(b.angle()) - Interval::of(a.angle()) - offset,
            drive: true,
        }),
        Joint::Prismatic([a, b]) => Some(Equation::Displacement {
            along: along(a),
            line: LinkPoint::of(a),
            point: LinkPoint::of(b),
            constant: -offset,
        }),
        _ => None,
    }
}

impl Equation {
    /// Whether it depends on the position of a link.
    pub(crate) fn is_of(&self, link: usize) -> bool {
        let link = Some(link);
        match self {
            Self::Same([a, b], _) => a.link == link || b.link == link,
            Self::OnLine { line, point, .. } | Self::Displacement { line, point, .. } => {
                line.link == link || point.link == link
            }
            Self::Angle { bodies, .. } => bodies.contains(&link),
            Self::Rolling { turns, rack, .. } => {
                let moved = |(line, _, point): &(LinkPoint, _, LinkPoint)| {
                    line.link == link || point.link == link
                };
                turns.iter().any(|(wheel, _)| *wheel == link) || rack.as_ref().is_some_and(moved)
            }
        }
    }

    /// Factor of the drive's position.
    pub(crate) const fn by_drive(&self) -> Interval {
        match self {
            Self::Angle { drive: true, .. } | Self::Displacement { .. } => Interval::of(-1.0),
            _ => Interval::ZERO,
        }
    }

    /// The coefficient of this order, without the contribution of the drive's position.
    pub(crate) fn term(&self, places: &[LinkFrame<Series>], order: usize) -> Interval {
        let at = |link: Option<usize>| link.and_then(|link| places.get(link));
        let constant = |value: Interval| if order == 0 { value } else { Interval::ZERO };
        match self {
            Self::Same([a, b], axis) => {
                coordinate(at(a.link), a.at, *axis, order)
                    - coordinate(at(b.link), b.at, *axis, order)
            }
            Self::Angle {
                bodies: [a, b],
                constant: c,
                ..
            } => {
                let psi = |link: Option<usize>| at(link).map_or(Interval::ZERO, |p| p.psi.0[order]);
                psi(*b) - psi(*a) + constant(*c)
            }
            Self::Rolling {
                turns,
                rack,
                constant: c,
            } => {
                let turn = |(link, radius): &(Option<usize>, Interval)| {
                    at(*link).map_or(Interval::ZERO, |place| place.psi.0[order] * *radius)
                };
                let sum = turns
                    .iter()
                    .fold(constant(*c), |sum, wheel| sum + turn(wheel));
                let Some((line, along, point)) = rack else {
                    return sum;
                };
                let along = |k: usize| vector(at(line.link), *along, k);
                sum + product(along, [line, point], &at, order)
            }
            Self::OnLine {
                line,
                along: [cos, sin],
                point,
            } => {
                let across = |k: usize| vector(at(line.link), [-*sin, *cos], k);
                product(across, [line, point], &at, order)
            }
            Self::Displacement {
                line,
                along,
                point,
                constant: c,
            } => {
                let along = |k: usize| vector(at(line.link), *along, k);
                product(along, [line, point], &at, order) + constant(*c)
            }
        }
    }
}

/// The coefficient of a coordinate of a point.
fn coordinate(
    place: Option<&LinkFrame<Series>>,
    [u, v]: [f64; 2],
    axis: usize,
    order: usize,
) -> Interval {
    let Some(place) = place else {
        let fixed = if axis == 0 { u } else { v };
        return Interval::of(if order == 0 { fixed } else { 0.0 });
    };
    let (sin, cos) = (place.sin.0[order], place.cos.0[order]);
    match axis {
        0 => place.x.0[order] + (cos * u - sin * v),
        _ => place.y.0[order] + (sin * u + cos * v),
    }
}

/// The coefficients of a vector of a body.
fn vector(place: Option<&LinkFrame<Series>>, [u, v]: [Interval; 2], order: usize) -> [Interval; 2] {
    let Some(place) = place else {
        return if order == 0 {
            [u, v]
        } else {
            [Interval::ZERO; 2]
        };
    };
    let (sin, cos) = (place.sin.0[order], place.cos.0[order]);
    [cos * u - sin * v, sin * u + cos * v]
}

/// The coefficient of the scalar product of a vector and the vector from one point to another.
fn product<'p>(
    vector: impl Fn(usize) -> [Interval; 2],
    [line, point]: [&LinkPoint; 2],
    at: &impl Fn(Option<usize>) -> Option<&'p LinkFrame<Series>>,
    order: usize,
) -> Interval {
    let mut sum = Interval::ZERO;
    for k in 0..=order {
        let across = vector(k);
        for (axis, component) in across.into_iter().enumerate() {
            let way = coordinate(at(point.link), point.at, axis, order - k)
                - coordinate(at(line.link), line.at, axis, order - k);
            sum = sum + component * way;
        }
    }
    sum
}
