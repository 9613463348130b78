//! Images of tables of 16-bit rows.

use super::table::words_len;
use super::{Constants, Model, Table};
use crate::tick::image::{CONSTANTS, HEADER_WORDS, Header, Image, ImageError, Validity, seal};
use crate::{Domain, Error, Scale};

/// Number type in the header: i16.
const NUMBER: u8 = 3;
/// Layout in the header: rows of packed words.
const LAYOUT: u8 = 5;

/// Words of the image of a table.
#[must_use]
pub const fn image_words(cells: u32, set: u8) -> usize {
    HEADER_WORDS + words_len(cells, set) + 1
}

/// Writes the image of `table` and returns it. The table was checked when it was built.
///
/// # Errors
/// A buffer shorter than [`image_words`].
pub fn encode<'b>(
    table: &Table<'_>,
    domain: Domain,
    scale: &Scale,
    validity: Validity,
    buffer: &'b mut [u32],
) -> Result<&'b [u32], Error> {
    let Constants {
        viscous,
        coulomb,
        shift,
    } = table.constants();
    let mut constants = [0; CONSTANTS];
    for (slot, word) in
        constants
            .iter_mut()
            .zip([shift, viscous.cast_unsigned(), coulomb.cast_unsigned()])
    {
        *slot = word;
    }
    let header = Header {
        kind: [NUMBER, table.curves(), LAYOUT],
        cells: table.cells(),
        domain,
        scale,
        validity,
        constants,
    };
    seal(&header, bytemuck::cast_slice(table.words()), buffer)
}

impl<'a> Image<'a> {
    /// The model over 16-bit rows, in place in the image.
    ///
    /// # Errors
    /// Another number type, layout or set of curves than the image has, or a table that is not sound.
    pub fn short_model<const CURVES: u8>(&self) -> Result<Model<'a, CURVES>, ImageError> {
        let table = self.short_table()?;
        Ok(Model::new(table, self.domain().span(), self.scale())?)
    }

    /// The table of 16-bit rows, in place in the image.
    ///
    /// # Errors
    /// Another number type or layout than the image has, or a table that is not sound.
    pub fn short_table(&self) -> Result<Table<'a>, ImageError> {
        if self.code != NUMBER {
            return Err(ImageError::NumberType(self.code));
        }
        if self.layout != LAYOUT {
            return Err(ImageError::Layout(self.layout));
        }
        let [shift, viscous, coulomb, ..] = self.constants;
        let constants = Constants {
            viscous: viscous.cast_signed(),
            coulomb: coulomb.cast_signed(),
            shift,
        };
        Ok(Table::new(
            self.rows,
            constants,
            self.curves(),
            self.cells(),
        )?)
    }
}
