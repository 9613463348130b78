//! Linear systems with interval coefficients, preconditioned by an approximate inverse.

use crate::interval::Interval;

/// A square matrix, row by row.
#[derive(Clone, Debug)]
pub(crate) struct Matrix<T> {
    pub(crate) size: usize,
    pub(crate) entries: Vec<T>,
}

impl<T: Copy> Matrix<T> {
    pub(crate) fn new(size: usize, entry: T) -> Self {
        Self {
            size,
            entries: vec![entry; size * size],
        }
    }

    pub(crate) fn row(&self, row: usize) -> &[T] {
        &self.entries[row * self.size..(row + 1) * self.size]
    }

    pub(crate) fn set(&mut self, row: usize, column: usize, entry: T) {
        self.entries[row * self.size + column] = entry;
    }
}

impl Matrix<Interval> {
    /// An approximate inverse of the middles, by elimination with the largest pivots; `None` if singular.
    pub(crate) fn inverse(&self) -> Option<Matrix<f64>> {
        let n = self.size;
        let mut left: Vec<f64> = self.entries.iter().map(|a| a.middle()).collect();
        let mut right = Matrix::new(n, 0.0);
        for k in 0..n {
            right.set(k, k, 1.0);
        }
        for k in 0..n {
            let size = |row: &usize| left[row * n + k].abs();
            let pivot = (k..n).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            if left[pivot * n + k].abs() < 1e-300 {
                return None;
            }
            for column in 0..n {
                left.swap(k * n + column, pivot * n + column);
                right.entries.swap(k * n + column, pivot * n + column);
            }
            let scale = 1.0 / left[k * n + k];
            for column in 0..n {
                left[k * n + column] *= scale;
                right.entries[k * n + column] *= scale;
            }
            for row in (0..n).filter(|row| *row != k) {
                let factor = left[row * n + k];
                if factor == 0.0 {
                    continue;
                }
                for column in 0..n {
                    left[row * n + column] -= factor * left[k * n + column];
                    right.entries[row * n + column] -= factor * right.entries[k * n + column];
                }
            }
        }
        right.entries.iter().all(|a| a.is_finite()).then_some(right)
    }
}

/// The systems A·x = b for all matrices A of an interval matrix.
pub(crate) struct Solver {
    inverse: Matrix<f64>,
    /// 1 − Y·A.
    rest: Matrix<Interval>,
}

impl Solver {
    /// A solver with an approximate inverse Y.
    pub(crate) fn new(inverse: Matrix<f64>, matrix: &Matrix<Interval>) -> Self {
        let n = matrix.size;
        let mut rest = Matrix::new(n, Interval::ZERO);
        for row in 0..n {
            let mut sums = vec![Interval::ZERO; n];
            sums[row] = Interval::ONE;
            for (k, y) in inverse.row(row).iter().enumerate() {
                if *y == 0.0 {
                    continue;
                }
                for (sum, a) in sums.iter_mut().zip(matrix.row(k)) {
                    if *a != Interval::ZERO {
                        *sum = *sum - *a * *y;
                    }
                }
            }
            rest.entries[row * n..(row + 1) * n].copy_from_slice(&sums);
        }
        Self { inverse, rest }
    }

    /// Y·b
    pub(crate) fn approximate(&self, b: &[Interval]) -> Vec<Interval> {
        let rows = (0..self.inverse.size).map(|row| {
            let products = self.inverse.row(row).iter().zip(b);
            products.fold(Interval::ZERO, |sum, (y, b)| sum + *b * *y)
        });
        rows.collect()
    }

    /// (1 − Y·A)·x
    pub(crate) fn rest(&self, x: &[Interval]) -> Vec<Interval> {
        let rows = (0..self.rest.size).map(|row| {
            let products = self.rest.row(row).iter().zip(x);
            products.fold(Interval::ZERO, |sum, (e, x)| sum + *e * *x)
        });
        rows.collect()
    }

    /// All solutions for right-hand sides in `b`; `units` are the scales of the unknowns, in which 1 − Y·A is measured. `None` if the matrix may be
    /// singular.
    pub(crate) fn solve(&self, b: &[Interval], units: &[f64]) -> Option<Vec<Interval>> {
        /// Number of iterations x = Y·b + (1 − Y·A)·x, which narrow the solution.
        const STEPS: usize = 2;
        let start = self.approximate(b);
        let in_units = |x: &[f64], row: usize| {
            let sum: f64 = x.iter().zip(units).map(|(x, unit)| x * unit).sum();
            sum / units[row] * (1.0 + 1e-12)
        };
        let mut norm = 0.0_f64;
        for row in 0..self.rest.size {
            let sizes: Vec<f64> = self.rest.row(row).iter().map(|e| e.size()).collect();
            let here = in_units(&sizes, row);
            // NaN does not contract.
            let contracts = here < 0.9;
            if !contracts {
                return None;
            }
            norm = norm.max(here);
        }
        let sizes = start.iter().zip(units).map(|(x, unit)| x.size() / unit);
        let most = sizes.fold(0.0, f64::max) / (1.0 - norm) * (1.0 + 1e-12);
        let within = |unit: &f64| Interval::within((most * unit).next_up());
        let mut x: Vec<Interval> = units.iter().map(within).collect();
        for _ in 0..STEPS {
            let rest = self.rest(&x);
            for ((x, start), rest) in x.iter_mut().zip(&start).zip(rest) {
                *x = (*start + rest).and(*x);
            }
        }
        Some(x)
    }
}
