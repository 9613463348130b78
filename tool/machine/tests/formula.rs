//! Formulas and their slopes, against the same written in Rust and differentiated by hand.

use jred::friction::Dual;
use jred_machine::number::formula::Formula;

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
