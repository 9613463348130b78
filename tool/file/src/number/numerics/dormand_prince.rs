//! Initial value problems y′ = f(x, y): Dormand and Prince's explicit Runge-Kutta method of order 8 with error estimates
//! of orders 5 and 3 (Hairer, Nørsett, Wanner 1993, "Solving Ordinary Differential Equations I", II.5 and II.10, program
//! DOP853).

mod bends;
mod coefficients;

use crate::math;
use bends::{Sides, StepResult};
use coefficients::{A, B, B3, C, E5};

/// Evaluations of f in one step.
const STAGES: usize = 12;

/// The step control of DOP853: the next step is the one that would have met the tolerance times `SAFETY`, at most
/// `GROWTH` and at least `SHRINKAGE` times the last.
const SAFETY: f64 = 0.9;
const GROWTH: f64 = 6.0;
const SHRINKAGE: f64 = 0.333;

/// A position and the values there.
pub type StatePoint<const N: usize> = (f64, [f64; N]);

/// Why an integration did not reach its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IntegrationError<E> {
    /// f cannot be evaluated.
    Function(E),
    /// More steps are needed than allowed.
    TooManySteps {
        /// Position reached.
        x: f64,
    },
    /// The step has become too small for the digits of x.
    StepTooSmall {
        /// Position reached.
        x: f64,
    },
}

impl<E> From<E> for IntegrationError<E> {
    fn from(error: E) -> Self {
        Self::Function(error)
    }
}

/// The allowed error per step and value, relative for values above 1 and absolute below, and the most steps.
///
/// A stiff problem is integrated in small steps until there are too many.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy {
    /// Tolerance.
    pub tolerance: f64,
    /// Allowed steps, including rejected ones.
    pub most_steps: u32,
}

impl Accuracy {
    /// The steps from `y` at x = 0 to x = `end` > 0, both included, or to the first one that is `enough`.
    ///
    /// f may bend, but not jump, where one of the values of `bends` passes zero. The number of values is the same everywhere, zero for a smooth f.
    /// Each is relative to its terms, so that 1e-13 is rounding. A step ends at such a position.
    ///
    /// # Errors
    /// Those of `f`, `bends` and `enough`; too many steps, or too small ones.
    pub fn steps<const N: usize, E>(
        self,
        f: impl Fn(f64, &[f64; N]) -> Result<[f64; N], E>,
        bends: impl Fn(f64, &[f64; N]) -> Result<Vec<f64>, E>,
        mut y: [f64; N],
        end: f64,
        enough: impl Fn(f64, &[f64; N]) -> Result<bool, E>,
    ) -> Result<Vec<StatePoint<N>>, IntegrationError<E>> {
        let mut x = 0.0;
        let mut steps = vec![(x, y)];
        let mut slope = f(x, &y)?;
        let mut sides = Sides::at(bends(x, &y)?);
        let mut h = self.first_step(&f, &y, &slope, end)?;
        let mut growth = GROWTH;
        for _ in 0..self.most_steps {
            if 0.1 * h <= f64::EPSILON * x {
                return Err(IntegrationError::StepTooSmall { x });
            }
            let mut last = x + 1.01 * h > end;
            if last {
                h = end - x;
            }
            let Some(mut step) = Step::new(&f, x, h, &y, slope)? else {
                // Beyond the range of numbers: stiff friction in a long step.
                h *= SHRINKAGE;
                growth = 1.0;
                continue;
            };
            let mut error = step.error(&y, self.tolerance);
            let mut next = h;
            let mut ahead = None;
            // A step that is rejected once may be too long; after the second rejection f may bend in it.
            if !sides.is_empty() && (error <= 1.0 || growth < GROWTH) {
                let to = f(x + h, &step.y)?;
                let begin = bends::StepStart { x, y: &y, slope };
                match sides.pass(&f, &bends, begin, &step, to)? {
                    StepResult::Nothing => ahead = Some(to),
                    StepResult::Bend { step: short, which } => {
                        let found = short.error(&y, self.tolerance);
                        if found <= 1.0 {
                            (last, error, step) = (false, found, short);
                            sides.turn(which, bends(x + step.h, &step.y)?);
                        }
                    }
                }
            }
            let shrink = math::pow(error, 0.125) / SAFETY;
            if error <= 1.0 {
                let whole = step.h >= h;
                x = if last { end } else { x + step.h };
                y = step.y;
                steps.push((x, y));
                if last || enough(x, &y)? {
                    return Ok(steps);
                }
                slope = match ahead {
                    Some(ahead) => ahead,
                    None => f(x, &y)?,
                };
                if whole {
                    next = h / shrink.clamp(1.0 / growth, 1.0 / SHRINKAGE);
                }
                h = next.min(end);
                growth = GROWTH;
            } else {
                h /= shrink.min(1.0 / SHRINKAGE);
                // The step after a rejected one does not grow.
                growth = 1.0;
            }
        }
        Err(IntegrationError::TooManySteps { x })
    }

    /// A first step from the sizes of y, y′ and y″ against the tolerance.
    fn first_step<const N: usize, E>(
        self,
        f: impl Fn(f64, &[f64; N]) -> Result<[f64; N], E>,
        y: &[f64; N],
        slope: &[f64; N],
        end: f64,
    ) -> Result<f64, E> {
        let size = |v: &[f64; N]| {
            let shares = v
                .iter()
                .zip(y)
                .map(|(v, y)| v / (self.tolerance + y.abs() * self.tolerance));
            shares.map(|share| share * share).sum::<f64>()
        };
        let (d0, d1) = (size(y), size(slope));
        let h = if d0 < 1e-10 || d1 < 1e-10 {
            1e-6
        } else {
            0.01 * (d0 / d1).sqrt()
        };
        let h = h.min(end);
        let ahead = f(h, &std::array::from_fn(|i| y[i] + slope[i] * h))?;
        let change = std::array::from_fn(|i| ahead[i] - slope[i]);
        let largest = d1.sqrt().max(size(&change).sqrt() / h);
        let by_slopes = if largest <= 1e-15 {
            (h * 1e-3).max(1e-6)
        } else {
            math::pow(0.01 / largest, 0.125)
        };
        Ok((100.0 * h).min(by_slopes).min(end))
    }
}

/// One step.
struct Step<const N: usize> {
    h: f64,
    /// f at the stages.
    k: [[f64; N]; STAGES],
    /// The mean slope.
    mean: [f64; N],
    /// The values at the end.
    y: [f64; N],
}

impl<const N: usize> Step<N> {
    /// The step; `None` if an intermediate value is not finite.
    fn new<E>(
        f: impl Fn(f64, &[f64; N]) -> Result<[f64; N], E>,
        x: f64,
        h: f64,
        y: &[f64; N],
        slope: [f64; N],
    ) -> Result<Option<Self>, E> {
        let mut k = [slope; STAGES];
        for (s, (row, c)) in A.iter().zip(C).enumerate().skip(1) {
            let mut at = *y;
            for (a, k) in row.iter().zip(&k) {
                at = std::array::from_fn(|i| at[i] + k[i] * (h * a));
            }
            if at.iter().any(|value| !value.is_finite()) {
                return Ok(None);
            }
            k[s] = f(x + h * c, &at)?;
        }
        let mean = sum(&B, &k);
        let y: [f64; N] = std::array::from_fn(|i| y[i] + mean[i] * h);
        let numbers = y.iter().all(|value| value.is_finite());
        Ok(numbers.then_some(Self { h, k, mean, y }))
    }

    /// The estimated error as a share of the tolerance.
    fn error(&self, before: &[f64; N], tolerance: f64) -> f64 {
        let fifth = sum(&E5, &self.k);
        let (mut err5, mut err3) = (0.0, 0.0);
        for i in 0..N {
            let scale = tolerance + before[i].abs().max(self.y[i].abs()) * tolerance;
            let third: f64 = B3
                .iter()
                .fold(self.mean[i], |rest, (s, b)| rest - self.k[*s][i] * b);
            err5 += (fifth[i] / scale).powi(2);
            err3 += (third / scale).powi(2);
        }
        let both = err5 + 0.01 * err3;
        let both = if both > 0.0 { both } else { 1.0 };
        self.h * err5 * (1.0 / (both * N as f64)).sqrt()
    }
}

fn sum<const N: usize>(shares: &[f64; STAGES], k: &[[f64; N]; STAGES]) -> [f64; N] {
    let parts = || shares.iter().zip(k);
    std::array::from_fn(|i| parts().map(|(share, k)| share * k[i]).sum())
}

#[cfg(test)]
#[expect(
    clippy::disallowed_methods,
    reason = "functions of another library than the code's"
)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    const FINE: Accuracy = Accuracy {
        tolerance: 1e-12,
        most_steps: 100_000,
    };

    /// An f without bends.
    #[expect(clippy::unnecessary_wraps, reason = "others can fail")]
    fn smooth<const N: usize, E>(_: f64, _: &[f64; N]) -> Result<Vec<f64>, E> {
        Ok(Vec::new())
    }

    fn one_step<const N: usize>(
        f: impl Fn(f64, &[f64; N]) -> [f64; N],
        x: f64,
        h: f64,
        y: [f64; N],
    ) -> Step<N> {
        let f = |x: f64, y: &[f64; N]| Ok::<_, Infallible>(f(x, y));
        let Ok(slope) = f(x, &y);
        let Ok(step) = Step::new(f, x, h, &y, slope);
        step.unwrap()
    }

    /// The position of each stage is the sum of its row.
    #[test]
    fn nodes_are_the_sums_of_their_rows() {
        for (row, c) in A.iter().zip(C) {
            let size: f64 = row.iter().map(|a| a.abs()).sum();
            let sum: f64 = row.iter().sum();
            assert!((sum - c).abs() <= 4.0 * f64::EPSILON * size, "{c}: {sum}");
        }
    }

    /// A polynomial is integrated exactly up to order 8 and not beyond; the estimates detect it from orders 5 and 3.
    #[test]
    fn polynomials_are_exact_in_one_step() {
        for power in 0..10 {
            let f = |x: f64, _: &[f64; 1]| [f64::from(power + 1) * x.powi(power)];
            let step = one_step(f, 0.0, 1.0, [0.0]);
            let off = (step.y[0] - 1.0).abs();
            assert_eq!(off < 1e-15, power < 8, "x^{power}: {off:e}");
            let fifth = sum(&E5, &step.k)[0].abs();
            assert_eq!(fifth < 1e-14, power < 5, "x^{power}: {fifth:e}");
            let third: f64 = B3.iter().map(|(s, b)| step.k[*s][0] * b).sum();
            assert_eq!((third - 1.0).abs() < 1e-14, power < 3, "x^{power}");
        }
    }

    /// Half the step has 1/2⁹ of the error: for a pendulum with a nonlinear, time-dependent f.
    #[test]
    fn the_error_of_a_step_falls_with_its_ninth_power() {
        let f = |x: f64, y: &[f64; 2]| [y[1], -y[0].sin() * (1.0 + x)];
        let many = |n: u32| {
            let h = 0.8 / f64::from(n);
            (0..n).fold([1.0, 0.5], |y, k| one_step(f, f64::from(k) * h, h, y).y)
        };
        let exact = many(64);
        let off = |n| (many(n)[0] - exact[0]).hypot(many(n)[1] - exact[1]);
        let order = (off(1) / off(2)).log2();
        assert!((7.5..10.0).contains(&order), "{order}");
    }

    /// Growth over 1500 steps and more, without an early end.
    #[test]
    fn a_long_way_keeps_its_tolerance() {
        let f = |_: f64, y: &[f64; 1]| Ok::<_, Infallible>([y[0]]);
        let steps = FINE.steps(f, smooth, [1.0], 600.0, |_, _| Ok(false));
        let steps = steps.unwrap();
        let (x, [y]) = steps[steps.len() - 1];
        assert!((x - 600.0).abs() < 1e-12, "{x}");
        assert!(steps.len() > 1500, "{}", steps.len());
        assert!((y / 600f64.exp() - 1.0).abs() < 1e-8, "{y}");
    }

    /// y′ = |cos x|: with steps that end where f bends, both tolerances are satisfied, and the fine one takes at most two thirds of the steps.
    #[test]
    fn a_step_ends_where_f_bends() {
        // ∫|cos x| dx over 10.
        let exact = 6.0 + (10.0f64 - 3.0 * std::f64::consts::PI).sin().abs();
        let f = |x: f64, _: &[f64; 1]| Ok::<_, ()>([x.cos().abs()]);
        let bends = |x: f64, _: &[f64; 1]| Ok(vec![x.cos()]);
        let rough = Accuracy {
            tolerance: 1e-6,
            most_steps: 1000,
        };
        let enough = |_, _: &[f64; 1]| Ok(false);
        let last = |steps: Result<Vec<(f64, [f64; 1])>, _>| {
            let steps = steps.unwrap();
            (steps[steps.len() - 1].1[0], steps.len())
        };
        let (found, _) = last(rough.steps(f, bends, [0.0], 10.0, enough));
        assert!((found - exact).abs() < rough.tolerance, "{found} {exact}");
        let (found, count) = last(FINE.steps(f, bends, [0.0], 10.0, enough));
        assert!((found - exact).abs() < FINE.tolerance, "{found} {exact}");
        let (_, blind) = last(FINE.steps(f, smooth, [0.0], 10.0, enough));
        assert!(3 * count < 2 * blind, "{count} {blind}");
        // Each position is the end of a step.
        let steps = FINE.steps(f, bends, [0.0], 10.0, |_, _| Ok(false)).unwrap();
        for k in 0..3 {
            let place = (f64::from(k) + 0.5) * std::f64::consts::PI;
            assert!(steps.iter().any(|(x, _)| (x - place).abs() < 1e-9), "{k}");
        }
    }

    /// Between two ends of a step the value may pass zero twice.
    #[test]
    fn a_short_excursion_is_seen() {
        let value = |x: f64| (x - 0.51).powi(2) - 1e-4;
        let f = |x: f64, _: &[f64; 1]| Ok::<_, ()>([value(x).max(0.0)]);
        let bends = |x: f64, _: &[f64; 1]| Ok(vec![value(x)]);
        let steps = FINE.steps(f, bends, [0.0], 1.0, |_, _| Ok(false)).unwrap();
        let (_, [y]) = steps[steps.len() - 1];
        // ∫(x − 0.51)² − 1e-4 outside [0.5, 0.52].
        let part = |x: f64| (x - 0.51).powi(3) / 3.0 - 1e-4 * x;
        let exact = part(0.5) - part(0.0) + part(1.0) - part(0.52);
        assert!((y - exact).abs() < 1e-13, "{y} {exact}");
    }

    #[test]
    fn ends_where_it_is_enough_or_impossible() {
        let f = |_: f64, y: &[f64; 2]| Ok::<_, ()>([y[1], -y[0]]);
        let steps = FINE.steps(f, smooth, [0.0, 1.0], 100.0, |_, y| Ok(y[1] < 0.0));
        let steps = steps.unwrap();
        assert!(steps[..steps.len() - 1].iter().all(|(_, y)| y[1] >= 0.0));
        let (x, y) = steps[steps.len() - 1];
        assert!(x < 4.0 && y[1] < 0.0, "{x}");

        let few = Accuracy {
            most_steps: 3,
            ..FINE
        };
        let found = few.steps(f, smooth, [0.0, 1.0], 100.0, |_, _| Ok(false));
        assert!(matches!(found, Err(IntegrationError::TooManySteps { x }) if x > 0.0));
        let found = FINE.steps(
            |x, _: &[f64; 1]| if x < 1.0 { Ok([1.0]) } else { Err("far") },
            smooth,
            [0.0],
            9.0,
            |_, _| Ok(false),
        );
        assert_eq!(found, Err(IntegrationError::Function("far")));
        for nonsense in [f64::NAN, f64::INFINITY] {
            let found = FINE.steps(
                |_, _: &[f64; 1]| Ok::<_, ()>([nonsense]),
                smooth,
                [0.0],
                1.0,
                |_, _| Ok(false),
            );
            assert!(found.is_err(), "{found:?}");
        }
        // A step that leaves the range of numbers is rejected.
        let stiff = |_: f64, y: &[f64; 1]| Ok::<_, ()>([-1e100 * y[0].powi(5)]);
        assert!(
            Step::new(stiff, 0.0, 1e-98, &[1.0], [-1e100])
                .unwrap()
                .is_none()
        );
        let steps = FINE
            .steps(stiff, smooth, [1.0], 1e-98, |_, _| Ok(false))
            .unwrap();
        let (_, [y]) = steps[steps.len() - 1];
        assert!((y / 401f64.powf(-0.25) - 1.0).abs() < 1e-10, "{y}");
        // 1/(1 − x) has no value at 1.
        let found = FINE.steps(
            |_, y: &[f64; 1]| Ok::<_, ()>([y[0] * y[0]]),
            smooth,
            [1.0],
            2.0,
            |_, _| Ok(false),
        );
        assert!(
            matches!(found, Err(IntegrationError::StepTooSmall { x }) if (x - 1.0).abs() < 1e-6),
            "{found:?}"
        );
    }
}
