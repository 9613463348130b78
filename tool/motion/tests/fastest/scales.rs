//! The same motion in other units, mirrored and reversed.

use super::{close, fastest, machine, motor, table, task};
use crate::support::{edited, press_text};

/// Masses, lengths and times in other units: the time of the move has the same numerical value.
#[test]
fn the_result_does_not_depend_on_units() {
    let viscous =
        |b: f64| format!("[[load]]\non = \"table\"\nviscous_moment = \"{b} N m s/rad\"\n");
    let reference = fastest(
        &table(2.0, &viscous(0.3)),
        &motor([10.0, 4.0], 5.0),
        &task(0.0, 3.0),
    );
    for mass in [1e-3, 1.0, 1e4] {
        for angle in [1e-6, 1.0, 1e3] {
            for time in [1e-3, 1.0, 1e2] {
                let torque = mass * angle / (time * time);
                let file = table(2.0 * mass, &viscous(0.3 * mass / time));
                let found = fastest(
                    &file,
                    &motor([10.0 * torque, 4.0 * torque], 5.0 * angle / time),
                    &task(0.0, 3.0 * angle),
                );
                close(found.time / time, reference.time, 1e-11);
                assert_eq!(found.phases.len(), reference.phases.len());
            }
        }
    }
}

/// Without friction and losses, and with equal torque for braking and driving, the way back is the same motion in reverse.
#[test]
fn the_way_back_takes_as_long_without_losses() {
    let file = lossless_press();
    for (from, to) in [(0.0, 3.0), (1.0, 9.0), (-2.0, 0.1)] {
        let motor = motor([60.0; 2], 12.0);
        let there = fastest(&file, &motor, &task(from, to));
        let back = fastest(&file, &motor, &task(to, from));
        close(back.time, there.time, 1e-9);
        assert_eq!(there.phases.len(), back.phases.len());
    }
}

/// The crank of the press, without gravity, loads and drive train.
pub(super) fn lossless_press() -> jred_file::model::machine::MachineFile {
    let text = press_text();
    let begin = text.find("[mechanism]").unwrap();
    let end = text.find("[[load]]").unwrap();
    machine(&format!(
        "title = \"crank\"\ngravity = [\"0 m/s^2\", \"0 m/s^2\"]\n{}",
        &text[begin..end]
    ))
}

/// The press is symmetrical about the axis of its guide, except for the pressing force: both directions from bottom dead centre take equal time, with
/// friction, weight, losses and a falling motor torque.
#[test]
fn both_ways_round_take_as_long() {
    let text = press_text();
    let begin = text.find("# Pressing force").unwrap();
    let end = text.find("[[load]]\nname = \"guide friction\"").unwrap();
    let file = machine(&edited(&text, &text[begin..end], ""));
    for (from, to) in [(0.3, 2.9), (2.9, 0.3), (0.0, 6.5)] {
        let motor = motor([60.0, 20.0], 40.0);
        let one = fastest(&file, &motor, &task(from, to));
        let other = fastest(&file, &motor, &task(-from, -to));
        close(other.time, one.time, 1e-11);
    }
}
