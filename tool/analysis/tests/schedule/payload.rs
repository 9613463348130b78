//! `[[payload]]`: torque, joints and energy of what is carried for a while.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use crate::reader;
use jred::machine::Mechanism;
use jred_file::model::machine::MachineFile;
use jred_file::model::schedule::ScheduleInstant;

use super::{G, PINION, RACK, RADIUS, WAY, duty, machine, work};
use crate::reading::oblique_slider_crank;
use crate::support::{Folder, near, within};

fn payload(keys: &str) -> String {
    format!("[[payload]]\non = \"rack\"\nmass = \"7 kg\"\n{keys}\n")
}

/// Lifted and left above: the torque is that of the heavier rack while it is carried, and the work of a cycle is m·g·h.
#[test]
fn what_is_lifted_costs_its_weight() {
    let file = machine("9.81", &payload("segments = [1, 2]"));
    let duty = duty(&file);
    for i in &duty.instants {
        let mass = if i.t < 1.5 { RACK + 7.0 } else { RACK };
        let inertia = PINION + mass * RADIUS * RADIUS;
        let expected = inertia * i.alpha + mass * G * RADIUS;
        assert!((i.input_torque - expected).abs() < 1e-10, "{i:?}");
        near("inertia", i.inertia, inertia, 1e-12);
    }
    near("work", work(&duty), 7.0 * G * WAY * RADIUS, 1e-9);
    near(
        "holding",
        duty.hold_torque,
        (RACK + 7.0) * G * RADIUS,
        1e-12,
    );
    // Without the motion it is not there.
    near(
        "bare",
        file.bare_reduction(0.0).unwrap().inertia,
        PINION + RACK * RADIUS * RADIUS,
        1e-12,
    );
}

/// Over the end of the cycle, carried down: the machine gets the work back.
#[test]
fn a_payload_may_be_carried_over_the_end_of_the_cycle() {
    let down = duty(&machine("9.81", &payload("segments = [3, 4]")));
    near("down", work(&down), -7.0 * G * WAY * RADIUS, 1e-9);
    let over = duty(&machine("9.81", &payload("segments = [4, 1]")));
    near("up", work(&over), 7.0 * G * WAY * RADIUS, 1e-9);
    let always = duty(&machine("9.81", &payload("segments = [1, 2, 3, 4]")));
    // The instants at the ends of a stretch lie a billionth of it inside.
    let lifted = (RACK + 7.0) * G * WAY * RADIUS;
    within("to and fro", work(&always), 0.0, 1e-9 * lifted);
}

/// Picked up at the speed of its place, it brings its kinetic energy: the drive accelerates it from that speed on.
#[test]
fn at_speed_it_brings_its_energy() {
    let keys = "during = [\"0.5 s\", \"1.2 s\"]\nwhile_moving = true";
    let duty = duty(&machine("0", &payload(keys)));
    let speed = 1.875 * WAY * RADIUS;
    near("work", work(&duty), -0.5 * 7.0 * speed * speed, 1e-8);
}

/// On a link that turns, at a point beside its centre of mass: every joint force is that of the same mass in a table of loads, which two
/// rotors and a force stand for.
#[test]
fn on_a_rod_it_is_the_payload_of_a_table() {
    let text = |more: &str| {
        let motion = "[motion]\ntype = \"cycle\"\n\
                      [[motion.segment]]\nlaw = \"polynomial-345\"\nmove = \"360 deg\"\nduration = \"1 s\"\n\
                      [[motion.segment]]\ndwell = \"0.2 s\"\n";
        oblique_slider_crank("4 kg", &format!("{more}\n{motion}"))
    };
    let folder = Folder::new();
    let mut csv = String::from("Position [deg],Payload [kg]\n");
    for k in 0..=12 {
        writeln!(csv, "{},2.5", 30 * k).unwrap();
    }
    folder.file("payload.csv", csv);
    let parse = |more: &str| -> MachineFile {
        reader::parse("machine.toml", &text(more), folder.path("").as_path()).unwrap()
    };
    let place = "on = \"rod\"\nat = [\"200 mm\", \"40 mm\"]";
    let table = parse(&format!("[[load]]\ntable = \"payload.csv\"\n{place}"));
    let carried = parse(&format!(
        "[[payload]]\nmass = \"2.5 kg\"\n{place}\nsegments = [1]"
    ));
    let turning = parse(&format!(
        "[[payload]]\nmass = \"2.5 kg\"\ninertia = \"0.03 kg m^2\"\n{place}\nsegments = [1]"
    ));
    let bare = parse("");
    let now = ScheduleInstant::of(0.5, 9.0);
    let mut turned = 0.0f64;
    for k in 0..200 {
        let phi = TAU * (f64::from(k) * 0.618_033_988_749_895).fract();
        let forces = |file: &MachineFile| {
            let machine = file.machine_at(&now, phi).unwrap();
            machine.forces(phi, 9.0, -20.0).unwrap()
        };
        let (a, b) = (forces(&table), forces(&carried));
        near("drive", a.drive, b.drive, 1e-9);
        for k in 0..carried.machine.mechanism().own_joints() {
            for axis in 0..2 {
                let [a, b] = [&a, &b].map(|forces| forces.reactions[k].force[axis]);
                assert!((a - b).abs() < 1e-9, "{phi}: {a} {b}");
            }
        }
        let after = carried
            .machine_at(&ScheduleInstant::of(1.1, 0.0), phi)
            .unwrap();
        near(
            "set down",
            after.forces(phi, 9.0, -20.0).unwrap().drive,
            forces(&bare).drive,
            1e-12,
        );
        // Its own inertia adds J·ψ̈·ψ′.
        let psi = carried.machine.mechanism().frames(phi).unwrap()[1].psi;
        let expected = 0.03 * psi.acceleration(9.0, -20.0) * psi.d1;
        assert!((forces(&turning).drive - b.drive - expected).abs() < 1e-9);
        turned = turned.max(expected.abs());
    }
    assert!(turned > 0.05);
}
