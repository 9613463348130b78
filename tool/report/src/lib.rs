//! What was found, written: tables, listings, plots and pages.
//!
//! Behind [`jred_machine`], [`jred_sizing`] and [`jred_motion`], whose results are data, and before the command, which prints.
//!
//! 1. [`table`]: columns, rows and sheets as aligned tables, CSV or JSON.
//! 2. [`list`]: what the commands answer, in words and as JSON.
//! 3. [`plot`] and [`drawing`]: curves and mechanisms as SVG.
//! 4. [`page`]: self-contained HTML pages.
#![forbid(unsafe_code)]

pub mod drawing;
pub mod list;
pub mod page;
pub mod plot;
pub mod table;
