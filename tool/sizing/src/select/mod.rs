//! Drives of a catalogue, judged, filtered and ranked.

pub mod filter;
pub mod fit;
pub mod named;
pub mod pareto;
pub mod rank;
pub mod ratio;
pub mod requirement;
pub mod size;
