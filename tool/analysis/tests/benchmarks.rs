//! Sizing problems with answers from elsewhere: makers' handbooks, and closed forms worked out here. `docs/evidence.md` lists
//! them.

use jred_analysis::duty::{Duty, Instant};
use jred_file::model::machine::MachineFile;

use crate::reading::{machine, read};
use crate::support::budget::SIMPSON;
use crate::support::{near, within};

mod handbooks;
mod machines;
mod moves;

fn duty(file: &MachineFile) -> Duty {
    Duty::new(file, file.required_motion().unwrap(), 2000).unwrap()
}

/// The instant nearest to a time.
fn at(duty: &Duty, t: f64) -> &Instant {
    let distance = |instant: &&Instant| (instant.t - t).abs();
    let instants = duty.instants.iter();
    instants
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .unwrap()
}

/// Checks a figure that a source prints with an error of half its last digit, or with that of the figures it was made from.
#[track_caller]
fn printed(what: &str, found: f64, expected: f64, error: f64) {
    within(what, found, expected, error);
}
