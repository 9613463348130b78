//! The path cut into cells, with the machine and the speed limit at three places of each.

use jred_file::math;
use std::f64::consts::{FRAC_PI_2, PI};

use jred::error::Error;

use super::field::Field;
use super::joint_force::{JointForce, Spot};
use crate::memo::Memo;
use crate::path_dynamics::Place;

/// Factor of z from one trial to the next where nothing limits the speed, and the most trials.
const RISE: f64 = 16.0;
const RISES: i32 = 40;

/// Speeds at which limits are tested for an allowed acceleration.
const TRIED_SPEEDS: u32 = 24;

/// Share of a cell, or of a piece, by which a place at a corner is moved inside: a quantity that jumps there then has the value of its own side.
pub(super) const CORNER_INSET: f64 = 1e-9;

/// Largest relative change of the tool's speed limit within that distance, unless it jumps there.
const CONTINUITY: f64 = 1e-6;

/// Places closer than this share of the largest position are the same within rounding.
const PLACE_TOLERANCE: f64 = 16.0 * f64::EPSILON;

/// A cell of the path. Between its three places every quantity is the parabola through them.
#[derive(Clone, Debug)]
pub struct PathCell {
    /// Distance of its start from the start of the path (rad, or m).
    pub x: f64,
    /// Its length.
    pub length: f64,
    /// The machine at its start, middle and end.
    pub places: [Place; 3],
    /// The largest z = ½·v² at the same places; infinite: no limit.
    pub caps: [f64; 3],
    /// The limited joint forces at the same places.
    pub forces: Vec<[JointForce; 3]>,
    /// Whether it continues the cell before: no corner lies between them.
    pub goes_on: bool,
}

impl PathCell {
    /// The machine at a share of the cell, 0 to 1.
    pub fn spot(&self, u: f64) -> Spot<'_> {
        let [a, b, c] = &self.places;
        let at = |place, weights| Spot::new(place, &self.forces, weights);
        if (u - 0.5).abs() < f64::EPSILON {
            return at(*b, [0.0, 1.0, 0.0]);
        }
        if u <= 0.0 {
            return at(*a, [1.0, 0.0, 0.0]);
        }
        if u >= 1.0 {
            return at(*c, [0.0, 0.0, 1.0]);
        }
        let w = weights(u);
        let mix = |of: fn(&Place) -> f64| w[0] * of(a) + w[1] * of(b) + w[2] * of(c);
        let place = Place {
            phi: mix(|p| p.phi),
            inertia: mix(|p| p.inertia),
            inertia_slope: mix(|p| p.inertia_slope),
            load: mix(|p| p.load),
            viscous: mix(|p| p.viscous),
            coulomb: mix(|p| p.coulomb),
        };
        at(place, w)
    }

    /// The largest z at a share of the cell.
    ///
    /// Its reciprocal is interpolated by a parabola: towards a place where the tool is at rest the limit grows without bound, and its reciprocal
    /// falls to zero as a parabola.
    pub fn cap(&self, u: f64) -> f64 {
        if self.is_level() {
            return self.caps[0];
        }
        let [a, b, c] = self.caps.map(f64::recip);
        let w = weights(u);
        let least = a.min(b).min(c);
        (w[0] * a + w[1] * b + w[2] * c).max(least).recip()
    }

    /// Slope of the largest z by the position.
    pub fn cap_slope(&self, u: f64) -> f64 {
        let cap = self.cap(u);
        if self.is_level() || !cap.is_finite() {
            return 0.0;
        }
        let [a, b, c] = self.caps.map(f64::recip);
        let slope = (4.0 * u - 3.0) * a + (4.0 - 8.0 * u) * b + (4.0 * u - 1.0) * c;
        -slope * cap * cap / self.length
    }

    fn is_level(&self) -> bool {
        let [a, b, c] = self.caps;
        a.total_cmp(&b).is_eq() && b.total_cmp(&c).is_eq()
    }
}

fn weights(u: f64) -> [f64; 3] {
    [
        (1.0 - u) * (1.0 - 2.0 * u),
        4.0 * u * (1.0 - u),
        u * (2.0 * u - 1.0),
    ]
}

/// The cells of a path.
#[derive(Clone, Debug)]
pub struct Track {
    /// The cells, in order.
    pub cells: Vec<PathCell>,
}

/// The ends of a path.
#[derive(Clone, Debug)]
pub struct Ends {
    /// Position of the start (rad, or m).
    pub from: f64,
    /// Length of the path.
    pub length: f64,
    /// Speeds at the start and at the end, along the path.
    pub speeds: [f64; 2],
    /// Distances from the start, inside the path, at which the machine is not smooth.
    pub corners: Vec<f64>,
}

impl Ends {
    /// Distance below which two places are one.
    fn near(&self) -> f64 {
        PLACE_TOLERANCE * (self.from.abs() + self.length)
    }

    /// Distance from the border of a cell of this length at which the machine has the values of the cell's own side.
    pub fn inside(&self, length: f64) -> f64 {
        (CORNER_INSET * length).max(self.near()).min(0.25 * length)
    }
}

/// The machine at a place, independent of the speed.
#[derive(Clone, Debug)]
pub struct PathPoint {
    /// The machine.
    pub place: Place,
    /// The largest speed of the drive link that the tool's limit allows.
    pub tool: f64,
    /// The limited joint forces.
    pub forces: Vec<JointForce>,
}

impl PathPoint {
    /// At a position.
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn new(field: &Field, phi: f64) -> Result<Self, Error> {
        Ok(Self {
            place: field.dynamics.place(phi)?,
            tool: field.tool_speed(phi)?,
            forces: field.forces(phi)?,
        })
    }
}

/// The machine along a path: evaluated once for each place, for all cells that meet there and for all motions.
#[derive(Debug)]
pub struct Survey<'f, 'w, 'a> {
    /// Machine, drive and limits.
    pub field: &'f Field<'w, 'a>,
    /// Position of the start (rad, or m).
    from: f64,
    /// By the distance from the start.
    seen: Memo<u64, PathPoint>,
    /// The largest z, by the place and the border of its cell.
    caps: Memo<[u64; 2], f64>,
}

impl<'f, 'w, 'a> Survey<'f, 'w, 'a> {
    /// A survey of a path from a position on.
    pub fn new(field: &'f Field<'w, 'a>, from: f64) -> Self {
        Self {
            field,
            from,
            seen: Memo::default(),
            caps: Memo::default(),
        }
    }

    /// The machine at a distance from the start.
    ///
    /// # Errors
    /// The mechanism cannot be placed there.
    pub fn seen(&self, x: f64) -> Result<PathPoint, Error> {
        let position = self.from + self.field.dynamics.direction * x;
        self.seen
            .of(x.to_bits(), || PathPoint::new(self.field, position))
    }

    /// The same with the largest z; the place lies inside a cell with this border.
    fn at(&self, x: f64, border: f64) -> Result<(Place, f64, Vec<JointForce>), Error> {
        let PathPoint {
            place,
            mut tool,
            forces,
        } = self.seen(x)?;
        let cap = self.caps.of([x, border].map(f64::to_bits), || {
            if (x - border).abs() > 0.0 {
                // A limit that continues beyond the border has no jump there.
                let there = self.seen(border)?.tool;
                if tool.is_finite() && (there - tool).abs() <= CONTINUITY * tool {
                    tool = there;
                }
            }
            let top = 0.5 * self.field.top().0.powi(2);
            let alone: Vec<_> = forces.iter().map(|force| [*force; 3]).collect();
            let spot = Spot::new(place, &alone, [1.0, 0.0, 0.0]);
            Ok::<_, Error>(ceiling(self.field, &spot, top).min(0.5 * tool.powi(2)))
        })?;
        Ok((place, cap, forces))
    }
}

impl Track {
    /// About `count` cells, finer towards an end at rest, with additional borders at the distances `finer`; no cell crosses a corner of the machine.
    ///
    /// # Errors
    /// The mechanism cannot be placed somewhere on the path.
    pub fn new(survey: &Survey, ends: &Ends, count: usize, finer: &[f64]) -> Result<Self, Error> {
        let (nodes, is_edge) = nodes(ends, count, finer);
        let at = |x: f64, border: f64| survey.at(x, border);
        let mut end_before = None;
        let mut cells: Vec<PathCell> = Vec::with_capacity(nodes.len());
        for (k, pair) in nodes.windows(2).enumerate() {
            let &[x, end] = pair else { continue };
            let length = end - x;
            let inside = ends.inside(length);
            let goes_on = !is_edge[k];
            let first = match end_before.take().filter(|_| goes_on) {
                Some(before) => before,
                None if goes_on => at(x, x)?,
                None => at(x + inside, x)?,
            };
            let half = x + 0.5 * length;
            let middle = at(half, half)?;
            let last = at(if is_edge[k + 1] { end - inside } else { end }, end)?;
            let joints = first.2.iter().zip(&middle.2).zip(&last.2);
            cells.push(PathCell {
                x,
                length,
                places: [first.0, middle.0, last.0],
                caps: [first.1, middle.1, last.1],
                forces: joints.map(|((a, b), c)| [*a, *b, *c]).collect(),
                goes_on,
            });
            end_before = Some(last);
        }
        Ok(Self { cells })
    }
}

/// Distances from the start at which cells meet, and whether each is a corner of the machine.
fn nodes(ends: &Ends, count: usize, finer: &[f64]) -> (Vec<f64>, Vec<bool>) {
    let rest = ends.speeds.map(|speed| speed == 0.0);
    let share = |s: f64| match rest {
        [true, true] => 0.5 * (1.0 - math::cos(PI * s)),
        [true, false] => 1.0 - math::cos(FRAC_PI_2 * s),
        [false, true] => math::sin(FRAC_PI_2 * s),
        [false, false] => s,
    };
    let count = count.max(2);
    let inner = (1..count).map(|k| (ends.length * share(k as f64 / count as f64), false));
    let mut all: Vec<(f64, bool)> = inner.collect();
    all.extend(finer.iter().map(|x| (*x, false)));
    all.extend(ends.corners.iter().map(|x| (*x, true)));
    all.push((0.0, true));
    all.push((ends.length, true));
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let near = ends.near();
    all.dedup_by(|b, a| {
        let same = b.0 - a.0 <= near;
        if same && b.1 && !a.1 {
            *a = *b;
        }
        same
    });
    if let Some(last) = all.last_mut() {
        *last = (ends.length, true);
    }
    all.into_iter().unzip()
}

/// The end of the first range of z, up to `top`, in which limits leave an acceleration.
fn ceiling(field: &Field, place: &Spot, top: f64) -> f64 {
    if !field.may_be_empty() {
        return top;
    }
    let open = |z: f64| field.is_open(place, z);
    let highest = if top.is_finite() {
        top
    } else {
        // Without a speed limit: from slow motions upwards until no acceleration is left.
        let slow = (1..=RISES).map(|k| place.inertia.recip() * RISE.powi(k));
        let Some(closed) = slow.take_while(|z| z.is_finite()).find(|z| !open(*z)) else {
            return top;
        };
        closed
    };
    let z = |k: u32| highest * (f64::from(k) / f64::from(TRIED_SPEEDS)).powi(2);
    let Some(first) = (0..=TRIED_SPEEDS).find(|k| open(z(*k))) else {
        return 0.0;
    };
    let Some(closed) = (first..=TRIED_SPEEDS).find(|k| !open(z(*k))) else {
        return top;
    };
    let (mut low, mut high) = (z(closed - 1), z(closed));
    while {
        let middle = low.midpoint(high);
        low < middle && middle < high
    } {
        let middle = low.midpoint(high);
        if open(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
