//! The table image: layout, bit-exact round trips, and what is refused when reading or writing it.

mod support;

use jred::table::curves;
use jred::tabulate::{Request, Tabulated};
use jred::{
    Domain, Error, Image, ImageError, Model, Phase, Q31, Scalar, Scale, Table, TableError, VERSION,
    encode, image_words,
};
use proptest::prelude::*;
use support::images::{VALIDITY, crc32, refused, sealed, small, stroke};
use support::machines::{Spec, Wave, spec};
use support::{config, model, number, words};

#[test]
fn known_crc_and_layout() {
    // The check value of CRC-32/ISO-HDLC is that of "123456789"; here of its first eight bytes, by zlib.
    assert_eq!(
        crc32(&[u32::from_le_bytes(*b"1234"), u32::from_le_bytes(*b"5678")]),
        0x9AE0_DAAF
    );
    let image = small();
    assert_eq!(image.len(), 16 + 7 + 1);
    assert_eq!(image[0].to_le_bytes(), *b"JRED");
    assert_eq!(image[1], u32::from(VERSION) | 16 << 16);
    assert_eq!(image[2], 24);
    assert_eq!(image[3].to_le_bytes(), [1, 0, 1, 0]);
    assert_eq!(image[4], 4);
    let numbers = [7, 8, 9, 10, 11, 12].map(|k: usize| f32::from_bits(image[k]));
    assert_eq!(
        numbers.map(f32::to_bits),
        [1.0f32, 1.0, 1.0, 10.0, 100.0, 0.01].map(f32::to_bits)
    );
    assert_eq!(image[23], crc32(&image[..23]));
    let image = stroke();
    assert_eq!(image[3].to_le_bytes(), [2, 7, 1, 1]);
    assert_eq!([image[5], image[6]], [-0.5f32, 1.5].map(f32::to_bits));
    let read = Image::new(&image).unwrap();
    assert_eq!(
        (read.cells(), read.curves(), read.validity()),
        (12, 7, VALIDITY)
    );
    assert_eq!(
        read.domain(),
        Domain::Stroke {
            from: -0.5,
            to: 1.5
        }
    );
    assert_eq!(*read.scale(), Scale::new(60.0, 11.0, 2.0).unwrap());
    let found = Tabulated {
        cells: 12,
        torque_error: 0.01,
        worst: 1.0,
    };
    let request = Request {
        torque_error: 0.02,
        omega: 10.0,
        alpha: 100.0,
        max_cells: 64,
    };
    assert_eq!(found.validity(&request), VALIDITY);
}

fn same_bits<S: Scalar>(spec: &Spec, bits: u32, omega: f64, alpha: f64) {
    let machine = spec.machine();
    let scale = Scale::covering(&machine, 60.0, 900.0, 64).unwrap();
    let rows = words::<S, { curves::ALL }>(&machine, 64, &scale).unwrap();
    let before = model::<S, { curves::ALL }>(&rows, 64, Domain::Turn, &scale);
    let mut buffer = vec![0; image_words(64, curves::ALL)];
    let image = encode(before.table(), Domain::Turn, &scale, VALIDITY, &mut buffer).unwrap();
    let image = Image::new(image).unwrap();
    assert_eq!(*image.scale(), scale);
    let after: Model<'_, S, { curves::ALL }> = image.model().unwrap();
    assert_eq!(after.table().words(), rows);
    let (phase, omega, alpha) = (Phase::from_bits(bits), number(omega), number(alpha));
    assert_eq!(
        after.torque(phase, omega, alpha),
        before.torque(phase, omega, alpha)
    );
    assert_eq!(
        after.acceleration(phase, omega, alpha),
        before.acceleration(phase, omega, alpha)
    );
}

/// Another magic, version and length are named even with a right CRC.
#[test]
fn other_kinds_of_image_are_named() {
    let with = |word: usize, value: u32| {
        let mut image = small();
        image[word] = value;
        refused(&sealed(image))
    };
    assert_eq!(with(0, 0x1234), ImageError::NotAnImage(0x1234));
    assert_eq!(
        with(1, 2 | 16 << 16),
        ImageError::Version {
            found: 2,
            supported: VERSION
        }
    );
    assert_eq!(
        with(2, 25),
        ImageError::Length {
            needed: 25,
            given: 24
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
        with(&turn, 1, u32::from(VERSION) | 17 << 16),
        ImageError::Header(1),
        "another header length"
    );
    assert_eq!(
        with(&turn, 3, kind(1, 0, 2, 0)),
        ImageError::Header(3),
        "another interpolant"
    );
    assert_eq!(
        with(&turn, 3, kind(1, 8, 1, 0)),
        ImageError::Header(3),
        "an unknown curve"
    );
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
    for word in [13, 14, 15] {
        assert_eq!(with(&turn, word, 1), ImageError::Header(13), "reserved");
    }
    // Bases that are numbers, but whose acceleration or velocity torque is none.
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

fn no_model<S: Scalar, const CURVES: u8>(image: Vec<u32>) -> ImageError {
    let image = sealed(image);
    Image::new(&image)
        .unwrap()
        .model::<S, CURVES>()
        .unwrap_err()
}

#[test]
fn model_of_another_type_or_of_an_unsound_table_is_refused() {
    assert_eq!(no_model::<Q31, 0>(small()), ImageError::NumberType(1));
    assert_eq!(no_model::<f64, 0>(small()), ImageError::NumberType(1));
    assert_eq!(no_model::<f32, 7>(stroke()), ImageError::NumberType(2));
    assert_eq!(no_model::<f32, 1>(small()), ImageError::Curves(0));
    assert_eq!(no_model::<Q31, 3>(stroke()), ImageError::Curves(7));
    let with = |word: usize, value: u32| {
        let mut image = small();
        image[word] = value;
        no_model::<f32, 0>(image)
    };
    assert_eq!(
        with(3, u32::from_le_bytes([9, 0, 1, 0])),
        ImageError::NumberType(9)
    );
    let table = |error| ImageError::Table(error);
    assert_eq!(with(4, 3), table(TableError::Cells(3)));
    assert_eq!(with(4, u32::MAX), table(TableError::Cells(u32::MAX)));
    assert_eq!(
        with(4, 5),
        table(TableError::Length {
            needed: 8,
            given: 7
        })
    );
    assert_eq!(
        with(16 + 3, f32::NAN.to_bits()),
        table(TableError::Range { curve: 0, cell: 0 })
    );
    assert_eq!(
        with(16 + 3, (-1f32).to_bits()),
        table(TableError::NoInertia { cell: 0 })
    );
    assert_eq!(
        with(16, 0.2f32.to_bits()),
        table(TableError::NotClosed { curve: 0 })
    );
    let mut fast = stroke();
    fast[8] = 3e4f32.to_bits();
    assert!(matches!(
        no_model::<Q31, 7>(fast),
        ImageError::Table(TableError::VelocityTorque { .. })
    ));
}

#[test]
fn encoding_needs_room_and_a_stored_number_type() {
    let words = words::<f64, 0>(&Wave::bare(1.0, 0.0), 4, &Scale::SI).unwrap();
    let table = Table::<f64>::new(&words, 0, 4, true).unwrap();
    let mut buffer = [0; 24];
    assert!(encode(&table, Domain::Turn, &Scale::SI, VALIDITY, &mut buffer).is_err());
    let words = support::words::<f32, 0>(&Wave::bare(1.0, 0.0), 4, &Scale::SI).unwrap();
    let table = Table::<f32>::new(&words, 0, 4, true).unwrap();
    let error = encode(
        &table,
        Domain::Turn,
        &Scale::SI,
        VALIDITY,
        &mut buffer[..23],
    )
    .unwrap_err();
    assert_eq!(
        error,
        Error::BufferTooShort {
            needed: 24,
            given: 23
        }
    );
}

proptest! {
    #![proptest_config(config(256, 0x0007))]

    #[test]
    fn round_trip_is_bit_exact(spec in spec(), bits: u32, omega in -0.9..0.9, alpha in -0.9..0.9) {
        same_bits::<f32>(&spec, bits, omega, alpha);
        same_bits::<Q31>(&spec, bits, omega, alpha);
    }
}

#[test]
fn tables_of_f64_have_no_image() {
    let words = [1.0f64 / 6.0; 7];
    let table = Table::<f64>::new(&words, curves::INERTIA, 4, true).unwrap();
    let mut buffer = [0; image_words(4, curves::INERTIA)];
    let error = encode(&table, Domain::Turn, &Scale::SI, VALIDITY, &mut buffer).unwrap_err();
    assert_eq!(error, Error::NoImage("f64"));
    assert!(error.to_string().contains("use f32 or q31"), "{error}");
}
