//! Small dense linear systems on borrowed memory: Gaussian elimination with row pivoting.
//!
//! Not from a library: a linkage solves systems of one to a dozen equations in slices of its own memory, whose size depends on the mechanism, and a
//! matrix library would be most of the code that firmware compiles for it. Elimination with the largest pivot of the column gives the exact solution
//! of a system whose coefficients differ from the given ones by a few units of the last place (N. J. Higham, *Accuracy and Stability of Numerical
//! Algorithms*, 9.3).

/// Factors the n × n matrix `a` (column-major) in place; n is the length of `pivots`. Returns its determinant; at zero a pivot vanishes, and the
/// factors must not be used.
pub(crate) fn factor(a: &mut [f64], pivots: &mut [usize]) -> f64 {
    let n = pivots.len();
    let mut determinant = 1.0;
    for (k, place) in pivots.iter_mut().enumerate() {
        let pivot = k + largest(&a[n * k + k..n * (k + 1)]);
        *place = pivot;
        if pivot != k {
            determinant = -determinant;
            for column in a.chunks_exact_mut(n) {
                column.swap(k, pivot);
            }
        }
        let (before, after) = a.split_at_mut(n * (k + 1));
        let Some((diagonal, below)) = before[n * k + k..].split_first_mut() else {
            return 0.0;
        };
        if *diagonal == 0.0 {
            return 0.0;
        }
        determinant *= *diagonal;
        let inverse = 1.0 / *diagonal;
        for share in &mut *below {
            *share *= inverse;
        }
        for column in after.chunks_exact_mut(n) {
            eliminate(&mut column[k..], below);
        }
    }
    determinant
}

/// Solves for the right-hand side `b`, in place, with the factors from [`factor`].
pub(crate) fn solve(factors: &[f64], pivots: &[usize], b: &mut [f64]) {
    let n = pivots.len();
    for (k, &pivot) in pivots.iter().enumerate() {
        b.swap(k, pivot);
    }
    for (k, column) in factors.chunks_exact(n.max(1)).enumerate() {
        eliminate(&mut b[k..], &column[k + 1..]);
    }
    for (k, column) in factors.chunks_exact(n.max(1)).enumerate().rev() {
        b[k] /= column[k];
        let (above, found) = b.split_at_mut(k);
        subtract(above, found[0], column);
    }
}

/// Subtracts the first element's row, in the given shares, from the rows below it.
fn eliminate(column: &mut [f64], shares: &[f64]) {
    if let Some((&mut first, rest)) = column.split_first_mut() {
        subtract(rest, first, shares);
    }
}

fn subtract(from: &mut [f64], factor: f64, shares: &[f64]) {
    for (x, share) in from.iter_mut().zip(shares) {
        *x -= factor * share;
    }
}

/// Index of the element of largest magnitude.
fn largest(column: &[f64]) -> usize {
    let mut found = (0, 0.0);
    for (index, x) in column.iter().enumerate() {
        if x.abs() > found.1 {
            found = (index, x.abs());
        }
    }
    found.0
}
