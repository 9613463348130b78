//! Cogging that was not asked for: a score test of the residuals.
//!
//! ```text
//! s = Wᵀe          W = Z_q − Z̃·(X̃ᵀZ̃)⁻¹·X̃ᵀZ_q          χ² = sᵀ(WᵀW)⁻¹s/misfit
//! ```
//!
//! Z_q has the cosine and the sine of order q, whitened; W is what the unknowns of the fit leave of them.

use jred_file::math;

use super::basis::Basis;
use super::fault::Fault;
use super::fit::{Fit, masked};
use super::matrix::{dot, whiten};

/// Highest order that is tested.
const HIGHEST: u32 = 120;

/// χ² of two degrees of freedom from which on an order is certain: one in 10⁸ orders of white noise.
const CERTAIN: f64 = 40.0;

/// Its median, and the orders to either side whose median is that of noise that is not white.
const MEDIAN: f64 = 1.386;
const NEIGHBOURS: usize = 10;

/// The most orders that are reported.
const MOST: usize = 8;

/// An order without the part that the unknowns explain.
struct Candidate {
    order: u32,
    /// Of the rows: cosine and sine.
    waves: [Vec<f64>; 2],
    /// (WᵀW)⁻¹: both diagonal elements and the other one.
    inverse: [f64; 3],
}

impl Candidate {
    fn new(order: u32, waves: [Vec<f64>; 2]) -> Option<Self> {
        let [c, s] = &waves;
        let [cc, ss, cs] = [dot(c, c), dot(s, s), dot(c, s)];
        let determinant = cc * ss - cs * cs;
        (determinant > 1e-12 * cc * ss).then(|| Self {
            order,
            inverse: [ss, cc, -cs].map(|x| x / determinant),
            waves,
        })
    }

    /// The factors of cosine and sine that fit the residuals best, and the sum of squares that they explain.
    fn fitted(&self, residuals: &[f64]) -> ([f64; 2], f64) {
        let [a, b, both] = self.inverse;
        let [c, s] = [0, 1].map(|k| dot(&self.waves[k], residuals));
        let factors = [a * c + both * s, both * c + b * s];
        (factors, factors[0] * c + factors[1] * s)
    }
}

/// The orders above the harmonics of V′ that the residuals have, without those that were asked for; the largest first.
pub(super) fn cogging(fit: &Fit) -> Vec<Fault> {
    let orders = left(fit);
    let mut residuals = fit.residuals.clone();
    let mut found: Vec<Fault> = Vec::new();
    while found.len() < MOST {
        let scale = fit.misfit.max(1.0);
        let squares = orders
            .iter()
            .map(|order| order.fitted(&residuals).1 / scale);
        let squares: Vec<f64> = squares.collect();
        let best = (0..orders.len()).max_by(|a, b| squares[*a].total_cmp(&squares[*b]));
        let Some(best) = best.filter(|best| squares[*best] > CERTAIN * excess(&squares, *best))
        else {
            break;
        };
        let Candidate { order, waves, .. } = &orders[best];
        let (factors, _) = orders[best].fitted(&residuals);
        for (wave, factor) in waves.iter().zip(factors) {
            for (residual, x) in residuals.iter_mut().zip(wave) {
                *residual -= factor * x;
            }
        }
        let amplitude = math::hypot(factors[0], factors[1]);
        found.push(Fault::Cogging {
            order: *order,
            amplitude,
        });
    }
    found
}

/// By how much noise at the orders around one is above the model's.
fn excess(squares: &[f64], at: usize) -> f64 {
    let from = at.saturating_sub(NEIGHBOURS);
    let to = (at + NEIGHBOURS + 1).min(squares.len());
    let mut around = squares[from..to].to_vec();
    around.sort_by(f64::total_cmp);
    (around[around.len() / 2] / MEDIAN).max(1.0)
}

/// Each order without the part that the unknowns explain.
fn left(fit: &Fit) -> Vec<Candidate> {
    let orders = (fit.basis.harmonics as u32 + 1..=HIGHEST)
        .filter(|order| !fit.basis.cogging.contains(order));
    let basis = Basis {
        harmonics: 0,
        mean: false,
        friction: 0,
        shape: Vec::new(),
        cogging: orders.collect(),
        least: 0,
    };
    let motion = &fit.motion;
    let rows = fit.weak.rows(&basis, &motion.position, &motion.speed);
    let columns: Vec<usize> = (basis.cog()..basis.unknowns()).collect();
    let mut waves = masked(&rows.select(&columns), &fit.kept);
    whiten(&fit.lower, &mut waves);
    let normal = fit.instruments.transposed_product(&fit.whitened);
    let Some(inverse) = normal.inverse() else {
        return Vec::new();
    };
    let explained = inverse.transposed_product(&fit.whitened.transposed_product(&waves));
    waves.subtract_product(&fit.instruments, &explained);
    let column = |k: usize| -> Vec<f64> { waves.rows().map(|row| row[k]).collect() };
    let each = basis.cogging.iter().enumerate();
    each.filter_map(|(k, order)| Candidate::new(*order, [column(2 * k), column(2 * k + 1)]))
        .collect()
}
