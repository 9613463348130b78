//! Writes table images.

use super::check::Progress;
use super::error::ImageError;
use super::{HEADER_WORDS, Image, MACHINE, MAGIC, STROKE, TURN, VERSION, Validity};
use crate::Domain;
use crate::curve::{CONSTANTS, CurveSet, Format, Table, words_len};
use crate::number::Number;

/// Two half-words in one word.
const fn word_of(low: u16, high: u16) -> u32 {
    low as u32 | (high as u32) << 16
}

/// Words of the image of a table of `cells` cells.
#[must_use]
pub const fn image_len<F: Format>(cells: u32, set: CurveSet) -> usize {
    HEADER_WORDS + (words_len::<F>(cells, set) * size_of::<F::Word>()).div_ceil(4) + 1
}

/// Writes and returns the image of `table`, which was checked when it was created.
///
/// # Errors
/// A buffer shorter than [`image_len`], or a number type that images do not store (f64).
pub fn encode<'b, F: Format>(
    table: &Table<'_, F>,
    validity: Validity,
    buffer: &'b mut [u32],
) -> Result<&'b [u32], ImageError> {
    let [code, layout] = F::CODES.ok_or(ImageError::NotStored(<F::Number as Number>::NAME))?;
    let rows: &[u8] = bytemuck::cast_slice(table.words());
    let needed = image_len::<F>(table.cells(), table.set());
    let given = buffer.len();
    let short = ImageError::BufferTooShort { needed, given };
    let image = buffer.get_mut(..needed).ok_or(short)?;
    let (domain, from, to) = match table.domain().to::<f32>() {
        Domain::Turn => (TURN, 0.0, 0.0),
        Domain::Stroke { from, to } => (STROKE, from, to),
    };
    let scale = table.scale();
    let words: [u32; HEADER_WORDS - CONSTANTS] = [
        MAGIC,
        word_of(VERSION, HEADER_WORDS as u16),
        needed as u32,
        u32::from_le_bytes([code, table.set() as u8, layout, domain]),
        table.cells(),
        from.to_bits(),
        to.to_bits(),
        scale.torque().to_bits(),
        scale.speed().to_bits(),
        scale.inertia().to_bits(),
        validity.max_speed.to_bits(),
        validity.max_acceleration.to_bits(),
        validity.torque_error.to_bits(),
    ];
    let constants = F::header(table.constants(), table.set());
    image.fill(0);
    for (slot, word) in image.iter_mut().zip(words.iter().chain(&constants)) {
        *slot = *word;
    }
    let bytes: &mut [u8] = bytemuck::cast_slice_mut(image);
    for (slot, byte) in bytes.iter_mut().skip(4 * HEADER_WORDS).zip(rows) {
        *slot = *byte;
    }
    seal(image);
    Ok(image)
}

/// Writes the identifier of a machine into an image, as `jred export` does.
///
/// # Errors
/// Words that are not an image.
pub fn identify(image: &mut [u32], machine: u32) -> Result<(), ImageError> {
    Image::new(image)?;
    if let Some(word) = image.get_mut(MACHINE) {
        *word = machine;
    }
    seal(image);
    Ok(())
}

/// Writes the CRC of an image.
pub(crate) fn seal(image: &mut [u32]) {
    if let Some((crc, covered)) = image.split_last_mut() {
        *crc = Progress::START.all(covered);
    }
}
