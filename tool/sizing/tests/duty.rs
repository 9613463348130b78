//! Drives and the torque-speed limits of motors over a cycle.
// Zeros and copied figures are exact.
#![allow(clippy::float_cmp)]

mod drives;
mod limits;

use std::path::Path;

use crate::support::machines::CONSTANT_SPEED;
use crate::support::near;
use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_file::units::RPM;
use jred_sizing::catalogue::Catalogue;
use jred_sizing::cycle::Cycle;

fn read(text: &str) -> MachineFile {
    checked::parse("machine.toml", text, Path::new("")).unwrap()
}

fn duty_of(file: &MachineFile, steps: usize) -> Duty {
    Duty::new(file, file.motion.as_ref().unwrap(), steps).unwrap()
}

fn catalogue() -> Catalogue {
    Catalogue::load(None, None).unwrap()
}

/// At constant speed a motor supplies only friction, and regenerates nothing.
#[test]
fn constant_speed_supplies_only_friction() {
    let duty = duty_of(&read(CONSTANT_SPEED), 50);
    let speed = -300.0 * RPM;
    let expected = -6.0 / 3.0 + 0.05 * speed;
    let motor = limits::motor();
    let geared = Cycle::new(&duty).motor_duty(&drives::drive(&motor, None));
    near("RMS", geared.torque.rms, expected.abs(), 1e-13);
    assert_eq!(geared.regenerative_energy, 0.0);
    near(
        "energy",
        geared.motoring_energy,
        expected * speed * 0.2,
        1e-13,
    );
}
