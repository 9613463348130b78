//! Torque offsets of CiA 402, and the names of function blocks.
// Copied figures are exact.
#![allow(clippy::float_cmp)]

use std::f64::consts::TAU;

use jred_analysis::checked;
use jred_export::{
    BLOCK_NAMES, Core, Export, LayoutChoice, Name, Number, ShaftInstant, Task, TorqueOffsets,
};

use crate::support::shipped;

fn instants() -> Vec<ShaftInstant> {
    let instant = |k: u32| {
        let t = f64::from(k) * 1e-3;
        ShaftInstant {
            t,
            position: 3.0 * t * TAU,
            torque: 5.0 * (20.0 * t).sin() - 0.3,
        }
    };
    (0..200).map(instant).collect()
}

fn offsets(
    instants: &[ShaftInstant],
    rated: f64,
    counts_per_turn: Option<u32>,
) -> TorqueOffsets<'_> {
    TorqueOffsets {
        title: "an axis",
        instants,
        rated,
        counts_per_turn,
        rotor: 1e-4,
        drive: None,
        unit: "N m",
    }
}

#[test]
fn a_drive_reads_the_torque_within_half_of_a_per_mille() {
    let instants = instants();
    for counts in [None, Some(4096)] {
        // Rounded to the whole mN m that 0x6076 takes.
        let text = offsets(&instants, 2.400_4, counts).csv().unwrap();
        assert!(text.contains("# base: 0x6076 = 2400 mN m; 1 per mille = 0.0024 N m\n"));
        let (comments, rows): (Vec<&str>, Vec<&str>) =
            text.lines().partition(|line| line.starts_with('#'));
        assert_eq!(comments.len(), 6);
        assert_eq!(
            rows[0],
            if counts.is_some() {
                "t [s],0x6064 [counts],0x60B2 [per mille]"
            } else {
                "t [s],0x60B2 [per mille]"
            }
        );
        assert_eq!(rows.len(), 201);
        for (row, instant) in rows[1..].iter().zip(&instants) {
            let cells: Vec<&str> = row.split(',').collect();
            assert_eq!(cells[0].parse::<f64>().unwrap(), instant.t);
            let per_mille: i16 = cells.last().unwrap().parse().unwrap();
            let error = f64::from(per_mille) * 2.4e-3 - instant.torque;
            assert!(error.abs() <= 1.2e-3 + 1e-12, "{row}");
            if let Some(per_turn) = counts {
                let counts: i32 = cells[1].parse().unwrap();
                let error = f64::from(counts) / f64::from(per_turn) - instant.position / TAU;
                assert!(error.abs() <= 0.5 / f64::from(per_turn) + 1e-12, "{row}");
            }
        }
    }
}

#[test]
fn what_an_object_cannot_hold_is_refused_with_what_fits() {
    let instants = instants();
    let fault = offsets(&instants, 0.01, None).csv().unwrap_err();
    let said = fault.to_string();
    assert!(
        said.contains(
            "per mille of the rated torque: objects 0x60B2 and 0x6071 are INTEGER16, up to 32767"
        ),
        "{said}"
    );
    let cure = fault.cure().unwrap();
    let least = cure
        .split_once("From ")
        .unwrap()
        .1
        .split_once(" N m")
        .unwrap()
        .0;
    let least: f64 = least.parse().unwrap();
    assert!(offsets(&instants, least, None).csv().is_ok());
    assert!(offsets(&instants, 0.9 * least, None).csv().is_err());
    for rated in [4e-4, 1e7] {
        let fault = offsets(&instants, rated, None).csv().unwrap_err();
        assert!(
            fault
                .to_string()
                .contains("does not fit object 0x6076, whole mN m from 1 to 4294967295")
        );
        assert!(fault.cure().unwrap().contains("rated torque of the motor"));
    }
    let fault = offsets(&instants, 2.0, Some(u32::MAX)).csv().unwrap_err();
    assert!(
        fault
            .to_string()
            .contains("object 0x6064 is INTEGER32, up to 2147483647")
    );
    assert!(fault.cure().unwrap().contains("fewer --counts-per-turn"));
}

/// Letter case does not count in a PLC, so a block must not have the name of a variable in it.
#[test]
fn names_of_blocks_are_not_those_of_their_variables() {
    let file = checked::read(&shipped("shaking-feeder.toml")).unwrap();
    let task = Task {
        number: Number::F32,
        layout: LayoutChoice::Spline,
        core: Core::default(),
        forward: false,
        reciprocal: false,
        torque_error: Some(0.5),
        max_bytes: None,
        max_cells: 200,
        omega: 30.0,
        alpha: 100.0,
        rotor: 0.0,
        edges: Vec::new(),
        machine: None,
    };
    let export = Export::new(&file, task).unwrap();
    let name = Name::for_plc("feeder", &BLOCK_NAMES).unwrap();
    let text = export.structured_text(&name, "about\nit").unwrap();
    assert!(text.starts_with("(* about *)\n(* it *)\nFUNCTION_BLOCK feeder\n"));
    let declared = text
        .lines()
        .filter(|line| line.starts_with("    ") && !line.contains("(Position :="));
    let mut count = 0;
    for (variable, _) in declared.filter_map(|line| line.trim().split_once(" : ")) {
        count += 1;
        assert!(Name::for_plc(variable, &BLOCK_NAMES).is_err(), "{variable}");
    }
    assert!(count > 40, "{count}");
    // Other tables than the spline in f32 are no function block.
    let other = Task {
        layout: LayoutChoice::Cubic,
        ..export.task.clone()
    };
    let other = Export::new(&file, other).unwrap();
    assert!(other.structured_text(&name, "").is_none());
}
