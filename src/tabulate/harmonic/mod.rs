//! Harmonics of a machine, from its mechanism.
//!
//! The coefficients of a smooth machine fall geometrically: a few replace a table of many cells. A kink (a load with an edge, a dwell) makes them
//! fall like 1/k²: such a machine needs a table. [`fit()`] distinguishes them.

mod error;
#[allow(
    clippy::indexing_slicing,
    reason = "runs before a machine does, not in a tick"
)]
mod fit;
#[allow(
    clippy::indexing_slicing,
    reason = "runs before a machine does, not in a tick"
)]
mod spectrum;

pub use error::HarmonicError;
pub use fit::{Fit, fit, measure, scratch_len, terms_in_use};
