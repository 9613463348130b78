//! Texts with places: reading TOML and CSV, and showing their faults.

pub mod columns;
pub mod csv;
#[cfg(feature = "fs")]
pub mod disk;
pub mod entries;
pub mod file;
pub mod item;
pub mod key;
pub mod problem;
pub mod section;
pub mod tree;
pub(crate) mod value;
