//! How many harmonics the rows of a fit show.

use super::basis::Basis;
use super::fit::Fit;
use super::matrix::{Matrix, dot};
use super::solution::{Unfit, solve};

/// Number of harmonics that are tested together.
const NEXT: usize = 4;

/// The least number of harmonics of J and V′ before those that are tested, and how many are kept of those that were not significant.
const FROM: usize = 3;
const MORE: usize = 2;

impl Fit {
    /// The same rows with this basis of fewer harmonics.
    pub(super) fn subset(mut self, basis: Basis) -> Result<Self, Unfit> {
        let columns = self.columns_of(&basis);
        self.whitened = self.whitened.select(&columns);
        self.instruments = self.instruments.select(&columns);
        let used = self.used();
        let mut found = solve(&self.whitened, &self.instruments, &self.right, used)?;
        if self.delay_free {
            self.delay = self.delay_of_rows + found.theta.pop().unwrap_or_default();
        }
        self.basis = basis;
        self.theta = found.theta;
        self.misfit = found.misfit;
        self.covariances = found.covariances;
        self.residuals = found.residuals;
        Ok(self)
    }

    /// The columns of a basis with fewer harmonics, and that of the delay.
    fn columns_of(&self, fewer: &Basis) -> Vec<usize> {
        let mut columns = self.basis.columns_of(fewer);
        if self.delay_free {
            columns.push(self.basis.unknowns());
        }
        columns
    }

    /// The basis with the smallest numbers of harmonics, of J and V′, then of c, whose next ones are jointly insignificant (Wald), and two more. Without
    /// a significant one c is constant.
    pub(super) fn order(&self) -> Basis {
        let tests = Tests::new(self);
        let basis = &self.basis;
        let most = basis.harmonics;
        let first = FROM.max(basis.least);
        let found = (first..most).find(|&harmonics| {
            let wide = basis.with_harmonics((harmonics + NEXT).min(most));
            let potential = wide.potential();
            let tested: Vec<usize> = (1 + 2 * harmonics..potential)
                .chain(potential + 2 * harmonics..wide.mean_load())
                .collect();
            tests.insignificant(&wide, &tested)
        });
        let basis = basis.with_harmonics(found.map_or(most, |k| (k + MORE).min(most)));
        let most = basis.friction;
        let found = (0..most).find(|&friction| {
            let wide = basis.with_friction((friction + NEXT).min(most));
            let tested: Vec<usize> = (wide.coulomb_waves() + 2 * friction..wide.cog()).collect();
            tests.insignificant(&wide, &tested)
        });
        basis.with_friction(match found {
            Some(0) => 0,
            Some(friction) => (friction + MORE).min(most),
            None => most,
        })
    }
}

/// Tests of unknowns of a fit.
struct Tests<'f> {
    fit: &'f Fit,
    normal: Matrix,
    spread: Matrix,
    right: Vec<f64>,
}

impl<'f> Tests<'f> {
    fn new(fit: &'f Fit) -> Self {
        Self {
            fit,
            normal: fit.instruments.transposed_product(&fit.whitened),
            spread: fit.instruments.transposed_product(&fit.instruments),
            right: fit.instruments.transposed_times(&fit.right),
        }
    }

    /// Whether these unknowns of a basis are jointly insignificant (Wald).
    fn insignificant(&self, basis: &Basis, tested: &[usize]) -> bool {
        let columns = self.fit.columns_of(basis);
        let Some(inverse) = self.normal.block(&columns).inverse() else {
            return false;
        };
        let shown: Vec<f64> = columns.iter().map(|&c| self.right[c]).collect();
        let theta = inverse.times(&shown);
        let covariance = inverse.congruence(&self.spread.block(&columns));
        let values: Vec<f64> = tested.iter().map(|&i| theta[i]).collect();
        let Some(weight) = covariance.block(tested).inverse() else {
            return false;
        };
        let wald = dot(&values, &weight.times(&values)) / self.fit.misfit.max(1.0);
        let count = tested.len() as f64;
        wald < count + 2.5 * (2.0 * count).sqrt()
    }
}
