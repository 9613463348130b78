//! Symmetric linear equations in skyline storage: each row is kept from its first entry.
//!
//! Factored as L·D·Lᵀ without exchange of rows: O(n·b²) where a row begins b places before the diagonal. Full rows at the end (closing a ring, the
//! condition of the time) cost O(n·b) each. The signs of D are the inertia of the matrix.

/// The lower half of a symmetric matrix.
#[derive(Clone, Debug)]
pub(crate) struct Skyline {
    /// First column of each row.
    first: Vec<usize>,
    /// Start of each row in `values`; one more than the number of rows.
    start: Vec<usize>,
    values: Vec<f64>,
}

impl Skyline {
    /// A matrix of zeros whose rows begin in these columns.
    pub(crate) fn new(first: Vec<usize>) -> Self {
        let mut start = vec![0];
        let mut end = 0;
        for (row, first) in first.iter().enumerate() {
            end += row + 1 - first;
            start.push(end);
        }
        Self {
            first,
            start,
            values: vec![0.0; end],
        }
    }

    /// Sets all entries to zero.
    pub(crate) fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Adds to an entry, and to its mirror image.
    pub(crate) fn add(&mut self, i: usize, j: usize, value: f64) {
        let (row, column) = (i.max(j), i.min(j));
        self.values[self.start[row] + column - self.first[row]] += value;
    }

    pub(crate) fn diagonal(&self) -> impl Iterator<Item = f64> + '_ {
        self.start.iter().skip(1).map(|end| self.values[end - 1])
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.values[self.start[row]..self.start[row + 1]]
    }

    /// The factors, and the number of negative pivots; `None` if a pivot is zero or NaN.
    pub(crate) fn factor(mut self) -> Option<(Factors, usize)> {
        let mut negative = 0;
        for i in 0..self.first.len() {
            let first = self.first[i];
            let (before, rest) = self.values.split_at_mut(self.start[i]);
            let row = &mut rest[..=i - first];
            // Row of L·D, column by column.
            for j in first..i {
                let other = &before[self.start[j]..self.start[j + 1]];
                let from = first.max(self.first[j]);
                let mine = &row[from - first..j - first];
                let theirs = &other[from - self.first[j]..j - self.first[j]];
                let sum: f64 = mine.iter().zip(theirs).map(|(a, b)| a * b).sum();
                row[j - first] -= sum;
            }
            // Its pivot, and the row of L.
            let mut pivot = row[i - first];
            for j in first..i {
                let by_pivot = row[j - first];
                let entry = by_pivot / before[self.start[j + 1] - 1];
                pivot -= entry * by_pivot;
                row[j - first] = entry;
            }
            row[i - first] = pivot;
            if pivot == 0.0 || !pivot.is_finite() {
                return None;
            }
            negative += usize::from(pivot < 0.0);
        }
        Some((Factors(self), negative))
    }
}

/// L and D of a factored matrix.
#[derive(Clone, Debug)]
pub(crate) struct Factors(Skyline);

impl Factors {
    /// Solves for one right side.
    pub(crate) fn solve(&self, right: &mut [f64]) {
        let Self(matrix) = self;
        let rows = matrix.first.len();
        for i in 0..rows {
            let first = matrix.first[i];
            let row = matrix.row(i);
            let sum: f64 = row.iter().zip(&right[first..i]).map(|(l, x)| l * x).sum();
            right[i] -= sum;
        }
        for (x, pivot) in right.iter_mut().zip(matrix.diagonal()) {
            *x /= pivot;
        }
        for i in (0..rows).rev() {
            let (first, known) = (matrix.first[i], right[i]);
            for (x, l) in right[first..i].iter_mut().zip(matrix.row(i)) {
                *x -= l * known;
            }
        }
    }
}

#[cfg(test)]
#[expect(
    clippy::disallowed_methods,
    reason = "functions of another library than the code's"
)]
mod tests {
    use super::Skyline;

    /// A ring of ten with a full last row, indefinite. The solution reproduces the right side. The signs of the pivots are those of the eigenvalues,
    /// of which the border makes one negative.
    #[test]
    fn a_bordered_band_is_solved() {
        let n = 11;
        let first = (0..n).map(|i: usize| if i < 9 { i.saturating_sub(2) } else { 0 });
        let mut matrix = Skyline::new(first.collect());
        let mut full = vec![vec![0.0; n]; n];
        let mut add = |i: usize, j: usize, value: f64| {
            matrix.add(i, j, value);
            full[i][j] = value;
            full[j][i] = value;
        };
        for i in 0..10 {
            add(i, i, 5.0 + i as f64);
            if i > 0 {
                add(i, i - 1, 1.5);
            }
            if i > 1 {
                add(i, i - 2, -0.7);
            }
            add(10, i, 0.3 + 0.1 * i as f64);
        }
        add(9, 0, 0.9);
        let right: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let mut x = right.clone();
        let (factors, negative) = matrix.factor().unwrap();
        factors.solve(&mut x);
        assert_eq!(negative, 1);
        for (row, right) in full.iter().zip(&right) {
            let sum: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
            assert!((sum - right).abs() < 1e-13, "{sum}, not {right}");
        }
    }
}
