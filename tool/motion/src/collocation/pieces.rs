//! Values at the ends of a path's elements, and the cubic through those of one element.

/// A value at an end of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Value {
    /// An unknown.
    Free(usize),
    /// Given.
    Fixed(f64),
}

impl Value {
    /// The value for these unknowns.
    pub(crate) fn of(self, x: &[f64]) -> f64 {
        match self {
            Self::Free(index) => x[index],
            Self::Fixed(value) => value,
        }
    }

    const fn unknown(self) -> Option<usize> {
        match self {
            Self::Free(index) => Some(index),
            Self::Fixed(_) => None,
        }
    }
}

/// First nonzero column of each row of a matrix over n unknowns, where the unknowns of one element are coupled.
pub(crate) fn first_columns<'v>(
    unknowns: usize,
    elements: impl Iterator<Item = &'v [Value]>,
) -> Vec<usize> {
    let mut first: Vec<usize> = (0..unknowns).collect();
    for values in elements {
        let free = || values.iter().filter_map(|value| value.unknown());
        let least = free().min().unwrap_or(0);
        for index in free() {
            first[index] = first[index].min(least);
        }
    }
    first
}

/// Coefficients of an element's four values (length h) in w, w′ and w″ at its share z.
pub(crate) fn hermite(z: f64, h: f64) -> [[f64; 4]; 3] {
    let z2 = z * z;
    let z3 = z2 * z;
    [
        [
            2.0 * z3 - 3.0 * z2 + 1.0,
            h * (z3 - 2.0 * z2 + z),
            3.0 * z2 - 2.0 * z3,
            h * (z3 - z2),
        ],
        [
            6.0 * (z2 - z) / h,
            3.0 * z2 - 4.0 * z + 1.0,
            6.0 * (z - z2) / h,
            3.0 * z2 - 2.0 * z,
        ],
        [
            (12.0 * z - 6.0) / (h * h),
            (6.0 * z - 4.0) / h,
            (6.0 - 12.0 * z) / (h * h),
            (6.0 * z - 2.0) / h,
        ],
    ]
}

pub(crate) fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
