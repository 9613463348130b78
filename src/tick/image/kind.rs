//! Format and set of an image, checked at compile time.

use super::{Image, MAGIC, VERSION};
use crate::curve::{CurveSet, Format};

/// Word of the header with the terms of harmonics, after those of every table.
const FIRST_CONSTANT: usize = 13;

impl Image<'_> {
    /// Whether the header of these words is that of an image of this format and set of curves.
    ///
    /// `const`, so that an image that is a constant of the program is checked at compile time; `jred export --format rust` writes this line, and the
    /// type of the model. The rest that [`new`](Self::new) and [`model`](Self::model) check, the CRC and every cell, is checked at start-up.
    ///
    /// ```compile_fail,E0080
    /// use jred::{Image, Q31, Spline, curves};
    ///
    /// static TABLE: [u32; 25] = [0; 25];
    /// const _: () = assert!(Image::is_of::<Spline<Q31>, { curves::LOAD }>(&TABLE));
    /// ```
    #[must_use]
    pub const fn is_of<F: Format, const SET: CurveSet>(words: &[u32]) -> bool {
        let [
            magic,
            version,
            _,
            kind,
            _,
            _,
            _,
            _,
            _,
            _,
            _,
            _,
            _,
            constant,
            ..,
        ] = words
        else {
            return false;
        };
        same_kind::<F>([*magic, *version, *kind, *constant], SET)
    }

    /// As [`is_of`](Self::is_of), for the bytes of a file.
    ///
    /// ```
    /// use jred::{CurveSet, Image, Q31, Spline, curves};
    ///
    /// const PRESS: CurveSet = curves::LOAD | curves::COULOMB | curves::CONSTANT_VISCOUS;
    /// const BYTES: &[u8] = include_bytes!("../../../examples/data/press_f32.jred");
    /// const _: () = assert!(Image::bytes_are_of::<Spline<f32>, PRESS>(BYTES));
    /// assert!(!Image::bytes_are_of::<Spline<Q31>, PRESS>(BYTES));
    /// ```
    #[must_use]
    pub const fn bytes_are_of<F: Format, const SET: CurveSet>(bytes: &[u8]) -> bool {
        let mut words = [0; FIRST_CONSTANT + 1];
        let mut rest = bytes;
        let mut left: &mut [u32] = &mut words;
        while let Some((word, after)) = left.split_first_mut() {
            let Some((bytes, more)) = rest.split_first_chunk::<4>() else {
                return false;
            };
            *word = u32::from_le_bytes(*bytes);
            (left, rest) = (after, more);
        }
        Self::is_of::<F, SET>(&words)
    }
}

/// Whether magic, version, kind and first constant of a header match a format and set.
const fn same_kind<F: Format>([magic, version, kind, constant]: [u32; 4], set: CurveSet) -> bool {
    let Some([code, layout]) = F::CODES else {
        return false;
    };
    let [found_code, found_set, found_layout, _] = kind.to_le_bytes();
    let terms = if F::TERMS {
        (constant as CurveSet) << 8
    } else {
        0
    };
    magic == MAGIC
        && version as u16 == VERSION
        && found_code == code
        && found_layout == layout
        && found_set as CurveSet | terms == set
}
