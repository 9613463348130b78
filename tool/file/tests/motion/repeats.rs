//! Cycles that go on by any angle, where the machine comes round.

use std::fmt::Write as _;

use crate::reading::{read, refuses, text_of};

use super::{belt_motion, motion, within};

/// A dial with `count` equal arms whose loads act in one arm's place: its curves repeat after 360°/count.
fn dial(loads: &[(f64, f64)], step: f64) -> String {
    let mut text = String::from(
        "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"belt\"\n\
         driver = { radius = \"4 cm\", inertia = \"1 kg cm^2\" }\n\
         driven = { radius = \"4 cm\", inertia = \"6 kg cm^2\" }\n",
    );
    for (from, to) in loads {
        write!(
            text,
            "[[load]]\non = \"shaft-2\"\nopposing_moment = \"3 N m\"\nbetween = [\"{from} deg\", \"{to} deg\"]\nramp = \"1 deg\"\n"
        )
        .unwrap();
    }
    text + &format!(
        "[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"modified-sine\"\nmove = \"{step} deg\"\nduration = \"0.3 s\"\n\
         [[motion.segment]]\ndwell = \"0.2 s\"\n"
    )
}

#[test]
fn a_machine_that_is_the_same_everywhere_goes_on_by_any_step() {
    for step in ["60 deg", "0.1 deg", "-7777.7 deg"] {
        let law = format!("law = \"cycloidal\"; move = \"{step}\"; duration = \"1 s\"");
        assert!(motion("cycle", &[&law]).cyclic);
    }
    // A recording, too: a third of a turn.
    let folder = tempfile::tempdir().unwrap();
    let mut csv = String::from("t [s],phi [deg]\n");
    for k in 0..=10 {
        writeln!(csv, "{},{}", f64::from(k) / 10.0, 12 * k).unwrap();
    }
    std::fs::write(folder.path().join("feed.csv"), csv).unwrap();
    let text = belt_motion("profile", &[]) + "file = \"feed.csv\"\n";
    let motion = crate::reading::parse_in(&text, folder.path())
        .unwrap()
        .motion
        .unwrap();
    assert!(motion.cyclic);
    within(
        "advance",
        motion.at(1.0).phi,
        2.0 * std::f64::consts::PI / 3.0,
        1e-12,
    );
}

#[test]
fn the_step_of_a_dial_is_that_of_its_curves() {
    let thirds = [(10.0, 40.0), (130.0, 160.0), (250.0, 280.0)];
    for step in [120.0, -120.0, 240.0, 360.0] {
        read(&dial(&thirds, step));
    }
    refuses(
        &dial(&thirds, 60.0),
        &[
            "add up to 60 deg",
            "the machine is not the same there: the friction torque is",
            "a cycle later",
            "by the load \"opposing moment on shaft-2\"",
            "write the segments 6 times, for the whole turn",
            "a load with `between` acts in its part of each turn",
        ],
    );
    // A load as narrow as a third of the grid, once.
    refuses(
        &dial(&[(10.1, 12.1)], 120.0),
        &[
            "the friction torque is",
            "3 N m",
            "write the segments 3 times",
        ],
    );
    // No part of a turn: back to where it began would be a move of nothing.
    refuses(
        &dial(&thirds, 70.0),
        &["add a move of 290 deg to reach 360 deg"],
    );
    // A Geneva wheel repeats after a slot, but its crank needs a turn for it.
    let geneva = text_of("geneva.toml");
    let head = geneva.split("[motion]").next().unwrap();
    refuses(
        &format!(
            "{head}\n[motion]\ntype = \"cycle\"\n[[motion.segment]]\nlaw = \"cycloidal\"\nmove = \"90 deg\"\nduration = \"1 s\"\n"
        ),
        &["add up to 90 deg", "the machine is not the same there"],
    );
}
