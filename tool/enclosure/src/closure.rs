//! The closure of the joints: where all links are, proven by the interval form of Newton's method.
//!
//! The coordinates q = (x, y, ψ of every link) satisfy the equations of the joints and of the drive, f(q, φ) = 0. For the middle of a
//! stretch and for all of it, Krawczyk's operator
//!
//! ```text
//! K = m − Y·f(m, φ) + (1 − Y·A)·([q] − m),    A = ∂f/∂q over [q],  Y ≈ A⁻¹ in the middle
//! ```
//!
//! maps a box [q] around the pose in double precision into its inside: so there is one pose in it for each φ, and no other. Then
//! the Taylor coefficients follow order by order from the same equations, A·qₖ = −(what lower orders make of order k).

use std::f64::consts::TAU;

use jred::machine::{Body, Frames, Joint, Jointed, Marker};
use jred::mechanism::linkage::Pair;

use crate::fault::Unproven;
use crate::form::Form;
use crate::interval::Interval;
use crate::matrix::{Matrix, Solver};
use crate::place::Place;
use crate::series::{Series, TERMS, sin_cos_term};

/// One of the equations, which is zero.
#[derive(Clone, Debug)]
enum Equation {
    /// A coordinate (0: x, 1: y) of two points that coincide.
    Same([Point; 2], usize),
    /// A point and a line through another with a direction.
    OnLine {
        line: Point,
        along: [Interval; 2],
        point: Point,
    },
    /// Directions that agree up to a constant, or that turn with the drive.
    Angle {
        bodies: [Option<usize>; 2],
        constant: Interval,
        drive: bool,
    },
    /// Wheels that roll on each other or on a rack: turns times radii, and the way along the rack.
    Rolling {
        turns: Vec<(Option<usize>, Interval)>,
        rack: Option<(Point, [Interval; 2], Point)>,
        constant: Interval,
    },
    /// A displacement along a line that the drive sets.
    Displacement {
        line: Point,
        along: [Interval; 2],
        point: Point,
        constant: Interval,
    },
}

/// A point of a link, or of the ground.
#[derive(Clone, Copy, Debug)]
struct Point {
    link: Option<usize>,
    at: [f64; 2],
}

impl Point {
    const fn of(marker: &Marker) -> Self {
        Self {
            link: marker.body.link(),
            at: marker.at,
        }
    }
}

/// The joints of a mechanism as equations.
#[derive(Clone)]
pub struct Closure<'m> {
    mechanism: &'m dyn Jointed,
    /// Number of links that the equations place.
    links: usize,
    equations: Vec<Equation>,
}

/// A tolerance of what must be the same everywhere in double precision: the constant of the drive, rounded.
const SAME: f64 = 1e-11;

impl<'m> Closure<'m> {
    /// Of the first so many links and joints of a mechanism; `phi` is a position at which it can be placed.
    ///
    /// # Errors
    /// A joint whose geometry it does not know, or too few of them.
    pub fn new(
        mechanism: &'m dyn Jointed,
        links: usize,
        joints: usize,
        phi: f64,
    ) -> Result<Self, Unproven> {
        let frames = mechanism.frames(phi).map_err(|_| Unproven::Pose { phi })?;
        let all = mechanism
            .joints(phi, &frames)
            .map_err(|_| Unproven::Pose { phi })?;
        let mut equations = Vec::new();
        for (number, joint) in all.iter().take(joints).enumerate() {
            equations.extend(of_joint(joint, &frames).ok_or(Unproven::Joint { number })?);
        }
        let drive = all.get(mechanism.drive());
        let drive = drive.and_then(|joint| of_drive(joint, &frames, phi));
        Self::closed(mechanism, links, equations, drive)
    }

    /// Of a linkage with these pairs, gears and racks among them.
    ///
    /// # Errors
    /// A pair whose geometry it does not know, or too few of them.
    pub fn of_pairs(
        mechanism: &'m dyn Jointed,
        links: usize,
        pairs: &[Pair],
        phi: f64,
    ) -> Result<Self, Unproven> {
        let frames = mechanism.frames(phi).map_err(|_| Unproven::Pose { phi })?;
        let mut equations = Vec::new();
        for (number, pair) in pairs.iter().enumerate() {
            equations.extend(of_pair(pair, &frames).ok_or(Unproven::Joint { number })?);
        }
        let drive = match pairs.get(mechanism.drive()) {
            Some(Pair::Joint(joint)) => of_drive(joint, &frames, phi),
            _ => None,
        };
        Self::closed(mechanism, links, equations, drive)
    }

    /// With the equation of the drive, if they leave one freedom.
    fn closed(
        mechanism: &'m dyn Jointed,
        links: usize,
        mut equations: Vec<Equation>,
        drive: Option<Equation>,
    ) -> Result<Self, Unproven> {
        equations.push(drive.ok_or(Unproven::Drive)?);
        if equations.len() != 3 * links {
            return Err(Unproven::Freedoms {
                equations: equations.len(),
                coordinates: 3 * links,
            });
        }
        Ok(Self {
            mechanism,
            links,
            equations,
        })
    }

    /// Where the links are from one position of the drive link to another.
    ///
    /// # Errors
    /// A stretch on which no pose, or more than one, could be proven: a shorter one may do.
    pub fn places(&self, stretch: [f64; 2]) -> Result<Vec<Place<Form>>, Unproven> {
        let [from, to] = stretch;
        let middle = from.midpoint(to);
        let frames = self.mechanism.frames(middle);
        let frames = frames.map_err(|_| Unproven::Pose { phi: middle })?;
        let solve = |phi: Interval| {
            self.series(&frames, phi)
                .ok_or(Unproven::Pose { phi: middle })
        };
        let at = solve(Interval::of(middle))?;
        let over = solve(Interval::between(from, to))?;
        let places = at.iter().zip(&over);
        Ok(places.map(|(at, over)| Place::joined(at, over)).collect())
    }

    /// The series of all links for every φ of an interval, around a pose in its middle.
    fn series(&self, frames: &Frames, phi: Interval) -> Option<Vec<Place<Series>>> {
        let half = 0.5 * phi.width();
        let (start, units) = self.start(frames);
        let (pose, solver) = self.pose(&start, &units, phi, half)?;
        let mut places: Vec<Place<Series>> = pose.chunks_exact(3).map(place).collect();
        for order in 1..TERMS {
            for place in &mut places {
                raise(place, order);
            }
            let sides = self.equations.iter().map(|equation| {
                let own = if order == 1 {
                    equation.by_drive()
                } else {
                    Interval::ZERO
                };
                -(equation.term(&places, order) + own)
            });
            let sides: Vec<Interval> = sides.collect();
            let terms = solver.solve(&sides, &units)?;
            for (place, terms) in places.iter_mut().zip(terms.chunks_exact(3)) {
                set(place, order, terms);
            }
        }
        Some(places)
    }

    /// The coordinates in double precision, and how fast each moves: a measure of its size. Where a coordinate turns back its
    /// first derivative says nothing.
    fn start(&self, frames: &Frames) -> (Vec<f64>, Vec<f64>) {
        let own = || frames.iter().take(self.links);
        let coordinates = || own().flat_map(|frame| [frame.x, frame.y, frame.psi]);
        let rates: Vec<f64> = coordinates().map(|q| q.d1.abs() + q.d2.abs()).collect();
        // Lengths, then angles.
        let most = [false, true].map(|angles| {
            let own = rates
                .iter()
                .enumerate()
                .filter(|(k, _)| (k % 3 == 2) == angles);
            let most = own.fold(0.0_f64, |most, (_, rate)| most.max(*rate));
            if most > 0.0 { most } else { 1.0 }
        });
        let unit = |(k, rate): (usize, &f64)| rate.max(0.1 * most[usize::from(k % 3 == 2)]);
        let units = rates.iter().enumerate().map(unit).collect();
        (coordinates().map(|q| q.value).collect(), units)
    }

    /// A box of coordinates with exactly one pose for each φ, and the systems of its equations.
    fn pose(
        &self,
        start: &[f64],
        units: &[f64],
        phi: Interval,
        half: f64,
    ) -> Option<(Vec<Interval>, Solver)> {
        const ATTEMPTS: usize = 6;
        let middle: Vec<Interval> = start.iter().map(|q| Interval::of(*q)).collect();
        let inverse = self.jacobian(&middle).inverse()?;
        let residual = self.residual(&middle, phi);
        let radius = |(q, unit): (&f64, &f64)| 1.5 * half * unit + 1e-12 * (1.0 + q.abs());
        let mut radii: Vec<f64> = start.iter().zip(units).map(radius).collect();
        for _ in 0..ATTEMPTS {
            let all = start.iter().zip(&radii);
            let all: Vec<Interval> = all.map(|(q, r)| Interval::around(*q, *r)).collect();
            let solver = Solver::new(inverse.clone(), &self.jacobian(&all));
            let newton = solver.approximate(&residual);
            let away = all.iter().zip(&middle).map(|(all, middle)| *all - *middle);
            let rest = solver.rest(&away.collect::<Vec<_>>());
            let image = middle.iter().zip(newton).zip(rest);
            let image: Vec<Interval> = image.map(|((m, n), r)| *m - n + r).collect();
            if image
                .iter()
                .zip(&all)
                .all(|(image, all)| image.is_inside(*all))
            {
                // The pose lies in the image: once more with that.
                let solver = Solver::new(inverse, &self.jacobian(&image));
                let away = image
                    .iter()
                    .zip(&middle)
                    .map(|(all, middle)| *all - *middle);
                let rest = solver.rest(&away.collect::<Vec<_>>());
                let newton = solver.approximate(&residual);
                let again = middle.iter().zip(newton).zip(rest).zip(&image);
                let again = again.map(|(((m, n), r), before)| (*m - n + r).and(*before));
                return Some((again.collect(), solver));
            }
            for ((radius, image), q) in radii.iter_mut().zip(&image).zip(start) {
                let needed = (*image - Interval::of(*q)).size();
                *radius = radius.max(1.2 * needed);
            }
            let bounded = |radius: &f64| *radius < 1e6;
            if !radii.iter().all(bounded) {
                return None;
            }
        }
        None
    }

    fn residual(&self, pose: &[Interval], phi: Interval) -> Vec<Interval> {
        let places: Vec<Place<Series>> = pose.chunks_exact(3).map(place).collect();
        let of = |equation: &Equation| equation.term(&places, 0) + equation.by_drive() * phi;
        self.equations.iter().map(of).collect()
    }

    /// ∂f/∂q: the terms of first order, with the first derivative of one coordinate at a time.
    fn jacobian(&self, pose: &[Interval]) -> Matrix<Interval> {
        let mut places: Vec<Place<Series>> = pose.chunks_exact(3).map(place).collect();
        let mut matrix = Matrix::new(3 * self.links, Interval::ZERO);
        for link in 0..self.links {
            for axis in 0..3 {
                let mut terms = [Interval::ZERO; 3];
                terms[axis] = Interval::ONE;
                set(&mut places[link], 1, &terms);
                for (row, equation) in self.equations.iter().enumerate() {
                    if equation.is_of(link) {
                        matrix.set(row, 3 * link + axis, equation.term(&places, 1));
                    }
                }
                for place in [&mut places[link]] {
                    for series in [
                        &mut place.x,
                        &mut place.y,
                        &mut place.psi,
                        &mut place.sin,
                        &mut place.cos,
                    ] {
                        series.0[1] = Interval::ZERO;
                    }
                }
            }
        }
        matrix
    }
}

/// A link at these coordinates.
fn place(coordinates: &[Interval]) -> Place<Series> {
    let (sin, cos) = coordinates[2].sin_cos();
    Place {
        x: Series::constant(coordinates[0]),
        y: Series::constant(coordinates[1]),
        psi: Series::constant(coordinates[2]),
        sin: Series::constant(sin),
        cos: Series::constant(cos),
    }
}

/// Prepares a link for coefficients of this order: of sine and cosine, the part that lower orders of ψ make.
fn raise(place: &mut Place<Series>, order: usize) {
    (place.sin.0[order], place.cos.0[order]) =
        sin_cos_term(&place.psi.0, &place.sin.0, &place.cos.0, order);
}

/// Sets the coefficients of this order, after [`raise`] to it.
fn set(place: &mut Place<Series>, order: usize, terms: &[Interval]) {
    (place.x.0[order], place.y.0[order]) = (terms[0], terms[1]);
    place.psi.0[order] = terms[2];
    place.sin.0[order] = place.sin.0[order] + place.cos.0[0] * terms[2];
    place.cos.0[order] = place.cos.0[order] - place.sin.0[0] * terms[2];
}

fn of_joint(joint: &Joint, frames: &Frames) -> Option<Vec<Equation>> {
    let same = |a: &Marker, b: &Marker| {
        [0, 1].map(|axis| Equation::Same([Point::of(a), Point::of(b)], axis))
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

fn of_pair(pair: &Pair, frames: &Frames) -> Option<Vec<Equation>> {
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
            rack: Some((Point::of(rack), along(rack), Point::of(pinion))),
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
        line: Point::of(line),
        point: Point::of(point),
    }
}

const fn links([a, b]: [&Marker; 2]) -> [Option<usize>; 2] {
    [a.body.link(), b.body.link()]
}

/// The constant difference of the frames of two markers whose directions agree, up to whole turns.
fn agree([a, b]: [&Marker; 2], frames: &Frames) -> Equation {
    let apart = (b.direction(frames) - a.direction(frames)).value;
    let turns = Interval::turn() * (apart / TAU).round();
    Equation::Angle {
        bodies: links([a, b]),
        constant: Interval::of(b.angle()) - Interval::of(a.angle()) - turns,
        drive: false,
    }
}

/// The coordinate of the drive is φ and a constant, which is known from one position, rounded.
fn of_drive(joint: &Joint, frames: &Frames, phi: f64) -> Option<Equation> {
    let offset = joint.coordinate(frames).value - phi;
    // Most are zero, and their roundings with them.
    let offset = if offset.abs() < SAME {
        Interval::ZERO
    } else {
        Interval::around(offset, SAME)
    };
    match joint {
        Joint::Revolute([a, b]) => Some(Equation::Angle {
            bodies: links([a, b]),
            constant: Interval::of(b.angle()) - Interval::of(a.angle()) - offset,
            drive: true,
        }),
        Joint::Prismatic([a, b]) => Some(Equation::Displacement {
            along: along(a),
            line: Point::of(a),
            point: Point::of(b),
            constant: -offset,
        }),
        _ => None,
    }
}

impl Equation {
    /// Whether it depends on where a link is.
    fn is_of(&self, link: usize) -> bool {
        let link = Some(link);
        match self {
            Self::Same([a, b], _) => a.link == link || b.link == link,
            Self::OnLine { line, point, .. } | Self::Displacement { line, point, .. } => {
                line.link == link || point.link == link
            }
            Self::Angle { bodies, .. } => bodies.contains(&link),
            Self::Rolling { turns, rack, .. } => {
                let moved =
                    |(line, _, point): &(Point, _, Point)| line.link == link || point.link == link;
                turns.iter().any(|(wheel, _)| *wheel == link) || rack.as_ref().is_some_and(moved)
            }
        }
    }

    /// What the drive's position is multiplied by.
    const fn by_drive(&self) -> Interval {
        match self {
            Self::Angle { drive: true, .. } | Self::Displacement { .. } => Interval::of(-1.0),
            _ => Interval::ZERO,
        }
    }

    /// The coefficient of this order, without what the drive's position adds.
    fn term(&self, places: &[Place<Series>], order: usize) -> Interval {
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
    place: Option<&Place<Series>>,
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
fn vector(place: Option<&Place<Series>>, [u, v]: [Interval; 2], order: usize) -> [Interval; 2] {
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

/// The coefficient of the scalar product of a vector and the way from one point to another.
fn product<'p>(
    vector: impl Fn(usize) -> [Interval; 2],
    [line, point]: [&Point; 2],
    at: &impl Fn(Option<usize>) -> Option<&'p Place<Series>>,
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
