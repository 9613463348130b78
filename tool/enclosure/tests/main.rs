//! The test program of the package.
#![allow(
    clippy::disallowed_methods,
    reason = "tests expect values of another library"
)]

mod golden;
mod intervals;
mod linkages;
mod mechanics;
mod taylor;
