//! A study, row by row.

use super::header::Header;
use crate::cell::Cell;

/// A study: rows that are computed one by one, in any order.
pub trait RowSource: Sync {
    /// Identity of the study.
    fn header(&self) -> Header;

    /// One row.
    fn row(&self, index: u64) -> Vec<Cell>;
}
