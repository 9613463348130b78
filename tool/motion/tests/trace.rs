//! A motion through nodes, and the files written from it.

use std::fmt::Write as _;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_analysis::inspect::Findings;
use jred_file::model::coordinate::Coordinate;
use jred_file::model::machine::MachineFile;
use jred_file::model::motion::Motion;
use jred_motion::fastest::MoveLimits;
use jred_motion::fastest::cycle::cycle;
use jred_motion::gentlest::cycle::{Goal, Request, gentlest_cycle};
use jred_motion::gentlest::without_drive;
use jred_motion::moves::{self, Move, Part};
use jred_motion::path_dynamics::Actuator;
use jred_motion::trace::{Master, Node, Trace};
use jred_sizing::catalogue::Motor;
use jred_sizing::cycle::Cycle;
use jred_sizing::cycle::form::Coefficients;
use jred_sizing::motor::envelope::Envelope;
use jred_sizing::thermal::classify::Features;

use crate::support::{Folder, edited, press_text};

/// The press with a profile as its motion; `more` is added to `[motion]`.
fn press_with(trace: &Trace, more: &str) -> MachineFile {
    let folder = Folder::new();
    folder.file("profile.csv", trace.profile());
    let text = press_text();
    let begin = text.find("[motion]").unwrap();
    let end = text.find("# Start from rest").unwrap();
    let motion = format!("[motion]\ntype = \"profile\"\nfile = \"profile.csv\"\n{more}");
    let machine = folder.file("press.toml", edited(&text, &text[begin..end], &motion));
    checked::read(&machine).unwrap()
}

/// If the speed is a cubic, the nodes reproduce it in between.
#[test]
fn a_cubic_of_the_speed_is_given_back() {
    let phi = |t: f64| 0.3 + t * t - 0.4 * t.powi(3) + 0.1 * t.powi(4);
    let omega = |t: f64| 2.0 * t - 1.2 * t * t + 0.4 * t.powi(3);
    let alpha = |t: f64| 2.0 - 2.4 * t + 1.2 * t * t;
    let node = |(t, step): (f64, f64)| Node {
        t,
        step,
        phi: phi(t),
        omega: omega(t),
        alpha: [alpha(t); 2],
    };
    let nodes = [(0.0, 0.0), (0.5, 0.5), (1.3, 0.8)].map(node);
    let trace = Trace::new(Coordinate::Angle, nodes.to_vec());
    for k in 0..=130 {
        let t = f64::from(k) * 0.01;
        let found = trace.at(t);
        assert!((found.phi - phi(t)).abs() < 1e-14);
        assert!((found.omega - omega(t)).abs() < 1e-14);
        assert!((found.alpha - alpha(t)).abs() < 1e-13);
    }
}

/// A written profile is read as the same motion.
#[test]
fn a_profile_is_read_as_the_same_motion() {
    let law = |z: f64| z * z * z * (10.0 - z * (15.0 - 6.0 * z));
    let speed = |z: f64| 30.0 * z * z * (1.0 - z).powi(2);
    let bend = |z: f64| 60.0 * z * (1.0 - z) * (1.0 - 2.0 * z);
    let nodes = (0..=200).map(|k| {
        let z = f64::from(k) / 200.0;
        Node {
            t: z,
            step: if k == 0 { 0.0 } else { 1.0 / 200.0 },
            phi: law(z),
            omega: speed(z),
            alpha: [bend(z); 2],
        }
    });
    let mut trace = Trace::from_rest(Coordinate::Angle, 0.0);
    trace.then(&nodes.collect::<Vec<_>>());
    trace.dwell(0.5);
    assert!((trace.duration() - 1.5).abs() < 1e-15);
    let file = press_with(&trace, "cyclic = false\n");
    let motion = file.required_motion().unwrap();
    for k in 0..=60 {
        let t = f64::from(k) / 60.0;
        let found = motion.at(t);
        assert!((found.phi - law(t)).abs() < 1e-10, "{t}");
        // The cubic of the speed: h⁴/384 of its fourth derivative, 720.
        assert!((found.omega - speed(t)).abs() < 2e-9, "{t}");
        assert!((found.alpha - bend(t)).abs() < 1e-5, "{t}");
    }
    assert!(Duty::new(&file, motion, 200).is_ok());
}

/// Motor torque at the input of the drive train only.
const DIRECT: Coefficients = Coefficients([0.0, 1.0, 1.0, 0.0, 0.0]);

/// The fastest motions of the press, there, a pause, and back, written and read again: largest and RMS torque of the duty are the motor's limit and
/// the motion's figures, although the acceleration jumps.
#[test]
fn a_profile_keeps_the_corners() {
    let none = std::collections::BTreeMap::<String, String>::new();
    let file = checked::parse("press.toml", &press_text(), none).unwrap();
    let motor = Motor {
        peak_curve: vec![[0.0, 30.0], [150.0, 25.0]],
        ..Motor::default()
    };
    let actuator = Actuator {
        coefficients: DIRECT,
        ratio: 1.0,
        envelope: Envelope::of(&motor),
    };
    let step = |from: f64, to: f64| {
        Part::Move(Move {
            from,
            to,
            duration: 1.0,
        })
    };
    let dwell = Part::Dwell {
        at: 2.0,
        duration: 0.4,
    };
    let parts = [step(1.0, 2.0), dwell, step(2.0, 1.0)];
    let made = cycle(&file, &actuator, MoveLimits::default(), None, &parts).unwrap();
    let file = press_with(&made.trace, "");
    let motion = file.required_motion().unwrap();
    for k in 0..=1000 {
        let t = made.trace.duration() * f64::from(k) / 1000.0;
        let [own, read] = [made.trace.at(t), motion.at(t)];
        assert!((own.phi - read.phi).abs() < 1e-13);
        assert!((own.omega - read.omega).abs() < 1e-12);
    }
    let found = Cycle::new(&Duty::new(&file, motion, 2000).unwrap());
    let peak = found.peak_torque(&DIRECT);
    assert!((peak / 30.0 - 1.0).abs() < 1e-6, "{peak}");
    let rms = found.rms_torque(&DIRECT);
    assert!(
        (rms / made.load.rms - 1.0).abs() < 1e-6,
        "{rms} {}",
        made.load.rms
    );
    // The second move starts from rest; the first one at the reversal of the cycle, without a rest.
    assert_eq!(Features::of(&found, &DIRECT, 1.0).starts, 1);
    let parts = moves::chain(motion, &[]).unwrap().parts;
    let same = matches!(
        parts.as_slice(),
        [Part::Move(_), Part::Dwell { .. }, Part::Move(_)]
    );
    assert!(same, "{parts:?}");
}

/// A curve through rows of a move and a pause oscillates around the rest: that is not a start. Digits are truncated as in a recording.
#[test]
fn a_recorded_pause_is_followed_by_one_start() {
    let law = |z: f64| z * z * z * (10.0 - z * (15.0 - 6.0 * z));
    let mut rows = String::from("t [s],phi [deg]\n");
    for k in 0..=900 {
        let t = f64::from(k) * 1e-3;
        let turns = match t {
            t if t < 0.1 => 0.0,
            t if t < 0.3 => law((t - 0.1) / 0.2),
            t if t < 0.5 => 1.0,
            t if t < 0.8 => 1.0 + law((t - 0.5) / 0.3),
            _ => 2.0,
        };
        writeln!(rows, "{t:.3},{:.4}", 360.0 * turns).unwrap();
    }
    let folder = Folder::new();
    folder.file("profile.csv", rows);
    let text = press_text();
    let begin = text.find("[motion]").unwrap();
    let end = text.find("# Start from rest").unwrap();
    let motion = "[motion]\ntype = \"profile\"\nfile = \"profile.csv\"\n";
    let machine = folder.file("press.toml", edited(&text, &text[begin..end], motion));
    let file = checked::read(&machine).unwrap();
    let duty = Duty::new(&file, file.required_motion().unwrap(), 2000).unwrap();
    let features = Features::of(&Cycle::new(&duty), &DIRECT, 1.0);
    assert_eq!(features.starts, 2);
}

/// Programs read a cam table by its own columns: position differences over master differences are the given derivatives, in any units. For a parabola
/// central differences are exact.
#[test]
fn derivatives_of_a_cam_table_are_by_its_own_columns() {
    for coordinate in [Coordinate::Angle, Coordinate::Length] {
        for master in [Master::Degree, Master::Radian, Master::Turn] {
            let node = |t: f64| Node {
                t,
                step: t,
                phi: 0.3 + 0.5 * t + 0.7 * t * t,
                omega: 0.5 + 1.4 * t,
                alpha: [1.4; 2],
            };
            let trace = Trace::new(coordinate, vec![node(0.0), node(2.5)]);
            let rows = trace.cam(101, master);
            let turn = match master {
                Master::Degree => 360.0,
                Master::Radian => std::f64::consts::TAU,
                Master::Turn => 1.0,
            };
            assert_eq!(rows.len(), 101);
            let (first, last) = (&rows[0], &rows[100]);
            assert!((last[0] - first[0] - turn).abs() < 1e-12 * turn);
            let way = last[1] - first[1];
            for three in rows.windows(3) {
                let [before, here, after] = [&three[0], &three[1], &three[2]];
                let step = here[0] - before[0];
                let slope = (after[1] - before[1]) / (2.0 * step);
                let bend = (after[1] - 2.0 * here[1] + before[1]) / (step * step);
                // Positions have sixteen digits, a difference of two neighbours twelve or eleven.
                assert!(
                    (slope - here[2]).abs() < 1e-11 * way / turn,
                    "{coordinate:?} {master}"
                );
                assert!(
                    (bend - here[3]).abs() < 1e-8 * way / (turn * turn),
                    "{coordinate:?} {master}"
                );
            }
        }
    }
}

/// Difference between the work of a profile's motion and the energy, as in `jred check`.
fn imbalance(file: &MachineFile) -> f64 {
    Findings::of(file).unwrap().agreement.energy.unwrap()
}

/// The fastest and the gentlest motion of the press balance work and energy as well as its own motion does: the jerk jumps at their rows, and the
/// work is integrated from row to row.
#[test]
fn the_check_accepts_the_profiles() {
    let none = std::collections::BTreeMap::<String, String>::new();
    let file = checked::parse("press.toml", &press_text(), none).unwrap();
    let motor = Motor {
        peak_curve: vec![[0.0, 500.0], [10.0, 500.0]],
        ..Motor::default()
    };
    let actuator = Actuator {
        coefficients: DIRECT,
        ratio: 1.0,
        envelope: Envelope::of(&motor),
    };
    let part = Part::Move(Move {
        from: 180f64.to_radians(),
        to: 540f64.to_radians(),
        duration: 1.0,
    });
    let fastest = cycle(&file, &actuator, MoveLimits::default(), None, &[part]).unwrap();
    let found = imbalance(&press_with(&fastest.trace, "cyclic = false\n"));
    assert!(found < 1e-9, "{found:e}");
    // A law whose speed is a polynomial of higher degree than the profile's.
    for machine in ["cam-translating", "linkage-cam-lever", "load-table"] {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
            .join(format!("../../machines/{machine}.toml"));
        let file = checked::read(&path).unwrap();
        let motion = file.required_motion().unwrap();
        let request = Request {
            actuator: without_drive(),
            copper: None,
            goal: Goal::Rms,
            ramp: 0.0,
            sampling: 500.into(),
        };
        let gentle =
            gentlest_cycle(&file, motion, &request).unwrap_or_else(|_| panic!("{machine}"));
        let trace = &gentle.trace;
        let missed = trace
            .nodes()
            .windows(2)
            .map(|pair| pair[1].missed_since(&pair[0])[0].abs());
        let way = trace.nodes().last().unwrap().phi - trace.nodes()[0].phi;
        assert!(missed.sum::<f64>() < 1e-9 * way.abs(), "{machine}");
        let made = MachineFile {
            motion: Some(Motion::nodes(trace.nodes(), false)),
            ..file
        };
        let found = imbalance(&made);
        assert!(found < 1e-9, "{machine}: {found:e}");
    }
}
