//! Texts with places: what stands where in TOML and CSV, and what is wrong with it.

pub mod columns;
pub mod csv;
#[cfg(feature = "fs")]
pub mod disk;
pub mod file;
pub mod item;
pub mod problem;
pub mod section;
pub mod tree;
