//! Rows of a study: computed in parallel, written in order, resumed and merged.

pub mod merge;
pub mod run;
pub mod store;
