//! Limits of the force in a joint.

use jred_analysis::reduce::joints_with_force;
use jred_file::model::machine::MachineFile;
use jred_motion::fastest::joint_force::reached;
use jred_motion::fastest::{Binding, Fastest, JointForces, MoveLimits, NoMotion, Task, solve};
use jred_motion::trace::Trace;

use super::{close, fastest, machine, motor, task};

/// ϖ: a quarter turn with an unbalanced mass takes ϖ/√k, half of it for each end.
const LEMNISCATE: f64 = 2.622_057_554_292_119;

/// A crank with 2 kg at 0.3 m from its axis, which moves a massless yoke; no weight.
fn unbalanced() -> MachineFile {
    machine(
        "title = \"crank\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"scotch-yoke\"\n\
         crank = { length = \"300 mm\", mass = \"2 kg\", inertia = \"0.1 kg m^2\", com = [\"300 mm\", \"0 mm\"] }\nyoke = { mass = \"0 kg\" }\n",
    )
}

/// A Scotch yoke of 50 mm without weight and friction, whose pin moves only the yoke.
fn yoke(more: &str) -> MachineFile {
    machine(&format!(
        "title = \"yoke\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"scotch-yoke\"\n\
         crank = {{ length = \"50 mm\", mass = \"1 kg\", inertia = \"0.01 kg m^2\" }}\nyoke = {{ mass = \"8 kg\" }}\n{more}"
    ))
}

fn press() -> MachineFile {
    machine(
        "title = \"press\"\ngravity = [\"9.81 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\nflywheel = \"0.3 kg m^2\"\n\
         crank = { length = \"90 mm\", mass = \"10 kg\", inertia = \"0.1 kg m^2\" }\n\
         rod = { length = \"400 mm\", mass = \"12 kg\", inertia = \"0.2 kg m^2\", com = [\"150 mm\", \"0 mm\"] }\n\
         slider = { mass = \"40 kg\" }\n\
         [[load]]\nname = \"work\"\non = \"slider\"\nforce = [\"600 N\", \"0 N\"]\nbetween = [\"300 deg\", \"340 deg\"]\nramp = \"0.01 deg\"\n\
         [[load]]\nname = \"guide\"\non = \"slider\"\nopposing_force = \"60 N\"\n\
         [[load]]\nname = \"oil\"\non = \"slider\"\nviscous_force = \"90 N s/m\"\n",
    )
}

fn joint(file: &MachineFile, name: &str) -> usize {
    let all = joints_with_force(file.machine.mechanism()).unwrap();
    let found = all.iter().find(|(_, own)| *own == name);
    found.unwrap_or_else(|| panic!("{name}: {all:?}")).0
}

fn within(file: &MachineFile, limits: &[(&str, f64)], asked: &Task) -> Task {
    let forces = limits
        .iter()
        .fold(JointForces::default(), |all, (name, force)| {
            all.with(joint(file, name), *force)
        });
    Task {
        limits: MoveLimits {
            forces,
            ..asked.limits
        },
        ..*asked
    }
}

/// The largest force of a joint in a motion, by the machine's own kinetostatics, at many instants of each step.
fn largest(file: &MachineFile, found: &Fastest, name: &str) -> f64 {
    let joint = joint(file, name);
    let mut most = 0.0f64;
    for pair in found.trace.nodes().windows(2) {
        // At the nodes themselves reversing friction may have either sign.
        for share in [0.03, 0.1, 0.35, 0.6, 0.9, 0.97] {
            let state = pair[1].after(&pair[0], share);
            if (pair[1].phi - pair[0].phi).abs() < 1e-9 {
                continue;
            }
            let forces = file
                .machine
                .forces(state.phi, state.omega, state.alpha)
                .unwrap();
            let [x, y] = forces.reactions[joint].force;
            most = most.max(x.hypot(y));
        }
    }
    most
}

fn limits(found: &Fastest) -> Vec<Binding> {
    found.phases.iter().map(|phase| phase.limit).collect()
}

/// m·e·|ω² + i·α| ≤ F permits with k = F/(m·e): ω² = k·sin 2φ up to ω² = k after an eighth of a turn, then constant.
#[test]
fn an_unbalanced_mass() {
    let file = unbalanced();
    let name = "crank pivot";
    let k = 60.0;
    let force = 2.0 * 0.3 * k;
    for dynamics in [2.0, 9.0] {
        let asked = within(&file, &[(name, force)], &task(0.4, 0.4 + dynamics));
        let found = fastest(&file, &motor([1e4; 2], 1e3), &asked);
        let root = k.sqrt();
        close(
            found.time,
            LEMNISCATE / root + (dynamics - std::f64::consts::FRAC_PI_2) / root,
            1e-6,
        );
        assert_eq!(limits(&found), [Binding::JointForce(0)]);
        close(largest(&file, &found, name), force, 1e-6);
    }
}

/// The yoke's acceleration is at most F/m: over the distance r to the dead centre and back it takes 4·√(r/a), for any crank.
#[test]
fn a_yoke_through_its_dead_centre() {
    let file = yoke("");
    let force = 100.0;
    let quarter = std::f64::consts::FRAC_PI_2;
    for [from, to] in [[1.0, 3.0], [3.0, 1.0], [1.0, 5.0]] {
        let asked = within(
            &file,
            &[("pin in the slot", force)],
            &task(from * quarter, to * quarter),
        );
        let found = fastest(&file, &motor([20.0; 2], 1e3), &asked);
        let strokes = 0.5 * (to - from).abs();
        // Each stroke of r and back; between two of them the yoke passes its middle at full speed.
        let acceleration = force / 8.0;
        let time = if strokes > 1.0 {
            // From rest at the middle to the dead centre, over the whole stroke, and back to the middle.
            2.0 * 2.0 * (0.05f64 / acceleration).sqrt() + 2.0 * (0.1f64 / acceleration).sqrt()
        } else {
            4.0 * (0.05f64 / acceleration).sqrt()
        };
        close(found.time, time, 1e-6);
        assert!(largest(&file, &found, "pin in the slot") <= force * (1.0 + 1e-6));
    }
}

/// With weight, friction and a load that rises within a hundredth of a degree.
fn keeps_the_forces_of_its_joints(dynamics: [f64; 2]) {
    let file = press();
    let drive = motor([260.0; 2], 30.0);
    let [from, to] = dynamics.map(f64::to_radians);
    let free = solve(&file, &drive, &task(from, to)).unwrap();
    // The load rises within steps of 1e-7 s, where rounding of the speeds is this share of the torque.
    assert!(free.excess <= 1e-8, "{:e}", free.excess);
    let mut before = f64::INFINITY;
    for force in [1500.0, 3000.0, 1e5] {
        let pins = [("crank pin", force), ("slider pin", 0.9 * force)];
        let asked = within(&file, &pins, &task(from, to));
        let found = fastest(&file, &drive, &asked);
        for (name, limit) in pins {
            let most = largest(&file, &found, name);
            assert!(
                most <= limit * (1.0 + 1e-6),
                "{name}: {most} N of {limit} N"
            );
        }
        assert!(
            found.time <= before * (1.0 + 1e-9),
            "{} after {before}",
            found.time
        );
        before = found.time;
    }
    close(before, free.time, 1e-9);
}

#[test]
fn a_press_keeps_the_forces_of_its_joints() {
    keeps_the_forces_of_its_joints([180.0, 540.0]);
}

#[test]
fn a_press_that_turns_back_keeps_the_forces_of_its_joints() {
    keeps_the_forces_of_its_joints([500.0, 270.0]);
}

/// Weight and work alone exceed the limit; the message gives position and amount.
#[test]
fn a_force_that_needs_no_motion() {
    let file = press();
    let drive = motor([260.0; 2], 30.0);
    let asked = within(&file, &[("slider pin", 500.0)], &task(3.0, 9.0));
    let Err(why) = solve(&file, &drive, &asked) else {
        panic!("found");
    };
    let NoMotion::JointForce {
        joint,
        phi,
        forces: [force, limit],
        ..
    } = &why
    else {
        panic!("{why}");
    };
    assert_eq!((joint.as_str(), *limit), ("slider pin", 500.0));
    let degrees = phi.to_degrees();
    assert!((300.0..340.0).contains(&degrees), "{degrees}");
    assert!((900.0..1100.0).contains(force), "{force}");
    let says = why.to_string();
    assert!(
        says.contains("slider pin") && says.contains("500 N"),
        "{says}"
    );
    assert!(why.cure().contains("--max-reaction"), "{}", why.cure());
}

#[test]
fn neither_jerk_nor_torque_rate_beside_it() {
    let file = press();
    let asked = within(&file, &[("slider pin", 5000.0)], &task(3.0, 4.0));
    let limits = MoveLimits {
        jerk: Some(1e4),
        ..asked.limits
    };
    let why = solve(&file, &motor([260.0; 2], 30.0), &Task { limits, ..asked });
    assert_eq!(why.map(|found| found.time), Err(NoMotion::JointForceAlone));
}

/// A yoke of 8 kg that goes down: its guide carries 30 N of the weight in motion, and none of it in a pause.
#[test]
fn the_largest_force_is_told_and_pauses_are_looked_at() {
    let text = "title = \"yoke\"\ngravity = [\"9.81 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"scotch-yoke\"\n\
         crank = { length = \"50 mm\", mass = \"1 kg\", inertia = \"0.01 kg m^2\" }\nyoke = { mass = \"8 kg\" }\n\
         [[load]]\non = \"yoke\"\nopposing_force = \"30 N\"\n";
    let file = machine(text);
    let weight = 8.0 * 9.81;
    let name = "pin in the slot";
    for limit in [60.0, 100.0] {
        let down = task(200.0_f64.to_radians(), 340.0_f64.to_radians());
        let asked = within(&file, &[(name, limit)], &down);
        let found = fastest(&file, &motor([200.0; 2], 300.0), &asked);
        let told = |trace: &Trace| {
            let all = reached(&file, &asked.limits.forces, trace).unwrap();
            assert_eq!(all.len(), 1);
            all[0]
        };
        let mut trace = found.trace.clone();
        let moving = told(&trace);
        assert_eq!(moving.name(&file), name);
        close(moving.force, limit, 1e-6);
        close(moving.force, largest(&file, &found, name), 1e-3);
        assert!(!moving.stands && moving.kept_at_rest(&file).is_ok());
        trace.dwell(0.5);
        let standing = told(&trace);
        if limit > weight {
            assert_eq!(standing, moving);
            continue;
        }
        close(standing.force, weight, 1e-9);
        assert!(standing.stands && standing.t >= found.time);
        let refused = standing.kept_at_rest(&file);
        assert!(
            matches!(refused, Err(NoMotion::JointForce { stands: true, .. })),
            "{refused:?}"
        );
    }
}
