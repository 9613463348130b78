//! Why an image is refused, or not written.

use core::fmt;

use crate::curve::TableError;
use crate::number::error::{Curable, error};

/// Why an image is refused, or not written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ImageError {
    /// The bytes do not start on a 4-byte boundary, or are not whole words.
    Misaligned,
    /// This processor is big-endian; images are little-endian and used in place.
    BigEndian,
    /// Shorter than a header, or another length than in the header.
    Length {
        /// Words that the image must have.
        needed: u32,
        /// Words given.
        given: u32,
    },
    /// The first word is not "JRED".
    NotAnImage(u32),
    /// Made for another version of the layout.
    Version {
        /// Version of the image.
        found: u16,
        /// Version that this library reads.
        supported: u16,
    },
    /// The contents are damaged.
    Crc {
        /// CRC-32 stored in the image.
        stored: u32,
        /// CRC-32 of its contents.
        computed: u32,
    },
    /// The header field at this word index has a value that is unknown to this version or out of range.
    Header(u8),
    /// The image contains another number type; its code (1 = f32, 2 = i32, 3 = i16).
    NumberType(u8),
    /// The image has another layout; its code (1 = spline, 2 = cubic, 3 = quadratic, 4 = spline16, 5 = rows of 16 bits, 6 = harmonics, 7 = slider-crank).
    Layout(u8),
    /// The image is for another machine.
    Machine {
        /// Its identifier, or 0.
        found: u32,
        /// The expected identifier.
        expected: u32,
    },
    /// The table is invalid.
    Table(TableError),
    /// Images do not store tables of this number type.
    NotStored(&'static str),
    /// A received image is longer than its memory.
    TooLong {
        /// Words of memory.
        given: usize,
    },
    /// The buffer for the image is too short.
    BufferTooShort {
        /// Words needed.
        needed: usize,
        /// Words given.
        given: usize,
    },
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Misaligned => {
                write!(
                    f,
                    "the image is not a whole number of words on a 4-byte boundary"
                )
            }
            Self::BigEndian => write!(f, "images are little-endian, this processor is not"),
            Self::Length { needed, given } => {
                write!(
                    f,
                    "the image has {given} words, but {needed} are needed: truncated?"
                )
            }
            Self::NotAnImage(word) => {
                write!(
                    f,
                    "not a table image: it starts with {word:#010x} instead of \"JRED\""
                )
            }
            Self::Version { found, supported } => write!(
                f,
                "image version {found}, this library reads version {supported}"
            ),
            Self::Crc { stored, computed } => write!(
                f,
                "the image is damaged: CRC-32 {computed:#010x}, stored {stored:#010x}"
            ),
            Self::Header(word) => write!(f, "header word {word} of the image has no meaning"),
            Self::NumberType(code) => {
                write!(
                    f,
                    "the image holds numbers of type {code} (1 = f32, 2 = i32, 3 = i16)"
                )
            }
            Self::Layout(code) => write!(
                f,
                "the image has layout {code} (1 = spline, 2 = cubic, 3 = quadratic, 4 = spline16, 5 = rows of 16 bits, 6 = harmonics, 7 = slider-crank)"
            ),
            Self::Machine { found, expected } => write!(
                f,
                "the image is of the machine 0x{found:08x}, not of 0x{expected:08x}"
            ),
            Self::Table(error) => error.fmt(f),
            Self::NotStored(name) => write!(f, "tables of {name} are not stored in images"),
            Self::TooLong { given } => write!(
                f,
                "the image is longer than the {given} words of its memory"
            ),
            Self::BufferTooShort { needed, given } => write!(
                f,
                "the buffer holds {given} words, but the image has {needed}"
            ),
        }
    }
}

error!(ImageError, Table(TableError));

impl Curable for ImageError {
    fn write_cure(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Misaligned => f.write_str(
                "give all of its bytes, on a 4-byte boundary, as jred::include_image! does",
            ),
            Self::BigEndian => f.write_str("tick it on a little-endian processor"),
            Self::Length { .. } => {
                f.write_str("give all words that jred wrote, and none behind them")
            }
            Self::NotAnImage(_) => {
                f.write_str("give a file that jred export wrote, with --format image")
            }
            Self::Version { .. } | Self::Header(_) => {
                f.write_str("export the table again, with the jred of this library's version")
            }
            Self::Crc { .. } => f.write_str("load the image again"),
            Self::NumberType(_) => f.write_str(
                "export the table again with --type f32, i32 or i16, as the model's numbers are (f32, Q31, Q15), or give the model the format that jred export prints",
            ),
            Self::Layout(_) => f.write_str(
                "export the table again with the --layout of the model's format, or give the model the format that jred export prints",
            ),
            Self::Machine { .. } => {
                f.write_str("load the image that was exported for this machine")
            }
            Self::Table(error) => error.write_cure(f),
            Self::NotStored(_) => f.write_str("use f32 or i32"),
            Self::TooLong { .. } => f.write_str(
                "give it the bytes that jred export prints, four a word, or export a smaller table (--max-bytes)",
            ),
            Self::BufferTooShort { needed, .. } => write!(f, "give it {needed} words"),
        }
    }
}
