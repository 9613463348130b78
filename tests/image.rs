//! The table image: its words, bit-exact round trips, and refusals.

use crate::support::images::{VALIDITY, crc32, small, stroke, stroke_in};
use crate::support::machines::{Spec, Wave, spec};
use crate::support::rows::Rows;
use crate::support::{config, quantity, samples, scale_of};
use jred::image::{HEADER_WORDS, VERSION, encode, identify, image_len};
use jred::table::Format;
use jred::tabulate::{Request, TableFigures};
use jred::{
    Cubic, CurveSet, Domain, Image, ImageError, Model, Phase, Q31, Quadratic, Scale, Spline, curves,
};
use proptest::prelude::*;

/// Words of the smallest image: header, seven points, CRC.
const SMALL: u32 = 24 + 7 + 1;

#[test]
fn known_crc_and_layout() {
    // The check value of CRC-32/ISO-HDLC is that of "123456789"; here of its first eight bytes, by zlib.
    assert_eq!(
        crc32(&[u32::from_le_bytes(*b"1234"), u32::from_le_bytes(*b"5678")]),
        0x9AE0_DAAF
    );
    let image = small();
    assert_eq!((HEADER_WORDS, VERSION), (24, 2));
    assert_eq!(image.len(), 24 + 7 + 1);
    assert_eq!(image[0].to_le_bytes(), *b"JRED");
    assert_eq!(image[1], 2 | 24 << 16);
    assert_eq!(image[2], SMALL);
    assert_eq!(image[3].to_le_bytes(), [1, 0, 1, 0]);
    assert_eq!(image[4], 4);
    let numbers = [7, 8, 9, 10, 11, 12].map(|k: usize| f32::from_bits(image[k]));
    assert_eq!(
        numbers.map(f32::to_bits),
        [1.0f32, 1.0, 1.0, 10.0, 100.0, 0.01].map(f32::to_bits)
    );
    assert_eq!(image[31], crc32(&image[..31]));
    let image = stroke();
    assert_eq!(image[3].to_le_bytes(), [2, 7, 1, 1]);
    assert_eq!([image[5], image[6]], [-0.5f32, 1.5].map(f32::to_bits));
    let read = Image::new(&image).unwrap();
    assert_eq!(
        (read.cells(), read.set(), read.validity()),
        (12, 7, VALIDITY)
    );
    assert_eq!(
        read.domain(),
        Domain::Stroke {
            from: -0.5,
            to: 1.5
        }
    );
    let scale = scale_of(60.0, 11.0, 2.0);
    assert_eq!(*read.scale(), scale.for_cells(12, 2.0));
    let mut found = TableFigures::default();
    found.cells = 12;
    found.torque_error = 0.01;
    let request = Request::new(0.02)
        .with_max_speed(10.0)
        .with_max_acceleration(100.0)
        .with_max_cells(64);
    assert_eq!(found.validity(&request), VALIDITY);
}

fn same_bits<F: Format, const SET: CurveSet>(spec: &Spec, bits: u32, state: [f64; 2]) {
    let machine = spec.machine();
    let scale = Scale::covering(&machine, 60.0, 900.0, 64).unwrap();
    let scale = scale.for_cells(90, std::f64::consts::TAU);
    let rows = Rows::<F>::of(&machine, SET, 90, &scale).unwrap();
    let before = rows.model::<SET>(&scale);
    let mut buffer = vec![u32::MAX; image_len::<F>(90, SET)];
    let image = encode(before.table(), VALIDITY, &mut buffer).unwrap();
    let image = Image::new(image).unwrap();
    assert_eq!(*image.scale(), scale);
    let after: Model<'_, F, SET> = image.model().unwrap();
    assert_eq!(after.table().words(), rows.words);
    assert_eq!(*after.table().constants(), rows.constants);
    assert_eq!(image.table::<F>().unwrap().set(), SET);
    let (phase, [omega, alpha]) = (Phase::from_bits(bits), state);
    let (omega, torque) = (quantity(omega), quantity(alpha));
    let alpha = quantity(alpha);
    assert_eq!(
        after.torque(phase, omega, alpha),
        before.torque(phase, omega, alpha)
    );
    assert_eq!(
        after.acceleration(phase, omega, torque),
        before.acceleration(phase, omega, torque)
    );
}

#[test]
fn an_image_is_of_its_machine() {
    let machine = Wave::bare(1.0, 0.0);
    let mut buffer = [0; SMALL as usize];
    let rows = Rows::<Spline<f32>>::of(&machine, 0, 4, &Scale::SI).unwrap();
    encode(&rows.table(), VALIDITY, &mut buffer).unwrap();
    assert_eq!(Image::new(&buffer).unwrap().machine(), 0);
    identify(&mut buffer, 0x1a2b_3c4d).unwrap();
    // Only word 19 and the CRC change.
    assert_eq!(buffer[19], 0x1a2b_3c4d);
    let image = Image::new(&buffer).unwrap();
    assert_eq!(image.machine(), 0x1a2b_3c4d);
    let model: Model<'_, Spline<f32>, 0> = image.of_machine(0x1a2b_3c4d).unwrap().model().unwrap();
    assert_eq!(model.table().words(), rows.words);
    let other = image.of_machine(7).unwrap_err();
    let (found, expected) = (0x1a2b_3c4d, 7);
    assert_eq!(other, ImageError::Machine { found, expected });
    assert_eq!(
        format!("{other}; {}", other.cure()),
        "the image is of the machine 0x1a2b3c4d, not of 0x00000007; load the image that was exported for this machine"
    );
    // Words that are not an image get no identifier.
    buffer[24] ^= 1;
    let damaged = buffer;
    assert!(matches!(
        identify(&mut buffer, 7),
        Err(ImageError::Crc { .. })
    ));
    assert_eq!(buffer, damaged);
}

#[test]
fn encoding_needs_room_and_a_stored_number_type() {
    let machine = Wave::bare(1.0, 0.0);
    let mut buffer = [0; SMALL as usize];
    let rows = Rows::<Spline<f64>>::of(&machine, 0, 4, &Scale::SI).unwrap();
    let error = encode(&rows.table(), VALIDITY, &mut buffer).unwrap_err();
    assert_eq!(error, ImageError::NotStored("f64"));
    assert!(error.cure().to_string().contains("use f32"), "{error}");
    let rows = Rows::<Spline<f32>>::of(&machine, 0, 4, &Scale::SI).unwrap();
    let short = &mut buffer[..SMALL as usize - 1];
    let error = encode(&rows.table(), VALIDITY, short).unwrap_err();
    assert_eq!(
        error,
        ImageError::BufferTooShort {
            needed: 32,
            given: 31
        }
    );
    assert!(encode(&rows.table(), VALIDITY, &mut buffer).is_ok());
}

proptest! {
    #![proptest_config(config(256, 0x0007))]

    #[test]
    fn round_trip_is_bit_exact(spec in spec(), bits: u32, omega in -0.9..0.9, alpha in -0.9..0.9) {
        let state = [omega, alpha];
        same_bits::<Spline<f32>, { curves::ALL }>(&spec, bits, state);
        same_bits::<Quadratic<f32>, { curves::LOAD | curves::CONSTANT_VISCOUS }>(&spec, bits, state);
        same_bits::<Cubic<f32>, { curves::COULOMB }>(&spec, bits, state);
        same_bits::<Spline<Q31>, { curves::ALL }>(&spec, bits, state);
        same_bits::<Cubic<Q31>, { curves::LOAD | curves::VISCOUS | curves::CONSTANT_COULOMB }>(&spec, bits, state);
        same_bits::<Quadratic<Q31>, { curves::ALL }>(&spec, bits, state);
    }
}

/// With the curve of 1/J, and constants or curves next to it.
#[test]
fn round_trip_of_every_curve_is_bit_exact() {
    const EVERY: CurveSet = curves::ALL | curves::RECIPROCAL;
    const CONSTANTS: CurveSet =
        curves::LOAD | curves::CONSTANT_VISCOUS | curves::CONSTANT_COULOMB | curves::RECIPROCAL;
    for spec in samples(3, 0x0007, &spec()) {
        same_bits::<Spline<Q31>, EVERY>(&spec, 0x1234_5678, [0.3, -0.2]);
        same_bits::<Cubic<Q31>, EVERY>(&spec, 0x8765_4321, [-0.3, 0.2]);
        same_bits::<Spline<Q31>, CONSTANTS>(&spec, 0x1234_5678, [0.3, -0.2]);
        same_bits::<Cubic<Q31>, CONSTANTS>(&spec, 0x8765_4321, [-0.3, 0.2]);
    }
    let reciprocal = stroke_in::<Quadratic<Q31>>(curves::RECIPROCAL);
    let image = Image::new(&reciprocal).unwrap();
    assert!(
        image
            .model::<Quadratic<Q31>, { curves::RECIPROCAL }>()
            .is_ok()
    );
}
