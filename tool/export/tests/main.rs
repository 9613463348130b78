//! The one test program of the package.
#![allow(
    clippy::disallowed_methods,
    reason = "tests show paths that they made, and expect values of another library"
)]

mod between_places;
mod cams;
mod drives;
mod proven_export;
#[path = "../../support/reading.rs"]
mod reading;
#[path = "../../support/mod.rs"]
mod support;

use jred_analysis::checked as reader;
