//! Intact table images of another kind, without meaning or without a valid table.

use crate::support::images::{refused, sealed, small, stroke, stroke_in};
use jred::image::{HEADER_WORDS, VERSION};
use jred::table::{Format, TableError};
use jred::{Cubic, CurveSet, Image, ImageError, Q31, Quadratic, Spline, curves};

/// Words of the smallest image: header, seven points, CRC.
const SMALL: u32 = HEADER_WORDS as u32 + 7 + 1;

/// Another magic, version or length is named even with a correct CRC.
#[test]
fn other_kinds_of_image_are_named() {
    let with = |word: usize, value: u32| {
        let mut image = small();
        image[word] = value;
        refused(&sealed(image))
    };
    assert_eq!(with(0, 0x1234), ImageError::NotAnImage(0x1234));
    assert_eq!(
        with(1, 1 | 16 << 16),
        ImageError::Version {
            found: 1,
            supported: VERSION
        }
    );
    assert_eq!(
        with(2, SMALL + 1),
        ImageError::Length {
            needed: SMALL + 1,
            given: SMALL
        }
    );
}

#[test]
fn meaningless_header_words_are_refused() {
    let with = |image: &[u32], word: usize, value: u32| {
        let mut image = image.to_vec();
        image[word] = value;
        refused(&sealed(image))
    };
    let kind =
        |code, set, interpolant, domain| u32::from_le_bytes([code, set, interpolant, domain]);
    let [turn, stroke] = [small(), stroke()];
    assert_eq!(
        with(&turn, 1, u32::from(VERSION) | 16 << 16),
        ImageError::Header(1),
        "another header length"
    );
    for set in [64, 128, 255] {
        assert_eq!(
            with(&turn, 3, kind(1, set, 1, 0)),
            ImageError::Header(3),
            "an unknown curve"
        );
    }
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(
            with(&stroke, 5, value.to_bits()),
            ImageError::Header(5),
            "from {value}"
        );
    }
    for value in [f32::NAN, f32::INFINITY, -0.5, -1.0] {
        assert_eq!(
            with(&stroke, 6, value.to_bits()),
            ImageError::Header(5),
            "to {value}"
        );
    }
    for (word, first) in [(7, 7), (8, 7), (9, 7)] {
        for value in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert_eq!(
                with(&turn, word, value.to_bits()),
                ImageError::Header(first),
                "base {value}"
            );
        }
    }
    for word in [10, 11, 12] {
        for value in [-1.0, f32::NAN, f32::INFINITY] {
            assert_eq!(
                with(&turn, word, value.to_bits()),
                ImageError::Header(10),
                "limit {value}"
            );
        }
    }
    // Finite bases whose acceleration or velocity torque is not finite.
    assert_eq!(with(&turn, 7, 1e-45f32.to_bits()), ImageError::Header(7));
    assert_eq!(with(&turn, 8, 1e30f32.to_bits()), ImageError::Header(7));
}

/// The code of the domain is a byte of word 3.
#[test]
fn unknown_domain_is_refused_with_its_word() {
    let mut image = small();
    image[3] |= 2 << 24;
    assert_eq!(refused(&sealed(image)), ImageError::Header(3));
}

/// The cure for every fault of an image.
#[test]
fn a_refused_image_says_what_to_do() {
    for (error, cure) in [
        (ImageError::Misaligned, "include_image!"),
        (ImageError::BigEndian, "little-endian"),
        (
            ImageError::Length {
                needed: 100,
                given: 99,
            },
            "all words",
        ),
        (ImageError::NotAnImage(0), "--format image"),
        (
            ImageError::Version {
                found: 1,
                supported: 2,
            },
            "export the table again",
        ),
        (
            ImageError::Crc {
                stored: 1,
                computed: 2,
            },
            "load the image again",
        ),
        (ImageError::Header(3), "export the table again"),
        (ImageError::NumberType(2), "--type"),
        (ImageError::Layout(4), "--layout"),
        (
            ImageError::Machine {
                found: 1,
                expected: 2,
            },
            "this machine",
        ),
        (ImageError::NotStored("f64"), "f32 or i32"),
        (ImageError::TooLong { given: 400 }, "--max-bytes"),
        (
            ImageError::BufferTooShort {
                needed: 100,
                given: 99,
            },
            "100 words",
        ),
    ] {
        let text = error.cure().to_string();
        assert!(
            text.contains(cure),
            "{error}: \"{text}\" does not say \"{cure}\""
        );
    }
}

fn no_model<F: Format, const SET: CurveSet>(image: Vec<u32>) -> ImageError {
    let image = sealed(image);
    let image = Image::new(&image).unwrap();
    image.model::<F, SET>().map(|_| ()).unwrap_err()
}

#[test]
fn model_of_another_type_set_or_layout_is_refused() {
    let table = ImageError::Table;
    assert_eq!(
        no_model::<Spline<Q31>, 0>(small()),
        ImageError::NumberType(1)
    );
    assert_eq!(
        no_model::<Spline<f64>, 0>(small()),
        ImageError::NumberType(1)
    );
    assert_eq!(
        no_model::<Spline<f32>, 7>(stroke()),
        ImageError::NumberType(2)
    );
    assert_eq!(
        no_model::<Spline<f32>, 1>(small()),
        table(TableError::Curves(0))
    );
    assert_eq!(
        no_model::<Spline<Q31>, 3>(stroke()),
        table(TableError::Curves(7))
    );
    let layout = ImageError::Layout;
    assert_eq!(no_model::<Cubic<f32>, 0>(small()), layout(1));
    assert_eq!(no_model::<Quadratic<f32>, 0>(small()), layout(1));
    let cubic = stroke_in::<Cubic<Q31>>(curves::ALL);
    assert_eq!(no_model::<Spline<Q31>, 7>(cubic.clone()), layout(2));
    assert_eq!(no_model::<Quadratic<Q31>, 7>(cubic.clone()), layout(2));
    let quadratic = stroke_in::<Quadratic<f32>>(curves::ALL);
    assert_eq!(no_model::<Cubic<f32>, 7>(quadratic), layout(3));
    for (code, set, other) in [(9, 0, 1), (0, 0, 1), (255, 63, 3)] {
        let mut image = small();
        image[3] = u32::from_le_bytes([code, set, other, 0]);
        let refused = no_model::<Spline<f32>, 0>(image);
        assert_eq!(refused, ImageError::NumberType(code));
    }
    for other in [0, 9, 255] {
        let mut image = small();
        image[3] = u32::from_le_bytes([1, 0, other, 0]);
        assert_eq!(no_model::<Spline<f32>, 0>(image), layout(other));
    }
}

#[test]
fn model_of_an_unsound_table_is_refused() {
    const RECIPROCAL: CurveSet = curves::RECIPROCAL;
    let with = |word: usize, value: u32| {
        let mut image = small();
        image[word] = value;
        no_model::<Spline<f32>, 0>(image)
    };
    let table = ImageError::Table;
    let row = HEADER_WORDS;
    assert_eq!(with(4, 3), table(TableError::Cells(3)));
    assert_eq!(with(4, 65_536), table(TableError::Cells(65_536)));
    assert_eq!(with(4, u32::MAX), table(TableError::Cells(u32::MAX)));
    assert_eq!(
        with(4, 5),
        table(TableError::Length {
            needed: 8,
            given: 7
        })
    );
    assert_eq!(
        with(row + 3, f32::NAN.to_bits()),
        table(TableError::Range { curve: 0, cell: 0 })
    );
    assert_eq!(
        with(row + 3, (-2f32).to_bits()),
        table(TableError::NoInertia { cell: 0 })
    );
    assert_eq!(
        with(row, 0.2f32.to_bits()),
        table(TableError::NotClosed { curve: 0 })
    );
    // The constant of J.
    assert_eq!(
        with(13, (-1f32).to_bits()),
        table(TableError::NoInertia { cell: 0 })
    );
    assert_eq!(
        with(13, f32::NAN.to_bits()),
        table(TableError::Range { curve: 0, cell: 0 })
    );
    let mut fast = stroke();
    fast[8] = 3e4f32.to_bits();
    assert_eq!(
        no_model::<Spline<Q31>, 7>(fast),
        table(TableError::SpeedBase)
    );
    let mut wrong = stroke_in::<Cubic<Q31>>(RECIPROCAL);
    wrong[row + 4] /= 2; // 1/J in cell 0 then has another unit than in cell 1
    assert_eq!(
        no_model::<Cubic<Q31>, RECIPROCAL>(wrong),
        table(TableError::Reciprocal { cell: 1 })
    );
    let mut heavy = stroke_in::<Spline<Q31>>(curves::CONSTANT_COULOMB);
    heavy[15] = 1 << 29;
    assert_eq!(
        no_model::<Spline<Q31>, { curves::CONSTANT_COULOMB }>(heavy),
        table(TableError::TorqueRange { cell: 0 })
    );
}
