//! Identities of the arithmetic on transfer functions.

use std::f64::consts::{PI, TAU};

use crate::support::{assert_near, budget, config, largest};
use jred::number::Transfer;
use proptest::prelude::*;

fn parts(t: Transfer) -> [f64; 4] {
    [t.value, t.d1, t.d2, t.d3]
}

#[track_caller]
fn assert_same(what: &str, found: Transfer, expected: Transfer, size: f64) {
    for (k, (f, e)) in parts(found).iter().zip(parts(expected)).enumerate() {
        assert_near(
            &format!("{what}, order {k}"),
            *f,
            e,
            budget::IDENTITY * size,
        );
    }
}

prop_compose! {
    fn transfer()(value in -3.0..3.0, d1 in -2.0..2.0, d2 in -2.0..2.0, d3 in -2.0..2.0) -> Transfer {
        Transfer { value, d1, d2, d3 }
    }
}

prop_compose! {
    /// Bounded away from zero, so that quotients and roots keep their magnitude.
    fn positive()(value in 0.5..4.0, d1 in -2.0..2.0, d2 in -2.0..2.0, d3 in -2.0..2.0) -> Transfer {
        Transfer { value, d1, d2, d3 }
    }
}

proptest! {
    #![proptest_config(config(256, 0x0002))]

    #[test]
    fn sine_and_cosine_square_to_one(f in transfer()) {
        let (sin, cos) = f.sin_cos();
        let size = 1.0 + largest(parts(sin * sin));
        assert_same("sin² + cos²", sin * sin + cos * cos, Transfer::constant(1.0), size);
        assert_near("sin", sin.value, f.value.sin(), budget::IDENTITY);
        assert_near("sin'", sin.d1, f.value.cos() * f.d1, budget::IDENTITY);
    }

    #[test]
    fn chain_rule(g in transfer()) {
        let (s, c) = g.value.sin_cos();
        let outer = Transfer { value: s, d1: c, d2: -s, d3: -c };
        assert_same("sin(g)", outer.after(g), g.sin_cos().0, 40.0);
        let x = g.value;
        let outer = Transfer { value: x * x * x, d1: 3.0 * x * x, d2: 6.0 * x, d3: 6.0 };
        let cube = g * g * g;
        assert_same("g³", outer.after(g), cube, 100.0 + largest(parts(cube)));
    }

    #[test]
    fn angle_inverts_sine_and_cosine(f in transfer()) {
        let (sin, cos) = f.sin_cos();
        let mut angle = Transfer::angle(sin, cos);
        angle.value = f.value + (angle.value - f.value + PI).rem_euclid(TAU) - PI;
        assert_same("angle", angle, f, 1.0 + largest(parts(sin)) * largest(parts(cos)));
    }

    #[test]
    fn quotient_times_divisor_is_the_dividend(f in transfer(), g in positive()) {
        let q = f.over(g);
        assert_same("q·g", q * g, f, 1.0 + largest(parts(q)) * largest(parts(g)));
    }

    #[test]
    fn square_of_the_root_is_the_radicand(f in positive()) {
        let y = f.sqrt();
        assert!(y.value > 0.0);
        assert_same("y²", y * y, f, 1.0 + largest(parts(y)).powi(2));
    }

    #[test]
    fn products_follow_leibniz(f in transfer(), g in transfer(), h in transfer(), k in -3.0..3.0) {
        let size = 1.0 + largest(parts(f)) * largest(parts(g)) * largest(parts(h)) * 16.0;
        assert_same("f·g = g·f", f * g, g * f, size);
        assert_same("(f·g)·h", (f * g) * h, f * (g * h), size);
        assert_same("f·(g − h)", f * (g - h), f * g - f * h, size);
        assert_same("k·f", f * k, f * Transfer::constant(k), size);
        assert_same("−f", -f, f * -1.0, size);
        // (f·g)''' has the binomial coefficients 1 3 3 1.
        let third = f.d3 * g.value + 3.0 * f.d2 * g.d1 + 3.0 * f.d1 * g.d2 + f.value * g.d3;
        assert_near("(f·g)'''", (f * g).d3, third, budget::IDENTITY * size);
    }

    /// φ^n has the elementary derivatives, and motion follows the chain rule.
    #[test]
    fn powers_and_motion(phi in -2.0..2.0, omega in -50.0..50.0, alpha in -500.0..500.0) {
        let x = Transfer::variable(phi);
        let fourth = x * x * x * x;
        let expected = Transfer {
            value: phi.powi(4),
            d1: 4.0 * phi.powi(3),
            d2: 12.0 * phi.powi(2),
            d3: 24.0 * phi,
        };
        assert_same("φ⁴", fourth, expected, 50.0);
        assert_near("velocity", fourth.velocity(omega), 4.0 * phi.powi(3) * omega, 1e-9);
        let expected = 4.0 * phi.powi(3) * alpha + 12.0 * phi * phi * omega * omega;
        assert_near("acceleration", fourth.acceleration(omega, alpha), expected, 1e-7);
    }
}
