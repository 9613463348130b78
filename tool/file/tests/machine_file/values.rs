//! The values of the example files.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use crate::reader;
use jred::Domain;
use jred::machine::{Action, Load, Mechanism, Window};
use jred_file::model::characteristic::Characteristic;
use jred_file::model::rule::Rule;
use jred_file::model::rules::RuleSet;
use jred_file::model::simulation::Shaft;

use super::{GEARS, PRESS, close, data, parse, rendered};

/// Beyond this share a rule is violated.
fn limit(rules: &RuleSet, rule: Rule) -> f64 {
    rules.limit(rule).fail.unwrap()
}

#[test]
fn the_press_is_read_in_si_units() {
    let press = reader::read(&data().join("press.toml")).unwrap();
    assert_eq!(press.title, "Servo press, 60 mm stroke, 20 kN");
    let mechanism = press.machine.mechanism();
    assert_eq!(mechanism.kind(), "slider-crank");
    close(mechanism.points()[0].at[0], 0.03);
    close(mechanism.frames(0.0).unwrap()[2].x.value, 0.03 + 0.18);
    let [crank, rod, slider] = mechanism.links() else {
        panic!("three links")
    };
    close(crank.mass(), 9.0);
    close(crank.inertia(), 0.018);
    close(crank.com()[0], 0.006);
    close(rod.mass(), 6.5);
    close(rod.inertia(), 0.03);
    close(rod.com()[0], 0.055);
    close(slider.mass(), 42.0);
    close(press.flywheel, 0.05);
    close(press.machine.flywheel(), 0.05);

    let names: Vec<&str> = press
        .loads
        .iter()
        .map(|named| named.name.as_str())
        .collect();
    assert_eq!(
        names,
        ["pressing force", "guide friction", "crank bearings"]
    );
    assert_eq!(press.machine.loads().len(), 3);
    let window = Window::new(Domain::Turn, [1.75 * PI, TAU], PI / 12.0).unwrap();
    let frames = mechanism.frames(6.0).unwrap();
    let expected = Load::new(2, Action::Force([-20_000.0, 0.0]))
        .unwrap()
        .within(window);
    let (found, expected) = (
        press.loads[0].load.reduce(&frames[2], 6.0),
        expected.reduce(&frames[2], 6.0),
    );
    assert!((found.process / expected.process - 1.0).abs() < 1e-9);
    assert_eq!(
        press.loads[1].load,
        Load::new(2, Action::OpposingForce(150.0)).unwrap()
    );
    assert_eq!(
        press.loads[2].load,
        Load::new(0, Action::ViscousMoment(0.4)).unwrap()
    );

    close(press.drive_train.ratio(), 3.0);
    close(press.drive_train.efficiency(), 0.97);
    close(
        press.drive_train.inertia_at_input(),
        0.0006 + 0.6 * 0.04 * 0.04 + 0.03 / 9.0,
    );

    let motion = press.motion.unwrap();
    assert!(motion.cyclic);
    close(motion.duration(), 1.0);
    close(motion.at(0.0).phi, PI);
    close(motion.at(1.0).phi, 3.0 * PI);

    let simulation = press.simulation.unwrap();
    close(simulation.start_angle, PI);
    close(simulation.duration, 1.5);
    close(simulation.output_step, 0.005);
    let Some(Characteristic::Points(points)) = &simulation.torque else {
        panic!("{:?}", simulation.torque);
    };
    assert_eq!(points.len(), 3);
    close(points[1].0, 50.0 * PI);
    close(points[1].1, 10.0);
    assert_eq!(simulation.at, Shaft::Motor);
    close(simulation.rotor_inertia, 0.0012);
    close(simulation.tolerance, 1e-12);
    close(limit(&press.rules, Rule::RmsTorque), 0.8);
}

#[test]
fn a_gear_train_with_every_optional_key_is_read() {
    let file = parse(GEARS).unwrap();
    let train = file.machine.mechanism();
    assert_eq!(train.kind(), "gear-train");
    let output = train.frames(0.0).unwrap().last().unwrap().psi.d1;
    close(1.0 / output, -3.0 * 4.0);
    close(file.drive_train.ratio(), -2.0);
    close(file.drive_train.efficiency(), 0.98);
    assert_eq!(file.loads[0].name, "opposing moment on shaft-3");
    let motion = file.motion.unwrap();
    assert!(!motion.cyclic);
    close(motion.at(0.6).phi, PI);
    let simulation = file.simulation.unwrap();
    assert_eq!(simulation.torque, Some(Characteristic::constant(2.5)));
    assert_eq!(simulation.at, Shaft::DriveLink);
    close(limit(&file.rules, Rule::RmsTorque), 0.7);
    close(limit(&file.rules, Rule::PeakTorque), 0.75);
    close(limit(&file.rules, Rule::InertiaRatio), 8.0);
}

#[test]
fn a_belt_and_a_constant_speed_are_read() {
    let text = "gravity = [\"0 m/s^2\", \"0 m/s^2\"]\n[mechanism]\ntype = \"belt\"\n\
                driver = { radius = \"2 cm\", inertia = \"1 kg cm^2\" }\n\
                driven = { radius = \"5 cm\", inertia = \"6 kg cm^2\" }\n\
                [motion]\ntype = \"constant-speed\"\nspeed = \"-60 rpm\"\n";
    let file = parse(text).unwrap();
    assert_eq!(file.title, "machine.toml");
    assert!(file.drive_train.stages().is_empty());
    let motion = file.motion.unwrap();
    close(motion.duration(), 1.0);
    close(motion.at(0.25).phi, -TAU / 4.0);
}

#[test]
fn every_line_of_the_press_is_optional_or_missed_by_name() {
    let optional = [
        "title",
        "offset",
        "branch",
        "flywheel",
        "com",
        "name",
        "between",
        "ramp",
        "belt_mass",
        "efficiency",
        "start",
        "start_speed",
        "torque_speed",
        "at",
        "rotor_inertia",
    ];
    for (number, line) in PRESS.lines().enumerate() {
        let Some((key, _)) = line.split_once(" = ").filter(|_| !line.starts_with('#')) else {
            continue;
        };
        let others = PRESS.lines().enumerate().filter(|(k, _)| *k != number);
        let text = others.map(|(_, line)| line).collect::<Vec<_>>().join("\n");
        match parse(&text) {
            Ok(_) => assert!(optional.contains(&key), "line {}: {line}", number + 1),
            Err(report) => {
                let report = rendered(&report);
                let pair = ["between", "ramp"].contains(&key);
                assert!(
                    pair || !optional.contains(&key),
                    "line {}: {report}",
                    number + 1
                );
                let named = report.contains(&format!("`{key}`")) && report.contains("missing");
                // Some keys leave nothing behind that could be named: the other alternative is named, too.
                let key = if key.starts_with("opposing")
                    || key.starts_with("viscous")
                    || key == "force"
                    || key == "dwell"
                {
                    report.contains(key)
                } else {
                    named
                };
                assert!(key, "line {}: {line}\n{report}", number + 1);
            }
        }
    }
}

#[test]
fn every_machine_of_the_collection_is_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            if let Err(report) = reader::read(&path) {
                panic!("{}", rendered(&report));
            }
            count += 1;
        }
    }
    assert!(count > 0);
}
