use core::f64::consts::TAU;

use jred::axis::{FeedForward, Gearbox, Motion, Period, Ramp, TorqueLimits, Transmission};
use jred::number::{Number, Sliding};
use jred::table::Format;
use jred::{
    Cubic, Domain, Model, Phase, Q15, Q31, Quadratic, Reducible, Rows16, Scale, Set, Spline,
    Validity, curves,
};

use crate::support::images::VALIDITY;
use crate::support::machines::Wave;
use crate::support::rows::Rows;
use crate::support::{assert_near, samples, scale_of};

const WAVE: Wave = Wave {
    mean: 1.0,
    swing: 0.25,
    load: 3.0,
    viscous: 0.1,
    coulomb: 0.5,
    domain: Domain::Turn,
};

/// Calls `with` with a model of the wave.
fn with_model<F: Format, const SET: Set>(scale: Scale, with: impl FnOnce(Model<'_, F, SET>)) {
    let cells = 128;
    let scale = if F::WHOLE_FACTOR {
        scale.for_cells(cells, TAU)
    } else {
        scale
    };
    let rows = Rows::<F>::of(&WAVE, SET, cells, &scale).unwrap();
    with(Model::new(rows.table()).unwrap());
}

fn si<N: Number>(scale: &Scale, [omega, alpha]: [f64; 2]) -> [N; 2] {
    [
        scale.omega(omega as f32).value,
        scale.alpha(alpha as f32).value,
    ]
}

/// Every term against the curve that it is made of; their sum against the torque.
fn terms<F: Format, const SET: Set>(scale: Scale, error: f64) {
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
            let [w, a] = si::<F::Number>(&scale, [omega, alpha]);
            for (sliding, c) in [
                (Sliding::Against(w), omega.signum()),
                (
                    Sliding::Against(si(&scale, [-omega, 0.0])[0]),
                    -omega.signum(),
                ),
                (Sliding::Share(F::Number::from_f64(share).unwrap()), share),
            ] {
                let found = model.contributions(phase, w, a, sliding);
                let exact = [
                    (found.inertial, (1.0 + 0.25 * phi.cos()) * alpha),
                    (found.velocity, -0.125 * phi.sin() * omega * omega),
                    (found.load, -3.0 * phi.sin()),
                    (found.viscous, 0.1 * omega),
                    (found.coulomb, 0.5 * c),
                ];
                let mut sum = 0.0;
                for (k, (found, exact)) in exact.into_iter().enumerate() {
                    let found = found.to_f64() * torque;
                    assert_near(
                        &format!("{} term {k} at {phi}", F::NAME),
                        found,
                        exact,
                        error,
                    );
                    sum += found;
                }
                let whole = model.torque_with(phase, w, a, sliding).to_f64() * torque;
                assert_near("their sum", sum, whole, error);
            }
        }
    });
}

#[test]
fn contributions_are_the_terms_of_the_equation() {
    const CURVES: Set = curves::ALL;
    const CONSTANTS: Set = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
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
    const SET: Set = curves::LOAD | curves::CONSTANT_COULOMB;
    with_model::<Spline<f64>, SET>(Scale::SI, |model| {
        let feed_forward = FeedForward::new(model, VALIDITY);
        let phase = Phase::from_radians(1.0);
        let torque = |measured: f64, reference: f64| {
            let reference = Motion {
                phase,
                omega: reference,
                alpha: 2.0,
            };
            let sliding = Sliding::Against(reference.omega);
            feed_forward
                .at_measured(phase, measured, reference, sliding)
                .torque
        };
        let rest = torque(0.0, 0.01);
        for measured in [1e-6, -1e-6] {
            assert_near("flickering", torque(measured, 0.01), rest, 1e-9);
        }
        assert_near("the other way", torque(1e-6, -0.01), rest - 1.0, 1e-9);
        // By the measured speed it would chatter.
        let chatter = [1e-6, -1e-6].map(|omega| model.torque(phase, omega, 2.0));
        assert_near("chatter", chatter[0] - chatter[1], 1.0, 1e-9);

        // A ramp is continuous, and c beyond its width.
        let ramp = Ramp::new(0.2, &Scale::SI).unwrap();
        for (omega, share) in [
            (0.0, 0.0),
            (0.05, 0.25),
            (-0.1, -0.5),
            (0.2, 1.0),
            (-3.0, -1.0),
            (9.0, 1.0),
        ] {
            let found = model
                .contributions(phase, omega, 0.0, ramp.at(omega))
                .coulomb;
            assert_near("ramp", found, 0.5 * share, 1e-7);
        }
    });
    let ramp = Ramp::new(0.2, &scale_of(1.0, 10.0, 1.0)).unwrap();
    for (omega, share) in [(0.05, 0.25), (-0.1, -0.5), (0.4, 1.0), (-3.0, -1.0)] {
        let Sliding::Share(found) = ramp.at(Q31::from_f64(omega / 10.0).unwrap()) else {
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
                omega: 4.0,
                alpha: 40.0,
                torque_error: 0.0,
            };
            let feed_forward = FeedForward::new(model, validity);
            for &(omega, alpha, speed, acceleration) in cases {
                let status = feed_forward.status(omega, alpha);
                assert_eq!(
                    (status.speed, status.acceleration),
                    (speed, acceleration),
                    "{omega:?} {alpha:?}"
                );
                assert_eq!(status.is_valid(), !(speed || acceleration));
                let motion = Motion {
                    phase: Phase::default(),
                    omega,
                    alpha,
                };
                let checked = feed_forward.at_reference(motion, Sliding::Against(omega));
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

/// Runge-Kutta steps of the exact machine under a constant torque: angle and speed after `time`.
fn driven(torque: f64, [phi, omega]: [f64; 2], time: f64) -> [f64; 2] {
    let alpha = |[phi, omega]: [f64; 2]| WAVE.reduction(phi).unwrap().acceleration(omega, torque);
    let steps = 64;
    let h = time / f64::from(steps);
    let mut at = [phi, omega];
    for _ in 0..steps {
        let step = |by: [f64; 2], h: f64| [at[0] + h * by[0], at[1] + h * by[1]];
        let k1 = [at[1], alpha(at)];
        let p2 = step(k1, h / 2.0);
        let k2 = [p2[1], alpha(p2)];
        let p3 = step(k2, h / 2.0);
        let k3 = [p3[1], alpha(p3)];
        let p4 = step(k3, h);
        let k4 = [p4[1], alpha(p4)];
        for j in 0..2 {
            at[j] += h / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]);
        }
    }
    at
}

#[test]
fn the_middle_of_a_tick_is_one_order_better() {
    const SET: Set = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    with_model::<Cubic<f64>, SET>(Scale::SI, |model| {
        for (bits, from, alpha) in samples(
            40,
            0xff02,
            &(proptest::num::u32::ANY, 2.0..8.0, -60.0..60.0),
        ) {
            let phase = Phase::from_bits(bits);
            let phi = f64::from(bits) / 4_294_967_296.0 * TAU;
            let missed = |time: f64| {
                let to = from + alpha * time;
                let period =
                    Period::<f64>::new(time as f32, Domain::<f64>::Turn, &Scale::SI).unwrap();
                let middle = period.between(phase, from, to).value;
                let torque = |m: Motion<f64>| model.torque(m.phase, m.omega, m.alpha);
                let start = Motion {
                    phase,
                    omega: from,
                    alpha,
                };
                [middle, start].map(|motion| driven(torque(motion), [phi, from], time)[1] - to)
            };
            let [coarse, fine] = [missed(0.02), missed(0.01)];
            // Order two of the start: a quarter. Order three of the middle: an eighth, where it is not zero by chance.
            assert!(
                coarse[0].abs() < 0.2 * coarse[1].abs() + 2e-4,
                "{phi}: {coarse:?}"
            );
            assert!(
                fine[0].abs() < 0.16 * coarse[0].abs() + 2e-6,
                "{phi}: {coarse:?} {fine:?}"
            );
        }
    });
}

#[test]
fn a_lead_time_is_made_up_for() {
    let turn = Domain::<f64>::Turn;
    let scale = scale_of(150.0, 10.0, 1.5);
    for (omega, alpha, lead) in [
        (3.0, -40.0, 0.002),
        (-7.0, 80.0, 0.001),
        (0.0, 90.0, 0.01),
        (5.0, 0.0, 0.000_1),
    ] {
        let [moved, later] = [
            omega * lead + 0.5 * alpha * lead * lead,
            omega + alpha * lead,
        ];
        let check = |name: &str, phase: Phase, found: f64, error: f64| {
            let turned = f64::from(phase.to_bits().cast_signed()) / 4_294_967_296.0 * TAU;
            assert_near(&format!("{name} angle"), turned, moved, error * lead + 1e-8);
            assert_near(&format!("{name} speed"), found, later, error);
        };
        let start = Motion {
            phase: Phase::default(),
            omega,
            alpha,
        };
        let after = Period::<f64>::new(lead as f32, turn, &Scale::SI)
            .unwrap()
            .later(start)
            .value;
        check("f64", after.phase, after.omega, 1e-6);
        let [w, a] = si::<Q31>(&scale, [omega, alpha]);
        let start = Motion {
            phase: Phase::default(),
            omega: w,
            alpha: a,
        };
        let after = Period::<Q31>::new(lead as f32, turn, &scale)
            .unwrap()
            .later(start)
            .value;
        check("q31", after.phase, after.omega.to_f64() * 10.0, 1e-5);
        let [w, a] = si::<Q15>(&scale, [omega, alpha]);
        let start = Motion {
            phase: Phase::default(),
            omega: w,
            alpha: a,
        };
        let after = Period::<Q15>::new(lead as f32, turn, &scale)
            .unwrap()
            .later(start)
            .value;
        check("q15", after.phase, after.omega.to_f64() * 10.0, 2e-3);
    }
}

#[test]
fn a_gearbox_loses_on_the_side_that_is_driven() {
    let gearbox = Gearbox {
        ratio: 8.0,
        efficiency: 0.9,
        rotor: 0.002,
    };
    let scale = scale_of(150.0, 10.0, 1.5);
    let single = Transmission::new::<f64>(gearbox, &Scale::SI).unwrap();
    let fixed = Transmission::new::<Q31>(gearbox, &scale).unwrap();
    assert_near("base", fixed.base().into(), 150.0 / (8.0 * 0.9), 1e-5);
    for (torque, omega, alpha) in samples(300, 0xff03, &(-140.0..140.0, -9.0..9.0, -60.0..60.0)) {
        // Power through the gearbox: out is in less the losses, whichever side drives.
        let [motor, load]: [f64; 2] = [8.0 * omega, omega];
        let through = single.motor(torque, omega, alpha).value - 8.0 * 0.002 * alpha;
        let (at_motor, at_load): (f64, f64) = (through * motor, torque * load);
        let (given, got) = if at_load > 0.0 {
            (at_motor, at_load)
        } else {
            (-at_load, -at_motor)
        };
        assert_near("power", got, 0.9 * given, 1e-4);
        let [w, a] = si::<Q31>(&scale, [omega, alpha]);
        let pu: Q31 = scale.to_torque(torque as f32).value;
        let expected = single.motor(torque, omega, alpha).value;
        let found = fixed.motor(pu, w, a);
        assert!(!found.saturated);
        assert_near(
            "q31",
            found.value.to_f64() * f64::from(fixed.base()),
            expected,
            1e-4,
        );
    }
    // At rest the motor drives, whatever the torque's sign.
    for torque in [50.0, -50.0] {
        assert_near(
            "at rest",
            single.motor(torque, 0.0, 0.0).value,
            torque / (8.0 * 0.9),
            1e-5,
        );
    }
    // The gearbox alone, the rotor alone, and their sum leave the range.
    let half = Q31::from_f64(0.6).unwrap();
    let light = Transmission::new::<Q31>(
        Gearbox {
            rotor: 0.0,
            ..gearbox
        },
        &scale,
    )
    .unwrap();
    assert!(!light.motor(half, half, half).saturated);
    let heavy = Transmission::new::<Q31>(
        Gearbox {
            rotor: 10.0,
            ..gearbox
        },
        &scale,
    )
    .unwrap();
    assert!(heavy.motor(Q31::default(), half, half).saturated);
    let full = fixed.motor(Q31::MAX, Q31::MAX, Q31::MAX);
    assert!(full.saturated && full.value == Q31::MAX);
}

#[test]
fn limits_take_away_and_say_so() {
    let limits = TorqueLimits::new(-2.0, 5.0).unwrap();
    for (torque, within, clipped) in [
        (1.0, 1.0, 0.0),
        (-2.0, -2.0, 0.0),
        (7.5, 5.0, 2.5),
        (-3.0, -2.0, -1.0),
    ] {
        let limited = limits.limited(torque);
        assert_near("torque", limited.torque, within, 0.0);
        assert_near("clipped", limited.clipped, clipped, 0.0);
    }
    let none = limits.limited(f64::NAN);
    assert_near("no number", none.torque, 0.0, 0.0);
    assert!(none.clipped.is_nan());
    assert_near("no end", limits.limited(f64::INFINITY).torque, 5.0, 0.0);
    let half = Q15::from_f64(0.5).unwrap();
    let limits = TorqueLimits::new(Q15::MIN, half).unwrap();
    assert_eq!(limits.limited(Q15::MAX).torque, half);
    assert_near(
        "clipped",
        limits.limited(Q15::MAX).clipped.to_f64(),
        0.5,
        1e-4,
    );
    for (least, greatest) in [(1.0, 2.0), (-2.0, -1.0), (f64::NAN, 1.0), (-1.0, f64::NAN)] {
        assert!(
            TorqueLimits::new(least, greatest).is_err(),
            "{least} {greatest}"
        );
    }
    let good = Gearbox {
        ratio: 8.0,
        efficiency: 0.9,
        rotor: 0.002,
    };
    for wrong in [
        Gearbox { ratio: 0.0, ..good },
        Gearbox {
            ratio: f32::NAN,
            ..good
        },
        Gearbox {
            efficiency: 0.0,
            ..good
        },
        Gearbox {
            efficiency: 1.1,
            ..good
        },
        Gearbox {
            rotor: -1.0,
            ..good
        },
        Gearbox {
            rotor: f32::INFINITY,
            ..good
        },
    ] {
        assert!(
            Transmission::new::<f32>(wrong, &Scale::SI).is_err(),
            "{wrong:?}"
        );
    }
    for width in [0.0, -1.0, f32::NAN, 1e-7] {
        assert!(Ramp::new(width, &Scale::SI).is_err(), "{width}");
    }
}

#[test]
fn the_measured_state_is_where_the_curves_are_read() {
    const SET: Set = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
    with_model::<Cubic<f64>, SET>(Scale::SI, |model| {
        let feed_forward = FeedForward::new(model, VALIDITY);
        let (at, speed) = (2.0, 6.0);
        let reference = Motion {
            phase: Phase::from_radians(0.5),
            omega: -3.0,
            alpha: 20.0,
        };
        let sliding = Sliding::Against(reference.omega);
        let found = feed_forward.at_measured(Phase::from_radians(at), speed, reference, sliding);
        let (sin, cos) = f64::sin_cos(at);
        let expected =
            (1.0 + 0.25 * cos) * 20.0 - 0.125 * sin * speed * speed - 3.0 * sin + 0.1 * speed - 0.5;
        assert_near("at the measured state", found.torque, expected, 1e-5);
        assert!(found.status.is_valid());
        let (sin, cos) = f64::sin_cos(0.5);
        let expected = (1.0 + 0.25 * cos) * 20.0 - 0.125 * sin * 9.0 - 3.0 * sin - 0.3 - 0.5;
        assert_near(
            "at the reference",
            feed_forward.at_reference(reference, sliding).torque,
            expected,
            1e-5,
        );
        // The measured speed is judged, and a set-point that is no number.
        assert!(
            feed_forward
                .at_measured(reference.phase, 11.0, reference, sliding)
                .status
                .speed
        );
        let none = Sliding::Against(f64::NAN);
        assert!(
            feed_forward
                .at_measured(reference.phase, 1.0, reference, none)
                .status
                .speed
        );
        let ramp = Ramp::new(0.2, &Scale::SI).unwrap();
        assert_eq!(ramp.at(f64::NAN), Sliding::Share(0.0));
    });
}

#[test]
fn a_limited_motion_is_flagged_and_a_stroke_ends() {
    let scale = scale_of(10.0, 30.0, 1.0);
    let turn = Domain::<f64>::Turn;
    let time = Period::<Q31>::new(0.001, turn, &scale).unwrap();
    let fast = Q31::from_f64(0.8).unwrap();
    assert!(
        time.between(Phase::default(), Q31::default(), fast)
            .saturated
    );
    assert!(!time.between(Phase::default(), fast, fast).saturated);
    let long = Period::<Q31>::new(0.05, turn, &scale_of(1000.0, 30.0, 1.0)).unwrap();
    let start = Motion {
        phase: Phase::default(),
        omega: fast,
        alpha: Q31::MAX,
    };
    assert!(long.later(start).saturated);
    assert!(
        !long
            .later(Motion {
                alpha: Q31::default(),
                ..start
            })
            .saturated
    );
    // A quarter of a turn a period at the speed base is the most.
    assert!(Period::<Q31>::new(0.25 * TAU as f32 / 30.0 * 1.01, turn, &scale).is_err());
    assert!(Period::<Q31>::new(0.25 * TAU as f32 / 30.0 * 0.99, turn, &scale).is_ok());
    // Up to half a turn, in floating point too.
    let lead = Period::<f64>::new(0.006, turn, &Scale::SI).unwrap();
    let ahead = lead.later(Motion {
        phase: Phase::default(),
        omega: 100.0 * core::f64::consts::PI / 4.0,
        alpha: 0.0,
    });
    assert_near(
        "turns",
        f64::from(ahead.value.phase.to_bits()) / 4_294_967_296.0,
        0.075,
        1e-6,
    );
    let ahead = lead.later(Motion {
        phase: Phase::default(),
        omega: 450.0,
        alpha: 0.0,
    });
    assert_near(
        "turns",
        f64::from(ahead.value.phase.to_bits()) / 4_294_967_296.0,
        450.0 * 0.006 / TAU,
        1e-6,
    );

    let stroke = Domain::stroke(0.0, 0.5).unwrap();
    let time = Period::<f64>::new(0.01, stroke, &Scale::SI).unwrap();
    for (phase, omega, end) in [(0xffff_0000, 1.0, u32::MAX), (0x0001_0000, -1.0, 0)] {
        let start = Motion {
            phase: Phase::from_bits(phase),
            omega,
            alpha: 0.0,
        };
        assert_eq!(time.later(start).value.phase.to_bits(), end);
        assert_eq!(
            time.between(start.phase, omega, omega)
                .value
                .phase
                .to_bits(),
            end
        );
    }
}
