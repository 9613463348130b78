//! The image against its documentation, docs/table-image.md.

use std::f64::consts::TAU;

use jred::table::Format;
use jred::{Cubic, Image, Phase, Q31, Quadratic, Rows16, Spline, Spline16};

use super::reader::{Read, Reader};
use super::{KINDS, image, images_of};
use crate::support::{Folder, budget, shipped};

/// The library's reading of the same image at these places.
fn library(words: &[u32], kind: (&str, &str), places: &[u32]) -> Vec<Read> {
    let image = Image::new(words).unwrap();
    match kind {
        ("f32", "spline") => long::<Spline<f32>>(&image, places),
        ("f32", "cubic") => long::<Cubic<f32>>(&image, places),
        ("f32", _) => long::<Quadratic<f32>>(&image, places),
        ("i32", "spline") => long::<Spline<Q31>>(&image, places),
        ("i32", "spline16") => long::<Spline16>(&image, places),
        ("i32", "cubic") => long::<Cubic<Q31>>(&image, places),
        ("i32", _) => long::<Quadratic<Q31>>(&image, places),
        _ => long::<Rows16>(&image, places),
    }
}

fn long<F: Format>(image: &Image<'_>, places: &[u32]) -> Vec<Read> {
    let table = image.table::<F>().unwrap();
    let at = |bits: &u32| {
        let phase = Phase::from_bits(*bits);
        let read = table.si(phase, image.domain().to());
        Read {
            inertia: read.inertia,
            slope: read.inertia_slope,
            load: read.load,
            viscous: read.viscous,
            coulomb: read.coulomb,
            reciprocal: table.reciprocal(phase).unwrap_or(0.0),
        }
    };
    places.iter().map(at).collect()
}

fn compare(words: &[u32], kind: (&str, &str)) {
    let reader = Reader::new(words.to_vec());
    let mut largest = Read::default();
    let mut worst = Read::default();
    let places: Vec<u32> = (0..4000)
        .map(|k: u32| k.wrapping_mul(1_073_741).wrapping_add(77) ^ k << 20)
        .collect();
    for (bits, library) in places.iter().zip(library(words, kind, &places)) {
        let found = reader.read(*bits);
        for (worst, most, a, b) in [
            (
                &mut worst.inertia,
                &mut largest.inertia,
                found.inertia,
                library.inertia,
            ),
            (
                &mut worst.slope,
                &mut largest.slope,
                found.slope,
                library.slope,
            ),
            (&mut worst.load, &mut largest.load, found.load, library.load),
            (
                &mut worst.viscous,
                &mut largest.viscous,
                found.viscous,
                library.viscous,
            ),
            (
                &mut worst.coulomb,
                &mut largest.coulomb,
                found.coulomb,
                library.coulomb,
            ),
        ] {
            *worst = worst.max((a - b).abs());
            *most = most.max(b.abs());
        }
    }
    let share = match kind {
        ("f32", _) => budget::DOCUMENT_F32,
        ("i32", "quadratic") => budget::DOCUMENT_SHORT_PLACE,
        ("i32", _) => budget::DOCUMENT_I32,
        _ => budget::DOCUMENT_I16,
    };
    // Units of fixed point are those of the bases, however small a curve is.
    let fixed = f64::from(u8::from(kind.0 != "f32"));
    let [torque, speed, inertia] = [7, 8, 9].map(|word| fixed * reader.float(word));
    let per_position = f64::from(reader.words[4]) / reader.range();
    let per_speed = torque / speed.max(f64::MIN_POSITIVE);
    for (what, worst, most) in [
        ("J", worst.inertia, largest.inertia.max(inertia)),
        ("J'", worst.slope, largest.slope.max(inertia * per_position)),
        ("load", worst.load, largest.load.max(torque)),
        ("b", worst.viscous, largest.viscous.max(per_speed)),
        ("c", worst.coulomb, largest.coulomb.max(torque)),
    ] {
        println!("{kind:?} {what}: {:e} of {most}", worst / most.max(1e-300));
        assert!(worst <= share * most, "{kind:?} {what}: {worst} of {most}");
    }
    assert!(largest.inertia > 0.0 && largest.slope > 0.0);
}

#[test]
fn the_document_gives_the_curves_of_every_type_and_layout() {
    let folder = Folder::new();
    for (number, layout) in KINDS {
        for reciprocal in ["no", "yes"] {
            if number == "f32" && reciprocal == "yes" {
                continue;
            }
            let words = image(
                &folder,
                &[
                    "--type",
                    number,
                    "--layout",
                    layout,
                    "--torque-error",
                    "1 N m",
                    "--reciprocal",
                    reciprocal,
                ],
            );
            compare(&words, (number, layout));
        }
    }
}

/// Strokes, and friction that is a curve, a constant, or both kinds.
#[test]
fn the_document_gives_the_curves_of_other_machines() {
    for (machine, range) in [
        ("cam-translating.toml", [TAU, TAU * TAU]),
        ("excavator-bucket.toml", [0.151, 0.339]),
        ("geneva.toml", [TAU, TAU * TAU]),
    ] {
        let file = shipped(machine);
        for (words, kind) in images_of(&file, 1500, range).iter().zip(KINDS) {
            compare(words, kind);
        }
    }
}

/// The curve of 1/J is J_m/J: their product is the same power of two everywhere.
#[test]
fn the_reciprocal_is_a_power_of_two_over_the_inertia() {
    let folder = Folder::new();
    for (number, layout) in &KINDS[3..] {
        let words = image(
            &folder,
            &[
                "--type",
                number,
                "--layout",
                layout,
                "--torque-error",
                "1 N m",
                "--reciprocal",
                "yes",
            ],
        );
        let reader = Reader::new(words);
        let base = reader.float(9);
        let unit = if *number == "i16" {
            1.0
        } else {
            let read = reader.read(0);
            (read.inertia / base * read.reciprocal)
                .log2()
                .round()
                .exp2()
        };
        let products = (0..2000u32).map(|k| {
            let read = reader.read(k.wrapping_mul(2_147_483));
            read.inertia / base * read.reciprocal / unit
        });
        let worst = products.fold(0.0, |worst: f64, product| worst.max((product - 1.0).abs()));
        println!("{number} {layout}: {worst:e}");
        assert!(
            worst <= budget::RECIPROCAL_SEED,
            "{number} {layout}: {worst}"
        );
    }
}
