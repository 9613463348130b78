//! Passing change points: positions where two branches of a linkage cross.
//!
//! On each branch the coordinates are smooth functions of φ there, but the Jacobian of a group is singular: its determinant passes zero and changes
//! sign. (At a dead point it only touches zero, and there is no position beyond.) So a change point is a place that the walk along φ cannot pass,
//! with solutions on both sides whose determinants have opposite signs. In a window around it the coordinates are Hermite polynomials of degree 7
//! through their values and three derivatives at both ends.
//!
//! The width of the window is a compromise. The error of the polynomial grows as h⁸ (h⁵ in the third derivative); the error of the positions at its
//! ends, which the solver finds by that Jacobian, falls as 1/h (1/h⁴). The width used is that with the best agreement of two polynomials.

use core::f64::consts::SQRT_2;

use crate::machine::Frames;
use crate::machine::error::PoseError;
use crate::machine::link::Frame;
use crate::math;
use crate::number::transfer::Transfer;

use super::Linkage;
use super::solver::Solution;
use super::walk::{Gait, Place, TRUSTED, predicted};

/// Half the first window, which finds the branch on the far side (rad, or relative to the linkage's size).
const FIRST: f64 = 2e-3;
/// Half the window that locates the change point.
const NARROW: f64 = 1e-4;
/// Half the narrowest and the widest window for interpolation.
const WIDTHS: [f64; 2] = [8e-3, 0.3];
/// Agreement of two windows' third derivatives (relative to the largest, at least 1) where branches cross; branches that only come close do not reach
/// it.
const AGREED: f64 = 1e-4;

/// A change point with its window.
#[derive(Clone, Debug)]
pub(super) struct Crossing<const LINKS: usize> {
    /// Crossing of the branches (rad, or m).
    pub(super) phi: f64,
    /// Ends of the window.
    ends: [f64; 2],
    solved: [Solution; 2],
    /// x, y and ψ of each link at both ends.
    coordinates: [[[Transfer; 3]; LINKS]; 2],
}

impl<const LINKS: usize> Crossing<LINKS> {
    /// The crossing between two places on one branch.
    fn between(phi: f64, sides: [&Place; 2]) -> Self {
        let mut coordinates = [[[Transfer::constant(0.0); 3]; LINKS]; 2];
        for (end, side) in coordinates.iter_mut().zip(sides) {
            for (link, frame) in end.iter_mut().zip(&side.frames) {
                *link = [frame.x, frame.y, frame.psi];
            }
        }
        Self {
            phi,
            ends: sides.map(|side| side.phi),
            solved: sides.map(|side| side.solved),
            coordinates,
        }
    }

    /// Whether a position is in the window.
    pub(super) fn holds(&self, phi: f64) -> bool {
        self.ends[0] <= phi && phi <= self.ends[1]
    }

    /// Whether the window lies below a position.
    pub(super) fn is_below(&self, phi: f64) -> bool {
        self.ends[1] < phi
    }

    /// Signs of the determinants above it.
    pub(super) const fn signs_above(&self) -> u64 {
        self.solved[1].signs
    }

    /// Half the width of the window.
    fn half(&self) -> f64 {
        0.5 * (self.ends[1] - self.ends[0])
    }

    /// The upper end of the window, for a linkage of `count` links.
    pub(super) fn upper(&self, count: usize) -> Place {
        self.end(1, count)
    }

    fn end(&self, end: usize, count: usize) -> Place {
        let links = self.coordinates[end].iter().take(count);
        let frames = links.map(|[x, y, psi]| Frame::turned([*x, *y], *psi));
        // A window ends far enough from the zero of the determinants that the first step can do without them.
        let unknown = [0.0; _];
        Place::new(self.ends[end], self.solved[end], frames.collect(), &unknown)
    }

    /// Puts `count` links at a position in the window into `frames`.
    pub(super) fn place(&self, phi: f64, count: usize, frames: &mut Frames) -> Solution {
        let [from, to] = self.ends;
        let width = to - from;
        let u = Transfer {
            value: (phi - from) / width,
            d1: 1.0 / width,
            d2: 0.0,
            d3: 0.0,
        };
        frames.clear();
        let [below, above] = &self.coordinates;
        frames.extend(below.iter().zip(above).take(count).map(|(below, above)| {
            let [x, y, psi] = [0, 1, 2].map(|axis| hermite([below[axis], above[axis]], width, u));
            Frame::turned([x, y], psi)
        }));
        let [below, above] = &self.solved;
        let near = if phi < self.phi { below } else { above };
        let part = math::abs(phi - self.phi) / self.half();
        Solution {
            quality: part.min(1.0) * near.quality,
            ..*near
        }
    }

    /// Difference of two windows around the same change point: in the third derivatives there, relative to 1 or their largest.
    fn differs(&self, other: &Self, count: usize, unit: f64) -> f64 {
        let [mut here, mut there] = [Frames::new(), Frames::new()];
        self.place(self.phi, count, &mut here);
        other.place(self.phi, count, &mut there);
        let cube = unit * unit * unit;
        let mut largest = 0.0_f64;
        for (a, b) in here.iter().zip(&there) {
            for (a, b) in [(a.x, b.x), (a.y, b.y), (a.psi, b.psi)] {
                let scale = 1.0 + cube * math::abs(a.d3);
                largest = largest.max(cube * math::abs(a.d3 - b.d3) / scale);
            }
        }
        largest
    }
}

/// The polynomial of degree 7 through values and three derivatives with respect to φ at the ends of a window, at u = 0 to 1 of its `width`: the
/// third-order Taylor polynomial at u = 0, plus u⁴ times a polynomial for the difference at u = 1.
fn hermite([from, to]: [Transfer; 2], width: f64, u: Transfer) -> Transfer {
    let taylor = |f: Transfer| {
        let (w2, w3) = (width * width, width * width * width);
        [f.value, f.d1 * width, f.d2 * w2 / 2.0, f.d3 * w3 / 6.0]
    };
    // Relative to the value at the lower end, so that large angles lose no digits.
    let base = from.value;
    let [_, a1, a2, a3] = taylor(from);
    let [b0, b1, b2, b3] = taylor(to);
    let left = [
        b0 - base - (a1 + a2 + a3),
        b1 - (a1 + 2.0 * a2 + 3.0 * a3),
        b2 - (a2 + 3.0 * a3),
        b3 - a3,
    ];
    // Times 1/(1 + w)⁴ = 1 − 4·w + 10·w² − 20·w³ + …, w = u − 1.
    let [l0, l1, l2, l3] = left;
    let rest = [
        l0,
        l1 - 4.0 * l0,
        l2 - 4.0 * l1 + 10.0 * l0,
        l3 - 4.0 * l2 + 10.0 * l1 - 20.0 * l0,
    ];
    let w = u - Transfer::constant(1.0);
    let [c0, c1, c2, c3] = rest.map(Transfer::constant);
    let far = ((c3 * w + c2) * w + c1) * w + c0;
    let square = u * u;
    let near = ((u * a3 + Transfer::constant(a2)) * u + Transfer::constant(a1)) * u;
    far * (square * square) + near + Transfer::constant(base)
}

impl<const LINKS: usize, const PAIRS: usize, const CAMS: usize> Linkage<LINKS, PAIRS, CAMS> {
    /// The change point directly ahead of a place, upwards (`way` = 1) or downwards (−1); `None` where the way ends, or only becomes steep.
    pub(super) fn cross(&self, stalled: &Place, way: f64, span: f64) -> Option<Crossing<LINKS>> {
        let unit = self.unit();
        let gait = Gait::strict(span);
        let to = |side: &mut Place, phi: f64| self.walk(side, phi, gait);
        // Here the determinants may be small.
        let mut near = Place::new(
            stalled.phi,
            stalled.solved,
            stalled.frames.clone(),
            &stalled.determinants,
        );
        to(&mut near, stalled.phi - way * FIRST * unit).ok()?;
        let mut far = self.beyond(&near, stalled.phi + way * FIRST * unit)?;
        let mut phi = root(&near, &far);
        for side in [(&mut near, -1.0), (&mut far, 1.0)] {
            to(side.0, phi + way * side.1 * NARROW * unit).ok()?;
        }
        phi = root(&near, &far);
        let [mut below, mut above] = if way > 0.0 { [near, far] } else { [far, near] };
        let mut half = WIDTHS[0];
        let mut before: Option<Crossing<LINKS>> = None;
        let mut best: Option<(f64, Crossing<LINKS>)> = None;
        while half <= WIDTHS[1]
            && to(&mut below, phi - half * unit).is_ok()
            && to(&mut above, phi + half * unit).is_ok()
        {
            let now = Crossing::between(phi, [&below, &above]);
            if let Some(before) = before {
                let apart = now.differs(&before, self.links.len(), unit);
                if best.as_ref().is_none_or(|(least, _)| apart < *least) {
                    best = Some((apart, before));
                }
            }
            before = Some(now);
            half *= SQRT_2;
        }
        best.filter(|(apart, _)| *apart < AGREED)
            .map(|(_, crossing)| crossing)
    }

    /// The place at φ, where branches crossed on the way there.
    fn beyond(&self, near: &Place, phi: f64) -> Option<Place> {
        let frames = predicted(&near.frames, phi - near.phi);
        let far = self.placed(phi, frames).ok()?;
        let crossed = far.solved.signs != near.solved.signs;
        (crossed && far.solved.correction <= TRUSTED).then_some(far)
    }

    /// The crossing of branches directly ahead of a place, upwards (`way` = 1) or downwards (−1).
    pub(super) fn flat_ahead(&self, place: &Place, way: f64) -> Option<f64> {
        let far = self.beyond(place, place.phi + way * NARROW * self.unit())?;
        Some(root(place, &far))
    }

    /// Walks from a place to another φ, through the change points on the way, which are stored. Ends in the last window if it contains `to`.
    pub(super) fn walk_through<const FLATS: usize>(
        &self,
        place: &mut Place,
        to: f64,
        span: f64,
        found: &mut heapless::Vec<Crossing<LINKS>, FLATS>,
    ) -> Result<(), PassError> {
        let gait = if FLATS == 0 {
            Gait::strict(span)
        } else {
            Gait::wary(self.unit())
        };
        while let Err(stopped) = self.walk(place, to, gait) {
            let way = math::sign(to - place.phi);
            if FLATS == 0 {
                return Err(stopped.into());
            }
            let Some(crossing) = self.cross(place, way, span) else {
                // Not a change point: walk as close to it as without change points.
                self.walk(place, to, Gait::strict(span))?;
                break;
            };
            let end = crossing.end(usize::from(way > 0.0), self.links.len());
            let arrived = crossing.holds(to);
            found.push(crossing).map_err(|_| PassError::TooMany)?;
            *place = end;
            if arrived {
                break;
            }
        }
        Ok(())
    }

    /// The drive's equivalent of an angle of 1 rad: 1, or the linkage's size (m) if it slides.
    pub(super) fn unit(&self) -> f64 {
        if self.slides() { self.size } else { 1.0 }
    }
}

/// Why the walk failed.
pub(super) enum PassError {
    Pose(PoseError),
    TooMany,
}

impl From<PoseError> for PassError {
    fn from(error: PoseError) -> Self {
        Self::Pose(error)
    }
}

/// The zero of a group's determinant between two places close to it.
fn root(near: &Place, far: &Place) -> f64 {
    let group = (near.solved.signs ^ far.solved.signs).trailing_zeros() as usize;
    let [near_to, far_to] = [near, far].map(|side| {
        let determinant = side.determinants.get(group);
        determinant.copied().unwrap_or(1.0)
    });
    near.phi + near_to / (near_to + far_to) * (far.phi - near.phi)
}
