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
use crate::support::close;
use crate::support::machines::FOUR_BAR;
