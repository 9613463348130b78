//! Curves through points: orders of convergence, closed forms, no overshoot, the frequency response of smoothing.

use std::f64::consts::TAU;

use crate::support::budget;
use jred_file::number::spline::{FitMethod, Spline, SplineError};
use proptest::prelude::*;

/// Uneven steps: those of the golden ratio's fractions, between 0.4 and 1.6 of the mean.
fn uneven(count: usize, from: f64, to: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let places: Vec<f64> = (0..=count)
        .map(|k| {
            let place = sum;
            sum += 0.4 + 1.2 * (k as f64 * 0.618_033_988_749_895).fract();
            place
        })
        .collect();
    let all = places[count];
    places
        .iter()
        .map(|p| from + (to - from) * p / all)
        .collect()
}

#[test]
fn a_cubic_comes_back_exactly() {
    let f = |x: f64| 2.0 - 3.0 * x + 0.5 * x * x - 0.25 * x * x * x;
    let area = |x: f64| 2.0 * x - 1.5 * x * x + x.powi(3) / 6.0 - x.powi(4) / 16.0;
    let x = uneven(11, -2.0, 3.0);
    let y: Vec<f64> = x.iter().map(|x| f(*x)).collect();
    let spline = Spline::bounded(&x, &y, FitMethod::Interpolating).unwrap();
    for k in 0..=500 {
        let at = -2.0 + f64::from(k) / 100.0;
        let found = spline.at(at);
        let expected = [f(at), -3.0 + at - 0.75 * at * at, 1.0 - 1.5 * at, -1.5];
        for (found, expected) in found.into_iter().zip(expected) {
            assert!(
                (found - expected).abs() < budget::SPLINE_EXACT,
                "{at}: {found} {expected}"
            );
        }
        let whole = spline.integral(at) - (area(at) - area(-2.0));
        assert!(whole.abs() < budget::SPLINE_EXACT, "{whole:e}");
    }
}

/// Error of value, slope and curvature at halved steps: orders 4, 3, 2.
#[test]
fn errors_fall_with_the_order_of_a_cubic() {
    let f = |x: f64| (x.sin() + 0.3 * (2.0 * x).cos()).exp();
    let slope = |x: f64| (x.cos() - 0.6 * (2.0 * x).sin()) * f(x);
    let curvature = |x: f64| {
        let d = x.cos() - 0.6 * (2.0 * x).sin();
        (-x.sin() - 1.2 * (2.0 * x).cos() + d * d) * f(x)
    };
    for periodic in [true, false] {
        let errors = [80, 160].map(|count| {
            let mut x = uneven(count, 0.3, 0.3 + TAU);
            if periodic {
                x.pop();
            }
            let y: Vec<f64> = x.iter().map(|x| f(*x)).collect();
            let spline = if periodic {
                Spline::periodic(&x, &y, TAU, FitMethod::Interpolating)
            } else {
                Spline::bounded(&x, &y, FitMethod::Interpolating)
            }
            .unwrap();
            let mut worst = [0.0f64; 3];
            for k in 0..=5000 {
                let at = 0.3 + TAU * f64::from(k) / 5000.0;
                let found = spline.at(at);
                for (worst, (found, exact)) in
                    worst
                        .iter_mut()
                        .zip(found.into_iter().zip([f(at), slope(at), curvature(at)]))
                {
                    *worst = worst.max((found - exact).abs());
                }
            }
            worst
        });
        for (order, (coarse, fine)) in [4, 3, 2].into_iter().zip(errors[0].iter().zip(errors[1])) {
            let ratio = coarse / fine / f64::from(1 << order);
            println!("periodic {periodic}, order {order}: {coarse:.2e}, {fine:.2e}");
            assert!((0.6..2.0).contains(&ratio), "{periodic} {order}: {ratio}");
        }
    }
}

#[test]
fn a_periodic_curve_closes() {
    let x = [0.1, 0.9, 2.0, 2.2, 3.9, 5.0];
    let y = [1.0, 3.0, -2.0, 0.5, 0.0, 2.0];
    for way in [
        FitMethod::Interpolating,
        FitMethod::Smoothing(3.0),
        FitMethod::Monotone,
    ] {
        let spline = Spline::periodic(&x, &y, 6.0, way).unwrap();
        let orders = if way == FitMethod::Monotone { 2 } else { 3 };
        let [start, end] = [0.1 + 1e-9, 6.1 - 1e-9].map(|x| spline.at(x));
        for (a, b) in start.iter().zip(end).take(orders) {
            assert!((a - b).abs() < 1e-6 * (1.0 + a.abs()), "{way:?}: {a} {b}");
        }
        let [now, later] = [spline.at(4.4), spline.at(4.4 - 12.0)];
        assert!(now.iter().zip(later).all(|(a, b)| (a - b).abs() < 1e-12));
        let turn = spline.integral(6.1);
        assert!((spline.integral(4.4 + 12.0) - spline.integral(4.4) - 2.0 * turn).abs() < 1e-12);
        if way != FitMethod::Smoothing(3.0) {
            for (x, y) in x.iter().zip(y) {
                assert!((spline.at(*x)[0] - y).abs() < budget::SPLINE_EXACT);
            }
        }
    }
}

/// A sine of frequency ω keeps 1/(1 + (ω/ω_c)⁴) of its amplitude, at even and uneven steps, in a ring and in a chain.
#[test]
fn smoothing_has_the_response_that_it_states() {
    for ratio in [0.5, 1.0, 2.0] {
        let (count, waves) = (400, 4.0);
        let omega = TAU * waves;
        let cutoff = omega / ratio;
        let kept = 1.0 / (1.0 + f64::powi(ratio, 4));
        for even in [true, false] {
            let x: Vec<f64> = if even {
                (0..=count).map(|k| k as f64 / count as f64).collect()
            } else {
                uneven(count, 0.0, 1.0)
            };
            let y: Vec<f64> = x.iter().map(|x| (omega * x).sin()).collect();
            let ring =
                Spline::periodic(&x[..count], &y[..count], 1.0, FitMethod::Smoothing(cutoff))
                    .unwrap();
            let chain = Spline::bounded(&x, &y, FitMethod::Smoothing(cutoff)).unwrap();
            for k in 0..1000 {
                let at = f64::from(k) / 1000.0;
                let expected = kept * (omega * at).sin();
                let error = (ring.at(at)[0] - expected).abs();
                assert!(
                    error < budget::SMOOTHING,
                    "{ratio} {even} at {at}: {error:e}"
                );
                // The ends of a chain are felt for a few periods of the cut-off.
                if (0.4..0.6).contains(&at) && ratio <= 1.0 {
                    let error = (chain.at(at)[0] - expected).abs();
                    assert!(
                        error < budget::SMOOTHING,
                        "chain {ratio} {even} at {at}: {error:e}"
                    );
                }
            }
        }
    }
}

/// The smallest ring: four points, in which the second neighbours on both sides are one. A quarter-wave cosine's spline has, by
/// symmetry, the value 11/16 of the amplitude halfway to its zero.
#[test]
fn four_points_make_a_ring() {
    let x = [0.0, 1.0, 2.0, 3.0];
    let spline =
        Spline::periodic(&x, &[1.0, 0.0, -1.0, 0.0], 4.0, FitMethod::Interpolating).unwrap();
    assert!(
        (spline.at(0.5)[0] - 0.6875).abs() < 1e-14,
        "{:?}",
        spline.at(0.5)
    );
    let smooth =
        Spline::periodic(&x, &[1.0, 0.0, -1.0, 0.0], 4.0, FitMethod::Smoothing(1.0)).unwrap();
    let kept = smooth.at(0.0)[0];
    assert!(kept > 0.0 && kept < 1.0 && (smooth.at(2.0)[0] + kept).abs() < 1e-14);
    assert!(smooth.at(1.0)[0].abs() < 1e-14 && smooth.integral(4.0).abs() < 1e-14);
}

#[test]
fn smoothing_keeps_straight_lines_and_takes_noise() {
    let x = uneven(300, 0.0, 3.0);
    let line = |x: f64| 4.0 - 2.5 * x;
    let y: Vec<f64> = x.iter().map(|x| line(*x)).collect();
    let spline = Spline::bounded(&x, &y, FitMethod::Smoothing(20.0)).unwrap();
    assert!(x.iter().all(|x| (spline.at(*x)[0] - line(*x)).abs() < 1e-9));
    // Alternating noise is far above the cut-off.
    let noisy: Vec<f64> = y
        .iter()
        .enumerate()
        .map(|(k, y)| y + if k % 2 == 0 { 0.1 } else { -0.1 })
        .collect();
    let spline = Spline::bounded(&x, &noisy, FitMethod::Smoothing(20.0)).unwrap();
    let most = x.iter().map(|x| (spline.at(*x)[0] - line(*x)).abs());
    let most = most.fold(0.0, f64::max);
    assert!((1e-4..0.05).contains(&most), "{most}");
}

#[test]
fn points_that_cannot_be_meant_are_refused() {
    let x = [0.0, 1.0, 2.0, 3.0, 4.0];
    let y = [0.0; 5];
    let way = FitMethod::Interpolating;
    assert_eq!(
        Spline::bounded(&x[..4], &y[..4], way),
        Err(SplineError::TooFew)
    );
    assert_eq!(
        Spline::bounded(&x, &y[..4], way),
        Err(SplineError::NotRising)
    );
    assert_eq!(
        Spline::bounded(&[0.0, 1.0, 1.0, 3.0, 4.0], &y, way),
        Err(SplineError::NotRising)
    );
    assert_eq!(
        Spline::bounded(&x, &[0.0, f64::NAN, 0.0, 0.0, 0.0], way),
        Err(SplineError::NotRising)
    );
    assert_eq!(
        Spline::periodic(&x[..3], &y[..3], 4.0, way),
        Err(SplineError::TooFew)
    );
    assert_eq!(
        Spline::periodic(&x, &y, 4.0, way),
        Err(SplineError::BeyondPeriod)
    );
    assert!(Spline::periodic(&x, &y, 4.1, way).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, rng_seed: proptest::test_runner::RngSeed::Fixed(7), failure_persistence: None, ..ProptestConfig::default() })]

    /// Between two rows the monotone curve stays between their values, whatever they are; it passes through them.
    #[test]
    fn a_monotone_curve_never_overshoots(
        y in prop::collection::vec(prop_oneof![Just(0.0), -10.0..10.0f64], 5..30),
        periodic: bool,
    ) {
        let mut x = uneven(y.len(), 0.0, 1.0);
        x.pop();
        let spline = if periodic {
            Spline::periodic(&x, &y, 1.0, FitMethod::Monotone)
        } else {
            Spline::bounded(&x, &y, FitMethod::Monotone)
        }.unwrap();
        for (ends, values) in x.windows(2).zip(y.windows(2)) {
            let (low, high) = (values[0].min(values[1]), values[0].max(values[1]));
            for k in 0..=20 {
                let at = ends[0] + (ends[1] - ends[0]) * f64::from(k) / 20.0;
                let value = spline.at(at)[0];
                prop_assert!(value >= low - 1e-12 && value <= high + 1e-12, "{value} {low} {high}");
            }
        }
        let least = y.iter().copied().fold(f64::INFINITY, f64::min);
        prop_assert!((spline.least().0 - least).abs() < 1e-12);
    }

    /// `least` finds what a fine search finds.
    #[test]
    fn the_least_value_is_found(y in prop::collection::vec(-10.0..10.0f64, 5..20)) {
        let mut x = uneven(y.len(), 0.0, 1.0);
        x.pop();
        let spline = Spline::bounded(&x, &y, FitMethod::Interpolating).unwrap();
        let [from, to] = spline.range();
        let searched = (0..=20_000).map(|k| spline.at(from + (to - from) * f64::from(k) / 20_000.0)[0]);
        let searched = searched.fold(f64::INFINITY, f64::min);
        let (least, at) = spline.least();
        prop_assert!(least <= searched + 1e-9 && least >= searched - 1e-3 * (1.0 + searched.abs()));
        prop_assert!((spline.at(at)[0] - least).abs() < 1e-9);
    }
}
