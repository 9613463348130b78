//! Machine files of the library mechanisms: what they say in SI units, and what a user is told about a wrong one.

mod axes;
mod ball_screw;
mod cam_table;
mod disc_cam;
mod four_bar;
mod geneva;
mod hoist;
mod indexing_cam;
mod inverted_slider_crank;
mod parallel_shafts;
mod planetary;
mod rack;
mod scotch_yoke;
mod six_link;
mod toggle_press;

use crate::reading::{machine, parse, refuses, refuses_edit, refuses_edits, rendered};

/// The one whole example of a document.
fn example(document: &'static str) -> &'static str {
    let mut blocks = document.split("\n```toml\n").skip(1);
    let block = blocks.next().and_then(|rest| rest.split("\n```").next());
    assert!(blocks.next().is_none(), "one example a document");
    block.unwrap()
}

#[track_caller]
fn close(found: f64, expected: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= 1e-12 * expected.abs().max(1e-3),
        "{found} is not {expected}"
    );
}
