//! Small dense linear systems on borrowed memory: LU factors with row pivoting, by `nalgebra`'s elimination steps.

use nalgebra::linalg::{gauss_step, gauss_step_swap};
use nalgebra::{DMatrixView, DMatrixViewMut, DVectorViewMut};

/// Factors the n × n matrix `a` (column-major) in place; n is the length of `pivots`. Returns its determinant: zero where
/// a pivot vanishes, and then the factors are of no use.
pub(crate) fn factor(a: &mut [f64], pivots: &mut [usize]) -> f64 {
    // Most groups of a linkage are a single equation.
    if let ([a], [pivot]) = (&*a, &mut *pivots) {
        *pivot = 0;
        return *a;
    }
    let n = pivots.len();
    let mut a = DMatrixViewMut::from_slice(a, n, n);
    let mut determinant = 1.0;
    for (k, pivot) in pivots.iter_mut().enumerate() {
        *pivot = a.view_range(k.., k).icamax() + k;
        let diagonal = a[(*pivot, k)];
        if diagonal == 0.0 {
            return 0.0;
        }
        determinant *= diagonal;
        if *pivot == k {
            gauss_step(&mut a, diagonal, k);
        } else {
            determinant = -determinant;
            a.columns_range_mut(..k).swap_rows(k, *pivot);
            gauss_step_swap(&mut a, diagonal, k, *pivot);
        }
    }
    determinant
}

/// Solves for the right-hand side `b`, in place, with the factors that [`factor`] left.
pub(crate) fn solve(factors: &[f64], pivots: &[usize], b: &mut [f64]) {
    if let ([a], [b]) = (factors, &mut *b) {
        *b /= a;
        return;
    }
    let n = pivots.len();
    let factors = DMatrixView::from_slice(factors, n, n);
    let mut b = DVectorViewMut::from_slice(b, n);
    for (k, &pivot) in pivots.iter().enumerate() {
        b.swap_rows(k, pivot);
    }
    // Cannot fail: the diagonal of the lower factor is one, and no pivot was zero.
    let _ = factors.solve_lower_triangular_with_diag_mut(&mut b, 1.0);
    let _ = factors.solve_upper_triangular_mut(&mut b);
}
