//! Damaged images and garbage: every flipped bit refused, nothing panics.

use crate::support::images::{refused, sealed, small, stroke, stroke_in};
use crate::support::{config, samples, value};
use jred::image::{HEADER_WORDS, VERSION};
use jred::number::Quantity;
use jred::table::Format;
use jred::{Cubic, CurveSet, Image, ImageError, Phase, Q31, Quadratic, Spline, curves};
use proptest::prelude::*;

#[test]
fn every_flipped_bit_is_refused() {
    let images = [
        small(),
        stroke(),
        stroke_in::<Cubic<Q31>>(curves::LOAD | curves::RECIPROCAL),
        stroke_in::<Quadratic<f32>>(curves::LOAD | curves::CONSTANT_COULOMB),
    ];
    for image in images {
        assert!(Image::new(&image).is_ok());
        for bit in 0..32 * image.len() {
            let mut damaged = image.clone();
            damaged[bit / 32] ^= 1 << (bit % 32);
            let error = refused(&damaged);
            let expected = match bit / 32 {
                0 => matches!(error, ImageError::NotAnImage(_)),
                1 if bit % 32 < 16 => matches!(error, ImageError::Version { .. }),
                2 => matches!(error, ImageError::Length { .. }),
                _ => matches!(error, ImageError::Crc { .. }),
            };
            assert!(expected, "bit {bit}: {error:?}");
        }
    }
}

#[test]
fn truncated_extended_and_misaligned_images_are_refused() {
    let image = small();
    let needed = image.len() as u32;
    for given in 0..needed {
        let error = refused(&image[..given as usize]);
        let least = HEADER_WORDS as u32 + 1;
        let needed = if given < least { least } else { needed };
        assert_eq!(error, ImageError::Length { needed, given });
    }
    for more in 1..5 {
        let longer = [image.clone(), vec![0; more]].concat();
        assert_eq!(
            refused(&longer),
            ImageError::Length {
                needed,
                given: needed + more as u32
            }
        );
    }
    let bytes: Vec<u8> = image.iter().flat_map(|w| w.to_le_bytes()).collect();
    // One of four positions in a larger buffer is 4-byte aligned; the others are refused.
    let mut buffer = vec![0; bytes.len() + 4];
    for shift in 0..4 {
        buffer[shift..shift + bytes.len()].copy_from_slice(&bytes);
        let place = &buffer[shift..shift + bytes.len()];
        match Image::from_bytes(place) {
            Ok(_) => assert_eq!(place.as_ptr() as usize % 4, 0),
            Err(error) => {
                assert_eq!(error, ImageError::Misaligned);
                assert_ne!(place.as_ptr() as usize % 4, 0);
            }
        }
        for cut in 1..4 {
            let part = Image::from_bytes(&place[..place.len() - cut]).unwrap_err();
            assert_eq!(part, ImageError::Misaligned, "not whole words");
        }
    }
}

/// Ticks a model if there is one; in fixed point a limited acceleration is at an end of the range.
fn tick<F: Format, const SET: CurveSet>(
    image: &Image<'_>,
    state: [F::Number; 2],
    phase: Phase,
    ends: Option<[F::Number; 2]>,
) -> u32 {
    let Ok(model) = image.model::<F, SET>() else {
        return 0;
    };
    let [a, b] = state;
    let omega = Quantity::of(a);
    let torque = model.torque(phase, omega, Quantity::of(b));
    let range = model.acceleration_range(phase, omega, Quantity::of(b), torque);
    for found in [range.least, range.greatest] {
        assert!(!found.saturated || ends.is_some_and(|ends| ends.contains(&found.value.number())));
        assert!(value(found.value).is_finite() && value(torque).is_finite());
    }
    1
}

/// Checking any image neither panics nor overflows (overflow checks are on in debug builds). Returns the number of models ticked.
fn look_at(image: &[u32], state: [i32; 2], phase: Phase) -> u32 {
    const ALL: CurveSet = curves::ALL;
    const SEEDED: CurveSet = curves::VISCOUS | curves::COULOMB | curves::RECIPROCAL;
    let Ok(image) = Image::new(image) else {
        return 0;
    };
    let fixed = state.map(Q31::from_bits);
    let float = state.map(|bits| bits as f32 * 1e-6);
    let ends = Some([Q31::MIN, Q31::MAX]);
    tick::<Spline<Q31>, ALL>(&image, fixed, phase, ends)
        + tick::<Cubic<Q31>, ALL>(&image, fixed, phase, ends)
        + tick::<Quadratic<Q31>, ALL>(&image, fixed, phase, ends)
        + tick::<Spline<Q31>, SEEDED>(&image, fixed, phase, ends)
        + tick::<Quadratic<Q31>, SEEDED>(&image, fixed, phase, ends)
        + tick::<Spline<f32>, ALL>(&image, float, phase, None)
        + tick::<Cubic<f32>, ALL>(&image, float, phase, None)
        + tick::<Quadratic<f32>, ALL>(&image, float, phase, None)
}

proptest! {
    #![proptest_config(config(256, 0x0009))]

    #[test]
    fn garbage_never_panics(garbage in prop::collection::vec(any::<u32>(), 0..60), a: i32, b: i32, bits: u32) {
        look_at(&garbage, [a, b], Phase::from_bits(bits));
    }
}

/// Garbage after a correct header, with a correct CRC: rows with small values are accepted and ticked.
#[test]
fn garbage_with_a_header_never_panics() {
    let rows = prop::collection::vec(any::<i32>(), 64);
    let state = (any::<[i32; 2]>(), any::<u32>(), any::<[i32; 3]>());
    let mut ticked = [[0; 4]; 2];
    for (rows, shift, (code, layout), bases, (state, bits, constants)) in samples(
        4000,
        0x0041,
        &(
            rows,
            0..8,
            (1u8..=2, 1u8..=3),
            any::<Option<[u32; 3]>>(),
            state,
        ),
    ) {
        // Words of a cell, and those of J in it.
        let [words, pitch, own] = [[28, 4, 1], [64, 16, 4], [48, 12, 3]][usize::from(layout) - 1];
        let mut image = vec![0; HEADER_WORDS];
        image[0] = u32::from_le_bytes(*b"JRED");
        image[1] = u32::from(VERSION) | (HEADER_WORDS as u32) << 16;
        image[2] = (HEADER_WORDS + words + 1) as u32;
        // Four curves: all, or b, c and a seed of 1/J.
        let seeded = state[0] % 4 == 0;
        let set: u8 = if seeded { 14 } else { 7 };
        image[3] = u32::from_le_bytes([code, set, layout, 1]);
        image[4] = 4;
        image[6] = 1f32.to_bits();
        // ½·4 cells/1·½ is one.
        let right = [2f32, 1.0, 1.0].map(f32::to_bits);
        image[7..10].copy_from_slice(&bases.unwrap_or(right));
        for (k, (slot, constant)) in image[13..16].iter_mut().zip(constants).enumerate() {
            // A negative friction is refused: it is tried now and then.
            let friction = k > 0 && state[1] % 8 != 0;
            let constant = if friction {
                constant.saturating_abs()
            } else {
                constant
            };
            *slot = if code == 2 {
                (constant >> (6 + shift)) as u32
            } else {
                0
            };
        }
        image.extend(rows.iter().take(words).enumerate().map(|(k, row)| {
            let (column, power) = (k % pitch / own, k % own);
            let row = match (column, power) {
                // The inertia, which must be positive; and a seed close to its reciprocal.
                (0, 0) => (row >> 10) + (1 << if own == 1 { 26 } else { 28 }),
                (0, _) => row >> 8,
                (3, 0) if seeded => (row >> 9) + if own == 1 { (1 << 28) / 3 * 2 } else { 1 << 30 },
                (3, _) if seeded => row >> 10,
                _ => row >> (3 + shift),
            };
            if code == 2 {
                row as u32
            } else {
                (row as f32 * 1e-9).to_bits()
            }
        }));
        image.push(0);
        let image = sealed(image);
        assert!(bases.is_some() || Image::new(&image).is_ok());
        let place = if seeded { 3 } else { usize::from(layout) - 1 };
        ticked[usize::from(code) - 1][place] += look_at(&image, state, Phase::from_bits(bits));
    }
    println!("ticked: {ticked:?}");
    // For f32 and i32; the last are seeds, which f32 lacks.
    assert!(ticked[0][..3].iter().all(|count| *count > 50), "{ticked:?}");
    assert!(ticked[1].iter().all(|count| *count > 50), "{ticked:?}");
    assert_eq!(ticked[0][3], 0);
}
