//! Images for tests, and an independent CRC.

use jred::image::{ImageCheck, Validity, encode, image_len};
use jred::table::Format;
use jred::{CurveSet, Domain, Image, ImageError, Q31, Scale, Spline, curves};

use super::machines::Wave;
use super::rows::Rows;
use super::scale_of;

/// CRC-32 as in IEEE 802.3, bit by bit: polynomial 0x04C11DB7 reflected, start and end inverted.
pub(crate) fn crc32(words: &[u32]) -> u32 {
    !words
        .iter()
        .flat_map(|w| w.to_le_bytes())
        .fold(u32::MAX, |crc, byte| {
            (0..8).fold(crc ^ u32::from(byte), |crc, _| {
                (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg())
            })
        })
}

/// Corrects the CRC.
pub(crate) fn sealed(mut image: Vec<u32>) -> Vec<u32> {
    let last = image.len() - 1;
    image[last] = crc32(&image[..last]);
    image
}

pub(crate) const VALIDITY: Validity = Validity {
    max_speed: 10.0,
    max_acceleration: 100.0,
    torque_error: 0.01,
};

pub(crate) fn encoded<F: Format>(
    machine: &Wave,
    set: CurveSet,
    cells: u32,
    scale: &Scale,
) -> Vec<u32> {
    let rows = Rows::<F>::of(machine, set, cells, scale).unwrap();
    let mut buffer = vec![0; image_len::<F>(cells, set) + 3];
    encode(&rows.table(), VALIDITY, &mut buffer)
        .unwrap()
        .to_vec()
}

/// The smallest possible image: four cells, inertia only.
pub(crate) fn small() -> Vec<u32> {
    encoded::<Spline<f32>>(&Wave::bare(1.0, 0.25), curves::INERTIA, 4, &Scale::SI)
}

pub(crate) fn stroke() -> Vec<u32> {
    stroke_in::<Spline<Q31>>(curves::ALL)
}

/// Over a stroke, with the curves of this set.
pub(crate) fn stroke_in<F: Format>(set: CurveSet) -> Vec<u32> {
    let domain = Domain::stroke(-0.5, 1.5).unwrap();
    let wave = Wave {
        mean: 1.0,
        swing: 0.25,
        load: 3.0,
        viscous: 0.1,
        coulomb: 0.5,
        domain,
    };
    let scale = scale_of(60.0, 11.0, 2.0);
    encoded::<F>(&wave, set, 12, &scale.for_cells(12, domain.span()))
}

/// The verdict on an image checked in slices of this many words.
pub(crate) fn in_slices(image: &[u32], words: usize) -> Result<Image<'_>, ImageError> {
    let mut check = ImageCheck::new(image);
    for _ in 0..=image.len() {
        if let Some(verdict) = check.advance(words) {
            return verdict;
        }
    }
    panic!("the check of {} words does not end", image.len());
}

/// The reason for its refusal, checked at once and in slices.
pub(crate) fn refused(image: &[u32]) -> ImageError {
    let error = Image::new(image).map(|_| ()).unwrap_err();
    for words in [1, 7, 64] {
        let sliced = in_slices(image, words).map(|_| ());
        assert_eq!(sliced, Err(error), "{words} words at a time");
    }
    error
}
