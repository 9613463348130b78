//! The test program of the package.

mod curves;
mod lever;
#[path = "../../support/mod.rs"]
mod support;
