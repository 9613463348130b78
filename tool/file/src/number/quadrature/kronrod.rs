//! Gauss-Kronrod rules: a Gauss rule, additional places that give nearly twice its degree, and the difference of both.
//!
//! ```text
//! ∫₋₁¹ f dx ≈ K = Σ wₖ·f(xₖ)        error ≈ s·min(1, (200·|K − G|/s)^1.5)        s = ∫|f − f‾| dx
//! ```
//!
//! K with 2n + 1 places is exact to degree 3n + 1, G with n of them to 2n − 1. The estimate is by R. Piessens and others, QUADPACK, Springer 1983:
//! where both rules converge, K is better than G by many more digits; where they do not, as at a kink, the estimate is cautious. It is limited to at
//! least 0.15·|K − G|. The polynomial through the places is evaluated in barycentric form (J.-P. Berrut, L. N. Trefethen, Barycentric Lagrange
//! interpolation, SIAM Review 46 (2004) 501).

use crate::math;

/// Most places of a rule.
pub const MOST_PLACES: usize = 15;

/// A pair of rules on −1 to 1 with their places in order.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    places: &'static [f64],
    weights: &'static [f64],
    /// Weights of the Gauss rule; zero at the additional places.
    gauss: &'static [f64],
    /// Weights of the barycentric form.
    barycentric: &'static [f64],
}

/// An integral from −1 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// K.
    pub integral: f64,
    /// Estimate of its error.
    pub error: f64,
    /// ∫|f|.
    pub size: f64,
}

/// Least estimate as a share of |K − G|: at a slight kink K is hardly better than G.
const OF_DIFFERENCE: f64 = 0.15;

/// Least estimate as a share of ∫|f|: rounding.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

impl Rule {
    /// The places, between −1 and 1.
    pub const fn places(&self) -> &'static [f64] {
        self.places
    }

    /// Their weights in K; they are positive, and their sum is 2.
    pub const fn weights(&self) -> &'static [f64] {
        self.weights
    }

    /// The rule with this number of places.
    pub const fn of_count(count: usize) -> Option<&'static Self> {
        match count {
            7 => Some(&KRONROD_7),
            15 => Some(&KRONROD_15),
            _ => None,
        }
    }

    /// The integral of the values at the places, with its error.
    pub fn estimate(&self, values: &[f64]) -> Estimate {
        let [mut integral, mut gauss, mut size] = [0.0; 3];
        for ((value, weight), coarse) in values.iter().zip(self.weights).zip(self.gauss) {
            integral += weight * value;
            gauss += coarse * value;
            size += weight * value.abs();
        }
        let mean = 0.5 * integral;
        let spread = values.iter().zip(self.weights);
        let spread: f64 = spread.map(|(v, weight)| weight * (v - mean).abs()).sum();
        let difference = (integral - gauss).abs();
        let error = if spread > 0.0 {
            spread * math::pow(200.0 * difference / spread, 1.5).min(1.0)
        } else {
            difference
        };
        Estimate {
            integral,
            error: error.max(OF_DIFFERENCE * difference).max(ROUNDING * size),
            size,
        }
    }

    /// The polynomial through the values at x, which may lie beyond the places.
    pub fn at(&self, values: &[f64], x: f64) -> f64 {
        let [mut above, mut below] = [0.0; 2];
        for ((place, weight), value) in self.places.iter().zip(self.barycentric).zip(values) {
            let way = x - place;
            if way == 0.0 {
                return *value;
            }
            let share = weight / way;
            above += share * value;
            below += share;
        }
        above / below
    }

    /// The integral of `f` over [a, b], which lies within −1 to 1.
    pub fn over(&self, [a, b]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
        let (middle, half) = (a.midpoint(b), 0.5 * (b - a));
        let terms = self.places.iter().zip(self.weights);
        half * terms.map(|(x, w)| w * f(middle + half * x)).sum::<f64>()
    }

    /// The integral of `f` over [a, b]. The part with the largest error is halved until the total error is estimated below `share` of ∫|f| or below
    /// `least`, or until halving no longer helps, as for a curve that is only rounding. A non-finite value makes the result non-finite.
    pub fn adaptive(
        &self,
        [a, b]: [f64; 2],
        (share, least): (f64, f64),
        f: &impl Fn(f64) -> f64,
    ) -> f64 {
        let whole = self.part([a, b], f);
        let is_enough =
            |error: f64, size: f64| error <= (share * size).max(least) || !error.is_finite();
        if is_enough(whole.error, whole.size) {
            return whole.integral;
        }
        let mut parts = vec![whole];
        let mut useless = 0;
        while parts.len() < MOST_PARTS && useless < MOST_USELESS {
            let worst = (0..parts.len()).max_by(|i, k| parts[*i].error.total_cmp(&parts[*k].error));
            let Some(worst) = worst else { break };
            let cut = parts[worst];
            let [a, b] = cut.ends;
            let middle = a.midpoint(b);
            let halves = [[a, middle], [middle, b]].map(|ends| self.part(ends, f));
            useless += u32::from(halves[0].error + halves[1].error > USELESS * cut.error);
            parts[worst] = halves[0];
            parts.push(halves[1]);
            let sum = |of: fn(&Subinterval) -> f64| parts.iter().map(of).sum::<f64>();
            if is_enough(sum(|part| part.error), sum(|part| part.size)) {
                break;
            }
        }
        parts.iter().map(|part| part.integral).sum()
    }

    fn part(&self, [a, b]: [f64; 2], f: &impl Fn(f64) -> f64) -> Subinterval {
        let (middle, half) = (a.midpoint(b), 0.5 * (b - a));
        let mut values = [0.0; MOST_PLACES];
        for (value, x) in values.iter_mut().zip(self.places) {
            *value = f(middle + half * x);
        }
        let found = self.estimate(&values[..self.places.len()]);
        Subinterval {
            ends: [a, b],
            integral: half * found.integral,
            error: half * found.error,
            size: half * found.size,
        }
    }
}

/// A part of an integral.
#[derive(Clone, Copy)]
struct Subinterval {
    ends: [f64; 2],
    integral: f64,
    error: f64,
    size: f64,
}

/// The most parts of one integral: a kink takes some forty, down to the rounding of its position.
const MOST_PARTS: usize = 400;

/// Share of an error above which a halving is useless, and the number of useless halvings that end the search: for rounding they come immediately,
/// for a curve not yet resolved by the places only sometimes.
const USELESS: f64 = 0.9;
const MOST_USELESS: u32 = 20;

const fn barycentric<const N: usize>(places: &[f64; N]) -> [f64; N] {
    let mut weights = [1.0; N];
    let mut k = 0;
    while k < N {
        let mut j = 0;
        while j < N {
            if j != k {
                // Doubled distances, so that the products stay near 1.
                weights[k] /= 2.0 * (places[k] - places[j]);
            }
            j += 1;
        }
        k += 1;
    }
    weights
}

const PLACES_7: [f64; 7] = [
    -0.960_491_268_708_020_3,
    -0.774_596_669_241_483_4,
    -0.434_243_749_346_802_56,
    0.0,
    0.434_243_749_346_802_56,
    0.774_596_669_241_483_4,
    0.960_491_268_708_020_3,
];

const BARYCENTRIC_7: [f64; 7] = barycentric(&PLACES_7);

/// Three Gauss places among seven.
pub static KRONROD_7: Rule = Rule {
    places: &PLACES_7,
    weights: &[
        0.104_656_226_026_467_26,
        0.268_488_089_868_333_44,
        0.401_397_414_775_962_2,
        0.450_916_538_658_474_14,
        0.401_397_414_775_962_2,
        0.268_488_089_868_333_44,
        0.104_656_226_026_467_26,
    ],
    gauss: &[0.0, 5.0 / 9.0, 0.0, 8.0 / 9.0, 0.0, 5.0 / 9.0, 0.0],
    barycentric: &BARYCENTRIC_7,
};

const PLACES_15: [f64; 15] = [
    -0.991_455_371_120_812_6,
    -0.949_107_912_342_758_5,
    -0.864_864_423_359_769_1,
    -0.741_531_185_599_394_4,
    -0.586_087_235_467_691_1,
    -0.405_845_151_377_397_2,
    -0.207_784_955_007_898_47,
    0.0,
    0.207_784_955_007_898_47,
    0.405_845_151_377_397_2,
    0.586_087_235_467_691_1,
    0.741_531_185_599_394_4,
    0.864_864_423_359_769_1,
    0.949_107_912_342_758_5,
    0.991_455_371_120_812_6,
];

const BARYCENTRIC_15: [f64; 15] = barycentric(&PLACES_15);

/// Seven Gauss places among fifteen.
pub static KRONROD_15: Rule = Rule {
    places: &PLACES_15,
    weights: &[
        0.022_935_322_010_529_225,
        0.063_092_092_629_978_55,
        0.104_790_010_322_250_18,
        0.140_653_259_715_525_92,
        0.169_004_726_639_267_9,
        0.190_350_578_064_785_4,
        0.204_432_940_075_298_9,
        0.209_482_141_084_727_82,
        0.204_432_940_075_298_9,
        0.190_350_578_064_785_4,
        0.169_004_726_639_267_9,
        0.140_653_259_715_525_92,
        0.104_790_010_322_250_18,
        0.063_092_092_629_978_55,
        0.022_935_322_010_529_225,
    ],
    gauss: &[
        0.0,
        0.129_484_966_168_869_7,
        0.0,
        0.279_705_391_489_276_64,
        0.0,
        0.381_830_050_505_118_9,
        0.0,
        0.417_959_183_673_469_4,
        0.0,
        0.381_830_050_505_118_9,
        0.0,
        0.279_705_391_489_276_64,
        0.0,
        0.129_484_966_168_869_7,
        0.0,
    ],
    barycentric: &BARYCENTRIC_15,
};

#[cfg(test)]
#[expect(
    clippy::disallowed_methods,
    reason = "functions of another library than the code's"
)]
mod tests {
    use super::{KRONROD_7, KRONROD_15, Rule};

    const RULES: [(&Rule, i32); 2] = [(&KRONROD_7, 3), (&KRONROD_15, 7)];

    fn values(rule: &Rule, f: impl Fn(f64) -> f64) -> Vec<f64> {
        rule.places().iter().map(|x| f(*x)).collect()
    }

    /// Both rules integrate Legendre polynomials of their degree to rounding, and not the next one.
    #[test]
    fn degrees() {
        // P_n by its recurrence; its integral is zero for n > 0.
        let legendre = |n: i32, x: f64| {
            let (mut before, mut now) = (1.0, x);
            for k in 1..n {
                let k = f64::from(k);
                (before, now) = (now, ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0));
            }
            if n == 0 { 1.0 } else { now }
        };
        for (rule, n) in RULES {
            let with = |weights: &[f64], degree: i32| {
                let terms = rule.places().iter().zip(weights);
                terms.map(|(x, w)| w * legendre(degree, *x)).sum::<f64>()
            };
            assert!((with(rule.weights, 0) - 2.0).abs() < 1e-15);
            for degree in 1..=3 * n + 1 {
                assert!(with(rule.weights, degree).abs() < 2e-15, "{n} {degree}");
            }
            for degree in 1..2 * n {
                assert!(with(rule.gauss, degree).abs() < 2e-15, "{n} {degree}");
            }
            // The rules are even: 3n + 2 is odd where n is.
            assert!(with(rule.weights, 3 * n + 3).abs() > 1e-6);
            assert!(with(rule.gauss, 2 * n).abs() > 1e-3);
        }
    }

    /// A polynomial of its degree is reproduced between the places, at them and at the ends.
    #[test]
    fn the_polynomial_through_the_places() {
        for (rule, n) in RULES {
            let f = |x: f64| (0..=2 * n).fold(0.0, |sum, k| sum * x + f64::from(k) - 2.5);
            let values = values(rule, f);
            for x in [-1.0, -0.97, -0.3, 0.0, 0.434_243_749_346_802_56, 0.5, 1.0] {
                assert!(
                    (rule.at(&values, x) - f(x)).abs() < 1e-13 * f(1.0).abs(),
                    "{x}"
                );
            }
            let part = rule.over([-0.5, 0.75], |x| rule.at(&values, x));
            let exact = KRONROD_15.over([-0.5, 0.75], f);
            assert!((part - exact).abs() < 1e-13 * exact.abs());
        }
    }

    /// The error is not above its estimate for a smooth curve, and for one with a kink.
    #[test]
    fn errors_are_estimated() {
        type Curve = fn(f64) -> f64;
        let curves: [(Curve, f64); 4] = [
            (f64::exp, 1f64.exp() - (-1f64).exp()),
            (|x| (9.0 * x).cos(), 2.0 * 9f64.sin() / 9.0),
            (|x| 1.0 / (1.0 + 25.0 * x * x), 0.4 * 5f64.atan()),
            (|x| (x - 0.3).max(0.0), 0.245),
        ];
        for (f, exact) in curves {
            for (rule, _) in RULES {
                let found = rule.estimate(&values(rule, f));
                let off = (found.integral - exact).abs();
                assert!(off <= found.error, "{off} {}", found.error);
                let sum = rule.adaptive([-1.0, 1.0], (1e-12, 0.0), &f);
                assert!((sum - exact).abs() < 2e-12 * exact, "{sum} {exact}");
            }
        }
    }

    /// A non-finite value gives a non-finite sum immediately.
    #[test]
    fn what_is_not_finite_stays_so() {
        let sum = KRONROD_15.adaptive([-1.0, 1.0], (1e-12, 0.0), &|x| {
            if x > 0.9 { f64::NAN } else { 1.0 }
        });
        assert!(sum.is_nan());
    }
}
