//! Continuation along φ, (79).

use crate::machine::Frames;
use crate::machine::error::PoseError;
use crate::machine::joint::Joint;
use crate::machine::link::Frame;
use crate::math;
use crate::number::transfer::Transfer;

use super::solver::{Determinants, Solution, SolveError};
use super::{Linkage, Pair};

/// Limit of a link's movement by the corrector (rad, or relative to the linkage's size): beyond it the predictor cannot be trusted.
pub(super) const TRUSTED: f64 = 0.02;
/// Shortest step, relative to the drive's range: a place that it cannot pass is a dead point.
const SHORTEST: f64 = 1e-9;
/// Shortest step towards a change point (rad, or relative to the linkage's size).
const WARY: f64 = 1e-5;
/// A group's determinant may fall to this share of its largest value: closer to a crossing of branches, rounding in the predictor could move the
/// links to the other branch. Near a dead point that is a distance of its square.
const LEAST: f64 = 1e-5;

/// Distance from a drawing for comparing its determinants (rad, or relative to the linkage's size).
const ASIDE: f64 = 0.01;

/// Minimum distance of a walk from a dead point.
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

    /// For a possible change point ahead; `unit` is the drive's equivalent of 1 rad.
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
    pub(super) solved: Solution,
    pub(super) frames: Frames,
    pub(super) determinants: Determinants,
    /// Their largest values on the way here.
    largest: Determinants,
}

impl Place {
    /// The start of a walk.
    pub(super) const fn new(
        phi: f64,
        solved: Solution,
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

    /// The largest fall of a group's determinant, as a share of its `largest`, and that group's number.
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
    /// Walks from a place to another φ, in steps as long as the predictor can be trusted. On failure `place` is the last place reached.
    pub(super) fn walk(&self, place: &mut Place, to: f64, gait: Gait) -> Result<(), PoseError> {
        let mut step = to - place.phi;
        let mut arrived = math::abs(step) == 0.0;
        while !arrived {
            let phi = place.phi;
            let last = math::abs(to - phi) <= math::abs(step);
            let next = if last { to } else { phi + step };
            let found = self.placed(next, predicted(&place.frames, next - phi));
            // Not another solution, beyond a dead point, or where branches cross.
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

    /// The links solved at a position, from a nearby start.
    pub(super) fn placed(&self, phi: f64, mut frames: Frames) -> Result<Place, SolveError> {
        let mut determinants = [1.0; _];
        let solved = self.solve_noting(phi, &mut frames, &mut determinants)?;
        Ok(Place::new(phi, solved, frames, &determinants))
    }

    /// The pair with the worst transmission at a place, relative to the way there.
    fn weakest(&self, place: &Place) -> usize {
        match place.fallen(&place.largest) {
            (part, k) if part < place.solved.quality => self.pair_of_group(k),
            _ => place.solved.weakest,
        }
    }

    /// The pair that locks in the drawing, at a change point: its determinant is practically zero compared with a place nearby.
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

impl SolveError {
    pub(super) fn at(self, phi: f64) -> PoseError {
        let Self { pair: joint, gap } = self;
        if gap > 0.0 {
            PoseError::CannotAssemble { phi, joint, gap }
        } else {
            PoseError::DeadPoint { phi, joint }
        }
    }
}

/// The links after a step `h`, by the third-order Taylor polynomial.
pub(super) fn predicted(frames: &Frames, h: f64) -> Frames {
    let on =
        |c: Transfer| Transfer::constant(c.value + h * (c.d1 + h / 2.0 * (c.d2 + h / 3.0 * c.d3)));
    frames
        .iter()
        .map(|frame| Frame::turned([on(frame.x), on(frame.y)], on(frame.psi)))
        .collect()
}
