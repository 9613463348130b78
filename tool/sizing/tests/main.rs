//! The test program of the package.
#![allow(
    clippy::disallowed_methods,
    reason = "tests show paths that they made, and expect values of another library"
)]

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

use std::path::Path;

use jred_analysis::checked;
use jred_analysis::duty::Duty;
use jred_sizing::catalogue::{Drive, Motor};

/// A motor without a gearbox and an amplifier.
fn direct(motor: &Motor) -> Drive<'_> {
    Drive {
        motor,
        gearbox: None,
        amplifier: None,
    }
}

/// The duty of the press in so many steps.
fn press_duty(steps: usize) -> Duty {
    let text = support::press_text();
    let file = checked::parse("press.toml", &text, Path::new("")).unwrap();
    Duty::new(&file, file.motion.as_ref().unwrap(), steps).unwrap()
}
