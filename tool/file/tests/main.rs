//! The one test program of the package.
#![allow(
    clippy::disallowed_methods,
    reason = "tests show paths that they made, and expect values of another library"
)]

mod complete;
mod formula;
mod import;
mod keys;
mod linkage_file;
mod machine_file;
mod mechanisms;
mod motion;
mod names;
mod project;
mod reader;
#[path = "../../support/reading.rs"]
mod reading;
mod rules;
mod spline;
mod supply;
#[path = "../../support/mod.rs"]
mod support;
