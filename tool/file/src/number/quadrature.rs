//! Gauss-Legendre rules, on 0 to 1 unless they are centred: places and weights. A rule of n points is exact to degree 2n − 1. Rules with an error
//! estimate, and the polynomial through their places: [`kronrod`].

pub mod kronrod;

/// Two points.
pub const GAUSS_2: [[f64; 2]; 2] = [
    [0.211_324_865_405_187_1, 0.5],
    [0.788_675_134_594_812_9, 0.5],
];

/// Three points.
pub const GAUSS_3: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_3, 5.0 / 18.0],
    [0.5, 8.0 / 18.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];

/// Five points.
pub const GAUSS_5: [[f64; 2]; 5] = [
    [0.046_910_077_030_668_004, 0.118_463_442_528_094_54],
    [0.230_765_344_947_158_45, 0.239_314_335_249_683_23],
    [0.5, 0.284_444_444_444_444_44],
    [0.769_234_655_052_841_5, 0.239_314_335_249_683_23],
    [0.953_089_922_969_332, 0.118_463_442_528_094_54],
];

/// The five points on −1 to 1, for sums about the middle of an interval.
pub const CENTRED_GAUSS_5: [[f64; 2]; 5] = [
    [-0.906_179_845_938_664, 0.236_926_885_056_189_1],
    [-0.538_469_310_105_683, 0.478_628_670_499_366_5],
    [0.0, 128.0 / 225.0],
    [0.538_469_310_105_683, 0.478_628_670_499_366_5],
    [0.906_179_845_938_664, 0.236_926_885_056_189_1],
];

#[cfg(test)]
mod tests {
    use super::{CENTRED_GAUSS_5, GAUSS_2, GAUSS_3, GAUSS_5};

    #[test]
    fn both_of_five_points_are_the_same() {
        for ([z, weight], [x, centred]) in GAUSS_5.into_iter().zip(CENTRED_GAUSS_5) {
            assert!((2.0 * z - 1.0 - x).abs() < 2.0 * f64::EPSILON);
            assert!((2.0 * weight - centred).abs() < 2.0 * f64::EPSILON);
        }
    }

    /// Each rule integrates powers of its degree to rounding, and not the next power.
    #[test]
    fn degrees() {
        for rule in [&GAUSS_2[..], &GAUSS_3, &GAUSS_5] {
            let degree = 2 * rule.len() as i32 - 1;
            let error = |power: i32| {
                let sum: f64 = rule.iter().map(|[z, weight]| weight * z.powi(power)).sum();
                (sum * f64::from(power + 1) - 1.0).abs()
            };
            assert!((0..=degree).all(|power| error(power) < 4.0 * f64::EPSILON));
            assert!(error(degree + 1) > 1e-6);
        }
    }
}
