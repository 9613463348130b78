//! Quadrants: the current depends on driving or braking, not on the direction; and constant torque.

use jred_file::model::site::Site;
use jred_file::units::RPM;
use jred_sizing::catalogue::Motor;
use jred_sizing::motor::envelope::{Envelope, Limit, LimitPiece, MotorLimits};

use super::{bare, near, servo};
use crate::support::budget;

/// Reversed together with its torque it draws the same current; in field weakening less against its speed than along it.
#[test]
fn the_current_does_not_depend_on_the_direction() {
    let mut motor = servo();
    motor.max_speed = Some(9000.0 * RPM);
    let prepared = MotorLimits::new(&motor, None, &Site::default());
    let fastest = prepared.envelope.max_speed();
    let mut weakened = 0;
    for share in [0.1, 0.5, 0.9, 0.98] {
        let speed = share * fastest;
        for part in [0.05, 0.3, 0.9] {
            let torque = part * prepared.envelope.peak_torque(1.0, speed);
            let current = |torque: f64, speed: f64| prepared.current(torque, speed).unwrap();
            let (drives, brakes) = (current(torque, speed), current(-torque, speed));
            near(current(-torque, -speed), drives, budget::CLOSED_FORM);
            near(current(torque, -speed), brakes, budget::CLOSED_FORM);
            let along = torque / 0.85;
            assert!(brakes >= along * (1.0 - 1e-9) && drives >= along * (1.0 - 1e-9));
            // The voltage drop in the resistance leaves more voltage when braking.
            assert!(brakes <= drives * (1.0 + 1e-9), "{brakes} {drives}");
            weakened += u32::from(brakes < 0.999 * drives);
        }
    }
    assert!(weakened >= 2, "{weakened}");
}

/// A level is that torque at every speed, also an infinite one; a line falls to zero, not below.
#[test]
fn levels_and_lines() {
    let level = Limit::level(5.0, f64::INFINITY);
    for speed in [0.0, 1.0, 1e300, f64::INFINITY] {
        assert_eq!(level.torque(speed), 5.0);
    }
    let cut = level.pieces()[0].cut(3.0, f64::INFINITY);
    assert_eq!(cut.torque(f64::INFINITY), 5.0);
    let line = LimitPiece::line([10.0, 6.0], [40.0, 0.0]);
    for (speed, torque) in [(10.0, 6.0), (25.0, 3.0), (40.0, 0.0)] {
        near(line.torque(speed), torque, budget::CLOSED_FORM);
        near(
            line.cut(20.0, 40.0).torque(speed.max(20.0)),
            line.torque(speed.max(20.0)),
            budget::CLOSED_FORM,
        );
    }
    // From rest to speed zero: a step, not a slope.
    assert_eq!(
        LimitPiece::line([0.0, 5.0], [f64::INFINITY, 5.0]).torque(1e9),
        5.0
    );
    let lower = level.min(&Limit::new([LimitPiece::level(0.0, 10.0, 7.0), line]));
    for (speed, torque) in [
        (0.0, 5.0),
        (12.0, 5.0),
        (15.0, 5.0),
        (25.0, 3.0),
        (40.0, 0.0),
        (41.0, 0.0),
    ] {
        near(lower.torque(speed), torque, budget::CLOSED_FORM);
    }
    assert_eq!(lower.end(), 40.0);
}

/// The S1 torque at rest and at any speed without a rated speed; with one, linear between both and constant power beyond.
#[test]
fn the_continuous_torque_with_and_without_a_rated_speed() {
    let motor = |rated_speed| Motor {
        rated_torque: Some(8.0),
        standstill_torque: Some(9.0),
        peak_torque: Some(30.0),
        max_speed: Some(500.0),
        rated_speed,
        ..bare()
    };
    let unknown = Envelope::of(&motor(None));
    for (speed, torque) in [(0.0, 9.0), (100.0, 8.0), (400.0, 8.0)] {
        near(
            unknown.continuous_torque(speed),
            torque,
            budget::CLOSED_FORM,
        );
    }
    let known = Envelope::of(&motor(Some(200.0)));
    for (speed, torque) in [
        (0.0, 9.0),
        (100.0, 8.5),
        (200.0, 8.0),
        (400.0, 4.0),
        (501.0, 0.0),
    ] {
        near(known.continuous_torque(speed), torque, budget::CLOSED_FORM);
        near(known.continuous_torque(-speed), torque, budget::CLOSED_FORM);
    }
}
