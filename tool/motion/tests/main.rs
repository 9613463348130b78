//! The test program of the package.
#![allow(
    clippy::disallowed_methods,
    reason = "tests show paths that they made, and expect values of another library"
)]

mod balance;
mod contact;
mod driven;
mod fastest;
mod gentlest;
mod kept;
mod moves;
mod overshoot;
mod pauses;
mod plan;
#[path = "../../support/mod.rs"]
mod support;
mod trace;
mod way;
