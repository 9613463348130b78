//! `jred export --pieces`: a table for each piece between the edges of loads, assembled as in firmware.

use std::path::PathBuf;

use jred::machine::Reducible as _;
use jred::table::Format;
use jred::{
    Cubic, CurveSet, Domain, Image, Model, Phase, Pieces, Q31, Quadratic, Rows16, Spline, Spline16,
    curves,
};

use jred_export::{Export, LayoutChoice, Number, SearchResult, Task};
use jred_file::model::machine::MachineFile;

use super::images::{errors, machine};
use super::{KINDS, export_of, press_pieces};
use crate::support::{Folder, Run, budget, edited_press, press_file, shipped, typed};

/// The curves of the press.
const SET: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;

/// The press with a pressing force that rises within half a degree.
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

/// The tables of all types and layouts for 0.5 N m, split at the edges of the loads.
fn searched(file: &MachineFile) -> Export {
    let task = Task {
        number: Number::F32,
        layout: LayoutChoice::Auto,
        core: jred_export::Core::default(),
        forward: false,
        reciprocal: false,
        torque_error: Some(0.5),
        max_bytes: None,
        max_cells: 4096,
        omega: 30.0,
        alpha: 230.0,
        rotor: 0.0,
        edges: file.machine.load_edges().collect(),
        machine: None,
    };
    Export::new(file, task).unwrap()
}

/// The phases at which pieces start, and their images.
type Tables = Vec<(u32, Vec<u32>)>;

/// The tables as the command writes them.
fn written(value: &serde_json::Value) -> Tables {
    let pieces = value["pieces"].as_array().unwrap().iter();
    pieces
        .map(|piece| (piece["start"].as_u64().unwrap() as u32, words(piece)))
        .collect()
}

/// The largest errors of four pieces, with a quarter of the states in each, many close to its ends.
fn errors_of<F: Format>(file: &MachineFile, tables: &Tables) -> [f64; 2] {
    let image = |k: usize| Image::new(&tables[k].1).unwrap();
    let start = |k: usize| tables[k % 4].0;
    let models = std::array::from_fn(|k| {
        let model: Model<'_, F, SET> = image(k).model().unwrap();
        (Phase::from_bits(start(k)), model)
    });
    let model = Pieces::<F, SET, 4>::new(Domain::Turn, models).unwrap();
    let spread = |share: f64| {
        let (piece, within) = ((4.0 * share) as usize, (4.0 * share).fract());
        // The sine puts more of them at the ends.
        let within = 0.5 - 0.5 * (std::f64::consts::PI * within).cos();
        let length = start(piece + 1).wrapping_sub(start(piece));
        Phase::from_bits(start(piece).wrapping_add((within * f64::from(length)) as u32))
    };
    errors::<F::Number>(
        &machine(file),
        &image(0),
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
    let file = jred_analysis::checked::read(&steep(&folder)).unwrap();
    let export = searched(&file);
    for ((number, layout, answer), kind) in export.answers.iter().zip(KINDS) {
        assert_eq!((number.name(), layout.name()), kind);
        let SearchResult::Meets(candidate) = answer else {
            panic!("{kind:?}: {answer:?}")
        };
        let tables = candidate.tables.iter();
        let tables: Tables = tables
            .map(|table| (export.start(table).to_bits(), table.words.clone()))
            .collect();
        let found = match kind {
            ("f32", "spline") => errors_of::<Spline<f32>>(&file, &tables),
            ("f32", "cubic") => errors_of::<Cubic<f32>>(&file, &tables),
            ("f32", _) => errors_of::<Quadratic<f32>>(&file, &tables),
            ("i32", "spline") => errors_of::<Spline<Q31>>(&file, &tables),
            ("i32", "spline16") => errors_of::<Spline16>(&file, &tables),
            ("i32", "cubic") => errors_of::<Cubic<Q31>>(&file, &tables),
            ("i32", _) => errors_of::<Quadratic<Q31>>(&file, &tables),
            _ => errors_of::<Rows16>(&file, &tables),
        };
        let stated = candidate.error();
        assert!(stated <= 0.5, "{kind:?} {stated}");
        for error in found {
            let most = stated * (1.0 + budget::BETWEEN_PLACES);
            assert!(
                (0.4 * stated..=most).contains(&error),
                "{kind:?}: {error} of {stated}"
            );
        }
        // They meet at the edges of the load: 315, 315.5, 359.5 and 360 degrees.
        let starts = candidate
            .tables
            .iter()
            .map(|table| table.range[0].to_degrees());
        for (found, edge) in starts.zip([0.0, 315.0, 315.5, 359.5]) {
            assert!((found - edge).abs() < 1e-7, "{found} is not {edge}");
        }
    }
    assert_eq!(export.answers.len(), KINDS.len());
}

/// A single table needs the cell size of the steep edge over the whole turn.
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
    // Given by hand, in another order and turn, the edges are the same.
    let named = bytes(&["--pieces", "-45 deg, 720 deg, 359.5 deg, 315.5 deg"]);
    assert_eq!(named, four);
}

/// Firmware selects a piece by integer phases, to which such edges must be rounded.
#[test]
fn steep_edges_that_are_no_whole_phases_hold_their_error() {
    let folder = Folder::new();
    let text = edited_press(
        "[\"315 deg\", \"360 deg\"]",
        "[\"310.1234567 deg\", \"350.7654321 deg\"]",
    );
    let text = text.replace("ramp = \"15 deg\"", "ramp = \"0.006 deg\"");
    let text = text.replace("\"-10 kN\"", "\"-10 MN\"");
    let file = folder.file("steep.toml", text);
    let arguments = typed("--pieces auto --torque-error '0.1 N m' --layout spline --format json");
    let run = export_of(&file, &arguments, None).ends(0);
    let stated = run.json()["torque_error"].as_f64().unwrap();
    let file = jred_analysis::checked::read(&file).unwrap();
    let [error, _] = errors_of::<Spline<f32>>(&file, &written(&run.json()));
    assert!(stated <= 0.1 && error > 0.1 * stated, "{error} of {stated}");
    assert!(
        error <= stated * (1.0 + budget::BETWEEN_PLACES),
        "{error} of {stated}"
    );
}

/// A turn with one edge is one piece that starts there; a stroke with only its ends is not split.
#[test]
fn a_single_piece_begins_at_its_edge() {
    let folder = Folder::new();
    // With the turn from the edge rounded up, and not.
    for degrees in [60, 104] {
        let edge = format!("{degrees} deg");
        let line = format!("--pieces '{edge}' --torque-error '2 N m' --layout spline");
        let arguments = typed(&line);
        let run = export_of(
            &press_file(),
            &[&arguments[..], &["--format", "json"]].concat(),
            None,
        );
        let value = run.ends(0).json();
        let pieces = value["pieces"].as_array().unwrap();
        let start = Phase::from_radians(f64::from(degrees).to_radians()).to_bits();
        assert_eq!(pieces.len(), 1);
        assert_eq!(pieces[0]["start"], start);
        assert!(value["rust"].as_str().unwrap().starts_with("jred::Pieces<"));
        let words = words(&pieces[0]);
        let model = Image::new(&words)
            .unwrap()
            .model::<Spline<f32>, SET>()
            .unwrap();
        let turn = Pieces::new(Domain::Turn, [(Phase::from_bits(start), model)]).unwrap();
        let machine = machine(&jred_analysis::checked::read(&press_file()).unwrap());
        let [torque, _] = errors::<f32>(
            &machine,
            &Image::new(&words).unwrap(),
            |share| Phase::from_bits((share * 4_294_967_296.0) as u32),
            |phase, omega, alpha| turn.torque(phase, omega, alpha),
            |phase, omega, torque| turn.acceleration(phase, omega, torque),
        );
        assert!((0.5..=2.0).contains(&torque), "{torque}");
    }
    for number in ["i32", "i16"] {
        let edge = ["--pieces", "60 deg", "--type", number];
        let arguments = [&edge[..], &["--torque-error", "2 N m"]].concat();
        export_of(&press_file(), &arguments, None).ends(0);
    }
    let out = folder.path("table.rs");
    let arguments = typed("--pieces '60 deg' --torque-error '2 N m' --format rust");
    export_of(&press_file(), &arguments, Some(&out)).ends(0);
    assert!(
        std::fs::read_to_string(out)
            .unwrap()
            .contains("piece(0x2aaaaaab, &TABLE_1)?,")
    );

    let gripper = shipped("linear-gripper.toml");
    let ends = typed("--torque-error '2 N' --pieces '120 mm, 200 mm' --format json");
    assert!(export_of(&gripper, &ends, None).ends(0).json()["words"].is_array());
}

/// A stroke is split inside, from its start to its end.
#[test]
fn a_stroke_in_pieces_holds_its_error() {
    let gripper = shipped("linear-gripper.toml");
    let arguments = typed(
        "--torque-error '2 N' --layout spline --pieces '150 mm, 172.5 mm, 130 mm' --format json",
    );
    let value = export_of(&gripper, &arguments, None).ends(0).json();
    let pieces = value["pieces"].as_array().unwrap();
    assert_eq!(pieces[0]["start"], 0);
    let near = |k: usize, end: &str, expected: f64| {
        let found = pieces[k][end].as_f64().unwrap();
        assert!((found - expected).abs() < 1e-10, "{found}");
    };
    for (k, [from, to]) in [[0.12, 0.13], [0.13, 0.15], [0.15, 0.1725], [0.1725, 0.2]]
        .into_iter()
        .enumerate()
    {
        near(k, "from", from);
        near(k, "to", to);
    }
    let machine = machine(&jred_analysis::checked::read(&gripper).unwrap());
    let [omega, alpha] = ["omega", "alpha"].map(|key| value[key].as_f64().unwrap());
    let mut worst = 0.0f64;
    for piece in pieces {
        let words = words(piece);
        let model = Image::new(&words)
            .unwrap()
            .any_model::<Spline<f32>>()
            .unwrap();
        let [from, to] = ["from", "to"].map(|key| piece[key].as_f64().unwrap());
        for k in 0..1000 {
            let share = (f64::from(k) + 0.5) / 1000.0;
            let phase = Phase::from_bits((share * 4_294_967_296.0) as u32);
            let exact = machine.reduction(from + (to - from) * share).unwrap();
            let expected = exact.torque(omega, alpha).total();
            let found = f64::from(model.torque(phase, omega as f32, alpha as f32));
            worst = worst.max((found - expected).abs());
        }
    }
    let stated = value["torque_error"].as_f64().unwrap();
    let most = stated * (1.0 + budget::BETWEEN_PLACES);
    assert!(
        (0.2 * stated..=most).contains(&worst),
        "{worst} of {stated}"
    );
}

/// A load between two of the positions from which curves and machine units are chosen, in every number type.
#[test]
fn a_narrow_load_has_its_curve_and_its_units() {
    let folder = Folder::new();
    let text = edited_press(
        "[\"315 deg\", \"360 deg\"]",
        "[\"300.0625 deg\", \"300.1875 deg\"]",
    );
    let text = text.replace("ramp = \"15 deg\"", "ramp = \"0.0625 deg\"");
    let weightless = text.replace("\"9.81 m/s^2\"", "\"0 m/s^2\"");
    for (name, text) in [("heavy", &text), ("weightless", &weightless)] {
        let file = jred_analysis::checked::read(&folder.file("narrow.toml", text)).unwrap();
        let mut met = Vec::new();
        for (number, layout, answer) in searched(&file).answers {
            // Some layouts would need more cells.
            let SearchResult::Meets(candidate) = answer else {
                assert!(
                    matches!(answer, SearchResult::Misses(_)),
                    "{name} {number:?} {layout:?}"
                );
                continue;
            };
            assert_ne!(candidate.curves() & curves::LOAD, 0, "{name} {number:?}");
            met.push(number);
        }
        for number in Number::ALL {
            assert!(met.contains(&number), "{name}: no table of {number:?}");
        }
    }
    let harmonic = ["--torque-error", "5 N m", "--layout", "harmonic"];
    let file = folder.file("narrow.toml", &text);
    let run = export_of(&file, &harmonic, None).ends(1);
    run.says(&["harmonics reach a torque error of "]);
    assert!(!run.message().contains("rounding floor"));
}

/// The source in the repository is compiled with this test.
#[test]
fn the_source_text_is_a_program() {
    let folder = Folder::new();
    let out = folder.path("press_pieces.rs");
    let more = typed("--torque-error '2 N m' --layout spline --pieces auto --format rust");
    export_of(&press_file(), &more, Some(&out)).ends(0);
    let here = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/export/press_pieces.rs");
    let (written, expected) = [out.as_path(), here.as_ref()]
        .map(|path| std::fs::read_to_string(path).unwrap())
        .into();
    assert_eq!(written, expected, "see CONTRIBUTING.md, Examples");

    let model = press_pieces::pieces().unwrap();
    let machine = machine(&jred_analysis::checked::read(&press_file()).unwrap());
    let image = Image::new(&press_pieces::TABLE_1).unwrap();
    let [torque, _] = errors::<f32>(
        &machine,
        &image,
        |share| Phase::from_bits((share * 4_294_967_296.0) as u32),
        |phase, omega, alpha| model.torque(phase, omega, alpha),
        |phase, omega, torque| model.acceleration(phase, omega, torque),
    );
    assert!((0.5..=2.0).contains(&torque), "{torque}");

    let out = folder.path("press_pieces.c");
    let more = typed("--torque-error '2 N m' --layout spline --pieces auto --format c");
    export_of(&press_file(), &more, Some(&out)).ends(0);
    let text = std::fs::read_to_string(out).unwrap();
    for (k, table) in [&press_pieces::TABLE_1[..], &press_pieces::TABLE_2[..]]
        .iter()
        .enumerate()
    {
        let head = format!(
            "const uint32_t press_pieces_words_{}[{}] = {{\n    0x4445524au, ",
            k + 1,
            table.len()
        );
        assert!(text.contains(&head), "{text}");
    }
    assert!(text.contains("const uint32_t press_pieces_starts[4] = { 0x00000000u, 0xe0000000u, "));
}
