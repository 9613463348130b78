//! Initial value problems y′ = f(x, y): Dormand and Prince's explicit Runge-Kutta method of order 8 with error estimates
//! of orders 5 and 3 (Hairer, Nørsett, Wanner 1993, "Solving Ordinary Differential Equations I", II.5 and II.10, program
//! DOP853).

/// Evaluations of f in one step.
const STAGES: usize = 12;

/// The step control of DOP853: the next step is the one that would have met the tolerance times `SAFETY`, at most
/// `GROWTH` and at least `SHRINKAGE` times the last.
const SAFETY: f64 = 0.9;
const GROWTH: f64 = 6.0;
const SHRINKAGE: f64 = 0.333;

/// A place and the values there.
pub type Point<const N: usize> = (f64, [f64; N]);

/// Why an integration did not reach its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stopped<E> {
    /// f cannot be evaluated.
    Function(E),
    /// More steps would be needed than allowed.
    TooManySteps {
        /// Place reached.
        x: f64,
    },
    /// The step has become too small for the digits of x.
    StepTooSmall {
        /// Place reached.
        x: f64,
    },
}

impl<E> From<E> for Stopped<E> {
    fn from(error: E) -> Self {
        Self::Function(error)
    }
}

/// The error allowed per step and value, relative for values above 1 and absolute below, and the most steps.
///
/// A stiff problem is integrated in small steps until there are too many.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy {
    /// Tolerance.
    pub tolerance: f64,
    /// Steps allowed, rejected ones included.
    pub most_steps: u32,
}

impl Accuracy {
    /// The steps from `y` at x = 0 to x = `end` > 0, both included, or to the first one that is `enough`.
    ///
    /// # Errors
    /// Those of `f` and `enough`; too many steps, or too small ones.
    pub fn steps<const N: usize, E>(
        self,
        f: impl Fn(f64, &[f64; N]) -> Result<[f64; N], E>,
        mut y: [f64; N],
        end: f64,
        enough: impl Fn(f64, &[f64; N]) -> Result<bool, E>,
    ) -> Result<Vec<Point<N>>, Stopped<E>> {
        let mut x = 0.0;
        let mut steps = vec![(x, y)];
        let mut slope = f(x, &y)?;
        let mut h = self.first_step(&f, &y, &slope, end)?;
        let mut growth = GROWTH;
        for _ in 0..self.most_steps {
            if 0.1 * h <= f64::EPSILON * x {
                return Err(Stopped::StepTooSmall { x });
            }
            let last = x + 1.01 * h > end;
            if last {
                h = end - x;
            }
            let step = Step::new(&f, x, h, &y, slope)?;
            let error = step.error(&y, self.tolerance);
            let shrink = error.powf(0.125) / SAFETY;
            if error <= 1.0 {
                x += h;
                y = step.y;
                steps.push((x, y));
                if last || enough(x, &y)? {
                    return Ok(steps);
                }
                slope = f(x, &y)?;
                h = (h / shrink.clamp(1.0 / growth, 1.0 / SHRINKAGE)).min(end);
                growth = GROWTH;
            } else {
                h /= shrink.min(1.0 / SHRINKAGE);
                // The step after a rejected one does not grow.
                growth = 1.0;
            }
        }
        Err(Stopped::TooManySteps { x })
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
            (0.01 / largest).powf(0.125)
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
    fn new<E>(
        f: impl Fn(f64, &[f64; N]) -> Result<[f64; N], E>,
        x: f64,
        h: f64,
        y: &[f64; N],
        slope: [f64; N],
    ) -> Result<Self, E> {
        let mut k = [slope; STAGES];
        for (s, (row, c)) in A.iter().zip(C).enumerate().skip(1) {
            let mut at = *y;
            for (a, k) in row.iter().zip(&k) {
                at = std::array::from_fn(|i| at[i] + k[i] * (h * a));
            }
            k[s] = f(x + h * c, &at)?;
        }
        let mean = sum(&B, &k);
        Ok(Self {
            h,
            k,
            mean,
            y: std::array::from_fn(|i| y[i] + mean[i] * h),
        })
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

/// Where the stages lie within a step.
const C: [f64; STAGES] = [
    0.0,
    0.052_600_151_958_767_73,
    0.078_900_227_938_151_6,
    0.118_350_341_907_227_4,
    0.281_649_658_092_772_6,
    0.333_333_333_333_333_3,
    0.25,
    0.307_692_307_692_307_7,
    0.651_282_051_282_051_3,
    0.6,
    0.857_142_857_142_857_1,
    1.0,
];
/// Coefficients of each stage.
const A: [&[f64]; STAGES] = [
    &[],
    &[0.052_600_151_958_767_73],
    &[0.019_725_056_984_537_9, 0.059_175_170_953_613_7],
    &[0.029_587_585_476_806_85, 0.0, 0.088_762_756_430_420_54],
    &[
        0.241_365_134_159_266_7,
        0.0,
        -0.884_549_479_328_286_1,
        0.924_834_003_261_792,
    ],
    &[
        0.037_037_037_037_037_035,
        0.0,
        0.0,
        0.170_828_608_729_473_86,
        0.125_467_687_566_822_42,
    ],
    &[
        0.037_109_375,
        0.0,
        0.0,
        0.170_252_211_019_544_05,
        0.060_216_538_980_455_96,
        -0.017_578_125,
    ],
    &[
        0.037_092_000_118_504_79,
        0.0,
        0.0,
        0.170_383_925_712_239_98,
        0.107_262_030_446_373_28,
        -0.015_319_437_748_624_402,
        0.008_273_789_163_814_023,
    ],
    &[
        0.624_110_958_716_075_7,
        0.0,
        0.0,
        -3.360_892_629_446_941_4,
        -0.868_219_346_841_726,
        27.592_099_699_446_71,
        20.154_067_550_477_894,
        -43.489_884_181_069_96,
    ],
    &[
        0.477_662_536_438_264_34,
        0.0,
        0.0,
        -2.488_114_619_971_667_7,
        -0.590_290_826_836_843,
        21.230_051_448_181_193,
        15.279_233_632_882_423,
        -33.288_210_968_984_86,
        -0.020_331_201_708_508_627,
    ],
    &[
        -0.937_142_430_085_987_3,
        0.0,
        0.0,
        5.186_372_428_844_064,
        1.091_437_348_996_729_5,
        -8.149_787_010_746_927,
        -18.520_065_659_996_96,
        22.739_487_099_350_505,
        2.493_605_552_679_652_3,
        -3.046_764_471_898_219_6,
    ],
    &[
        2.273_310_147_516_538,
        0.0,
        0.0,
        -10.534_495_466_737_25,
        -2.000_872_058_224_862_5,
        -17.958_931_863_118_8,
        27.948_884_529_419_96,
        -2.858_998_277_135_023_5,
        -8.872_856_933_530_63,
        12.360_567_175_794_303,
        0.643_392_746_015_763_6,
    ],
];
/// The solution of order 8.
const B: [f64; STAGES] = [
    0.054_293_734_116_568_765,
    0.0,
    0.0,
    0.0,
    0.0,
    4.450_312_892_752_409,
    1.891_517_899_314_500_3,
    -5.801_203_960_010_585,
    0.311_164_366_957_819_9,
    -0.152_160_949_662_516_1,
    0.201_365_400_804_030_34,
    0.044_710_615_727_772_59,
];
/// Error by the solution of order 5.
const E5: [f64; STAGES] = [
    0.013_120_044_994_194_88,
    0.0,
    0.0,
    0.0,
    0.0,
    -1.225_156_446_376_204_4,
    -0.495_758_949_657_250_2,
    1.664_377_182_454_986_4,
    -0.350_328_848_749_973_66,
    0.334_179_118_713_017_5,
    0.081_923_206_485_115_71,
    -0.022_355_307_863_886_294,
];
/// The solution of order 3: (stage, share).
const B3: [(usize, f64); 3] = [
    (0, 0.244_094_488_188_976_4),
    (8, 0.733_846_688_281_611_8),
    (11, 0.022_058_823_529_411_766),
];

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    const FINE: Accuracy = Accuracy {
        tolerance: 1e-12,
        most_steps: 100_000,
    };

    fn one_step<const N: usize>(
        f: impl Fn(f64, &[f64; N]) -> [f64; N],
        x: f64,
        h: f64,
        y: [f64; N],
    ) -> Step<N> {
        let f = |x: f64, y: &[f64; N]| Ok::<_, Infallible>(f(x, y));
        let Ok(slope) = f(x, &y);
        let Ok(step) = Step::new(f, x, h, &y, slope);
        step
    }

    /// Each stage lies where its shares say.
    #[test]
    fn nodes_are_the_sums_of_their_rows() {
        for (row, c) in A.iter().zip(C) {
            let size: f64 = row.iter().map(|a| a.abs()).sum();
            let sum: f64 = row.iter().sum();
            assert!((sum - c).abs() <= 4.0 * f64::EPSILON * size, "{c}: {sum}");
        }
    }

    /// A polynomial is integrated without error up to order 8 and not beyond; the estimates see it from orders 5 and 3 on.
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

    /// Half the step has a 2⁹th of the error: a pendulum, whose f is not linear, with time in it.
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

    /// Growth over 1500 steps and more: no end before the end.
    #[test]
    fn a_long_way_keeps_its_tolerance() {
        let f = |_: f64, y: &[f64; 1]| Ok::<_, Infallible>([y[0]]);
        let steps = FINE.steps(f, [1.0], 600.0, |_, _| Ok(false));
        let steps = steps.unwrap();
        let (x, [y]) = steps[steps.len() - 1];
        assert!((x - 600.0).abs() < 1e-12, "{x}");
        assert!(steps.len() > 1500, "{}", steps.len());
        assert!((y / 600f64.exp() - 1.0).abs() < 1e-8, "{y}");
    }

    #[test]
    fn ends_where_it_is_enough_or_impossible() {
        let f = |_: f64, y: &[f64; 2]| Ok::<_, ()>([y[1], -y[0]]);
        let steps = FINE.steps(f, [0.0, 1.0], 100.0, |_, y| Ok(y[1] < 0.0));
        let steps = steps.unwrap();
        assert!(steps[..steps.len() - 1].iter().all(|(_, y)| y[1] >= 0.0));
        let (x, y) = steps[steps.len() - 1];
        assert!(x < 4.0 && y[1] < 0.0, "{x}");

        let few = Accuracy {
            most_steps: 3,
            ..FINE
        };
        let found = few.steps(f, [0.0, 1.0], 100.0, |_, _| Ok(false));
        assert!(matches!(found, Err(Stopped::TooManySteps { x }) if x > 0.0));
        let found = FINE.steps(
            |x, _: &[f64; 1]| if x < 1.0 { Ok([1.0]) } else { Err("far") },
            [0.0],
            9.0,
            |_, _| Ok(false),
        );
        assert_eq!(found, Err(Stopped::Function("far")));
        for nonsense in [f64::NAN, f64::INFINITY] {
            let found = FINE.steps(
                |_, _: &[f64; 1]| Ok::<_, ()>([nonsense]),
                [0.0],
                1.0,
                |_, _| Ok(false),
            );
            assert!(found.is_err(), "{found:?}");
        }
        // 1/(1 − x) has no value at 1.
        let found = FINE.steps(
            |_, y: &[f64; 1]| Ok::<_, ()>([y[0] * y[0]]),
            [1.0],
            2.0,
            |_, _| Ok(false),
        );
        assert!(
            matches!(found, Err(Stopped::StepTooSmall { x }) if (x - 1.0).abs() < 1e-6),
            "{found:?}"
        );
    }
}
