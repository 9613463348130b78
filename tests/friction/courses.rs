//! Functions of time and position, and numbers with their gradients.

use jred::friction::{
    Course, Creep, CreepLimit, Curve, Dual, OperatingPoint, Ramp, RampShape, Sine, SineShape,
    Variable,
};
use jred::machine::motion::Law;
use jred::table::{CubicSpline, control_points, fit_bounded, fit_periodic};

use crate::support::{assert_near, budget, derivative};

/// Derivatives by all three variables against differences.
fn check(course: &impl Course, at: [f64; 3]) {
    let found = course.at(OperatingPoint::at_time(at[0])
        .with_angle(at[1])
        .with_load(at[2]));
    for k in 0..3 {
        let along = |x: f64| {
            let mut moved = at;
            moved[k] = x;
            course
                .at(OperatingPoint::at_time(moved[0])
                    .with_angle(moved[1])
                    .with_load(moved[2]))
                .value
        };
        let slope = derivative(along, at[k], 1e-3);
        let size = 1.0 + found.slope[k].abs();
        assert_near("slope", found.slope[k], slope, budget::RICHARDSON * size);
    }
}

#[test]
fn courses_have_exact_slopes() {
    let at = [0.37, 1.1, 4.0];
    for variable in [Variable::Time, Variable::Angle, Variable::Load] {
        for law in [Law::Polynomial345, Law::Cycloidal, Law::ModifiedSine] {
            check(
                &Ramp::new(
                    variable,
                    RampShape {
                        start: 0.1,
                        length: 5.0,
                        values: [0.5, 2.0],
                    },
                    law,
                )
                .unwrap(),
                at,
            );
        }
        check(
            &Ramp::linear(
                variable,
                RampShape {
                    start: 0.1,
                    length: 5.0,
                    values: [0.5, 2.0],
                },
            )
            .unwrap(),
            at,
        );
        check(
            &Sine::new(
                variable,
                SineShape {
                    mean: 1.0,
                    amplitude: 0.3,
                    frequency: 2.5,
                    phase: 0.4,
                },
            )
            .unwrap(),
            at,
        );
    }
    check(
        &Creep::new(CreepLimit {
            slip: 0.03,
            torque: 50.0,
        })
        .unwrap(),
        at,
    );
    // A formula of the user's own, of all three variables.
    let own = |p: OperatingPoint| {
        let (sin, cos) = (p.t * p.phi - p.load * 0.1).sin_cos();
        (sin * 2.0 + cos * p.t + 3.0) / (p.load + 1.0).sqrt() - p.phi
    };
    check(&own, at);
}

#[test]
fn ramps_end_in_their_limits() {
    let shift = Ramp::new(
        Variable::Time,
        RampShape {
            start: 1.0,
            length: 2.0,
            values: [0.5, 2.0],
        },
        Law::Polynomial345,
    )
    .unwrap();
    let line = Ramp::linear(
        Variable::Time,
        RampShape {
            start: 1.0,
            length: 2.0,
            values: [0.5, 2.0],
        },
    )
    .unwrap();
    for (t, value) in [
        (-5.0, 0.5),
        (0.99, 0.5),
        (1.0, 0.5),
        (2.0, 1.25),
        (3.0, 2.0),
        (9.0, 2.0),
    ] {
        for course in [&shift, &line] {
            let found = course.at(OperatingPoint::at_time(t));
            assert_near("value", found.value, value, budget::CLOSED_FORM);
            if !(1.0..=3.0).contains(&t) {
                assert_near("slope", found.slope[0], 0.0, 0.0);
            }
        }
    }
    let middle = |course: &Ramp| course.at(OperatingPoint::at_time(2.0)).slope[0];
    assert_near("slope", middle(&line), 0.75, budget::CLOSED_FORM);
    assert_near("slope", middle(&shift), 0.75 * 1.875, budget::CLOSED_FORM);
}

#[test]
fn curves_pass_through_their_samples() {
    let f = |x: f64| 1.2 + 0.3 * (2.0 * x).sin();
    let tau = std::f64::consts::TAU;
    let samples: Vec<f64> = (0..48).map(|k| f(tau * f64::from(k) / 48.0)).collect();
    let mut control = vec![0.0; control_points(48)];
    fit_periodic(&samples, &mut control).unwrap();
    let turn = Curve::turn(CubicSpline::new(control).unwrap());
    for phi in [0.0, 1.3, -2.0, 9.0, 40.0] {
        let found = turn.at(OperatingPoint::at_time(0.0).with_angle(phi));
        assert_near("value", found.value, f(phi), budget::CURVE[0]);
        assert_near(
            "slope",
            found.slope[1],
            0.6 * (2.0 * phi).cos(),
            budget::CURVE[1],
        );
        check(&turn, [0.0, phi + 0.013, 0.0]);
    }
    let samples: Vec<f64> = (0..=20).map(|k| f(f64::from(k) / 10.0)).collect();
    let mut control = vec![0.0; control_points(20)];
    fit_bounded(&samples, &mut control).unwrap();
    let part =
        Curve::bounded(Variable::Load, 3.0, 2.0, CubicSpline::new(control).unwrap()).unwrap();
    for (load, x) in [(3.0, 0.0), (3.7, 0.7), (5.0, 2.0)] {
        let found = part.at(OperatingPoint::at_time(0.0).with_load(load));
        assert_near("value", found.value, f(x), budget::CURVE[0]);
        assert_near(
            "slope",
            found.slope[2],
            0.6 * (2.0 * x).cos(),
            budget::CURVE[1],
        );
    }
    let outside = part.at(OperatingPoint::at_time(0.0).with_load(7.0));
    assert_near("end value", outside.value, f(2.0), budget::CLOSED_FORM);
    assert_near("end slope", outside.slope[2], 0.0, 0.0);
}

#[test]
fn duals_follow_the_rules_of_differentiation() {
    let [x, y] = Dual::variables(&[0.7, -1.3]);
    let (sin, cos) = (x * y).sin_cos();
    let one = sin * sin + cos * cos;
    assert_near("sin² + cos²", one.value, 1.0, budget::IDENTITY);
    let quotient = (x * 3.0 - y) / (y * y + 1.0);
    let back = quotient * (y * y + 1.0) - (x * 3.0 - y);
    let root = (y * y + x).sqrt();
    let zero = root * root - y * y - x;
    let constant = Dual::<2>::from(4.0) / 2.0 - 2.0;
    for k in 0..2 {
        assert_near("slope of 1", one.slope[k], 0.0, budget::IDENTITY);
        assert_near("q·g − f", back.slope[k], 0.0, budget::IDENTITY);
        assert_near("√f² − f", zero.slope[k], 0.0, budget::IDENTITY);
        assert_near("constant", constant.slope[k], 0.0, 0.0);
    }
    assert_near("∂(xy)/∂x", (x * y).slope[0], -1.3, 0.0);
    assert!(!(x / 0.0).is_finite());
}
