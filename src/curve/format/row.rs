//! How many words a table has.

use super::harmonic::{means, row};
use crate::curve::curves::{Set, width};

/// The words of a table.
#[derive(Clone, Copy, Debug)]
pub enum Size {
    /// Row after row.
    Rows(Row),
    /// Means, then harmonic after harmonic.
    Harmonics,
}

impl Size {
    /// Words of a whole table.
    #[inline]
    pub(crate) const fn words(&self, cells: usize, set: Set) -> usize {
        match self {
            Self::Rows(row) => (cells + row.more) * row.pitch(set),
            Self::Harmonics => means(set) + cells * row(set),
        }
    }
}

/// The words of a row.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Words in addition to those of the curves.
    pub(super) head: usize,
    /// Half-words of a curve.
    pub(super) halves: usize,
    /// Rows are padded to a multiple of four words.
    pub(super) padded: bool,
    /// Rows beyond the cells.
    pub(super) more: usize,
}

impl Row {
    /// Words from one row to the next: never 0.
    #[inline]
    pub(crate) const fn pitch(&self, set: Set) -> usize {
        let words = self.head + (width(set) * self.halves).div_ceil(2);
        // Without a division, which would have to fear a zero.
        if self.padded { (words + 3) & !3 } else { words }
    }
}
