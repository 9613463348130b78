//! The weak form: the equation of motion times test functions with compact support, integrated by parts so that nothing measured is differentiated.
//!
//! ```text
//! w_i(t) = β₅((t − τ_i)/h)          quintic B-spline, support 6h
//! Σ Δt [ẅ_i·G_m(y) − ½·w_i·g_m′(y)·ω²]       J = Σ a_m·g_m,  G_m′ = g_m
//! ```

use super::basis::{Basis, in_turn};
use super::matrix::{Band, DIAGONALS, Matrix, dot};
use jred_file::math;

/// The test functions of a log.
#[derive(Clone, Debug)]
pub(super) struct Weak {
    /// Samples between knots.
    pub(super) spacing: usize,
    step: f64,
    /// Number of test functions: function i covers the samples from i·spacing on.
    pub(super) count: usize,
    /// w, ẇ, ẅ at the samples of the support, times the step.
    weights: [Vec<f64>; 3],
}

/// The quintic B-spline with knots at −3…3, differentiated `times` times.
fn spline(u: f64, times: usize) -> f64 {
    // Of the left half only, whose terms do not cancel.
    let flip = if u > 0.0 && times % 2 == 1 { -1.0 } else { 1.0 };
    let left = -u.abs();
    let degree = 5 - times;
    let factorial: f64 = (1..=degree).map(|k| k as f64).product();
    let binomials = [1.0, -6.0, 15.0, -20.0];
    let terms = binomials.iter().enumerate().map(|(k, b)| {
        let from = left + 3.0 - k as f64;
        if from > 0.0 {
            b * from.powi(degree as i32)
        } else {
            0.0
        }
    });
    flip * terms.sum::<f64>() / factorial
}

/// The number of test functions.
pub(super) fn number(samples: usize, spacing: usize) -> usize {
    (samples / spacing).saturating_sub(DIAGONALS)
}

impl Weak {
    pub(super) fn new(samples: usize, spacing: usize, step: f64) -> Self {
        let weak = Self {
            spacing,
            step,
            count: number(samples, spacing),
            weights: Default::default(),
        };
        Self {
            weights: [0, 1, 2].map(|times| weak.shifted(0.0, times)),
            ..weak
        }
    }

    /// Distance of the knots (s).
    pub(super) fn knots(&self) -> f64 {
        self.spacing as f64 * self.step
    }

    /// The weights of the support's samples, of a test function that is later by `by` samples.
    fn shifted(&self, by: f64, times: usize) -> Vec<f64> {
        let scale = self.step / self.knots().powi(times as i32);
        (0..DIAGONALS * self.spacing)
            .map(|l| scale * spline((l as f64 - by) / self.spacing as f64 - 3.0, times))
            .collect()
    }

    /// Calls with the number of each test function that has sample `k`, and the sample's place in it.
    fn each(&self, k: usize, mut call: impl FnMut(usize, usize)) {
        let block = k / self.spacing;
        let first = block.saturating_sub(DIAGONALS - 1);
        for i in first..self.count.min(block + 1) {
            call(i, k - i * self.spacing);
        }
    }

    /// Number of samples that some test function has.
    fn covered(&self) -> usize {
        (self.count + DIAGONALS - 1) * self.spacing
    }

    /// The rows of the unknowns, from a position and a speed.
    pub(super) fn rows(&self, basis: &Basis, position: &[f64], speed: &[f64]) -> Matrix {
        let unknowns = basis.unknowns();
        let [w, w1, w2] = &self.weights;
        let mut rows = Matrix::zeros(self.count, unknowns);
        let first = position.first().copied().unwrap_or_default();
        let (mut of_w, mut of_w2) = (vec![0.0; unknowns], vec![0.0; basis.inertias()]);
        let mut waves = Vec::new();
        let (viscous, coulomb) = (basis.viscous(), basis.coulomb());
        for (k, (phi, omega)) in position.iter().zip(speed).enumerate().take(self.covered()) {
            basis.harmonics_at(*phi, &mut waves);
            let half_square = 0.5 * omega * omega;
            of_w2[0] = phi - first;
            for (m, [c, s]) in waves.iter().enumerate().skip(1) {
                let order = m as f64;
                of_w2[2 * m - 1] = s / order;
                of_w2[2 * m] = -c / order;
                of_w[2 * m - 1] = s * half_square * order;
                of_w[2 * m] = -c * half_square * order;
                of_w[basis.potential() + 2 * m - 2] = *c;
                of_w[basis.potential() + 2 * m - 1] = *s;
            }
            if basis.mean {
                of_w[basis.mean_load()] = 1.0;
            }
            let sign = if *omega == 0.0 { 0.0 } else { omega.signum() };
            of_w[coulomb] = sign;
            if !basis.shape.is_empty() {
                of_w[coulomb + 1] = sign * in_turn(&basis.shape, *phi)[0];
            }
            let of_c = of_w[basis.coulomb_waves()..].chunks_mut(2);
            for (into, [c, s]) in of_c.zip(waves.iter().skip(1)).take(basis.friction) {
                into.copy_from_slice(&[sign * c, sign * s]);
            }
            for (q, at) in basis.cogging.iter().zip(0..) {
                let (s, c) = math::sin_cos(f64::from(*q) * phi);
                of_w[basis.cog() + 2 * at] = c;
                of_w[basis.cog() + 2 * at + 1] = s;
            }
            self.each(k, |i, l| {
                let row = rows.row_mut(i);
                for (into, x) in row.iter_mut().zip(&of_w2) {
                    *into += w2[l] * x;
                }
                for (into, x) in row.iter_mut().zip(&of_w) {
                    *into += w[l] * x;
                }
                row[viscous] -= w1[l] * (phi - first);
            });
        }
        rows
    }

    /// The integral of the torque, whose samples are late by `delay`, and its derivative by that delay. The test function moves.
    pub(super) fn torque(&self, torque: &[f64], delay: f64) -> [Vec<f64>; 2] {
        let whole = (delay / self.step).floor();
        let part = delay / self.step - whole;
        let [w, w1] = [0, 1].map(|times| self.shifted(part, times));
        let (mut sum, mut slope) = (vec![0.0; self.count], vec![0.0; self.count]);
        for k in 0..self.covered() {
            let at = k as isize + whole as isize;
            let value = usize::try_from(at).ok().and_then(|at| torque.get(at));
            let Some(value) = value else { continue };
            self.each(k, |i, l| {
                sum[i] += w[l] * value;
                slope[i] -= w1[l] * value;
            });
        }
        [sum, slope]
    }

    /// The effect of a position error at each sample of a test function's support on its row.
    pub(super) fn position_errors(
        &self,
        basis: &Basis,
        theta: &[f64],
        motion: &super::smooth::Smooth,
    ) -> Matrix {
        let [w, w1, w2] = &self.weights;
        let mut rows = Matrix::zeros(self.count, DIAGONALS * self.spacing);
        let mut waves = Vec::new();
        let moving = motion.position.iter().zip(&motion.speed);
        let moving = moving.zip(&motion.acceleration).enumerate();
        for (k, ((phi, omega), alpha)) in moving.take(self.covered()) {
            basis.harmonics_at(*phi, &mut waves);
            let at = basis.at(theta, &waves, *phi);
            let first = at.inertia_slope * omega - theta[basis.viscous()];
            let zeroth = at.inertia_slope * alpha
                + 0.5 * at.inertia_curvature * omega * omega
                + at.stiffness
                + at.friction_slope * omega.signum();
            self.each(k, |i, l| {
                rows.row_mut(i)[l] = at.inertia * w2[l] + first * w1[l] + zeroth * w[l];
            });
        }
        rows
    }

    /// Covariance of the rows by position errors of unit variance.
    pub(super) fn position_band(&self, errors: &Matrix) -> Band {
        let band = |i: usize| {
            std::array::from_fn(|l| {
                let shared = (DIAGONALS - l) * self.spacing;
                if l > i {
                    0.0
                } else {
                    dot(
                        &errors.row(i - l)[l * self.spacing..],
                        &errors.row(i)[..shared],
                    )
                }
            })
        };
        (0..self.count).map(band).collect()
    }

    /// Covariance of the rows by torque errors of unit variance, by the distance of the rows.
    pub(super) fn torque_band(&self) -> [f64; DIAGONALS] {
        let w = &self.weights[0];
        std::array::from_fn(|l| dot(&w[l * self.spacing..], &w[..(DIAGONALS - l) * self.spacing]))
    }

    /// Which rows have a sample, within `near` samples of their support, that is marked.
    pub(super) fn touched(&self, marked: impl Iterator<Item = bool>, near: usize) -> Vec<bool> {
        let mut before = vec![0usize];
        let mut sum = 0;
        before.extend(marked.map(|marked| {
            sum += usize::from(marked);
            sum
        }));
        let last = before.len() - 1;
        let row = |i: usize| {
            let (from, to) = (
                (i * self.spacing).saturating_sub(near),
                (i + DIAGONALS) * self.spacing + near,
            );
            before[to.min(last)] > before[from.min(last)]
        };
        (0..self.count).map(row).collect()
    }
}
