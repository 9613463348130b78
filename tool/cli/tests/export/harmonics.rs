//! Harmonics: exported, loaded, ticked; refused if a table is needed.

use jred::harmonic::terms;
use jred::machine::Reducible as _;
use jred::{CurveSet, Harmonic, Image, ImageError, Phase, Spline, curves};

use super::images::{machine, random};
use super::{export, export_of, number_after, words_of};
use crate::support::{Folder, budget, press_file, shipped};

/// The press without its pressing force, whose steep edges need a table.
fn smooth(folder: &Folder) -> std::path::PathBuf {
    let text = std::fs::read_to_string(press_file()).unwrap();
    let (before, rest) = text.split_once("# Pressing force").unwrap();
    let (_, after) = rest.split_once("[[load]]").unwrap();
    let (_, after) = after.split_once("[[load]]").unwrap();
    folder.file("smooth.toml", format!("{before}[[load]]{after}"))
}

/// J is even; the load of the weight and the friction F·x′ are odd.
const SET: CurveSet = curves::LOAD
    | curves::COULOMB
    | curves::CONSTANT_VISCOUS
    | terms::INERTIA_COS
    | terms::LOAD_SIN
    | terms::COULOMB_SIN;

#[test]
fn an_image_of_harmonics_holds_its_error() {
    let folder = Folder::new();
    let path = smooth(&folder);
    let file = jred_analysis::checked::read(&path).unwrap();
    let machine = machine(&file);
    let mut before = 0;
    for (allowed, more) in [(2.0, "256"), (0.05, "256"), (0.001, "32")] {
        let out = folder.path("harmonics.jred");
        let error = format!("{allowed} N m");
        let run = export_of(
            &path,
            &[
                "--layout",
                "harmonic",
                "--torque-error",
                &error,
                "--max-cells",
                more,
            ],
            Some(&out),
        )
        .ends(0);
        let words = words_of(&out);
        let image = Image::new(&words).unwrap();
        let stated = f64::from(image.validity().torque_error);
        assert!(stated <= allowed, "{stated} of {allowed}");
        assert!(
            image.cells() > before,
            "a smaller error needs more harmonics"
        );
        before = image.cells();
        assert!(4 * words.len() < 300, "{} words", words.len());
        let printed = number_after(&run.out, "f32, layout harmonic, ");
        assert_eq!(printed, f64::from(image.cells()));
        assert!(run.out.contains(
            "image.model::<Harmonic<f32>, { curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS | \
             harmonic::terms::INERTIA_COS | harmonic::terms::LOAD_SIN | harmonic::terms::COULOMB_SIN }>()"
        ));
        let model = image.model::<Harmonic<f32>, SET>().unwrap();
        let any = image.any_model::<Harmonic<f32>>().unwrap();
        let mut random = random();
        let mut worst = 0.0f64;
        for _ in 0..20_000 {
            let phase = Phase::from_bits((random() * 4_294_967_296.0) as u32);
            let mut signed = |most: f32| most * (2.0 * random() - 1.0) as f32;
            let (omega, alpha) = (
                signed(image.validity().max_speed),
                signed(image.validity().max_acceleration),
            );
            let found = model.torque(phase, omega, alpha);
            assert_eq!(found, any.torque(phase, omega, alpha));
            let exact = machine.reduction(phase.radians()).unwrap();
            let exact = exact.torque(omega.into(), alpha.into()).total();
            worst = worst.max((f64::from(found) - exact).abs());
        }
        assert!(
            worst <= stated * (1.0 + budget::BETWEEN_PLACES),
            "{worst} above {stated}"
        );
        assert!(worst > stated / 10.0, "{worst} far below {stated}");
        // Another format or set is refused, not misread.
        assert!(matches!(
            image.model::<Spline<f32>, { curves::LOAD }>(),
            Err(ImageError::Layout(6))
        ));
        assert!(matches!(
            image.model::<Harmonic<f32>, { curves::LOAD }>(),
            Err(ImageError::Table(jred::table::TableError::Curves(SET)))
        ));
    }
}

#[test]
fn the_most_exact_harmonics_for_their_bytes() {
    let folder = Folder::new();
    let path = smooth(&folder);
    let mut before = f64::INFINITY;
    for bytes in ["140", "180"] {
        let out = folder.path("harmonics.jred");
        let arguments = ["--layout", "harmonic", "--max-bytes", bytes];
        export_of(&path, &arguments, Some(&out)).ends(0);
        let words = words_of(&out);
        assert!(4 * words.len() <= bytes.parse().unwrap());
        let image = Image::new(&words).unwrap();
        let error = f64::from(image.validity().torque_error);
        assert!(error < 0.5 * before, "{error} after {before}");
        before = error;
    }
}

/// Coefficients reach any error, but ticks in single precision have a floor.
#[test]
fn the_floor_of_single_precision_is_named() {
    let folder = Folder::new();
    let arguments = ["--layout", "harmonic", "--torque-error", "1e-5 N m"];
    let run = export_of(&smooth(&folder), &arguments, None).ends(1);
    run.says(&["this is the rounding floor of f32: more harmonics do not lower it"]);
    let reached = number_after(&run.message(), " harmonics reach ");
    assert!((1e-5..1e-4).contains(&reached), "{reached}");
}

#[test]
fn what_has_an_edge_or_a_stroke_is_refused() {
    let folder = Folder::new();
    let harmonic = ["--layout", "harmonic", "--torque-error", "0.05 N m"];
    let (run, _) = export(&folder, &[&harmonic[..], &["--max-cells", "8"]].concat());
    run.ends(1)
        .says(&["harmonics reach a torque error", "needs a table"]);
    let stroke = shipped("linear-gripper.toml");
    let arguments = ["--layout", "harmonic", "--torque-error", "2 N"];
    export_of(&stroke, &arguments, None)
        .ends(1)
        .says(&["stroke", "use a table"]);
    // Single precision only.
    let (run, _) = export(&folder, &[&harmonic[..], &["--type", "i32"]].concat());
    run.ends(2).says(&["i32 tables have no layout harmonic"]);
}
