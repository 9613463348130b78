//! The table image: a machine's curves as the tool exports them and firmware uses them, in place from flash.
//!
//! The layout is documented word by word in `docs/table-image.md`. Everything is a little-endian 32-bit word, so an
//! image needs 4-byte alignment and nothing else; no number is copied or converted on loading. A CRC-32 covers all
//! of it. [`Image::new`] checks header and CRC, [`Image::model`] the table itself: what passes both can be ticked.

mod error;

pub use error::ImageError;

use crate::curve::{Constants, Layout, Table, curves};
use crate::number::Scalar;
use crate::{Domain, Error, Model, Scale};

/// "JRED" in the file's first four bytes.
const MAGIC: u32 = u32::from_le_bytes(*b"JRED");
/// Version of the layout.
pub const VERSION: u16 = 2;
/// Words of the header.
pub const HEADER_WORDS: usize = 24;
/// Words of it for what a layout has beside its rows.
pub(crate) const CONSTANTS: usize = HEADER_WORDS - 13;
/// Words from here on are zero.
const RESERVED: usize = 19;
/// Domain codes.
const TURN: u8 = 0;
const STROKE: u8 = 1;

const CRC: crc::Crc<u32> = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);

/// What the table was made for and how exact it is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Validity {
    /// Largest speed (rad/s, or m/s).
    pub omega: f32,
    /// Largest acceleration (rad/s², or m/s²).
    pub alpha: f32,
    /// Largest error of the drive torque within these (N·m, or N).
    pub torque_error: f32,
}

/// A table image whose header and CRC were checked.
#[derive(Clone, Copy, Debug)]
pub struct Image<'a> {
    pub(crate) rows: &'a [u32],
    pub(crate) code: u8,
    curves: u8,
    pub(crate) layout: u8,
    pub(crate) constants: [u32; CONSTANTS],
    cells: u32,
    domain: Domain<f32>,
    scale: Scale,
    validity: Validity,
}

impl<'a> Image<'a> {
    /// Checks an image given as words: a `static` array as `jred export --format rust` writes it.
    ///
    /// # Errors
    /// What [`ImageError`] lists, except for the table's own errors.
    pub fn new(words: &'a [u32]) -> Result<Self, ImageError> {
        if cfg!(target_endian = "big") {
            return Err(ImageError::BigEndian);
        }
        let given = words.len() as u32;
        let short = ImageError::Length {
            needed: HEADER_WORDS as u32 + 1,
            given,
        };
        let (header, rest) = words.split_first_chunk::<HEADER_WORDS>().ok_or(short)?;
        let (stored, rows) = rest.split_last().ok_or(short)?;
        let &[
            magic,
            version,
            length,
            kind,
            cells,
            from,
            to,
            torque,
            speed,
            inertia,
            omega,
            alpha,
            torque_error,
            constants @ ..,
        ] = header;
        if magic != MAGIC {
            return Err(ImageError::NotAnImage(magic));
        }
        if version as u16 != VERSION {
            return Err(ImageError::Version {
                found: version as u16,
                supported: VERSION,
            });
        }
        if length != given {
            return Err(ImageError::Length {
                needed: length,
                given,
            });
        }
        let covered = words.get(..words.len() - 1).unwrap_or_default();
        let computed = CRC.checksum(bytemuck::cast_slice(covered));
        if computed != *stored {
            return Err(ImageError::Crc {
                stored: *stored,
                computed,
            });
        }
        if (version >> 16) as usize != HEADER_WORDS {
            return Err(ImageError::Header(1));
        }
        let [code, set, layout, domain] = kind.to_le_bytes();
        let (from, to) = (f32::from_bits(from), f32::from_bits(to));
        let domain = match domain {
            TURN => Domain::Turn,
            STROKE if to > from && (to - from).is_finite() => Domain::Stroke { from, to },
            STROKE => return Err(ImageError::Header(5)),
            _ => return Err(ImageError::Header(3)),
        };
        if set > curves::EVERY {
            return Err(ImageError::Header(3));
        }
        if header.get(RESERVED..) != Some(&[0; HEADER_WORDS - RESERVED]) {
            return Err(ImageError::Header(RESERVED as u8));
        }
        let scale = Scale::from_bases([torque, speed, inertia].map(f32::from_bits));
        if !scale.is_sound() {
            return Err(ImageError::Header(7));
        }
        let validity = Validity {
            omega: f32::from_bits(omega),
            alpha: f32::from_bits(alpha),
            torque_error: f32::from_bits(torque_error),
        };
        let limits = [validity.omega, validity.alpha, validity.torque_error];
        if !limits.iter().all(|x| x.is_finite() && *x >= 0.0) {
            return Err(ImageError::Header(10));
        }
        Ok(Self {
            rows,
            code,
            curves: set,
            layout,
            constants,
            cells,
            domain,
            scale,
            validity,
        })
    }

    /// Checks an image given as bytes, such as `include_bytes!` or a flash region.
    ///
    /// # Errors
    /// As [`new`](Self::new); the bytes must lie on a 4-byte boundary ([`include_image!`](crate::include_image)
    /// sees to it).
    pub fn from_bytes(bytes: &'a [u8]) -> Result<Self, ImageError> {
        Self::new(bytemuck::try_cast_slice(bytes).map_err(|_| ImageError::Misaligned)?)
    }

    /// The model, its table in place in the image.
    ///
    /// # Errors
    /// Another number type or other curves than the image has, or a table that is not sound.
    pub fn model<S: Scalar, const CURVES: u8, L: Layout>(
        &self,
    ) -> Result<Model<'a, S, CURVES, L>, ImageError> {
        let table = self.table::<S, L>()?;
        Ok(Model::new(table, S::span_f32(self.domain), &self.scale)?)
    }

    /// The table, in place in the image.
    ///
    /// # Errors
    /// Another number type or layout than the image has, or a table that is not sound.
    pub fn table<S: Scalar, L: Layout>(&self) -> Result<Table<'a, S, L>, ImageError> {
        if S::CODE != Some(self.code) {
            return Err(ImageError::NumberType(self.code));
        }
        if L::CODE != self.layout {
            return Err(ImageError::Layout(self.layout));
        }
        let words = bytemuck::try_cast_slice(self.rows).map_err(|_| ImageError::Misaligned)?;
        // 16-bit words may leave half a word unused at the end.
        let used = L::words(self.cells as usize, self.curves);
        let words = match words.get(..used) {
            Some(used) if words.len() - used.len() <= 1 => used,
            _ => words,
        };
        let [inertia, viscous, coulomb, j_load, b_c, reciprocal, ..] = self.constants;
        let gain = |bits: u32| S::whole(bits as u16);
        let constants = Constants {
            inertia: S::word_from_bits(inertia),
            viscous: S::word_from_bits(viscous),
            coulomb: S::word_from_bits(coulomb),
            gains: [
                gain(j_load),
                gain(j_load >> 16),
                gain(b_c),
                gain(b_c >> 16),
                gain(reciprocal),
            ],
        };
        let periodic = matches!(self.domain, Domain::Turn);
        let table = Table::with_constants(words, constants, self.curves, self.cells, periodic)?;
        Ok(table)
    }

    /// The machine units.
    pub const fn scale(&self) -> &Scale {
        &self.scale
    }

    /// Range of the drive link.
    pub const fn domain(&self) -> Domain<f32> {
        self.domain
    }

    /// The set of [`curves`] beside the inertia.
    pub const fn curves(&self) -> u8 {
        self.curves
    }

    /// Number of cells.
    pub const fn cells(&self) -> u32 {
        self.cells
    }

    /// What the table was made for and how exact it is.
    pub const fn validity(&self) -> Validity {
        self.validity
    }
}

/// Two half-words in one word.
const fn word_of(low: u16, high: u16) -> u32 {
    low as u32 | (high as u32) << 16
}

/// Words of the image of a table.
#[must_use]
pub fn image_words<S: Scalar, L: Layout>(cells: u32, set: u8) -> usize {
    let bytes = L::words(cells as usize, set) * size_of::<S::Word>();
    HEADER_WORDS + bytes.div_ceil(4) + 1
}

/// Writes the image of `table` and returns it. The table was checked when it was built.
///
/// # Errors
/// A buffer shorter than [`image_words`], or a number type that is not stored in images (f64).
pub fn encode<'b, S: Scalar, L: Layout>(
    table: &Table<'_, S, L>,
    domain: Domain,
    scale: &Scale,
    validity: Validity,
    buffer: &'b mut [u32],
) -> Result<&'b [u32], Error> {
    let code = S::CODE.ok_or(Error::NoImage(S::NAME))?;
    let constants = table.constants();
    let [j, load, b, c, reciprocal] = constants.gains.map(|g| S::exact_whole(g));
    let header = Header {
        kind: [code, table.curves(), L::CODE],
        cells: table.cells(),
        domain,
        scale,
        validity,
        constants: [
            S::word_bits(constants.inertia),
            S::word_bits(constants.viscous),
            S::word_bits(constants.coulomb),
            word_of(j, load),
            word_of(b, c),
            word_of(reciprocal, 0),
            0,
            0,
            0,
            0,
            0,
        ],
    };
    seal(&header, bytemuck::cast_slice(table.words()), buffer)
}

/// What an image says about its rows.
pub(crate) struct Header<'s> {
    /// Codes of the number type, the set of curves, and the layout.
    pub(crate) kind: [u8; 3],
    pub(crate) cells: u32,
    pub(crate) domain: Domain,
    pub(crate) scale: &'s Scale,
    pub(crate) validity: Validity,
    pub(crate) constants: [u32; CONSTANTS],
}

/// Writes an image: header, rows, CRC.
pub(crate) fn seal<'b>(
    header: &Header<'_>,
    rows: &[u8],
    buffer: &'b mut [u32],
) -> Result<&'b [u32], Error> {
    let needed = HEADER_WORDS + rows.len().div_ceil(4) + 1;
    let given = buffer.len();
    let short = Error::BufferTooShort { needed, given };
    let image = buffer.get_mut(..needed).ok_or(short)?;
    let (domain, from, to) = match header.domain.to_f32() {
        Domain::Turn => (TURN, 0.0, 0.0),
        Domain::Stroke { from, to } => (STROKE, from, to),
    };
    let [code, set, layout] = header.kind;
    let (scale, validity) = (header.scale, header.validity);
    let words: [u32; HEADER_WORDS - CONSTANTS] = [
        MAGIC,
        word_of(VERSION, HEADER_WORDS as u16),
        needed as u32,
        u32::from_le_bytes([code, set, layout, domain]),
        header.cells,
        from.to_bits(),
        to.to_bits(),
        scale.torque().to_bits(),
        scale.speed().to_bits(),
        scale.inertia().to_bits(),
        validity.omega.to_bits(),
        validity.alpha.to_bits(),
        validity.torque_error.to_bits(),
    ];
    image.fill(0);
    for (slot, word) in image.iter_mut().zip(words.iter().chain(&header.constants)) {
        *slot = *word;
    }
    let bytes: &mut [u8] = bytemuck::cast_slice_mut(image);
    for (slot, byte) in bytes.iter_mut().skip(4 * HEADER_WORDS).zip(rows) {
        *slot = *byte;
    }
    if let Some((crc, covered)) = image.split_last_mut() {
        *crc = CRC.checksum(bytemuck::cast_slice(covered));
    }
    Ok(image)
}

/// Bytes on a 4-byte boundary; made by [`include_image!`](crate::include_image).
#[repr(C, align(4))]
#[derive(Clone, Copy, Debug)]
pub struct Aligned<T: ?Sized>(pub T);

/// A table image from a file, as a `&'static [u8]` on a 4-byte boundary, for [`Image::from_bytes`].
///
/// The path is relative to the source file, as for `include_bytes!`.
#[macro_export]
macro_rules! include_image {
    ($path:expr) => {{
        static IMAGE: $crate::Aligned<[u8; include_bytes!($path).len()]> =
            $crate::Aligned(*include_bytes!($path));
        let bytes: &'static [u8] = &IMAGE.0;
        bytes
    }};
}
