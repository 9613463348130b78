//! `PathDynamics` against the duty, which counts in the drive link's own direction.

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_motion::path_dynamics::{Actuator, PathDynamics};
use jred_sizing::catalogue::Catalogue;
use jred_sizing::motor::envelope::Envelope;

use crate::support::budget::SAME_SUMS;
use crate::support::{Folder, edited, edited_press, press_file};

/// The motor torque of every drive at every moving instant of the press's cycle equals the duty's, which goes through the train stage by stage, and
/// the acceleration at this torque is the instant's: with its belt, and with two more stages with losses, one of which reverses the direction.
#[test]
fn demand_is_that_of_the_duty_and_acceleration_its_inverse() {
    behaves_as_the_duty(&checked::read(&press_file()).unwrap());
    let folder = Folder::new();
    let stages = "[[drive_train]]\ntype = \"friction\"\nratio = -0.6\nslip = \"6 %\"\n\
                  input_inertia = \"0.0004 kg m^2\"\noutput_inertia = \"0.002 kg m^2\"\n\n";
    let text = edited_press("[[drive_train]]", &format!("{stages}[[drive_train]]"));
    let text = edited(&text, "[motion]", &format!("{stages}[motion]"));
    let text = edited(&text, "ratio = -0.6", "ratio = 1.2");
    behaves_as_the_duty(&checked::read(&folder.file("train.toml", text)).unwrap());
}

fn behaves_as_the_duty(file: &MachineFile) {
    let duty = Duty::new(file, file.required_motion().unwrap(), 200).unwrap();
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
            let dynamics = PathDynamics::new(file, actuator.clone(), direction);
            let place = dynamics.place(instant.phi).unwrap();
            let speed = instant.omega.abs();
            let acceleration = instant.alpha * direction;
            let demand = dynamics.demand(&place, speed, acceleration);
            let motor = drive.motor_point(instant);
            let expected = motor.torque * motor.speed.signum();
            let size = expected.abs() + demand.per_acceleration * acceleration.abs();
            assert!(
                (demand.torque - expected).abs() <= SAME_SUMS * size,
                "{}: {} N m, the duty {expected}",
                drive.name(),
                demand.torque
            );
            let found = dynamics.acceleration(&place, speed, demand.torque);
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
