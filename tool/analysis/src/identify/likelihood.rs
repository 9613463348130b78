//! The covariance of the rows by the noise of encoder and torque, and the torque's noise by maximum likelihood.

use super::matrix::{Band, DIAGONALS, Matrix, factor, whiten};
use jred_file::math;

/// Covariance of the rows; those that do not count are set apart.
pub(super) fn covariance(
    position: &Band,
    torque: &[f64; DIAGONALS],
    variance: f64,
    kept: &[bool],
) -> Band {
    let row = |(i, band): (usize, &[f64; DIAGONALS])| {
        std::array::from_fn(|l| match (kept[i], l) {
            (true, _) if l <= i && kept[i - l] => band[l] + variance * torque[l],
            (false, 0) => 1.0,
            _ => 0.0,
        })
    };
    position.iter().enumerate().map(row).collect()
}

/// −2·ln of the likelihood of residuals, but for a constant.
fn unlikeliness(band: &Band, residuals: &[f64]) -> Option<f64> {
    let lower = factor(band)?;
    let mut column = Matrix::zeros(residuals.len(), 1)
        .beside(residuals)
        .select(&[1]);
    whiten(&lower, &mut column);
    let squares: f64 = column.rows().map(|row| row[0] * row[0]).sum();
    let logs: f64 = lower.iter().map(|row| math::ln(row[0])).sum();
    Some(squares + 2.0 * logs)
}

/// The variance of the torque by maximum likelihood, with Newton's method on its logarithm.
pub(super) fn torque_variance(
    position: &Band,
    torque: &[f64; DIAGONALS],
    kept: &[bool],
    residuals: &[f64],
    start: f64,
    steps: usize,
) -> Option<f64> {
    let mut log = math::ln(start);
    let at = |log: f64| {
        unlikeliness(
            &covariance(position, torque, math::exp(log), kept),
            residuals,
        )
    };
    for _ in 0..steps {
        let [here, above, below] = [at(log)?, at(log + 0.1)?, at(log - 0.1)?];
        let curvature = ((above - 2.0 * here + below) / 0.01).max(1e-2 * kept.len() as f64);
        let step = (-(above - below) / 0.2 / curvature).clamp(-1.5, 1.5);
        log += step;
        if step.abs() < 0.01 {
            break;
        }
    }
    Some(math::exp(log))
}
