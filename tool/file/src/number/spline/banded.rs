//! Linear equations in which each unknown is coupled to its two neighbours on either side; in a ring, the last unknowns are coupled to the first.

/// The equations: coefficients at the offsets −2 to 2 from the diagonal, and the right side.
pub(super) struct System {
    pub(super) rows: Vec<[f64; 5]>,
    pub(super) right: Vec<f64>,
}

/// Simultaneous right sides: the given one, and the columns of the two unknowns that close a ring.
type RightSides = [f64; 3];

impl System {
    /// The unknowns of an open chain: coefficients beyond the first or the last unknown must be zero. Gaussian elimination without exchange of rows:
    /// the matrices here are diagonally dominant or definite, except for the two rows at the ends of a not-a-knot spline, whose first pivots are
    /// steps.
    pub(super) fn solve(self) -> Vec<f64> {
        let right = self.right.iter().map(|r| [*r, 0.0, 0.0]).collect();
        let solution = eliminate(self.rows, right);
        solution.into_iter().map(|s| s[0]).collect()
    }

    /// The unknowns of a ring of at least four: the open chain is solved for given last two unknowns, which then follow from the last two rows.
    pub(super) fn solve_ring(self) -> Vec<f64> {
        let n = self.rows.len();
        let open = n - 2;
        let mut rows = Vec::with_capacity(open);
        let mut right: Vec<RightSides> = Vec::with_capacity(open);
        for (k, row) in self.rows.iter().enumerate().take(open) {
            let mut inner = [0.0; 5];
            let mut carried = [self.right[k], 0.0, 0.0];
            for (offset, value) in row.iter().enumerate() {
                let column = (k + n + offset - 2) % n;
                match column.checked_sub(open) {
                    Some(last) => carried[1 + last] -= value,
                    None => inner[offset] += value,
                }
            }
            rows.push(inner);
            right.push(carried);
        }
        let chain = eliminate(rows, right);
        // Each of the last two rows after substituting the chain: a·p + b·q = r.
        let closing = [open, open + 1].map(|k| {
            let mut equation = [0.0, 0.0, self.right[k]];
            for (offset, value) in self.rows[k].iter().enumerate() {
                let column = (k + n + offset - 2) % n;
                if let Some(last) = column.checked_sub(open) {
                    equation[last] += value;
                } else {
                    let [given, p, q] = chain[column];
                    equation[0] += value * p;
                    equation[1] += value * q;
                    equation[2] -= value * given;
                }
            }
            equation
        });
        let [[a, b, r], [c, d, s]] = closing;
        let determinant = a * d - b * c;
        let (p, q) = ((r * d - b * s) / determinant, (a * s - r * c) / determinant);
        let mut solution: Vec<f64> = chain
            .iter()
            .map(|[given, by_p, by_q]| given + by_p * p + by_q * q)
            .collect();
        solution.extend([p, q]);
        solution
    }
}

/// Gaussian elimination of an open chain.
fn eliminate(mut rows: Vec<[f64; 5]>, mut right: Vec<RightSides>) -> Vec<RightSides> {
    let n = rows.len();
    for k in 0..n {
        let (pivot, top) = (rows[k], right[k]);
        for below in 1..=2.min(n - 1 - k) {
            let row = &mut rows[k + below];
            let factor = row[2 - below] / pivot[2];
            for offset in 0..=2 {
                row[2 - below + offset] -= factor * pivot[2 + offset];
            }
            for (value, above) in right[k + below].iter_mut().zip(top) {
                *value -= factor * above;
            }
        }
    }
    for k in (0..n).rev() {
        for ahead in 1..=2.min(n - 1 - k) {
            let (factor, known) = (rows[k][2 + ahead], right[k + ahead]);
            for (value, known) in right[k].iter_mut().zip(known) {
                *value -= factor * known;
            }
        }
        let pivot = rows[k][2];
        for value in &mut right[k] {
            *value /= pivot;
        }
    }
    right
}
