//! `jred export --pieces`: a table for each piece between the edges of loads, put together as firmware does it.

use std::path::PathBuf;

use jred::table::Format;
use jred::{
    Cubic, Image, Model, Phase, Pieces, Q31, Quadratic, Rows16, Set, Spline, Spline16, curves,
};

use super::images::{errors, machine};
use super::{KINDS, export_of, press_pieces};
use crate::support::{Folder, Run, budget, edited_press, press_file};

/// The curves of the press.
const SET: Set = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// The press with a pressing force that sets in within half a degree.
fn steep(folder: &Folder) -> PathBuf {
    let text = edited_press("ramp = \"15 deg\"", "ramp = \"0.5 deg\"");
    folder.file("steep.toml", text)
}

fn exported(folder: &Folder, kind: (&str, &str), more: &[&str]) -> Run {
    let arguments = [
        "--type",
        kind.0,
        "--layout",
        kind.1,
        "--torque-error",
        "0.5 N m",
    ];
    export_of(&steep(folder), &[&arguments[..], more].concat(), None)
}

/// The largest errors of four pieces, a quarter of the states in each of them, and close to both of its ends.
fn errors_of<F: Format>(folder: &Folder, value: &serde_json::Value) -> [f64; 2] {
    let pieces = value["pieces"].as_array().unwrap();
    let words: Vec<Vec<u32>> = pieces.iter().map(words).collect();
    let images: Vec<Image<'_>> = words.iter().map(|w| Image::new(w).unwrap()).collect();
    let start = |k: usize| pieces[k % 4]["start"].as_u64().unwrap() as u32;
    let model = Pieces::<F, SET, 4>::new(std::array::from_fn(|k| {
        let model: Model<'_, F, SET> = images[k].model().unwrap();
        (Phase::from_bits(start(k)), model)
    }))
    .unwrap();
    let spread = |share: f64| {
        let (piece, within) = ((4.0 * share) as usize, (4.0 * share).fract());
        // The sine puts more of them at the ends.
        let within = 0.5 - 0.5 * (std::f64::consts::PI * within).cos();
        let length = start(piece + 1).wrapping_sub(start(piece));
        Phase::from_bits(start(piece).wrapping_add((within * f64::from(length)) as u32))
    };
    let machine = machine(&jred_machine::read::read(&steep(folder)).unwrap());
    errors(
        &machine,
        &images[0],
        spread,
        |phase, omega, alpha| model.torque(phase, omega, alpha),
        |phase, omega, torque| model.acceleration(phase, omega, torque),
    )
}

fn words(piece: &serde_json::Value) -> Vec<u32> {
    let words = piece["words"].as_array().unwrap();
    words.iter().map(|w| w.as_u64().unwrap() as u32).collect()
}

#[test]
fn pieces_of_every_type_and_layout_hold_their_error() {
    let folder = Folder::new();
    for kind in KINDS {
        let run = exported(&folder, kind, &["--pieces", "auto", "--format", "json"]).ends(0);
        let value = run.json();
        let found = match kind {
            ("f32", "spline") => errors_of::<Spline<f32>>(&folder, &value),
            ("f32", "cubic") => errors_of::<Cubic<f32>>(&folder, &value),
            ("f32", _) => errors_of::<Quadratic<f32>>(&folder, &value),
            ("i32", "spline") => errors_of::<Spline<Q31>>(&folder, &value),
            ("i32", "spline16") => errors_of::<Spline16>(&folder, &value),
            ("i32", "cubic") => errors_of::<Cubic<Q31>>(&folder, &value),
            ("i32", _) => errors_of::<Quadratic<Q31>>(&folder, &value),
            _ => errors_of::<Rows16>(&folder, &value),
        };
        let stated = value["torque_error"].as_f64().unwrap();
        assert!(stated <= 0.5, "{kind:?} {stated}");
        for error in found {
            let most = stated * (1.0 + budget::BETWEEN_PLACES);
            assert!(
                (0.4 * stated..=most).contains(&error),
                "{kind:?}: {error} of {stated}"
            );
        }
        // They meet at the edges of the load: 315, 315.5, 359.5 and 360 degrees.
        let starts = value["pieces"].as_array().unwrap().iter();
        let starts: Vec<f64> = starts
            .map(|p| p["from"].as_f64().unwrap().to_degrees())
            .collect();
        for (found, edge) in starts.iter().zip([0.0, 315.0, 315.5, 359.5]) {
            assert!(
                (found - edge).abs() < budget::CLOSED_FORM * 360.0,
                "{starts:?}"
            );
        }
    }
}

/// A single table needs as many cells as the steep edge asks for, all over the turn.
#[test]
fn pieces_take_a_fraction_of_one_table() {
    let folder = Folder::new();
    let kind = ("f32", "spline");
    let bytes = |more: &[&str]| {
        let run = exported(&folder, kind, &[more, &["--format", "json"]].concat()).ends(0);
        run.json()["image_bytes"].as_u64().unwrap()
    };
    let (one, four) = (bytes(&[]), bytes(&["--pieces", "auto"]));
    assert!(four > 500 && 30 * four < one, "{four} and {one} bytes");
    // Named by hand, in another order and turn, they are the same.
    let named = bytes(&["--pieces", "-45 deg, 720 deg, 359.5 deg, 315.5 deg"]);
    assert_eq!(named, four);
}

/// What is in the repository is compiled with this test.
#[test]
fn the_source_text_is_a_program() {
    let folder = Folder::new();
    let out = folder.path("press_pieces.rs");
    let more = [
        "--torque-error",
        "2 N m",
        "--pieces",
        "auto",
        "--format",
        "rust",
    ];
    export_of(&press_file(), &more, Some(&out)).ends(0);
    let here = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/export/press_pieces.rs");
    let (written, expected) = [out.as_path(), here.as_ref()]
        .map(|path| std::fs::read_to_string(path).unwrap())
        .into();
    assert_eq!(written, expected, "see CONTRIBUTING.md, Examples");

    let model = press_pieces::pieces().unwrap();
    let machine = machine(&jred_machine::read::read(&press_file()).unwrap());
    let image = Image::new(&press_pieces::TABLE_1).unwrap();
    let [torque, _] = errors(
        &machine,
        &image,
        |share| Phase::from_bits((share * 4_294_967_296.0) as u32),
        |phase, omega, alpha| model.torque(phase, omega, alpha),
        |phase, omega, torque| model.acceleration(phase, omega, torque),
    );
    assert!((0.5..=2.0).contains(&torque), "{torque}");

    let out = folder.path("press_pieces.c");
    let more = [
        "--torque-error",
        "2 N m",
        "--pieces",
        "auto",
        "--format",
        "c",
    ];
    export_of(&press_file(), &more, Some(&out)).ends(0);
    let text = std::fs::read_to_string(out).unwrap();
    for (k, table) in [&press_pieces::TABLE_1[..], &press_pieces::TABLE_2[..]]
        .iter()
        .enumerate()
    {
        let head = format!(
            "const uint32_t jred_table_{}[{}] = {{\n    0x4445524a, ",
            k + 1,
            table.len()
        );
        assert!(text.contains(&head), "{text}");
    }
    assert!(text.contains("const uint32_t jred_starts[4] = { 0x00000000, 0xe0000000, "));
}

#[test]
fn pieces_that_are_not_possible() {
    let folder = Folder::new();
    let gripper = press_file().with_file_name("linear-gripper.toml");
    let plain = press_file().with_file_name("planetary.toml");
    let refused = |file: &std::path::Path, more: &[&str], words: &[&str]| {
        let more = [&["--torque-error", "2 N m"], more].concat();
        export_of(file, &more, None).ends(2).says(words);
    };
    let press = press_file();
    let out = folder.path("table.jred");
    let more = ["--torque-error", "2 N m", "--pieces", "auto"];
    let run = export_of(&press, &more, Some(&out)).ends(2);
    run.says(&[
        "one image cannot hold the tables of several pieces",
        "--format rust, c or json",
    ]);
    assert!(!out.exists());
    refused(
        &press,
        &["--pieces", "10 deg, 5 mm"],
        &["--pieces", "\"5 mm\""],
    );
    refused(
        &press,
        &["--pieces", "10 deg, 10.004 deg"],
        &["the piece from φ = 10 deg to φ = 10.004 deg is shorter than 1/65536 of the range"],
    );
    refused(
        &press,
        &["--pieces", "auto", "--max-bytes", "900"],
        &["cannot be used with"],
    );
    refused(
        &plain,
        &["--pieces", "auto", "--omega", "1 rad/s"],
        &["no edges for --pieces auto", "--pieces \"60 deg, 75 deg\""],
    );
    let outside = ["--torque-error", "2 N", "--pieces", "1 m"];
    export_of(&gripper, &outside, None)
        .ends(2)
        .says(&["\"1 m\": it must lie within the stroke, "]);
    // Machine units of i32 go with the width of a cell, of which π degrees and the rest of a turn have none in common.
    let irrational = ["--type", "i32", "--pieces", "0 deg, 3.14159265358979 deg"];
    refused(
        &press,
        &irrational,
        &["for i32 go with the width of a cell", "--type f32"],
    );
}
