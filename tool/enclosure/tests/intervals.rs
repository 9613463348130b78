//! Intervals contain the exact results of their operations.

use jred_enclosure::Interval;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

const CASES: u32 = 100_000;

/// A number of magnitude 1e-6 to 1e6 and either sign.
fn number(random: &mut ChaCha8Rng) -> f64 {
    let size = 10.0_f64.powf(random.random_range(-6.0..6.0));
    if random.random() { size } else { -size }
}

/// An interval, sometimes of one number, and a number in it.
fn pair(random: &mut ChaCha8Rng) -> (Interval, f64) {
    let a = number(random);
    let b = match random.random_range(0..3) {
        0 => a,
        1 => a + 1e-9 * number(random),
        _ => number(random),
    };
    let all = Interval::between(a, b);
    let within = a + random.random::<f64>() * (b - a);
    (all, within.clamp(all.lo(), all.hi()))
}

/// Whether an interval contains `high + low` exactly, where `high` is the sum rounded.
fn contains(all: Interval, high: f64, low: f64) -> bool {
    let above = all.lo() < high || all.lo() <= high && low >= 0.0;
    let below = all.hi() > high || all.hi() >= high && low <= 0.0;
    above && below
}

#[test]
fn sums_products_and_quotients_contain_the_exact_ones() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..CASES {
        let ((a, x), (b, y)) = (pair(&mut random), pair(&mut random));
        // Knuth's sum of two numbers and Dekker's product, which are error-free.
        let sum = x + y;
        let part = sum - x;
        assert!(contains(a + b, sum, (x - (sum - part)) + (y - part)));
        let difference = x - y;
        let part = difference - x;
        assert!(contains(
            a - b,
            difference,
            (x - (difference - part)) - (y + part)
        ));
        let product = x * y;
        assert!(contains(a * b, product, x.mul_add(y, -product)));
        assert!(contains(a.square(), x * x, x.mul_add(x, -(x * x))));
        let quotient = x / y;
        // The sign of the remainder of x.
        let rest = (-quotient).mul_add(y, x);
        assert!(contains(a / b, quotient, rest * y.signum()), "{a:?} {b:?}");
        assert!((a / b).is_bounded() != b.contains(0.0));
    }
}

#[test]
fn roots_and_waves_contain_the_exact_ones() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..CASES {
        let (a, x) = pair(&mut random);
        let squared = a.square();
        let root = (x * x).sqrt();
        let inside = Interval::between(x * x, squared.hi()).sqrt();
        // √(x²) is |x|, to a rounding.
        assert!(inside.lo() <= root && root <= inside.hi());
        assert!(inside.lo() * inside.lo() <= x * x * (1.0 + 1e-15));
        let (sin, cos) = a.sin_cos();
        // The standard library's, different from libm's: both are accurate to a unit of the last place.
        let near = |all: Interval, value: f64| {
            all.lo() <= value.next_up() && value.next_down() <= all.hi()
        };
        assert!(near(sin, x.sin()) && near(cos, x.cos()), "{a:?} {x}");
        // Not wider than necessary.
        if a.lo() >= a.hi() {
            assert!(sin.width() < 1e-15 && cos.width() < 1e-15);
        }
    }
    // Crests and troughs between the ends.
    let (sin, cos) = Interval::between(1.5, 1.6).sin_cos();
    assert!(sin.hi() >= 1.0 && sin.lo() > 0.99 && cos.hi() < 0.1);
    let (sin, cos) = Interval::between(3.0, 5.0).sin_cos();
    assert!(sin.lo() <= -1.0 && sin.hi() < 0.15 && cos.lo() <= -1.0 && cos.hi() < 0.29);
    assert!(Interval::between(-1.0, 1.0).sqrt() == Interval::ALL);
}
