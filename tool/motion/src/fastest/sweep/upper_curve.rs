//! The upper curve in one cell: its speeds, where a motion meets it, and the pieces along it.

use super::{
    CURVE_TOLERANCE, Side, SweepCurve, SweepPiece, along_cap, first_positive, follow, push, zero_of,
};
use crate::fastest::field::Field;
use crate::fastest::leg::{Leg, Step};
use crate::fastest::track::PathCell;

/// The upper curve in a cell, as pieces from the end to the start.
pub(super) struct UpperCurve<'u> {
    pub(super) field: &'u Field<'u, 'u>,
    pub(super) cell: &'u PathCell,
    pub(super) own: &'u [SweepPiece],
}

impl UpperCurve<'_> {
    /// The piece that contains a share of the cell; at a border the later one.
    fn piece(&self, u: f64) -> Option<&SweepPiece> {
        let covers = |piece: &&SweepPiece| piece.step.u[0] <= u;
        self.own.iter().find(covers).or(self.own.last())
    }

    fn leg(&self) -> Leg<'_> {
        Leg {
            field: self.field,
            side: Side::Least,
            cell: self.cell,
        }
    }

    /// z at a share of the cell.
    pub(super) fn z(&self, u: f64) -> f64 {
        let Some(SweepPiece { step, along, .. }) = self.piece(u) else {
            return 0.0;
        };
        if *along == SweepCurve::Cap {
            return self.cell.cap(u);
        }
        if u <= step.u[0] {
            return step.z[0];
        }
        if (u - step.u[1]).abs() <= 0.0 {
            return step.z[1];
        }
        let leg = self.leg();
        follow(&leg, leg.point(step.u[1], step.z[1]), u)
    }

    /// The first step that rises above the upper curve, and where.
    pub(super) fn crossed(&self, leg: &Leg, steps: &[Step]) -> Option<(usize, f64)> {
        let is_above = |step: &Step| step.z[1] > self.z(step.u[1]) * (1.0 + CURVE_TOLERANCE);
        let k = steps.iter().position(is_above)?;
        let step = steps[k];
        let left = leg.point(step.u[0], step.z[0]);
        let values = [0, 1].map(|end| step.z[end] - self.z(step.u[end]));
        if values[0] >= 0.0 {
            return Some((k, step.u[0]));
        }
        let above = |u: f64| follow(leg, left, u) - self.z(u);
        Some((k, zero_of(above, step.u, values)))
    }

    /// Follows the upper curve from a share of the cell: how far, and whether it still does at the end.
    pub(super) fn along(
        &self,
        from: f64,
        most: &Leg,
        may_leave: bool,
        index: usize,
        pieces: &mut Vec<SweepPiece>,
    ) -> (f64, bool) {
        let Some(piece) = self.piece(from) else {
            return (1.0, true);
        };
        let end = piece.step.u[1];
        match piece.along {
            SweepCurve::Cap => {
                let cell = self.cell;
                let falls = |u: f64| cell.cap_slope(u) - most.at(u, cell.cap(u));
                let leaves = first_positive(falls, from, end).filter(|_| may_leave);
                let to = leaves.unwrap_or(end);
                if to > from {
                    along_cap(cell, index, [from, to], pieces);
                }
                (to, leaves.is_none())
            }
            _ if from <= piece.step.u[0] => {
                pieces.push(*piece);
                (end, true)
            }
            SweepCurve::Side(_) => {
                let leg = self.leg();
                let mut part = Vec::new();
                let right = leg.point(end, piece.step.z[1]);
                if leg.go(right, from, &mut part).is_ok() {
                    push(pieces, index, part.into_iter().rev(), leg.side);
                }
                (end, true)
            }
        }
    }
}
