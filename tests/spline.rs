//! The cubic spline: exact at knots, closed or with not-a-knot ends, of the stated order.

use std::f64::consts::TAU;

use crate::support::{assert_near, budget, config, largest};
use jred::table::{CubicSpline, control_points, fit_bounded, fit_periodic};
use proptest::prelude::*;

fn periodic(samples: &[f64]) -> CubicSpline<Vec<f64>> {
    let mut control = vec![0.0; control_points(samples.len())];
    fit_periodic(samples, &mut control).unwrap();
    CubicSpline::new(control).unwrap()
}

fn bounded(samples: &[f64]) -> CubicSpline<Vec<f64>> {
    let mut control = vec![0.0; control_points(samples.len() - 1)];
    fit_bounded(samples, &mut control).unwrap();
    CubicSpline::new(control).unwrap()
}

proptest! {
    #![proptest_config(config(128, 0x0004))]

    #[test]
    fn splines_pass_through_their_samples(samples in prop::collection::vec(-5.0..5.0, 5..70)) {
        let cells = samples.len() as f64;
        let turn = periodic(&samples);
        let stroke = bounded(&samples);
        for (k, sample) in samples.iter().enumerate() {
            let k = k as f64;
            let knot = budget::SPLINE_KNOT * 5.0;
            assert_near("periodic", turn.at(k / cells)[0], *sample, knot * cells);
            assert_near("bounded", stroke.at(k / (cells - 1.0))[0], *sample, knot * cells);
        }
        assert_eq!((turn.cells(), stroke.cells()), (samples.len(), samples.len() - 1));
        // The turn closes with value, slope and curvature.
        let [start, end] = [turn.at(0.0), turn.at(1.0)];
        for (order, (a, b)) in start.iter().zip(end).enumerate() {
            let size = 30.0 * cells.powi(order as i32);
            assert_near("closure", b, *a, budget::SPLINE_END * size);
        }
        // Not-a-knot: the first two cells are one cubic, so its third difference over them is constant; likewise the last.
        for ends in [0.0, cells - 3.0] {
            let curvature = |k: f64| stroke.at((ends + k) / (cells - 1.0))[2];
            let second = curvature(0.0) - 2.0 * curvature(1.0) + curvature(2.0);
            assert_near("not-a-knot", second, 0.0, budget::SPLINE_END * 300.0 * cells.powi(2));
        }
    }

    #[test]
    fn bounded_ends_reproduce_a_cubic(c in [-3.0..3.0, -3.0..3.0, -3.0..3.0, -3.0f64..3.0], cells in 4usize..100) {
        let value = |x: f64| c[0] + x * (c[1] + x * (c[2] + x * c[3]));
        let samples: Vec<f64> = (0..=cells).map(|k| value(k as f64 / cells as f64)).collect();
        let curve = bounded(&samples);
        for k in 0..=37 {
            let x = f64::from(k) / 37.0;
            let expected = [value(x), c[1] + x * (2.0 * c[2] + 3.0 * c[3] * x), 2.0 * c[2] + 6.0 * c[3] * x];
            for (order, (found, expected)) in curve.at(x).iter().zip(expected).enumerate() {
                let size = 30.0 * (cells as f64).powi(order as i32);
                assert_near("cubic", *found, expected, budget::SPLINE_END * size);
            }
        }
        let bits = |x: f64| curve.at(x).map(f64::to_bits);
        prop_assert_eq!(bits(-1.0), bits(0.0));
        prop_assert_eq!(bits(2.0), bits(1.0));
    }
}

/// Largest error of value and slope on a dense grid, for `cells` cells.
fn errors(
    cells: usize,
    fit: impl Fn(&[f64]) -> CubicSpline<Vec<f64>>,
    turn: bool,
    f: impl Fn(f64) -> [f64; 2],
) -> [f64; 2] {
    let knots = if turn { cells } else { cells + 1 };
    let samples: Vec<f64> = (0..knots).map(|k| f(k as f64 / cells as f64)[0]).collect();
    let curve = fit(&samples);
    let places = (0..=32 * cells).map(|k| k as f64 / (32 * cells) as f64);
    [0, 1].map(|order| largest(places.clone().map(|x| curve.at(x)[order] - f(x)[order])))
}

#[test]
fn value_converges_with_order_4_and_slope_with_3() {
    let turn = |x: f64| {
        let (sin, cos) = (TAU * x).sin_cos();
        [sin.exp(), TAU * cos * sin.exp()]
    };
    let stroke = |x: f64| [(2.0 * x).exp(), 2.0 * (2.0 * x).exp()];
    for cells in [64, 128] {
        for [coarse, fine] in [
            [cells, 2 * cells].map(|n| errors(n, periodic, true, turn)),
            [cells, 2 * cells].map(|n| errors(n, bounded, false, stroke)),
        ] {
            println!(
                "{cells} cells: {coarse:?}, orders {:.2} {:.2}",
                coarse[0] / fine[0],
                coarse[1] / fine[1]
            );
            assert_near(
                "order 4",
                coarse[0] / fine[0],
                16.0,
                16.0 * budget::ORDER_SHARE,
            );
            assert_near(
                "order 3",
                coarse[1] / fine[1],
                8.0,
                8.0 * budget::ORDER_SHARE,
            );
        }
    }
}
