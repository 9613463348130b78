use core::f64::consts::TAU;

use jred::axis::{FeedForward, FrictionRamp, MotionState};
use jred::image::Validity;
use jred::number::{FrictionSign, Number, Quantity};
use jred::table::{AccelerationOf, Format, SpeedOf};
use jred::{
    Cubic, CurveSet, Domain, Phase, Q15, Q31, Quadratic, Rows16, Scale, Speed, Spline, curves,
};

use super::machine::{in_units, si, with_model};
use crate::support::images::VALIDITY;
use crate::support::{assert_near, quantity, samples, scale_of, value};

/// Every term against its curve; their sum against the torque.
fn terms<F: Format, const SET: CurveSet>(scale: Scale, error: f64) {
    with_model::<F, SET>(scale, |model| {
        let scale = *model.table().scale();
        let torque = f64::from(scale.torque());
        for (bits, omega, alpha, share) in samples(
            500,
            0xff01,
            &(proptest::num::u32::ANY, -9.0..9.0, -90.0..90.0, -1.0..1.0),
        ) {
            let (phase, phi) = (
                Phase::from_bits(bits),
                f64::from(bits) / 4_294_967_296.0 * TAU,
            );
            let (w, a) = si::<F::Number>(&scale, [omega, alpha]);
            for (friction, c) in [
                (FrictionSign::OfSpeed(w), omega.signum()),
                (
                    FrictionSign::OfSpeed(si::<F::Number>(&scale, [-omega, 0.0]).0),
                    -omega.signum(),
                ),
                (
                    FrictionSign::Scaled(F::Number::from_f64(share).unwrap()),
                    share,
                ),
            ] {
                let found = model.torque_terms(phase, w, a, friction);
                let exact = [
                    (found.acceleration, (1.0 + 0.25 * phi.cos()) * alpha),
                    (found.velocity, -0.125 * phi.sin() * omega * omega),
                    (found.load, -3.0 * phi.sin()),
                    (found.viscous, 0.1 * omega),
                    (found.coulomb, 0.5 * c),
                ];
                let mut sum = 0.0;
                for (k, (found, exact)) in exact.into_iter().enumerate() {
                    let found = value(found) * torque;
                    assert_near(
                        &format!("{} term {k} at {phi}", F::NAME),
                        found,
                        exact,
                        error,
                    );
                    sum += found;
                }
                let whole = value(model.torque_with(phase, w, a, friction)) * torque;
                assert_near("their sum", sum, whole, error);
            }
        }
    });
}

#[test]
fn contributions_are_the_terms_of_the_equation() {
    const CURVES: CurveSet = curves::ALL;
    const CONSTANTS: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    let scale = scale_of(150.0, 10.0, 1.4);
    terms::<Spline<f32>, CURVES>(Scale::SI, 1e-4);
    terms::<Cubic<f64>, CONSTANTS>(Scale::SI, 1e-4);
    terms::<Cubic<Q31>, CURVES>(scale, 1e-4);
    terms::<Quadratic<Q31>, CONSTANTS>(scale, 3e-3);
    terms::<Rows16, CURVES>(scale, 0.03);
    terms::<Rows16, CONSTANTS>(scale, 0.03);
}

/// The measured speed flickers around zero; the friction follows the set-point.
#[test]
fn friction_does_not_chatter() {
    const SET: CurveSet = curves::LOAD | curves::CONSTANT_COULOMB;
    with_model::<Spline<f64>, SET>(Scale::SI, |model| {
        let feed_forward = FeedForward::new(model, VALIDITY);
        let phase = Phase::from_radians(1.0);
        let torque = |measured: f64, reference: f64| {
            let reference = MotionState {
                phase,
                omega: reference,
                alpha: 2.0,
            };
            let friction = FrictionSign::OfSpeed(reference.omega);
            feed_forward
                .at_measured(phase, measured, reference, friction)
                .torque
        };
        let rest = torque(0.0, 0.01);
        for measured in [1e-6, -1e-6] {
            assert_near("flickering", torque(measured, 0.01), rest, 1e-9);
        }
        assert_near("the other way", torque(1e-6, -0.01), rest - 1.0, 1e-9);
        // With the measured speed it would chatter.
        let chatter = [1e-6, -1e-6].map(|omega| model.torque(phase, omega, 2.0));
        assert_near("chatter", chatter[0] - chatter[1], 1.0, 1e-9);

        // A ramp is continuous, and c beyond its width.
        let ramp = FrictionRamp::new(0.2, &model).unwrap();
        for (omega, share) in [
            (0.0, 0.0),
            (0.05, 0.25),
            (-0.1, -0.5),
            (0.2, 1.0),
            (-3.0, -1.0),
            (9.0, 1.0),
        ] {
            let found = model
                .torque_terms(phase, omega, 0.0, ramp.at(omega))
                .coulomb;
            assert_near("ramp", found, 0.5 * share, 1e-7);
        }
    });
    let model = in_units::<Spline<Q31>>(Domain::Turn, scale_of(1.0, 10.0, 1.0));
    let ramp = FrictionRamp::new(0.2, &model).unwrap();
    for (omega, share) in [(0.05, 0.25), (-0.1, -0.5), (0.4, 1.0), (-3.0, -1.0)] {
        let FrictionSign::Scaled(found) = ramp.at(quantity::<Speed<Q31>>(omega / 10.0)) else {
            panic!("a share");
        };
        assert_near("ramp", found.to_f64(), share, 1e-6);
    }
}

#[test]
fn a_motion_beyond_the_table_is_flagged() {
    fn flags<F: Format>(scale: Scale, cases: &[(F::Number, F::Number, bool, bool)]) {
        with_model::<F, { curves::LOAD }>(scale, |model| {
            let validity = Validity {
                max_speed: 4.0,
                max_acceleration: 40.0,
                torque_error: 0.0,
            };
            let feed_forward = FeedForward::new(model, validity);
            for &(omega, alpha, speed, acceleration) in cases {
                let (omega, alpha) = (Quantity::of(omega), Quantity::of(alpha));
                let status = feed_forward.status(omega, alpha);
                assert_eq!(
                    (status.speed_beyond, status.acceleration_beyond),
                    (speed, acceleration),
                    "{omega:?} {alpha:?}"
                );
                assert_eq!(status.is_valid(), !(speed || acceleration));
                let motion = MotionState {
                    phase: Phase::default(),
                    omega,
                    alpha,
                };
                let checked = feed_forward.at_reference(motion, FrictionSign::OfSpeed(omega));
                assert_eq!(checked.status, status);
            }
        });
    }
    let (nan, inf) = (f32::NAN, f32::INFINITY);
    flags::<Spline<f32>>(
        Scale::SI,
        &[
            (0.0, 0.0, false, false),
            (4.0, -40.0, false, false),
            (4.039, -40.39, false, false),
            (4.041, 40.0, true, false),
            (-4.0, 40.41, false, true),
            (-40.0, -400.0, true, true),
            (nan, 0.0, true, false),
            (-0.0, -nan, false, true),
            (inf, -inf, true, true),
        ],
    );
    let scale = scale_of(150.0, 10.0, 1.5);
    let of = |share: f64| Q31::from_f64(share).unwrap();
    flags::<Spline<Q31>>(
        scale,
        &[
            (of(0.3), of(-0.3), false, false),
            (Q31::MAX, of(0.0), true, false),
            (of(0.0), Q31::MIN, false, true),
            (Q31::MIN, Q31::MAX, true, true),
        ],
    );
    let of = |share: f64| Q15::from_f64(share).unwrap();
    flags::<Rows16>(
        scale,
        &[
            (of(0.3), of(-0.3), false, false),
            (Q15::MIN, of(0.0), true, false),
            (of(0.0), Q15::MAX, false, true),
        ],
    );
}

/// A speed base that equals the table's limit: a saturated speed is still outside the table's validity.
#[test]
fn a_number_that_was_limited_is_flagged() {
    fn limited<F: Format>() {
        let scale = scale_of(150.0, 10.0, 1.5);
        with_model::<F, { curves::LOAD }>(scale, |model| {
            let scale = *model.table().scale();
            for share in [0.995, 1.0, 2.0] {
                let validity = Validity {
                    max_speed: share * scale.speed(),
                    max_acceleration: share * scale.acceleration(),
                    torque_error: 0.0,
                };
                let feed_forward = FeedForward::new(model, validity);
                for sign in [-1.0, 1.0] {
                    let [inside, outside] = [0.999, 1.001].map(|of_base| {
                        let of_base: f32 = sign * of_base;
                        let omega = scale.omega::<SpeedOf<F>>(of_base * scale.speed());
                        let alpha =
                            scale.alpha::<AccelerationOf<F>>(of_base * scale.acceleration());
                        assert_eq!([omega.saturated, alpha.saturated], [of_base.abs() > 1.0; 2]);
                        feed_forward.status(omega.value, alpha.value)
                    });
                    assert!(inside.is_valid(), "{share}: {inside:?}");
                    assert!(
                        outside.speed_beyond && outside.acceleration_beyond,
                        "{share}: {outside:?}"
                    );
                }
            }
        });
    }
    limited::<Spline<Q31>>();
    limited::<Rows16>();
}

#[test]
fn the_measured_state_is_where_the_curves_are_read() {
    const SET: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    with_model::<Cubic<f64>, SET>(Scale::SI, |model| {
        let feed_forward = FeedForward::new(model, VALIDITY);
        let (at, speed) = (2.0, 6.0);
        let reference = MotionState {
            phase: Phase::from_radians(0.5),
            omega: -3.0,
            alpha: 20.0,
        };
        let friction = FrictionSign::OfSpeed(reference.omega);
        let found = feed_forward.at_measured(Phase::from_radians(at), speed, reference, friction);
        let (sin, cos) = f64::sin_cos(at);
        let expected =
            (1.0 + 0.25 * cos) * 20.0 - 0.125 * sin * speed * speed - 3.0 * sin + 0.1 * speed - 0.5;
        assert_near("at the measured state", found.torque, expected, 1e-5);
        assert!(found.status.is_valid());
        let (sin, cos) = f64::sin_cos(0.5);
        let expected = (1.0 + 0.25 * cos) * 20.0 - 0.125 * sin * 9.0 - 3.0 * sin - 0.3 - 0.5;
        assert_near(
            "at the reference",
            feed_forward.at_reference(reference, friction).torque,
            expected,
            1e-5,
        );
        // The measured speed is checked, and a set-point of NaN.
        assert!(
            feed_forward
                .at_measured(reference.phase, 11.0, reference, friction)
                .status
                .speed_beyond
        );
        let none = FrictionSign::OfSpeed(f64::NAN);
        assert!(
            feed_forward
                .at_measured(reference.phase, 1.0, reference, none)
                .status
                .speed_beyond
        );
        let ramp = FrictionRamp::new(0.2, &model).unwrap();
        assert_eq!(ramp.at(f64::NAN), FrictionSign::Scaled(0.0));
    });
}

/// A vertical axis: for any flagged input (NaN, infinity, too fast) the torque is that of the nearest valid motion, and never less than the weight
/// needs at rest.
#[test]
fn what_is_flagged_holds_the_weight() {
    fn held<F: Format>(scale: Scale, wrong: &[f64], error: f64) {
        with_model::<F, { curves::LOAD }>(scale, |model| {
            let scale = *model.table().scale();
            let feed_forward = FeedForward::new(
                model,
                Validity {
                    max_speed: 4.0,
                    max_acceleration: 0.1,
                    torque_error: 0.0,
                },
            );
            // At a quarter turn the load is 3 N·m, J is 1, ½·J′ is −0.125.
            let phase = Phase::from_bits(1 << 30);
            for &wrong in wrong {
                let (omega, alpha) = si::<F::Number>(&scale, [wrong, wrong]);
                let sides = [wrong.clamp(-4.04, 4.04), wrong.clamp(-0.101, 0.101)];
                let [w, a] = sides.map(|x| if x.is_nan() { 0.0 } else { x });
                let motion = MotionState {
                    phase,
                    omega,
                    alpha,
                };
                let none = MotionState {
                    phase,
                    ..MotionState::default()
                };
                for (found, exact) in [
                    (
                        feed_forward.at_reference(motion, FrictionSign::OfSpeed(omega)),
                        a - 0.125 * w * w - 3.0,
                    ),
                    (
                        feed_forward.at_reference(
                            MotionState {
                                alpha: Default::default(),
                                ..motion
                            },
                            FrictionSign::OfSpeed(omega),
                        ),
                        -0.125 * w * w - 3.0,
                    ),
                    (
                        feed_forward.at_reference(
                            MotionState {
                                omega: Default::default(),
                                ..motion
                            },
                            FrictionSign::OfSpeed(none.omega),
                        ),
                        a - 3.0,
                    ),
                    (
                        feed_forward.at_measured(
                            phase,
                            omega,
                            none,
                            FrictionSign::OfSpeed(none.omega),
                        ),
                        -0.125 * w * w - 3.0,
                    ),
                    (
                        feed_forward.at_measured(
                            phase,
                            none.omega,
                            motion,
                            FrictionSign::OfSpeed(none.omega),
                        ),
                        a - 3.0,
                    ),
                    (
                        feed_forward.at_measured(
                            phase,
                            none.omega,
                            MotionState {
                                alpha: none.alpha,
                                ..motion
                            },
                            FrictionSign::Scaled(F::Number::default()),
                        ),
                        -3.0,
                    ),
                ] {
                    assert!(!found.status.is_valid(), "{wrong}: {found:?}");
                    let torque = value(found.torque) * f64::from(scale.torque());
                    assert_near(&format!("{} at {wrong}", F::NAME), torque, exact, error);
                }
            }
        });
    }
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    held::<Spline<f32>>(Scale::SI, &[nan, -nan, inf, -inf, 1e30, -5.0, 50.0], 1e-4);
    held::<Cubic<f64>>(Scale::SI, &[nan, inf, -inf, 5.0], 1e-4);
    // In fixed point a set-point beyond the base is limited to it.
    held::<Spline<Q31>>(scale_of(150.0, 10.0, 1.5), &[1e30, -1e30, 5.0, -9.0], 1e-4);
    held::<Rows16>(scale_of(150.0, 10.0, 1.5), &[1e30, -1e30, 5.0, -9.0], 0.03);
}
