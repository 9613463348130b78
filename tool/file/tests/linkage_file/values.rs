//! Values of linkages against golden data and closed forms.

use std::f64::consts::TAU;

use jred::Domain;
use jred::machine::{Jointed as _, Link, Machine, MassProperties, Mechanism as _, Reducible as _};
use jred::mechanism::{Branch, SixLink, SixLinkDimensions, SliderCrank, SliderCrankDimensions};
use serde_json::Value;

use super::{FOUR_BAR, close, read};
use crate::reading::machine;
use crate::support::budget;

/// A table of the golden four-bar: its columns and its rows.
fn golden(table: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = include_str!("../../../../tests/data/02_four_bar_A.json");
    let case: Value = serde_json::from_str(text).unwrap();
    let table = &case["expected"]["tables"][table];
    let columns = table["columns"].as_array().unwrap().iter();
    let columns = columns.map(|c| c.as_str().unwrap().to_owned()).collect();
    let row = |row: &Value| {
        let values = row.as_array().unwrap().iter();
        values.map(|v| v.as_f64().unwrap()).collect()
    };
    let rows = table["rows"].as_array().unwrap().iter().map(row).collect();
    (columns, rows)
}

/// The largest magnitude of a column, by which its errors are measured.
fn largest(rows: &[Vec<f64>], column: usize) -> f64 {
    rows.iter().map(|row| row[column].abs()).fold(0.0, f64::max)
}

#[test]
fn the_four_bar_of_the_golden_data() {
    let file = read(FOUR_BAR);
    let (columns, rows) = golden("position");
    for row in &rows {
        let frames = file.machine.mechanism().frames(row[0]).unwrap();
        let reduced = file.machine.reduction(row[0]).unwrap();
        let [j, dj, d2j] = reduced.inertias();
        let found = [
            frames[1].psi.value,
            frames[1].psi.d1,
            frames[1].psi.d2,
            frames[2].psi.value,
            frames[2].psi.d1,
            frames[2].psi.d2,
            j,
            dj,
            d2j,
            reduced.load_torque(),
        ];
        for (k, found) in found.into_iter().enumerate() {
            let scale = largest(&rows, k + 1);
            assert!(
                (found - row[k + 1]).abs() <= budget::LINKAGE * scale,
                "{} at φ = {}: {found} is not {}",
                columns[k + 1],
                row[0],
                row[k + 1]
            );
        }
    }
    assert!(rows.len() > 30);

    let (columns, rows) = golden("motion");
    let column = |name: &str| columns.iter().position(|c| c == name).unwrap();
    let [phi, omega, alpha, torque] = ["phi", "omega", "alpha", "T_drive"].map(column);
    for row in &rows {
        let forces = file
            .machine
            .forces(row[phi], row[omega], row[alpha])
            .unwrap();
        let mut pairs = vec![(torque, forces.drive)];
        for (joint, name) in ["F_0_1", "F_1_2", "F_2_3", "F_0_3"].iter().enumerate() {
            let [x, y] = forces.reactions[joint].force;
            pairs.push((column(&format!("{name}x")), x));
            pairs.push((column(&format!("{name}y")), y));
        }
        for (k, found) in pairs {
            close(found, row[k], budget::LINKAGE * largest(&rows, k));
        }
    }
}

#[test]
fn names_and_points() {
    let file = read(FOUR_BAR);
    let mechanism = file.machine.mechanism();
    assert_eq!(mechanism.kind(), "linkage");
    assert_eq!(mechanism.link_names(), ["crank", "coupler", "rocker"]);
    assert_eq!(
        mechanism.joint_names(),
        [
            "crank bearing",
            "crank pin",
            "coupler pin",
            "rocker bearing"
        ]
    );
    let points: Vec<&str> = mechanism.points().iter().map(|p| p.name.as_str()).collect();
    assert_eq!(points, ["crank.A", "coupler.B", "rocker.B"]);
    assert_eq!(mechanism.ground_points()[1], ("C".to_owned(), [0.3, 0.0]));
    assert_eq!(mechanism.drive(), 0);
    assert_eq!(mechanism.domain(), Domain::Turn);
}

/// A crank with a rod and a slider on a guide that rises by 30°, not through the crank's bearing.
const INCLINED: &str = r#"gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "linkage"
drive = "bearing"
ground = { G = ["-12.5 mm", "21.650635094610966 mm"] }
body = [
  { name = "crank", mass = "2 kg", inertia = "30 kg cm^2", com = ["20 mm", "4 mm"], angle = "30 deg", points = { A = ["50 mm", "0 mm"] } },
  { name = "rod", mass = "3 kg", inertia = "0.02 kg m^2", com = ["80 mm", "0 mm"], angle = "40 deg", points = { B = ["200 mm", "0 mm"] } },
  { name = "slider", mass = "8 kg" },
]
joint = [
  { name = "bearing", between = ["ground", "crank"] },
  { name = "crank pin", between = ["crank.A", "rod"] },
  { name = "slider pin", between = ["rod.B", "slider"] },
  { name = "guide", type = "prismatic", between = ["ground.G", "slider"], direction = "30 deg" },
]
"#;

#[test]
fn a_slider_crank_on_an_inclined_guide() {
    let file = read(INCLINED);
    let link = |m, j, com| {
        Link::new(MassProperties {
            mass: m,
            inertia: j,
            com,
        })
        .unwrap()
    };
    let links = [
        link(2.0, 0.003, [0.02, 0.004]),
        link(3.0, 0.02, [0.08, 0.0]),
        link(8.0, 0.0, [0.0, 0.0]),
    ];
    // Turned back by 30°, gravity turns with it.
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let upright = SliderCrank::new(
        SliderCrankDimensions {
            crank: 0.05,
            rod: 0.2,
            offset: 0.025,
        },
        Branch::Right,
        links,
    )
    .unwrap();
    let upright = Machine::new(upright)
        .with_gravity([-9.81 * sin, -9.81 * cos])
        .unwrap();
    for k in 0..50 {
        let phi = TAU * f64::from(k) / 50.0;
        let found = file.machine.reduction(phi).unwrap();
        let expected = upright.reduction(phi - 30f64.to_radians()).unwrap();
        for order in 0..3 {
            close(found.inertias()[order], expected.inertias()[order], 1e-12);
        }
        close(found.load_torque(), expected.load_torque(), 1e-11);
    }
}

/// The six-link mechanism of equations (81), as bodies and joints.
const SIX_LINK: &str = r#"gravity = ["0 m/s^2", "-9.81 m/s^2"]
[mechanism]
type = "linkage"
drive = "crank bearing"
ground = { O2 = ["-200 mm", "0 mm"], G = ["0 mm", "350 mm"] }
body = [
  { name = "crank", mass = "4 kg", inertia = "0.02 kg m^2", angle = "90 deg", points = { A = ["100 mm", "0 mm"] } },
  { name = "block", mass = "0.6 kg", inertia = "3 kg cm^2", angle = "25 deg" },
  { name = "rocker", mass = "6 kg", inertia = "0.1 kg m^2", com = ["210 mm", "0 mm"], angle = "25 deg", points = { B = ["450 mm", "0 mm"] } },
  { name = "rod", mass = "3 kg", inertia = "0.12 kg m^2", com = ["350 mm", "0 mm"], angle = "15 deg", points = { C = ["700 mm", "0 mm"] } },
  { name = "slider", mass = "30 kg" },
]
joint = [
  { name = "crank bearing", between = ["ground", "crank"] },
  { name = "crank pin", between = ["crank.A", "block"] },
  { name = "slot", type = "prismatic", between = ["rocker", "block"], direction = "0 deg" },
  { name = "rocker bearing", between = ["ground.O2", "rocker"] },
  { name = "rocker pin", between = ["rocker.B", "rod"] },
  { name = "slider pin", between = ["rod.C", "slider"] },
  { name = "guide", type = "prismatic", between = ["ground.G", "slider"], direction = "0 deg" },
]
"#;

fn six_link() -> Machine<SixLink> {
    let link = |m, j, u| {
        Link::new(MassProperties {
            mass: m,
            inertia: j,
            com: [u, 0.0],
        })
        .unwrap()
    };
    let links = [
        link(4.0, 0.02, 0.0),
        link(0.6, 0.0003, 0.0),
        link(6.0, 0.1, 0.21),
        link(3.0, 0.12, 0.35),
        link(30.0, 0.0, 0.0),
    ];
    let mechanism = SixLink::new(
        SixLinkDimensions {
            crank: 0.1,
            rocker: 0.45,
            rod: 0.7,
            centres: 0.2,
            below: -0.35,
        },
        Branch::Right,
        links,
    )
    .unwrap();
    Machine::new(mechanism).with_gravity([0.0, -9.81]).unwrap()
}

#[test]
fn the_six_links_of_equations_81() {
    let file = read(SIX_LINK);
    // A pin in the slot instead of the block: the block's mass goes to the crank pin, its inertia to the rocker.
    let slot = SIX_LINK
        .replace("  { name = \"block\", mass = \"0.6 kg\", inertia = \"3 kg cm^2\", angle = \"25 deg\" },\n", "")
        .replace("  { name = \"crank pin\", between = [\"crank.A\", \"block\"] },\n", "")
        .replace(
            "type = \"prismatic\", between = [\"rocker\", \"block\"]",
            "type = \"pin-in-slot\", between = [\"crank.A\", \"rocker\"]",
        );
    let slot = read(&slot);
    let closed = six_link();
    for k in 0..60 {
        let phi = TAU * f64::from(k) / 60.0;
        let frames = file.machine.mechanism().frames(phi).unwrap();
        let (rocker, rod) = (frames[2].psi, frames[3].psi);
        let way = frames[1].x.value + 0.2;
        let s = way.hypot(frames[1].y.value);
        let turned = rod.value + std::f64::consts::PI; // (81) counts φ₃ from C to B
        let equations = [
            0.1 * phi.cos() - s * rocker.value.cos() + 0.2,
            0.1 * phi.sin() - s * rocker.value.sin(),
            0.45 * rocker.value.sin() - 0.7 * turned.sin() - 0.35,
        ];
        for equation in equations {
            close(equation, 0.0, 1e-13);
        }
        let (found, expected) = (
            file.machine.reduction(phi).unwrap(),
            closed.reduction(phi).unwrap(),
        );
        for order in 0..3 {
            close(
                found.inertias()[order],
                expected.inertias()[order],
                budget::LINKAGE * 10.0,
            );
        }
        close(
            found.load_torque(),
            expected.load_torque(),
            budget::LINKAGE * 100.0,
        );
        let without = slot.machine.mechanism().frames(phi).unwrap();
        close(without[1].psi.value, rocker.value, 1e-12);
        close(without[1].psi.d2, rocker.d2, 1e-11);
    }
}

#[test]
fn the_drawing_need_not_be_exact() {
    let exact = read(FOUR_BAR);
    for (coupler, rocker) in [("30 deg", "120 deg"), ("70 deg", "85 deg")] {
        let text = FOUR_BAR
            .replace("50 deg", coupler)
            .replace("100 deg", rocker);
        let file = read(&text);
        for phi in [0.3, 3.0, 5.5] {
            let [found, expected] =
                [&file, &exact].map(|f| f.machine.mechanism().frames(phi).unwrap()[2].psi);
            close(found.value, expected.value, 1e-13);
        }
    }
    // The other branch: the coupler pin below the line of the bearings.
    let below = read(
        &FOUR_BAR
            .replace("50 deg", "-45 deg")
            .replace("100 deg", "-105 deg"),
    );
    let found = below.machine.mechanism().frames(0.0).unwrap()[2].psi;
    let above = exact.machine.mechanism().frames(0.0).unwrap()[2].psi;
    close(found.value, -above.value, 1e-12);
}

#[test]
fn the_machines_are_read() {
    for name in [
        "linkage-four-bar.toml",
        "linkage-press.toml",
        "linkage-planetary.toml",
        "linkage-cam-lever.toml",
        "excavator-bucket.toml",
    ] {
        let file = machine(name);
        assert_eq!(file.machine.mechanism().kind(), "linkage", "{name}");
    }
}

#[test]
fn the_documented_examples_are_read() {
    let doc = include_str!("../../../../docs/mechanisms/linkage.md");
    let blocks = doc.split("\n```toml\n").skip(1);
    let links = |block: &str| {
        let file = read(block.split("\n```").next().unwrap());
        file.machine.mechanism().links().len()
    };
    let found: Vec<usize> = blocks.map(links).collect();
    // A folded slider-crank, and a four-bar.
    assert_eq!(found, [3, 3]);
}
