//! Formulas and their slopes, against the same written in Rust and differentiated by hand.

use jred::friction::Dual;
use jred_enclosure::Interval;
use jred_file::number::formula::Formula;

use crate::support::{near, within};

fn at(text: &str, [t, phi]: [f64; 2]) -> [f64; 3] {
    let formula = Formula::parse(text, &["t", "phi"]).unwrap();
    let [t, phi] = Dual::variables(&[t, phi]);
    let found = formula.at(&[t, phi]);
    [found.value, found.slope[0], found.slope[1]]
}

#[test]
fn values_and_slopes_are_those_of_the_textbook() {
    let (t, phi) = (0.7f64, 1.3f64);
    let cases: [(&str, [f64; 3]); 16] = [
        ("2 + 3*4", [14.0, 0.0, 0.0]),
        ("2 - 3 - 4", [-5.0, 0.0, 0.0]),
        ("-2^2", [-4.0, 0.0, 0.0]),
        ("2^3^2", [512.0, 0.0, 0.0]),
        ("2^-1", [0.5, 0.0, 0.0]),
        ("8/4/2", [1.0, 0.0, 0.0]),
        ("1.5e-3 + 2E2", [200.0015, 0.0, 0.0]),
        ("t*phi", [t * phi, phi, t]),
        ("t/phi", [t / phi, 1.0 / phi, -t / (phi * phi)]),
        (
            "sin(2*pi*t)",
            [
                (std::f64::consts::TAU * t).sin(),
                std::f64::consts::TAU * (std::f64::consts::TAU * t).cos(),
                0.0,
            ],
        ),
        (
            "tan(t) + atan(phi)",
            [
                t.tan() + phi.atan(),
                1.0 / (t.cos() * t.cos()),
                1.0 / (1.0 + phi * phi),
            ],
        ),
        (
            "exp(-t) * cos(phi)",
            [
                (-t).exp() * phi.cos(),
                -(-t).exp() * phi.cos(),
                -(-t).exp() * phi.sin(),
            ],
        ),
        (
            "ln(t) + sqrt(phi)",
            [t.ln() + phi.sqrt(), 1.0 / t, 0.5 / phi.sqrt()],
        ),
        ("tanh(t)", [t.tanh(), 1.0 / (t.cosh() * t.cosh()), 0.0]),
        (
            "t^phi",
            [t.powf(phi), phi * t.powf(phi - 1.0), t.powf(phi) * t.ln()],
        ),
        ("(t - 1)^3", [-0.027, 3.0 * 0.09, 0.0]),
    ];
    for (text, expected) in cases {
        for (found, expected) in at(text, [t, phi]).into_iter().zip(expected) {
            near(text, found, expected, 4e-15);
        }
    }
    let exact: [(&str, f64, [f64; 3]); 3] = [
        ("t^0", 0.0, [1.0, 0.0, 0.0]),
        ("t^2", 0.0, [0.0; 3]),
        ("2·t − 1", 3.0, [5.0, 2.0, 0.0]),
    ];
    for (text, t, expected) in exact {
        for (found, expected) in at(text, [t, 0.0]).into_iter().zip(expected) {
            within(text, found, expected, 0.0);
        }
    }
}

#[test]
fn a_formula_knows_its_variables() {
    let formula = Formula::parse("1 + sin(phi)", &["t", "phi"]).unwrap();
    assert!(formula.contains(1) && !formula.contains(0));
}

/// Mistakes are found at their place in the text.
#[test]
fn faults_have_a_place() {
    for (text, place) in [
        ("1 + x", 4..5),
        ("1 + (2", 4..5),
        ("1 $ 2", 2..3),
        ("1 +", 3..3),
        ("* 2", 0..1),
        ("1e", 1..2),
    ] {
        let fault = Formula::parse(text, &["t"]).unwrap_err();
        assert_eq!(fault.place, place, "{text}: {}", fault.what);
    }
}

/// Wherever the variables are in their intervals, the value is in the bounds; where there is no pole they close in on it.
#[test]
fn bounds_contain_every_value() {
    let formulas = [
        "0.8 + 0.3*sin(2*pi*t)*cos(phi)",
        "t/(phi + 3) - t^2",
        "exp(-t)*tanh(phi) + atan(t - phi)",
        "sqrt(t + 2) + ln(phi + 3) + tan(t/4)",
        "(t + 3)^1.7 + (phi + 2)^t + 2^-3",
        "t*t - phi^3/(t^2 + 1)",
    ];
    let mut random = 12345u64;
    let mut next = || {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (random >> 11) as f64 / (1u64 << 53) as f64
    };
    for text in formulas {
        let formula = Formula::parse(text, &["t", "phi"]).unwrap();
        for width in [1.0, 1e-3, 1e-6] {
            for _ in 0..200 {
                let from = [next(), next()].map(|x| 2.0 * x - 1.0);
                let [t, phi] = from.map(|x| Interval::between(x, x + width));
                let bounds = formula.bounds(&[t, phi]);
                let place = from.map(|x| x + width * next());
                let [value, ..] = at(text, place);
                assert!(
                    !value.is_finite() || bounds.contains(value),
                    "{text} {place:?} {bounds:?}"
                );
                if width < 0.1 && bounds.is_bounded() && value.abs() < 10.0 {
                    assert!(
                        bounds.width() < 200.0 * width,
                        "{text} {place:?} {bounds:?}"
                    );
                }
            }
        }
    }
    // Across a pole every number is a value.
    let pole = Formula::parse("1/(t - 0.50001)", &["t", "phi"]).unwrap();
    let near = |a: f64, b: f64| pole.bounds(&[Interval::between(a, b), Interval::ZERO]);
    assert!(!near(0.5, 0.51).is_bounded());
    assert!(near(0.5, 0.500_000_01).is_bounded());
}
