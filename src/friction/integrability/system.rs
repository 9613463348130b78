//! Several constraints together.
//!
//! ```text
//! dθ_β ∧ θ₁ ∧ … ∧ θ_s = 0 for every β                                      Frobenius
//! ```
//!
//! An equivalent condition: dθ_β(u, v) = 0 for all displacements u, v that satisfy the constraints. Constraints that each alone
//! are non-holonomic may be holonomic together, and the other way round.

use core::fmt;

use super::{CANCELLED, Dual, NOISE, Sizes, coefficients, exterior};
use crate::{Error, math};

/// What a system of constraints is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SystemIntegrability<const N: usize> {
    /// Holonomic: as many relations between the positions as constraints.
    Holonomic,
    /// Non-holonomic.
    NonHolonomic {
        /// Number β of a constraint that is violated, from 0.
        form: usize,
        /// The two variables, from 0, whose displacements, with those of the others that the constraints ask for, give
        /// dθ_β(u, v) ≠ 0. Time among them means: the ratio is shifted.
        variables: [usize; 2],
        /// dθ_β(u, v).
        value: f64,
        /// Where.
        place: [f64; N],
        /// Most relations between the positions that the system may contain.
        relations: usize,
    },
}

impl<const N: usize> SystemIntegrability<N> {
    /// Whether all constraints are such between positions.
    #[must_use]
    pub const fn is_holonomic(&self) -> bool {
        matches!(self, Self::Holonomic)
    }
}

impl<const N: usize> fmt::Display for SystemIntegrability<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Holonomic => write!(f, "holonomic: Frobenius' condition holds for the system"),
            Self::NonHolonomic {
                form,
                variables: [u, v],
                value,
                relations,
                ..
            } => write!(
                f,
                "non-holonomic: dθ of constraint {form} is {value:.3e} for displacements in the variables {u}, {v}; \
                 at most {relations} relations between positions are left"
            ),
        }
    }
}

/// Tests S constraints over N variables at every one of `places`. Bounds on rounding as in [`test`](super::test).
///
/// # Errors
/// No place, a coefficient or derivative that is not finite, a constraint without coefficients, or constraints that
/// depend on each other at a place.
pub fn test_system<const N: usize, const S: usize>(
    forms: impl Fn(&[Dual<N>; N]) -> [[Dual<N>; N]; S],
    places: &[[f64; N]],
) -> Result<SystemIntegrability<N>, Error> {
    if places.is_empty() {
        return Err(Error::NotPositive("number of places", 0.0));
    }
    let mut answer = SystemIntegrability::Holonomic;
    let mut fewest = S;
    for place in places {
        let mut system = [[Dual::constant(0.0); N]; S];
        for (k, slot) in system.iter_mut().enumerate() {
            let row =
                |x: &[Dual<N>; N]| forms(x).get(k).copied().unwrap_or([Dual::constant(0.0); N]);
            *slot = coefficients(&row, place)?;
        }
        let solved = Solved::new(&system)?;
        let mut spanned = Span::<S>::default();
        for (u, v) in pairs::<N>().filter(|(u, v)| solved.is_free(*u) && solved.is_free(*v)) {
            let (first, second) = (solved.displacement(u), solved.displacement(v));
            let mut violation = [0.0; S];
            for (k, (form, slot)) in system.iter().zip(&mut violation).enumerate() {
                let Some(value) = on(form, &first, &second) else {
                    continue;
                };
                *slot = value;
                let larger = match answer {
                    SystemIntegrability::Holonomic => true,
                    SystemIntegrability::NonHolonomic { value: most, .. } => {
                        math::abs(value) > math::abs(most)
                    }
                };
                if larger {
                    answer = SystemIntegrability::NonHolonomic {
                        form: k,
                        variables: [u, v],
                        value,
                        place: *place,
                        relations: 0,
                    };
                }
            }
            spanned.add(violation);
        }
        fewest = fewest.min(S - spanned.rank);
    }
    if let SystemIntegrability::NonHolonomic { relations, .. } = &mut answer {
        *relations = fewest;
    }
    Ok(answer)
}

fn pairs<const N: usize>() -> impl Iterator<Item = (usize, usize)> {
    (0..N).flat_map(|u| (u + 1..N).map(move |v| (u, v)))
}

/// dθ(u, v) = Σ (∂C_k/∂x_i − ∂C_i/∂x_k)·(u_i·v_k − u_k·v_i) over i < k, if it is not zero.
fn on<const N: usize>(form: &[Dual<N>; N], u: &[f64; N], v: &[f64; N]) -> Option<f64> {
    let size = Sizes::of(form);
    let (mut value, mut own, mut most) = (0.0, 0.0, 0.0f64);
    for (i, k) in pairs::<N>() {
        let (curl, terms) = exterior(form, i, k);
        let at = |w: &[f64; N], index: usize| w.get(index).copied().unwrap_or(0.0);
        let (a, b) = (at(u, i) * at(v, k), at(u, k) * at(v, i));
        value += curl * (a - b);
        own += terms * (math::abs(a) + math::abs(b));
        most = most.max(math::abs(a) + math::abs(b));
    }
    let counts = math::abs(value) > CANCELLED * own && math::abs(value) > NOISE * size.slope * most;
    counts.then_some(value)
}

/// The constraints solved for S of the variables.
struct Solved<const N: usize, const S: usize> {
    rows: [[f64; N]; S],
    /// The variable that each row is solved for.
    pivots: [usize; S],
}

impl<const N: usize, const S: usize> Solved<N, S> {
    /// Gauss-Jordan elimination with complete pivoting.
    fn new(system: &[[Dual<N>; N]; S]) -> Result<Self, Error> {
        let mut rows = system.map(|form| form.map(|c| c.value));
        let mut pivots = [N; S];
        let largest = |row: &[f64; N]| row.iter().fold(0.0f64, |most, x| most.max(math::abs(*x)));
        for row in &mut rows {
            let size = largest(row);
            *row = row.map(|x| x / size);
        }
        for done in 0..S {
            let mut best = (0.0, done, N);
            for (k, row) in rows.iter().enumerate().skip(done) {
                for (column, x) in row.iter().enumerate() {
                    if math::abs(*x) > best.0 {
                        best = (math::abs(*x), k, column);
                    }
                }
            }
            let (size, at, column) = best;
            if size <= CANCELLED {
                return Err(Error::NotPositive(
                    "independent part of a constraint of the system",
                    size,
                ));
            }
            rows.swap(done, at);
            let Some(pivot) = rows.get_mut(done) else {
                continue;
            };
            let by = pivot.get(column).copied().unwrap_or(1.0);
            *pivot = pivot.map(|x| x / by);
            let pivot = *pivot;
            let others = rows.iter_mut().enumerate().filter(|(k, _)| *k != done);
            for (_, row) in others {
                let factor = row.get(column).copied().unwrap_or(0.0);
                for (x, p) in row.iter_mut().zip(pivot) {
                    *x -= factor * p;
                }
            }
            if let Some(slot) = pivots.get_mut(done) {
                *slot = column;
            }
        }
        Ok(Self { rows, pivots })
    }

    fn is_free(&self, variable: usize) -> bool {
        !self.pivots.contains(&variable)
    }

    /// A unit displacement in a free variable, with what the constraints ask of the others.
    fn displacement(&self, variable: usize) -> [f64; N] {
        let mut displacement = [0.0; N];
        let mut set = |k: usize, value: f64| {
            if let Some(slot) = displacement.get_mut(k) {
                *slot = value;
            }
        };
        set(variable, 1.0);
        for (row, pivot) in self.rows.iter().zip(self.pivots) {
            set(pivot, -row.get(variable).copied().unwrap_or(0.0));
        }
        displacement
    }
}

/// The rank of vectors, one after another.
struct Span<const S: usize> {
    basis: [[f64; S]; S],
    rank: usize,
}

impl<const S: usize> Default for Span<S> {
    fn default() -> Self {
        Self {
            basis: [[0.0; S]; S],
            rank: 0,
        }
    }
}

impl<const S: usize> Span<S> {
    fn add(&mut self, mut vector: [f64; S]) {
        let length = |v: &[f64; S]| math::sqrt(v.iter().map(|x| x * x).sum());
        let whole = length(&vector);
        for known in self.basis.iter().take(self.rank) {
            let along: f64 = known.iter().zip(&vector).map(|(a, b)| a * b).sum();
            for (x, k) in vector.iter_mut().zip(known) {
                *x -= along * k;
            }
        }
        let left = length(&vector);
        if left > CANCELLED * whole
            && let Some(slot) = self.basis.get_mut(self.rank)
        {
            *slot = vector.map(|x| x / left);
            self.rank += 1;
        }
    }
}
