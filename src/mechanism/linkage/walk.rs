//! Continuation along φ, (79).

use crate::machine::Frames;
use crate::machine::error::PoseError;
use crate::machine::joint::Joint;
use crate::machine::link::Frame;
use crate::math;
use crate::number::transfer::Transfer;

use super::solver::{Determinants, Solved, Unsolved};
use super::{Linkage, Pair};

/// The corrector may move a link so far (rad, or of the linkage's size): beyond, the predictor was not to be trusted.
pub(super) const TRUSTED: f64 = 0.02;
/// Shortest step, of the drive's range: what cannot be passed with it is a dead point.
const SHORTEST: f64 = 1e-9;
/// Shortest step towards a change point (rad, or of the linkage's size).
const WARY: f64 = 1e-5;
/// A group's determinant may fall to this part of its largest: closer to a crossing of branches, rounding in the predictor could put the
/// links on the other one. A dead point is this close within the square of it.
const LEAST: f64 = 1e-5;

/// How far from a drawing its determinants are compared (rad, or of the linkage's size).
const ASIDE: f64 = 0.01;

/// How close to a dead point a walk goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gait {
    /// Shortest step (rad, or m).
    shortest: f64,
}

impl Gait {
    /// As close as the solver can.
    pub(super) fn strict(span: f64) -> Self {
        Self {
            shortest: SHORTEST * span,
        }
    }

    /// Where a change point may be ahead; `unit` is what 1 rad is for the drive.
    pub(super) fn wary(unit: f64) -> Self {
        Self {
            shortest: WARY * unit,
        }
    }
}

/// The links, solved at a position of the drive.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub(super) phi: f64,
    pub(super) solved: Solved,
    pub(super) frames: Frames,
    pub(super) determinants: Determinants,
    /// The largest of them on the way here.
    largest: Determinants,
}

impl Place {
    /// Where the way begins.
    pub(super) const fn new(
        phi: f64,
        solved: Solved,
        frames: Frames,
        determinants: &Determinants,
    ) -> Self {
        Self {
            phi,
            solved,
            frames,
            determinants: *determinants,
            largest: *determinants,
        }
    }

    /// The part of its `largest` to which the determinant of a group has fallen furthest, and that group's number.
    fn fallen(&self, largest: &Determinants) -> (f64, usize) {
        let both = self.determinants.iter().zip(largest);
        let parts = both.map(|(now, largest)| now / largest).enumerate();
        parts.fold(
            (1.0, 0),
            |least, (k, part)| {
                if part < least.0 { (part, k) } else { least }
            },
        )
    }
}

impl<const LINKS: usize, const PAIRS: usize, const CAMS: usize> Linkage<LINKS, PAIRS, CAMS> {
    /// From a place to another φ, in steps as long as the predictor is to be trusted. A place that is not reached is the last before it.
    pub(super) fn walk(&self, place: &mut Place, to: f64, gait: Gait) -> Result<(), PoseError> {
        let mut step = to - place.phi;
        let mut arrived = math::abs(step) == 0.0;
        while !arrived {
            let phi = place.phi;
            let last = math::abs(to - phi) <= math::abs(step);
            let next = if last { to } else { phi + step };
            let found = self.placed(next, predicted(&place.frames, next - phi));
            // Not another solution, on the far side of a dead point, or where branches cross.
            let same = found.as_ref().is_ok_and(|found| {
                found.solved.signs == place.solved.signs && found.fallen(&place.largest).0 >= LEAST
            });
            match found {
                Ok(mut found) if same && found.solved.correction <= TRUSTED => {
                    for (largest, before) in found.largest.iter_mut().zip(&place.largest) {
                        *largest = largest.max(*before);
                    }
                    *place = found;
                    arrived = last;
                    step *= 2.0;
                }
                found if math::abs(next - phi) <= gait.shortest => {
                    let joint = self.weakest(place);
                    if same || found.is_err() {
                        return Err(PoseError::DeadPoint { phi: next, joint });
                    }
                    let flat = self.flat_ahead(place, math::sign(step));
                    let phi = flat.unwrap_or(next);
                    return Err(PoseError::BranchChange { phi, joint });
                }
                _ => step = 0.5 * (next - phi),
            }
        }
        Ok(())
    }

    /// The links solved at a position, from where they nearly are.
    pub(super) fn placed(&self, phi: f64, mut frames: Frames) -> Result<Place, Unsolved> {
        let mut determinants = [1.0; _];
        let solved = self.solve_noting(phi, &mut frames, &mut determinants)?;
        Ok(Place::new(phi, solved, frames, &determinants))
    }

    /// The pair that moves the links worst at a place, of what it did on the way there.
    fn weakest(&self, place: &Place) -> usize {
        match place.fallen(&place.largest) {
            (part, k) if part < place.solved.quality => self.pair_of_group(k),
            _ => place.solved.weakest,
        }
    }

    /// The pair that locks where the links are drawn, in a change point: its determinant is as good as zero, against what it is a little aside.
    pub(super) fn flat_at(&self, drawn: &Place) -> Option<usize> {
        [ASIDE, -ASIDE].into_iter().find_map(|aside| {
            let phi = drawn.phi + aside * self.unit();
            let beside = self.placed(phi, predicted(&drawn.frames, 0.0)).ok()?;
            let (part, k) = drawn.fallen(&beside.determinants);
            (part < LEAST).then(|| self.pair_of_group(k))
        })
    }

    /// Whether the drive is a guide.
    pub(super) fn slides(&self) -> bool {
        matches!(
            self.pairs.get(self.drive),
            Some(Pair::Joint(Joint::Prismatic(_)))
        )
    }
}

impl Unsolved {
    pub(super) fn at(self, phi: f64) -> PoseError {
        let Self { pair: joint, gap } = self;
        if gap > 0.0 {
            PoseError::CannotAssemble { phi, joint, gap }
        } else {
            PoseError::DeadPoint { phi, joint }
        }
    }
}

/// The links a step `h` on, by Taylor's polynomial of third order.
pub(super) fn predicted(frames: &Frames, h: f64) -> Frames {
    let on =
        |c: Transfer| Transfer::constant(c.value + h * (c.d1 + h / 2.0 * (c.d2 + h / 3.0 * c.d3)));
    frames
        .iter()
        .map(|frame| Frame::turned([on(frame.x), on(frame.y)], on(frame.psi)))
        .collect()
}
