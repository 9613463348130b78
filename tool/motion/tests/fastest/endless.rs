//! Endless motions.

use std::f64::consts::TAU;
use std::path::Path;

use jred::Domain;
use jred_analysis::checked;
use jred_motion::fastest::joint_force::reached;
use jred_motion::fastest::{Binding, JointForces, MoveLimits, NoMotion, Task, solve};
use jred_motion::path_dynamics::PathDynamics;
use jred_motion::plan::{Plan, SHARE};
use jred_motion::trace::Node;

use super::{close, fastest, machine, motor, table, task};

fn turn(from: f64) -> Task {
    Task {
        endless: true,
        ..task(from, from + TAU)
    }
}

/// With constant inertia: the largest speed that friction permits, P − S·v/V = C + b·v.
#[test]
fn a_constant_inertia_turns_evenly() {
    let found = solve(&table(2.0, ""), &motor([10.0; 2], 7.0), &turn(0.3)).unwrap();
    close(found.time, TAU / 7.0, 1e-9);
    let limits: Vec<Binding> = found.phases.iter().map(|phase| phase.limit).collect();
    assert_eq!(limits, [Binding::MotorSpeed]);
    let file = table(
        0.5,
        "[[load]]\non = \"table\"\nopposing_moment = \"2 N m\"\n\
         [[load]]\non = \"table\"\nviscous_moment = \"0.3 N m s/rad\"\n",
    );
    let found = solve(&file, &motor([10.0, 1.0], 20.0), &turn(0.0)).unwrap();
    close(found.time, TAU / (8.0 / (9.0 / 20.0 + 0.3)), 1e-8);
}

const CRANK: &str = "title = \"crank\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\n\
    [mechanism.crank]\nlength = \"50 mm\"\nmass = \"1 kg\"\ninertia = \"0.002 kg m^2\"\ncom = [\"0 mm\", \"0 mm\"]\n\
    [mechanism.rod]\nlength = \"200 mm\"\nmass = \"0.1 kg\"\ninertia = \"0.0005 kg m^2\"\ncom = [\"100 mm\", \"0 mm\"]\n\
    [mechanism.slider]\nmass = \"2 kg\"\n";

/// It ends with its initial speed, wherever the turn is cut; it keeps its limits, and no start is faster.
#[test]
fn a_crank_comes_round_with_its_speed() {
    let file = machine(CRANK);
    let motor = motor([3.0; 2], 60.0);
    let times: Vec<f64> = [0.0, 0.7, 2.0, 4.5]
        .into_iter()
        .map(|from| {
            let found = solve(&file, &motor, &turn(from)).unwrap();
            assert!(found.excess <= 1e-9, "{:e}", found.excess);
            let nodes = found.trace.nodes();
            let [first, last] = [nodes[0], nodes[nodes.len() - 1]];
            close(last.omega, first.omega, 1e-8);
            let faster = Task {
                speeds: [first.omega * 1.0001; 2],
                ..task(from, from + TAU)
            };
            let at_top = first.omega > 60.0 * (1.0 - 1e-9);
            assert!(at_top || solve(&file, &motor, &faster).is_err());
            let dynamics = PathDynamics::new(&file, motor.clone(), 1.0);
            let place = dynamics.place(first.phi).unwrap();
            assert!(place.inertia > 0.0);
            found.time
        })
        .collect();
    for time in &times {
        close(*time, times[0], 1e-7);
    }
    // Always below the largest speed, faster than a turn from rest to rest.
    assert!(times[0] > TAU / 60.0 * 1.001, "{times:?}");
    assert!(times[0] < fastest(&file, &motor, &task(0.0, TAU)).time);
}

/// Without an effective speed limit, a torque limit alone lets a frictionless machine reach the motor's speed.
#[test]
fn limits_of_the_drive_link_hold() {
    let limits = MoveLimits {
        speed: Some(5.0),
        ..MoveLimits::default()
    };
    let asked = Task {
        limits,
        ..turn(1.0)
    };
    let found = solve(&table(2.0, ""), &motor([10.0; 2], 7.0), &asked).unwrap();
    close(found.time, TAU / 5.0, 1e-9);
}

/// For any inertia, and any number of turns to reach the periodic speed: M = b·ω.
#[test]
fn a_heavy_table_turns_as_a_light_one() {
    for inertia in [1.0, 60.0, 600.0] {
        let file = table(
            inertia,
            "[[load]]\non = \"table\"\nviscous_moment = \"0.1 N m s/rad\"\n",
        );
        let found = solve(&file, &motor([1.0; 2], 100.0), &turn(0.0)).unwrap();
        // A turn changes the speed by a ten-thousandth of its deviation.
        close(found.time, TAU / 10.0, 1e-5);
    }
}

/// Example machines: steps so short that rounding dominates their acceleration do not count as excess.
#[test]
fn machines_go_on_for_ever() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    for (name, torque) in [
        ("eccentric-press", 13.2),
        ("eccentric-press", 60.0),
        ("cam-translating", 60.0),
        ("flying-shear", 60.0),
        ("geneva", 60.0),
        ("scotch-yoke", 60.0),
        ("shaking-feeder", 60.0),
    ] {
        let text = std::fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap();
        let file = checked::parse(name, &text, folder.as_path()).unwrap();
        let found = solve(&file, &motor([torque; 2], 157.0), &turn(0.5)).unwrap();
        assert!(found.excess <= 1e-6, "{name}: {:e}", found.excess);
        let nodes = found.trace.nodes();
        close(nodes[nodes.len() - 1].omega, nodes[0].omega, 1e-6);
    }
}

/// Symmetric about its dead centres: the load that drives it from one brakes it to the other.
const SYMMETRIC: &str = "title = \"symmetric\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"slider-crank\"\n\
    [mechanism.crank]\nlength = \"30 mm\"\nmass = \"9 kg\"\ninertia = \"0.018 kg m^2\"\ncom = [\"0 mm\", \"0 mm\"]\n\
    [mechanism.rod]\nlength = \"180 mm\"\nmass = \"0.5 kg\"\ninertia = \"0.003 kg m^2\"\ncom = [\"55 mm\", \"0 mm\"]\n\
    [mechanism.slider]\nmass = \"20 kg\"\n";

/// If driving meets braking in a dead centre, the turn ends with the speed that driving reaches there, without a remaining fragment of driving. The
/// plan has no row for a fragment.
#[test]
fn a_turn_begins_where_driving_meets_braking() {
    let file = machine(SYMMETRIC);
    let motor = motor([10.0; 2], 314.159);
    let guide = JointForces::default().with(3, 50.0);
    let limits = MoveLimits {
        forces: guide,
        ..MoveLimits::default()
    };
    let endless = Task {
        limits,
        ..turn(0.0)
    };
    let found = solve(&file, &motor, &endless).unwrap();
    let reaches = Task {
        limits,
        speeds: [40.0, 100.0],
        ..task(0.5 * TAU, TAU)
    };
    let Err(NoMotion::EndTooFast { most, .. }) = solve(&file, &motor, &reaches) else {
        panic!("100 rad/s cannot be reached");
    };
    let nodes = found.trace.nodes();
    let [first, last] = [nodes[0], nodes[nodes.len() - 1]];
    close(first.omega, most, 1e-8);
    close(last.omega, most, 1e-8);
    let jump = |node: &Node| (node.alpha[1] - node.alpha[0]).abs() > 1.0;
    let shreds = nodes.windows(2).filter(|pair| {
        let step = pair[1].step;
        jump(&pair[0]) && jump(&pair[1]) && step > 1e-9 * found.time && step < 1e-5
    });
    assert_eq!(shreds.count(), 0);
    let plan = Plan::new(&found.trace, Domain::Turn, 0, SHARE).unwrap();
    assert_eq!(plan.excess, None);
    assert!(plan.rows < 50, "{}", plan.rows);
    let largest = nodes.iter().map(|node| node.alpha[0].abs());
    let largest = largest.fold(0.0, f64::max);
    close(f64::from(plan.most[1]), largest, 2.0 * SHARE);
}

/// A steep machine, whose acceleration between two nodes varies more than by rounding of their speeds: finer cells keep its torque.
#[test]
fn a_steep_turn_is_accurate() {
    let file = machine(SYMMETRIC);
    let found = solve(&file, &motor([10.0; 2], 314.159), &turn(0.0)).unwrap();
    assert!(found.excess <= 1e-9, "{:e}", found.excess);
    // It has 3000 rpm in the dead centres, where its inertia is smallest. Without a drive it would keep its energy from there; 10 N m make it
    // slightly faster.
    let dynamics = PathDynamics::new(&file, motor([10.0; 2], 314.159), 1.0);
    let least = dynamics.place(0.0).unwrap().inertia;
    let parts = 3600;
    let free: f64 = (0..parts)
        .map(|k| {
            let phi = TAU * (f64::from(k) + 0.5) / f64::from(parts);
            let inertia = dynamics.place(phi).unwrap().inertia;
            TAU / f64::from(parts) / (314.159 * (least / inertia).sqrt())
        })
        .sum();
    close(found.time, free, 0.02);
    assert!(found.time < free, "{} {free}", found.time);
}

/// Near the inner dead centre the force of the crank pin hardly depends on the acceleration, and its speed limit changes within a degree.
#[test]
fn a_pin_at_its_dead_centre() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines/shaking-feeder.toml");
    let file = checked::read(&path).unwrap();
    let names = file.machine.mechanism().joint_names();
    let pin = names.iter().position(|name| name == "crank pin").unwrap();
    let mut before = f64::INFINITY;
    for force in [3900.0, 4000.0, 4100.0] {
        let asked = Task {
            limits: MoveLimits {
                forces: JointForces::default().with(pin, force),
                ..MoveLimits::default()
            },
            ..turn(0.0)
        };
        let found = solve(&file, &motor([50.0; 2], 314.159), &asked).unwrap();
        assert!(found.time < before, "{} s after {before} s", found.time);
        before = found.time;
        let [most] = reached(&file, &asked.limits.forces, &found.trace).unwrap()[..] else {
            panic!("one joint is limited");
        };
        close(most.force, force, 1e-6);
    }
}
