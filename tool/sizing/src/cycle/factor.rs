//! The triangular factor of a cycle: root mean squares of linear forms, without the samples.

use super::LoadSample;
use crate::cycle::form::LOADS;

/// Rows of a block.
const BLOCK: usize = 64;

/// A weighted row of loads.
type LoadRow = [f64; LOADS];
/// An upper triangle, row by row.
type Triangle = [LoadRow; LOADS];

/// R of the QR factorization of the rows √w·x: ∑ w·(c·x)² = ‖R·c‖² for every c.
///
/// The direct sum would need ∑ w·x·xᵀ, which loses twice the digits where the terms of c·x cancel. Householder reflections keep each column to some
/// units of its own last place, so the root is as exact as the terms of c·x. One pass; the factors of blocks are joined in pairs, pairs of pairs and
/// so on, so that rounding grows only with the logarithm of their number (Demmel, Grigori, Hoemmen, Langou 2012, "Communication-optimal parallel and
/// sequential QR and LU factorizations").
#[derive(Clone, Debug)]
pub(super) struct Factor(Triangle);

impl Factor {
    /// The factor of the samples' loads.
    pub(super) fn of_loads(samples: &[LoadSample]) -> Self {
        Self::new(samples.iter().map(|s| (s.weight, s.loads())))
    }

    /// The factor of the loads times the speed: power is a linear form in these.
    pub(super) fn of_powers(samples: &[LoadSample]) -> Self {
        Self::new(
            samples
                .iter()
                .map(|s| (s.weight, s.loads().map(|x| x * s.speed()))),
        )
    }

    fn new(rows: impl Iterator<Item = (f64, LoadRow)>) -> Self {
        // Place k of the row: the factor of 2^k blocks, or `None`.
        let mut joined: Vec<Option<Triangle>> = Vec::new();
        let mut add = |block: &mut [LoadRow]| {
            let mut sum = triangle(block);
            for place in &mut joined {
                let Some(other) = place.take() else {
                    *place = Some(sum);
                    return;
                };
                sum = join(&other, &sum);
            }
            joined.push(Some(sum));
        };
        let mut block = Vec::with_capacity(BLOCK);
        for (weight, loads) in rows.filter(|(weight, _)| *weight > 0.0) {
            let root = weight.sqrt();
            block.push(loads.map(|x| root * x));
            if block.len() == BLOCK {
                add(&mut block);
                block.clear();
            }
        }
        if !block.is_empty() {
            add(&mut block);
        }
        let mut all = joined.into_iter().flatten();
        let first = all.next().unwrap_or_default();
        Self(all.fold(first, |sum, factor| join(&factor, &sum)))
    }

    /// √(∑ w·(c·x)²).
    pub(super) fn norm(&self, c: &[f64; LOADS]) -> f64 {
        let row = |(k, row): (usize, &LoadRow)| -> f64 {
            let terms = row.iter().zip(c).skip(k);
            terms.map(|(r, c)| r * c).sum()
        };
        let rows = self.0.iter().enumerate().map(row);
        rows.map(|x| x * x).sum::<f64>().sqrt()
    }
}

fn join(above: &Triangle, below: &Triangle) -> Triangle {
    let mut both = [[0.0; LOADS]; 2 * LOADS];
    both[..LOADS].copy_from_slice(above);
    both[LOADS..].copy_from_slice(below);
    triangle(&mut both)
}

/// R of the QR factorization of the rows by Householder reflections, in place.
fn triangle(rows: &mut [LoadRow]) -> Triangle {
    let mut triangle = Triangle::default();
    for k in 0..LOADS.min(rows.len()) {
        let rest = &mut rows[k..];
        let length = rest.iter().map(|row| row[k] * row[k]).sum::<f64>().sqrt();
        if length > 0.0 {
            // The reflection maps column k to (diagonal, 0, …); of the two signs the one without cancellation.
            let diagonal = -length.copysign(rest[0][k]);
            let normal = rest[0][k] - diagonal;
            for column in k + 1..LOADS {
                let across: f64 = normal * rest[0][column]
                    + rest[1..]
                        .iter()
                        .map(|row| row[k] * row[column])
                        .sum::<f64>();
                let twice = across / (diagonal * normal);
                rest[0][column] += twice * normal;
                for row in &mut rest[1..] {
                    row[column] += twice * row[k];
                }
            }
            rest[0][k] = diagonal;
        }
        triangle[k][k..].copy_from_slice(&rest[0][k..]);
    }
    triangle
}
