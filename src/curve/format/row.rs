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
    /// Rows are padded to a multiple of this.
    pub(super) multiple: usize,
    /// Rows beyond the cells.
    pub(super) more: usize,
}

impl Row {
    /// Words from one row to the next.
    pub(crate) const fn pitch(&self, set: Set) -> usize {
        (self.head + (width(set) * self.halves).div_ceil(2)).next_multiple_of(self.multiple)
    }
}
