//! A study, row by row.

use super::cell::Cell;
use super::header::Header;

/// A study: rows that are computed one by one, in any order.
pub trait RowSource: Sync {
    /// Identity of the study.
    fn header(&self) -> Header;

    /// One row.
    fn row(&self, index: u64) -> Vec<Cell>;
}
