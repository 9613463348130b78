//! Damaged images and garbage: every flipped bit refused, nothing panics.

mod support;

use jred::table::curves;
use jred::{HEADER_WORDS, Image, ImageError, Phase, Q31, VERSION};
use proptest::prelude::*;
use support::images::{refused, sealed, small, stroke};
use support::{config, samples};

#[test]
fn every_flipped_bit_is_refused() {
    for image in [small(), stroke()] {
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
    for given in 0..24u32 {
        let error = refused(&image[..given as usize]);
        let needed = if given < 17 {
            HEADER_WORDS as u32 + 1
        } else {
            24
        };
        assert_eq!(error, ImageError::Length { needed, given });
    }
    for more in 1..5 {
        let longer = [image.clone(), vec![0; more]].concat();
        assert_eq!(
            refused(&longer),
            ImageError::Length {
                needed: 24,
                given: 24 + more as u32
            }
        );
    }
    let bytes: Vec<u8> = image.iter().flat_map(|w| w.to_le_bytes()).collect();
    // One of four places in a larger buffer is on a 4-byte boundary; every other one is refused.
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

/// Whatever an image holds, looking at it neither panics nor overflows (overflow checks are on in debug builds).
/// Returns how many models there were to tick.
fn look_at(image: &[u32], state: [i32; 2], phase: Phase) -> u32 {
    let Ok(image) = Image::new(image) else {
        return 0;
    };
    let fixed = image.model::<Q31, { curves::ALL }>();
    let float = image.model::<f32, { curves::ALL }>();
    if let Ok(model) = &fixed {
        let [a, b] = state.map(Q31::from_bits);
        let ticks = [model.torque(phase, a, b), model.acceleration(phase, a, b)];
        assert!(
            ticks
                .iter()
                .all(|t| !t.saturated || [Q31::MIN, Q31::MAX].contains(&t.value)),
            "{ticks:?}"
        );
    }
    if let Ok(model) = &float {
        let [a, b] = state.map(|bits| bits as f32 * 1e-6);
        let ticks = [model.torque(phase, a, b), model.acceleration(phase, a, b)];
        assert!(
            ticks.iter().all(|t| t.value.is_finite() && !t.saturated),
            "{ticks:?}"
        );
    }
    u32::from(fixed.is_ok()) + u32::from(float.is_ok())
}

proptest! {
    #![proptest_config(config(256, 0x0009))]

    #[test]
    fn garbage_never_panics(garbage in prop::collection::vec(any::<u32>(), 0..60), a: i32, b: i32, bits: u32) {
        look_at(&garbage, [a, b], Phase::from_bits(bits));
    }
}

/// Garbage behind a header that is right, with a right CRC: small enough rows are let in and ticked.
#[test]
fn garbage_with_a_header_never_panics() {
    let rows = prop::collection::vec(any::<i32>(), 28);
    let state = (any::<[i32; 2]>(), any::<u32>());
    let mut ticked = [0, 0];
    for (rows, shift, code, bases, (state, bits)) in samples(
        2000,
        0x0041,
        &(rows, 0..8, 1u8..=2, any::<Option<[u32; 3]>>(), state),
    ) {
        let mut image = vec![0; HEADER_WORDS];
        image[0] = u32::from_le_bytes(*b"JRED");
        image[1] = u32::from(VERSION) | 16 << 16;
        image[2] = 16 + 28 + 1;
        image[3] = u32::from_le_bytes([code, 7, 1, 1]);
        image[4] = 4;
        image[6] = 1f32.to_bits();
        let right = [1f32, 0.5, 1.0].map(f32::to_bits);
        image[7..10].copy_from_slice(&bases.unwrap_or(right));
        image.extend(rows.iter().enumerate().map(|(k, row)| {
            // Every fourth is of the inertia, which is to be positive.
            let row = if k % 4 == 0 {
                (row >> 8) + (1 << 26)
            } else {
                row >> (2 + shift)
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
        ticked[usize::from(code) - 1] += look_at(&image, state, Phase::from_bits(bits));
    }
    println!("ticked: {ticked:?}");
    assert!(ticked.iter().all(|count| *count > 100), "{ticked:?}");
}
