//! The way against the duty, which counts in the drive link's own direction.

use jred_machine::analysis::duty::Duty;
use jred_machine::read;
use jred_motion::way::{Actuator, Way};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::motor::envelope::Envelope;

use crate::support::budget::SAME_SUMS;
use crate::support::press_file;

/// The motor torque of every drive at every instant of the press's cycle in which it moves is the duty's, and the acceleration that
/// this torque gives is the instant's.
#[test]
fn demand_is_that_of_the_duty_and_acceleration_its_inverse() {
    let file = read::read(&press_file()).unwrap();
    let duty = Duty::new(&file, file.required_motion().unwrap(), 200).unwrap();
    let catalogue = Catalogue::built_in().unwrap();
    let mut checked = 0;
    for (_, drive) in catalogue.drives().step_by(37) {
        let envelope = Envelope::at(drive.motor, drive.amplifier, &file.site);
        let actuator = Actuator::new(&drive, envelope);
        for instant in &duty.instants {
            if instant.omega == 0.0 {
                continue;
            }
            let direction = instant.omega.signum();
            let way = Way::new(&file, actuator.clone(), direction);
            let place = way.place(instant.phi).unwrap();
            let speed = instant.omega.abs();
            let acceleration = instant.alpha * direction;
            let demand = way.demand(&place, speed, acceleration);
            let motor = drive.motor_point(instant);
            let expected = motor.torque * motor.speed.signum();
            let size = expected.abs() + demand.per_acceleration * acceleration.abs();
            assert!(
                (demand.torque - expected).abs() <= SAME_SUMS * size,
                "{}: {} N m, the duty {expected}",
                drive.name(),
                demand.torque
            );
            let found = way.acceleration(&place, speed, demand.torque);
            let size = acceleration.abs() + demand.torque.abs() / demand.per_acceleration;
            assert!(
                (found - acceleration).abs() <= SAME_SUMS * size,
                "{}: {found}, not {acceleration}",
                drive.name()
            );
            checked += 1;
        }
    }
    assert!(checked > 1000, "{checked}");
}
