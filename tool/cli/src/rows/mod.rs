//! Rows of a study: computed in parallel, written in order, continued and merged.

pub mod merge;
pub mod run;
pub mod store;
