use jred::axis::{FrictionRamp, Gearbox, TorqueLimits, Transmission};
use jred::{Acceleration, Domain, MotorTorque, Q15, Q31, Scale, Speed, Spline, Torque};

use super::machine::{in_units, si};
use crate::support::{assert_near, quantity, samples, scale_of, value};

#[test]
fn a_gearbox_loses_on_the_side_that_is_driven() {
    let gearbox = Gearbox {
        ratio: 8.0,
        efficiency: 0.9,
        rotor: 0.002,
    };
    let scale = scale_of(150.0, 10.0, 1.5);
    let units = in_units::<Spline<Q31>>(Domain::Turn, scale);
    let single =
        Transmission::new(gearbox, &in_units::<Spline<f64>>(Domain::Turn, Scale::SI)).unwrap();
    let fixed = Transmission::new(gearbox, &units).unwrap();
    assert_near("base", fixed.base().into(), 150.0 / (8.0 * 0.9), 1e-5);
    for (torque, omega, alpha) in samples(300, 0xff03, &(-140.0..140.0, -9.0..9.0, -60.0..60.0)) {
        // Power through the gearbox: output is input less the losses, for either driving side.
        let [motor, load]: [f64; 2] = [8.0 * omega, omega];
        let through = single.motor(torque, omega, alpha).value - 8.0 * 0.002 * alpha;
        let (at_motor, at_load): (f64, f64) = (through * motor, torque * load);
        let (given, got) = if at_load > 0.0 {
            (at_motor, at_load)
        } else {
            (-at_load, -at_motor)
        };
        assert_near("power", got, 0.9 * given, 1e-4);
        let (w, a) = si::<Q31>(&scale, [omega, alpha]);
        let pu = scale.to_torque(torque as f32).value;
        let expected = single.motor(torque, omega, alpha).value;
        let found = fixed.motor(pu, w, a);
        assert!(!found.saturated);
        let back = fixed.to_torque(fixed.torque_si(found.value));
        assert_near(
            "there and back",
            value(back.value),
            value(found.value),
            1e-7,
        );
        assert_near(
            "q31",
            value(found.value) * f64::from(fixed.base()),
            expected,
            1e-4,
        );
    }
    // At rest the motor counts as driving, for either sign of the torque.
    for torque in [50.0, -50.0] {
        assert_near(
            "at rest",
            single.motor(torque, 0.0, 0.0).value,
            torque / (8.0 * 0.9),
            1e-5,
        );
    }
    // The gearbox alone, the rotor alone, and their sum exceed the range.
    let light = Transmission::new(
        Gearbox {
            rotor: 0.0,
            ..gearbox
        },
        &units,
    )
    .unwrap();
    let (torque, omega, alpha) = (quantity(0.6), quantity(0.6), quantity(0.6));
    assert!(!light.motor(torque, omega, alpha).saturated);
    let heavy = Transmission::new(
        Gearbox {
            rotor: 10.0,
            ..gearbox
        },
        &units,
    )
    .unwrap();
    assert!(heavy.motor(Torque::default(), omega, alpha).saturated);
    let full = fixed.motor(
        Torque::<Q31>::MAX,
        Speed::<Q31>::MAX,
        Acceleration::<Q31>::MAX,
    );
    assert!(full.saturated && full.value == MotorTorque::<Q31>::MAX);
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
    let half = quantity(0.5);
    let most = MotorTorque::<Q15>::MAX;
    let limits = TorqueLimits::new(MotorTorque::<Q15>::MIN, half).unwrap();
    assert_eq!(limits.limited(most).torque, half);
    assert_near("clipped", value(limits.limited(most).clipped), 0.5, 1e-4);
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
    let units = in_units::<Spline<f32>>(Domain::Turn, Scale::SI);
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
        assert!(Transmission::new(wrong, &units).is_err(), "{wrong:?}");
    }
    for width in [0.0, -1.0, f32::NAN, 1e-7] {
        assert!(FrictionRamp::new(width, &units).is_err(), "{width}");
    }
}
