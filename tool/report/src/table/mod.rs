//! Columns, rows and sheets as aligned tables, CSV or JSON.

pub(crate) mod json;
pub mod output;
pub mod rows;
pub mod sheet;
