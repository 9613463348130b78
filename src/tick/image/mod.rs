//! The table image: a machine's curves as the tool exports them and firmware uses them, in place in flash.
//!
//! `docs/table-image.md` documents the layout word by word. Everything is a little-endian 32-bit word, so that an image only needs 4-byte alignment;
//! no number is copied or converted on loading. A CRC-32 covers all of it. [`Image::new`] checks header and CRC, [`Image::model`] the table itself:
//! an image that passes both can be ticked.

mod check;
mod encode;
mod error;
mod kind;

pub use check::ImageCheck;
pub(crate) use check::Progress;
pub(crate) use encode::seal;
pub use encode::{encode, identify, image_len};
pub use error::ImageError;

use crate::curve::{CONSTANTS, CurveSet, Format, Shape, Table};
use crate::{AnyModel, Domain, Model, Scale};

/// "JRED" in the file's first four bytes.
const MAGIC: u32 = u32::from_le_bytes(*b"JRED");
/// Version of the layout.
pub const VERSION: u16 = 2;
/// Words of the header.
pub const HEADER_WORDS: usize = 24;
/// Word of the machine's identifier.
const MACHINE: usize = 19;
/// Words from here on are zero.
const RESERVED: usize = 20;
/// Bits in use of the set of curves.
const KNOWN: u32 = 6;
/// Domain codes.
const TURN: u8 = 0;
const STROKE: u8 = 1;

/// Validity and accuracy of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Validity {
    /// Largest speed (rad/s, or m/s).
    pub max_speed: f32,
    /// Largest acceleration (rad/s², or m/s²).
    pub max_acceleration: f32,
    /// Largest error of the drive torque within these limits (N·m, or N).
    pub torque_error: f32,
}

/// A table image whose header and CRC were checked.
#[derive(Clone, Copy, Debug)]
pub struct Image<'a> {
    rows: &'a [u32],
    code: u8,
    set: CurveSet,
    layout: u8,
    constants: [u32; CONSTANTS],
    cells: u32,
    domain: Domain<f32>,
    scale: Scale,
    validity: Validity,
    machine: u32,
}

impl<'a> Image<'a> {
    /// Checks an image given as words, such as a `static` array from `jred export --format rust`.
    ///
    /// It checks everything at once; [`ImageCheck`] does the same in slices.
    ///
    /// # Errors
    /// As [`ImageError`] lists, except for the table's own errors.
    pub fn new(words: &'a [u32]) -> Result<Self, ImageError> {
        Self::with_crc(words, Progress::START.all(covered(words, &TABLE)?))
    }

    /// The image, if `computed` is the CRC-32 of its words before the last.
    #[inline(never)] // a program that checks at once and in slices has it once
    fn with_crc(words: &'a [u32], computed: u32) -> Result<Self, ImageError> {
        let short = ImageError::Length {
            needed: HEADER_WORDS as u32 + 1,
            given: words.len() as u32,
        };
        let (header, rest) = words.split_first_chunk::<HEADER_WORDS>().ok_or(short)?;
        let (stored, rows) = rest.split_last().ok_or(short)?;
        let &[
            _,
            version,
            _,
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
        let set = CurveSet::from(set);
        if set >= 1 << KNOWN {
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
            max_speed: f32::from_bits(omega),
            max_acceleration: f32::from_bits(alpha),
            torque_error: f32::from_bits(torque_error),
        };
        let limits = [
            validity.max_speed,
            validity.max_acceleration,
            validity.torque_error,
        ];
        if !limits.iter().all(|x| x.is_finite() && *x >= 0.0) {
            return Err(ImageError::Header(10));
        }
        Ok(Self {
            rows,
            code,
            set,
            layout,
            constants,
            cells,
            domain,
            scale,
            validity,
            machine: header.get(MACHINE).copied().unwrap_or_default(),
        })
    }

    /// Checks an image given as bytes, such as `include_bytes!` or a flash region.
    ///
    /// # Errors
    /// As [`new`](Self::new); also bytes that are not on a 4-byte boundary ([`include_image!`](crate::include_image) aligns them).
    pub fn from_bytes(bytes: &'a [u8]) -> Result<Self, ImageError> {
        Self::new(bytemuck::try_cast_slice(bytes).map_err(|_| ImageError::Misaligned)?)
    }

    /// The model over the table, in place in the image.
    ///
    /// The program names its format and its set of curves:
    ///
    /// ```
    /// # use jred::{Image, ImageError, Model, Spline, curves};
    /// fn model<'a>(image: &Image<'a>) -> Result<Model<'a, Spline<f32>, { curves::LOAD }>, ImageError> {
    ///     image.model::<Spline<f32>, { curves::LOAD }>()
    /// }
    /// ```
    ///
    /// Neither another format nor a set known only at run time compiles:
    ///
    /// ```compile_fail,E0308
    /// # use jred::{Image, ImageError, Model, Q31, Spline, curves};
    /// fn model<'a>(image: &Image<'a>) -> Result<Model<'a, Spline<f32>, { curves::LOAD }>, ImageError> {
    ///     image.model::<Spline<Q31>, { curves::LOAD }>()
    /// }
    /// ```
    ///
    /// ```compile_fail,E0435
    /// # use jred::{Image, ImageError, Model, Spline, curves};
    /// fn model<'a>(image: &Image<'a>) -> Result<Model<'a, Spline<f32>, { curves::LOAD }>, ImageError> {
    ///     let set = image.set();
    ///     image.model::<Spline<f32>, { set }>()
    /// }
    /// ```
    ///
    /// # Errors
    /// Another number type, format or set of curves than the image has, or an invalid table.
    pub fn model<F: Format, const SET: CurveSet>(&self) -> Result<Model<'a, F, SET>, ImageError> {
        Ok(Model::new(self.table()?)?)
    }

    /// The model, for a program that does not know its curves at compile time.
    ///
    /// It borrows the words of the image, as every model does:
    ///
    /// ```
    /// # use jred::{Image, ImageError, Phase, Spline};
    /// fn torque(words: &mut [u32]) -> Result<f32, ImageError> {
    ///     let model = Image::new(words)?.any_model::<Spline<f32>>()?;
    ///     let torque = model.torque(Phase::default(), 10.0, 50.0);
    ///     words[0] = 0;
    ///     Ok(torque)
    /// }
    /// ```
    ///
    /// so that overwriting them before the last tick does not compile:
    ///
    /// ```compile_fail,E0506
    /// # use jred::{Image, ImageError, Phase, Spline};
    /// fn torque(words: &mut [u32]) -> Result<f32, ImageError> {
    ///     let model = Image::new(words)?.any_model::<Spline<f32>>()?;
    ///     words[0] = 0;
    ///     Ok(model.torque(Phase::default(), 10.0, 50.0))
    /// }
    /// ```
    ///
    /// # Errors
    /// As [`model`](Self::model).
    pub fn any_model<F: Format>(&self) -> Result<AnyModel<'a, F>, ImageError> {
        Ok(AnyModel::new(self.table()?)?)
    }

    /// The table, in place in the image.
    ///
    /// # Errors
    /// Another number type or format than the image has, or an invalid table.
    pub fn table<F: Format>(&self) -> Result<Table<'a, F>, ImageError> {
        if F::CODES.map(|[code, _]| code) != Some(self.code) {
            return Err(ImageError::NumberType(self.code));
        }
        if F::CODES.map(|[_, layout]| layout) != Some(self.layout) {
            return Err(ImageError::Layout(self.layout));
        }
        let words = bytemuck::try_cast_slice(self.rows).map_err(|_| ImageError::Misaligned)?;
        let shape = Shape {
            set: F::set(&self.constants, self.set),
            cells: self.cells,
            domain: self.domain.to(),
            scale: self.scale,
            constants: F::from_header(&self.constants),
        };
        Ok(Table::new(words, shape)?)
    }

    /// The same, if it is for the machine with this identifier: another machine may have the same types and curves.
    ///
    /// # Errors
    /// [`ImageError::Machine`].
    pub const fn of_machine(self, machine: u32) -> Result<Self, ImageError> {
        if self.machine == machine {
            Ok(self)
        } else {
            Err(ImageError::Machine {
                found: self.machine,
                expected: machine,
            })
        }
    }

    /// The identifier of the machine, written by [`identify`], or 0.
    pub const fn machine(&self) -> u32 {
        self.machine
    }

    /// The machine units.
    pub const fn scale(&self) -> &Scale {
        &self.scale
    }

    /// Range of the drive link.
    pub const fn domain(&self) -> Domain<f32> {
        self.domain
    }

    /// The set of [`curves`](crate::curves) in addition to the inertia.
    pub const fn set(&self) -> CurveSet {
        self.set
    }

    /// Number of cells.
    pub const fn cells(&self) -> u32 {
        self.cells
    }

    /// Validity and accuracy of the table.
    pub const fn validity(&self) -> Validity {
        self.validity
    }
}

/// The beginning of an image of any kind: its first word, the version in its second, and the words of its header.
pub(crate) struct Beginning {
    pub(crate) magic: u32,
    pub(crate) version: u16,
    pub(crate) header: usize,
}

const TABLE: Beginning = Beginning {
    magic: MAGIC,
    version: VERSION,
    header: HEADER_WORDS,
};

/// The words that the CRC covers, if magic, version and length of the image are right.
pub(crate) fn covered<'a>(
    words: &'a [u32],
    beginning: &Beginning,
) -> Result<&'a [u32], ImageError> {
    if cfg!(target_endian = "big") {
        return Err(ImageError::BigEndian);
    }
    let given = words.len() as u32;
    let short = ImageError::Length {
        needed: beginning.header as u32 + 1,
        given,
    };
    let (_, covered) = words.split_last().ok_or(short)?;
    let [magic, version, length, ..] = covered else {
        return Err(short);
    };
    if covered.len() < beginning.header {
        return Err(short);
    }
    if *magic != beginning.magic {
        return Err(ImageError::NotAnImage(*magic));
    }
    if *version as u16 != beginning.version {
        return Err(ImageError::Version {
            found: *version as u16,
            supported: beginning.version,
        });
    }
    if *length != given {
        return Err(ImageError::Length {
            needed: *length,
            given,
        });
    }
    Ok(covered)
}

/// Bytes on a 4-byte boundary, created by [`include_image!`](crate::include_image).
#[repr(C, align(4))]
#[derive(Clone, Copy, Debug)]
pub struct Aligned<T: ?Sized>(pub T);

/// A table image from a file, as a `&'static [u8]` on a 4-byte boundary, for [`Image::from_bytes`].
///
/// The path is relative to the source file, as for `include_bytes!`.
#[macro_export]
macro_rules! include_image {
    ($path:expr) => {{
        static IMAGE: $crate::image::Aligned<[u8; include_bytes!($path).len()]> =
            $crate::image::Aligned(*include_bytes!($path));
        let bytes: &'static [u8] = &IMAGE.0;
        bytes
    }};
}
