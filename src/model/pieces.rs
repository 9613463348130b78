//! A turn in pieces, for curves with jumps.
//!
//! A table is at least continuously differentiable. Where a curve of the machine jumps (a load that is switched on, a dwell cam
//! whose follower starts with a jerk or a blow), no number of cells makes the error next to the jump small: it falls with the
//! width of a cell only. A table for each piece between the jumps has no such cells. [`Part`] is a piece of a machine, to be
//! tabulated as a stroke; [`Pieces`] puts their models together again.

use crate::error::finite;
use crate::scalar::{Outcome, Scalar};
use crate::table::{Layout, Spline, TableError};
use crate::{Domain, Error, Model, Phase, Reducible, Reduction};

/// A part of a machine's range, as a stroke.
#[derive(Clone, Copy, Debug)]
pub struct Part<'m, M> {
    machine: &'m M,
    from: f64,
    to: f64,
}

/// The end of a part belongs to the next one; so close to it (in lengths of the part) its last place lies.
const INSIDE: f64 = 1e-11;

impl<'m, M: Reducible> Part<'m, M> {
    /// From the position `from` to `to` (rad, or m).
    ///
    /// # Errors
    /// A position that is not finite, `to` not greater than `from`, or more than a turn.
    pub fn new(machine: &'m M, from: f64, to: f64) -> Result<Self, Error> {
        let from = finite("start of the part", from)?;
        let to = finite("end of the part", to)?;
        let span = machine.domain().span();
        if !(to > from && to - from <= span) {
            return Err(Error::OutOfRange {
                what: "length of the part",
                value: to - from,
                min: 0.0,
                max: span,
            });
        }
        Ok(Self { machine, from, to })
    }
}

impl<M: Reducible> Reducible for Part<'_, M> {
    fn domain(&self) -> Domain {
        Domain::Stroke {
            from: self.from,
            to: self.to,
        }
    }

    fn reduction(&self, phi: f64) -> Result<Reduction, Error> {
        // What holds from the end on is not what holds before it.
        let last = self.to - INSIDE * (self.to - self.from);
        self.machine.reduction(phi.clamp(self.from, last))
    }
}

/// A turn of N pieces, each with a model of its own; they share the machine units and the set of curves.
///
/// Costs beside the model's tick: N comparisons and one long multiplication.
#[derive(Clone, Copy, Debug)]
pub struct Pieces<'a, S: Scalar, const CURVES: u8, const N: usize, L: Layout = Spline> {
    pieces: [Piece<'a, S, CURVES, L>; N],
}

#[derive(Clone, Copy, Debug)]
struct Piece<'a, S: Scalar, const CURVES: u8, L: Layout> {
    start: u32,
    /// Shifts the length of the piece to the left until its top bit is set.
    shift: u32,
    /// 2⁶³ divided by the length so shifted.
    stretch: u32,
    model: Model<'a, S, CURVES, L>,
}

impl<'a, S: Scalar, const CURVES: u8, const N: usize, L: Layout> Pieces<'a, S, CURVES, N, L> {
    /// From the models of pieces and the phases at which they start, in ascending order; the last ends where the first starts.
    ///
    /// # Errors
    /// [`TableError::Pieces`]: no piece, starts that do not ascend, or a piece shorter than 2⁻¹⁶ of a turn.
    pub fn new(models: [(Phase, Model<'a, S, CURVES, L>); N]) -> Result<Self, TableError> {
        let starts = models.map(|(start, _)| start.to_bits());
        if N == 0 || !starts.is_sorted_by(|a, b| a < b) {
            return Err(TableError::Pieces);
        }
        let mut following = starts.iter().cycle().skip(1);
        let mut too_short = false;
        let pieces = models.map(|(start, model)| {
            let start = start.to_bits();
            let next = following.next().copied().unwrap_or(start);
            // A single piece is a whole turn, whose length does not fit: one unit less.
            let length = match next.wrapping_sub(start) {
                0 => u32::MAX,
                length => length,
            };
            too_short |= length < 1 << 16;
            let shift = length.leading_zeros();
            let shifted = u64::from(length.wrapping_shl(shift)).max(1);
            let stretch = ((1u64 << 63) / shifted).min(u64::from(u32::MAX));
            Piece {
                start,
                shift,
                stretch: stretch as u32,
                model,
            }
        });
        if too_short {
            return Err(TableError::Pieces);
        }
        Ok(Self { pieces })
    }

    /// The model of the piece at `phase`, and the phase within it.
    #[inline]
    fn at(&self, phase: Phase) -> Option<(&Model<'a, S, CURVES, L>, Phase)> {
        // Before the first start it is the last piece, which goes on from the turn before.
        let mut piece = self.pieces.last()?;
        for candidate in &self.pieces {
            if phase.to_bits() >= candidate.start {
                piece = candidate;
            }
        }
        let beyond = phase.to_bits().wrapping_sub(piece.start);
        let shifted = u64::from(beyond.wrapping_shl(piece.shift));
        let within = (shifted * u64::from(piece.stretch)) >> 31;
        let within = within.min(u64::from(u32::MAX)) as u32;
        Some((&piece.model, Phase::from_bits(within)))
    }

    /// As [`Model::torque`].
    #[inline]
    pub fn torque(&self, phase: Phase, omega: S, alpha: S) -> S {
        let found = self.at(phase);
        found.map_or(S::default(), |(model, phase)| model.torque(phase, omega, alpha))
    }

    /// As [`Model::acceleration`].
    #[inline]
    pub fn acceleration(&self, phase: Phase, omega: S, torque: S) -> Outcome<S> {
        let found = self.at(phase);
        found.map_or(Outcome::default(), |(model, phase)| {
            model.acceleration(phase, omega, torque)
        })
    }
}
