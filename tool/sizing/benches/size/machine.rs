//! The machine of the benchmark.

use std::path::Path;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;

use crate::brute;

/// A small dosing press: 30 mm stroke, 60 N over the last part of the way, a turn in two seconds and a rest. Its torque of about
/// 1 N·m and its largest speed of 6 rad/s suit the middle of the catalogue.
const MACHINE: &str = r#"
title = "Dosing press, 30 mm stroke, 60 N"
gravity = ["9.81 m/s^2", "0 m/s^2"]

[mechanism]
type = "slider-crank"
offset = "0 mm"
branch = "right"
flywheel = "0.00002 kg m^2"

[mechanism.crank]
length = "15 mm"
mass = "0.12 kg"
inertia = "0.00002 kg m^2"
com = ["3 mm", "0 mm"]

[mechanism.rod]
length = "80 mm"
mass = "0.09 kg"
inertia = "0.00006 kg m^2"
com = ["25 mm", "0 mm"]

[mechanism.slider]
mass = "0.6 kg"

[[load]]
name = "pressing force"
on = "slider"
force = ["-60 N", "0 N"]
between = ["315 deg", "360 deg"]
ramp = "15 deg"

[[load]]
name = "guide friction"
on = "slider"
opposing_force = "2 N"

[motion]
type = "cycle"
start = "180 deg"

[[motion.segment]]
law = "polynomial-345"
move = "360 deg"
duration = "2 s"

[[motion.segment]]
dwell = "0.5 s"
"#;

/// The machine.
pub(crate) fn machine() -> MachineFile {
    match checked::parse("press.toml", MACHINE, Path::new("")) {
        Ok(file) => file,
        Err(problem) => panic!("the benchmark's own machine: {problem:?}"),
    }
}

/// A cycle of it with at least this number of instants.
pub(crate) fn duty(file: &MachineFile, instants: usize) -> Duty {
    let Some(motion) = &file.motion else {
        panic!("the benchmark's own machine has no motion");
    };
    match Duty::new(file, motion, instants) {
        // For comparison with plain loops.
        Ok(duty) => brute::sampled(duty),
        Err(error) => panic!("the benchmark's own machine: {error}"),
    }
}
