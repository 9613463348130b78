//! The solution of whitened rows, with the covariance by the noise model and that by the residuals.

use super::matrix::{Matrix, dot};

/// Rows in a block of the scores, and lags of their covariance.
const BLOCK: usize = 10;
const LAGS: usize = 3;

/// Why there is no fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unfit {
    /// Too few rows are left for these unknowns.
    Few { rows: usize, needed: usize },
    /// The unknowns cannot be told apart.
    Singular,
}

/// The solution of whitened rows.
pub(super) struct Solution {
    pub(super) theta: Vec<f64>,
    pub(super) residuals: Vec<f64>,
    pub(super) misfit: f64,
    pub(super) covariances: [Matrix; 2],
}

/// θ, its residuals and covariances from whitened rows, of which `kept` count.
pub(super) fn solve(
    whitened: &Matrix,
    instruments: &Matrix,
    right: &[f64],
    kept: usize,
) -> Result<Solution, Unfit> {
    let normal = instruments.transposed_product(whitened);
    let inverse = normal.inverse().ok_or(Unfit::Singular)?;
    let theta = inverse.times(&instruments.transposed_times(right));
    let fitted = whitened.times(&theta);
    let residuals: Vec<f64> = right.iter().zip(&fitted).map(|(r, x)| r - x).collect();
    let free = (kept - whitened.columns()) as f64;
    let misfit = dot(&residuals, &residuals) / free;
    let mut model = inverse.congruence(&instruments.transposed_product(instruments));
    for row in model.rows_mut() {
        for x in row {
            *x *= misfit.max(1.0);
        }
    }
    let scores = scores(instruments, &residuals, kept as f64 / free);
    let observed = inverse.congruence(&scores);
    Ok(Solution {
        theta,
        residuals,
        misfit,
        covariances: [model, observed],
    })
}

/// Covariance of the scores z̃·e with Bartlett's weights, whose neighbours are summed first.
fn scores(instruments: &Matrix, residuals: &[f64], factor: f64) -> Matrix {
    let columns = instruments.columns();
    let blocks = residuals.len() / BLOCK + 1;
    let mut sums = Matrix::zeros(blocks, columns);
    for (i, (z, e)) in instruments.rows().zip(residuals).enumerate() {
        for (into, z) in sums.row_mut(i / BLOCK).iter_mut().zip(z) {
            *into += z * e;
        }
    }
    let mut covariance = Matrix::zeros(columns, columns);
    for lag in 0..=LAGS {
        let weight = 1.0 - lag as f64 / (LAGS + 1) as f64;
        for (later, row) in sums.rows().skip(lag).zip(sums.rows()) {
            for (i, a) in later.iter().enumerate() {
                for (k, b) in row.iter().enumerate() {
                    let both = factor * weight * a * b;
                    covariance.row_mut(i)[k] += both;
                    if lag > 0 {
                        covariance.row_mut(k)[i] += both;
                    }
                }
            }
        }
    }
    covariance
}
