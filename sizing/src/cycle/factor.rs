//! The triangular factor of a cycle: root mean squares of linear forms, without the samples.

use nalgebra::{Matrix5, SMatrix, Vector5};

use super::Sample;
use crate::drive::LOADS;

/// Rows of a block.
const BLOCK: usize = 64;

/// R of the QR factorization of the rows √w·x: ∑ w·(c·x)² = ‖R·c‖² for every c.
///
/// The sum itself would need ∑ w·x·xᵀ, whose digits are lost twice over where the terms of c·x cancel. Householder's
/// reflections keep each column to some units of its own last place, so the root is as exact as the terms of c·x are.
/// One pass; the factors of blocks are joined in pairs, pairs of pairs and so on, so that rounding grows with the
/// logarithm of their number only (Demmel, Grigori, Hoemmen, Langou 2012, "Communication-optimal parallel and sequential
/// QR and LU factorizations").
#[derive(Clone, Debug)]
pub(super) struct Factor(Matrix5<f64>);

impl Factor {
    /// The factor of the samples' loads.
    pub(super) fn of_loads(samples: &[Sample]) -> Self {
        Self::new(samples.iter().map(|s| (s.weight, s.loads())))
    }

    /// The factor of the loads times the speed: power is a linear form in these.
    pub(super) fn of_powers(samples: &[Sample]) -> Self {
        Self::new(
            samples
                .iter()
                .map(|s| (s.weight, s.loads().map(|x| x * s.speed()))),
        )
    }

    fn new(rows: impl Iterator<Item = (f64, [f64; LOADS])>) -> Self {
        // At place k of the row: the factor of 2^k blocks, or none.
        let mut joined: Vec<Option<Matrix5<f64>>> = Vec::new();
        let mut add = |block: &SMatrix<f64, BLOCK, LOADS>| {
            let mut sum = block.qr().r();
            for place in &mut joined {
                let Some(other) = place.take() else {
                    *place = Some(sum);
                    return;
                };
                sum = join(&other, &sum);
            }
            joined.push(Some(sum));
        };
        let mut block = SMatrix::<f64, BLOCK, LOADS>::zeros();
        let mut filled = 0;
        for (weight, loads) in rows.filter(|(weight, _)| *weight > 0.0) {
            block
                .row_mut(filled)
                .copy_from(&(Vector5::from(loads) * weight.sqrt()).transpose());
            filled += 1;
            if filled == BLOCK {
                add(&block);
                block.fill(0.0);
                filled = 0;
            }
        }
        if filled > 0 {
            add(&block);
        }
        let mut all = joined.into_iter().flatten();
        let first = all.next().unwrap_or_else(Matrix5::zeros);
        Self(all.fold(first, |sum, factor| join(&factor, &sum)))
    }

    /// √(∑ w·(c·x)²).
    pub(super) fn norm(&self, c: &[f64; LOADS]) -> f64 {
        let r = &self.0;
        let [a, b, c, d, e] = *c;
        let rows = [
            r[(0, 0)] * a + r[(0, 1)] * b + r[(0, 2)] * c + r[(0, 3)] * d + r[(0, 4)] * e,
            r[(1, 1)] * b + r[(1, 2)] * c + r[(1, 3)] * d + r[(1, 4)] * e,
            r[(2, 2)] * c + r[(2, 3)] * d + r[(2, 4)] * e,
            r[(3, 3)] * d + r[(3, 4)] * e,
            r[(4, 4)] * e,
        ];
        rows.iter().map(|x| x * x).sum::<f64>().sqrt()
    }
}

fn join(above: &Matrix5<f64>, below: &Matrix5<f64>) -> Matrix5<f64> {
    let mut both = SMatrix::<f64, { 2 * LOADS }, LOADS>::zeros();
    both.fixed_view_mut::<LOADS, LOADS>(0, 0).copy_from(above);
    both.fixed_view_mut::<LOADS, LOADS>(LOADS, 0)
        .copy_from(below);
    both.qr().r()
}
