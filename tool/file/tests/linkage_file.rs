//! Linkages, springs, dampers and bounded drives in machine files: what they say in SI units, against independent
//! results, and what a user is told about a wrong one.

mod cams;
mod change_points;
mod elements;
mod refusals;
mod strokes;
mod trains;
mod values;
mod wheels;

use crate::reading::{parse, read, refuses, refuses_edit, refuses_edits};
use crate::support::machines::FOUR_BAR;

#[track_caller]
fn within(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= tolerance,
        "{found} is {error:e} from {expected}, more than {tolerance:e}"
    );
}
