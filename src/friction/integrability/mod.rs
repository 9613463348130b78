//! Can a constraint on velocities be written as a relation between positions?
//!
//! A constraint Σ C_i·q̇_i + C = 0 (III.4), or as a form over the variables x = (q₁ … q_r, t)
//!
//! ```text
//! θ = Σ C_i(x)·dx_i = 0                                                   (III.5)
//! ∂C_i/∂x_k = ∂C_k/∂x_i for all i, k: θ is a total differential           (III.6), sufficient
//! θ ∧ dθ = 0: θ is one after multiplication by an integrating factor      Frobenius, necessary and sufficient
//! ```
//!
//! Coefficients are written as functions of [`Dual`] numbers, so their derivatives are exact. A violation at one place proves
//! the constraint non-holonomic; a verdict of holonomic refers to the places tested.
//!
//! (III.6) as printed speaks of sufficient conditions and leaves the integrating factor open; Frobenius' theorem closes
//! that gap (H. Flanders, *Differential Forms*, chapter VII).

mod drive;
mod relation;
mod system;

pub use drive::StageConstraint;
pub use relation::{dependent, potential};
pub use system::{SystemIntegrability, test_system};

use core::fmt;

use super::Dual;
use crate::{Error, math};

/// What one constraint is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integrability<const N: usize> {
    /// Holonomic; the coefficients are constant: Σ C_i·x_i = const (III.18).
    Constant([f64; N]),
    /// Holonomic; a total differential (III.6): Φ(x) = const, with Φ by [`potential`].
    Exact,
    /// Holonomic with an integrating factor: (III.6) fails for two variables, Frobenius' condition holds. The relation
    /// between the positions is found by [`dependent`].
    IntegratingFactor {
        /// The two variables i, k, counted from 0.
        variables: [usize; 2],
        /// ∂C_k/∂x_i − ∂C_i/∂x_k.
        curl: f64,
        /// Where.
        place: [f64; N],
    },
    /// Non-holonomic: there is no relation between the positions.
    NonHolonomic {
        /// Three variables a < b < c, counted from 0, for which θ ∧ dθ is not zero.
        variables: [usize; 3],
        /// Coefficient of θ ∧ dθ at dx_a ∧ dx_b ∧ dx_c.
        value: f64,
        /// Where.
        place: [f64; N],
    },
}

impl<const N: usize> Integrability<N> {
    /// Whether the constraint is one between positions.
    #[must_use]
    pub const fn is_holonomic(&self) -> bool {
        !matches!(self, Self::NonHolonomic { .. })
    }
}

impl<const N: usize> fmt::Display for Integrability<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(_) => write!(f, "holonomic: the coefficients are constant (III.18)"),
            Self::Exact => write!(f, "holonomic: a total differential (III.6)"),
            Self::IntegratingFactor {
                variables: [i, k],
                curl,
                ..
            } => write!(
                f,
                "holonomic with an integrating factor: (III.6) fails for the variables {i}, {k} by {curl:.3e}, \
                 Frobenius' condition holds"
            ),
            Self::NonHolonomic {
                variables: [a, b, c],
                value,
                ..
            } => write!(
                f,
                "non-holonomic: θ∧dθ is {value:.3e} for the variables {a}, {b}, {c}, not zero"
            ),
        }
    }
}

/// Tests one constraint at every one of `places`. The `form` gives its N coefficients, that of dt among them where time is
/// one of the variables.
///
/// A violation counts if it is above 1e-10 of its own terms and 1e-13 of the largest product of a coefficient and a
/// derivative: exact derivatives leave 1e-15.
///
/// ```
/// use jred::friction::integrability::{Integrability, test};
///
/// // y·dx − x·dy: not a total differential, but one after division by y².
/// let found = test(|[x, y]| [*y, -*x], &[[1.0, 2.0]])?;
/// assert!(matches!(found, Integrability::IntegratingFactor { curl: -2.0, .. }));
/// # Ok::<(), jred::Error>(())
/// ```
///
/// # Errors
/// No place, a coefficient or derivative that is not finite, or a place where all coefficients are zero.
pub fn test<const N: usize>(
    form: impl Fn(&[Dual<N>; N]) -> [Dual<N>; N],
    places: &[[f64; N]],
) -> Result<Integrability<N>, Error> {
    let mut constant = None;
    let mut curled = None;
    let mut twisted: Option<([usize; 3], f64, [f64; N])> = None;
    let mut first: Option<[f64; N]> = None;
    for place in places {
        let c = coefficients(&form, place)?;
        let size = Sizes::of(&c);
        let values = c.map(|c| c.value);
        let first = *first.get_or_insert(values);
        let same = c.iter().zip(first).all(|(c, was)| {
            math::abs(c.value - was) <= NOISE * size.coefficient
                && c.slope
                    .iter()
                    .all(|s| math::abs(*s) <= NOISE * size.coefficient)
        });
        constant = if same {
            constant.or(Some(true))
        } else {
            Some(false)
        };
        if let Some((variables, curl)) = curl(&c, &size) {
            curled.get_or_insert((variables, curl, *place));
        }
        if let Some((variables, value)) = twist(&c, &size)
            && twisted.is_none_or(|(_, largest, _)| math::abs(value) > math::abs(largest))
        {
            twisted = Some((variables, value, *place));
        }
    }
    let Some(values) = first else {
        return Err(Error::NotPositive("number of places", 0.0));
    };
    Ok(match (twisted, curled, constant) {
        (Some((variables, value, place)), ..) => Integrability::NonHolonomic {
            variables,
            value,
            place,
        },
        (None, Some((variables, curl, place)), _) => Integrability::IntegratingFactor {
            variables,
            curl,
            place,
        },
        (None, None, Some(true)) => Integrability::Constant(values),
        _ => Integrability::Exact,
    })
}

/// Smaller than this share is rounding.
const NOISE: f64 = 1e-13;

/// The same for a sum, of the sizes of its own terms.
const CANCELLED: f64 = 1e-10;

/// The largest of what violations are made of.
struct Sizes {
    coefficient: f64,
    slope: f64,
}

impl Sizes {
    fn of<const N: usize>(coefficients: &[Dual<N>; N]) -> Self {
        let most = |most: f64, x: f64| most.max(math::abs(x));
        let slopes = coefficients.iter().flat_map(|c| c.slope);
        Self {
            coefficient: coefficients.iter().map(|c| c.value).fold(0.0, most),
            slope: slopes.fold(0.0, most),
        }
    }
}

fn coefficients<const N: usize>(
    form: &impl Fn(&[Dual<N>; N]) -> [Dual<N>; N],
    place: &[f64; N],
) -> Result<[Dual<N>; N], Error> {
    let found = form(&Dual::variables(place));
    if !found.iter().all(Dual::is_finite) {
        return Err(Error::NotFinite("coefficient of the constraint"));
    }
    if found.iter().all(|c| c.value == 0.0) {
        return Err(Error::NotPositive(
            "largest coefficient of the constraint",
            0.0,
        ));
    }
    Ok(found)
}

/// ∂C_k/∂x_i − ∂C_i/∂x_k, and the size of its terms.
fn exterior<const N: usize>(c: &[Dual<N>; N], i: usize, k: usize) -> (f64, f64) {
    let slope = |of: usize, by: usize| c.get(of).and_then(|c| c.slope.get(by)).copied();
    let (a, b) = (slope(k, i).unwrap_or(0.0), slope(i, k).unwrap_or(0.0));
    (a - b, math::abs(a) + math::abs(b))
}

/// The first pair for which (III.6) fails, with its curl.
fn curl<const N: usize>(c: &[Dual<N>; N], size: &Sizes) -> Option<([usize; 2], f64)> {
    let pairs = (0..N).flat_map(|i| (i + 1..N).map(move |k| [i, k]));
    let curls = pairs.map(|[i, k]| ([i, k], exterior(c, i, k)));
    let mut failing = curls.filter_map(|(pair, (value, own))| {
        (math::abs(value) > CANCELLED * own && math::abs(value) > NOISE * size.slope)
            .then_some((pair, value))
    });
    failing.next()
}

/// The triple with the largest θ ∧ dθ, if it is not zero.
fn twist<const N: usize>(c: &[Dual<N>; N], size: &Sizes) -> Option<([usize; 3], f64)> {
    let mut largest: Option<([usize; 3], f64)> = None;
    for i in 0..N {
        for k in i + 1..N {
            for l in k + 1..N {
                let (mut value, mut own) = (0.0, 0.0);
                for [a, b, d] in [[i, k, l], [k, l, i], [l, i, k]] {
                    let (curl, terms) = exterior(c, b, d);
                    let factor = c.get(a).map_or(0.0, |c| c.value);
                    value += factor * curl;
                    own += math::abs(factor) * terms;
                }
                let counts = math::abs(value) > CANCELLED * own
                    && math::abs(value) > NOISE * size.coefficient * size.slope;
                if counts && largest.is_none_or(|(_, most)| math::abs(value) > math::abs(most)) {
                    largest = Some(([i, k, l], value));
                }
            }
        }
    }
    largest
}
