//! Images checked in slices, and slots that receive an image in pieces: the verdicts and the bits equal those of an image in flash.

use crate::support::images::{VALIDITY, in_slices, sealed, small, stroke, stroke_in};
use crate::support::value;
use jred::axis::{FeedForward, ImageSlot};
use jred::harmonic::terms;
use jred::image::{HEADER_WORDS, ImageCheck, encode, image_len};
use jred::number::{FrictionSign, Quantity};
use jred::table::{Format, Shape, SpeedOf, Table, TableError};
use jred::{
    Cubic, CurveSet, Harmonic, Image, ImageError, Phase, Q31, Quadratic, Rows16, Spline, Spline16,
    curves,
};

/// Enough for every image of these tests.
const WORDS: usize = 400;

#[test]
fn slices_give_the_same_verdict() {
    for image in [small(), stroke(), stroke_in::<Cubic<Q31>>(curves::LOAD)] {
        let covered = image.len() - 1;
        for words in 1..image.len() + 3 {
            let mut check = ImageCheck::new(&image);
            let mut calls = 1;
            let found = loop {
                if let Some(verdict) = check.advance(words) {
                    break verdict.unwrap();
                }
                calls += 1;
            };
            assert_eq!(calls, covered.div_ceil(words), "{words} words at a time");
            let whole = Image::new(&image).unwrap();
            assert_eq!(found.validity(), whole.validity());
            assert_eq!(
                (found.cells(), found.set(), found.domain(), found.scale()),
                (whole.cells(), whole.set(), whole.domain(), whole.scale())
            );
            // Damage in the last slice, in the first, and in the CRC.
            for damaged in [covered - 1, HEADER_WORDS, covered] {
                let mut other = image.clone();
                other[damaged] ^= 0x100;
                assert!(matches!(
                    in_slices(&other, words),
                    Err(ImageError::Crc { .. })
                ));
            }
        }
    }
}

/// A wrong header is detected before the CRC is complete.
#[test]
fn a_wrong_header_is_found_by_the_first_call() {
    let mut image = stroke();
    image[1] += 1;
    let first = ImageCheck::new(&image)
        .advance(1)
        .map(|found| found.is_ok());
    assert_eq!(first, Some(false));
    assert!(ImageCheck::new(&stroke()).advance(1).is_none());
}

fn bytes(image: &[u32]) -> Vec<u8> {
    image.iter().flat_map(|word| word.to_le_bytes()).collect()
}

/// A slot that has received these bytes in pieces.
fn received<'m, F: Format, const SET: CurveSet>(
    memory: &'m mut [u32],
    bytes: &[u8],
    piece: usize,
) -> ImageSlot<'m, F, SET> {
    let mut slot = ImageSlot::new(memory);
    for piece in bytes.chunks(piece) {
        assert!(slot.feed_forward().is_none() && slot.validity().is_none());
        slot.receive(piece).unwrap();
    }
    slot
}

fn checked<F: Format, const SET: CurveSet>(
    slot: &mut ImageSlot<'_, F, SET>,
    words: usize,
) -> Result<(), ImageError> {
    for _ in 0..=WORDS {
        assert!(slot.feed_forward().is_none());
        if let Some(verdict) = slot.check(words) {
            assert_eq!(slot.check(words), Some(verdict), "the verdict stays");
            assert_eq!(slot.feed_forward().is_some(), verdict.is_ok());
            assert_eq!(slot.validity().is_some(), verdict.is_ok());
            return verdict;
        }
    }
    panic!("the check does not end");
}

/// Torques over the range, compared bit by bit.
fn torques<F: Format, const SET: CurveSet>(found: &FeedForward<'_, F, SET>) -> Vec<(f64, f64)> {
    let scale = *found.model().table().scale();
    let at = |k: u32| {
        let phase = Phase::from_bits(k.wrapping_mul(0x0312_3457));
        let omega = scale.omega(0.1 * k as f32 - 5.0).value;
        let alpha = scale.alpha(k as f32 - 50.0).value;
        let model = found.model();
        let torque = model.torque_with(phase, omega, alpha, FrictionSign::OfSpeed(omega));
        let back = model.acceleration(phase, omega, torque).value;
        (value(torque), value(back))
    };
    (0..100).map(at).collect()
}

fn ticks_alike<F: Format, const SET: CurveSet>(image: &[u32]) {
    let whole = Image::new(image).unwrap();
    let whole = FeedForward::new(whole.model::<F, SET>().unwrap(), whole.validity());
    let expected = torques(&whole);
    assert!(expected.iter().any(|torque| *torque != expected[0]));
    for (piece, words) in [(1, 1), (3, 400), (61, 16), (4096, 5)] {
        let mut memory = [[0; WORDS]; 2];
        let [first, second] = &mut memory;
        let mut slot = received::<F, SET>(first, &bytes(image), piece);
        checked(&mut slot, words).unwrap();
        assert_eq!(torques(&slot.feed_forward().unwrap()), expected);
        // The result does not depend on its address.
        let mut moved = ImageSlot::new(second);
        core::mem::swap(&mut slot, &mut moved);
        assert_eq!(torques(&moved.feed_forward().unwrap()), expected);
        assert!(slot.feed_forward().is_none());
        assert_eq!(moved.validity(), Some(VALIDITY));
        // The images are for 10 rad/s; the base is at least 11.
        for (speed, beyond) in [(9.0, false), (10.5, true)] {
            let omega: SpeedOf<F> = whole.model().table().scale().omega(speed).value;
            let alpha = Quantity::of(omega.number());
            let status = moved.feed_forward().unwrap().status(omega, alpha);
            assert_eq!(status, whole.status(omega, alpha));
            assert_eq!(status.speed_beyond, beyond);
        }
    }
}

#[test]
fn a_slot_ticks_as_the_image_itself() {
    const SEEDED: CurveSet = curves::VISCOUS | curves::COULOMB | curves::RECIPROCAL;
    const CONSTANT: CurveSet = curves::LOAD | curves::CONSTANT_COULOMB;
    const WAVE: CurveSet = curves::INERTIA | terms::ALL;
    ticks_alike::<Spline<f32>, { curves::INERTIA }>(&small());
    ticks_alike::<Spline<f32>, CONSTANT>(&stroke_in::<Spline<f32>>(CONSTANT));
    ticks_alike::<Spline<Q31>, { curves::ALL }>(&stroke());
    ticks_alike::<Spline<Q31>, SEEDED>(&stroke_in::<Spline<Q31>>(SEEDED));
    ticks_alike::<Spline16, { curves::ALL }>(&stroke_in::<Spline16>(curves::ALL));
    ticks_alike::<Cubic<f32>, { curves::ALL }>(&stroke_in::<Cubic<f32>>(curves::ALL));
    ticks_alike::<Quadratic<Q31>, SEEDED>(&stroke_in::<Quadratic<Q31>>(SEEDED));
    ticks_alike::<Rows16, CONSTANT>(&stroke_in::<Rows16>(CONSTANT));
    ticks_alike::<Rows16, SEEDED>(&stroke_in::<Rows16>(SEEDED));
    // J = 2 + 0.5·cos φ + 0.25·sin φ.
    let words = [2.0, 0.5, 0.25, 0.0, 0.0];
    let table = Table::<Harmonic<f32>>::new(&words, Shape::harmonics(2, WAVE)).unwrap();
    let mut buffer = vec![0; image_len::<Harmonic<f32>>(2, WAVE)];
    ticks_alike::<Harmonic<f32>, WAVE>(encode(&table, VALIDITY, &mut buffer).unwrap());
}

/// The verdict of a slot on these bytes.
fn verdict<const SET: CurveSet>(bytes: &[u8]) -> Result<(), ImageError> {
    let mut memory = [u32::MAX; WORDS];
    checked(
        &mut received::<Spline<f32>, SET>(&mut memory, bytes, 10),
        16,
    )
}

#[test]
fn a_slot_refuses_what_an_image_refuses() {
    let image = small();
    let given = image.len() as u32;
    assert_eq!(verdict::<0>(&bytes(&image)), Ok(()));
    assert_eq!(
        verdict::<0>(&bytes(&image[..image.len() - 1])),
        Err(ImageError::Length {
            needed: given,
            given: given - 1
        })
    );
    assert_eq!(
        verdict::<0>(&bytes(&image)[..4 * image.len() - 1]),
        Err(ImageError::Misaligned)
    );
    assert!(matches!(
        verdict::<0>(&[]),
        Err(ImageError::Length { given: 0, .. })
    ));
    let table = |error| Err(ImageError::Table(error));
    assert_eq!(
        verdict::<1>(&bytes(&image)),
        table(TableError::Curves(0)),
        "other curves"
    );
    assert_eq!(
        verdict::<{ curves::ALL }>(&bytes(&stroke())),
        Err(ImageError::NumberType(2))
    );
    let mut wrong = image.clone();
    wrong[HEADER_WORDS + 3] = f32::NAN.to_bits();
    assert!(matches!(
        verdict::<0>(&bytes(&wrong)),
        Err(ImageError::Crc { .. })
    ));
    assert_eq!(
        verdict::<0>(&bytes(&sealed(wrong))),
        table(TableError::Range { curve: 0, cell: 0 })
    );
}

/// After a refused image, after a good one, and during one.
#[test]
fn a_slot_is_used_again() {
    let good = bytes(&small());
    let mut damaged = good.clone();
    damaged[100] ^= 1;
    let mut memory = [0; WORDS];
    let mut slot = received::<Spline<f32>, 0>(&mut memory, &damaged, 7);
    assert!(checked(&mut slot, 3).is_err());
    // The first bytes after a verdict start another image.
    slot.receive(&good[..11]).unwrap();
    assert!(slot.feed_forward().is_none());
    slot.receive(&good[11..]).unwrap();
    checked(&mut slot, 3).unwrap();
    slot.receive(&damaged).unwrap();
    assert!(slot.feed_forward().is_none(), "the old table is gone");
    slot.clear();
    slot.receive(&good[..60]).unwrap();
    assert!(slot.check(1).is_some_and(|found| found.is_err()), "half");
    slot.receive(&good).unwrap();
    // After a partial check more bytes arrive: then it is not the image of its header.
    assert!(slot.check(2).is_none());
    slot.receive(&good[..4]).unwrap();
    assert!(matches!(
        slot.check(2),
        Some(Err(ImageError::Length { .. }))
    ));
    slot.receive(&good).unwrap();
    // Partially checked, then abandoned.
    assert!(slot.check(2).is_none());
    slot.clear();
    slot.receive(&good).unwrap();
    checked(&mut slot, 1).unwrap();
}

#[test]
fn more_than_a_slot_holds_is_refused() {
    let mut memory = [0; WORDS];
    let mut slot = ImageSlot::<Spline<f32>, 0>::new(&mut memory);
    slot.receive(&[0; 4 * WORDS - 2]).unwrap();
    let refused = slot.receive(&[1, 2, 3]);
    let long = ImageError::TooLong { given: WORDS };
    assert_eq!(refused, Err(long));
    assert!(long.to_string().contains("400 words"), "{long}");
    slot.receive(&[1, 2]).unwrap();
    assert_eq!(slot.receive(&[1]), Err(long));
}
