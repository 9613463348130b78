//! Common periods of cycles, and curves with fewer points.

use jred_sizing::bus::axes::Axes;
use jred_sizing::bus::curve::PowerCurve;
use jred_sizing::bus::period::Common;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use super::{BUS, budget, near, random_curve, worst};

/// A curve with fewer points deviates nowhere by more than allowed; jumps and ends stay in place.
#[test]
fn a_curve_with_fewer_points() {
    let at = |curve: &PowerCurve, t: f64| {
        let points = curve.points();
        let next = points.partition_point(|point| point[0] <= t);
        let [[from, p], [to, q]] = [points[next - 1], points[next]];
        p + (q - p) * (t - from) / (to - from)
    };
    let mut random = ChaCha8Rng::seed_from_u64(20);
    for case in 0..40 {
        let steps = 1 + case * 20;
        let wave = |t: f64| 900.0 * (t * 7.0).sin() + 300.0 * (t * 31.0).cos();
        let mut points: Vec<[f64; 2]> = (0..=steps)
            .map(|k| f64::from(k) / f64::from(steps))
            .map(|t| [t, wave(t) + random.random_range(-0.4..0.4)])
            .collect();
        points.insert(points.len() / 2, [points[points.len() / 2][0], -2000.0]);
        let curve = PowerCurve::new(points.clone(), 1.0);
        for tolerance in [0.0, 0.5, 20.0] {
            let fewer = curve.simplified(tolerance);
            assert_eq!(fewer.period(), 1.0);
            assert!(fewer.points().len() <= curve.points().len());
            assert!(
                fewer
                    .points()
                    .contains(&[points[points.len() / 2][0], -2000.0])
                    || case == 0
            );
            for _ in 0..50 {
                let t = random.random_range(0.0..1.0);
                let off = (at(&curve, t) - at(&fewer, t)).abs();
                assert!(off <= tolerance + 1e-9, "{case} {tolerance}: {off} at {t}");
            }
            assert_eq!(fewer.points().first(), curve.points().first());
            assert_eq!(fewer.points().last(), curve.points().last());
        }
        if case > 20 {
            assert!(curve.simplified(20.0).points().len() * 4 < curve.points().len());
        }
    }
}

/// A common period with more than 5000 points is searched by fewer, and the results use all: random phases are not worse by more than the grid of
/// three axes misses.
#[test]
fn a_long_common_period_is_searched_with_fewer_points() {
    let brakes = |phase: f64, period: f64| {
        let points = (0..=200).map(|k| f64::from(k) / 200.0);
        let power = move |u: f64| 800.0 * (6.0 * (u + phase)).sin() - 300.0 * (17.0 * u).cos();
        PowerCurve::new(points.map(|u| [u * period, power(u)]), period)
    };
    let curves = [brakes(0.0, 1.0), brakes(0.3, 0.96), brakes(0.7, 0.9)];
    let axes = Axes::new(BUS, curves.to_vec());
    let Common::Searched { cycles, .. } = axes.common() else {
        panic!("not searched")
    };
    assert!(cycles.iter().sum::<u32>() * 200 > 5_000);
    let worst = worst(&axes).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(21);
    for _ in 0..40 {
        let phases = [
            0.0,
            random.random_range(0.0..0.96),
            random.random_range(0.0..0.9),
        ];
        let figures = axes.at(&phases).unwrap();
        for (goal, worst) in worst.iter().enumerate() {
            let [found, other] =
                [&worst.figures, &figures].map(|figures| figures.judged(1.0)[goal]);
            assert!(
                found >= other * (1.0 - budget::THREE_PHASES),
                "{goal}: {found}, {other}"
            );
        }
    }
    for worst in worst {
        assert_eq!(worst.figures, axes.at(&worst.phases).unwrap());
    }
}

/// The three cases of a common period, with their numbers.
#[test]
fn common_periods() {
    let mut random = ChaCha8Rng::seed_from_u64(16);
    let mut axes = |periods: &[f64]| {
        let curves = periods.iter();
        let curves = curves.map(|period| random_curve(&mut random, *period, 1000.0));
        Axes::new(BUS, curves.collect())
    };
    let near_it = |common: &Common, expected: f64, counts: &[u32]| match common {
        Common::Searched { period, cycles } | Common::TooLong { period, cycles } => {
            near("period", *period, expected, budget::BUS);
            assert_eq!(cycles, counts);
        }
        Common::None => panic!("none"),
    };
    let searched = axes(&[0.5, 0.51]);
    assert!(matches!(searched.common(), Common::Searched { .. }));
    near_it(searched.common(), 25.5, &[51, 50]);
    let three = axes(&[0.4, 0.6, 0.5]);
    near_it(three.common(), 6.0, &[15, 10, 12]);
    for (periods, period, counts) in [
        ([0.5, 0.5007], 2503.5, [5007, 5000]),
        ([0.1 + 0.2, 0.3001], 900.3, [3001, 3000]),
        ([1.0, 0.001], 1.0, [1, 1000]),
    ] {
        let late = axes(&periods);
        assert!(matches!(late.common(), Common::TooLong { .. }));
        near_it(late.common(), period, &counts);
        assert!(worst(&late).is_none() && late.at(&[0.0; 2]).is_none());
    }
    for second in [std::f64::consts::SQRT_2, 1.012_345_67] {
        let never = axes(&[1.0, second]);
        assert_eq!(never.common(), &Common::None);
        assert!(worst(&never).is_none() && never.bounds().highest > 560.0);
    }
}
