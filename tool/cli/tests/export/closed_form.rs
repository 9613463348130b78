//! A slider-crank in closed form: selected, loaded, ticked; refused if there is no such form.

use jred::machine::Reducible as _;
use jred::slider_crank::terms;
use jred::{CurveSet, Image, ImageError, Phase, SliderCrankForm, Spline, curves};

use super::images::{errors, machine};
use super::{export_of, feeder_form, number_after, words_of};
use crate::support::{Folder, press_file, shipped, typed};

const SET: CurveSet = curves::LOAD
    | curves::VISCOUS
    | curves::COULOMB
    | curves::CONSTANT_COULOMB
    | terms::INERTIA_COS
    | terms::LOAD_SIN
    | terms::LOAD_COS;

/// Whatever error is asked for, down to single precision's own: the form meets it.
#[test]
#[ignore = "more than five seconds of a processor"]
fn a_plain_slider_crank_is_taken_as_its_form() {
    let folder = Folder::new();
    let path = shipped("shaking-feeder.toml");
    let file = jred_analysis::checked::read(&path).unwrap();
    for allowed in ["5 N m", "0.01 N m", "0.00002 N m"] {
        let out = folder.path("feeder.jred");
        let more = ["--torque-error", allowed, "--layout", "slider-crank"];
        let run = export_of(&path, &more, Some(&out)).ends(0);
        assert!(
            run.out
                .contains("f32, layout slider-crank, 12 coefficients")
        );
        assert!(run.out.contains("48 bytes of rows, 148 bytes of image"));
        assert!(run.out.contains("needs jred's feature micromath"));
        assert!(
            run.out
                .contains("instructions at most on a Cortex-M4F: closed form ")
        );
        let words = words_of(&out);
        let image = Image::new(&words).unwrap();
        let stated = f64::from(image.validity().torque_error);
        let model = image.model::<SliderCrankForm, SET>().unwrap();
        let [torque, acceleration] = errors::<f32>(
            &machine(&file),
            &image,
            |share| Phase::from_bits((share * 4_294_967_296.0) as u32),
            |phase, omega: f32, alpha| model.torque(phase, omega, alpha),
            |phase, omega, torque| model.acceleration(phase, omega, torque),
        );
        // Roundings are random: between 16,381 positions there may be a larger one.
        assert!(
            torque <= 1.5 * stated && torque > stated / 4.0,
            "{torque} of {stated}"
        );
        assert!(acceleration <= 1.5 * stated, "{acceleration} of {stated}");
        let largest = number_after(&run.out, "of the largest, ");
        assert!(stated < 1e-6 * largest, "{stated} of {largest}");
        assert!(matches!(
            image.model::<Spline<f32>, { curves::LOAD }>(),
            Err(ImageError::Layout(7))
        ));
    }
    // No table is more accurate than single precision; the message names that floor.
    let run = export_of(&path, &["--torque-error", "1e-7 N m"], None).ends(1);
    run.says(&[
        "slider-crank: 12 coefficients reach ",
        "the rounding floor of f32",
    ]);
    // A table on request; in fixed point there is no form.
    for (kind, layout) in [
        (["--layout", "spline"], "f32, layout spline"),
        (["--type", "i32"], "i32, layout "),
    ] {
        let more = [&kind[..], &["--torque-error", "0.01 N m"]].concat();
        let run = export_of(&path, &more, None).ends(0);
        assert!(run.out.contains(layout), "{}", run.out);
        assert!(!run.out.contains("needs jred's feature"));
    }
}

/// The Rust source is compiled here.
#[test]
fn the_rust_file_of_a_form_is_a_program() {
    let folder = Folder::new();
    let out = folder.path("feeder_form.rs");
    let more = typed("--torque-error '0.1 N m' --layout slider-crank --format rust");
    export_of(&shipped("shaking-feeder.toml"), &more, Some(&out)).ends(0);
    let here = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/export/feeder_form.rs");
    let [written, expected] =
        [out.as_path(), here.as_ref()].map(|path| std::fs::read_to_string(path).unwrap());
    assert_eq!(written, expected, "see CONTRIBUTING.md, Examples");
    let model = feeder_form::model().unwrap();
    let file = jred_analysis::checked::read(&shipped("shaking-feeder.toml")).unwrap();
    let exact = machine(&file).reduction(0.5).unwrap().torque(20.0, 300.0);
    let found = model.torque(Phase::from_radians(0.5), 20.0, 300.0);
    assert!((f64::from(found) - exact.total()).abs() < 2e-5, "{found}");
}

/// In C a form with its own family has its functions, others those for any set.
#[test]
fn the_c_file_names_the_functions_of_the_form() {
    let folder = Folder::new();
    let feeder = std::fs::read_to_string(shipped("shaking-feeder.toml")).unwrap();
    let plain = feeder
        .replace("viscous_force = \"60 N s/m\"", "opposing_force = \"5 N\"")
        .replace("\"3 mm\"]", "\"0 mm\"]");
    // LOAD 1, COULOMB 4, CONSTANT_COULOMB 32; centres of mass on the lines and a vertical weight leave LOAD_COS, 1024.
    for (text, line) in [
        (feeder, "JRED_ANY_MODEL(machine, slider_crank_f32);"),
        (plain, "JRED_MODEL(machine, slider_crank_f32, 1061);"),
    ] {
        let (file, out) = (folder.file("machine.toml", text), folder.path("machine.h"));
        export_of(
            &file,
            &typed("--torque-error '0.1 N m' --layout slider-crank --format c"),
            Some(&out),
        )
        .ends(0);
        let written = std::fs::read_to_string(&out).unwrap();
        assert!(written.contains(line), "{written}");
    }
}

#[test]
fn what_has_no_form_is_refused_with_its_reason() {
    let folder = Folder::new();
    let asked = ["--layout", "slider-crank", "--torque-error", "0.5 N m"];
    let feeder = std::fs::read_to_string(shipped("shaking-feeder.toml")).unwrap();
    let rubbing = feeder.replace(
        "on = \"crank\"\nopposing_moment = \"0.3 N m\"",
        "on = \"rod\"\nopposing_force = \"3 N\"\nat = [\"70 mm\", \"0 mm\"]",
    );
    let sprung = format!(
        "{feeder}\n[[spring]]\nname = \"return\"\nbetween = [\"slider\", {{ on = \"ground\", at = [\"300 mm\", \"20 mm\"] }}]\n\
         stiffness = \"1 N/mm\"\nfree_length = \"100 mm\"\n"
    );
    let file = |text: String| folder.file("feeder.toml", text);
    for (path, words) in [
        (
            press_file(),
            "load \"pressing force\" acts in a part of the turn",
        ),
        (
            shipped("four-bar.toml"),
            "the mechanism is of type \"four-bar\"",
        ),
        (shipped("load-table.toml"), "is a curve over the position"),
        (
            file(rubbing),
            "load \"crank bearings\" rubs on the rod between its pins",
        ),
    ] {
        let run = export_of(&path, &asked, None).ends(2);
        run.says(&[words, "constant loads and friction only", "remove --layout"]);
    }
    let run = export_of(&file(sprung), &asked, None).ends(2);
    println!("{}", run.message());
    run.says(&["\"return\" is a spring or a damper", "--layout harmonic"]);
    // Single precision and a full turn only.
    let path = shipped("shaking-feeder.toml");
    let number = export_of(&path, &[&asked[..], &["--type", "i32"]].concat(), None);
    number
        .ends(2)
        .says(&["i32 tables have no layout slider-crank"]);
    let pieces = export_of(&path, &[&asked[..], &["--pieces", "60 deg"]].concat(), None);
    pieces
        .ends(2)
        .says(&["a closed form describes a whole turn"]);
    // While the root keeps its digits: (25 + 108)/140 = 0.95.
    for (offset, ends) in [("107 mm", 0), ("109 mm", 1)] {
        let steep = feeder.replace("offset = \"20 mm\"", &format!("offset = \"{offset}\""));
        let run = export_of(&file(steep.clone()), &asked, None).ends(ends);
        if ends == 1 {
            run.says(&["the rod is too short for the closed form", "use a table"]);
        }
        // Without --layout a table is written.
        export_of(&file(steep), &asked[2..], None).ends(0);
    }
    // Too few bytes.
    let more = ["--layout", "slider-crank", "--max-bytes", "147"];
    export_of(&path, &more, None).ends(2).says(&["148 bytes"]);
    let more = ["--layout", "slider-crank", "--max-bytes", "148"];
    export_of(&path, &more, None).ends(0);
}

/// Instruction counts in the summary, of form and table, are at least those of the document and at most a tenth more.
#[test]
fn instructions_are_those_of_the_document() {
    let document = include_str!("../../../../docs/performance.md");
    let more = ["--torque-error", "1 N m", "--layout", "slider-crank"];
    let run = export_of(&shipped("shaking-feeder.toml"), &more, None).ends(0);
    let note = run
        .out
        .lines()
        .find(|line| line.starts_with("instructions at most on a Cortex-M4F"))
        .unwrap();
    for (mark, row) in [
        ("closed form ", "| f32, slider-crank: 10,000 counts"),
        (", cubic ", "| f32, cubic: 10,000 counts"),
        (", spline ", "| f32, spline: 10,000 counts"),
    ] {
        let line = document.lines().find(|line| line.starts_with(row)).unwrap();
        let listed: f64 = line.split('|').nth(4).unwrap().trim().parse().unwrap();
        let said = number_after(note, mark);
        assert!(
            listed <= said && said < 1.1 * listed,
            "{row}: {said}, {listed}"
        );
    }
}
