//! Minimum time against closed forms, quadratures and a dynamic programme.

mod closed_form;
mod costs;
mod endless;
mod jerk;
mod joint_force;
mod lengths;
mod nodes;
mod programme;
mod refusals;
mod rms;
mod ruled;
mod scales;
mod tool_speed;
mod torque_rate;
mod varying;
mod winding;

use std::collections::BTreeMap;

use jred_analysis::checked;
use jred_file::model::machine::MachineFile;
use jred_motion::fastest::{Fastest, MoveLimits, Task, solve};
use jred_motion::path_dynamics::Actuator;
use jred_sizing::catalogue::Motor;
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::motor::envelope::Envelope;

/// A table with this inertia (kg·m²) and loads.
fn table(inertia: f64, loads: &str) -> MachineFile {
    machine(&format!(
        "title = \"table\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"rotary-table\"\n[mechanism.table]\nmass = \"1 kg\"\ninertia = \"{inertia} kg m^2\"\n{loads}"
    ))
}

fn machine(text: &str) -> MachineFile {
    checked::parse("test.toml", text, BTreeMap::<String, String>::new()).unwrap()
}

/// A motor without rotor, friction and gearbox, whose torque falls linearly from rest to its largest speed.
pub(crate) fn motor(torques: [f64; 2], speed: f64) -> Actuator {
    let motor = Motor {
        peak_curve: vec![[0.0, torques[0]], [speed, torques[1]]],
        ..Motor::default()
    };
    Actuator {
        coefficients: Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]),
        ratio: 1.0,
        envelope: Envelope::of(&motor),
    }
}

/// Limited jerk, without acceleration at the ends.
fn jerk_limits(jerk: f64) -> MoveLimits {
    MoveLimits {
        jerk: Some(jerk),
        level_ends: true,
        ..MoveLimits::default()
    }
}

/// The same with a limited rate of the motor torque.
fn torque_rate_limits(rate: f64) -> MoveLimits {
    MoveLimits {
        torque_rate: Some(rate),
        level_ends: true,
        ..MoveLimits::default()
    }
}

fn task(from: f64, to: f64) -> Task {
    Task {
        from,
        to,
        speeds: [0.0; 2],
        limits: MoveLimits::default(),
        endless: false,
    }
}

fn fastest(file: &MachineFile, motor: &Actuator, task: &Task) -> Fastest {
    let found = solve(file, motor, task).unwrap_or_else(|why| panic!("{why}"));
    // Finer cells reach 1e-9. Rounding of the speeds in a short step adds a little; where curves of a joint force meet, some times as much.
    let most = if task.limits.forces.is_some() {
        1e-8
    } else {
        5e-9
    };
    assert!(found.excess <= most, "exceeded by {:e}", found.excess);
    let nodes = found.trace.nodes();
    let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
    assert!((first.phi - task.from).abs() <= 1e-15 * task.from.abs());
    assert!((last.phi - task.to).abs() <= 1e-15 * task.to.abs());
    let way = (task.to - task.from).signum();
    for (node, speed) in [first, last].iter().zip(task.speeds) {
        assert!((node.omega * way - speed).abs() <= 1e-9 * speed, "{node:?}");
    }
    assert!((found.trace.duration() - found.time).abs() <= 1e-12 * found.time);
    found
}

fn close(found: f64, expected: f64, share: f64) {
    let error = (found - expected).abs() / expected.abs();
    assert!(error <= share, "{found}, not {expected}: {error:e}");
}
