use core::f64::consts::TAU;

use jred::axis::{AxisError, Envelope, Gearbox, Limit, Limits, Period};
use jred::number::Number;
use jred::table::{Format, TorqueOf};
use jred::{Cubic, CurveSet, Domain, Phase, Q31, Quadratic, Rows16, Scale, Speed, Spline, curves};
use proptest::num::u32::ANY;

use super::machine::{in_units, si, with_model};
use crate::support::{assert_near, quantity, samples, scale_of, value};

const SET: CurveSet = curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB;
/// A drive for the wave: 8 N·m up to 4 rad/s, 3 at 8 and nothing beyond; 6 when braking.
const POINTS: [[f32; 2]; 3] = [[4.0, 8.0], [6.0, 7.0], [8.0, 3.0]];

/// The same, as an independent formula.
fn driving(omega: f64) -> f64 {
    match omega {
        w if w <= 4.0 => 8.0,
        w if w <= 6.0 => 8.0 - (w - 4.0) / 2.0,
        w if w <= 8.0 => 7.0 - (w - 6.0) * 2.0,
        _ => 0.0,
    }
}

fn interval(omega: f64) -> [f64; 2] {
    if omega > 0.0 {
        [-6.0, driving(omega)]
    } else if omega < 0.0 {
        [-driving(-omega), 6.0]
    } else {
        [-8.0, 8.0]
    }
}

fn envelope_of<F: Format>(scale: Scale, error: f64) {
    let model = in_units::<F>(Domain::Turn, scale);
    let envelope = Envelope::<_, 3>::new(POINTS, 6.0, &model).unwrap();
    let torque = |torque| value::<TorqueOf<F>>(torque) * f64::from(scale.torque());
    let on_points = [0.0, 4.0, -4.0, 6.0, -6.0, 7.999, 8.5, -8.5];
    for omega in samples(400, 0xff10, &(-9.0..9.0))
        .into_iter()
        .chain(on_points)
    {
        let (w, _) = si::<F::Number>(&scale, [omega, 0.0]);
        let exact = interval(value(w) * f64::from(scale.speed()));
        let found = envelope.torques(w).map(torque);
        for (found, exact) in found.into_iter().zip(exact) {
            assert_near(
                &format!("{} at {omega}", <F::Number as Number>::NAME),
                found,
                exact,
                error,
            );
        }
    }
}

#[test]
fn an_envelope_is_that_of_its_points() {
    let scale = scale_of(10.0, 10.0, 1.5);
    envelope_of::<Spline<f64>>(Scale::SI, 1e-6);
    envelope_of::<Spline<f32>>(Scale::SI, 2e-6);
    envelope_of::<Spline<Q31>>(scale, 10.0 * 6.0 / 2_147_483_648.0 + 2e-6);
    envelope_of::<Rows16>(scale, 10.0 * 3.0 / 32_768.0);
    let model = in_units::<Spline<f32>>(Domain::Turn, Scale::SI);
    let none = Envelope::new(POINTS, 6.0, &model)
        .unwrap()
        .torques(f32::NAN);
    assert_eq!(none.map(f32::to_bits), [0; 2]);
}

#[test]
fn an_envelope_of_a_motor_is_that_of_the_drive_link() {
    let gearbox = Gearbox {
        ratio: 10.0,
        efficiency: 0.9,
        rotor: 0.0,
    };
    let motor = [[40.0, 0.8], [60.0, 0.4]];
    let model = in_units::<Spline<f64>>(Domain::Turn, Scale::SI);
    let link = Envelope::of_motor(motor, 0.6, gearbox, &model).unwrap();
    // At 5 rad/s the motor turns at 50 and drives with 0.6, which gives 0.9 at the link.
    let found = link.torques(5.0);
    assert_near("driving", found[1], 0.6 * 10.0 * 0.9, 1e-6);
    assert_near("braking", found[0], -0.6 * 10.0, 1e-6);
    let rotor = Gearbox {
        rotor: 1e-4,
        ..gearbox
    };
    let refused = Envelope::of_motor(motor, 0.6, rotor, &model);
    assert!(matches!(
        refused,
        Err(AxisError::OutOfRange {
            what: "the inertia of the rotor",
            ..
        })
    ));
}

#[test]
fn envelopes_that_cannot_be_are_refused() {
    let model = in_units::<Spline<f32>>(Domain::Turn, Scale::SI);
    let made = |points: [[f32; 2]; 2], brake| Envelope::new(points, brake, &model);
    assert!(made([[0.0, 5.0], [1.0, 0.0]], 5.0).is_ok());
    let nan = f32::NAN;
    for (points, brake) in [
        ([[1.0, 5.0], [1.0, 4.0]], 5.0),
        ([[-1.0, 5.0], [1.0, 4.0]], 5.0),
        ([[1.0, 5.0], [2.0, 6.0]], 5.0),
        ([[1.0, 5.0], [2.0, -1.0]], 5.0),
        ([[1.0, 0.0], [2.0, 0.0]], 5.0),
        ([[1.0, nan], [2.0, 1.0]], 5.0),
        ([[1.0, 5.0], [nan, 1.0]], 5.0),
        ([[1.0, 5.0], [2.0, nan]], 5.0),
        ([[1.0, 5.0], [f32::INFINITY, 1.0]], 5.0),
        ([[1.0, f32::INFINITY], [2.0, 1.0]], 5.0),
        ([[1.0, 5.0], [2.0, 4.0]], 0.0),
        ([[1.0, 5.0], [2.0, 4.0]], nan),
    ] {
        assert!(made(points, brake).is_err(), "{points:?} {brake}");
    }
    assert!(Envelope::new([], 5.0, &model).is_err());
    let model = in_units::<Spline<Q31>>(Domain::Turn, scale_of(4.0, 10.0, 1.0));
    assert!(Envelope::new([[5.0, 4.5]], 3.0, &model).is_err());
    // A curve that continues above the speed base ends there.
    let beyond = Envelope::new([[5.0, 3.6], [15.0, 1.6]], 3.0, &model).unwrap();
    let [least, most] = beyond
        .torques(quantity(0.9))
        .map(|torque| 4.0 * value(torque));
    assert_near("least", least, -3.0, 1e-6);
    assert_near("most", most, 2.8, 1e-6);
    assert_near(
        "most",
        4.0 * value(beyond.torques(Speed::<Q31>::MAX)[1]),
        2.6,
        1e-6,
    );
    assert!(Envelope::new([[5.0, 3.5]], 4.5, &model).is_err());
    assert!(Envelope::new([[5.0, 3.5]], 3.0, &model).is_ok());
}

/// In every state: the torque of the accelerations, and the active limit, against the equation of motion.
fn feasible<F: Format>(scale: Scale, error: f64) {
    with_model::<F, SET>(scale, |model| {
        let scale = *model.table().scale();
        let period = Period::new(0.05, &model).unwrap();
        let envelope = Envelope::new(POINTS, 6.0, &model).unwrap();
        let limits = Limits::new(envelope, 5.5, 7.5, period, &model).unwrap();
        let [torque, speed, alpha_base] =
            [scale.torque(), scale.speed(), scale.acceleration()].map(f64::from);
        let mut seen = [0; 3];
        for (bits, omega) in samples(600, 0xff11, &(ANY, -9.0..9.0)) {
            let phi = f64::from(bits) / 4_294_967_296.0 * TAU;
            let (w, _) = si::<F::Number>(&scale, [omega, 0.0]);
            let omega = value(w) * speed;
            let found = limits.feasible(&model, Phase::from_bits(bits), w);
            let drag = -0.125 * phi.sin() * omega * omega - 3.0 * phi.sin()
                + 0.1 * omega
                + 0.5 * omega.signum();
            let of_torque = interval(omega).map(|t| (t - drag) / (1.0 + 0.25 * phi.cos()));
            let of_speed = [-5.5 - omega, 5.5 - omega].map(|gain| gain / 0.05);
            let clamped = |k: usize| {
                of_speed[k]
                    .clamp(-7.5, 7.5)
                    .clamp(of_torque[0], of_torque[1])
            };
            for (k, bound) in [(0, found.least), (1, found.greatest)] {
                let alpha = value(bound.alpha) * alpha_base;
                assert_near(
                    &format!("{} at {phi}, {omega}", F::NAME),
                    alpha,
                    clamped(k),
                    error,
                );
                let (by, from) = match bound.by {
                    Limit::Torque => (0, of_torque[k]),
                    Limit::Acceleration => (1, [-7.5, 7.5][k]),
                    Limit::Speed => (2, of_speed[k]),
                    other => panic!("{other:?}"),
                };
                // The limit reported as active is met; if none can be met, the other end of the torque range.
                assert!(
                    (alpha - from).abs() < error || found.unkept.is_some(),
                    "{bound:?}"
                );
                seen[by] += 1;
            }
            // The acceleration limit cannot correct the speed within a tick, or the torque is insufficient.
            let close = of_speed.map(|alpha| alpha.clamp(-7.5, 7.5));
            let conflict = close[1] < of_torque[0]
                || close[0] > of_torque[1]
                || of_speed[1] < -7.5
                || of_speed[0] > 7.5;
            let near = |x: f64, y: f64| (x - y).abs() < error;
            let unsure = near(of_torque[0], close[1])
                || near(of_torque[1], close[0])
                || near(of_speed[1], -7.5)
                || near(of_speed[0], 7.5);
            assert!(
                unsure || found.unkept.is_some() == conflict,
                "{found:?} {of_torque:?}"
            );
            // Back through the model: never more than the drive has.
            for bound in [found.least, found.greatest] {
                let needed = value(model.torque(Phase::from_bits(bits), w, bound.alpha)) * torque;
                let [least, most] = interval(omega);
                assert!(
                    needed > least - error && needed < most + error,
                    "{needed} {bound:?}"
                );
            }
        }
        assert!(seen.iter().all(|n| *n > 20), "{seen:?}");
    });
}

#[test]
fn feasible_accelerations_are_those_of_the_equation_of_motion() {
    feasible::<Cubic<f64>>(Scale::SI, 2e-5);
    feasible::<Spline<f32>>(Scale::SI, 5e-4);
    let scale = scale_of(60.0, 10.0, 3.0);
    feasible::<Cubic<Q31>>(scale, 5e-4);
    feasible::<Quadratic<Q31>>(scale, 2e-3);
    feasible::<Rows16>(scale, 0.03);
}

#[test]
fn friction_holds_a_machine_at_rest() {
    with_model::<Cubic<f64>, SET>(Scale::SI, |model| {
        let period = Period::new(0.001, &model).unwrap();
        let at = |phi: f64, peak: f32| {
            let envelope = Envelope::new([[9.0, peak]], peak, &model).unwrap();
            let limits = Limits::new(envelope, 8.5, 75.0, period, &model).unwrap();
            let found = limits.feasible(&model, Phase::from_radians(phi), 0.0);
            [found.least.alpha, found.greatest.alpha]
        };
        // The load is 3·sin φ, c is 0.5, J is 1 at a quarter turn.
        let quarter = TAU / 4.0;
        for (phi, peak, expected) in [
            (0.0, 0.4, [0.0, 0.0]),
            (0.0, 1.5, [-1.0 / 1.25, 1.0 / 1.25]),
            // The load exceeds friction and drive: the machine starts, and the drive can only hold back.
            (quarter, 1.0, [3.0 - 0.5 - 1.0, 3.0 - 0.5 + 1.0]),
            (quarter, 2.8, [0.0, 3.0 - 0.5 + 2.8]),
            (quarter, 4.0, [3.0 + 0.5 - 4.0, 3.0 - 0.5 + 4.0]),
            (-quarter, 2.8, [-3.0 + 0.5 - 2.8, 0.0]),
        ] {
            let found = at(phi, peak);
            for (found, expected) in found.into_iter().zip(expected) {
                assert_near(&format!("at {phi} with {peak}"), found, expected, 1e-5);
            }
        }
    });
}

#[test]
fn no_number_gives_no_acceleration_and_says_so() {
    with_model::<Spline<f32>, SET>(Scale::SI, |model| {
        let period = Period::new(0.001, &model).unwrap();
        let envelope = Envelope::new(POINTS, 6.0, &model).unwrap();
        let limits = Limits::new(envelope, 8.5, 7.5, period, &model).unwrap();
        for omega in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30] {
            let found = limits.feasible(&model, Phase::default(), omega);
            assert!(found.unkept.is_some(), "{omega}: {found:?}");
            assert!(
                found.least.alpha.is_finite() && found.greatest.alpha.is_finite(),
                "{omega}: {found:?}"
            );
        }
        for (speed, acceleration) in [
            (0.0, 1.0),
            (1.0, 0.0),
            (f32::NAN, 1.0),
            (1.0, f32::INFINITY),
        ] {
            assert!(Limits::new(envelope, speed, acceleration, period, &model).is_err());
        }
    });
}

#[test]
fn what_is_lost_is_named() {
    with_model::<Cubic<f64>, SET>(Scale::SI, |model| {
        let period = Period::new(0.05, &model).unwrap();
        let unkept = |peak: f32, speed: f32, most: f32, phase: u32, omega: f64| {
            let envelope = Envelope::new([[9.0, peak]], peak, &model).unwrap();
            let limits = Limits::new(envelope, speed, most, period, &model).unwrap();
            limits
                .feasible(&model, Phase::from_bits(phase), omega)
                .unkept
        };
        // Too fast: the brake reduces it by 5.7 rad/s², 7.5 are permitted, and 20 are needed.
        assert_eq!(unkept(6.0, 5.5, 7.5, 0, 6.5), Some(Limit::Speed));
        assert_eq!(unkept(6.0, 5.5, 75.0, 0, 6.5), Some(Limit::Speed));
        // The load accelerates the machine with 1.5 rad/s² against the brake; 1 is permitted.
        assert_eq!(
            unkept(1.0, 5.5, 1.0, 1 << 30, 0.0),
            Some(Limit::Acceleration)
        );
        assert_eq!(unkept(1.0, 5.5, 2.0, 1 << 30, 0.0), None);
        // Beyond the last point of the torque curve there is no torque: the largest speed is not above it.
        assert_eq!(unkept(6.0, 20.0, 75.0, 0, 8.9), None);
        assert_eq!(unkept(6.0, 20.0, 75.0, 0, 9.5), Some(Limit::Speed));
    });
}
