//! Motion laws and moves: ends, continuity, derivatives, and the coefficients of VDI 2143.

use crate::support::{assert_near, budget, config, derivative, largest};
use std::f64::consts::PI;

use jred::machine::motion::{Law, Move};
use proptest::prelude::*;

const TRAPEZOID: Law = Law::Trapezoid {
    accelerate: 0.25,
    decelerate: 0.5,
};
/// Quadratic parabola.
const QUADRATIC: Law = Law::Trapezoid {
    accelerate: 0.5,
    decelerate: 0.5,
};
/// Sine and cosine of different lengths with a constant part and constant speed.
const SCCA: Law = Law::SineConstantCosine {
    sine: 0.2,
    constant: 0.3,
    cosine: 0.4,
};
const LAWS: [Law; 9] = [
    TRAPEZOID,
    SCCA,
    Law::Polynomial345,
    Law::Cycloidal,
    Law::ModifiedSine,
    Law::SimpleSine,
    Law::Polynomial4567,
    Law::ModifiedTrapezoid,
    Law::Gutman,
];

fn places(count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |k| f64::from(k) / f64::from(count))
}

#[test]
fn laws_rise_from_rest_to_rest() {
    for law in LAWS {
        law.check().unwrap();
        for (z, end) in [
            (0.0, 0.0),
            (1.0, 1.0),
            (-0.5, 0.0),
            (1.5, 1.0),
            (f64::NEG_INFINITY, 0.0),
        ] {
            let [s, v, _] = law.at(z);
            assert_near("S", s, end, budget::LAW_END);
            assert_near("S'", v, 0.0, budget::LAW_END);
        }
        for z in [-0.5, 1.5] {
            assert_near("S'' at rest", law.at(z)[2], 0.0, 0.0);
        }
        let mut before = 0.0;
        for z in places(1000) {
            let [s, v, _] = law.at(z);
            assert!(
                s >= before - budget::LAW_END && v >= -budget::LAW_END,
                "{law:?} turns back at {z}"
            );
            before = s;
        }
    }
    // The laws without a jerk jump start with zero acceleration as well.
    for law in LAWS {
        if law.characteristic().jerk.is_none() {
            continue;
        }
        for z in [0.0, 1.0] {
            assert_near("S''", law.at(z)[2], 0.0, 40.0 * budget::LAW_END);
        }
    }
}

/// A law is its own mirror image, S(1 − z) = 1 − S(z); a trapezoid is that with exchanged shares. The first and last instants of a move are slow, not
/// at rest: friction and losses depend on the sign of the speed. The speed there is the first term of its series.
#[test]
fn the_speed_next_to_a_rest_is_not_rounded_to_zero() {
    let near: f64 = 1e-9;
    for law in LAWS {
        let fourth = if law == Law::Polynomial4567 {
            840.0
        } else {
            0.0
        };
        let series =
            |z: f64| law.at(0.0)[2] * z + law.jerk(0.0) * z * z / 2.0 + fourth * z.powi(3) / 6.0;
        let end = match law {
            Law::Trapezoid {
                decelerate,
                accelerate,
            } => accelerate / decelerate,
            _ => 1.0,
        };
        for (z, expected) in [(near, series(near)), (1.0 - near, end * series(near))] {
            let found = law.at(z)[1] / expected;
            assert_near("share of the series", found, 1.0, budget::LAW_NEAR_REST);
        }
    }
}

#[test]
fn laws_are_symmetric() {
    for law in LAWS {
        let mirror = match law {
            Law::Trapezoid {
                accelerate,
                decelerate,
            } => Law::Trapezoid {
                accelerate: decelerate,
                decelerate: accelerate,
            },
            other => other,
        };
        for z in places(500).filter(|z| law.breaks().iter().flatten().all(|b| (z - b).abs() > 1e-9))
        {
            let ([s, v, a], [t, w, b]) = (law.at(z), mirror.at(1.0 - z));
            assert_near("S", t, 1.0 - s, budget::LAW_END);
            assert_near("S'", w, v, 10.0 * budget::LAW_END);
            // S'' of an inner end: the trapezoid's first and last instants are steps.
            if z > 0.0 && z < 1.0 {
                assert_near("S''", b, -a, 40.0 * budget::LAW_END);
            }
        }
    }
}

/// The trapezoid of thirds in closed form: the top speed is 3/2, the acceleration 9/2, without rounding to f32.
#[test]
fn trapezoid_of_thirds() {
    let third = 1.0 / 3.0;
    let law = Law::Trapezoid {
        accelerate: third,
        decelerate: third,
    };
    for (z, s, v) in [
        (third / 2.0, 0.0625, 0.75),
        (third, 0.25, 1.5),
        (0.5, 0.5, 1.5),
        (1.0 - third, 0.75, 1.5),
        (1.0 - third / 2.0, 0.9375, 0.75),
    ] {
        let [found, speed, _] = law.at(z);
        assert_near("S", found, s, 1e-15);
        assert_near("S'", speed, v, 2e-15);
    }
    for (z, a) in [
        (third.next_down(), 4.5),
        (third, 0.0),
        ((1.0 - third).next_down(), 0.0),
        (1.0 - third, -4.5),
    ] {
        assert_near("S''", law.at(z)[2], a, 4e-15);
    }
    assert_near("C_v", law.characteristic().velocity, 1.5, 1e-15);
}

#[test]
fn speed_and_acceleration_are_derivatives() {
    for law in LAWS {
        let step = 1e-3;
        let breaks = law.breaks().into_iter().flatten().chain([0.0, 1.0]);
        let breaks: Vec<f64> = breaks.collect();
        for z in places(997).filter(|z| breaks.iter().all(|b| (z - b).abs() > 2.0 * step)) {
            let [_, v, a] = law.at(z);
            assert_near(
                "S'",
                v,
                derivative(|z| law.at(z)[0], z, step),
                budget::LAW_DIFFERENCES,
            );
            assert_near(
                "S''",
                a,
                derivative(|z| law.at(z)[1], z, step),
                budget::LAW_DIFFERENCES,
            );
            assert_near(
                "S'''",
                law.jerk(z),
                derivative(|z| law.at(z)[2], z, step),
                10.0 * budget::LAW_DIFFERENCES,
            );
        }
        // Across a break position and speed are continuous; only the trapezoid's acceleration may jump there.
        for at in law.breaks().into_iter().flatten() {
            let [before, after] = [law.at(at - 1e-9), law.at(at + 1e-9)];
            assert_near("S", after[0], before[0], budget::LAW_BREAK);
            assert_near("S'", after[1], before[1], 10.0 * budget::LAW_BREAK);
            if law == TRAPEZOID {
                assert!((after[2] - before[2]).abs() > 1.0, "S'' jumps at {at}");
            } else {
                assert_near("S''", after[2], before[2], 100.0 * budget::LAW_BREAK);
            }
        }
    }
}

/// Largest S′, |S″|, |S‴| and S′·S″: the law's own extremes, its closed form, and the figures printed in the tables of
/// VDI 2143 Blatt 1 and Norton, *Cam Design and Manufacturing Handbook* (rounded there to the digits given here).
#[test]
#[expect(clippy::approx_constant, reason = "2π as it is printed")]
fn coefficients_of_vdi_2143() {
    let none = f64::NAN;
    for (law, printed) in [
        (Law::Polynomial345, [1.875, 5.77, 60.0, 6.69]),
        (Law::Cycloidal, [2.0, 6.28, 39.48, 8.16]),
        (Law::ModifiedSine, [1.76, 5.53, 69.47, 5.46]),
        (Law::SimpleSine, [1.57, 4.93, none, 3.88]),
        (Law::Polynomial4567, [2.19, 7.51, 52.5, 10.75]),
        (Law::ModifiedTrapezoid, [2.0, 4.89, 61.43, 8.09]),
        // From its two harmonics: 2π·√(2/3), 6π².
        (Law::Gutman, [2.0, 5.13, 59.22, 8.12]),
        (QUADRATIC, [2.0, 4.0, none, 8.0]),
        (TRAPEZOID, [1.6, 6.4, none, 10.24]),
    ] {
        // The grid misses a maximum by at most half a step: S‴·(step/2)²/2. A value that jumps at a break is also taken before it.
        let before = law.breaks().into_iter().flatten().map(f64::next_down);
        let most = |f: &dyn Fn(f64) -> f64| largest(places(100_000).chain(before.clone()).map(f));
        let found = law.characteristic();
        for (what, closed, extreme, printed) in [
            ("C_v", found.velocity, most(&|z| law.at(z)[1]), printed[0]),
            (
                "C_a",
                found.acceleration,
                most(&|z| law.at(z)[2]),
                printed[1],
            ),
            (
                "C_Mdyn",
                found.dynamic_torque,
                most(&|z| law.at(z)[1] * law.at(z)[2]),
                printed[3],
            ),
        ] {
            assert_near(what, extreme, closed, budget::LAW_MAXIMUM * closed);
            assert_near(what, closed, printed, budget::PRINTED);
        }
        let jumps = law.at(0.0)[2] != 0.0;
        assert_eq!(found.jerk.is_none(), jumps, "{law:?}");
        if let Some(jerk) = found.jerk {
            // The largest jerk may be at a corner of S‴, where a share of a step is lost.
            let extreme = most(&|z| law.jerk(z));
            assert_near("C_j", extreme, jerk, budget::LAW_MAXIMUM * jerk);
            assert_near("C_j", jerk, printed[2], budget::PRINTED);
        }
    }
}

/// A part of zero duration has no jerk, and gives no NaN.
#[test]
fn parts_without_time_have_no_jerk() {
    for [sine, constant, cosine] in [
        [0.0, 0.5, 0.5],
        [0.5, 0.5, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 0.0],
    ] {
        let law = Law::SineConstantCosine {
            sine,
            constant,
            cosine,
        };
        for z in [0.0f64, 0.25, 0.5, 0.75, 1.0] {
            assert!(law.jerk(z).is_finite(), "{law:?} at {z}: {}", law.jerk(z));
        }
    }
}

/// Members of the family of sine, constant and cosine acceleration: the traditional laws value by value, and printed figures of others:
/// <http://mechdesigner.support/mt-motion-cam-law-sine-constant-cosine-cv.htm>.
#[test]
fn sine_constant_and_cosine_make_the_traditional_laws() {
    let scca = |sine, constant, cosine| Law::SineConstantCosine {
        sine,
        constant,
        cosine,
    };
    for (member, law) in [
        (scca(0.25, 0.5, 0.25), Law::ModifiedTrapezoid),
        (scca(0.25, 0.0, 0.75), Law::ModifiedSine),
        (scca(0.5, 0.0, 0.5), Law::Cycloidal),
        (scca(0.0, 0.0, 1.0), Law::SimpleSine),
        (scca(0.0, 1.0, 0.0), QUADRATIC),
        (
            scca(0.0, 0.5, 0.0),
            Law::Trapezoid {
                accelerate: 0.25,
                decelerate: 0.25,
            },
        ),
    ] {
        member.check().unwrap();
        for z in places(997) {
            let jumps = law.breaks().into_iter().flatten();
            if jumps.chain([0.0, 1.0]).any(|b| (z - b).abs() < 1e-9) {
                continue;
            }
            for ((a, b), size) in member.at(z).into_iter().zip(law.at(z)).zip([1.0, 2.0, 9.0]) {
                assert_near("the same law", a, b, size * budget::LAW_END);
            }
            assert_near("jerk", member.jerk(z), law.jerk(z), 90.0 * budget::LAW_END);
        }
        let [a, b] = [member, law].map(Law::characteristic);
        assert_near(
            "C_v",
            a.velocity,
            b.velocity,
            budget::CLOSED_FORM * b.velocity,
        );
        let size = budget::CLOSED_FORM * b.acceleration;
        assert_near("C_a", a.acceleration, b.acceleration, size);
        let size = budget::CLOSED_FORM * b.dynamic_torque;
        assert_near("C_Mdyn", a.dynamic_torque, b.dynamic_torque, size);
        assert_eq!(a.jerk.is_some(), b.jerk.is_some());
        let [a, b] = [a, b].map(|found| found.jerk.unwrap_or(0.0));
        assert_near("C_j", a, b, budget::CLOSED_FORM * b);
    }
    for (law, [velocity, acceleration]) in [
        (scca(0.2, 0.0, 0.6), [1.528, 5.999]),
        (scca(1.0 / 6.0, 0.0, 0.5), [1.404, 6.616]),
    ] {
        let found = law.characteristic();
        assert_near("C_v", found.velocity, velocity, 5e-4);
        assert_near("C_a", found.acceleration, acceleration, budget::PRINTED);
    }
    // Norton's closed form of C_a without a stretch of constant speed, sine b and cosine d:
    // 4π²/((π² − 8)·(b² − d²) − 2π·(π − 2)·b + π²).
    for (b, d) in [(1.0 / 3.0, 1.0 / 3.0), (0.1, 0.6), (0.7, 0.05)] {
        let squares = (PI * PI - 8.0) * (b * b - d * d);
        let expected = 4.0 * PI * PI / (squares - 2.0 * PI * (PI - 2.0) * b + PI * PI);
        let found = scca(b, 1.0 - b - d, d).characteristic().acceleration;
        assert_near("C_a", found, expected, budget::CLOSED_FORM * expected);
    }
    for (law, words) in [
        (scca(-0.1, 0.5, 0.5), "sine is -0.1, outside 0 to 1"),
        (
            scca(0.5, 0.5, 0.5),
            "sine + constant + cosine is 1.5, outside 0.01 to 1",
        ),
        (
            scca(0.0, 0.0, 0.0),
            "sine + constant + cosine is 0, outside 0.01 to 1",
        ),
        (scca(0.0, f64::NAN, 0.0), "constant is NaN"),
    ] {
        let error = law.check().unwrap_err().to_string();
        assert!(error.starts_with(words), "{error}");
    }
}

proptest! {
    #![proptest_config(config(256, 0x0006))]

    /// Any shares: the extremes of the law are its figures, and it is smooth except at its breaks.
    #[test]
    fn sine_constant_and_cosine_of_any_shares(parts in [0.02f64..1.0, 0.0f64..1.0, 0.02f64..1.0, 0.0f64..1.0]) {
        let sum: f64 = parts.iter().sum();
        let [sine, constant, cosine, _] = parts.map(|part| part / sum);
        let law = Law::SineConstantCosine { sine, constant, cosine };
        law.check().unwrap();
        let at = |z: f64| law.at(z);
        assert_near("half way", at(0.5)[0], 0.5, budget::LAW_END);
        let found = law.characteristic();
        let most = |f: &dyn Fn(f64) -> f64| largest(places(4000).map(f));
        // Half a step of 1/4000 from the extreme, on a parabola of the law's sharpest curvature.
        let curved = (PI / sine.min(cosine)).powi(2) / 3.2e7;
        let share = |what: &str, found: f64, closed: f64| assert_near(what, found / closed, 1.0, curved.max(1e-9));
        share("C_v", most(&|z| at(z)[1]), found.velocity);
        share("C_a", most(&|z| at(z)[2]), found.acceleration);
        share("C_Mdyn", most(&|z| at(z)[1] * at(z)[2]), found.dynamic_torque);
        let breaks: Vec<f64> = law.breaks().into_iter().flatten().collect();
        prop_assert!(breaks.is_sorted());
        for z in breaks {
            let [before, after] = [at(z - 1e-10), at(z + 1e-10)];
            let jerk = found.jerk.unwrap();
            for (k, slope) in [found.velocity, found.acceleration, jerk].into_iter().enumerate() {
                assert_near("no jump", before[k], after[k], 3e-10 * slope);
            }
        }
    }

    #[test]
    fn single_precision_follows_double(z in 0f32..=1.0, which in 0usize..9) {
        let law = LAWS[which];
        let [single, double] = [law.cast::<f32>().at(z).map(f64::from), law.at(f64::from(z))];
        for (s, d) in single.iter().zip(double) {
            assert_near("law in f32", *s, d, budget::LAW_F32);
        }
    }

    #[test]
    fn trapezoids_of_any_shares(accelerate in 0.01f64..0.99, rest in 0.01f64..1.0, z in 0f64..1.0) {
        let decelerate = (1.0 - accelerate) * rest;
        let law = Law::Trapezoid { accelerate, decelerate };
        law.check().unwrap();
        let [a, d] = [accelerate, decelerate];
        let top = 1.0 / (1.0 - f64::midpoint(a, d));
        // Area under the speed's trapezoid up to z.
        let left = z.min(a);
        let middle = (z.min(1.0 - d) - a).max(0.0);
        let right = (z - (1.0 - d)).max(0.0);
        let area = left * left / (2.0 * a) + middle + right - right * right / (2.0 * d);
        assert_near("S", law.at(z)[0], top * area, 1e3 * budget::LAW_END);
        // Corners: the acceleration is the one after them, and just before them the one before.
        let [Some(first), Some(last), ..] = law.breaks() else { unreachable!() };
        prop_assert!((first, last) == (a, 1.0 - d) && first <= last);
        let between = if first < last { 0.0 } else { -top / d };
        assert_near("S'' after the first corner", law.at(first)[2], between, budget::LAW_END * top / d);
        assert_near("S'' before it", law.at(first.next_down())[2], top / a, budget::LAW_END * top / a);
        assert_near("S'' after the last corner", law.at(last)[2], -top / d, budget::LAW_END * top / d);
        let before = if first < last { 0.0 } else { top / a };
        assert_near("S'' before it", law.at(last.next_down())[2], before, budget::LAW_END * top / a);
    }

    #[test]
    fn moves_scale_their_law(
        which in 0usize..9, start in -9.0..9.0, distance in -9.0..9.0, duration in 0.1f64..9.0, z in 0f64..1.0,
    ) {
        let law = LAWS[which];
        let travel = Move::<f64>::new(law, start, distance, duration).unwrap();
        prop_assert_eq!((travel.duration(), travel.distance(), travel.law()), (duration, distance, law));
        let (state, [s, v, a]) = (travel.at(z * duration), law.at(z));
        // z is recovered from z·duration with a rounding: next to a break S″ may be that of the other side.
        prop_assume!(law.breaks().iter().flatten().all(|b| (z - b).abs() > 1e-12));
        assert_near("φ", state.phi, start + distance * s, 1e3 * budget::LAW_END);
        assert_near("ω", state.omega, distance / duration * v, 1e3 * budget::LAW_END / duration);
        let rounding = 1e4 * budget::LAW_END / duration.powi(2);
        assert_near("α", state.alpha, distance / duration.powi(2) * a, rounding);
        for (t, end) in [(-1.0, start), (duration + 1.0, start + distance)] {
            let state = travel.at(t);
            assert_near("end", state.phi, end, 0.0);
            prop_assert_eq!((state.omega, state.alpha), (0.0, 0.0));
        }
    }
}
