//! Columns, rows and sheets as aligned tables, CSV or JSON.

pub(crate) mod json;
pub mod output;
pub mod reading;
pub mod rows;
pub mod screen;
