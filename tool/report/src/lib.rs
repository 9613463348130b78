//! Results as tables, listings, plots and pages.
//!
//! Takes the results of [`jred_file`], [`jred_analysis`], [`jred_export`], [`jred_sizing`] and [`jred_motion`]; the command prints what it returns.
//!
//! 0. [`units`]: SI, or inches and pounds.
//! 1. [`table`]: columns, rows and sheets as aligned tables, CSV or JSON.
//! 2. [`answer`] and [`list`]: the answers of the commands, each built once and rendered as text, CSV, JSON and HTML.
//! 3. [`plot`] and [`drawing`]: curves and mechanisms as SVG.
//! 4. [`page`]: self-contained HTML pages.
#![forbid(unsafe_code)]

pub mod answer;
pub mod drawing;
pub mod list;
pub mod page;
pub mod plot;
pub mod schemas;
pub mod table;
pub mod units;
