//! Texts with places: what stands where in TOML and CSV, and what is wrong with it.

pub mod columns;
#[cfg(feature = "fs")]
pub(crate) mod disk;
pub mod file;
pub mod item;
pub mod problem;
pub mod section;
