//! Pauses of a motion that is written as a profile and read again: the machine is at rest in them.
// Zeros are exact.
#![allow(clippy::float_cmp)]

use std::path::Path;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_file::model::machine::MachineFile;
use jred_motion::gentlest::cycle::{GentlestResult, Goal, Request, gentlest_cycle};
use jred_motion::gentlest::without_drive;
use jred_sizing::cycle::Cycle;
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::thermal::classify::Features;

use crate::support::{Folder, near};

/// Motor torque at the input of the drive train only.
const DIRECT: Coefficients = Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]);

/// Largest residuals in a step at rest: speed (per s) and acceleration (per s²) from rounding.
const ROUNDING: f64 = 1e-9;

/// The spindle goes there, pauses, goes back and pauses; the speed (m/s) is `left` in the first pause.
fn paused(left: &str) -> MachineFile {
    let rows = [
        "0,0,0,1.2",
        "0.5,0.15,0.6,1.2",
        "0.5,0.15,0.6,-1.2",
        "1,0.3,LEFT,-1.2",
        "1,0.3,LEFT,0",
        "9,0.3,LEFT,0",
        "9,0.3,LEFT,-1.2",
        "9.5,0.15,-0.6,-1.2",
        "9.5,0.15,-0.6,1.2",
        "10,0,0,1.2",
        "10,0,0,0",
        "18,0,0,0",
    ];
    spindle(&rows.join("\n").replace("LEFT", left))
}

/// A screw and a nut of 100 kg with friction, and the rows of a profile.
fn spindle(rows: &str) -> MachineFile {
    let text = r#"gravity = { inclination = "0 deg" }
[mechanism]
type = "ball-screw"
lead = "10 mm"
stroke = ["0 mm", "400 mm"]
[mechanism.screw]
inertia = "5 kg cm^2"
[mechanism.nut]
mass = "100 kg"
friction = 0.3
[motion]
type = "profile"
file = "hand.csv"
of = { point = "nut", along = "x" }
"#;
    let folder = Folder::new();
    folder.file(
        "hand.csv",
        format!("t [s],s [m],v [m/s],a [m/s^2]\n{rows}\n"),
    );
    checked::read(&folder.file("spindle.toml", text)).unwrap()
}

/// Torques of the spindle for friction and for an acceleration of 1.2 m/s² (N·m).
fn torques() -> [f64; 2] {
    let lead = 0.01 / std::f64::consts::TAU;
    let friction = 0.3 * 100.0 * 9.81 * lead;
    [friction, (5e-4 + 100.0 * lead * lead) * 1.2 / lead]
}

fn duty(file: &MachineFile) -> Duty {
    Duty::new(file, file.required_motion().unwrap(), 2000).unwrap()
}

/// Share of the time at rest.
fn at_rest(duty: &Duty) -> f64 {
    duty.integral(|now| f64::from(now.omega == 0.0)) / duty.duration
}

/// A speed within rounding counts as zero: torque, time at rest and starts are those of a profile with zeros, and of the closed form.
#[test]
fn a_rounding_of_the_speed_is_a_pause() {
    let [friction, inertia] = torques();
    // It accelerates and brakes for 1 s each, half of 2 s.
    let squares = (friction + inertia).powi(2) + (friction - inertia).powi(2);
    let rms = (squares / 18.0).sqrt();
    for left in ["0", "1e-17", "-1e-17", "1e-12"] {
        let duty = duty(&paused(left));
        near(
            "RMS torque",
            duty.figures(|now| now.input_torque).rms,
            rms,
            1e-6,
        );
        near("at rest", at_rest(&duty), 16.0 / 18.0, 1e-9);
        let features = Features::of(&Cycle::new(&duty), &DIRECT, 1.0);
        assert_eq!(features.starts, 2, "{left}");
    }
    let [zero, left] = ["0", "1e-17"].map(|left| duty(&paused(left)));
    let rms = |duty: &Duty| duty.figures(|now| now.input_torque).rms;
    near("RMS torque", rms(&left), rms(&zero), 1e-9);
}

/// A part that is slower than the rest of the motion by a factor below a million is not a pause.
#[test]
fn a_slow_part_is_no_pause() {
    let duty = duty(&paused("1e-5"));
    assert!(at_rest(&duty) < 0.5);
}

/// Corners of a profile, where the acceleration stops rising, are not smoothed: its peak torque is that of the closed form, also with the long steps
/// of two pauses of 8 s.
#[test]
fn the_peak_of_a_corner_is_that_of_its_row() {
    let mut rows = vec![[0.0; 4]];
    for sign in [1.0, -1.0] {
        // Up to 1.2 m/s², slowly down to 1 m/s², and to zero; braking is the reverse.
        for [jerk, duration] in [
            [1.2 / 0.013, 0.013],
            [-0.5, 0.4],
            [-1.0 / 0.017, 0.017],
            [-1.0 / 0.017, 0.017],
            [-0.5, 0.4],
            [1.2 / 0.013, 0.013],
            [0.0, 8.0],
        ] {
            let Some(&[t, s, v, a]) = rows.last() else {
                return;
            };
            let j = sign * jerk;
            let d: f64 = duration;
            rows.push([
                t + d,
                s + d * (v + d * (0.5 * a + d * j / 6.0)),
                v + d * (a + 0.5 * d * j),
                a + d * j,
            ]);
        }
    }
    let row = |row: &[f64; 4]| row.map(|value| value.to_string()).join(",");
    let rows: Vec<String> = rows.iter().map(row).collect();
    let file = spindle(&rows.join("\n"));
    let motion = file.required_motion().unwrap();
    let peak = torques().into_iter().sum::<f64>();
    for steps in [250, 2000, 20_000] {
        let duty = Duty::new(&file, motion, steps).unwrap();
        let found = Cycle::new(&duty).peak_torque(&DIRECT);
        near(&steps.to_string(), found, peak, 1e-9);
        near("at rest", at_rest(&duty), 16.0 / motion.duration(), 1e-9);
    }
}

/// The machine with a profile as its motion; prescribed parts are kept.
fn with_profile(name: &str, made: &GentlestResult, file: &MachineFile) -> MachineFile {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../machines/{name}.toml"));
    let text = std::fs::read_to_string(path).unwrap();
    let mut of_motion = false;
    let mut kept = String::new();
    let mut cyclic = true;
    for line in text.lines() {
        if line.starts_with('[') {
            of_motion = line.starts_with("[motion]") || line.starts_with("[[motion.");
        }
        cyclic &= !(of_motion && line.contains("\"point-to-point\""));
        if !of_motion {
            kept += line;
            kept.push('\n');
        }
    }
    let profile = made.trace.of_axis(&file.axis()).profile();
    let of = text.lines().find(|line| line.starts_with("of ="));
    let of = of.unwrap_or_default();
    let motion =
        format!("[motion]\ntype = \"profile\"\nfile = \"p.csv\"\ncyclic = {cyclic}\n{of}\n");
    kept += &motion;
    let folder = Folder::new();
    folder.file("p.csv", profile);
    checked::read(&folder.file("machine.toml", kept)).unwrap()
}

/// The steps of a written profile without motion, up to rounding.
fn check_pauses(name: &str, profile: &str) {
    let rows: Vec<Vec<&str>> = profile
        .lines()
        .skip(1)
        .map(|row| row.split(',').collect())
        .collect();
    let number = |cell: &str| cell.parse::<f64>().unwrap();
    for pair in rows.windows(2) {
        let [before, after] = [&pair[0], &pair[1]];
        let still = [&before[2..], &after[2..]].concat();
        let still = still.into_iter().all(|cell| number(cell).abs() < ROUNDING);
        if still && number(after[0]) > number(before[0]) + 1e-3 {
            assert_eq!(before[1], after[1], "{name}: {pair:?}");
            assert_eq!([before[2], after[2]], ["0"; 2], "{name}: {pair:?}");
        }
    }
}

/// The gentlest motions of machines with friction, written and read: torque and time at rest are preserved.
#[test]
fn a_written_motion_is_read_with_its_pauses() {
    let machines = [
        ("ball-screw", 0.1),
        ("belt-axis", 0.0),
        ("belt-conveyor", 0.0),
        ("friction-fan", 0.0),
        ("hoist", 0.0),
        ("linkage-four-bar", 0.0),
        ("parallel-shafts", 0.1),
        ("planetary", 0.0),
        ("rack", 0.1),
        ("rotary-table", 0.0),
        ("turntable", 0.0),
        ("vertical-axis", 0.1),
    ];
    for (name, ramp) in machines {
        let path =
            Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../machines/{name}.toml"));
        let file = checked::read(&path).unwrap();
        let request = Request {
            actuator: without_drive(),
            copper: None,
            goal: Goal::Rms,
            ramp,
            sampling: 300.into(),
        };
        let made = gentlest_cycle(&file, file.required_motion().unwrap(), &request)
            .unwrap_or_else(|_| panic!("{name}"));
        check_pauses(name, &made.trace.of_axis(&file.axis()).profile());
        let read = with_profile(name, &made, &file);
        let [own, read] = [&made.motion, read.required_motion().unwrap()]
            .map(|motion| Duty::new(&file, motion, 2000).unwrap());
        let rms = |duty: &Duty| duty.figures(|now| now.input_torque).rms;
        // Their time steps differ.
        near(name, rms(&read), rms(&own), 3e-6);
        near(name, at_rest(&read), at_rest(&own), 1e-6);
    }
}
