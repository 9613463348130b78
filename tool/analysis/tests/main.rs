//! The one test program of the package.
#![allow(
    clippy::disallowed_methods,
    reason = "tests show paths that they made, and expect values of another library"
)]

mod benchmarks;
mod check;
mod cross_check;
mod duty;
mod duty_meter;
mod every_machine;
mod identify;
mod joint_friction;
mod largest;
mod load_table;
mod motion;
#[path = "../../support/reading.rs"]
mod reading;
mod schedule;
mod simulate;
mod sliding;
mod steady;
mod strokes;
#[path = "../../support/mod.rs"]
mod support;
mod swing;
mod variator;
mod warned;

use jred_analysis::checked as reader;
