//! Nodes of a motion: no step consists of rounding, and limits are satisfied up to the nodes.

use jred_analysis::checked;
use jred_file::model::machine::MachineFile;
use jred_motion::fastest::{Fastest, MoveLimits, Task, ToolSpeed};
use jred_motion::path_dynamics::{Actuator, PathDynamics};
use jred_motion::trace::Trace;
use jred_sizing::cycle::form::Coefficients;

use super::{fastest, motor, task};
use crate::support::press_text;

fn press() -> MachineFile {
    let none = std::collections::BTreeMap::<String, String>::new();
    checked::parse("press.toml", &press_text(), none).unwrap()
}

fn turns() -> Task {
    task(180_f64.to_radians(), 540_f64.to_radians())
}

/// A motor with a torque up to a speed (rpm) and the inertia of its rotor.
fn level(torque: f64, rpm: f64, rotor: f64) -> Actuator {
    Actuator {
        coefficients: Coefficients([rotor, 1.0, 1.0, 0.0, 0.0]),
        ..motor([torque; 2], rpm * std::f64::consts::TAU / 60.0)
    }
}

/// A speed limit of the slide between two positions (deg).
fn slide(file: &MachineFile, speed: f64, between: [f64; 2]) -> ToolSpeed {
    let mechanism = file.machine.mechanism();
    let names = mechanism.link_names();
    let slider = names.iter().position(|name| name == "slider").unwrap();
    let between = between.map(f64::to_radians);
    let limit = ToolSpeed::new(mechanism, slider, [0.0; 2], speed, between);
    limit.unwrap().unwrap()
}

/// The shortest step, as a share of the whole time.
fn shortest(trace: &Trace) -> f64 {
    let steps = trace.nodes().iter().skip(1).map(|node| node.step);
    steps.fold(f64::INFINITY, f64::min) / trace.duration()
}

/// Where the tool's speed limit meets an edge of the load, and where the motor's limit takes over: no step has a time of a few roundings, which would
/// make its acceleration arbitrary.
#[test]
fn no_step_is_only_rounding() {
    let file = press();
    for (speed, rpm) in [(0.06, 90.0), (0.3, 90.0), (0.3, 900.0), (0.1, 300.0)] {
        for between in [[300.0, 360.0], [290.0, 350.0], [315.0, 345.0]] {
            let asked = Task {
                limits: MoveLimits {
                    tool: slide(&file, speed, between).into(),
                    ..MoveLimits::default()
                },
                ..turns()
            };
            let found = fastest(&file, &level(500.0, rpm, 0.0), &asked);
            let step = shortest(&found.trace);
            assert!(step > 1e-13, "{speed} {rpm} {between:?}: {step:e}");
        }
    }
}

/// The largest share by which a motion exceeds the motor's torque, at 24 positions of each step and in its nodes, with its position.
fn exceeded(file: &MachineFile, actuator: &Actuator, found: &Fastest, torque: f64) -> [f64; 2] {
    let dynamics = PathDynamics::new(file, actuator.clone(), 1.0);
    let mut worst = [0.0, 0.0];
    for pair in found.trace.nodes().windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        for k in 0..=24 {
            let state = b.after(a, f64::from(k) / 24.0);
            // On the step's own side of a corner.
            let hair = 1e-9 * (b.phi - a.phi);
            let place = dynamics
                .place(state.phi.clamp(a.phi + hair, b.phi - hair))
                .unwrap();
            let demand = dynamics.demand(&place, state.omega, state.alpha).torque;
            let excess = demand.abs() / torque - 1.0;
            if excess > worst[0] {
                worst = [excess, state.phi.to_degrees()];
            }
        }
    }
    worst
}

/// A motion that leaves a speed limit also satisfies the torque limit there.
#[test]
fn limits_hold_up_to_the_nodes() {
    let file = press();
    for torque in [25.0, 40.0, 120.0] {
        let actuator = level(torque, 900.0, 0.02);
        for endless in [false, true] {
            let asked = Task { endless, ..turns() };
            let found = jred_motion::fastest::solve(&file, &actuator, &asked).unwrap();
            let [excess, phi] = exceeded(&file, &actuator, &found, torque);
            assert!(excess <= 1e-9, "{torque} {endless}: {excess:e} at {phi}");
            assert!(
                excess <= 1.01 * found.excess,
                "{torque} {endless}: {excess:e}"
            );
        }
    }
}
