//! Machine files with other values: quantities found and replaced, axes and their grid.

use crate::support::press_text;
use jred_sizing::study::axis::{Grid, Variation};
use jred_sizing::study::edit::{Document, Edit};

fn document() -> Document {
    Document::parse(press_text()).unwrap()
}

/// Quantities are found at their position, and only the named ones change.
#[test]
fn a_changed_file_differs_in_the_named_place_only() {
    let document = document();
    let find = |path: &str| document.find(path).unwrap();
    for (path, from, to) in [
        ("slider.mass", "mass = \"42 kg\"", "mass = \"77.5 kg\""),
        (
            "mechanism.slider.mass",
            "mass = \"42 kg\"",
            "mass = \"77.5 kg\"",
        ),
        (
            "load.guide friction.opposing_force",
            "opposing_force = \"150 N\"",
            "opposing_force = \"77.5 kg\"",
        ),
        (
            "load.2.opposing_force",
            "opposing_force = \"150 N\"",
            "opposing_force = \"77.5 kg\"",
        ),
        (
            "segment.1.duration",
            "duration = \"0.4 s\"",
            "duration = \"77.5 kg\"",
        ),
        (
            "pressing force.between.1",
            "between = [\"315 deg\"",
            "between = [\"77.5 kg\"",
        ),
        (
            "drive_train.1.driver.radius",
            "driver = { radius = \"40 mm\"",
            "driver = { radius = \"77.5 kg\"",
        ),
        (
            "simulation.torque_speed.2.2",
            "[\"500 rpm\", \"45 N m\"]",
            "[\"500 rpm\", \"77.5 kg\"]",
        ),
    ] {
        let edit = Edit {
            quantity: find(path),
            number: 77.5,
            unit: "kg",
        };
        assert_eq!(
            document.with(&[edit]),
            press_text().replacen(from, to, 1),
            "{path}"
        );
    }
    // Two at once, given in the other order.
    let edits =
        [("slider.mass", 50.0, "kg"), ("crank.length", 31.0, "mm")].map(|(path, number, unit)| {
            Edit {
                quantity: find(path),
                number,
                unit,
            }
        });
    let expected = press_text()
        .replacen("length = \"30 mm\"", "length = \"31 mm\"", 1)
        .replacen("mass = \"42 kg\"", "mass = \"50 kg\"", 1);
    assert_eq!(document.with(&edits), expected);
    assert_eq!(document.with(&[]), press_text());
}

/// Texts that are not quantities, names and titles are left alone.
#[test]
fn only_quantities_are_found() {
    let text = press_text().replacen("Servo press, 60 mm stroke, 10 kN", "5 kg", 1);
    let document = Document::parse(text).unwrap();
    let paths: Vec<&str> = document
        .quantities()
        .iter()
        .map(|q| q.path.as_str())
        .collect();
    assert!(!paths.contains(&"title"), "{paths:?}");
    assert!(
        !paths
            .iter()
            .any(|path| path.contains("law") || path.contains("type")),
        "{paths:?}"
    );
    // By hand, from the file: two of gravity, 10 of crank and rod, the slider, flywheel and offset, force (2), between (2),
    // ramp, friction, viscous moment, 7 of the belt, start, 3 of the motion, 4 + 6 + 1 of the simulation.
    assert_eq!(
        paths.len(),
        2 + 10 + 1 + 2 + 2 + 2 + 1 + 1 + 1 + 7 + 1 + 3 + 11,
        "{paths:#?}"
    );
}

#[test]
fn values_of_an_axis() {
    let document = document();
    let values = |text: &str| Variation::parse(&document, text).unwrap().values;
    assert_eq!(values("slider.mass=30..60kg:4"), [30.0, 40.0, 50.0, 60.0]);
    assert_eq!(values("slider.mass=60 kg..30 kg:3"), [60.0, 45.0, 30.0]);
    assert_eq!(values("slider.mass=1..100 kg:3:log"), [1.0, 10.0, 100.0]);
    assert_eq!(values("slider.mass=30,45,60kg"), [30.0, 45.0, 60.0]);
    assert_eq!(values("slider.mass=45000g"), [45000.0]);
    assert_eq!(
        values("com.1=-5..5mm:2".replace("com", "crank.com").as_str()),
        [-5.0, 5.0]
    );
    // A row contains the values written into the file.
    assert_eq!(values("slider.mass=0.1..0.4kg:4"), [0.1, 0.2, 0.3, 0.4]);
    let grid = Grid::new(vec![
        Variation::parse(&document, "slider.mass=1,2kg").unwrap(),
        Variation::parse(&document, "crank.length=10,20,30mm").unwrap(),
    ])
    .unwrap();
    assert_eq!(grid.count(), 6);
    let all: Vec<Vec<f64>> = (0..6).map(|row| grid.values(row)).collect();
    assert_eq!(
        all,
        [
            [1.0, 10.0],
            [1.0, 20.0],
            [1.0, 30.0],
            [2.0, 10.0],
            [2.0, 20.0],
            [2.0, 30.0]
        ]
    );
}
