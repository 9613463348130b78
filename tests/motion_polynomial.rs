//! Polynomials between boundary conditions: ends, derivatives, and the laws of VDI 2143 as special cases.

use crate::support::{assert_near, budget, config, derivative};
use jred::machine::motion::{End, Law, Polynomial};
use proptest::prelude::*;

/// From rest to rest they are the laws 3-4-5 and 4-5-6-7; with a single jerk of zero, 15z⁴ − 24z⁵ + 10z⁶ from the start (its conditions, s = s′ = s″
/// = s‴ = 0 and s = 1, s′ = s″ = 0, are solved by hand) and its mirror image.
#[test]
fn rest_to_rest_are_the_laws() {
    let open = End::new(0.0, 0.0);
    let still = End {
        jerk: Some(0.0),
        ..open
    };
    for k in 0..=100 {
        let z = f64::from(k) / 100.0;
        let sixth = |z: f64| z.powi(4) * (15.0 - 24.0 * z + 10.0 * z * z);
        for (start, end, expected) in [
            (open, open, Law::Polynomial345.at(z)[0]),
            (still, still, Law::Polynomial4567.at(z)[0]),
            (still, open, sixth(z)),
            (open, still, 1.0 - sixth(1.0 - z)),
        ] {
            let found = Polynomial::between(1.0, 1.0, start, end).at(z)[0];
            assert_near("s", found, expected, 10.0 * budget::LAW_END);
        }
    }
}

/// Constant jerk, in closed form.
#[test]
fn constant_jerk() {
    let phase = Polynomial::constant_jerk([2.0, -3.0, 12.0]);
    let expected = [2.0 - 1.5 + 2.0, 2.0 - 3.0 + 6.0, -3.0 + 12.0, 12.0];
    for (found, expected) in phase.at(1.0).into_iter().zip(expected) {
        assert_near("derivative", found, expected, budget::LAW_END);
    }
}

fn end() -> impl Strategy<Value = End> {
    let jerk = prop_oneof![Just(None), (-50.0..50.0).prop_map(Some)];
    (-3.0..3.0, -9.0..9.0, jerk).prop_map(|(speed, acceleration, jerk)| End {
        speed,
        acceleration,
        jerk,
    })
}

proptest! {
    #![proptest_config(config(512, 0x0026))]

    #[test]
    fn polynomials_meet_their_ends(rise in -1.0..1.0, span in 0.05..4.0, start in end(), last in end()) {
        let polynomial = Polynomial::between(rise, span, start, last);
        let size = |end: End| {
            let jerk = end.jerk.unwrap_or(0.0) * span.powi(3);
            (end.speed * span).abs() + (end.acceleration * span * span).abs() + jerk.abs()
        };
        let size = rise.abs() + size(start) + size(last);
        for (t, s, end) in [(0.0, 0.0, start), (span, rise, last)] {
            let [found, v, a, j] = polynomial.at(t);
            assert_near("s", found, s, budget::POLYNOMIAL_END * size);
            assert_near("s'", v * span, end.speed * span, 10.0 * budget::POLYNOMIAL_END * size);
            let (a, b) = (a * span * span, end.acceleration * span * span);
            assert_near("s''", a, b, 100.0 * budget::POLYNOMIAL_END * size);
            if let Some(jerk) = end.jerk {
                let scale = span.powi(3);
                assert_near("s'''", j * scale, jerk * scale, 1e3 * budget::POLYNOMIAL_END * size);
            }
        }
    }

    /// Each derivative matches the one before.
    #[test]
    fn derivatives_follow(rise in -1.0..1.0, start in end(), last in end(), z in 0.1..0.9) {
        let polynomial = Polynomial::between(rise, 1.0, start, last);
        for order in 0..3 {
            let slope = derivative(|t| polynomial.at(t)[order], z, 0.05);
            // Seventh degree: the extrapolated differences are exact up to roundings of sums up to a thousand.
            assert_near("derivative", polynomial.at(z)[order + 1], slope, 1e3 * budget::LAW_DIFFERENCES);
        }
    }

    #[test]
    fn single_precision_follows_double(rise in -1f32..1.0, start in end(), last in end(), z in 0f32..1.0) {
        let single = |end: End| End {
            speed: end.speed as f32,
            acceleration: end.acceleration as f32,
            jerk: end.jerk.map(|jerk| jerk as f32),
        };
        let found = Polynomial::between(rise, 1.0, single(start), single(last)).at(z)[0];
        let expected = Polynomial::between(f64::from(rise), 1.0, start, last).at(f64::from(z))[0];
        // Coefficients up to thirty times the ends' 70, fifty roundings of 2⁻²⁴ of them.
        assert_near("s in f32", f64::from(found), expected, 5e-3);
    }
}
