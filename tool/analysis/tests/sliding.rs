//! A boom lifted by a cylinder, whose drive link slides; and change points of a linkage.

use std::f64::consts::PI;

use jred_analysis::duty::Duty;
use jred_analysis::inspect::Findings;
use jred_analysis::reduce::{Over, Request, Sets, reduce};
use jred_analysis::simulate::{SimulationError, simulate};

use crate::reading::{machine, parse_in, read};
use crate::support::machines::{LIFT, LIFT_MOTION};
use crate::support::{Folder, budget, close};

/// θ′, and cos θ, of the lift at s.
fn boom(s: f64) -> [f64; 2] {
    let cos = (0.25 + 0.36 - s * s) / 0.6;
    let sin = (1.0 - cos * cos).sqrt();
    [s / (0.3 * sin), cos]
}

#[test]
fn the_duty_of_a_sliding_drive() {
    let file = read(&format!("{LIFT}{LIFT_MOTION}"));
    let duty = Duty::new(&file, file.motion.as_ref().unwrap(), 400).unwrap();
    // Up and down without friction: no energy is left over.
    close(duty.integral(|i| i.terms.total() * i.omega), 0.0, 1e-6);
    let hold = 100.0 * 9.81 * 0.8 * boom(0.4)[0] * boom(0.4)[1];
    close(duty.hold_torque, hold, 1e-9 * hold);
}

#[test]
fn a_recorded_motion_of_a_sliding_drive_is_reduced_in_millimetres() {
    let folder = Folder::new();
    folder.file(
        "way.csv",
        "t [s],s [mm]\n0,450\n1,460\n2,480\n3,510\n4,550\n",
    );
    let text =
        format!("{LIFT}\n[motion]\ntype = \"profile\"\nfile = \"way.csv\"\ncyclic = false\n");
    let file = parse_in(&text, &folder.path("")).unwrap();
    let request = Request {
        over: Over::Time,
        positions: 8,
        sets: Sets::default(),
        state: None,
    };
    let columns = reduce(&file, &request).unwrap();
    assert!(columns.names().iter().any(|name| name.ends_with("[mm]")));
}

#[test]
fn free_motions_of_a_sliding_drive() {
    // Pushed from below and let go by gravity: the energy stays.
    let free = format!(
        "{LIFT}\n[simulation]\nstart_position = \"500 mm\"\nstart_speed = \"0.3 m/s\"\nduration = \"0.05 s\"\n\
         output_step = \"5 ms\"\nforce = \"0 N\"\ntolerance = 1e-12\n"
    );
    let file = read(&free);
    let columns = simulate(&file, file.simulation.as_ref().unwrap())
        .unwrap()
        .whole()
        .unwrap();
    assert_eq!(columns.names()[1], "s [mm]");
    assert_eq!(columns.names()[4], "motor force [N]");
    let total: Vec<f64> = columns
        .rows()
        .iter()
        .map(|row| row[6].unwrap() + row[7].unwrap())
        .collect();
    for energy in &total {
        close(*energy, total[0], budget::CONSERVED * total[0].abs());
    }
    // A force that the weight cannot hold runs against the end of the stroke.
    let against = free
        .replace("force = \"0 N\"", "force = \"20 kN\"")
        .replace("0.05 s", "2 s");
    let file = read(&against);
    let error = simulate(&file, file.simulation.as_ref().unwrap())
        .unwrap()
        .whole()
        .unwrap_err();
    let SimulationError::EndOfStroke { t, end, axis, .. } = error else {
        panic!("{error:?}");
    };
    assert_eq!(axis.place(end), "s = 800 mm");
    assert!((0.10..0.11).contains(&t), "{t}");
}

#[test]
fn change_points_are_noted() {
    let file = machine("elliptic-drive.toml");
    let findings = Findings::of(&file).unwrap();
    assert!(findings.holds(), "{:?}", findings.violations());
    let [first, second] = findings.change_points.as_slice() else {
        panic!("{:?}", findings.change_points);
    };
    assert!(first.at.abs() < 1e-9 && (second.at - PI).abs() < 1e-9);
}
