//! A plan against the motion from which it was made.

use core::f64::consts::TAU;

use jred::axis::plan::{Errors, Knot, PlanError, PlanPoint, encode, image_len};
use jred::axis::{MachineUnits, Plan};
use jred::number::{Number, Quantity as _};
use jred::{Domain, Q31, Rows16, Scale, Spline};
use proptest::prelude::*;

use super::machine::in_units;
use crate::support::{samples, scale_of};

/// Seconds to units of 2⁻⁴⁰ s.
pub(super) fn units(t: f64) -> u64 {
    (t * 2f64.powi(40)) as u64
}

pub(super) fn image(knots: &[Knot], domain: Domain) -> Vec<u32> {
    let mut words = vec![0; image_len(knots.len())];
    let written = encode(knots, domain, 7, Errors::default(), &mut words).map(<[u32]>::len);
    assert_eq!(written, Ok(words.len()));
    words
}

/// Quintic Hermite basis at s: the functions for position, speed and acceleration at both ends, or a derivative of them.
fn basis(s: f64, derivative: u32) -> [f64; 6] {
    let polynomials: [[f64; 6]; 6] = [
        [1.0, 0.0, 0.0, -10.0, 15.0, -6.0],
        [0.0, 1.0, 0.0, -6.0, 8.0, -3.0],
        [0.0, 0.0, 0.5, -1.5, 1.5, -0.5],
        [0.0, 0.0, 0.0, 0.5, -1.0, 0.5],
        [0.0, 0.0, 0.0, -4.0, 7.0, -3.0],
        [0.0, 0.0, 0.0, 10.0, -15.0, 6.0],
    ];
    polynomials.map(|polynomial| {
        let mut sum = 0.0;
        for (power, c) in (0..).zip(polynomial) {
            if power >= derivative {
                let falling: f64 = (0..derivative).map(|j| f64::from(power - j)).product();
                sum += c * falling * s.powi((power - derivative).cast_signed());
            }
        }
        sum
    })
}

/// Weights of the Hermite basis over the time h between two knots.
fn ends(a: &Knot, b: &Knot, h: f64) -> [f64; 6] {
    [
        a.position,
        a.omega * h,
        a.alpha[1] * h * h,
        b.alpha[0] * h * h,
        b.omega * h,
        b.position,
    ]
}

/// Position, speed and acceleration between two knots.
pub(super) fn between(a: &Knot, b: &Knot, t: f64) -> [f64; 3] {
    let h = b.t - a.t;
    let s = (t - a.t) / h;
    let of = ends(a, b, h);
    [0, 1, 2].map(|derivative| {
        let sum: f64 = basis(s, derivative)
            .iter()
            .zip(of)
            .map(|(w, x)| w * x)
            .sum();
        sum / h.powi(derivative.cast_signed())
    })
}

pub(super) fn found<N: Number>(
    place: &PlanPoint<N>,
    model: &impl MachineUnits<Number = N>,
) -> [f64; 3] {
    let scale = model.scale();
    let turns = f64::from(place.turns) + f64::from(place.motion.phase.to_bits()) / 2f64.powi(32);
    let (from, span) = match model.domain().to::<f64>() {
        Domain::Turn => (0.0, TAU),
        Domain::Stroke { from, to } => (from, to - from),
    };
    [
        from + turns * span,
        place.motion.omega.number().to_f64() * f64::from(scale.speed()),
        place.motion.alpha.number().to_f64() * f64::from(scale.acceleration()),
    ]
}

/// Times of knots are multiples of 2⁻²⁴ s, and so of the units of a plan of up to 64 s.
const GRID: f64 = 16_777_216.0;

/// Random knots, 0.1 ms to a second apart, over many turns, with a jump of the acceleration at each.
fn any_knots() -> impl Strategy<Value = Vec<Knot>> {
    let step = (
        -4.0..0.0,
        -20.0..20.0,
        -30.0..30.0,
        -900.0..900.0,
        -900.0..900.0,
        -1.0..1.0,
    );
    proptest::collection::vec(step, 2..20).prop_map(|steps| {
        let (mut t, mut position, mut last) = (0.0, 0.0, 0.0);
        let knots = steps.into_iter().enumerate().map(|(k, step)| {
            let (length, start, omega, before, after, missed) = step;
            let length = if k == 0 {
                0.0
            } else {
                (10f64.powf(length) * GRID).ceil() / GRID
            };
            t += length;
            // Roughly consistent with the speeds, as a motion is.
            position += if k == 0 {
                start
            } else {
                length * (0.5 * (omega + last) + missed)
            };
            last = omega;
            Knot {
                t,
                position,
                omega,
                alpha: [before, after],
            }
        });
        knots.collect()
    })
}

/// The sum of a row's acceleration terms at the end of its window (the next power of two of its duration in seconds); and the same as a speed and a
/// distance over the window.
fn terms(a: &Knot, b: &Knot) -> [f64; 3] {
    let h = b.t - a.t;
    let window = 2f64.powf(h.log2().floor() + 1.0);
    let of = ends(a, b, h);
    // The derivatives at the start are the coefficients.
    let coefficient = |power: u32| -> f64 {
        let sum: f64 = basis(0.0, power).iter().zip(of).map(|(w, x)| w * x).sum();
        sum.abs() / (2..=power).map(f64::from).product::<f64>()
            * (window / h).powi(power.cast_signed())
    };
    let sum = |factors: [f64; 4]| -> f64 {
        (2..=5)
            .zip(factors)
            .map(|(power, factor)| factor * coefficient(power))
            .sum()
    };
    let way = sum([2.0, 6.0, 12.0, 20.0]);
    [way / (window * window), way / window, way]
}

/// The rows' polynomials are those through the knots, to 2⁻²⁶ of the sums of their terms, plus the effect of rounding positions to 2⁻³² of the range.
#[test]
fn a_plan_follows_its_polynomials() {
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let mut worst = [0.0_f64; 3];
    for knots in samples(300, 0xff61, &any_knots()) {
        let words = image(&knots, Domain::Turn);
        let plan = Plan::new(&words, &model).unwrap();
        // The units of speeds and accelerations are the same for all rows.
        let most = |j: usize| {
            knots
                .windows(2)
                .map(|pair| terms(&pair[0], &pair[1])[j])
                .fold(0.0, f64::max)
        };
        let (raised, fastest) = (most(0), most(1).max(plan.max_speed().into()));
        for pair in knots.windows(2) {
            let h = pair[1].t - pair[0].t;
            let [.., way] = terms(&pair[0], &pair[1]);
            let unit = TAU / 2f64.powi(32);
            let part = 2f64.powi(-26);
            let allowed = [
                part * (way + fastest * h) + 2.0 * unit,
                part * fastest + 2.0 * unit / h,
                part * (raised + 2.0 * fastest / h) + 6.0 * unit / (h * h),
            ];
            for share in [0.0, 1e-6, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999] {
                let t = units(pair[0].t + h * share);
                let exact = between(&pair[0], &pair[1], t as f64 / 2f64.powi(40));
                let here = found(&plan.at(t).value, &model);
                for j in 0..3 {
                    let error = (here[j] - exact[j]).abs();
                    worst[j] = worst[j].max(error / allowed[j]);
                    assert!(error <= allowed[j], "{j}: {error:e} {:e} {t}", allowed[j]);
                }
            }
        }
    }
    // The bound is tight: a fifth would be exceeded.
    for (j, worst) in worst.into_iter().enumerate() {
        assert!(worst > 0.2, "{j}: {worst}");
    }
}

/// From rest to rest with a trapezoidal speed: 1 s of 2 rad/s², 3 s of 2 rad/s, 0.5 s of −4 rad/s², then a second of rest.
pub(super) fn trapezoid() -> [Knot; 5] {
    let knot = |t, position, omega, before, after| Knot {
        t,
        position,
        omega,
        alpha: [before, after],
    };
    [
        knot(0.0, 0.5, 0.0, 0.0, 2.0),
        knot(1.0, 1.5, 2.0, 2.0, 0.0),
        knot(4.0, 7.5, 2.0, 0.0, -4.0),
        knot(4.5, 8.0, 0.0, -4.0, 0.0),
        knot(5.5, 8.0, 0.0, 0.0, 0.0),
    ]
}

/// The same in closed form.
pub(super) fn exact(t: f64) -> [f64; 3] {
    match t {
        ..1.0 => [0.5 + t * t, 2.0 * t, 2.0],
        ..4.0 => [1.5 + 2.0 * (t - 1.0), 2.0, 0.0],
        ..4.5 => {
            let left = 4.5 - t;
            [8.0 - 2.0 * left * left, 4.0 * left, -4.0]
        }
        _ => [8.0, 0.0, 0.0],
    }
}

/// Every number type, up to its own rounding; corners of the acceleration in place, rest after the end.
#[test]
fn corners_of_the_acceleration_are_kept() {
    fn check<N: Number>(model: &impl MachineUnits<Number = N>, unit: f64) {
        let words = image(&trapezoid(), Domain::Turn);
        let plan = Plan::new(&words, model).unwrap();
        assert_eq!((plan.rows(), plan.machine()), (5, 7));
        assert_eq!(plan.duration().to_bits(), 5.5_f32.to_bits());
        assert_eq!(plan.end(), units(5.5));
        assert_eq!(
            [plan.max_speed(), plan.max_acceleration()].map(f32::to_bits),
            [2.0_f32, 4.0].map(f32::to_bits)
        );
        let [speed, acceleration] =
            [model.scale().speed(), model.scale().acceleration()].map(f64::from);
        let before = [1.0, 4.0, 4.5].map(|t| units(t) - 1);
        let times = (0..=700).map(|k| units(0.01 * f64::from(k)));
        for t in times.chain(before) {
            let place = plan.at(t);
            assert!(!place.saturated);
            let [position, omega, alpha] = found(&place.value, model);
            let [at, v, a] = exact(t as f64 / 2f64.powi(40));
            // Factors to machine units have single precision.
            assert!((position - at).abs() < 2e-8 * TAU, "{t}: {position} {at}");
            assert!(
                (omega - v).abs() <= unit * speed + 1.8e-7,
                "{t}: {omega} {v}"
            );
            assert!(
                (alpha - a).abs() <= unit * acceleration + 3e-7,
                "{t}: {alpha} {a}"
            );
        }
        // After its end it stays at the end.
        assert_eq!(plan.at(u64::MAX), plan.at(plan.end()));
    }
    let scale = scale_of(100.0, 10.0, 10.0);
    check(&in_units::<Spline<f64>>(Domain::Turn, Scale::SI), 0.0);
    check(&in_units::<Spline<f32>>(Domain::Turn, Scale::SI), 2.4e-7);
    check(&in_units::<Spline<Q31>>(Domain::Turn, scale), 2e-8);
    check(&in_units::<Rows16>(Domain::Turn, scale), 3.1e-5);
}

/// On a stroke positions stay within the stroke, even where rounding would exceed it.
#[test]
fn a_stroke_is_not_left() {
    let domain = Domain::stroke(0.1, 0.6).unwrap();
    let model = in_units::<Spline<f32>>(domain, Scale::SI);
    // The whole stroke in 2 s, with 0.5 m/s² and −0.5 m/s².
    let knots = [
        (0.0, 0.1, 0.0, [0.0, 0.5]),
        (1.0, 0.35, 0.5, [0.5, -0.5]),
        (2.0, 0.6, 0.0, [-0.5, 0.0]),
    ];
    let knots = knots.map(|(t, position, omega, alpha)| Knot {
        t,
        position,
        omega,
        alpha,
    });
    let words = image(&knots, domain);
    let plan = Plan::new(&words, &model).unwrap();
    let mut before = 0;
    for k in 0..=1000 {
        let place = plan.at(units(0.002 * f64::from(k))).value;
        assert_eq!(place.turns, 0);
        let phase = place.motion.phase.to_bits();
        assert!(phase >= before, "{k}: {phase:x} {before:x}");
        before = phase;
    }
    assert_eq!(before, u32::MAX);
    // A model with another stroke is another machine; so is one with a turn.
    for other in [Domain::stroke(0.1, 0.5).unwrap(), Domain::Turn] {
        let model = in_units::<Spline<f32>>(other, Scale::SI);
        assert_eq!(Plan::new(&words, &model), Err(PlanError::Range));
    }
}

/// A plan at 2 rad/s for this many seconds.
pub(super) fn evenly(length: f64) -> Vec<u32> {
    let knot = |t| Knot {
        t,
        position: 2.0 * t,
        omega: 2.0,
        alpha: [0.0; 2],
    };
    image(&[knot(0.0), knot(length)], Domain::Turn)
}

/// A stretch of constant speed is one row of any length, as exact as its time: to 2⁻³² of the window.
#[test]
fn a_long_row_is_exact() {
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    for length in [10.0, 2000.0, 1e6] {
        let words = evenly(length);
        let plan = Plan::new(&words, &model).unwrap();
        for k in 0..=100 {
            let t = 0.01 * f64::from(k) * length;
            let place = plan.at(units(t));
            let [position, omega, alpha] = found(&place.value, &model);
            let window = 2.0 * length;
            assert!(
                (position - 2.0 * t).abs() <= 2.0 * window * 2f64.powi(-32) + 3e-9,
                "{t}: {position}"
            );
            // Single precision of the factor.
            assert!((omega - 2.0).abs() < 2.4e-7, "{t}: {omega}");
            assert!(alpha.abs() < 1e-6 / length, "{t}: {alpha}");
        }
    }
}

/// The greatest speed and acceleration in the header are those of the polynomials: at least the largest of 10,000 samples of each row, and no more.
#[test]
fn the_greatest_rates_are_those_of_the_polynomials() {
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let check = |knots: &[Knot]| {
        let words = image(knots, Domain::Turn);
        let plan = Plan::new(&words, &model).unwrap();
        let most = [plan.max_speed(), plan.max_acceleration()].map(f64::from);
        let mut sampled = [0.0_f64; 2];
        // In the shortest row the rounding of positions by half a unit at both ends is largest.
        let mut rounded = [0.0_f64; 2];
        for pair in knots.windows(2) {
            let h = pair[1].t - pair[0].t;
            let unit = TAU / 2f64.powi(32);
            rounded = [
                rounded[0].max(2.0 * unit / h),
                rounded[1].max(6.0 * unit / (h * h)),
            ];
            for k in 0..=10_000 {
                let t = pair[0].t + h * f64::from(k) / 1e4;
                let [_, v, a] = between(&pair[0], &pair[1], t);
                sampled = [sampled[0].max(v.abs()), sampled[1].max(a.abs())];
            }
        }
        for j in 0..2 {
            let single = 1e-7 * sampled[j] + rounded[j];
            assert!(most[j] >= sampled[j] - single, "{j}: {most:?} {sampled:?}");
            assert!(
                most[j] <= sampled[j] * (1.0 + 1e-6) + single,
                "{j}: {most:?} {sampled:?}"
            );
        }
        most
    };
    for knots in samples(20, 0xff62, &any_knots()) {
        check(&knots);
    }
    // From rest to rest by the polynomial 3-4-5: 15/8 of the mean speed, 10/√3 of the distance over the time squared.
    let knot = |t, position| Knot {
        t,
        position,
        ..Knot::default()
    };
    let [speed, acceleration] = check(&[knot(0.0, 0.0), knot(1.0, 1.0)]);
    assert!((speed / 1.875 - 1.0).abs() < 1e-7, "{speed}");
    assert!((acceleration * 3f64.sqrt() / 10.0 - 1.0).abs() < 1e-7);
    // With constant jerk the derivative of the acceleration has no roots; with constant acceleration it has none that are finite.
    check(&trapezoid());
}
