//! The test program of the package.
#![allow(clippy::disallowed_methods, reason = "tests show paths that they made")]

mod benchmarks;
mod brute;
mod bus;
mod catalogue;
mod cycle;
mod duty;
mod envelope;
mod explain;
mod meter;
mod rules;
mod search;
mod sensitivity;
#[path = "../../support/mod.rs"]
mod support;
mod thermal;
mod vary;
