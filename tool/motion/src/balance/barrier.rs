//! A convex problem in a few unknowns, by the barrier method. The result is within a stated gap of the optimum.
//!
//! ```text
//! minimise f(x) = ½·xᵀH·x + g·x   where b − a·x > 0 and x_m·x_θ − x_u² − x_v² > 0
//! ```
//!
//! For growing s, Newton's method finds the minimum of s·f(x) − Σ ln(bounds). There f is at most ν/s above its least value, where ν is the number of
//! bounds and a cone counts twice (S. Boyd, L. Vandenberghe, *Convex Optimization*, 11.3 and 11.6).

use crate::skyline::Skyline;
use jred_file::math;

/// Factor by which s grows from one minimum to the next.
const GROWTH: f64 = 10.0;
/// Most steps of Newton's method to one minimum.
const MOST_STEPS: usize = 200;
/// Half the square of Newton's decrement at which a minimum counts as reached.
const MINIMUM_DECREMENT: f64 = 1e-6;

/// The same where rounding stops the descent. It is large against rounding, but hardly widens the gap.
const ROUNDING_DECREMENT: f64 = 1e-2;

/// A constraint.
#[derive(Clone, Debug)]
pub(super) enum Bound {
    /// b − Σ a·x > 0: b, and the a with their unknowns.
    Linear(f64, Vec<(usize, f64)>),
    /// x_m·x_θ − x_u² − x_v² > 0 of the unknowns m, u, v, θ, where x_m and x_θ are positive.
    Cone([usize; 4]),
}

/// The problem.
#[derive(Clone, Debug)]
pub(super) struct QuadraticProgram {
    /// H, row by row.
    pub(super) curvature: Vec<Vec<f64>>,
    /// g.
    pub(super) slope: Vec<f64>,
    pub(super) bounds: Vec<Bound>,
}

impl Bound {
    /// Distance of a point from the bound.
    fn room(&self, x: &[f64]) -> f64 {
        match self {
            Self::Linear(b, a) => b - a.iter().map(|(k, a)| a * x[*k]).sum::<f64>(),
            Self::Cone([m, u, v, theta]) => x[*m] * x[*theta] - x[*u] * x[*u] - x[*v] * x[*v],
        }
    }

    /// Gradient of [`Self::room`].
    fn slope(&self, x: &[f64]) -> Vec<(usize, f64)> {
        match self {
            Self::Linear(_, a) => a.iter().map(|(k, a)| (*k, -a)).collect(),
            Self::Cone([m, u, v, theta]) => vec![
                (*m, x[*theta]),
                (*u, -2.0 * x[*u]),
                (*v, -2.0 * x[*v]),
                (*theta, x[*m]),
            ],
        }
    }

    const fn count(&self) -> f64 {
        match self {
            Self::Linear(..) => 1.0,
            Self::Cone(_) => 2.0,
        }
    }
}

impl QuadraticProgram {
    /// f.
    pub(super) fn value(&self, x: &[f64]) -> f64 {
        let rows = self.curvature.iter().zip(x).zip(&self.slope);
        rows.map(|((row, x_k), slope)| {
            let curved: f64 = row.iter().zip(x).map(|(h, x)| h * x).sum();
            (0.5 * curved + slope) * x_k
        })
        .sum()
    }

    /// s·f less the logarithms of all bounds; `None` outside of one.
    fn height(&self, s: f64, x: &[f64]) -> Option<f64> {
        let mut height = s * self.value(x);
        for bound in &self.bounds {
            let room = bound.room(x);
            if room.is_nan() || room <= 0.0 {
                return None;
            }
            height -= math::ln(room);
        }
        height.is_finite().then_some(height)
    }

    /// Newton's step from a point, and the expected decrease of the height.
    fn step(&self, s: f64, x: &[f64]) -> Option<(Vec<f64>, f64)> {
        let n = x.len();
        let mut matrix = Skyline::new(vec![0; n]);
        let mut right = vec![0.0; n];
        for (i, row) in self.curvature.iter().enumerate() {
            for (j, h) in row.iter().enumerate().take(i + 1) {
                matrix.add(i, j, s * h);
            }
            right[i] -= s * (self.slope[i] + row.iter().zip(x).map(|(h, x)| h * x).sum::<f64>());
        }
        for bound in &self.bounds {
            let room = bound.room(x);
            let slope = bound.slope(x);
            for (p, (i, a)) in slope.iter().enumerate() {
                right[*i] += a / room;
                for (j, b) in &slope[..=p] {
                    matrix.add(*i, *j, a * b / (room * room));
                }
            }
            if let Bound::Cone([m, u, v, theta]) = bound {
                matrix.add(*m, *theta, -1.0 / room);
                matrix.add(*u, *u, 2.0 / room);
                matrix.add(*v, *v, 2.0 / room);
            }
        }
        let downhill = right.clone();
        let (factors, negative) = matrix.factor()?;
        factors.solve(&mut right);
        let decrement: f64 = downhill.iter().zip(&right).map(|(a, b)| a * b).sum();
        (negative == 0 && decrement.is_finite()).then_some((right, 0.5 * decrement))
    }

    /// The minimum, and a bound of how far f is above the least value, from a `start` within all bounds. It ends when the gap is below `gap`, or
    /// where rounding stops the search.
    pub(super) fn least(&self, start: Vec<f64>, gap: f64) -> (Vec<f64>, f64) {
        let count: f64 = self.bounds.iter().map(Bound::count).sum();
        let (mut x, mut s, mut reached) = (start, 1.0, f64::INFINITY);
        while reached > gap {
            let Some(next) = self.centre(s, x.clone()) else {
                break;
            };
            (x, reached) = (next, count / s);
            s *= GROWTH;
        }
        (x, reached)
    }

    /// The minimum for one s; `None`: not reached within rounding.
    fn centre(&self, s: f64, mut x: Vec<f64>) -> Option<Vec<f64>> {
        let mut height = self.height(s, &x)?;
        for _ in 0..MOST_STEPS {
            let (step, falls) = self.step(s, &x)?;
            if falls <= MINIMUM_DECREMENT {
                return Some(x);
            }
            let mut share = 1.0;
            loop {
                let there: Vec<f64> = x.iter().zip(&step).map(|(x, d)| x + share * d).collect();
                if let Some(lower) = self.height(s, &there)
                    && lower < height
                    && lower <= height - 0.1 * share * falls
                {
                    (x, height) = (there, lower);
                    break;
                }
                share *= 0.5;
                if share < 1e-12 {
                    // The gain of the step is lost in the rounding of the height.
                    return (falls < ROUNDING_DECREMENT).then_some(x);
                }
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{Bound, QuadraticProgram};

    /// The point of a disc of radius 1 nearest to (3, 4): a cone with two unknowns fixed at 1.
    #[test]
    fn the_nearest_point_of_a_disc() {
        let mut curvature = vec![vec![0.0; 4]; 4];
        curvature[1][1] = 2.0;
        curvature[2][2] = 2.0;
        let bounds = vec![
            Bound::Cone([0, 1, 2, 3]),
            Bound::Linear(1.0, vec![(0, 1.0)]),
            Bound::Linear(1.0, vec![(3, 1.0)]),
        ];
        let problem = QuadraticProgram {
            curvature,
            slope: vec![0.0, -6.0, -8.0, 0.0],
            bounds,
        };
        let (x, gap) = problem.least(vec![0.5, 0.0, 0.0, 0.5], 1e-10);
        assert!(gap <= 1e-10);
        assert!(
            (x[1] - 0.6).abs() < 1e-6 && (x[2] - 0.8).abs() < 1e-6,
            "{x:?}"
        );
        // |x − (3, 4)|² = 16; f omits the constant 25.
        assert!((problem.value(&x) + 9.0).abs() < 1e-9);
    }

    /// The corner of a linear programme: least x + y above two lines.
    #[test]
    fn the_corner_of_a_linear_programme() {
        let bounds = vec![
            Bound::Linear(-2.0, vec![(0, -1.0), (1, -2.0)]),
            Bound::Linear(-2.0, vec![(0, -2.0), (1, -1.0)]),
        ];
        let problem = QuadraticProgram {
            curvature: vec![vec![0.0; 2]; 2],
            slope: vec![1.0; 2],
            bounds,
        };
        let (x, _) = problem.least(vec![3.0, 3.0], 1e-11);
        assert!(x.iter().all(|x| (x - 2.0 / 3.0).abs() < 1e-9), "{x:?}");
    }
}
