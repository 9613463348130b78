//! A motion through nodes, and the files that it becomes.

use jred_machine::analysis::duty::Duty;
use jred_machine::model::coordinate::Coordinate;
use jred_machine::read;
use jred_motion::trace::{Node, Trace};

use crate::support::{Folder, edited, press_text};

/// Where the speed is a cubic, the nodes give it back between them.
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

/// A profile that was written is read as the motion that it was made from.
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
    let folder = Folder::new();
    folder.file("profile.csv", trace.profile(3001));
    let text = press_text();
    let begin = text.find("[motion]").unwrap();
    let end = text.find("# Start from rest").unwrap();
    let motion = "[motion]\ntype = \"profile\"\nfile = \"profile.csv\"\ncyclic = false\n";
    let machine = folder.file("press.toml", edited(&text, &text[begin..end], motion));
    let file = read::read(&machine).unwrap();
    let motion = file.required_motion().unwrap();
    for k in 0..=60 {
        let t = f64::from(k) / 60.0;
        let found = motion.at(t);
        assert!((found.phi - law(t)).abs() < 1e-10, "{t}");
        assert!((found.omega - speed(t)).abs() < 1e-7, "{t}");
        assert!((found.alpha - bend(t)).abs() < 1e-3, "{t}");
    }
    assert!(Duty::new(&file, motion, 200).is_ok());
}

/// The master of a cam table turns once; derivatives are by its angle.
#[test]
fn a_cam_table_has_derivatives_by_the_master() {
    let node = |t: f64| Node {
        t,
        step: t,
        phi: t * t,
        omega: 2.0 * t,
        alpha: [2.0; 2],
    };
    let trace = Trace::new(Coordinate::Angle, vec![node(0.0), node(2.0)]);
    let table = trace.cam(3);
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "master [deg],phi [deg],phi' [1],phi'' [1/rad]");
    let numbers: Vec<f64> = lines[2]
        .split(',')
        .map(|cell| cell.parse().unwrap())
        .collect();
    let speed = std::f64::consts::PI;
    let expected = [180.0, 1f64.to_degrees(), 2.0 / speed, 2.0 / (speed * speed)];
    for (found, expected) in numbers.iter().zip(expected) {
        assert!(
            (found - expected).abs() < 1e-13 * expected,
            "{found} {expected}"
        );
    }
}
