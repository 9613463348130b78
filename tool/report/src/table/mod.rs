//! Columns, rows and sheets as aligned tables, CSV, JSON or cells of a spreadsheet.

#[cfg(feature = "workbook")]
pub(crate) mod grid;
pub(crate) mod json;
pub mod output;
pub mod reading;
pub mod rows;
pub mod screen;
