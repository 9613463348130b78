//! Rows of a study: computed in parallel, written in order, resumed.

pub mod run;
pub mod store;
