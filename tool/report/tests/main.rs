//! The test program of the package.
#![allow(
    clippy::disallowed_methods,
    reason = "tests expect values of another library"
)]

mod curves;
mod lever;
#[path = "../../support/mod.rs"]
mod support;
