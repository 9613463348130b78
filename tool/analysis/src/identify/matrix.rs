//! A small dense matrix, and the Cholesky factor of a banded one.

/// A dense matrix, row by row.
#[derive(Clone, Debug)]
pub(super) struct Matrix {
    columns: usize,
    data: Vec<f64>,
}

impl Matrix {
    pub(super) fn zeros(rows: usize, columns: usize) -> Self {
        Self {
            columns,
            data: vec![0.0; rows * columns],
        }
    }

    pub(super) fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.data.chunks_exact(self.columns)
    }

    pub(super) fn rows_mut(&mut self) -> impl Iterator<Item = &mut [f64]> {
        self.data.chunks_exact_mut(self.columns)
    }

    pub(super) const fn columns(&self) -> usize {
        self.columns
    }

    pub(super) fn row(&self, i: usize) -> &[f64] {
        &self.data[i * self.columns..][..self.columns]
    }

    pub(super) fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.data[i * self.columns..][..self.columns]
    }

    pub(super) fn at(&self, i: usize, k: usize) -> f64 {
        self.data[i * self.columns + k]
    }

    /// These columns, in this order.
    pub(super) fn select(&self, columns: &[usize]) -> Self {
        let rows = self.rows();
        Self {
            columns: columns.len(),
            data: rows
                .flat_map(|row| columns.iter().map(|&k| row[k]))
                .collect(),
        }
    }

    /// These rows and columns.
    pub(super) fn block(&self, which: &[usize]) -> Self {
        let rows = which.iter();
        Self {
            columns: which.len(),
            data: rows
                .flat_map(|&i| which.iter().map(move |&k| self.at(i, k)))
                .collect(),
        }
    }

    /// With one more column.
    pub(super) fn beside(&self, column: &[f64]) -> Self {
        let rows = self.rows().zip(column);
        Self {
            columns: self.columns + 1,
            data: rows
                .flat_map(|(row, last)| row.iter().copied().chain([*last]))
                .collect(),
        }
    }

    /// A·x.
    pub(super) fn times(&self, x: &[f64]) -> Vec<f64> {
        self.rows().map(|row| dot(row, x)).collect()
    }

    /// Aᵀ·x.
    pub(super) fn transposed_times(&self, x: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.columns];
        for (row, x) in self.rows().zip(x) {
            add(&mut sum, *x, row);
        }
        sum
    }

    /// Aᵀ·B.
    pub(super) fn transposed_product(&self, other: &Self) -> Self {
        let mut sum = Self::zeros(self.columns, other.columns);
        for (row, others) in self.rows().zip(other.rows()) {
            for (into, a) in sum.rows_mut().zip(row) {
                add(into, *a, others);
            }
        }
        sum
    }

    /// Takes A·B away.
    pub(super) fn subtract_product(&mut self, a: &Self, b: &Self) {
        for (into, factors) in self.rows_mut().zip(a.rows()) {
            for (factor, row) in factors.iter().zip(b.rows()) {
                add(into, -factor, row);
            }
        }
    }

    /// A·S·Aᵀ of a square S.
    pub(super) fn congruence(&self, inner: &Self) -> Self {
        let rows: Vec<Vec<f64>> = self.rows().map(|a| inner.transposed_times(a)).collect();
        let data = rows.iter().flat_map(|left| self.times(left)).collect();
        Self {
            columns: self.data.len() / self.columns,
            data,
        }
    }

    /// The inverse of a square matrix, by Gauss-Jordan elimination with row pivots after both sides are scaled by the square root of the diagonal.
    /// `None` if it is singular to working precision.
    pub(super) fn inverse(&self) -> Option<Self> {
        let n = self.columns;
        let scale: Vec<f64> = (0..n)
            .map(|k| self.at(k, k).abs().sqrt() + 1e-300)
            .collect();
        let mut wide = Self::zeros(n, 2 * n);
        for i in 0..n {
            for k in 0..n {
                wide.row_mut(i)[k] = self.at(i, k) / scale[i] / scale[k];
            }
            wide.row_mut(i)[n + i] = 1.0;
        }
        for k in 0..n {
            let size = |i: &usize| wide.at(*i, k).abs();
            let best = (k..n).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            let pivot = wide.at(best, k);
            if pivot.is_nan() || pivot.abs() <= 1e-14 {
                return None;
            }
            let chosen: Vec<f64> = wide.row(best).iter().map(|x| x / pivot).collect();
            if best != k {
                let moved = wide.row(k).to_vec();
                wide.row_mut(best).copy_from_slice(&moved);
            }
            for (i, row) in wide.rows_mut().enumerate() {
                if i == k {
                    row.copy_from_slice(&chosen);
                } else {
                    let factor = -row[k];
                    add(row, factor, &chosen);
                }
            }
        }
        let mut inverse = Self::zeros(n, n);
        for i in 0..n {
            for k in 0..n {
                inverse.row_mut(i)[k] = wide.at(i, n + k) / scale[i] / scale[k];
            }
        }
        Some(inverse)
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(into: &mut [f64], factor: f64, row: &[f64]) {
    for (into, x) in into.iter_mut().zip(row) {
        *into += factor * x;
    }
}

/// Number of diagonals, the main one and those below it.
pub(super) const DIAGONALS: usize = 6;

/// A symmetric banded matrix: `[i][l]` is the element (i, i − l).
pub(super) type Band = Vec<[f64; DIAGONALS]>;

/// The factor L of C = LLᵀ; `None` if C is not positive definite.
pub(super) fn factor(band: &[[f64; DIAGONALS]]) -> Option<Band> {
    let mut lower: Band = Vec::with_capacity(band.len());
    for (i, row) in band.iter().enumerate() {
        let mut here = [0.0; DIAGONALS];
        for l in (0..DIAGONALS.min(i + 1)).rev() {
            let mut rest = row[l];
            for k in l + 1..DIAGONALS.min(i + 1) {
                let above = if l == 0 { here[k] } else { lower[i - l][k - l] };
                rest -= here[k] * above;
            }
            here[l] = if l > 0 {
                rest / lower[i - l][0]
            } else if rest > 0.0 {
                rest.sqrt()
            } else {
                return None;
            };
        }
        lower.push(here);
    }
    Some(lower)
}

/// L⁻¹·A, in place.
pub(super) fn whiten(lower: &[[f64; DIAGONALS]], matrix: &mut Matrix) {
    let columns = matrix.columns;
    for (i, row) in lower.iter().enumerate() {
        let (before, rest) = matrix.data.split_at_mut(i * columns);
        let here = &mut rest[..columns];
        for (l, factor) in row.iter().enumerate().skip(1).take(i) {
            add(here, -factor, &before[(i - l) * columns..][..columns]);
        }
        for x in here {
            *x /= row[0];
        }
    }
}
