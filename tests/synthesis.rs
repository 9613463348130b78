//! Gear ratio synthesis: the optimum against textbook conditions, its derivatives, a grid, and the train of (6.9).

use crate::support::{assert_near, budget, config, derivative, largest};
use jred::mechanism::synthesis::{OpenStage, OpenTrain, RatioSplit, WheelInertia};
use jred::mechanism::{Stage, Train};
use jred::number::RangeError;
use proptest::prelude::*;

const WIDE: [f64; 2] = [0.01, 1e4];

/// Equal pinions of inertia 1, no load.
fn equal_pinions(ratio: f64, stages: usize, bounds: [f64; 2]) -> RatioSplit {
    RatioSplit::new(OpenTrain {
        ratio,
        stages: &vec![OpenStage::geared(1.0); stages],
        output: 0.0,
        bounds,
    })
    .unwrap()
}

/// Two stages: J = 1 + i₁² + 1/i₁² + i²/i₁⁴ is smallest for i₂² = (i₁⁴ − 1)/2.
#[test]
fn two_equal_pinions_follow_the_textbook() {
    for ratio in [2.0, 5.0, 12.0, 40.0, 200.0, 1e4] {
        let best = equal_pinions(ratio, 2, WIDE).optimum();
        let [first, second] = best.ratios[..] else {
            panic!("two ratios")
        };
        assert_near("product", first * second, ratio, budget::SPLIT * ratio);
        let textbook = (first.powi(4) - 1.0) / 2.0;
        assert_near(
            "i2²",
            second * second,
            textbook,
            budget::SPLIT * textbook * 10.0,
        );
        let inertia = 1.0 + first * first + 1.0 / (first * first) + ratio * ratio / first.powi(4);
        assert_near("J", best.inertia, inertia, budget::SPLIT * inertia);
    }
    // i₁ = 3: i₂ = √40, i = 3·√40.
    let best = equal_pinions(3.0 * 40f64.sqrt(), 2, WIDE).optimum();
    assert_near("i1", best.ratios[0], 3.0, 3.0 * budget::SPLIT);
}

/// Large ratios: i_k = √2·(i/2^(n/2))^(2^(k−1)/(2ⁿ − 1)), which neglects the pinions after the first.
#[test]
fn many_equal_pinions_tend_to_the_textbook_form() {
    for stages in 2..=4usize {
        let n = i32::try_from(stages).unwrap();
        let miss = |ratio: f64| {
            let best = equal_pinions(ratio, stages, [1.0, 1e7]).optimum();
            let form = |k: i32| {
                let share = 2f64.powi(k - 1) / (2f64.powi(n) - 1.0);
                2f64.sqrt() * (ratio / 2f64.powf(f64::from(n) / 2.0)).powf(share)
            };
            let each = best
                .ratios
                .iter()
                .zip(1..)
                .map(|(found, k)| found / form(k) - 1.0);
            largest(each)
        };
        // The neglected term is 1/i₁⁴ of the others.
        let [small, large] = [1e2, 1e4].map(|ratio: f64| miss(ratio * 30f64.powi(n - 2)));
        assert!(
            large < 0.02 && large < 0.4 * small,
            "{stages} stages: {small}, {large}"
        );
    }
}

/// A load equal to a constant driven wheel at the end only changes J.
#[test]
fn a_load_at_the_output_adds_its_reduced_inertia() {
    for stages in 2..=4 {
        let bare = equal_pinions(60.0, stages, WIDE);
        let loaded = RatioSplit::new(OpenTrain {
            ratio: 60.0,
            stages: &vec![OpenStage::geared(1.0); stages],
            output: 500.0,
            bounds: WIDE,
        })
        .unwrap();
        let [a, b] = [bare.optimum(), loaded.optimum()];
        assert_near(
            "J_L/i²",
            b.inertia - a.inertia,
            500.0 / 3600.0,
            budget::SPLIT * b.inertia,
        );
        for (one, other) in a.ratios.iter().zip(&b.ratios) {
            assert_near("ratio", *one, *other, 1e-7 * one);
        }
    }
}

/// Constant inertias: as much ratio as possible in front, up to the bound.
#[test]
fn constant_wheels_put_the_ratio_in_front() {
    let stage = OpenStage {
        driver: 1.0,
        driven: WheelInertia::Constant(3.0),
    };
    let split = RatioSplit::new(OpenTrain {
        ratio: 60.0,
        stages: &[stage; 3],
        output: 10.0,
        bounds: [1.5, 8.0],
    })
    .unwrap();
    let best = split.optimum();
    for (found, expected) in best.ratios.iter().zip([8.0, 5.0, 1.5]) {
        assert_near("ratio", *found, expected, 1e-12 * expected);
    }
    assert_near("first", split.first_range()[0], 1.5, 1e-12);
    assert_near("first", split.first_range()[1], 8.0, 1e-12);
}

#[derive(Clone, Debug)]
struct Spec {
    split: RatioSplit,
    stages: Vec<OpenStage>,
    output: f64,
    bounds: [f64; 2],
}

prop_compose! {
    fn spec(most: usize)(
        count in 2..=most,
        drivers in [0.01..5.0_f64, 0.01..5.0, 0.01..5.0, 0.01..5.0],
        driven in [0.01..5.0_f64, 0.01..5.0, 0.01..5.0, 0.01..5.0],
        constant in [any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>()],
        output in 0.0..500.0_f64,
        low in 0.5..2.0_f64,
        width in 1.5..12.0_f64,
        share in 0.02..0.98_f64,
    ) -> Spec {
        let stages: Vec<OpenStage> = (0..count).map(|k| OpenStage {
            driver: drivers[k],
            driven: if constant[k] { WheelInertia::Constant(driven[k]) } else { WheelInertia::LikePinion(driven[k]) },
        }).collect();
        let bounds = [low, low * width];
        let ratio = (count as f64 * (low.ln() + share * width.ln())).exp();
        let split = RatioSplit::new(OpenTrain { ratio, stages: &stages, output, bounds }).unwrap();
        Spec { split, stages, output, bounds }
    }
}

impl Spec {
    /// J by the train of (6.9), the load on its last shaft.
    fn by_the_train(&self, ratios: &[f64]) -> f64 {
        let last = self.stages.len() - 1;
        let stage = |(k, (stage, ratio)): (usize, (&OpenStage, &f64))| {
            let driven = match stage.driven {
                WheelInertia::Constant(inertia) => inertia,
                WheelInertia::LikePinion(pinion) => pinion * ratio.powi(4),
            };
            let load = if k == last { self.output } else { 0.0 };
            Stage::new(*ratio, [stage.driver, driven + load]).unwrap()
        };
        let stages: Vec<Stage> = self
            .stages
            .iter()
            .zip(ratios)
            .enumerate()
            .map(stage)
            .collect();
        Train::new(&stages).unwrap().inertia_at_input()
    }

    /// Every stage within its bounds, the product right, J that of the train, and the slopes of a minimum.
    fn check(&self, best: &jred::mechanism::synthesis::Split, fixed_first: bool) {
        let [low, high] = self.bounds;
        let product: f64 = best.ratios.iter().product();
        assert_near(
            "product",
            product,
            self.split.ratio(),
            budget::SPLIT * self.split.ratio(),
        );
        let train = self.by_the_train(&best.ratios);
        assert_near("J", best.inertia, train, budget::SPLIT * train);
        let slopes = self.split.slopes(&best.ratios);
        let skip = usize::from(fixed_first);
        let held = |ratio: f64| ratio <= low * (1.0 + 1e-9) || ratio >= high * (1.0 - 1e-9);
        let each = || best.ratios.iter().zip(&slopes).skip(skip);
        for (ratio, _) in each() {
            assert!(
                *ratio >= low * (1.0 - 1e-9) && *ratio <= high * (1.0 + 1e-9),
                "{ratio}"
            );
        }
        // Moving ratio from one stage to another gains nothing: the giver's slope is not above the taker's.
        for (giver, from) in each() {
            for (taker, to) in each() {
                let can = *giver > low * (1.0 + 1e-9) && *taker < high * (1.0 - 1e-9);
                assert!(
                    !can || from - to <= budget::SPLIT_SLOPE * train,
                    "{best:?}, {slopes:?}"
                );
                if !held(*giver) && !held(*taker) {
                    assert_near("J′", from - to, 0.0, budget::SPLIT_SLOPE * train);
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(config(150, 0x0591))]

    #[test]
    fn no_other_split_is_better(spec in spec(3), share in 0.0..1.0_f64) {
        let best = spec.split.optimum();
        spec.check(&best, false);
        // The curve over the split has its minimum there.
        let [least, most] = spec.split.first_range();
        let first = least + share * (most - least);
        let other = spec.split.with_first(first).unwrap();
        spec.check(&other, true);
        prop_assert!(other.inertia >= best.inertia * (1.0 - budget::SPLIT));
        let same = spec.split.with_first(best.ratios[0].clamp(least, most)).unwrap();
        assert_near("the curve's minimum", same.inertia, best.inertia, budget::SPLIT * best.inertia);
        let ratio = spec.split.equal().ratios[0];
        if ratio >= spec.bounds[0] && ratio <= spec.bounds[1] {
            prop_assert!(spec.split.equal().inertia >= best.inertia * (1.0 - budget::SPLIT));
        }
    }

    /// The slopes are the derivatives of J by ln i_k.
    #[test]
    fn slopes_are_derivatives(spec in spec(4), share in [0.2..5.0_f64, 0.2..5.0, 0.2..5.0, 0.2..5.0]) {
        let ratios = &share[..spec.split.stages()];
        let slopes = spec.split.slopes(ratios);
        for k in 0..ratios.len() {
            let along = |y: f64| {
                let mut ratios = ratios.to_vec();
                ratios[k] *= y.exp();
                spec.split.inertia(&ratios)
            };
            let size = spec.split.inertia(ratios);
            assert_near("∂J/∂y", slopes[k], derivative(along, 0.0, 1.0 / 64.0), budget::RICHARDSON * size * 10.0);
        }
    }
}

proptest! {
    #![proptest_config(config(12, 0x0592))]

    #[test]
    fn four_stages_have_equal_slopes(spec in spec(4)) {
        spec.check(&spec.split.optimum(), false);
    }
}

/// Nothing on a grid of two free ratios is better.
#[test]
fn a_grid_finds_nothing_better() {
    let stages = [
        OpenStage::geared(1.0),
        OpenStage::geared(2.0),
        OpenStage {
            driver: 4.0,
            driven: WheelInertia::Constant(300.0),
        },
    ];
    let split = RatioSplit::new(OpenTrain {
        ratio: 90.0,
        stages: &stages,
        output: 800.0,
        bounds: [1.0, 10.0],
    })
    .unwrap();
    let best = split.optimum();
    let mut least = f64::INFINITY;
    for a in 0..=400 {
        for b in 0..=400 {
            let [first, second] = [a, b].map(|k| (f64::from(k) / 400.0 * 10f64.ln()).exp());
            let third = 90.0 / first / second;
            if (1.0..=10.0).contains(&third) {
                least = least.min(split.inertia(&[first, second, third]));
            }
        }
    }
    assert!(
        best.inertia <= least && least < best.inertia * 1.001,
        "{best:?}, {least}"
    );
    assert!(split.equal().inertia > best.inertia);
}

#[test]
fn what_cannot_be_split_is_refused() {
    let geared = [OpenStage::geared(1.0); 3];
    let refused = |ratio, stages: &[OpenStage], output, bounds| {
        RatioSplit::new(OpenTrain {
            ratio,
            stages,
            output,
            bounds,
        })
        .unwrap_err()
        .to_string()
    };
    assert_eq!(
        refused(10.0, &geared[..1], 0.0, WIDE),
        "number of stages is 1, outside 2 to 4"
    );
    assert_eq!(
        refused(2000.0, &geared, 0.0, [1.0, 10.0]),
        "total ratio is 2000, outside 1 to 1000"
    );
    assert_eq!(
        refused(0.0, &geared, 0.0, WIDE),
        "total ratio is 0, but must be greater than zero"
    );
    assert_eq!(
        refused(-5.0, &geared, 0.0, WIDE),
        "total ratio is -5, but must be greater than zero"
    );
    assert_eq!(
        refused(5.0, &geared, -1.0, WIDE),
        "inertia at the output is -1, but must not be negative"
    );
    assert_eq!(
        refused(5.0, &geared, 0.0, [0.0, 2.0]),
        "smallest stage ratio is 0, but must be greater than zero"
    );
    assert_eq!(
        refused(5.0, &geared, 0.0, [3.0, 2.0]),
        "largest stage ratio is 2, less than 3"
    );
    assert_eq!(
        refused(5.0, &geared, 0.0, [1.0, f64::NAN]),
        "largest stage ratio is not a finite number"
    );
    let bad = OpenStage {
        driver: f64::NAN,
        driven: WheelInertia::Constant(1.0),
    };
    assert_eq!(
        refused(5.0, &[bad; 2], 0.0, WIDE),
        "inertia of the driver is not a finite number"
    );
    let none = [
        OpenStage {
            driver: 1.0,
            driven: WheelInertia::Constant(0.0),
        },
        OpenStage {
            driver: 0.0,
            driven: WheelInertia::Constant(2.0),
        },
    ];
    assert_eq!(
        refused(5.0, &none, 1.0, WIDE),
        "inertia between input and output is 0, but must be greater than zero"
    );
    let split = equal_pinions(20.0, 2, [1.0, 10.0]);
    assert_eq!(
        split.with_first(1.5).unwrap_err(),
        RangeError::OutOfRange {
            what: "ratio of the first stage",
            value: 1.5,
            min: 2.0,
            max: 10.0
        }
    );
    // At the edge of the bounds, all stages are at a bound.
    let edge = equal_pinions(100.0, 2, [1.0, 10.0]).optimum();
    assert_near("edge", edge.ratios[0], 10.0, 1e-12);
    assert_near("edge", edge.ratios[1], 10.0, 1e-11);
}
