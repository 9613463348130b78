//! Machines against results that others computed: sympy.physics.mechanics with absolute coordinates and multipliers
//! (`cross_check/cross_check.py` makes the files anew), and Andrews' squeezing mechanism as published.

mod andrews;

use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};

use jred_analysis::reduce::{Over, Request, Sets, reduce};

use crate::reading::machine;
use crate::support::{Columns, budget, largest, near_column};

/// Positions of a turn in the script, and its motion: 90 rpm, 40 rad/s².
const POSITIONS: usize = 37;
const STATE: [f64; 2] = [3.0 * PI, 40.0];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cross_check")
}

/// A file of numbers by column, below its line of origin; the first column is read as text.
fn columns(name: &str) -> (Vec<String>, Columns) {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(folder().join(name))
        .unwrap();
    let names = reader.headers().unwrap().iter().skip(1).map(str::to_owned);
    let names = names.collect();
    let (mut first, mut rows) = (Vec::new(), Vec::new());
    for record in reader.records() {
        let record = record.unwrap();
        first.push(record[0].to_owned());
        let cells = record
            .iter()
            .skip(1)
            .map(|cell| Some(cell.parse().unwrap()));
        rows.push(cells.collect());
    }
    (first, Columns { names, rows })
}

/// The results of `jred reduce` at the script's positions.
fn reduced(name: &str, sets: Sets) -> Columns {
    let request = Request {
        over: Over::Angle,
        positions: POSITIONS,
        sets,
        state: Some(STATE),
    };
    let found = reduce(&machine(&format!("{name}.toml")), &request).unwrap();
    Columns {
        names: found.names(),
        rows: found.rows().to_vec(),
    }
}

/// J_red, its derivative, drive torque and all joint forces of a machine; how many of its columns are joint forces.
fn agrees(name: &str) -> usize {
    let (positions, expected) = columns(&format!("{name}.csv"));
    let positions: Vec<usize> = positions.iter().map(|k| k.parse().unwrap()).collect();
    let curves = reduced(
        name,
        Sets {
            curves: true,
            ..Sets::default()
        },
    );
    let reactions = reduced(
        name,
        Sets {
            reactions: true,
            ..Sets::default()
        },
    );
    let phi = curves.get("phi [deg]");
    near_column(
        "phi",
        &phi.iter().map(|phi| phi.to_radians()).collect::<Vec<_>>(),
        &(0..POSITIONS)
            .map(|k| TAU * k as f64 / POSITIONS as f64)
            .collect::<Vec<_>>(),
        budget::CROSS_CHECK,
    );
    let at = |columns: &Columns, name: &str| {
        let all = columns.get(name);
        positions.iter().map(|&k| all[k]).collect::<Vec<_>>()
    };
    let torque = largest(&expected.get("T"));
    let is_force = |name: &&String| name.contains(" F_");
    let forces: Vec<f64> = expected
        .names
        .iter()
        .filter(is_force)
        .flat_map(|name| expected.get(name))
        .collect();
    for column in &expected.names {
        // One size for all components of all forces: a component may be nothing but rounding.
        let (found, size) = match column.as_str() {
            "J" => (at(&curves, "J_red [kg m^2]"), largest(&expected.get("J"))),
            "J'" => (
                at(&curves, "J_red' [kg m^2/rad]"),
                largest(&expected.get("J")),
            ),
            "T" => (at(&reactions, "T_drive [N m]"), torque),
            force if is_force(&column) => {
                (at(&reactions, &format!("{force} [N]")), largest(&forces))
            }
            moment => (at(&reactions, &format!("{moment} [N m]")), torque),
        };
        let scaled = |values: Vec<f64>| values.iter().map(|v| 1.0 + v / size).collect::<Vec<_>>();
        near_column(
            &format!("{name}: {column}"),
            &scaled(found),
            &scaled(expected.get(column)),
            budget::CROSS_CHECK,
        );
    }
    expected.names.iter().filter(is_force).count()
}

#[test]
fn seven_machines_agree_with_multipliers_in_absolute_coordinates() {
    // Components of joint forces: every joint of the machine, except the meshes, which are ratios there.
    for (name, forces) in [
        ("press", 8),
        ("four-bar", 8),
        ("six-link", 14),
        ("toggle-press", 14),
        ("linkage-press", 14),
        ("geneva", 6),
        ("linkage-planetary", 0),
    ] {
        assert_eq!(agrees(name), forces, "{name}");
    }
}
